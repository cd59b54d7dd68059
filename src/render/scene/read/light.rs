//! Lights (`KHR_lights_punctual`). A light that can't be used is left out with a warning.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec3;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as Description, Spot, Type};

use super::Context;
use crate::scene::{
    error::Fault,
    light::{Light, LightKind},
};

/// Largest ratio of the inner to the outer angle of a spot light's cone.
const HARDEST: f32 = 0.999;

/// Reads all lights, each at the origin and along -Z; `None` for those that can't be used.
pub fn read_all(context: &mut Context<'_>) -> Vec<Option<Light>> {
    let model = context.model;
    let read = model.all().map(|found| {
        let light = found.and_then(|(item, place)| read(item, &place, context).map(Some));
        context.tolerate(light, "the light is left out")
    });
    read.collect()
}

/// Reads the light at `place`.
pub fn read(item: &Description, place: &str, context: &mut Context<'_>) -> Result<Light, Fault> {
    let kind = match context.model.valid(&item.type_, &format!("{place}/type"))? {
        Type::Directional => LightKind::Directional,
        Type::Point => LightKind::Point,
        Type::Spot => match &item.spot {
            Some(spot) => read_spot(spot, &format!("{place}/spot"), context)?,
            None => {
                let reason = "the spot light has no \"spot\" and takes the defaults";
                context.warn(&Fault::new(place, reason));
                LightKind::Spot { inner_angle: 0.0, outer_angle: FRAC_PI_4 }
            }
        },
    };
    let color = item.color.map(|x| x.max(0.0) * item.intensity.max(0.0));
    if !color.iter().all(|x| x.is_finite()) {
        let reason = "colour times intensity is not within single precision";
        return Err(Fault::new(place, reason));
    }
    let range = item.range.filter(|_| kind != LightKind::Directional);
    if range.is_some_and(|range| range <= 0.0) {
        let reason = "a range of 0 or less is taken for an infinite one";
        context.warn(&Fault::new(place, reason));
    }
    Ok(Light { kind, position: DVec3::ZERO, direction: DVec3::NEG_Z, color, range: range.filter(|&range| range > 0.0) })
}

fn read_spot(spot: &Spot, place: &str, context: &mut Context<'_>) -> Result<LightKind, Fault> {
    let (given_inner, given_outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
    if given_outer <= 0.0 {
        let reason = format!("an outer cone of {given_outer} lets no light out");
        return Err(Fault::new(place, reason));
    }
    let outer_angle = given_outer.min(FRAC_PI_2);
    // Exporters write equal angles for a hard edge; the inner one is reduced below the outer one.
    let inner_angle = given_inner.clamp(0.0, HARDEST * outer_angle);
    if inner_angle != given_inner || outer_angle != given_outer {
        let reason = format!(
            "the angles {given_inner} and {given_outer} do not ascend from 0 to pi / 2; they are \
             taken for {inner_angle} and {outer_angle}"
        );
        context.warn(&Fault::new(place, reason));
    }
    Ok(LightKind::Spot { inner_angle, outer_angle })
}
