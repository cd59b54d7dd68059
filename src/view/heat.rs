//! Heat maps: numbers as colours, from black through purple and orange to light yellow.

use std::sync::LazyLock;

static PALETTE: LazyLock<Vec<[u8; 3]>> = LazyLock::new(|| {
    let bytes = nv_flip::magma_lut().to_vec();
    bytes.as_chunks::<3>().0.to_vec()
});

/// The colour of a share of the scale; what lies beyond its ends has that of the end.
pub fn color(share: f64) -> [u8; 3] {
    let top = PALETTE.len().saturating_sub(1);
    let index = (share.clamp(0.0, 1.0) * top as f64).round() as usize;
    PALETTE.get(index).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_lighter() {
        let light = |share| color(share).iter().map(|v| u32::from(*v)).sum::<u32>();
        let lights: Vec<_> = (0..=8)
            .map(|eighth| light(f64::from(eighth) / 8.0))
            .collect();
        assert!(
            lights.is_sorted() && lights[0] < 30 && lights[8] > 500,
            "{lights:?}"
        );
        assert_eq!((color(-1.0), color(7.0)), (color(0.0), color(1.0)));
    }
}
