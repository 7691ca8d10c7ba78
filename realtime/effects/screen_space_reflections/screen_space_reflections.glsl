// What a ray meets on the screen, as the frame has lit it.
#include "reflections.glsl"
#include "screen_rays.glsl"
#include "marching.glsl"
uniform sampler2D scattered_light;
#ifdef FALLBACK_CUBE
#include "cube_maps.glsl"
#include "cube_box.glsl"
uniform vec3 box_low;
uniform vec3 box_high;
#endif

// What a ray that met nothing sees.
vec3 unmet(Surface surface, vec3 direction) {
#ifdef FALLBACK_CUBE
    return from_cube(0, towards_wall(surface.position, direction, box_low, box_high, cube_centres[0]));
#else
    return UNMET;
#endif
}

vec3 seen_along(Surface surface, vec3 direction) {
    vec2 place;
    verdict = MARCH(screen_ray(surface.position, direction), place);
    return verdict == MET ? texelFetch(scattered_light, ivec2(place), 0).rgb : unmet(surface, direction);
}

vec3 indirect(Surface surface) {
    return reflected(surface);
}
