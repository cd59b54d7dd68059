// Whether two display codes contrast: 8 bits a channel, red in the lowest, alpha in the highest.
#ifndef CONTRAST_GLSL
#define CONTRAST_GLSL

// Three 8-bit channels apart in 11-bit fields, so that one subtraction compares all of them: a field holds
// 512 + contrast + a - b, whose bit 9 is set where a - b >= -contrast, and its complement where a - b <= contrast.
const uint FIELDS = 0x400801u;

uint spread(uint c) {
    return (c & 0xffu) | (c & 0xff00u) << 3 | (c & 0xff0000u) << 6;
}

// Of spread colours.
bool contrasting(uint a, uint b) {
    uint limit = (512u + frame.contrast) * FIELDS;
    uint u = a - b + limit;
    return (u & (2u * limit - u) & 512u * FIELDS) != 512u * FIELDS;
}

#endif
