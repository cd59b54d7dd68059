// Comparison of display codes: 8 bits a channel, red in the lowest, alpha in the highest. Alpha is not compared here.
#ifndef CONTRAST_GLSL
#define CONTRAST_GLSL

// The three colour channels are spread over fields of 11 bits, so that one subtraction compares all of them.
const uint FIELDS = 0x400801u;

uint spread(uint c) {
    return (c & 0xffu) | (c & 0xff00u) << 3 | (c & 0xff0000u) << 6;
}

// Whether a difference d of spread colours lies in some channel beyond -contrast to contrast. A channel of d lies within -510 to
// 510. A field of `u` holds 512 + contrast + d, whose bit 9 is set if d is -contrast or more and the field is below 1024. A
// field of 1024 or more means that d is above contrast, which is at most 255. The same bit of 2 * limit - u is set if d is
// contrast or less, and if d is not far below -contrast.
bool exceeding(uint d) {
    uint limit = (512u + frame.contrast) * FIELDS;
    uint u = d + limit;
    return (u & (2u * limit - u) & 512u * FIELDS) != 512u * FIELDS;
}

// Whether two colours differ in some channel by more than `frame.contrast`; both are spread.
bool contrasting(uint a, uint b) { return exceeding(a - b); }

// Whether the second difference of three colours exceeds `frame.contrast` in some channel; all are spread.
bool bending(uint a, uint b, uint c) { return exceeding(a + c - 2u * b); }

#endif
