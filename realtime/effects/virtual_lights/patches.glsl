// Virtual lights are Lambert patches: what one sends, and how it sees the scene.
uniform sampler2D virtual_position;
uniform sampler2D virtual_normal;
uniform sampler2D virtual_power; // W/sr along the normal
uniform vec2 planes;             // metres: near and far of the maps' views

const float WIDTH = 4.0; // of a map's view: the tangent of half its angle. What lies beyond, 6 % by cosine, counts as seen.

// cos θ/d² of what leaves a patch, and the direction to it.
float received_from(vec3 offset, vec3 normal, float nearest_distance, out vec3 direction) {
    float square = dot(offset, offset);
    direction = square > 0.0 ? offset * inversesqrt(square) : vec3(0.0);
    float distant = max(square, nearest_distance * nearest_distance);
    return distant > 0.0 ? max(-dot(direction, normal), 0.0) / distant : 0.0;
}

// An offset along two axes across a normal, and along the normal (Duff et al. 2017, listing 3).
vec3 along_axes(vec3 offset, vec3 n) {
    float turned = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (turned + n.z);
    float b = n.x * n.y * a;
    vec3 s = vec3(1.0 + turned * n.x * n.x * a, turned * b, -turned * n.x);
    vec3 t = vec3(b, turned + n.y * n.y * a, -n.y);
    return vec3(dot(offset, s), dot(offset, t), dot(offset, n));
}

// The depth along a perspective view's axis from what its map holds, 0…1.
float axial_depth(float depth, vec2 near_far) {
    return near_far.x * near_far.y / (near_far.y + depth * (near_far.x - near_far.y));
}
