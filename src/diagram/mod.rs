//! The drawing of the optics: film, lens, focal plane and object from left to right, with the rays of one pixel.
//!
//! [`Diagram`] holds the points and lines, in scene units. [`draw`] makes a [`Drawing`] of it: lines, areas and text,
//! each in its place on a sheet. The viewer paints that sheet, and [`svg`] writes it to a file, so the two are the same.

mod book;
mod border;
mod film;
mod handle;
mod outline;
mod paths;
mod section;
mod sheet;
mod svg;
mod view;
mod words;

pub use handle::{Handle, Part};
pub use outline::Outline;
pub use paths::{Diagram, ImageSide, Line, Side};
pub use section::Scale;
pub use sheet::{Anchor, LETTERS, Pane, Point, Role, Shape, text_width};
pub use svg::svg;
pub use view::{VIEWS, View, ViewEntry};
pub use words::{depth, millimetres, sentence};

use crate::renderer::Excerpt;
use crate::scene::CameraModel;
use crate::settings::Settings;
use sheet::{LINE, MARGIN, wrapped};

/// The share of the width that the picture of the film takes, if it does not become higher than wide.
const FILM_SHARE: f32 = 0.3;
/// The share that it takes if the rendered picture stands beside it, with the same share.
const FILM_SHARE_OF_TWO: f32 = 0.21;

/// The section shows the light of at most so many further points.
pub const KEPT: usize = 2;

/// How the optics are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look<'a> {
    /// Width and height of the drawing.
    pub size: [f32; 2],
    /// What is drawn.
    pub view: View,
    /// Whether a section has the same scale for depths and heights on both sides of the lens.
    pub to_scale: bool,
    /// The depths between which everything is sharp, if they are to be shown.
    pub sharp: Option<[f64; 2]>,
    /// The depths of further points on the same ray whose light the section shows too.
    pub kept: [Option<f64>; KEPT],
    /// The rendered picture around the pixel, if the section is to show it.
    pub picture: Option<&'a Excerpt>,
    /// A scale to keep, while a part of the drawing is moved. Otherwise the drawing fills its place.
    pub scale: Option<Scale>,
}

impl Look<'_> {
    /// Whether right is down, and not up.
    fn above(&self) -> bool {
        self.view == View::Above
    }
}

/// The whole drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height.
    pub size: [f32; 2],
    /// Its parts. Together they cover it, and none covers another one.
    pub panes: Vec<Pane>,
    /// Where the section draws which point. The other views are not magnified.
    pub scale: Option<Scale>,
    /// What can be moved by hand.
    pub handles: Vec<Handle>,
    /// How far from the pixel the picture is shown, in pixels.
    pub reach: u32,
    /// The place of the pixel in the rendered picture: two corners.
    pub middle_pixel: Option<[Point; 2]>,
}

/// The depths between which everything is sharp, for a lens.
pub fn sharp_depths(settings: &Settings) -> Option<[f64; 2]> {
    let estimator = &settings.estimator;
    let has_lens = estimator.model == CameraModel::ThinLens && estimator.lens.diameter > 0.0;
    has_lens.then(|| settings.depth_of_field())
}

/// Draws the optics, and below them a sentence that says what happens, or what the letters of the figure mean.
pub fn draw(diagram: &Diagram, look: &Look<'_>) -> Drawing {
    let size @ [width, height] = look.size.map(|extent| extent.max(1.0));
    let is_section = look.view.is_section();
    let text = if is_section { sentence(diagram) } else { book::caption(diagram, look.view) };
    let lines = wrapped(&text, width - 2.0 * MARGIN);
    let words_height = lines.len() as f32 * LINE + MARGIN;
    let bottom = (height - words_height).max(1.0);
    let mut drawing = if is_section {
        section(diagram, look, [width, bottom])
    } else {
        let panes = book::draw(diagram, look.view, [0.0; 2], [width, bottom]);
        Drawing { size, panes, scale: None, handles: Vec::new(), reach: 0, middle_pixel: None }
    };
    let mut words = Pane::new([0.0, bottom], size);
    words.rectangle(words.min, words.max, Role::Paper);
    words.line(words.min, [width, bottom], Role::Frame, 1.0);
    for (number, line) in (0_u8..).zip(lines) {
        let y = bottom + 0.5 * MARGIN + (f32::from(number) + 0.5) * LINE;
        words.text([MARGIN, y], Anchor::Start, Role::Text, line);
    }
    drawing.panes.push(words);
    Drawing { size, ..drawing }
}

/// Draws the section on the left, and on the right the circle of confusion and the rendered picture.
fn section(diagram: &Diagram, look: &Look<'_>, size @ [width, bottom]: Point) -> Drawing {
    let (share, count) = if look.picture.is_some() { (FILM_SHARE_OF_TWO, 2.0) } else { (FILM_SHARE, 1.0) };
    let side = bottom.min(share * width).ceil();
    let film_left = (width - count * side).max(0.0);
    let others: Vec<Diagram> =
        look.kept.into_iter().flatten().map(|depth| diagram.with_point_at(depth)).collect();
    let ([above, section, below], scale) = section::draw(diagram, &others, look, [film_left, bottom]);
    let handles = handle::handles(diagram, look, &scale, &section);
    let mut film = film::draw(diagram, &others, [film_left, 0.0], [film_left + side, bottom]);
    film.line([film_left, 0.0], [film_left, bottom], Role::Frame, 1.0);
    let shown = film::shown(diagram, &others);
    let mut drawing = Drawing {
        size,
        panes: vec![above, section, below, film],
        scale: Some(scale),
        handles,
        reach: (0.5 * shown + 0.5).ceil() as u32,
        middle_pixel: None,
    };
    if let Some(picture) = look.picture {
        let (pane, middle) = film::draw_picture(picture, shown, [film_left + side, 0.0], size);
        drawing.panes.push(pane);
        drawing.middle_pixel = middle;
    }
    drawing
}
