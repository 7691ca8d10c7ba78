// A number 0…1 for a pixel that differs from its neighbours' (Jimenez 2014, Next Generation Post Processing in Call of
// Duty, interleaved gradient noise: over any 3 × 3 pixels its values are spread evenly).
float interleaved_noise(vec2 pixel) {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}
