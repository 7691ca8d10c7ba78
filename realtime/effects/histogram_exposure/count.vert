// A pixel is a point in its bin.
#include "luminance.glsl"
#include "bin_of.glsl"
uniform sampler2D image;
uniform float floor_luminance;
uniform int stride;
uniform int bins;
uniform float low;
uniform float high;

void main() {
    int columns = (textureSize(image, 0).x + stride - 1) / stride;
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns) * stride;
    float stops = log2(max(luminance(texelFetch(image, pixel, 0).rgb), floor_luminance));
    gl_Position = vec4(2.0 * (float(bin_of(stops, low, high, bins)) + 0.5) / float(bins) - 1.0, 0.0, 0.0, 1.0);
}
