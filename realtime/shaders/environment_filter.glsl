// The environment seen through the material's lobes, by drawing directions from them. A direction may stand for the
// solid angle that it represents (Křivánek & Colbert 2008, "Real-time Shading with Filtered Importance Sampling", eq. 8
// to 12): what a sun far smaller than that sends is then spread over all, rather than met by one texel in a thousand.
#include "brdf.glsl"
#include "sample_lobes.glsl"
uniform samplerCube environment_source; // with mip levels
uniform float source_texel;             // mean solid angle of one of its texels, sr
uniform float least_angle;              // of a texel that is filled: it stands for no less, sr

// The level whose texels have this solid angle.
float source_level(float solid_angle, float texel) {
    return max(0.5 * log2(solid_angle / texel), 0.0);
}

// What a direction drawn with this density stands for; four times as much, so that neighbours overlap (eq. 11, K = 4).
float represented(float density, int samples) {
    return 4.0 / (float(samples) * density);
}

vec3 source_towards(vec3 direction, float density) {
#ifdef FILTERED
    float level = source_level(max(represented(density, SAMPLES), least_angle), source_texel);
#else
    float level = 0.0;
#endif
    return textureLod(environment_source, direction, level).rgb;
}

// Radiance under GGX's lobe, as seen straight along it (n = v = r), weighted with n·l (Karis 2013, "Real Shading in
// Unreal Engine 4").
vec3 specular_radiance(vec3 axis, float alpha) {
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        vec3 h = ggx_half_vector(hammersley(i, SAMPLES), alpha);
        vec3 l = vec3(2.0 * h.z * h.xy, 2.0 * h.z * h.z - 1.0);
        if (l.z <= 0.0) continue;
        float density = d_ggx(h.z, dot(h.xy, h.xy), alpha) * 0.25; // D·(n·h)/(4·(v·h)), v = n
        sum += source_towards(turned_to(axis, l), density) * l.z;
        weight += l.z;
    }
    return sum / weight;
}

// Irradiance over π: the mean radiance under the cosine.
vec3 diffuse_radiance(vec3 normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        vec3 l = cosine_direction(hammersley(i, SAMPLES));
        sum += source_towards(turned_to(normal, l), l.z * (1.0 / PI));
    }
    return sum / float(SAMPLES);
}
