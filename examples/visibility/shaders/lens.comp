// lens: writes the locations that are seen through a magnifying glass over the middle of the picture, for the library to sample.
// An invocation takes a location.
#version 460
layout(local_size_x = 64) in;
struct Location { ivec2 pixel; vec2 within; mat2 jacobian; };
layout(std430, binding = 0) writeonly buffer Locations { Location locations[]; };
layout(push_constant) uniform Push {
    uvec2 size;         // of the picture, in pixels
    uint side;          // locations along a pixel's side
    uint first_row;     // first row of the picture's pixels
} push;

const float MAGNIFICATION = 3.0;    // in the middle
const float RADIUS = 0.45;          // of the glass, over the picture's height

// The point of the image plane that is seen at a point of the picture, both in pixels from the upper left corner, y down.
vec2 lens(vec2 at) {
    vec2 middle = 0.5 * vec2(push.size), from_middle = at - middle;
    float r = length(from_middle) / (RADIUS * float(push.size.y));
    return middle + from_middle * mix(1.0 / MAGNIFICATION, 1.0, smoothstep(0.0, 1.0, r));
}

void main() {
    uint i = gl_GlobalInvocationID.x, columns = push.size.x * push.side;
    if (i >= locations.length()) return;
    float apart = 1.0 / float(push.side);
    vec2 at = vec2(0.0, push.first_row) + apart * (vec2(i % columns, i / columns) + 0.5);
    vec2 seen = lens(at), right = vec2(0.5 * apart, 0.0), down = right.yx;
    mat2 jacobian = mat2(lens(at + right) - lens(at - right), lens(at + down) - lens(at - down));
    locations[i] = Location(ivec2(floor(seen)), fract(seen), jacobian);
}
