// Lists of the layers that a sample sees, from the nearest one on.
#ifndef LAYER_LIST_GLSL
#define LAYER_LIST_GLSL

// What a record links to, or ~0. Links go to records that come before: nothing else is followed, so that lists end even
// where a record found no room, and what is there is left from another round.
uint farther(uint node) {
    uint next = texelFetch(records, int(node)).w;
    return next < node ? next : ~0u;
}

#endif
