//! Lights (`KHR_lights_punctual`). One that cannot be used is left out with a warning.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use super::{Context, json::Item};
use crate::scene::{document::LightSource, error::Fault, light::LightKind};

/// Largest inner angle of a spot light's cone, relative to the outer one.
const HARDEST: f32 = 0.999;

/// Reads all lights; `None` for those that cannot be used.
pub fn read_all(context: &mut Context<'_>) -> Result<Vec<Option<LightSource>>, Fault> {
    let items = match context.root.extension("KHR_lights_punctual") {
        Some(extension) => extension.objects("lights")?,
        None => Vec::new(),
    };
    Ok(items
        .iter()
        .map(|item| {
            let light = read(item, context).map(Some);
            context.tolerate(light, "the light is left out")
        })
        .collect())
}

fn read(item: &Item<'_>, context: &mut Context<'_>) -> Result<LightSource, Fault> {
    let kind = item.require("type")?;
    let kind = match kind.as_str()? {
        "directional" => LightKind::Directional,
        "point" => LightKind::Point,
        "spot" => read_spot(item, context)?,
        other => return Err(kind.fault(format!("\"{other}\" is no light type"))),
    };
    let intensity = item.f64_or("intensity", 1.0)?.max(0.0);
    let color = item.numbers::<3>("color")?.unwrap_or([1.0; 3]);
    let color = color.map(|x| (x.max(0.0) * intensity) as f32);
    if !color.iter().all(|x| x.is_finite()) {
        return Err(item.fault("colour times intensity is not within single precision"));
    }
    let range = match item.get("range") {
        Some(range) if kind != LightKind::Directional => Some(range.as_f64()? as f32),
        _ => None,
    };
    if range.is_some_and(|range| range <= 0.0) {
        context.warn(&item.fault("a range of 0 or less is taken for an infinite one"));
    }
    Ok(LightSource {
        kind,
        color,
        range: range.filter(|&range| range > 0.0 && range.is_finite()),
    })
}

fn read_spot(item: &Item<'_>, context: &mut Context<'_>) -> Result<LightKind, Fault> {
    let Some(spot) = item.get("spot") else {
        context.warn(&item.fault("the spot light has no \"spot\" and takes the defaults"));
        return Ok(LightKind::Spot {
            inner_angle: 0.0,
            outer_angle: FRAC_PI_4,
        });
    };
    let inner_angle = spot.f32_or("innerConeAngle", 0.0)?;
    let outer_angle = spot.f32_or("outerConeAngle", FRAC_PI_4)?;
    if outer_angle <= 0.0 {
        return Err(spot.fault(format!("an outer cone of {outer_angle} lets no light out")));
    }
    let (given_inner, given_outer) = (inner_angle, outer_angle);
    let outer_angle = outer_angle.min(FRAC_PI_2);
    // Exporters write equal angles for a hard edge.
    let inner_angle = inner_angle.clamp(0.0, HARDEST * outer_angle);
    if inner_angle != given_inner || outer_angle != given_outer {
        context.warn(&spot.fault(format!(
            "the angles {given_inner} and {given_outer} do not ascend from 0 to pi / 2; they are \
             taken for {inner_angle} and {outer_angle}"
        )));
    }
    Ok(LightKind::Spot {
        inner_angle,
        outer_angle,
    })
}
