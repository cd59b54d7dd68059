// Shadows on surfaces: how much of each light reaches a place. Places are the pixels of the region, then the visibility
// samples. Where cells are locations, there are only the latter.
#ifndef SHADOWS_GLSL
#define SHADOWS_GLSL
#include "interface.glsl"
#include "locations.glsl"

// Words of a place: 0 without shadows. The first word has a bit for each light, set if something lies between light and
// place. If casters may let light pass, a word for each light follows: the share of the light that passes, as a float. It is
// valid if the light's bit is set.
layout(constant_id = CONSTANT_SHADOW_WORDS) const uint SHADOW_WORDS = 0u;
layout(set = SET_DATA, binding = BINDING_SHADOW_WORDS) uniform utextureBuffer shadow_words;

uint place_of_fragment(uint fragment) { return (LOCATIONS ? 0u : frame.size.x * frame.size.y) + fragment; }

uint shadows_at(uint place) { return SHADOW_WORDS != 0u ? texelFetch(shadow_words, int(place * SHADOW_WORDS)).x : 0u; }

// The share of a light that reaches a place. `shadows` is the first word of the place.
float light_share(uint place, uint shadows, uint light) {
    if (SHADOW_WORDS == 0u || light >= 32u || (shadows >> light & 1u) == 0u) return 1.0;
    return SHADOW_WORDS == 1u ? 0.0 : uintBitsToFloat(texelFetch(shadow_words, int(place * SHADOW_WORDS + 1u + light)).x);
}

#endif
