// The hemisphere's visibility, for both parts of what a surface reflects.
#include "occlusion_lookup.glsl"
#include "occluded_ambient.glsl"

vec3 environment_visibility(Surface surface) {
    float visible = occlusion_at(surface, ivec2(gl_FragCoord.xy)).w;
    return occluded_ambient(surface, vec3(visible), visible, surface.normal);
}
