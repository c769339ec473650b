//! The parts of the drawing that can be moved by hand.

use super::section::{GLASS, Scale};
use super::sheet::{Pane, Point};
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

/// Where a part can be grasped: anywhere on a line, which may be as short as a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Handle {
    /// The part.
    pub part: Part,
    /// The ends of the line.
    pub line: [Point; 2],
}

impl Handle {
    /// The point of the line that is nearest to a place.
    pub fn nearest(&self, place: Point) -> Point {
        let [from, to] = self.line;
        let way = [0, 1].map(|axis| to[axis] - from[axis]);
        let along: f32 = (0..2).map(|axis| (place[axis] - from[axis]) * way[axis]).sum();
        let length_squared = way[0] * way[0] + way[1] * way[1];
        let share = (along / length_squared.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        [0, 1].map(|axis| from[axis] + share * way[axis])
    }

    /// How far a place is from the line.
    pub fn distance(&self, place: Point) -> f32 {
        let [x, y] = self.nearest(place);
        (place[0] - x).hypot(place[1] - y)
    }
}

/// What can be moved in a section. Where two parts lie on each other, the first one in the list is meant.
pub(super) fn handles(diagram: &Diagram, look: &Look<'_>, scale: &Scale, section: &Pane) -> Vec<Handle> {
    let handle = |part, line| Handle { part, line };
    let point = diagram.hit.map(|hit| handle(Part::Point, [scale.place(hit); 2]));
    let rims = diagram.rims(look.above()).map(|rim| {
        let [x, y] = scale.place(rim);
        handle(Part::Rim, [[x - GLASS, y], [x + GLASS, y]])
    });
    let has_rim = diagram.model != CameraModel::Pinhole;
    let plane = scale.focal_plane(diagram, section).map(|line| handle(Part::FocalPlane, line));
    let film = scale.x(-diagram.image.film_distance);
    let film = handle(Part::Film, [[film, section.min[1]], [film, section.max[1]]]);
    let rims = rims.into_iter().filter(|_| has_rim);
    point
        .into_iter()
        .chain(rims)
        .chain(plane)
        .chain([film].into_iter().filter(|_| diagram.film_is_free))
        .collect()
}
