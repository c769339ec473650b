//! The parts of the drawing that can be moved by hand.

use super::section::{GLASS, Scale};
use super::sheet::Point;
use super::{Diagram, Look};
use crate::scene::CameraModel;

/// A part of the drawing that can be moved by hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The point whose light is drawn, to the left and right.
    Point,
    /// The rim of the lens or of the hole, up and down.
    Rim,
    /// The focal plane, to the left and right.
    FocalPlane,
    /// The film, to the left and right.
    Film,
}

/// Where a part can be grasped: anywhere on a line, which is upright, level or as short as a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Handle {
    /// The part.
    pub part: Part,
    /// The ends of the line, the left or upper one first.
    pub line: [Point; 2],
}

impl Handle {
    /// The point of the line that is nearest to a place.
    pub fn nearest(&self, place: Point) -> Point {
        let [from, to] = self.line;
        [0, 1].map(|axis| place[axis].clamp(from[axis], to[axis]))
    }

    /// How far a place is from the line.
    pub fn distance(&self, place: Point) -> f32 {
        let [x, y] = self.nearest(place);
        (place[0] - x).hypot(place[1] - y)
    }
}

/// What can be moved in a section that is drawn between these heights. Where two parts lie on each other, the first one
/// in the list is meant.
pub(super) fn handles(
    diagram: &Diagram,
    look: &Look<'_>,
    scale: &Scale,
    [top, bottom]: [f32; 2],
) -> Vec<Handle> {
    let upright = |part, x: f32| Handle { part, line: [[x, top], [x, bottom]] };
    let point = diagram.hit.map(|hit| Handle { part: Part::Point, line: [scale.place(hit); 2] });
    let [x, y] = scale.lens;
    let half = (diagram.half_aperture[usize::from(!look.above())] * scale.fan) as f32;
    let rims =
        [y - half, y + half].map(|y| Handle { part: Part::Rim, line: [[x - GLASS, y], [x + GLASS, y]] });
    let has_rim = diagram.model != CameraModel::Pinhole;
    let plane = diagram.focus.map(|(depth, _)| upright(Part::FocalPlane, scale.x(depth)));
    let film = upright(Part::Film, scale.x(-diagram.image.film_distance));
    let rims = rims.into_iter().filter(|_| has_rim);
    point
        .into_iter()
        .chain(rims)
        .chain(plane)
        .chain([film].into_iter().filter(|_| diagram.film_is_free))
        .collect()
}
