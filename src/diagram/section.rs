//! The section: film, lens, focal plane and object from left to right, cut along the centre ray.

use super::border::{Border, rectangle};
use super::sheet::{LINE, MARGIN, Name, Pane, Point, Role};
use super::words::{depth, digits, meeting, millimetres, pixels};
use super::{Diagram, Line, Look};
use crate::scene::CameraModel;
use glam::{DVec2, DVec3};

/// The share of the width that the side of the film takes, unless the drawing is to scale.
const FILM_SIDE: f64 = 0.38;
/// The share of the height that the fan of rays takes, unless the drawing is to scale.
const FAN_SHARE: f64 = 0.56;
/// The share of the height that the slope of the centre ray takes, unless the drawing is to scale.
const SLOPE_SHARE: f64 = 0.36;
/// The share of the side of the film that stays free behind it.
const BEHIND_FILM: f64 = 1.06;
/// A length on the sheet that nobody sees.
const UNSEEN: f64 = 0.02;
/// The thickness of the lens.
pub(super) const GLASS: f32 = 7.0;

/// Where the section draws which point. Behind the lens, depths may have another scale than in front of it. Heights are
/// measured from the centre ray, which has a scale of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// The place of the lens' centre.
    pub lens: Point,
    /// The length on the sheet of a scene unit of depth in front of the lens.
    pub in_front: f64,
    /// The length on the sheet of a scene unit of depth behind the lens.
    pub behind: f64,
    /// The length on the sheet of a scene unit of distance from the centre ray.
    pub fan: f64,
    /// The length on the sheet of a scene unit that the centre ray rises.
    pub rise: f64,
    /// The height that the centre ray rises in a unit of depth.
    slope: f64,
    /// Whether the section is seen from above.
    above: bool,
}

impl Scale {
    /// The same scale for another drawing.
    fn kept(self, diagram: &Diagram, look: &Look) -> Self {
        let kept = Self { above: look.above(), ..self };
        Self { slope: kept.aside(diagram.slope), ..kept }
    }

    /// Chooses the scale such that the drawing fills this rectangle.
    fn new(diagram: &Diagram, others: &[Diagram], look: &Look<'_>, min: Point, max: Point) -> Self {
        let [width, height] = [0, 1].map(|axis| f64::from((max[axis] - min[axis]).max(1.0)));
        let all = || others.iter().chain([diagram]);
        let front = all().map(|of| of.reach).fold(0.0, f64::max);
        let back = BEHIND_FILM * all().map(film_side_end).fold(0.0, f64::max);
        let mut scale = Self {
            lens: [0.0; 2],
            in_front: 1.0,
            behind: 1.0,
            fan: 1.0,
            rise: 1.0,
            slope: 0.0,
            above: look.above(),
        };
        scale.slope = scale.aside(diagram.slope);
        // How far the rays get from the centre ray, and the centre ray from the axis.
        let light = all().flat_map(|of| light(of, look.above()));
        let fans: Vec<Line> = light.chain(fan(diagram, look.above())).collect();
        let half_fan = fans.iter().flatten().map(|point| scale.off_centre(*point).abs()).fold(0.0, f64::max);
        let half_rise = scale.slope.abs() * front.max(back);
        if look.to_scale {
            let high = 2.0 * (half_rise + half_fan).max(1e-12);
            let all = (width / (front + back)).min(height / high);
            (scale.in_front, scale.behind, scale.fan, scale.rise) = (all, all, all, all);
        } else {
            scale.in_front = (1.0 - FILM_SIDE) * width / front;
            scale.behind = FILM_SIDE * width / back;
            scale.fan = if half_fan > 0.0 { 0.5 * FAN_SHARE * height / half_fan } else { scale.in_front };
            scale.rise = scale.in_front.min(0.5 * SLOPE_SHARE * height / half_rise.max(1e-12));
        }
        let left = 0.5 * (width - front * scale.in_front - back * scale.behind);
        scale.lens = [min[0] + (left + back * scale.behind) as f32, min[1] + (0.5 * height) as f32];
        scale
    }

    /// The distance upwards from the axis, or to the right if the section is seen from above.
    fn aside(&self, point: DVec3) -> f64 {
        if self.above { point.x } else { point.y }
    }

    fn off_centre(&self, point: DVec3) -> f64 {
        self.aside(point) - self.slope * point.z
    }

    /// Where a point is drawn.
    pub fn place(&self, point: DVec3) -> Point {
        self.place_flat(point.z, self.aside(point))
    }

    /// Where a ray is drawn. At the depth of the lens it may have a bend, because depths behind it have another scale.
    fn way(&self, [from, to]: Line) -> Vec<Point> {
        let crosses = (from.z < 0.0) != (to.z < 0.0);
        let is_seen = from.z.abs().min(to.z.abs()) * self.behind.max(self.in_front) > UNSEEN;
        let bend = (crosses && is_seen).then(|| self.place(from + (to - from) * (from.z / (from.z - to.z))));
        [self.place(from)].into_iter().chain(bend).chain([self.place(to)]).collect()
    }

    /// The horizontal place at which a depth is drawn.
    pub fn x(&self, depth: f64) -> f32 {
        self.lens[0] + (depth * if depth < 0.0 { self.behind } else { self.in_front }) as f32
    }

    /// The depth that is drawn at a horizontal place.
    pub fn depth(&self, x: f32) -> f64 {
        let from_lens = f64::from(x - self.lens[0]);
        from_lens / if from_lens < 0.0 { self.behind } else { self.in_front }
    }

    /// How far above or below the centre of the lens a vertical place is.
    pub fn height_at_lens(&self, y: f32) -> f64 {
        f64::from((y - self.lens[1]).abs()) / self.fan
    }

    /// What is drawn at a place in front of the lens: its slopes to the right and upwards from the lens, and its depth.
    /// `slope` has those of the centre ray.
    pub fn seen_at(&self, [x, y]: Point, slope: DVec2) -> (DVec2, f64) {
        let depth = self.depth(x);
        let down = f64::from(y - self.lens[1]);
        let up = if self.above { down } else { -down };
        let aside = self.slope + (up / depth - self.slope * self.rise) / self.fan;
        (if self.above { DVec2::new(aside, slope.y) } else { DVec2::new(slope.x, aside) }, depth)
    }

    /// Where the plane is drawn that is in focus at this depth on the axis. What is farther away is on the positive side.
    fn border(&self, diagram: &Diagram, inverse_distance: f64) -> Border {
        let [in_depth, in_height] = diagram.cut_of_plane(self.above, inverse_distance);
        Border::new(|[x, y]| {
            let depth = (x - f64::from(self.lens[0])) / self.in_front;
            let down = y - f64::from(self.lens[1]);
            let up = if self.above { down } else { -down };
            let height = self.slope * depth + (up - self.slope * depth * self.rise) / self.fan;
            in_depth * depth + in_height * height - 1.0
        })
    }

    /// Where the focal plane is drawn in a section: the ends of a line.
    pub(super) fn focal_plane(&self, diagram: &Diagram, section: &Pane) -> Option<[Point; 2]> {
        diagram.focus?;
        let border = self.border(diagram, diagram.plane.inverse_distance);
        border.within([self.lens[0], section.min[1]], section.max)
    }

    /// The hinge line, if a section shows it: the focal plane of a tilted lens turns around it.
    fn hinge(&self, diagram: &Diagram, section: &Pane) -> Option<Point> {
        let [_, in_height] = diagram.cut_of_plane(self.above, 0.0);
        let at = self.place_flat(0.0, in_height.recip());
        (diagram.is_tilted() && at[1] > section.min[1] && at[1] < section.max[1]).then_some(at)
    }

    fn place_flat(&self, depth: f64, aside: f64) -> Point {
        let centre = self.slope * depth;
        let up = (aside - centre) * self.fan + centre * self.rise;
        // Seen from above, right is down.
        [self.x(depth), self.lens[1] + if self.above { up } else { -up } as f32]
    }

    /// What is drawn larger or smaller than depths in front of the lens, and how much: in full, then shorter and shorter.
    fn words(&self) -> Vec<String> {
        let is_same = |scale: f64| (scale / self.in_front - 1.0).abs() < 1e-9;
        if [self.behind, self.fan, self.rise].into_iter().all(is_same) {
            return vec!["to scale".into()];
        }
        let slope = self.slope.abs() > 1e-3 && !is_same(self.rise);
        let magnified = |[behind, fan, rise]: [&str; 3]| {
            let times = |name: &str, scale: f64| format!("{name} {} times", digits(scale / self.in_front, 2));
            let mut words = format!("magnified: {}, {}", times(behind, self.behind), times(fan, self.fan));
            if slope {
                words += &format!(", {}", times(rise, self.rise));
            }
            words
        };
        vec![
            magnified(["depths behind the lens", "heights from the centre ray", "its slope"]),
            magnified(["behind the lens", "heights", "slope"]),
            "magnified".into(),
        ]
    }
}

/// How far behind the lens the drawing goes.
fn film_side_end(diagram: &Diagram) -> f64 {
    let image = &diagram.image;
    image.light_up.first().map_or(image.film_distance, |line| -line[1].z)
}

fn fan(diagram: &Diagram, above: bool) -> Vec<Line> {
    let fan = if above { &diagram.fan_across } else { &diagram.fan_up };
    // The part of a ray that is drawn.
    let shown = |[from, to]: &Line| {
        let share = (diagram.reach / (to.z - from.z).max(1e-12)).min(1.0);
        [*from, *from + (*to - *from) * share]
    };
    fan.iter().map(shown).collect()
}

fn light(diagram: &Diagram, above: bool) -> Vec<Line> {
    if above { diagram.image.light_across.clone() } else { diagram.image.light_up.clone() }
}

/// Draws the section into the left part of the sheet, which has this size: names, the section itself, and further names.
/// Also gives its scale.
pub(super) fn draw(
    diagram: &Diagram,
    others: &[Diagram],
    look: &Look<'_>,
    [right, end]: Point,
) -> ([Pane; 3], Scale) {
    let top = MARGIN + LINE;
    let bottom = (end - 2.0 * LINE - MARGIN).max(top + 1.0);
    let filling = || Scale::new(diagram, others, look, [MARGIN, top], [right - MARGIN, bottom]);
    let scale = look.scale.map_or_else(filling, |scale| scale.kept(diagram, look));
    let [mut above, mut pane, mut below] =
        [[0.0, top], [top, bottom], [bottom, end]].map(|[from, to]| Pane::new([0.0, from], [right, to]));
    for pane in [&mut above, &mut pane, &mut below] {
        pane.rectangle(pane.min, pane.max, Role::Paper);
    }
    objects(&mut pane, diagram, look, &scale);
    let image = &diagram.image;
    let film = scale.x(-image.film_distance);
    let within = |depth: f64| scale.x(depth).clamp(0.0, right);

    let meets = meeting(diagram).zip(image.crossing);
    let mut names_below: Vec<Name> = meets
        .map(|(name, crossing)| Name::new(within(-crossing), Role::Blur, [name, "light meets here".into()]))
        .into_iter()
        .collect();
    if let Some([near, far]) = look.sharp {
        let [from, to] = [near, far].map(|depth| scale.border(diagram, depth.recip()));
        let band = to.before(&from.beyond(&rectangle([scale.lens[0], top], [right, bottom])));
        let [start, end] = [f32::min, f32::max].map(|nearer| band.iter().map(|at| at[0]).reduce(nearer));
        let middle = start.zip(end).map_or(right, |(start, end)| 0.5 * (start + end));
        pane.area(band, Role::Sharp);
        let far = if far.is_finite() { digits(far, 3) } else { "infinity".into() };
        let on_axis = if diagram.is_tilted() { " on the axis" } else { "" };
        let name = format!("sharp{on_axis} from {} to {far}", digits(near, 3));
        names_below.push(Name::new(middle, Role::SharpName, [name, "sharp".into()]));
    }
    below.row(bottom + 0.5 * LINE, names_below);
    below.row(bottom + 1.5 * LINE, vec![Name::new(0.0, Role::Faint, scale.words())]);

    pane.line([0.0, scale.lens[1]], [right, scale.lens[1]], Role::Frame, 1.0);
    pane.line([film, top], [film, bottom], Role::Film, 2.0);
    if let Some([from, to]) = scale.focal_plane(diagram, &pane) {
        pane.line(from, to, Role::Focus, 2.0);
    }
    for other in others {
        lit(&mut pane, other, other.light_role(false), look, &scale);
    }
    rays(&mut pane, diagram, others.is_empty(), look, &scale);
    opening(&mut pane, diagram, look, &scale, [top, bottom]);
    for other in others {
        let role = other.light_role(false);
        marks(&mut pane, other, [role; 2], look, &scale);
    }
    marks(&mut pane, diagram, [diagram.light_role(others.is_empty()), Role::Blur], look, &scale);
    if let Some(hinge) = scale.hinge(diagram, &pane) {
        pane.dot(hinge, 3.5, Role::Focus);
        pane.name(hinge, Role::Focus, "hinge line");
    }

    above.row(0.5 * top, names(diagram, others, &scale, &pane));
    ([above, pane, below], scale)
}

/// The names above the section. Where there is little room, film and lens keep their bare names, and depths are numbers in
/// the colours of their points.
fn names(diagram: &Diagram, others: &[Diagram], scale: &Scale, section: &Pane) -> Vec<Name> {
    let right = section.max[0];
    let within = |depth: f64| scale.x(depth).clamp(0.0, right);
    let film_distance = diagram.image.film_distance;
    let film = format!("film, {}", millimetres(film_distance * diagram.mm_per_unit));
    let (opening, wide) = opening_name(diagram);
    let opening_texts = match wide {
        Some(wide) => vec![format!("{opening}, {wide} wide"), format!("{opening}, {wide}"), opening.into()],
        None => vec![opening.into()],
    };
    let mut names = vec![
        Name::new(within(-film_distance), Role::Film, [format!("{film} behind"), film, "film".into()]),
        Name::new(scale.lens[0], Role::Glass, opening_texts),
    ];
    if let Some((focal_distance, _)) = diagram.focus {
        let line = scale.focal_plane(diagram, section);
        let (whole, number) = (depth(diagram, focal_distance), digits(focal_distance, 3));
        let texts = if diagram.is_tilted() && !(focal_distance > 0.0 && focal_distance.is_finite()) {
            // In this direction the lens is in focus nowhere in front of it.
            vec!["focal plane".into()]
        } else if diagram.is_tilted() {
            vec![format!("focal plane, here at {whole}"), format!("focal plane: {number}"), number]
        } else if line.is_some() {
            vec![format!("focal plane: {whole}"), format!("focal plane: {number}"), number]
        } else {
            vec![format!("focal plane, farther away: {whole}"), format!("focal plane: {number}"), number]
        };
        let x = line.map_or(right, |[top, _]| top[0]);
        names.push(Name::new(x, Role::Focus, texts));
    }
    if let Some(hit) = diagram.hit {
        let name = match diagram.material.as_str() {
            _ if diagram.is_moved => "moved point",
            "" => "object",
            material => material,
        };
        let (whole, number) = (depth(diagram, hit.z), digits(hit.z, 3));
        let texts = [format!("{name}: {whole}"), format!("{name}: {number}"), number];
        let role = diagram.light_role(others.is_empty());
        names.push(Name::new(within(hit.z), role, texts));
    }
    for (other, hit) in others.iter().filter_map(|other| other.hit.map(|hit| (other, hit))) {
        let (number, blur) = (digits(hit.z, 3), pixels(other.image.blur_pixels));
        let texts = [format!("kept: {number}, {blur}"), format!("kept: {number}"), number];
        names.push(Name::new(within(hit.z), other.light_role(false), texts));
    }
    names
}

fn objects(pane: &mut Pane, diagram: &Diagram, look: &Look<'_>, scale: &Scale) {
    let outlines = if look.above() { &diagram.outlines_across } else { &diagram.outlines_up };
    for outline in outlines {
        let points: Vec<Point> =
            outline.corners.iter().map(|[depth, aside]| scale.place_flat(*depth, *aside)).collect();
        if let [from, to] = points[..] {
            pane.line(from, to, Role::Object(outline.color), 1.5);
        } else {
            pane.area(points.clone(), Role::ObjectInside(outline.color));
            pane.outline(points, Role::Object(outline.color), 1.5);
        }
    }
}

fn rays(pane: &mut Pane, diagram: &Diagram, is_alone: bool, look: &Look<'_>, scale: &Scale) {
    let fan = fan(diagram, look.above());
    for ray in &fan {
        pane.lines(scale.way(*ray), Role::Ray, 1.0);
    }
    lit(pane, diagram, diagram.light_role(is_alone), look, scale);
    let image = &diagram.image;
    let end = diagram.hit.unwrap_or(diagram.centre[1]);
    pane.dashed(scale.lens, scale.place(end), Role::Centre);
    pane.dashed(scale.lens, scale.place(image.p), Role::Centre);
}

/// Draws the light of the point on both sides of the lens.
fn lit(pane: &mut Pane, diagram: &Diagram, role: Role, look: &Look<'_>, scale: &Scale) {
    let Some(hit) = diagram.hit else {
        return;
    };
    let arriving = fan(diagram, look.above()).into_iter().map(|ray| [hit, ray[0]]);
    for ray in arriving.chain(light(diagram, look.above())) {
        pane.lines(scale.way(ray), role, 1.0);
    }
}

/// Draws the lens, or the hole, and the wall around it.
fn opening(pane: &mut Pane, diagram: &Diagram, look: &Look<'_>, scale: &Scale, [top, bottom]: [f32; 2]) {
    let rims = diagram.rims(look.above());
    let x = scale.lens[0];
    let ends = rims.map(|rim| scale.place(rim)[1]);
    let [upper, lower] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    if diagram.model == CameraModel::ThinLens && upper < lower {
        // From the centre of the lens to one rim, on one side. A tilted lens may have a bend in the middle of the drawing,
        // because depths behind it have another scale.
        let side = |rim: DVec3, sign: f32| {
            (0..=8_u8).map(move |step| {
                let share = f32::from(step) / 8.0;
                let [x, y] = scale.place(rim * f64::from(share));
                [x + sign * GLASS * (1.0 - share * share), y]
            })
        };
        for rim in rims {
            pane.area(side(rim, 1.0).chain(side(rim, -1.0).rev()).collect(), Role::GlassInside);
        }
        let around = side(rims[0], 1.0).rev().chain(side(rims[1], 1.0).skip(1));
        let back = side(rims[1], -1.0).rev().skip(1).chain(side(rims[0], -1.0).skip(1));
        pane.outline(around.chain(back).collect(), Role::Glass, 1.5);
    }
    let middle = 0.5 * (upper + lower);
    for [from, to] in [[top, upper.min(middle - 1.0)], [lower.max(middle + 1.0), bottom]] {
        if from < to {
            pane.line([x, from], [x, to], Role::Frame, 3.0);
        }
    }
}

/// The name of the lens or the hole, and how wide it is.
fn opening_name(diagram: &Diagram) -> (&'static str, Option<String>) {
    let wide = diagram.half_aperture.map(|half| 2.0 * half * diagram.mm_per_unit);
    let wide = Some(millimetres(wide[0].max(wide[1])));
    match diagram.model {
        CameraModel::Pinhole => ("ideal pinhole", None),
        CameraModel::Hole => ("hole", wide),
        CameraModel::ThinLens if diagram.half_aperture == [0.0; 2] => ("pinhole", None),
        CameraModel::ThinLens => ("lens", wide),
    }
}

/// Marks the object's point, and in the second colour the place where light meets, and the blur on the film.
fn marks(pane: &mut Pane, diagram: &Diagram, [role, on_film]: [Role; 2], look: &Look<'_>, scale: &Scale) {
    let image = &diagram.image;
    if let Some((_, p)) = diagram.focus.filter(|(depth, _)| *depth > 0.0) {
        pane.dot(scale.place(p), 3.0, Role::Focus);
    }
    let Some(hit) = diagram.hit else {
        return;
    };
    pane.dot(scale.place(hit), 4.0, role);
    let [from, to] = diagram.falls(look.above()).map(|point| scale.place(point));
    pane.line(from, to, on_film, 4.0);
    if let Some(crossing) = image.crossing {
        let [x, y] = scale.place(-crossing * diagram.slope);
        pane.dot([x, y], 3.5, on_film);
        // A line leads from the name below up to the place.
        if on_film == Role::Blur {
            pane.line([x, y + 5.0], [x, pane.max[1]], on_film, 1.0);
        }
    }
}
