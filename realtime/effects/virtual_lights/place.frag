// Virtual lights where the rays of a light end: a column for each, read from the light's reflective shadow map.
#include "surface.glsl"
#include "brdf.glsl"
#include "lights.glsl"
uniform sampler2D rays; // row 0: texel of the map; row 1: W
uniform float inverse_range_square;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_power;

void main() {
    int ray = int(gl_FragCoord.x);
    Surface surface;
    // The viewer is the light: what faces away from it reflects nothing.
    bool lit = load_surface(ivec2(texelFetch(rays, ivec2(ray, 0), 0).xy), surface);
    vec3 power = texelFetch(rays, ivec2(ray, 1), 0).rgb;
    if (viewer.w > 0.0) {
        vec3 offset = viewer.xyz - surface.position;
        power *= range_window(1.0 / max(dot(offset, offset), 1e-30), inverse_range_square);
    }
    out_position = vec4(surface.position, 1.0);
    out_normal = vec4(lit ? surface.normal : vec3(0.0), 0.0);
    out_power = vec4(lit ? power * diffuse_color(surface.base_color, surface.metallic) * (1.0 / PI) : vec3(0.0), 0.0);
}
