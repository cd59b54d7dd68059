// prefilter: computes what surfaces of one roughness reflect of an environment if they are seen along their normals. It is an
// average over directions. For each direction the cube is read whose texels are about as large as the solid angle that the
// direction stands for. An invocation takes a texel.
// Reads: an environment's cube and ever coarser averages of it, directions. Writes: a cube. Twin: twins/src/prefilter.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/interface.glsl"
#include "include/workgroup.glsl"
layout(local_size_x = 64) in;
// Four half floats a texel; face by face in Vulkan's order, row by row.
layout(std430, set = SET_OWN, binding = PREFILTER_BINDING_TEXELS) buffer Texels { uvec2 texels[]; };
layout(std430, set = SET_OWN, binding = PREFILTER_BINDING_RAYS) readonly buffer Rays { vec4 rays[]; };    // about +z, and the level to read
layout(push_constant) uniform Push {
    uint finest;        // texels along the side of the finest cube that is read, a power of two
    uint side;          // texels along the side of the cube that is written
    uint first;         // first texel of that cube
    uint first_ray;
    uint ray_count;
} push;

// The direction of a place on a face, whose coordinates go from -1 to 1. It is not normalised.
vec3 direction(uint face, vec2 at) {
    float along = (face & 1u) == 0u ? 1.0 : -1.0;
    if (face < 2u) return vec3(along, -at.y, -along * at.x);
    if (face < 4u) return vec3(at.x, along, along * at.y);
    return vec3(along * at.x, -at.y, along);
}

// The inverse: the face that a direction points at, and the place there.
vec2 place(vec3 d, out uint face) {
    vec3 size = abs(d);
    bool is_x = size.x >= size.y && size.x >= size.z, is_y = !is_x && size.y >= size.z;
    float along = is_x ? d.x : is_y ? d.y : d.z, turn = along < 0.0 ? -1.0 : 1.0;
    face = (is_x ? 0u : is_y ? 2u : 4u) + (along < 0.0 ? 1u : 0u);
    return (is_x ? vec2(-d.z * turn, -d.y) : is_y ? vec2(d.x, d.z * turn) : vec2(d.x * turn, -d.y)) / abs(along);
}

vec3 texel(uint i) {
    uvec2 halves = texels[i];
    return vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
}

// Interpolates between the nearest texels of a face in the cube of a level.
vec3 average(uint level, uint face, vec2 at) {
    uint side = push.finest >> level, last = side - 1u;
    vec2 middle = clamp((0.5 * at + 0.5) * float(side) - 0.5, 0.0, float(last)), low = floor(middle), share = middle - low;
    uvec2 a = uvec2(low), b = min(a + 1u, uvec2(last));
    // The number of texels in finer cubes, which is six times the sum of the squares of their sides; then the faces before.
    uint face_start = 8u * (push.finest * push.finest - side * side) + face * side * side;
    uint top = face_start + a.y * side, bottom = face_start + b.y * side;
    vec3 upper = mix(texel(top + a.x), texel(top + b.x), share.x);
    vec3 lower = mix(texel(bottom + a.x), texel(bottom + b.x), share.x);
    return mix(upper, lower, share.y);
}

void main() {
    uint i = invocation_number(), area = push.side * push.side;
    if (i >= 6u * area) return;
    uint in_face = i % area;
    uvec2 column_row = uvec2(in_face % push.side, in_face / push.side);
    vec3 normal = normalize(direction(i / area, (2.0 * vec2(column_row) + 1.0) / float(push.side) - 1.0));
    // Any two axes perpendicular to the normal (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
    float turn = normal.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (turn + normal.z), b = normal.x * normal.y * a;
    vec3 right = vec3(1.0 + turn * normal.x * normal.x * a, turn * b, -turn * normal.x);
    vec3 up = vec3(b, turn + normal.y * normal.y * a, -normal.y);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint k = 0u; k < push.ray_count; k++) {
        vec4 ray = rays[push.first_ray + k];
        uint face;
        vec2 at = place(right * ray.x + up * ray.y + normal * ray.z, face);
        sum += ray.z * average(uint(ray.w), face, at);
        weights += ray.z;
    }
    sum /= weights;
    texels[push.first + i] = uvec2(packHalf2x16(sum.xy), packHalf2x16(vec2(sum.z, 1.0)));
}
