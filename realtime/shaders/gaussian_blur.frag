// One direction of a Gaussian; beyond the picture all is black.
uniform sampler2D image;
uniform ivec2 direction;
uniform float sigma;  // pixels
uniform int radius;
out vec4 result;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), size = textureSize(image, 0);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = -radius; i <= radius; i++) {
        float weight = exp(-0.5 * float(i * i) / (sigma * sigma));
        ivec2 place = here + i * direction;
        weights += weight;
        if (all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, size)))
            sum += weight * texelFetch(image, place, 0).rgb;
    }
    result = vec4(sum / weights, 1.0);
}
