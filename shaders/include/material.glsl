// Materials, as vectors in one buffer. interface.glsl has the vectors' numbers.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL
#include "interface.glsl"

uvec4 material_words(uint m, uint vector) {
    return texelFetch(materials, int(m * frame.material_vectors + vector));
}

vec4 material_vector(uint m, uint vector) {
    return uintBitsToFloat(material_words(m, vector));
}

#endif
