// A latitude-longitude map, by the convention of scenes/optics/environment.py; that is also the twin.
uniform sampler2D environment_map; // row 0 at the top
uniform vec3 environment_radiance; // a factor
uniform float environment_rotation;

// u (any whole turn beside 0…1) and v of a unit direction.
vec2 environment_coordinates(vec3 direction, float rotation) {
    float polar = atan(length(direction.xz), direction.y); // acos(y) would lose digits near the poles
    return vec2(0.5 + (atan(direction.z, direction.x) + rotation) * 0.15915494309189535, polar * 0.3183098861837907);
}

// Bilinear by hand: a filter in hardware may round its weights to 1/256, which a sun of many thousands shows.
vec3 environment_towards(vec3 direction) {
    ivec2 size = textureSize(environment_map, 0);
    vec2 place = environment_coordinates(direction, environment_rotation) * vec2(size) - 0.5;
    vec2 corner = floor(place), part = place - corner;
    ivec2 low = ivec2(corner);
    int left = ((low.x % size.x) + size.x) % size.x, right = (left + 1) % size.x;
    int top = clamp(low.y, 0, size.y - 1), bottom = clamp(low.y + 1, 0, size.y - 1);
    vec3 above = mix(texelFetch(environment_map, ivec2(left, top), 0).rgb,
                     texelFetch(environment_map, ivec2(right, top), 0).rgb, part.x);
    vec3 below = mix(texelFetch(environment_map, ivec2(left, bottom), 0).rgb,
                     texelFetch(environment_map, ivec2(right, bottom), 0).rgb, part.x);
    return environment_radiance * mix(above, below, part.y);
}
