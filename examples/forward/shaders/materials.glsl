// The renderer's two materials. Both fragments and the library's samples are shaded with them.

const uint CHECKERS = 0u, GLOSS = 1u;
const vec3 TO_SUN = vec3(0.424, 0.848, 0.318);

// The mean, over a box, of a checkerboard of -1 and 1. The checkerboard's integral along an axis is a triangle wave.
float checkers(vec2 at, vec2 side) {
    vec2 wide = max(side, 1e-4);
    vec2 low = abs(mod(at - 0.5 * wide, 2.0) - 1.0), high = abs(mod(at + 0.5 * wide, 2.0) - 1.0);
    vec2 mean = (low - high) / wide;
    return mean.x * mean.y;
}

// The mean over a parallelogram, which is approximated by a row of boxes along its longer side.
float checkers(vec2 at, vec2 dx, vec2 dy) {
    const float BOXES = 8.0;
    bool wide = dot(dx, dx) > dot(dy, dy);
    vec2 along = (wide ? dx : dy) / BOXES, side = abs(along) + abs(wide ? dy : dx);
    float sum = 0.0;
    for (float i = 0.5; i < BOXES; i += 1.0) sum += checkers(at + (i - 0.5 * BOXES) * along, side);
    return sum / BOXES;
}

// The light of a surface at a place in the world, in linear light. `dx` and `dy` are the change of the place across the part of a
// pixel that is shaded.
vec3 light_of(uint key, vec3 color, vec3 place, vec3 normal, vec3 eye, vec3 dx, vec3 dy) {
    vec3 n = normalize(normal);
    vec3 diffuse = color * (0.25 + 0.75 * max(dot(n, TO_SUN), 0.0));
    if (key == CHECKERS) return diffuse * (0.55 + 0.45 * checkers(2.0 * place.xz, 2.0 * dx.xz, 2.0 * dy.xz));
    vec3 between = normalize(TO_SUN + normalize(eye - place));
    return diffuse + 0.6 * pow(max(dot(n, between), 0.0), 60.0);
}
