// The mean over a row of texels, or a column: both in turn make a square. Tiles are not kept apart: what runs into a tile
// from its neighbour stays within its border. Of the image's own edge nothing is drawn.
uniform sampler2D image;
uniform ivec2 along; // one texel
out vec4 mean;

void main() {
    ivec2 centre = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int i = -MEAN_RADIUS; i <= MEAN_RADIUS; ++i) sum += texelFetch(image, centre + i * along, 0);
    mean = sum / float(2 * MEAN_RADIUS + 1);
}
