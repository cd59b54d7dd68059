// Linked lists of the layers that a sample sees, from the nearest one on.
#ifndef LAYER_LIST_GLSL
#define LAYER_LIST_GLSL

// The record that a record links to, or ~0 at the end. Valid links lead to records with smaller indices. Other links are not
// followed: where a record found no room, memory still holds one of another round, and lists have to end even then.
uint farther(uint node) {
    uint next = texelFetch(records, int(node)).w;
    return next < node ? next : ~0u;
}

#endif
