// Real spherical harmonics of the first three bands, and the irradiance that nine coefficients give (Ramamoorthi &
// Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", eq. 3 and 13), with Z of the paper as Y.
uniform sampler2D sh_coefficients; // one a column, with the band's cosine weight A_l/π in it

float basis(int index, vec3 d) {
    if (index == 0) return 0.28209479177387814;
    if (index < 4) return 0.4886025119029199 * (index == 1 ? d.z : index == 2 ? d.y : d.x);
    if (index == 6) return 0.31539156525252005 * (3.0 * d.y * d.y - 1.0);
    if (index == 8) return 0.5462742152960396 * (d.x * d.x - d.z * d.z);
    return 1.0925484305920792 * (index == 4 ? d.x * d.z : index == 5 ? d.z * d.y : d.x * d.y);
}

// Irradiance over π; a sun makes it negative on the far side, which no light is.
vec3 sh_radiance(vec3 normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < COEFFICIENTS; ++i) sum += texelFetch(sh_coefficients, ivec2(i, 0), 0).rgb * basis(i, normal);
    return max(sum, 0.0);
}
