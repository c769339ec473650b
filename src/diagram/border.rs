//! Straight borders on the sheet, where the drawing cuts planes of the scene.

use super::sheet::Point;

/// A straight line on the sheet. On one side of it a linear function of the place is positive, on the other one negative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Border {
    /// The function at the upper left corner of the sheet.
    at_corner: f64,
    /// By how much it grows to the right and down.
    slope: [f64; 2],
}

impl Border {
    /// The line where this function is zero, which must be linear.
    pub(super) fn new(function: impl Fn([f64; 2]) -> f64) -> Self {
        let at_corner = function([0.0; 2]);
        let slope = [function([1.0, 0.0]) - at_corner, function([0.0, 1.0]) - at_corner];
        Self { at_corner, slope }
    }

    fn value(&self, [x, y]: Point) -> f64 {
        self.at_corner + self.slope[0] * f64::from(x) + self.slope[1] * f64::from(y)
    }

    /// Where the line crosses the way from one place to another one, if it does.
    fn crossing(&self, from: Point, to: Point) -> Option<Point> {
        let (start, end) = (self.value(from), self.value(to));
        let share = start / (start - end);
        let at = |axis: usize| f64::from(from[axis]) + f64::from(to[axis] - from[axis]) * share;
        ((start < 0.0) != (end < 0.0)).then(|| [at(0) as f32, at(1) as f32])
    }

    /// The part of a convex polygon that lies on the positive side.
    pub(super) fn beyond(&self, corners: &[Point]) -> Vec<Point> {
        let mut part = Vec::new();
        for (number, corner) in corners.iter().enumerate() {
            if self.value(*corner) >= 0.0 {
                part.push(*corner);
            }
            part.extend(self.crossing(*corner, corners[(number + 1) % corners.len()]));
        }
        part
    }

    /// The part of a convex polygon that lies on the negative side.
    pub(super) fn before(&self, corners: &[Point]) -> Vec<Point> {
        let turned = Self { at_corner: -self.at_corner, slope: self.slope.map(|slope| -slope) };
        turned.beyond(corners)
    }

    /// The ends of the line within a rectangle, the upper one first.
    pub(super) fn within(&self, min: Point, max: Point) -> Option<[Point; 2]> {
        let corners = rectangle(min, max);
        let sides = (0..4).map(|side| [corners[side], corners[(side + 1) % 4]]);
        let ends: Vec<Point> = sides.filter_map(|[from, to]| self.crossing(from, to)).collect();
        match ends[..] {
            [one, other] => Some(if one[1] <= other[1] { [one, other] } else { [other, one] }),
            _ => None,
        }
    }
}

/// The corners of a rectangle.
pub(super) fn rectangle(min: Point, max: Point) -> [Point; 4] {
    [min, [max[0], min[1]], max, [min[0], max[1]]]
}
