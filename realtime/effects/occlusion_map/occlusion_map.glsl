// The texture says which share of the environment arrives.
vec3 environment_visibility(Surface surface) {
    return vec3(surface.occlusion);
}
