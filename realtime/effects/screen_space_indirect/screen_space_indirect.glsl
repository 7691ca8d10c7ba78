// Light gathered over the screen, averaged over like pixels, on the diffuse base.
#include "tile_mean.glsl"
#include "brdf.glsl"
uniform sampler2D gathered;

vec3 indirect(Surface surface) {
    return tile_mean(gathered, surface) * diffuse_color(surface.base_color, surface.metallic);
}
