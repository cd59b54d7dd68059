//! Colours over the transitions of lenses, the parts that a zoom bends.

use glam::DVec2;
use gpc::camera::zoom::ZoomRegion;

/// Colours of the lenses, used in turn.
const TINTS: [[u8; 3]; 4] = [[255, 64, 64], [64, 160, 255], [64, 220, 96], [255, 190, 32]];

/// Mixes `code` with the tint of the last lens in whose transition `place` lies; `place` is in pixels of the picture.
pub fn tinted(code: [u8; 4], place: DVec2, regions: &[ZoomRegion]) -> [u8; 4] {
    let Some(index) = regions.iter().rposition(|region| region.in_transition(place)) else {
        return code;
    };
    let tint = TINTS[index % TINTS.len()];
    let mix = |channel: usize| ((u16::from(code[channel]) + u16::from(tint[channel])) / 2) as u8;
    [mix(0), mix(1), mix(2), 255]
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::camera::zoom::{Shape, Transition};

    #[test]
    fn transitions_alone_are_tinted() {
        let region = ZoomRegion {
            center: [50.0, 50.0],
            radius: [10.0, 10.0],
            multiplicity: 0.5,
            shape: Shape::Circle,
            transition: Transition::Linear,
        };
        let code = [100, 100, 100, 255];
        let at = |x: f64| tinted(code, DVec2::new(x, 50.0), &[region]);
        assert_eq!((at(55.0), at(85.0)), (code, code));
        assert_eq!(at(70.0), [177, 82, 82, 255]);
    }
}
