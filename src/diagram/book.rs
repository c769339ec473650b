//! The figures of K. Suffern, *Ray Tracing from the Ground Up*, chapter 10, with their letters, for one pixel: to scale,
//! except that the opening is drawn larger where it would be too small.

use super::border::Border;
use super::film;
use super::sheet::{LINE, MARGIN, Name, Pane, Point, Role};
use super::words::digits;
use super::{Diagram, Line, View};
use crate::scene::CameraModel;
use glam::DVec3;
use std::f64::consts::TAU;

/// The rim of the opening is drawn with so many corners.
const RIM: u32 = 96;
/// The opening is at least this share as high as the picture on the view plane, in the figures in front of it.
const OPENING_SHARE: f64 = 0.45;
/// How far to the left and down what lies nearer to the eye is drawn in the layout.
const NEARER: f64 = 0.32;
/// The width of a dot.
const DOT: f32 = 7.0;
/// The share of the width of the figure of the circle of confusion that the film from the front takes.
const FILM_SHARE: f32 = 0.3;

/// A rectangle of the sheet in which everything has the same scale.
struct Paper {
    pane: Pane,
    /// The names of places, which are written when everything is drawn.
    names: Vec<(Point, Role, &'static str)>,
    /// How many lines of distances there are below the figure.
    distances: u8,
    /// Whether there is hardly room for the figure.
    is_low: bool,
    /// What lies in the middle of the rectangle.
    middle: [f64; 2],
    /// The length on the sheet of a scene unit.
    scale: f64,
}

impl Paper {
    /// Shows these points as large as possible, below a line of names and above so many lines of distances.
    fn new(min: Point, max: Point, distances: u8, points: impl Iterator<Item = [f64; 2]>) -> Self {
        let mut pane = Pane::new(min, max);
        pane.rectangle(pane.min, pane.max, Role::Paper);
        let nothing = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let bounds = points.fold(nothing, |bounds, point| {
            [0, 1].map(|axis| [bounds[axis][0].min(point[axis]), bounds[axis][1].max(point[axis])])
        });
        let margins = [2.0 * MARGIN, (1.0 + f32::from(distances)) * LINE + 2.0 * MARGIN];
        let scales = [0, 1].map(|axis| {
            let room = (pane.max[axis] - pane.min[axis] - margins[axis]).max(1.0);
            f64::from(room) / (bounds[axis][1] - bounds[axis][0]).max(1e-12)
        });
        let middle = bounds.map(|[low, high]| 0.5 * (low + high));
        let is_low = pane.max[1] - pane.min[1] < margins[1] + DOT;
        Self { pane, names: Vec::new(), distances, is_low, middle, scale: scales[0].min(scales[1]) }
    }

    fn place(&self, point: [f64; 2]) -> Point {
        let (min, max) = (self.pane.min, self.pane.max);
        let below = f32::from(self.distances) * LINE;
        let middle = [0.5 * (min[0] + max[0]), 0.5 * (min[1] + LINE + max[1] - below)];
        let [x, y] = [0, 1].map(|axis| ((point[axis] - self.middle[axis]) * self.scale) as f32);
        [middle[0] + x, middle[1] - y]
    }

    /// What is shown at a place of the sheet.
    fn shown_at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top] = self.place(self.middle).map(f64::from);
        [self.middle[0] + (x - left) / self.scale, self.middle[1] - (y - top) / self.scale]
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2], role: Role, width: f32) {
        self.pane.line(self.place(from), self.place(to), role, width);
    }

    fn dashed(&mut self, from: [f64; 2], to: [f64; 2], role: Role) {
        self.pane.dashed(self.place(from), self.place(to), role);
    }

    fn outline(&mut self, points: impl Iterator<Item = [f64; 2]>, role: Role) {
        let points = points.map(|point| self.place(point)).collect();
        self.pane.outline(points, role, 1.5);
    }

    fn dot(&mut self, at: [f64; 2], role: Role, name: &'static str) {
        let at = self.place(at);
        self.pane.dot(at, 0.5 * DOT, role);
        self.names.push((at, role, name));
    }

    /// The finished figure.
    fn finish(mut self) -> Pane {
        for (at, role, name) in self.names {
            self.pane.name(at, role, name);
        }
        self.pane
    }

    /// The height of the line of names above the figure.
    fn head(&self) -> f32 {
        self.pane.min[1] + 0.5 * (MARGIN + LINE)
    }

    /// Names things in a line, each near its place.
    fn row(&mut self, y: f32, names: &[([f64; 2], Role, &str)]) {
        // In a very low strip, the figure itself takes this line.
        if self.is_low {
            return;
        }
        let names = names.iter().map(|(at, role, name)| Name::new(self.place(*at)[0], *role, [*name]));
        self.pane.row(y, names.collect());
    }

    /// Shows a distance from the lens in a line of the lower edge.
    fn distance(&mut self, number: u8, depth: f64, role: Role, name: &'static str) {
        let y = self.pane.max[1] - (f32::from(number) + 0.5) * LINE;
        let [from, to] = [0.0, depth].map(|depth| self.place([depth, 0.0])[0]);
        for x in [from, to] {
            self.pane.line([x, y - 4.0], [x, y + 4.0], role, 1.0);
        }
        self.pane.line([from, y], [to, y], role, 1.0);
        self.names.push(([from.max(to), y], role, name));
    }
}

/// What is drawn in front of the lens, with its opening as large as it is drawn.
struct Front<'a> {
    diagram: &'a Diagram,
    larger: f64,
}

impl<'a> Front<'a> {
    fn new(diagram: &'a Diagram) -> Self {
        let widest = diagram.half_aperture[0].max(diagram.half_aperture[1]);
        let larger = OPENING_SHARE * diagram.half_picture[1] / widest.max(f64::MIN_POSITIVE);
        Self { diagram, larger: if widest > 0.0 { larger.max(1.0) } else { 1.0 } }
    }

    /// Where a ray is at a depth, if it starts on the larger opening.
    fn at(&self, ray: &Line, depth: f64) -> DVec3 {
        let [from, to] = *ray;
        if let Some((_, p)) = self.diagram.focus.filter(|(depth, _)| *depth > 0.0 && self.diagram.is_tilted())
        {
            let start = self.start(ray);
            return start + (p - start) * ((depth - start.z) / (p.z - start.z));
        }
        let on_ray = from + (to - from) * ((depth - from.z) / (to.z - from.z).max(1e-12));
        let centre = self.diagram.slope * depth;
        centre + self.larger * (on_ray - centre)
    }

    /// Where a ray starts on the larger opening.
    fn start(&self, ray: &Line) -> DVec3 {
        self.larger * ray[0]
    }

    /// The second of the two rays: it starts at the top of the opening.
    fn primary(&self) -> Line {
        *self.diagram.fan_up.last().unwrap_or(&self.diagram.centre)
    }

    fn half_aperture(&self) -> [f64; 2] {
        self.diagram.half_aperture.map(|half| self.larger * half)
    }

    /// The rim of the opening.
    fn rim(&self) -> impl Iterator<Item = DVec3> {
        let [width, height] = self.half_aperture();
        (0..RIM).map(move |corner| {
            let (sin, cos) = (TAU * f64::from(corner) / f64::from(RIM)).sin_cos();
            let [x, y] = [width * cos, height * sin];
            // A tilted opening is perpendicular to its axis.
            let (tilt, axis) = (self.diagram.plane.tilt, self.diagram.plane.lens_axis());
            let depth = if self.diagram.is_tilted() { (tilt.x * x + tilt.y * y) / axis.z } else { 0.0 };
            DVec3::new(x, y, depth)
        })
    }

    /// The corners of the picture on a plane.
    fn picture(&self, depth: f64) -> [DVec3; 4] {
        let [x, y] = self.diagram.half_picture.map(|half| half * depth / self.diagram.view_plane);
        [[-x, y], [x, y], [x, -y], [-x, -y]].map(|[x, y]| DVec3::new(x, y, depth))
    }

    /// The depth at which the rays end: the focal plane or, without a lens, what is seen.
    fn end(&self) -> f64 {
        let hit = self.diagram.hit.map_or(self.diagram.reach, |hit| hit.z);
        let focus = self.diagram.focus.map(|(depth, _)| depth);
        focus.filter(|depth| *depth > 0.0 && depth.is_finite()).unwrap_or(hit)
    }

    /// The corners of what the picture shows of the focal plane or, without a lens, of an upright plane. If a tilted focal
    /// plane leads too far, this is a smaller part of it.
    fn far_picture(&self) -> [DVec3; 4] {
        let end = self.end();
        let upright = self.picture(end);
        if !self.diagram.is_tilted() {
            return upright;
        }
        let (plane, middle) = (self.diagram.plane, self.diagram.slope.truncate());
        let part = |share: f64| {
            upright.map(|corner| {
                let slope = middle + share * (corner.truncate() / end - middle);
                slope.extend(1.0) / plane.inverse_depth(slope)
            })
        };
        let parts = [1.0, 0.5, 0.25, 0.12, 0.06, 0.03].map(part);
        let is_near = |corner: &DVec3| corner.z > 0.4 * end && corner.z < 2.5 * end;
        parts.into_iter().find(|part| part.iter().all(is_near)).unwrap_or(upright)
    }

    fn opening(&self) -> &'static str {
        if self.diagram.model == CameraModel::Hole { "hole" } else { "lens" }
    }
}

/// Draws a figure in this rectangle of the sheet.
pub(super) fn draw(diagram: &Diagram, view: View, min: Point, max: Point) -> Vec<Pane> {
    let front = Front::new(diagram);
    match view {
        View::Layout => vec![layout(&front, min, max)],
        View::TwoRays => vec![two_rays(&front, min, max)],
        View::CircleOfConfusion => {
            let edge = (max[0] - (max[1] - min[1]).min(FILM_SHARE * (max[0] - min[0]))).floor();
            let mut film = film::draw(diagram, &[], [edge, min[1]], max);
            film.line([edge, min[1]], [edge, max[1]], Role::Frame, 1.0);
            vec![circle_of_confusion(diagram, min, [edge, max[1]]), film]
        }
        _ => vec![cross_section(&front, min, max)],
    }
}

/// What the letters of a figure mean.
pub(super) fn caption(diagram: &Diagram, view: View) -> String {
    let front = Front::new(diagram);
    let opening = front.opening();
    let larger = match front.larger {
        larger if larger > 1.0 && view != View::CircleOfConfusion => {
            format!(" The {opening} is drawn {} times as wide as it is.", digits(larger, 2))
        }
        _ => String::new(),
    };
    let meets = match diagram.focus {
        Some(_) => "both meet at p on the focal plane, at the distance f",
        None => "without a lens, they do not meet",
    };
    let text = match view {
        View::Layout => format!(
            "The centre ray goes from the middle of the {opening} through q on the view plane, at the distance d. A primary \
             ray starts at l on the rim; {meets}."
        ),
        View::TwoRays => format!(
            "The (viewX, viewY) plane from behind the camera: the centre ray goes through it at q, and the primary ray from \
             l at r; {meets}."
        ),
        View::CircleOfConfusion => format!(
            "Behind the {opening}, to scale: light of the point that is seen is spread over the circle of confusion c \
             around p', where the centre ray ends. v is the distance of the film{}.",
            if diagram.image.crossing.is_some() { ", and i is where the light meets" } else { "" }
        ),
        _ => format!(
            "The centre ray goes from the middle of the {opening} through q on the view plane, at the distance d. Primary \
             rays start all over the {opening}; {}. h is what the centre ray hits.",
            meets.replace("both meet", "all meet")
        ),
    };
    let tilted = if diagram.is_tilted() && view != View::CircleOfConfusion {
        " The lens is tilted, and the focal plane with it."
    } else {
        ""
    };
    format!("{text}{larger}{tilted}")
}

fn side(point: DVec3) -> [f64; 2] {
    [point.z, point.y]
}

fn cross_section(front: &Front<'_>, min: Point, max: Point) -> Pane {
    let diagram = front.diagram;
    let (d, reach) = (diagram.view_plane, diagram.reach);
    let [_, half_picture] = diagram.half_picture;
    let [_, half] = front.half_aperture();
    let rays: Vec<[DVec3; 2]> =
        diagram.fan_up.iter().map(|ray| [front.start(ray), front.at(ray, reach)]).collect();
    let axis = [[-0.03 * reach, 0.0], [reach, 0.0]];
    let shown = [[d, half_picture], [d, -half_picture], [0.0, half], [0.0, -half]];
    let marks = diagram.focus.map(|(_, p)| p).into_iter().chain(diagram.hit);
    let marks = marks.filter(|point| point.z > 0.0 && point.z <= reach);
    let ends = rays.iter().flatten().copied().chain(marks).map(side);
    let mut paper = Paper::new(min, max, 2, axis.into_iter().chain(shown).chain(ends));
    paper.line(axis[0], axis[1], Role::Frame, 1.0);
    paper.line([d, half_picture], [d, -half_picture], Role::Faint, 2.0);
    let focus_role = Role::Focus;
    let mut names = vec![([0.0; 2], Role::Glass, front.opening()), ([d, 0.0], Role::Faint, "view plane")];
    if let Some((f, _)) = diagram.focus {
        let (top, bottom) = (paper.pane.min[1] + LINE + MARGIN, paper.pane.max[1] - 2.0 * LINE);
        let [in_depth, in_height] = diagram.cut_of_plane(false, diagram.plane.inverse_distance);
        let border = Border::new(|place| {
            let [depth, height] = paper.shown_at(place);
            in_depth * depth + in_height * height - 1.0
        });
        let lens = paper.place([0.0; 2])[0];
        if let Some([from, to]) = border.within([lens, top], [paper.pane.max[0], bottom]) {
            paper.pane.line(from, to, focus_role, 2.0);
        }
        names.push(([f, 0.0], focus_role, "focal plane"));
    }
    for [from, to] in &rays {
        paper.line(side(*from), side(*to), Role::Ray, 1.0);
    }
    paper.dashed([0.0; 2], side(diagram.slope * reach), Role::Centre);
    let [lower, upper] = diagram.rims(false).map(|rim| side(front.larger * rim));
    paper.line(upper, lower, Role::Glass, 4.0);
    paper.row(paper.head(), &names);
    paper.dot(side(diagram.q), Role::Text, "q");
    if let Some((f, p)) = diagram.focus.filter(|(depth, _)| *depth > 0.0) {
        paper.dot(side(p), focus_role, "p");
        paper.distance(0, f, focus_role, "f");
    }
    if let Some(hit) = diagram.hit {
        paper.dot(side(hit), Role::Light, "h");
    }
    paper.distance(1, d, Role::Faint, "d");
    paper.finish()
}

fn layout(front: &Front<'_>, min: Point, max: Point) -> Pane {
    let diagram = front.diagram;
    // Seen from the right: what is farther to the right is nearer to the eye.
    let flat = |point: DVec3| [point.z - NEARER * point.x, point.y - NEARER * point.x];
    let (d, end) = (diagram.view_plane, front.end());
    let planes = [front.picture(d), front.far_picture()];
    let primary = front.primary();
    let l = front.start(&primary);
    let [r, p] = [d, end].map(|depth| front.at(&primary, depth));
    let shown = planes.iter().flatten().copied().chain(front.rim()).chain([l, r, p]);
    let mut paper = Paper::new(min, max, 0, shown.map(flat));
    for corner in planes[1] {
        paper.line([0.0; 2], flat(corner), Role::Frame, 1.0);
    }
    let far = if diagram.focus.is_some() { Role::Focus } else { Role::Light };
    paper.outline(planes[1].into_iter().map(flat), far);
    paper.dashed([0.0; 2], flat(diagram.slope * end), Role::Centre);
    paper.line(flat(l), flat(p), Role::Primary, 2.0);
    paper.outline(planes[0].into_iter().map(flat), Role::Faint);
    for [from, to] in view_axes(diagram) {
        paper.line(flat(from), flat(to), Role::Grid, 1.0);
    }
    paper.outline(front.rim().map(flat), Role::Glass);
    let far_name = if diagram.focus.is_some() { "focal plane" } else { "what is seen" };
    let names = [
        ([0.0; 2], Role::Glass, front.opening()),
        (flat(DVec3::new(0.0, 0.0, d)), Role::Faint, "view plane"),
        (flat(DVec3::new(0.0, 0.0, end)), far, far_name),
    ];
    paper.row(paper.head(), &names);
    paper.dot(flat(l), Role::Glass, "l");
    paper.dot(flat(diagram.q), Role::Text, "q");
    paper.dot(flat(r), Role::Primary, "r");
    let name = if diagram.focus.is_some() { "p" } else { "h" };
    paper.dot(flat(diagram.slope * end), far, name);
    paper.finish()
}

/// The axes of the view plane.
fn view_axes(diagram: &Diagram) -> [Line; 2] {
    let ([x, y], d) = (diagram.half_picture, diagram.view_plane);
    [DVec3::new(x, 0.0, 0.0), DVec3::new(0.0, y, 0.0)].map(|half| [d * DVec3::Z - half, d * DVec3::Z + half])
}

fn two_rays(front: &Front<'_>, min: Point, max: Point) -> Pane {
    let diagram = front.diagram;
    let flat = |point: DVec3| [point.x, point.y];
    let d = diagram.view_plane;
    let primary = front.primary();
    let (l, r) = (front.start(&primary), front.at(&primary, d));
    let picture = front.picture(d);
    let mut paper = Paper::new(min, max, 0, picture.into_iter().chain(front.rim()).chain([l, r]).map(flat));
    paper.outline(picture.into_iter().map(flat), Role::Faint);
    for [from, to] in view_axes(diagram) {
        paper.line(flat(from), flat(to), Role::Grid, 1.0);
    }
    let names = [([0.0; 2], Role::Glass, front.opening()), (flat(picture[1]), Role::Faint, "view plane")];
    paper.row(paper.head(), &names);
    let rim: Vec<Point> = front.rim().map(|point| paper.place(flat(point))).collect();
    paper.pane.area(rim.clone(), Role::GlassInside);
    paper.pane.outline(rim, Role::Glass, 1.5);
    paper.dashed([0.0; 2], flat(diagram.q), Role::Centre);
    paper.line(flat(l), flat(r), Role::Primary, 2.0);
    paper.dot(flat(diagram.q), Role::Text, "q");
    paper.dot(flat(r), Role::Primary, "r");
    let [x_end, y_end] = view_axes(diagram).map(|[_, end]| paper.place(flat(end)));
    paper.names.extend([(x_end, Role::Faint, "viewX"), (y_end, Role::Faint, "viewY")]);
    // The opening has room for its letter where there is none for the others, so that it chooses last.
    paper.dot(flat(l), Role::Glass, "l");
    paper.finish()
}

fn circle_of_confusion(diagram: &Diagram, min: Point, max: Point) -> Pane {
    let image = &diagram.image;
    let v = image.film_distance;
    let [_, half] = diagram.half_aperture;
    let end = image.light_up.first().map_or(-1.08 * v, |line| line[1].z);
    let axis = [[1.04 * end, 0.0], [0.04 * v, 0.0]];
    let ends = image.light_up.iter().flatten().copied().chain([image.p]).map(side);
    let shown = axis.into_iter().chain([[0.0, half], [0.0, -half]]).chain(ends);
    let mut paper = Paper::new(min, max, 1, shown);
    paper.line(axis[0], axis[1], Role::Frame, 1.0);
    let x = paper.place([-v, 0.0])[0];
    let (top, bottom) = (paper.pane.min[1] + LINE + MARGIN, paper.pane.max[1] - LINE);
    paper.pane.line([x, top], [x, bottom], Role::Film, 2.0);
    for [from, to] in &image.light_up {
        paper.line(side(*from), side(*to), Role::Light, 1.0);
    }
    paper.dashed([0.0; 2], side(image.p), Role::Centre);
    let [lower, upper] = diagram.rims(false).map(side);
    paper.line(upper, lower, Role::Glass, 4.0);
    let falls = diagram.falls(false).map(side);
    paper.line(falls[0], falls[1], Role::Blur, 4.0);
    let opening = if diagram.model == CameraModel::Hole { "hole" } else { "lens" };
    paper.row(paper.head(), &[([-v, 0.0], Role::Film, "film"), ([0.0; 2], Role::Glass, opening)]);
    paper.dot(side(image.p), Role::Film, "p'");
    let lowest = if falls[0][1] < falls[1][1] { falls[0] } else { falls[1] };
    let rim = paper.place(lowest);
    paper.names.push((rim, Role::Blur, "c"));
    if let Some(crossing) = image.crossing.filter(|crossing| -crossing > 1.04 * end) {
        paper.dot(side(-crossing * diagram.slope), Role::Blur, "i");
    }
    paper.distance(0, -v, Role::Faint, "v");
    paper.finish()
}
