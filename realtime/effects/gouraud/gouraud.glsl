// Radiance reflected from one punctual light at the vertices, interpolated.
uniform sampler2D interpolated_light;

vec3 direct(Surface surface) {
    return texelFetch(interpolated_light, ivec2(gl_FragCoord.xy), 0).rgb;
}
