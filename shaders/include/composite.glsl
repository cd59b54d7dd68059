// BLEND layers over an opaque surface or the background.
#ifndef COMPOSITE_GLSL
#define COMPOSITE_GLSL

// The surfaces of a chain, from the record of the nearest one on. Links go to records that come before, so that there
// is an end to what is left of another round too, where a record found no room.
vec4 composite(uint node) {
    vec3 light = vec3(0.0);
    float through = 1.0;
    bool more;
    do {
        uint farther = texelFetch(records, int(node)).w;
        vec4 layer = texelFetch(shaded, int(node));
        light += through * layer.a * layer.rgb;
        through *= 1.0 - layer.a;
        more = farther < node;
        node = farther;
    } while (more);
    return to_output(vec4(light + through * frame.background.rgb, 1.0 - through * (1.0 - frame.background.a)));
}

#endif
