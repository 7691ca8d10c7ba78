// What a caster's fragment leaves in a map that is filtered: the technique's function of its depth.
#include "shadow_depth.glsl"
#include "kept.glsl"
uniform vec4 shadow_light;
uniform vec2 shadow_range;
in vec3 world_position;
out vec4 out_kept;

void keep() {
    float depth = linear_depth(world_position, shadow_light, shadow_range);
    out_kept = kept(depth, vec2(dFdx(depth), dFdy(depth)));
}
