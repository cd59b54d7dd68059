//! Composition of the window: a split between two pictures, and a magnifier over them.

use glam::DVec2;

/// A rectangle in pixels, from its upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    pub corner: [u32; 2],
    pub size: [u32; 2],
}

/// A rectangle of a picture, and the rectangle of the window that shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Index of the picture: 0 left of the split, 1 right of it.
    pub layer: usize,
    pub from: Rect,
    pub to: Rect,
}

impl Piece {
    /// The part of this piece that lies in a picture of `size` = [width, height], if any.
    pub fn within(&self, size: [u32; 2]) -> Option<Self> {
        let mut part = *self;
        for (axis, end) in size.into_iter().enumerate() {
            let factor = self.to.size[axis] / self.from.size[axis].max(1);
            let left = end.saturating_sub(self.from.corner[axis]);
            part.from.size[axis] = self.from.size[axis].min(left);
            part.to.size[axis] = part.from.size[axis] * factor;
        }
        (!part.from.size.contains(&0)).then_some(part)
    }
}

/// Approximate side of the magnifier, in pixels of the window.
const MAGNIFIER_SIDE: u32 = 288;

/// Pieces that show the pictures, side by side if there is a split at a column.
pub fn pictures(size: [u32; 2], split: Option<u32>) -> Vec<Piece> {
    let whole = Rect { corner: [0, 0], size };
    cut(whole, split).map(|(layer, part)| Piece { layer, from: part, to: part }).collect()
}

/// Pieces of a square that shows the pictures around `place` enlarged: each pixel has `factor` pixels to each side.
pub fn magnified(size: [u32; 2], split: Option<u32>, place: DVec2, factor: u32) -> Vec<Piece> {
    let centre = [place.x as u32, place.y as u32];
    // An odd number of pixels has a pixel in the middle.
    let side = [0, 1].map(|axis| ((MAGNIFIER_SIDE / factor) | 1).min(size[axis] / factor));
    if side.contains(&0) {
        return Vec::new();
    }
    // The magnifier stays inside of the picture and of the window, as close to the pointer as that allows.
    let around = |centre: u32, side: u32, end: u32| {
        let first = centre.saturating_sub(side / 2);
        first.min(end - side)
    };
    let from = Rect { corner: [0, 1].map(|axis| around(centre[axis], side[axis], size[axis])), size: side };
    let shown = side.map(|side| side * factor);
    let to = [0, 1].map(|axis| around(centre[axis], shown[axis], size[axis]));
    cut(from, split)
        .map(|(layer, part)| Piece {
            layer,
            from: part,
            to: Rect {
                corner: [0, 1].map(|axis| to[axis] + (part.corner[axis] - from.corner[axis]) * factor),
                size: part.size.map(|side| side * factor),
            },
        })
        .collect()
}

/// The parts of a rectangle left and right of a split, each with its layer.
fn cut(rect: Rect, split: Option<u32>) -> impl Iterator<Item = (usize, Rect)> {
    let [left, top] = rect.corner;
    let right = left + rect.size[0];
    let split = split.unwrap_or(right).clamp(left, right);
    let part = move |from: u32, to: u32| Rect { corner: [from, top], size: [to - from, rect.size[1]] };
    [(0, part(left, split)), (1, part(split, right))].into_iter().filter(|(_, part)| part.size[0] > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [640, 400];

    fn columns(pieces: &[Piece]) -> Vec<(usize, u32, u32)> {
        let column = |piece: &Piece| (piece.layer, piece.to.corner[0], piece.to.size[0]);
        pieces.iter().map(column).collect()
    }

    #[test]
    fn a_split_shows_every_column_once() {
        assert_eq!(columns(&pictures(SIZE, None)), [(0, 0, 640)]);
        assert_eq!(columns(&pictures(SIZE, Some(0))), [(1, 0, 640)]);
        assert_eq!(columns(&pictures(SIZE, Some(700))), [(0, 0, 640)]);
        assert_eq!(columns(&pictures(SIZE, Some(200))), [(0, 0, 200), (1, 200, 440)]);
        for piece in pictures(SIZE, Some(200)) {
            assert_eq!(piece.from, piece.to);
        }
    }

    #[test]
    fn the_magnifier_shows_the_pixel_under_the_pointer_in_its_middle() {
        for factor in [8, 16, 32] {
            let centre = [320, 200];
            let [piece] = magnified(SIZE, None, DVec2::new(320.5, 200.5), factor)[..] else {
                panic!("one piece");
            };
            for axis in [0, 1] {
                let side = piece.from.size[axis];
                assert_eq!(side % 2, 1);
                assert_eq!(piece.from.corner[axis] + side / 2, centre[axis]);
                assert_eq!(piece.to.size[axis], side * factor);
                let middle = piece.to.corner[axis] + piece.to.size[axis] / 2;
                assert_eq!(middle, centre[axis]);
            }
        }
    }

    #[test]
    fn the_magnifier_stays_inside_and_is_split_like_the_pictures() {
        for place in [DVec2::new(-5.0, 0.0), DVec2::new(700.0, 399.0), DVec2::new(200.0, 3.0)] {
            let pieces = magnified(SIZE, Some(202), place, 8);
            for piece in &pieces {
                for rect in [piece.from, piece.to] {
                    for axis in [0, 1] {
                        assert!(rect.corner[axis] + rect.size[axis] <= SIZE[axis]);
                    }
                }
                assert_eq!(piece.layer == 0, piece.from.corner[0] < 202);
            }
            if let [left, right] = &pieces[..] {
                assert_eq!(left.to.corner[0] + left.to.size[0], right.to.corner[0]);
                assert_eq!(left.from.corner[0] + left.from.size[0], right.from.corner[0]);
            }
        }
        assert!(magnified([20, 20], None, DVec2::splat(2.0), 32).is_empty());
    }

    #[test]
    fn of_a_smaller_picture_there_is_a_part() {
        let piece = pictures([100, 50], Some(60))[1];
        assert_eq!(piece.within([100, 50]), Some(piece));
        let part = piece.within([80, 70]).unwrap();
        assert_eq!((part.from.corner, part.from.size), ([60, 0], [20, 50]));
        assert_eq!(part.to, part.from);
        assert_eq!(piece.within([60, 50]), None);
        let piece = magnified([100, 50], None, DVec2::new(50.0, 25.0), 8)[0];
        let part = piece.within([50, 50]).unwrap();
        assert_eq!(part.from.size[0], 50 - piece.from.corner[0]);
        assert_eq!(part.to.size[0], 8 * part.from.size[0]);
    }
}
