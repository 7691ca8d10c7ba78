// cosᵉ of an angle, given its cosine and squared sine. Near 1 the logarithm of a rounded cosine has lost its digits: there
// it is a series in the squared sine. Twin: scenes/optics/microfacet.py.
float cosine_power(float cosine, float sin2, float exponent) {
    if (cosine <= 0.0) return 0.0;
    float series = -0.5 * sin2 * (1.0 + sin2 * (0.5 + sin2 * (0.333333333 + sin2 * 0.25)));
    return exp(exponent * (sin2 < 0.015625 ? series : log(cosine)));
}

// The exponent of (n·h) whose lobe is as high as GGX's (Walter et al. 2007, section 5.2).
float blinn_exponent(float alpha) {
    return 2.0 / (alpha * alpha) - 2.0;
}
