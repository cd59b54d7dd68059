//! The indices of counters and of indirect dispatches, as `shaders/include/counters.glsl` numbers them.

/// Indices into the buffer of counters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
#[repr(usize)]
pub enum Counter {
    Superpixels,
    Tiles,
    Survivors,
    Large,
    Outside,
    Backfacing,
    Degenerate,
    Untouching,
    RoundFirst,
    NextTile,
    Unfinished,
    Records,
    PlainTiles,
    MaskedTiles,
    BlendedTiles,
    UnlistedTiles,
    Rounds,
    CandidatesTotal,
    RecordsTotal,
    ShadedTotal,
    UnlistedTotal,
    Pairs,
    Thin,
    /// Superpixels that the first few of their samples did not settle.
    Resampled,
    PlainLeft,
    MaskedLeft,
    /// Cells with more candidates than loops may have trips.
    Stalled,
    /// Of a list's locations, those that lie in its region, and those that do not.
    Placed,
    LeftOut,
    /// Cells and groups of a list.
    Cells,
    Groups,
    /// How far samples lie from the centre of the pixel that holds their location, at the most: a float.
    Reach,
    /// How wide cells of a list are at the most, in pixels: a float.
    Widest,
    /// Thin triangles that are long, too.
    ThinLong,
    /// Not zero where there is work for another round.
    Waiting,
    /// Whether a kernel was run in other subgroups than it was made for. It stays: those before it alone are cleared.
    Subgroups,
}

impl Counter {
    /// Length of the buffer of counters.
    pub const COUNT: usize = 36;
    /// Bytes of the buffer of counters.
    pub(crate) const BYTES: u64 = 4 * Self::COUNT as u64;
    /// Bytes of those that are cleared before each run.
    pub(crate) const CLEARED_BYTES: u64 = 4 * Self::Subgroups as u64;

    /// Its value among all counters; 0 where these are fewer.
    pub(crate) fn of(self, counters: &[u32]) -> u32 {
        counters.get(self as usize).copied().unwrap_or(0)
    }
}

/// Indices of indirect dispatches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
#[repr(u32)]
pub enum Argument {
    Cull,
    BinSmall,
    BinLarge,
    Setup,
    SamplePlain,
    SampleMasked,
    SampleBlended,
    SampleUnlisted,
    Sort,
    Thin,
    Groups,
    PlainLeft,
    MaskedLeft,
    Tally,
    Enlist,
    ThinLong,
    /// The first material bin's; the others follow.
    Shade,
}

/// Tiles whose needs `tally` sums up; `shaders/include/load.glsl` calls them a stretch.
pub(crate) const STRETCH: u32 = 256;

#[cfg(test)]
mod tests {
    use super::*;

    fn shader_constant(name: &str) -> Option<usize> {
        include_str!("../../../shaders/include/counters.glsl")
            .lines()
            .find_map(|line| {
                let mut words = line.split_whitespace();
                (words.next() == Some("#define") && words.next() == Some(name))
                    .then(|| words.next()?.parse().ok())
                    .flatten()
            })
    }

    fn shouted(name: &str) -> String {
        name.chars()
            .enumerate()
            .flat_map(|(i, c)| {
                (i > 0 && c.is_uppercase())
                    .then_some('_')
                    .into_iter()
                    .chain(c.to_uppercase())
            })
            .collect()
    }

    #[test]
    fn counters_and_arguments_are_the_shaders() {
        use Counter as C;
        for counter in [
            C::Superpixels,
            C::Tiles,
            C::Survivors,
            C::Large,
            C::Outside,
            C::Backfacing,
            C::Degenerate,
            C::Untouching,
            C::RoundFirst,
            C::NextTile,
            C::Unfinished,
            C::Records,
            C::PlainTiles,
            C::MaskedTiles,
            C::BlendedTiles,
            C::UnlistedTiles,
            C::Rounds,
            C::CandidatesTotal,
            C::RecordsTotal,
            C::ShadedTotal,
            C::UnlistedTotal,
            C::Pairs,
            C::Thin,
            C::Resampled,
            C::PlainLeft,
            C::MaskedLeft,
            C::Stalled,
            C::Placed,
            C::LeftOut,
            C::Cells,
            C::Groups,
            C::Reach,
            C::Widest,
            C::ThinLong,
            C::Waiting,
            C::Subgroups,
        ] {
            let name = format!("COUNTER_{}", shouted(&format!("{counter:?}")));
            assert_eq!(shader_constant(&name), Some(counter as usize), "{name}");
        }
        assert_eq!(shader_constant("COUNTER_COUNT"), Some(Counter::COUNT));
        assert_eq!(shader_constant("STRETCH"), Some(STRETCH as usize));
        use Argument as A;
        for argument in [
            A::Cull,
            A::BinSmall,
            A::BinLarge,
            A::Setup,
            A::SamplePlain,
            A::SampleMasked,
            A::SampleBlended,
            A::SampleUnlisted,
            A::Sort,
            A::Thin,
            A::Groups,
            A::PlainLeft,
            A::MaskedLeft,
            A::Tally,
            A::Enlist,
            A::ThinLong,
            A::Shade,
        ] {
            let name = format!("ARGUMENT_{}", shouted(&format!("{argument:?}")));
            assert_eq!(shader_constant(&name), Some(argument as usize), "{name}");
        }
    }
}
