// A smooth surface between two dielectrics (scenes/optics/dielectric.py; that is also the twin). `eta` is the index of
// refraction beyond the surface over that on the viewer's side, the normal is on that side.

// The refracted direction's cosine to the normal; 0 from the critical angle on.
float cosine_beyond(float cosine, float eta) {
    return sqrt(max(1.0 - (1.0 - cosine * cosine) / (eta * eta), 0.0));
}

// Fresnel's equations: the share of unpolarised light that is mirrored.
float dielectric_reflectance(float cosine, float eta) {
    float beyond = cosine_beyond(cosine, eta);
    float across = (cosine - eta * beyond) / (cosine + eta * beyond);
    float along = (eta * cosine - beyond) / (eta * cosine + beyond);
    return beyond > 0.0 ? 0.5 * (across * across + along * along) : 1.0;
}

// Snell's law: the direction, away from the surface on its far side, of what is seen through it.
vec3 refracted(vec3 normal, vec3 view, float cosine, float eta) {
    return normal * (cosine / eta - cosine_beyond(cosine, eta)) - view / eta;
}
