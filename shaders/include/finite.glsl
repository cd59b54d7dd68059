// Tests for NaN and infinity by the bits of a number. Compilers may assume that arithmetic yields neither, and then remove
// calls of `isnan` and `isinf`.
#ifndef FINITE_GLSL
#define FINITE_GLSL

bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7fffffffu) < 0x7f800000u; }

#endif
