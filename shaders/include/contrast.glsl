// Comparison of display codes: 8 bits a channel, red in the lowest, alpha in the highest. Alpha is not compared here.
#ifndef CONTRAST_GLSL
#define CONTRAST_GLSL

// The three colour channels are spread over fields of 11 bits, so that one subtraction compares all of them. A field of `u`
// holds 512 + contrast + a - b, whose bit 9 is set if a - b >= -contrast. The same bit of 2 * limit - u is set if
// a - b <= contrast.
const uint FIELDS = 0x400801u;

uint spread(uint c) {
    return (c & 0xffu) | (c & 0xff00u) << 3 | (c & 0xff0000u) << 6;
}

// Whether two colours differ in some channel by more than `frame.contrast`; both are spread.
bool contrasting(uint a, uint b) {
    uint limit = (512u + frame.contrast) * FIELDS;
    uint u = a - b + limit;
    return (u & (2u * limit - u) & 512u * FIELDS) != 512u * FIELDS;
}

#endif
