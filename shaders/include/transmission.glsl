// KHR_materials_transmission and KHR_materials_volume: what of the light behind a surface passes it, straight on, tinted by
// the base colour and by absorption over the thickness (Beer and Lambert).
#ifndef TRANSMISSION_GLSL
#define TRANSMISSION_GLSL

// Share of the light that the surface does not reflect that passes, for a dielectric.
float transmitted(Place place) {
    return material_vector(place.material, MATERIAL_TRANSMISSION).x * READ(TRANSMISSION_TEXTURE, place).r;
}

// What a volume leaves of it, whose thickness is that of a mesh which is drawn so many times as large.
vec3 volume_passes(Place place, float scale) {
    float thickness = material_vector(place.material, MATERIAL_TRANSMISSION).y * READ(THICKNESS_TEXTURE, place).g * scale;
    return exp(-material_vector(place.material, MATERIAL_VOLUME).rgb * thickness);
}

#endif
