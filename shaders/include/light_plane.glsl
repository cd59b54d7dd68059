// Projection of a surface on the plane of a light. The shader pushes the members that this reads: see occlude.comp.
#ifndef LIGHT_PLANE_GLSL
#define LIGHT_PLANE_GLSL
#include "triangle.glsl"

// Casters have to be nearer to the light than the receiver by at least this share of the receiver's distance or, for distant
// lights, of the scene's depth. This keeps a surface from shadowing itself.
const float BIAS = 1.0 / 131072.0;

// Where a surface lies on the plane.
struct Projected {
    bool turned;        // the side that is seen is turned away from the light
    bool asked;         // other triangles decide whether the light reaches it
    uvec2 pixel;        // from the upper left pixel of the part of the plane that is sampled
    vec2 within;        // place in the pixel, from 0 to 1
    float least;        // depth from which on a triangle lies in front of it
};

// The plane of a cube that a direction belongs to, by the nearest axis: x, -x, y, -y, z, -z. Of equally near axes the first wins.
uint face_of(vec3 way) {
    vec3 size = abs(way);
    float largest = max(size.x, max(size.y, size.z));
    uint axis = size.x == largest ? 0u : size.y == largest ? 1u : 2u;
    float along = axis == 0u ? way.x : axis == 1u ? way.y : way.z;
    return 2u * axis + (along < 0.0 ? 1u : 0u);
}

// Projects a surface. `normal` points to the side that is seen; `backlit` surfaces let light from behind through. The part of the
// plane that is sampled has `size` pixels from pixel `first` on.
Projected project(vec3 position, vec3 normal, bool backlit, ivec2 first, ivec2 size) {
    Projected r;
    bool local = push.light.w != 0.0;
    vec3 to_light = local ? push.light.xyz - position : push.light.xyz;
    float distance_ = length(to_light);
    bool reached = !local || (distance_ <= push.range && dot(-to_light, push.cone.xyz) >= push.cone.w * distance_);
    r.turned = reached && !backlit && dot(normal, to_light) < 0.0;
    vec4 at = to_clip(push.to_plane, vec4(position, 1.0));
    vec2 uv = at.xy / at.w, low = floor(uv);
    r.asked = reached && !r.turned && at.w > 0.0 && (push.face == SINGLE_PLANE || face_of(-to_light) == push.face);
    // Rounding may move a place on the border of the part of the plane outside. Up to a pixel outside it is moved back.
    ivec2 pixel = ivec2(clamp(low, -8388608.0, 8388607.0)) - first, last = size - 1;
    vec2 within = uv - low;
    r.within = mix(mix(within, vec2(0.0), lessThan(pixel, ivec2(0))), vec2(1.0), greaterThan(pixel, last));
    r.asked = r.asked && all(greaterThanEqual(pixel, ivec2(-1))) && all(lessThanEqual(pixel, last + 1));
    r.pixel = uvec2(clamp(pixel, ivec2(0), last));
    float depth = at.z / at.w;
    r.least = local ? depth * (1.0 + BIAS) : depth + BIAS;
    return r;
}

#endif
