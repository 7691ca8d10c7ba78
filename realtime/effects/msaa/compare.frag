// Where a sample sees another triangle than the first one, or another of both sees none.
uniform sampler2D first_identity, first_position;
uniform sampler2D identity, position;
out vec4 edge;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool first_seen = texelFetch(first_position, pixel, 0).w > 0.0, seen = texelFetch(position, pixel, 0).w > 0.0;
    bool same = texelFetch(first_identity, pixel, 0).xyz == texelFetch(identity, pixel, 0).xyz;
    edge = vec4(first_seen != seen || (seen && !same) ? 1.0 : 0.0);
}
