//! What a drawing consists of: lines, areas and text, whose colours follow from what they stand for.

use super::Diagram;
use super::paths::Side;
use crate::scene::Overlay;
use crate::settings::to_srgb;
use ab_glyph::{Font, FontRef, PxScale, ScaleFont};
use std::sync::LazyLock;

/// A place on the sheet: to the right and down from its upper left corner.
pub type Point = [f32; 2];

/// The size of the letters.
pub const LETTERS: f32 = 16.0;
/// The height of a line of text.
pub(super) const LINE: f32 = 20.0;
/// The space between the edge of the sheet and a text.
pub(super) const MARGIN: f32 = 8.0;
/// The space between a dot and its name.
const NEAR: f32 = 6.0;
/// The space between two texts of a row.
const APART: f32 = 14.0;

/// The font of the drawing, which is that of the viewer.
static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).expect("the font is a part of the program")
});

/// What a part of the drawing stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Role {
    /// The background.
    Paper,
    /// The edge of the background, and the optical axis.
    Frame,
    /// Text and lines that explain.
    Faint,
    /// Text.
    Text,
    /// The film.
    Film,
    /// The rim of the lens or the hole.
    Glass,
    /// The inside of the lens.
    GlassInside,
    /// The focal plane.
    Focus,
    /// The depths that are sharp.
    Sharp,
    /// The name of the depths that are sharp.
    SharpName,
    /// The rays that the renderer traces.
    Ray,
    /// The one of these rays that a figure follows.
    Primary,
    /// The light of the object.
    Light,
    /// The light of a point, in the colour of the overlay that shows the circle of confusion.
    LightOf(Side),
    /// The ray through the centre of the lens.
    Centre,
    /// The circle of confusion, and the place where light meets.
    Blur,
    /// The inside of the circle of confusion, with this share of the light.
    BlurInside(f32),
    /// The pixel that is looked at.
    Pixel,
    /// The edges of the pixels.
    Grid,
    /// A pixel of the rendered picture, in its colour.
    Shown([u8; 3]),
    /// The outline of an object of this colour.
    Object([f32; 3]),
    /// The inside of an object of this colour.
    ObjectInside([f32; 3]),
}

impl Role {
    /// Red, green and blue in sRGB, and the opacity.
    pub fn color(self) -> [f32; 4] {
        match self {
            Self::Paper => [0.05, 0.05, 0.05, 1.0],
            Self::Frame => [0.33, 0.33, 0.33, 1.0],
            Self::Faint => [0.65, 0.65, 0.65, 1.0],
            Self::Text => [0.88, 0.88, 0.88, 1.0],
            Self::Film => [0.82, 0.82, 0.82, 1.0],
            Self::Glass => [0.45, 0.75, 1.0, 1.0],
            Self::GlassInside => [0.45, 0.75, 1.0, 0.20],
            Self::Focus => [1.0, 0.66, 0.15, 1.0],
            Self::Sharp => [0.35, 0.85, 0.40, 0.22],
            Self::SharpName => [0.50, 0.88, 0.52, 1.0],
            Self::Ray => [1.0, 0.93, 0.55, 0.35],
            Self::Primary => [1.0, 0.93, 0.55, 1.0],
            Self::Light => [0.45, 0.85, 0.90, 0.85],
            Self::LightOf(side) => {
                let colors = Overlay::CircleOfConfusion.entry().colors;
                let number = match side {
                    Side::InFront => 0,
                    Side::InFocus => 1,
                    Side::Behind => 2,
                };
                let [red, green, blue] = colors[number].map(|level| to_srgb(level.into()) as f32);
                // Names have this colour too, and a translucent blue is hard to read on the dark paper.
                [red, green, blue, 1.0]
            }
            Self::Centre => [1.0, 1.0, 1.0, 0.80],
            Self::Blur => [1.0, 0.42, 0.47, 1.0],
            Self::BlurInside(light) => [1.0, 0.36, 0.42, 0.60 * light.clamp(0.0, 1.0)],
            Self::Pixel => [1.0, 1.0, 1.0, 0.16],
            Self::Grid => [0.48, 0.48, 0.48, 0.55],
            Self::Shown(color) => {
                let [red, green, blue] = color.map(|level| f32::from(level) / 255.0);
                [red, green, blue, 1.0]
            }
            Self::Object([red, green, blue]) => [red, green, blue, 0.9],
            Self::ObjectInside([red, green, blue]) => [red, green, blue, 0.25],
        }
    }
}

/// Which part of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

impl Anchor {
    /// The left end of a text of this width.
    pub fn left(self, x: f32, width: f32) -> f32 {
        match self {
            Self::Start => x,
            Self::Middle => x - 0.5 * width,
            Self::End => x - width,
        }
    }
}

/// A part of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through these points. The last one is joined to the first one if it is closed.
    Line {
        /// The points.
        points: Vec<Point>,
        /// What it stands for.
        role: Role,
        /// The width of the line.
        width: f32,
        /// Whether it ends where it began.
        closed: bool,
        /// Whether it has gaps.
        dashed: bool,
    },
    /// The inside of a convex polygon.
    Area {
        /// The corners.
        corners: Vec<Point>,
        /// What it stands for.
        role: Role,
    },
    /// The inside of a rectangle, with hard edges, so that nothing shows between two of them.
    Square {
        /// The upper left corner.
        min: Point,
        /// The lower right corner.
        max: Point,
        /// What it stands for.
        role: Role,
    },
    /// A dot.
    Dot {
        /// Its middle.
        at: Point,
        /// Its radius.
        radius: f32,
        /// What it stands for.
        role: Role,
    },
    /// A line of text.
    Text {
        /// The place of the anchor, half-way up.
        at: Point,
        /// Which part of the text is there.
        anchor: Anchor,
        /// What it stands for.
        role: Role,
        /// The text.
        text: String,
    },
}

/// A rectangle of the sheet, whose shapes are cut off at its edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Pane {
    /// The upper left corner.
    pub min: Point,
    /// The lower right corner.
    pub max: Point,
    /// Its shapes, the lowest one first.
    pub shapes: Vec<Shape>,
}

/// A name in a row of names.
pub(super) struct Name {
    /// The horizontal place of what it names.
    pub(super) x: f32,
    /// What it names.
    pub(super) role: Role,
    /// The whole name, and what is written where there is not room for it: each one shorter than the one before.
    pub(super) texts: Vec<String>,
}

impl Name {
    pub(super) fn new(x: f32, role: Role, texts: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { x, role, texts: texts.into_iter().map(Into::into).collect() }
    }
}

impl Pane {
    pub(super) fn new(min: Point, max: Point) -> Self {
        Self { min, max: [max[0].max(min[0] + 1.0), max[1].max(min[1] + 1.0)], shapes: Vec::new() }
    }

    pub(super) fn line(&mut self, from: Point, to: Point, role: Role, width: f32) {
        self.lines(vec![from, to], role, width);
    }

    pub(super) fn lines(&mut self, points: Vec<Point>, role: Role, width: f32) {
        self.shapes.push(Shape::Line { points, role, width, closed: false, dashed: false });
    }

    pub(super) fn dashed(&mut self, from: Point, to: Point, role: Role) {
        self.shapes.push(Shape::Line {
            points: vec![from, to],
            role,
            width: 1.5,
            closed: false,
            dashed: true,
        });
    }

    pub(super) fn outline(&mut self, points: Vec<Point>, role: Role, width: f32) {
        self.shapes.push(Shape::Line { points, role, width, closed: true, dashed: false });
    }

    pub(super) fn area(&mut self, corners: Vec<Point>, role: Role) {
        self.shapes.push(Shape::Area { corners, role });
    }

    pub(super) fn rectangle(&mut self, from: Point, to: Point, role: Role) {
        self.area(vec![from, [to[0], from[1]], to, [from[0], to[1]]], role);
    }

    pub(super) fn square(&mut self, min: Point, max: Point, role: Role) {
        self.shapes.push(Shape::Square { min, max, role });
    }

    pub(super) fn dot(&mut self, at: Point, radius: f32, role: Role) {
        self.shapes.push(Shape::Dot { at, radius, role });
    }

    pub(super) fn text(&mut self, at: Point, anchor: Anchor, role: Role, text: String) {
        self.shapes.push(Shape::Text { at, anchor, role, text });
    }

    /// Writes the name of a thing beside its place, where there is no other text and no dot. If possible, no line crosses it
    /// there, and no dot is nearer than the one that it names. Without a free place it is left out. What is drawn later may
    /// cover the name, so names come last.
    pub(super) fn name(&mut self, named @ [x, y]: Point, role: Role, name: &str) {
        let width = text_width(name);
        let places = [1.0, 1.5, 2.0].into_iter().flat_map(|times| {
            let (right, left, middle) = (x + times * NEAR, x - times * NEAR - width, x - 0.5 * width);
            let (up, down) = (y - 0.6 * times * LINE, y + 0.6 * times * LINE);
            [
                [right, up],
                [right, down],
                [left, up],
                [left, down],
                [right, y],
                [left, y],
                [middle, up],
                [middle, down],
            ]
        });
        let free: Vec<Point> = places.filter(|at| self.is_free(*at, width)).collect();
        let own = || free.iter().filter(|at| self.is_nearest(named, **at, width));
        let best = own().find(|at| !self.is_crossed(**at, width)).or(own().next()).or(free.first());
        if let Some(at) = best.copied() {
            self.text(at, Anchor::Start, role, name.to_owned());
        }
    }

    /// Whether no dot is nearer than this place to a text of this width that stands there.
    fn is_nearest(&self, named: Point, at: Point, width: f32) -> bool {
        let own = distance(named, at, width);
        let is_nearer =
            |shape: &Shape| matches!(shape, Shape::Dot { at: dot, .. } if distance(*dot, at, width) < own);
        !self.shapes.iter().any(is_nearer)
    }

    /// Whether a text of this width can stand there.
    fn is_free(&self, [left, y]: Point, width: f32) -> bool {
        let is_within = left >= self.min[0]
            && left + width <= self.max[0]
            && y - 0.5 * LINE >= self.min[1]
            && y + 0.5 * LINE <= self.max[1];
        let is_covered = self.shapes.iter().any(|shape| match shape {
            Shape::Text { at, anchor, text, .. } => {
                let other = anchor.left(at[0], text_width(text));
                left < other + text_width(text) && other < left + width && (y - at[1]).abs() < LETTERS
            }
            Shape::Dot { at, radius, .. } => distance(*at, [left, y], width) < *radius,
            _ => false,
        });
        is_within && !is_covered
    }

    /// Whether a line passes through a text of this width that stands there.
    fn is_crossed(&self, [left, y]: Point, width: f32) -> bool {
        let (min, max) = ([left, y - 0.5 * LETTERS], [left + width, y + 0.5 * LETTERS]);
        let crosses = |from: Point, to: Point| {
            // The part of the line that lies between the sides, and between top and bottom.
            let (mut begin, mut end) = (0.0_f32, 1.0_f32);
            for axis in 0..2 {
                let way = to[axis] - from[axis];
                let ends = [min[axis], max[axis]].map(|side| (side - from[axis]) / way);
                if way.abs() > 1e-6 {
                    begin = begin.max(ends[0].min(ends[1]));
                    end = end.min(ends[0].max(ends[1]));
                } else if from[axis] < min[axis] || from[axis] > max[axis] {
                    return false;
                }
            }
            begin <= end
        };
        self.shapes.iter().any(|shape| match shape {
            Shape::Line { points, closed, .. } => {
                let last = points.first().filter(|_| *closed).zip(points.last());
                points.windows(2).any(|pair| crosses(pair[0], pair[1]))
                    || last.is_some_and(|(first, last)| crosses(*last, *first))
            }
            _ => false,
        })
    }

    /// Writes names in a row, each as near as possible to its place, and none over another one. If there is not room
    /// for all of them, they are shortened, the first one in the list first. If that is not enough, the last ones are left
    /// out.
    pub(super) fn row(&mut self, y: f32, mut names: Vec<Name>) {
        let (left, right) = (self.min[0] + MARGIN, self.max[0] - MARGIN);
        let is_too_wide = |names: &[Name]| {
            let needed = names.iter().map(|name| text_width(&name.texts[0]) + APART).sum::<f32>() - APART;
            needed > right - left
        };
        while is_too_wide(&names) {
            // The one that has been shortened least: of several, the first one.
            match (0..names.len()).rev().max_by_key(|number| names[*number].texts.len()) {
                Some(number) if names[number].texts.len() > 1 => drop(names[number].texts.remove(0)),
                Some(_) => drop(names.pop()),
                None => return,
            }
        }
        names.sort_by(|a, b| a.x.total_cmp(&b.x));
        let mut starts = Vec::new();
        let mut free = left;
        for name in &names {
            let width = text_width(&name.texts[0]);
            let start = (name.x - 0.5 * width).max(free);
            starts.push(start);
            free = start + width + APART;
        }
        let mut end = right;
        for (name, start) in names.into_iter().zip(starts).rev() {
            let start = start.min(end - text_width(&name.texts[0]));
            end = start - APART;
            self.text([start, y], Anchor::Start, name.role, name.texts[0].clone());
        }
    }
}

/// How far a place is from a text of this width that begins at `left`.
fn distance([x, y]: Point, [left, middle]: Point, width: f32) -> f32 {
    let beside = (left - x).max(x - left - width).max(0.0);
    beside.hypot(((y - middle).abs() - 0.5 * LETTERS).max(0.0))
}

/// The width of a text in the font of the drawing.
pub fn text_width(text: &str) -> f32 {
    // The viewer's font has this height from the lowest to the highest letter.
    let font = FONT.as_scaled(PxScale::from(LETTERS));
    text.chars().map(|letter| font.h_advance(font.glyph_id(letter))).sum()
}

/// The text in lines of at most this width.
pub(super) fn wrapped(text: &str, width: f32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}")) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

impl Diagram {
    /// The colour of the light. If it is not the only light, its colour says where the point is.
    pub(super) fn light_role(&self, is_alone: bool) -> Role {
        self.side().filter(|_| !is_alone).map_or(Role::Light, Role::LightOf)
    }
}
