//! Triangles of lists, strips and fans, with their corners in Vulkan's order.

/// Triangles of a list: every three corners form a triangle.
#[must_use]
pub fn list<T: Copy>(corners: &[T]) -> Vec<[T; 3]> {
    let triangles = corners.chunks_exact(3);
    triangles.map(|corners| [corners[0], corners[1], corners[2]]).collect()
}

/// Triangles of a strip: each corner from the third on forms a triangle with the two before it. In every other
/// triangle, these two are exchanged, so that all triangles have the same orientation.
#[must_use]
pub fn strip<T: Copy>(corners: &[T]) -> Vec<[T; 3]> {
    let triangles = corners.windows(3).enumerate();
    triangles
        .map(|(number, corners)| match number % 2 {
            0 => [corners[0], corners[1], corners[2]],
            _ => [corners[0], corners[2], corners[1]],
        })
        .collect()
}

/// Triangles of a fan: each corner from the third on forms a triangle with the one before it and the first.
#[must_use]
pub fn fan<T: Copy>(corners: &[T]) -> Vec<[T; 3]> {
    let Some((first, others)) = corners.split_first() else {
        return Vec::new();
    };
    let triangles = others.windows(2);
    triangles.map(|pair| [pair[0], pair[1], *first]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_have_vulkans_order() {
        let corners = [0, 1, 2, 3, 4, 5];
        assert_eq!(list(&corners), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(strip(&corners), [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]);
        assert_eq!(fan(&corners), [[1, 2, 0], [2, 3, 0], [3, 4, 0], [4, 5, 0]]);
        assert!(list(&corners[..2]).is_empty() && strip(&corners[..2]).is_empty());
        assert!(fan(&corners[..2]).is_empty() && fan::<u32>(&[]).is_empty());
    }
}
