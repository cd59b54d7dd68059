// Linked lists of the layers that a sample sees, from the nearest one on.
#ifndef LAYER_LIST_GLSL
#define LAYER_LIST_GLSL

// The fragment that a fragment links to, or ~0 at the end. Valid links lead to fragments with smaller indices. Other links are not
// followed: where a fragment found no room, memory still holds one of another round, and lists have to end even then.
uint farther(uint node) {
    uint next = texelFetch(fragments, int(node)).w;
    return next < node ? next : ~0u;
}

#endif
