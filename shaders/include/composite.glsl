// BLEND layers over an opaque surface or the background.
#ifndef COMPOSITE_GLSL
#define COMPOSITE_GLSL
#include "layer_list.glsl"
#include "tint.glsl"

// The colour of a list of layers. `node` is the fragment of the nearest one.
vec4 composite(uint node) {
    vec3 light = vec3(0.0);
    vec3 through = vec3(1.0);
    // The exception of DO_WHILE, see workarounds.glsl.
    while (node != ~0u) {
        vec4 layer = texelFetch(shaded, int(node));
        light += TINTED ? through * layer.rgb : through * layer.a * layer.rgb;
        through *= TINTED ? unpack_tint(layer.a) : vec3(1.0 - layer.a);
        node = farther(node);
    }
    // Alpha is weighted by the mean of what the channels let through.
    float left = TINTED ? dot(through, vec3(1.0 / 3.0)) : through.x;
    // The background is already as the output holds it.
    vec4 layers = to_output(vec4(light, 1.0 - left));
    return vec4(layers.rgb + through * frame.background.rgb, 1.0 - left * (1.0 - frame.background.a));
}

#endif
