uniform sampler2D logarithms;
uniform float level;
out vec4 result;

void main() {
    result = textureLod(logarithms, vec2(0.5), level);
}
