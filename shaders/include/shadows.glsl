// Which lights surfaces lie in the shadow of. Places are the pixels of the region and then, or where cells are locations from
// the first one on, visibility samples.
#ifndef SHADOWS_GLSL
#define SHADOWS_GLSL
#include "interface.glsl"
#include "locations.glsl"

// Words of a place: none where shadows are not asked for; a bit for each light that something keeps from it; and where casters
// may let light pass, for each light what part of it does, as a float, which counts if the light's bit is set.
layout(constant_id = CONSTANT_SHADOW_WORDS) const uint SHADOW_WORDS = 0u;
layout(set = SET_DATA, binding = BINDING_SHADOW_WORDS) uniform utextureBuffer shadow_words;

uint place_of_record(uint record) { return (LOCATIONS ? 0u : frame.size.x * frame.size.y) + record; }

uint shadows_at(uint place) { return SHADOW_WORDS != 0u ? texelFetch(shadow_words, int(place * SHADOW_WORDS)).x : 0u; }

// What part of a light reaches a place with such shadows.
float light_share(uint place, uint shadows, uint light) {
    if (SHADOW_WORDS == 0u || light >= 32u || (shadows >> light & 1u) == 0u) return 1.0;
    return SHADOW_WORDS == 1u ? 0.0 : uintBitsToFloat(texelFetch(shadow_words, int(place * SHADOW_WORDS + 1u + light)).x);
}

#endif
