// Normal mapping, and normals that point away from the eye. Twin: twins/src/reflection.rs.
#ifndef NORMAL_GLSL
#define NORMAL_GLSL

// The normal that a texel of a normal texture gives, in the mesh's frame of tangent, bitangent and normal.
vec3 bumped(vec4 texel, float scale, vec3 tangent, vec3 bitangent, vec3 normal) {
    vec3 n = texel.xyz * 2.0 - 1.0;
    n.xy *= scale;
    return safe_normalize(tangent * n.x + bitangent * n.y + normal * n.z, normal);
}

// The normal for reflections. Interpolated normals, normals of textures and normals that contradict the triangle's winding may
// point away from the eye. Such a normal is mirrored at the plane perpendicular to `to_eye`. A normal in this plane stays as it is,
// so that the result has no jump anywhere.
vec3 facing(vec3 normal, vec3 to_eye) {
    return normal - 2.0 * min(dot(normal, to_eye), 0.0) * to_eye;
}

// Share of its reflections that a surface with this normal keeps: all if the normal points to the side of the eye, and none if it
// points straight away.
float facing_share(vec3 normal, vec3 to_eye) {
    return 1.0 + min(dot(normal, to_eye), 0.0);
}

#endif
