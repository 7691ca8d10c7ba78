// The depth test lets through what lies no deeper: a picture drawn at the greatest depth only where there is an edge.
uniform sampler2D edges;
out vec4 unused;

void main() {
    unused = vec4(0.0);
    gl_FragDepth = texelFetch(edges, ivec2(gl_FragCoord.xy), 0).r > 0.0 ? 1.0 : 0.0;
}
