// An indirect dispatch of n workgroups, folded into rows of 32,768.
uvec4 groups(uint n) {
    return n == 0u ? uvec4(0u) : uvec4(min(n, 32768u), (n + 32767u) / 32768u, 1u, 0u);
}
