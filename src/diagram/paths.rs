//! The light paths of one pixel as points and lines.
//!
//! Points are in the camera's frame, in scene units: right, up, and the depth in front of the lens. Depth is negative
//! behind the lens, on the side of the film. K. Suffern, *Ray Tracing from the Ground Up*,
//! chapter 10; the side of the film follows from the equation of the thin lens, `1 / f = 1 / v + 1 / F`.

use super::outline::{Outline, Section, outlines};
use crate::renderer::{LensRay, Picked};
use crate::scene::{CameraModel, FocalPlane, Opening};
use crate::settings::Estimator;
use glam::{DVec2, DVec3};

/// The view plane is drawn at this fraction of the distance to what is looked at. Only angles matter on it.
const VIEW_PLANE_SHARE: f64 = 0.45;
/// The drawing extends beyond what is seen and beyond the focal plane by this factor.
const BEYOND: f64 = 1.2;
/// If one of them is more than this many times as far as the other, the drawing ends before it.
const MAX_DEPTH_RATIO: f64 = 4.0;

/// A blur of at most so many pixels cannot be seen.
pub(super) const SHARP: f64 = 0.5;

/// Where a point is, seen from the lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Nearer than the focal plane.
    InFront,
    /// As sharp as if it lay in the focal plane.
    InFocus,
    /// Farther away than the focal plane.
    Behind,
}

/// A line of the drawing.
pub type Line = [DVec3; 2];

/// What is drawn in front of the lens.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// The camera model.
    pub model: CameraModel,
    /// The length of a scene unit in millimetres.
    pub mm_per_unit: f64,
    /// Half the width and half the height of the aperture; 0 for a pinhole.
    pub half_aperture: [f64; 2],
    /// The depth at which the drawing ends.
    pub reach: f64,
    /// The depth at which the view plane is drawn.
    pub view_plane: f64,
    /// Half the width and half the height of the picture on the view plane.
    pub half_picture: [f64; 2],
    /// The sample point on the view plane: q.
    pub q: DVec3,
    /// The depth in which the pixel is in focus, which is that of the focal plane, and the point p where the centre ray meets it. `None` without a lens.
    pub focus: Option<(f64, DVec3)>,
    /// Where the lens is in focus.
    pub plane: FocalPlane,
    /// The point where the centre ray hits a surface, if it hits one.
    pub hit: Option<DVec3>,
    /// Whether `hit` is another point on the centre ray than the device found.
    pub is_moved: bool,
    /// Whether the distance of the film is free. Otherwise it follows from the focal distance.
    pub film_is_free: bool,
    /// The name of the material there.
    pub material: String,
    /// The direction of the centre ray, for a depth of one.
    pub slope: DVec3,
    /// What the plane through the centre ray and the vertical cuts of the scene: for the side view.
    pub outlines_up: Vec<Outline>,
    /// What the plane through the centre ray and the horizontal cuts of the scene: for the top view.
    pub outlines_across: Vec<Outline>,
    /// The ray through the centre of the lens.
    pub centre: Line,
    /// Primary rays from points of the lens on its vertical diameter, from bottom to top: for the side view.
    pub fan_up: Vec<Line>,
    /// Primary rays from points of the lens on its horizontal diameter, from left to right: for the top view.
    pub fan_across: Vec<Line>,
    /// The primary rays of the pixel's first samples.
    pub samples: Vec<Line>,
    /// What happens behind the lens.
    pub image: ImageSide,
}

/// What is drawn behind the lens.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageSide {
    /// The distance of the film behind the lens.
    pub film_distance: f64,
    /// The sample point on the film: p'.
    pub p: DVec3,
    /// How many pixels of the picture a scene unit on the film is. It is negative if the picture is turned by 180 degrees.
    pub pixels_per_unit: f64,
    /// Light from the visible point, through points on the vertical diameter of the lens, to the film. The lines start
    /// on the lens. They cross where the sharp image of the point would be.
    pub light_up: Vec<Line>,
    /// Light as in `light_up`, but through points on the horizontal diameter.
    pub light_across: Vec<Line>,
    /// The distance behind the lens at which the lines cross, if they do.
    pub crossing: Option<f64>,
    /// The diameter of the circle of confusion on the film, in scene units.
    pub blur: f64,
    /// The diameter of the circle of confusion in pixels.
    pub blur_pixels: f64,
    /// The shape of the circle of confusion: the openings of the aperture, in units of its radius.
    pub openings: Vec<Opening>,
    /// How far from its middle the circle of confusion has the light of a point on the rim of the aperture, in pixels of
    /// the picture. It is negative if the picture shows the shape of the aperture upside down.
    pub blur_radius: f64,
}

impl Diagram {
    /// Makes the diagram of what the device traced with this camera.
    pub fn new(estimator: &Estimator, picked: &Picked) -> Self {
        let camera = &estimator.focused_camera();
        // The centre of the lens as the device computes it.
        let (frame, eye) = (camera.frame(), picked.rays[0].origin);
        let turned =
            |vector: DVec3| DVec3::new(vector.dot(frame.u()), vector.dot(frame.v()), -vector.dot(frame.w()));
        let local = |point: DVec3| turned(point - eye);

        let slope = turned(picked.rays[0].direction);
        let slope = slope / slope.z;
        let hit = picked.surface.as_ref().map(|surface| local(surface.point));
        let has_lens = estimator.model == CameraModel::ThinLens;
        let plane = estimator.focal_plane();
        let in_focus = plane.inverse_depth(slope.truncate()).recip();
        let focus = has_lens.then(|| (in_focus, local(picked.focus)));
        let (near, reach) = extent(focus, hit, camera.film_distance());
        let view_plane = VIEW_PLANE_SHARE * near;

        let line = |ray: &LensRay| -> Line {
            let (origin, direction) = (local(ray.origin), turned(ray.direction));
            // The line ends beyond the edge of the drawing, because the edge may cut it a little behind its own depth.
            let end = (2.0 * reach / direction.z.max(1e-9)).min(ray.distance);
            [origin, origin + end * direction]
        };
        let lines = |rays: &[LensRay]| rays.iter().map(line).collect::<Vec<_>>();
        let size @ [width, height] = estimator.size.map(f64::from);
        let half_height = (0.5 * camera.vfov_radians).tan() * view_plane;
        let (fan_up, fan_across) = (lines(picked.fan_up()), lines(picked.fan_across()));
        // The outermost rays start on the rim.
        let half_aperture =
            [fan_across.last().map_or(0.0, |ray| ray[0].x), fan_up.last().map_or(0.0, |ray| ray[0].y)];
        let cut = |section| outlines(&estimator.scene, &local, section, slope, 2.0 * reach);
        let mut diagram = Self {
            model: estimator.model,
            mm_per_unit: camera.mm_per_unit(),
            half_aperture,
            reach,
            view_plane,
            half_picture: [half_height * width / height, half_height],
            q: slope * view_plane,
            focus,
            plane,
            hit,
            is_moved: false,
            film_is_free: !(has_lens && camera.focus_breathing),
            material: picked.surface.as_ref().map_or_else(String::new, |surface| surface.material.clone()),
            slope,
            outlines_up: cut(Section::Up),
            outlines_across: cut(Section::Across),
            centre: line(&picked.rays[0]),
            fan_up,
            fan_across,
            samples: lines(picked.samples()),
            image: ImageSide::without_light(camera.film_distance(), slope),
        };
        let pixels_per_unit = camera.view_distance_pixels(estimator.size[1]) / camera.film_distance();
        // The film shows everything upside down, and the picture is upright.
        let is_turned = estimator.model != CameraModel::Hole || !estimator.hole.upright;
        diagram.image.pixels_per_unit = if is_turned { -pixels_per_unit } else { pixels_per_unit };
        // The film position in units of the distance to a corner.
        let corner = 0.5 * size[0].hypot(size[1]) / camera.view_distance_pixels(estimator.size[1]);
        let film = ((slope.truncate() - plane.axis()) / corner).to_array();
        diagram.image.openings = estimator.aperture.openings(estimator.model, film);
        if let Some(hit) = hit {
            diagram.take_light(hit);
        }
        diagram
    }

    /// The same drawing with the light of a point at another depth on the centre ray. There may be nothing in the scene.
    pub fn with_point_at(&self, depth: f64) -> Self {
        let hit = self.slope * depth;
        let mut moved = Self { hit: Some(hit), is_moved: true, ..self.clone() };
        moved.reach = extent(self.focus, Some(hit), self.image.film_distance).1;
        moved.take_light(hit);
        moved
    }

    /// Where the point is whose light is drawn, if there is a focal plane.
    pub fn side(&self) -> Option<Side> {
        let ((focal_distance, _), hit) = self.focus.zip(self.hit)?;
        Some(match hit.z.recip() - focal_distance.recip() {
            _ if self.image.blur_pixels <= SHARP => Side::InFocus,
            // A tilted lens may be in focus behind itself, and then everything is too near.
            nearer if nearer > 0.0 => Side::InFront,
            _ => Side::Behind,
        })
    }

    /// The points of the rim of the lens or hole that a section cuts: the lower or left one, and the other one.
    pub(super) fn rims(&self, above: bool) -> [DVec3; 2] {
        let fan = if above { &self.fan_across } else { &self.fan_up };
        [fan.first(), fan.last()].map(|ray| ray.map_or(DVec3::ZERO, |ray| ray[0]))
    }

    /// Between which points of the film the light falls that a section shows.
    pub(super) fn falls(&self, above: bool) -> [DVec3; 2] {
        let light = if above { &self.image.light_across } else { &self.image.light_up };
        let on_film = |[from, to]: &Line| {
            *from + (*to - *from) * ((-self.image.film_distance - from.z) / (to.z - from.z))
        };
        [light.first(), light.last()].map(|line| line.map_or(self.image.p, on_film))
    }

    /// Whether the lens is tilted.
    pub(super) fn is_tilted(&self) -> bool {
        self.focus.is_some() && self.plane.tilt != DVec2::ZERO
    }

    /// In a section, the points in focus are those with `a z + b h = 1`, where `z` is their depth and `h` how far they are
    /// above or to the right of the axis. Gives `a` and `b` of the plane that is in focus at this depth on the axis, for
    /// the same lens.
    pub(super) fn cut_of_plane(&self, above: bool, inverse_distance: f64) -> [f64; 2] {
        let (slope, plane) = (self.slope, self.plane.slope);
        let [across, along] = if above { [plane.y * slope.y, plane.x] } else { [plane.x * slope.x, plane.y] };
        [inverse_distance + across, along]
    }

    /// Follows light from `hit` through the points of the lens where the primary rays start.
    fn take_light(&mut self, hit: DVec3) {
        let v = self.image.film_distance;
        // A hole does not refract: light goes straight on.
        let power = self.focus.map_or(0.0, |(focal_distance, _)| v.recip() + focal_distance.recip());
        let crossing = (power - hit.z.recip()).recip();
        let crossing = (crossing > 0.0).then_some(crossing);
        // The lines end a little beyond the film, or beyond the crossing if that is near.
        let end = 1.08 * crossing.filter(|at| *at < 1.7 * v).map_or(v, |at| at.max(v));
        let refracted = |lens: DVec3, behind: f64| {
            let slope = lens.truncate() * (hit.z.recip() - power) - hit.truncate() / hit.z;
            // A point of a tilted lens lies a little before or behind its centre, and on the same ray.
            let way = (behind + lens.z) / (1.0 + lens.z * (power - hit.z.recip()));
            (lens.truncate() + slope * way).extend(-behind)
        };
        let light = |fan: &[Line]| fan.iter().map(|ray| [ray[0], refracted(ray[0], end)]).collect();
        (self.image.light_up, self.image.light_across) = (light(&self.fan_up), light(&self.fan_across));
        // The circle is as wide as the wider of the two fans of light.
        let radius = self.half_aperture[0].max(self.half_aperture[1]);
        let rim = |side: f64| refracted(DVec3::new(0.0, side * radius, 0.0), v).y;
        self.image.blur = (rim(1.0) - rim(-1.0)).abs();
        self.image.blur_radius = 0.5 * (rim(1.0) - rim(-1.0)) * self.image.pixels_per_unit;
        self.image.blur_pixels = self.image.blur * self.image.pixels_per_unit.abs();
        self.image.crossing = crossing;
    }
}

/// How far the nearer one of focal plane and object is, and at which depth the drawing ends.
fn extent(focus: Option<(f64, DVec3)>, hit: Option<DVec3>, film_distance: f64) -> (f64, f64) {
    // A tilted lens may be in focus behind itself, where nothing is drawn.
    let depths = [focus.map(|(depth, _)| depth).filter(|depth| *depth > 0.0), hit.map(|point| point.z)];
    let (near, far) = depths
        .into_iter()
        .flatten()
        .fold((f64::INFINITY, 0.0_f64), |(near, far), depth| (near.min(depth), far.max(depth)));
    // If nothing is hit and there is no lens, any scale will do.
    if near.is_finite() {
        (near, BEYOND * far.min(MAX_DEPTH_RATIO * near))
    } else {
        (film_distance, film_distance)
    }
}

impl ImageSide {
    fn without_light(film_distance: f64, slope: DVec3) -> Self {
        Self {
            film_distance,
            p: -film_distance * slope,
            pixels_per_unit: 0.0,
            light_up: Vec::new(),
            light_across: Vec::new(),
            crossing: None,
            blur: 0.0,
            blur_pixels: 0.0,
            openings: Vec::new(),
            blur_radius: 0.0,
        }
    }
}
