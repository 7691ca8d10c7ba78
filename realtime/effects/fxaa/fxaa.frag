// FXAA (Lottes 2009), with the search along edges of version 3.11: of code values, in the picture's own gamma. Between
// pixels it mixes by itself: texture units may round what they mix of 8-bit texels to a code.
uniform sampler2D image;
uniform float threshold;
uniform float darkest;
uniform float smoothing;
uniform int reach;
out vec4 result;

// Rec. 601's luma, of code values.
float luma(vec3 code) {
    return dot(code, vec3(0.299, 0.587, 0.114));
}

vec3 at(ivec2 place) {
    return texelFetch(image, clamp(place, ivec2(0), textureSize(image, 0) - 1), 0).rgb;
}

float luma_at(ivec2 place) {
    return luma(at(place));
}

// How far from `start` along `direction` the edge to the pixel `across` ends, in pixels, and the luma there over the
// edge's own.
vec2 edge_end(ivec2 start, ivec2 across, ivec2 direction, float edge, float least) {
    float difference = 0.0;
    for (int walked = 1; walked <= reach; ++walked) {
        ivec2 place = start + walked * direction;
        difference = 0.5 * (luma_at(place) + luma_at(place + across)) - edge;
        if (abs(difference) >= least) {
            return vec2(walked, difference);
        }
    }
    return vec2(reach, difference);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec3 color = at(here);
    float m = luma(color);
    float n = luma_at(here + ivec2(0, 1)), s = luma_at(here - ivec2(0, 1));
    float e = luma_at(here + ivec2(1, 0)), w = luma_at(here - ivec2(1, 0));
    float brightest = max(m, max(max(n, s), max(e, w)));
    float range = brightest - min(m, min(min(n, s), min(e, w)));
    result = vec4(color, 1.0);
    if (range < max(darkest, threshold * brightest)) {
        return;
    }
    float ne = luma_at(here + ivec2(1, 1)), nw = luma_at(here + ivec2(-1, 1));
    float se = luma_at(here + ivec2(1, -1)), sw = luma_at(here - ivec2(1, 1));

    // What stands out of its neighbours is finer than a pixel.
    float mean = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
    float fine = smoothstep(0.0, 1.0, clamp(abs(mean - m) / range, 0.0, 1.0));
    fine *= fine * smoothing;

    float along_x = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
    float along_y = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
    bool horizontal = along_x >= along_y;

    // The edge lies between this pixel and the neighbour that differs more.
    ivec2 across = horizontal ? ivec2(0, 1) : ivec2(1, 0);
    float ahead = horizontal ? n : e, behind = horizontal ? s : w;
    if (abs(behind - m) >= abs(ahead - m)) {
        across = -across;
        ahead = behind;
    }
    float edge = 0.5 * (ahead + m);
    float least = 0.25 * abs(ahead - m);
    ivec2 along = horizontal ? ivec2(1, 0) : ivec2(0, 1);
    vec2 left = edge_end(here, across, -along, edge, least), right = edge_end(here, across, along, edge, least);
    vec2 nearer = left.x < right.x ? left : right;

    // A line from end to end covers this pixel only on the side that the nearer end falls to.
    bool covered = (nearer.y < 0.0) != (m < edge);
    float slant = covered ? 0.5 - nearer.x / (left.x + right.x) : 0.0;
    result.rgb = mix(color, at(here + across), max(slant, fine));
}
