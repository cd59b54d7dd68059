// Folds: two triangles at an angle of 60 degrees or more to each other, like the riser and the tread of a step.
#ifndef FOLD_GLSL
#define FOLD_GLSL

#include "triangle.glsl"

const float FOLD = 0.5;             // cosine of the angle from which on two triangles are a fold

// The normal of a triangle on the side that the eye sees.
vec3 facing_normal(Triangle k) {
    vec3 a = position_of(k, vec3(1.0, 0.0, 0.0));
    vec3 b = position_of(k, vec3(0.0, 1.0, 0.0)), c = position_of(k, vec3(0.0, 0.0, 1.0));
    vec3 normal = unit_or(cross(b - a, c - a), vec3(0.0));
    vec3 ray = frame.view_direction.w != 0.0 ? frame.view_direction.xyz : a - frame.eye.xyz;
    return dot(normal, ray) > 0.0 ? -normal : normal;
}

// Whether a triangle with this normal and the triangle with an ID are a fold. Background, with the ID 0, has none.
bool is_fold(vec3 normal, uint id) {
    return id != 0u && dot(normal, facing_normal(triangle_at(max(id, 1u) - 1u))) < FOLD;
}

#endif
