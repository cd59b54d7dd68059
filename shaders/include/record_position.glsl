// The position at which a visibility sample is shaded.
#ifndef RECORD_POSITION_GLSL
#define RECORD_POSITION_GLSL
#include "locations.glsl"
#include "place.glsl"
#include "tiles.glsl"

// The position on the image plane, in pixels from the screen's centre.
vec2 record_position(uvec4 record) {
    vec2 offset = place_location(record.z);
    if (!LOCATIONS) return frame.origin + vec2(record.x & 0xffffu, record.x >> 16) + offset;
    uint location = record.x & POINT_LOCATION;
    uvec4 at = texelFetch(locations, int(2u * location));
    return tile_center(ivec2(at.xy) >> ivec2(3, 2)) + place_in_tile(at) + location_jacobian(location) * offset;
}

#endif
