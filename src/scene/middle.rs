//! The middle of a scene, which is the origin of the coordinates on the device.

use super::Scene;
use glam::DVec3;

/// Coordinates up to this many times as large as the scene are not moved. They lose three bits of f32 at most.
const MAX_RATIO: f64 = 8.0;

/// A point near the middle of the shapes. Relative to it, the coordinates of the shapes are about as small as their
/// distances from each other. It is zero if they are that small already. It is rounded, so that numbers with few digits
/// still have few digits after the subtraction.
///
/// The middle is the median of the shapes' centres, so that a few shapes that are huge or far away, such as a sky or a
/// sun, do not move it. If no shape has bounds, it is the position of the camera.
pub(super) fn of(scene: &Scene) -> DVec3 {
    let bounds: Vec<[DVec3; 2]> = scene.shapes.iter().filter_map(|of| of.shape.bounds()).collect();
    let (middle, size) = if bounds.is_empty() {
        (scene.camera.eye, scene.camera.eye.distance(scene.camera.look_at))
    } else {
        let coordinate = |axis| median(bounds.iter().map(|[lower, upper]| 0.5 * (lower[axis] + upper[axis])));
        let middle = DVec3::new(coordinate(0), coordinate(1), coordinate(2));
        let farthest =
            |[lower, upper]: &[DVec3; 2]| (middle - lower).abs().max((upper - middle).abs()).max_element();
        (middle, median(bounds.iter().map(farthest)))
    };
    let step = (MAX_RATIO * size).log2().ceil().exp2();
    (middle / step).round() * step
}

/// The median of some numbers, at least one.
fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    let half = numbers.len() / 2;
    *numbers.select_nth_unstable_by(half, f64::total_cmp).1
}
