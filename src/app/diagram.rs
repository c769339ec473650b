//! The optics of one place of the picture as points and lines, for a drawing of them.
//!
//! Points are in the camera's frame and in scene units: right, up, and the depth in front of the lens, so that
//! what is behind it, on the film's side, has a negative one. K. Suffern, *Ray Tracing from the Ground Up*,
//! chapter 10; the image side by the equation of the thin lens, `1 / f = 1 / v + 1 / F`.

use crate::renderer::{LensRay, Picked};
use crate::scene::CameraModel;
use crate::settings::Estimator;
use glam::DVec3;

/// The view plane is drawn at this share of the way to what is looked at: only angles count there.
const VIEW_PLANE_SHARE: f64 = 0.25;
/// The drawing goes this far beyond what is seen and the focal plane, as a factor.
const BEYOND: f64 = 1.2;
/// Where one of them is farther than so many times the other, the drawing ends before it.
const MOST_APART: f64 = 4.0;

/// A line of the drawing.
pub type Line = [DVec3; 2];

/// What is drawn of the scene's side.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Half the opening's width and height; 0 for a pinhole.
    pub half_opening: [f64; 2],
    /// The depth to which the drawing goes.
    pub reach: f64,
    /// The depth at which the view plane is drawn.
    pub view_plane: f64,
    /// Half the width and height that the picture has there.
    pub half_picture: [f64; 2],
    /// Where the film position lies on the view plane: q.
    pub q: DVec3,
    /// The depth of the focal plane, and where the centre ray meets it: p. None without a lens.
    pub focus: Option<(f64, DVec3)>,
    /// What the centre ray meets, if anything.
    pub hit: Option<DVec3>,
    /// The ray through the centre of the lens.
    pub centre: Line,
    /// Primary rays from all over the lens, upwards: for the side view.
    pub fan_up: Vec<Line>,
    /// Primary rays from all over the lens, from left to right: for the top view.
    pub fan_across: Vec<Line>,
    /// Those of the pixel's first samples.
    pub samples: Vec<Line>,
    /// What happens behind the lens.
    pub image: ImageSide,
}

/// What is drawn of the film's side.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageSide {
    /// How far behind the lens the film stands.
    pub film_distance: f64,
    /// The film position itself, on the film: p'.
    pub p: DVec3,
    /// Light from what is seen, through points of the lens, to the film: lines that start on the lens, on its
    /// rim first. They cross where the sharp picture of it would be.
    pub light_up: Vec<Line>,
    /// Light as in `light_up`, but through points of the lens from left to right.
    pub light_across: Vec<Line>,
    /// How far behind the lens they cross, where they do.
    pub crossing: Option<f64>,
    /// The circle of confusion that they make on the film, in scene units: its diameter.
    pub blur: f64,
    /// The same in pixels.
    pub blur_pixels: f64,
}

impl Diagram {
    /// Of what the device traced, and the camera that it was traced with.
    pub fn new(estimator: &Estimator, picked: &Picked) -> Self {
        let camera = &estimator.camera;
        // The centre of the lens, where the device has it.
        let (frame, eye) = (camera.frame(), picked.rays[0].origin);
        let turned =
            |vector: DVec3| DVec3::new(vector.dot(frame.u()), vector.dot(frame.v()), -vector.dot(frame.w()));
        let local = |point: DVec3| turned(point - eye);

        let slope = turned(picked.rays[0].direction);
        let slope = slope / slope.z;
        let hit = picked.surface.as_ref().map(|surface| local(surface.point));
        let has_lens = estimator.model == CameraModel::ThinLens;
        let focus = has_lens.then(|| (f64::from(estimator.lens.focal_distance), local(picked.focus)));
        let depths = [focus.map(|(depth, _)| depth), hit.map(|point| point.z)];
        let (near, far) = depths
            .into_iter()
            .flatten()
            .fold((f64::INFINITY, 0.0_f64), |(near, far), depth| (near.min(depth), far.max(depth)));
        // With nothing in sight and no lens, any scale is as good.
        let reach =
            if near.is_finite() { BEYOND * far.min(MOST_APART * near) } else { camera.film_distance() };
        let view_plane = VIEW_PLANE_SHARE * if near.is_finite() { near } else { reach };

        let line = |ray: &LensRay| -> Line {
            let (origin, direction) = (local(ray.origin), turned(ray.direction));
            // Beyond the drawing's edge, which may cut a line a little later than its depth.
            let end = (2.0 * reach / direction.z.max(1e-9)).min(ray.distance);
            [origin, origin + end * direction]
        };
        let lines = |rays: &[LensRay]| rays.iter().map(line).collect::<Vec<_>>();
        let [width, height] = estimator.size.map(f64::from);
        let half_height = (0.5 * camera.vfov_radians).tan() * view_plane;
        let (fan_up, fan_across) = (lines(picked.fan_up()), lines(picked.fan_across()));
        // The fans end on the rim.
        let half_opening =
            [fan_across.last().map_or(0.0, |ray| ray[0].x), fan_up.last().map_or(0.0, |ray| ray[0].y)];
        let mut diagram = Self {
            half_opening,
            reach,
            view_plane,
            half_picture: [half_height * width / height, half_height],
            q: slope * view_plane,
            focus,
            hit,
            centre: line(&picked.rays[0]),
            fan_up,
            fan_across,
            samples: lines(picked.samples()),
            image: ImageSide::without_light(camera.film_distance(), slope),
        };
        if let Some(hit) = hit {
            let pixels_per_unit = camera.view_distance_pixels(estimator.size[1]) / camera.film_distance();
            diagram.take_light(hit, pixels_per_unit);
        }
        diagram
    }

    /// Follows light from `hit` through the points of the lens where the fans start.
    fn take_light(&mut self, hit: DVec3, pixels_per_unit: f64) {
        let v = self.image.film_distance;
        // A hole has no power: light goes straight on.
        let power = self.focus.map_or(0.0, |(focal_distance, _)| v.recip() + focal_distance.recip());
        let crossing = (power - hit.z.recip()).recip();
        let crossing = (crossing > 0.0).then_some(crossing);
        // A little beyond the film, or beyond the crossing where that is near.
        let end = 1.08 * crossing.filter(|at| *at < 1.7 * v).map_or(v, |at| at.max(v));
        let refracted = |lens: DVec3, behind: f64| {
            let slope = (lens - hit).truncate() / hit.z - lens.truncate() * power;
            (lens.truncate() + slope * behind).extend(-behind)
        };
        let light = |fan: &[Line]| fan.iter().map(|ray| [ray[0], refracted(ray[0], end)]).collect();
        (self.image.light_up, self.image.light_across) = (light(&self.fan_up), light(&self.fan_across));
        // As wide as the wider of the two.
        let radius = self.half_opening[0].max(self.half_opening[1]);
        let rim = |side: f64| refracted(DVec3::new(0.0, side * radius, 0.0), v).y;
        self.image.blur = (rim(1.0) - rim(-1.0)).abs();
        self.image.blur_pixels = self.image.blur * pixels_per_unit;
        self.image.crossing = crossing;
    }
}

impl ImageSide {
    fn without_light(film_distance: f64, slope: DVec3) -> Self {
        Self {
            film_distance,
            p: -film_distance * slope,
            light_up: Vec::new(),
            light_across: Vec::new(),
            crossing: None,
            blur: 0.0,
            blur_pixels: 0.0,
        }
    }
}
