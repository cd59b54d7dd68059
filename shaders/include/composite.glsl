// BLEND layers over an opaque surface.
#ifndef COMPOSITE_GLSL
#define COMPOSITE_GLSL

// One sample's layers, from its opaque surface on.
vec4 composite(uint node) {
    uvec4 record = texelFetch(records, int(node));
    bool background = record.y == 0u;
    vec4 c = background ? frame.background : texelFetch(shaded, int(node));
    bool untouched = background && record.w == ~0u;
    vec4 flat_background = c;
    while (record.w != ~0u) {
        node = record.w;
        record = texelFetch(records, int(node));
        vec4 layer = texelFetch(shaded, int(node));
        c = vec4(layer.rgb * layer.a, layer.a) + c * (1.0 - layer.a);
    }
    return untouched ? flat_background : to_output(c);
}

#endif
