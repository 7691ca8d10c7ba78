// The mean of the bins' middles, each weighted with what of its pixels lies between the trims.
uniform sampler2D counts;
uniform int bins;
uniform float low;
uniform float high;
uniform float darkest;
uniform float brightest;
out vec4 result;

void main() {
    float all_pixels = 0.0;
    for (int i = 0; i < bins; i++) all_pixels += texelFetch(counts, ivec2(i, 0), 0).r;
    float first = darkest * all_pixels, last = (1.0 - brightest) * all_pixels;
    float below = 0.0, weights = 0.0, sum = 0.0;
    for (int i = 0; i < bins; i++) {
        float here = below + texelFetch(counts, ivec2(i, 0), 0).r;
        float weight = max(min(here, last) - max(below, first), 0.0);
        weights += weight;
        sum += weight * (low + (float(i) + 0.5) * (high - low) / float(bins));
        below = here;
    }
    result = vec4(sum / max(weights, 1e-6));
}
