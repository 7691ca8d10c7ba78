// The sum of each column, times a weight.
uniform sampler2D rows;
uniform float weights[COUNT];
out vec4 result;

void main() {
    int column = int(gl_FragCoord.x);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < textureSize(rows, 0).y; ++i) sum += texelFetch(rows, ivec2(column, i), 0);
    result = sum * weights[column];
}
