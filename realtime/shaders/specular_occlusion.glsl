// How much of a surface's mirrored light from everywhere remains where a share `visibility` of its scattered light does.
// `bent_dot_mirrored`: cosine between the mean visible direction and the mirrored view. Twin: ambient/twin.py.

float specular_as_diffuse(float visibility, float n_dot_v, float alpha, float bent_dot_mirrored) {
    return visibility;
}

float specular_unoccluded(float visibility, float n_dot_v, float alpha, float bent_dot_mirrored) {
    return 1.0;
}

// Lagarde & de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26.
float specular_lagarde(float visibility, float n_dot_v, float alpha, float bent_dot_mirrored) {
    float power = exp2(-16.0 * alpha - 1.0);
    return clamp(pow(max(n_dot_v + visibility, 1e-6), power) - 1.0 + visibility, 0.0, 1.0);
}

// The solid angle that two spherical caps share, over 2π, from their half angles and the angle between their axes (Oat &
// Sander 2007, "Ambient Aperture Lighting", listing 1: a smooth step stands for the lens).
float cap_overlap(float first, float second, float between) {
    float small = min(first, second), difference = abs(first - second);
    float x = 1.0 - clamp((between - difference) / max(first + second - difference, 1e-4), 0.0, 1.0);
    float sine = sin(0.5 * small);  // 1 − cos(small) would cancel
    return x * x * (3.0 - 2.0 * x) * 2.0 * sine * sine;
}

// 1 − e⁻ˣ, by its series where the difference would cancel.
float one_minus_exp(float x) {
    return x < 0.1 ? x * (1.0 - x * (0.5 - x * (0.16666667 - x * 0.041666667))) : 1.0 - exp(-x);
}

// The angle whose cosine is 1 − x: acos has no digits left near 1.
float angle_from_versine(float x) {
    return 2.0 * atan(sqrt(x), sqrt(2.0 - x));
}

// Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion", section 5: the visible directions
// as a cone that has that cosine-weighted visibility, the lobe as one that holds most of it (cos = 10^(−α²)).
float specular_cone(float visibility, float n_dot_v, float alpha, float bent_dot_mirrored) {
    float share = clamp(visibility, 0.0, 1.0);
    float versine = one_minus_exp(2.30258509 * alpha * alpha);
    float between = angle_from_versine(1.0 - clamp(bent_dot_mirrored, -1.0, 1.0));
    float shared_part = cap_overlap(atan(sqrt(share), sqrt(1.0 - share)), angle_from_versine(versine), between);
    return clamp(shared_part / max(versine, 1e-6), 0.0, 1.0);
}
