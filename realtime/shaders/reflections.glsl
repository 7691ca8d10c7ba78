// Light from other surfaces: their image in the specular lobe, constant ambient light on the base. A technique says
// what is seen along a direction.
#include "visible_lobe.glsl"
#include "noise.glsl"
uniform vec3 ambient_radiance; // of light from other surfaces where nothing better is known

// What other surfaces scatter towards the point from a direction; n·l > 0.
vec3 seen_along(Surface surface, vec3 direction);

// Both lobes. One sample: the mirror's direction alone; more: a low-discrepancy set (Roberts 2018), turned at each pixel.
vec3 reflected(Surface surface) {
    vec3 n = surface.normal, v = surface.view, t;
    vec3 s = basis(n, t);
    float n_dot_v = max(dot(n, v), 1e-7);
    float alpha = max(surface.roughness * surface.roughness, MIN_ALPHA);
    vec3 f0 = reflectance_f0(surface.base_color, surface.metallic, surface.specular);
    vec3 f90 = reflectance_f90(surface.metallic, surface.specular);
    vec3 sum = vec3(0.0);
    if (max(max(f90.x, f0.x), max(f0.y, f0.z)) > 0.0) {
        float turn = interleaved_noise(gl_FragCoord.xy);
        for (int i = 0; i < SAMPLES; ++i) {
            vec3 h = n;
            if (SAMPLES > 1) {
                vec2 u = fract(vec2((float(i) + turn) / float(SAMPLES), turn + 0.6180339887498949 * float(i)));
                vec3 local = visible_normal(vec3(dot(s, v), dot(t, v), n_dot_v), alpha, u.x, u.y);
                h = local.x * s + local.y * t + local.z * n;
            }
            vec3 l = reflect(-v, h);
            float n_dot_l = dot(n, l);
            if (n_dot_l > 0.0)
                sum += f_schlick(dot(v, h), f0, f90) * shadowed_share(n_dot_v, n_dot_l, alpha) * seen_along(surface, l);
        }
    }
    return sum / float(SAMPLES) +
           ambient_base(surface.base_color, surface.metallic, surface.specular, n_dot_v) * ambient_radiance;
}
