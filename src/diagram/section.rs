//! The section: film, lens, focal plane and object from left to right, cut along the centre ray.

use super::sheet::{LINE, MARGIN, Name, Pane, Point, Role};
use super::words::{depth, digits, meeting, millimetres, pixels};
use super::{Diagram, Line, Look};
use crate::scene::CameraModel;
use glam::DVec3;

/// The share of the width that the side of the film takes, unless the drawing is to scale.
const FILM_SIDE: f64 = 0.38;
/// The share of the height that the fan of rays takes, unless the drawing is to scale.
const FAN_SHARE: f64 = 0.56;
/// The share of the height that the slope of the centre ray takes, unless the drawing is to scale.
const SLOPE_SHARE: f64 = 0.36;
/// The share of the side of the film that stays free behind it.
const BEHIND_FILM: f64 = 1.06;
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

    fn place_flat(&self, depth: f64, aside: f64) -> Point {
        let centre = self.slope * depth;
        let up = (aside - centre) * self.fan + centre * self.rise;
        // Seen from above, right is down.
        [self.x(depth), self.lens[1] + if self.above { up } else { -up } as f32]
    }

    /// What is drawn larger or smaller than depths in front of the lens, and how much.
    fn words(&self) -> String {
        let times = |name: &str, scale: f64| format!("{name} {} times", digits(scale / self.in_front, 2));
        let is_same = |scale: f64| (scale / self.in_front - 1.0).abs() < 1e-9;
        if [self.behind, self.fan, self.rise].into_iter().all(is_same) {
            return "to scale".into();
        }
        let parts = [
            ("depths behind the lens", self.behind, true),
            ("heights from the centre ray", self.fan, true),
            ("its slope", self.rise, self.slope.abs() > 1e-3 && !is_same(self.rise)),
        ];
        let parts: Vec<String> =
            parts.into_iter().filter(|part| part.2).map(|(name, scale, _)| times(name, scale)).collect();
        format!("magnified: {}", parts.join(", "))
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
        let band = [within(near), within(far)];
        pane.rectangle([band[0], top], [band[1], bottom], Role::Sharp);
        let far = if far.is_finite() { digits(far, 3) } else { "infinity".into() };
        let name = format!("sharp from {} to {far}", digits(near, 3));
        names_below.push(Name::new(0.5 * (band[0] + band[1]), Role::SharpName, [name, "sharp".into()]));
    }
    below.row(bottom + 0.5 * LINE, names_below);
    below.row(bottom + 1.5 * LINE, vec![Name::new(0.0, Role::Faint, [scale.words(), "magnified".into()])]);

    pane.line([0.0, scale.lens[1]], [right, scale.lens[1]], Role::Frame, 1.0);
    pane.line([film, top], [film, bottom], Role::Film, 2.0);
    if let Some((depth, _)) = diagram.focus {
        pane.line([scale.x(depth), top], [scale.x(depth), bottom], Role::Focus, 2.0);
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

    above.row(0.5 * top, names(diagram, others, &scale, right));
    ([above, pane, below], scale)
}

/// The names above the section. Where there is little room, film and lens keep their bare names, and depths are numbers in
/// the colours of their points.
fn names(diagram: &Diagram, others: &[Diagram], scale: &Scale, right: f32) -> Vec<Name> {
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
        let is_shown = scale.x(focal_distance) <= right;
        let name = if is_shown { "focal plane" } else { "focal plane, farther away" };
        let whole = format!("{name}: {}", depth(diagram, focal_distance));
        let number = digits(focal_distance, 3);
        let texts = [whole, format!("focal plane: {number}"), number];
        names.push(Name::new(within(focal_distance), Role::Focus, texts));
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
    let mut line = |[from, to]: Line, role: Role| pane.line(scale.place(from), scale.place(to), role, 1.0);
    for ray in &fan {
        line(*ray, Role::Ray);
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
    for [from, to] in arriving.chain(light(diagram, look.above())) {
        pane.line(scale.place(from), scale.place(to), role, 1.0);
    }
}

/// Draws the lens, or the hole, and the wall around it.
fn opening(pane: &mut Pane, diagram: &Diagram, look: &Look<'_>, scale: &Scale, [top, bottom]: [f32; 2]) {
    let [x, y] = scale.lens;
    let half = (diagram.half_aperture[usize::from(!look.above())] * scale.fan) as f32;
    if diagram.model == CameraModel::ThinLens && half > 0.0 {
        let side = |sign: f32| {
            (-8..=8_i8).map(move |step| {
                let share = f32::from(step) / 8.0;
                [x + sign * GLASS * (1.0 - share * share), y + sign * share * half]
            })
        };
        let glass: Vec<Point> = side(1.0).chain(side(-1.0)).collect();
        pane.area(glass.clone(), Role::GlassInside);
        pane.outline(glass, Role::Glass, 1.5);
    }
    let gap = half.max(1.0);
    for [from, to] in [[top, y - gap], [y + gap, bottom]] {
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
    if let Some((_, p)) = diagram.focus {
        pane.dot(scale.place(p), 3.0, Role::Focus);
    }
    let Some(hit) = diagram.hit else {
        return;
    };
    pane.dot(scale.place(hit), 4.0, role);
    let axis = usize::from(!look.above());
    let widest = diagram.half_aperture[0].max(diagram.half_aperture[1]).max(f64::MIN_POSITIVE);
    let half = 0.5 * image.blur * (diagram.half_aperture[axis] / widest) * scale.fan;
    let [x, y] = scale.place(image.p);
    pane.line([x, y - half as f32], [x, y + half as f32], on_film, 4.0);
    if let Some(crossing) = image.crossing {
        let [x, y] = scale.place(-crossing * diagram.slope);
        pane.dot([x, y], 3.5, on_film);
        // A line leads from the name below up to the place.
        if on_film == Role::Blur {
            pane.line([x, y + 5.0], [x, pane.max[1]], on_film, 1.0);
        }
    }
}
