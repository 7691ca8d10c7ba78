// Depth as maps keep it that are filtered: linear in the distance to the light, or along its rays where it has no
// position (w = 0: the direction towards it); 0 and 1 at the range's ends.
float linear_depth(vec3 point, vec4 light, vec2 range) {
    float away = light.w > 0.0 ? length(point - light.xyz) : -dot(point, light.xyz);
    return (away - range.x) / (range.y - range.x);
}
