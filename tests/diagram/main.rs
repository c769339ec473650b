//! The drawing of the optics: its points and lines against the equations, on the device's own rays.

#[path = "../common/mod.rs"]
mod common;

mod book;
mod parts;
mod rays;
mod texts;

use anyhow::Result;
use common::Gpu;
use glam::DVec3;
use thinlens::diagram::{Diagram, Drawing, KEPT, Line, Look, Point, Role, Shape, View};
use thinlens::renderer::Question;
use thinlens::settings::Settings;

const RAYS: u32 = 9;

fn drawn(gpu: &Gpu, settings: &Settings, position: [f32; 2]) -> Result<Diagram> {
    let picked =
        gpu.renderer(settings).pick(Question { position, fan: RAYS, samples: RAYS })?.expect("an answer");
    Ok(Diagram::new(&settings.estimator, &picked))
}

/// Where a line is at a depth.
fn at([from, to]: Line, depth: f64) -> DVec3 {
    from + (to - from) * ((depth - from.z) / (to - from).z)
}

/// A film position on the view plane at depth one, by the picture's edges: right, up, forward.
fn slope(settings: &Settings, [x, y]: [f32; 2]) -> DVec3 {
    let [width, height] = settings.estimator.size.map(f64::from);
    let half = (0.5 * settings.estimator.camera.vfov_radians).tan();
    let up = half * (1.0 - 2.0 * f64::from(y) / height);
    DVec3::new(half * (2.0 * f64::from(x) - width) / height, up, 1.0)
}

const LOOK: Look<'_> = Look {
    size: [1100.0, 420.0],
    view: View::Side,
    to_scale: false,
    sharp: Some([8.0, 12.0]),
    kept: [None; KEPT],
    picture: None,
    scale: None,
};

fn shapes(drawing: &Drawing) -> impl Iterator<Item = &Shape> {
    drawing.panes.iter().flat_map(|pane| &pane.shapes)
}

/// The drawn lines that stand for something.
fn lines(drawing: &Drawing, of: Role) -> Vec<&[Point]> {
    let points = shapes(drawing).filter_map(|shape| match shape {
        Shape::Line { points, role, .. } if *role == of => Some(&points[..]),
        _ => None,
    });
    points.collect()
}

/// The drawn areas that stand for something.
fn areas(drawing: &Drawing, of: Role) -> Vec<&[Point]> {
    let corners = shapes(drawing).filter_map(|shape| match shape {
        Shape::Area { corners, role } if *role == of => Some(&corners[..]),
        _ => None,
    });
    corners.collect()
}

/// The drawn dots that stand for something.
fn dots(drawing: &Drawing, of: Role) -> Vec<Point> {
    let places = shapes(drawing).filter_map(|shape| match shape {
        Shape::Dot { at, role, .. } if *role == of => Some(*at),
        _ => None,
    });
    places.collect()
}

/// The smallest and the largest value.
fn range(values: impl Iterator<Item = f32>) -> [f32; 2] {
    values.fold([f32::MAX, f32::MIN], |[low, high], value| [low.min(value), high.max(value)])
}

fn texts(drawing: &Drawing) -> Vec<&str> {
    let text = shapes(drawing).filter_map(|shape| match shape {
        Shape::Text { text, .. } => Some(text.as_str()),
        _ => None,
    });
    text.collect()
}

/// The number before `unit` in the one text of the drawing that contains `start`.
fn number(drawing: &Drawing, start: &str, unit: &str) -> f64 {
    let text =
        texts(drawing).into_iter().find(|text| text.contains(start)).unwrap_or_else(|| panic!("no {start}"));
    let rest = text.split_once(start).expect("it is there").1;
    let number = rest.split_once(unit).unwrap_or_else(|| panic!("no {unit} in {text}")).0;
    number.trim().parse().unwrap_or_else(|_| panic!("no number in {text}"))
}

/// Where a drawn line, or its extension, is at a horizontal place.
fn height([from, to]: [Point; 2], x: f32) -> f32 {
    from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0])
}
