// What numbers are, by their bits: compilers may take for granted that arithmetic makes neither infinity nor NaN, and drop
// what asks `isnan` or `isinf`.
#ifndef FINITE_GLSL
#define FINITE_GLSL

bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7fffffffu) < 0x7f800000u; }

#endif
