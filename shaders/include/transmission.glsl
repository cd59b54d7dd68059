// KHR_materials_transmission and KHR_materials_volume: light from behind that passes a surface without refraction. It is tinted
// by the base colour, and by absorption over the thickness (the law of Beer and Lambert).
#ifndef TRANSMISSION_GLSL
#define TRANSMISSION_GLSL

// For a dielectric: of the light that the surface does not reflect, the share that passes.
float transmitted(Place place) {
    return transmission_of(place.material).factor * READ(TRANSMISSION_TEXTURE, place).r;
}

// The share of this light that the volume does not absorb. Its thickness is given in lengths of the mesh; `scale` is how much
// longer these are in the world.
vec3 volume_passes(Place place, float scale) {
    float thickness = transmission_of(place.material).thickness * READ(THICKNESS_TEXTURE, place).g * scale;
    return exp(-absorption_of(place.material) * thickness);
}

#endif
