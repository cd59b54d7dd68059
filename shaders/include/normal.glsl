// Normal mapping.
#ifndef NORMAL_GLSL
#define NORMAL_GLSL

// The normal that a texel of a normal texture gives, in the mesh's frame of tangent, bitangent and normal.
vec3 bumped(vec4 texel, float scale, vec3 tangent, vec3 bitangent, vec3 normal) {
    vec3 n = texel.xyz * 2.0 - 1.0;
    n.xy *= scale;
    return safe_normalize(tangent * n.x + bitangent * n.y + normal * n.z, normal);
}

// An interpolated normal may face away from the eye at a silhouette. It is then turned until it is perpendicular to `to_eye`.
vec3 facing(vec3 normal, vec3 to_eye) {
    float turned = dot(normal, to_eye);
    return turned < 0.0 ? safe_normalize(normal - to_eye * turned, normal) : normal;
}

#endif
