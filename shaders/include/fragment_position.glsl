// The position at which a visibility sample is shaded.
#ifndef FRAGMENT_POSITION_GLSL
#define FRAGMENT_POSITION_GLSL
#include "locations.glsl"
#include "place.glsl"
#include "tiles.glsl"

// The position on the image plane, in pixels from the screen's centre.
vec2 fragment_position(uvec4 fragment) {
    vec2 offset = place_location(fragment.z);
    if (!LOCATIONS) return frame.origin + vec2(fragment.x & 0xffffu, fragment.x >> 16) + offset;
    uint location = fragment.x & POINT_LOCATION;
    uvec4 at = texelFetch(locations, int(2u * location));
    return tile_center(ivec2(at.xy) >> ivec2(3, 2)) + place_in_tile(at) + location_jacobian(location) * offset;
}

#endif
