uniform sampler2D edges;
uniform sampler2D centre;
uniform sampler2D mean;  // of the pattern's samples
out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool edge = texelFetch(edges, pixel, 0).r > 0.0;
    result = vec4(edge ? texelFetch(mean, pixel, 0).rgb : texelFetch(centre, pixel, 0).rgb, 1.0);
}
