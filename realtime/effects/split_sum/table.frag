// Albedos over n·v (across) and roughness (up), both 0…1 from the first texel's centre to the last one's: scale and bias
// of F0, and the mean of Schlick's weight over the base.
#include "albedo_samples.glsl"
out vec4 albedos;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    vec2 place = vec2(cell) / float(SIDE - 1);
    float n_dot_v = max(place.x, 1e-3), alpha = max(place.y * place.y, MIN_ALPHA);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        vec2 u = hammersley(i, SAMPLES);
        sum += vec3(specular_sample(u, n_dot_v, alpha), diffuse_sample(u, n_dot_v));
    }
    albedos = vec4(sum / float(SAMPLES), 0.0);
}
