//! The objects of a scene where a plane through the camera cuts them.

use crate::scene::{Material, Scene, Shape};
use crate::settings::to_srgb;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// What is round is drawn with so many corners.
const CORNERS: u32 = 64;
/// A scene with more shapes than this is drawn without its objects, because cutting them all would take too long.
const MAX_SHAPES: usize = 100_000;
/// The brightest channel of an object's colour, in linear light. The object itself may be brighter or darker.
const BRIGHTEST: f64 = 0.7;

/// The plane that cuts the objects. Both contain the centre ray.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    /// It also contains the vertical.
    Up,
    /// It also contains the horizontal.
    Across,
}

impl Section {
    /// The axes of the camera's frame within the plane, beside the depth, and out of it.
    fn axes(self) -> [usize; 2] {
        match self {
            Self::Up => [1, 0],
            Self::Across => [0, 1],
        }
    }
}

/// What the plane cuts of one object: a convex polygon, or a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The corners: the depth, and the distance upwards or to the right of the optical axis.
    pub corners: Vec<[f64; 2]>,
    /// Red, green and blue in sRGB, as bright as can be seen well.
    pub color: [f32; 3],
}

/// What a plane cuts of the objects of a scene, in front of the camera and nearer than `end`. `local` gives a point in the
/// camera's frame, and `slope` is the direction of the centre ray.
pub(super) fn outlines(
    scene: &Scene,
    local: &impl Fn(DVec3) -> DVec3,
    section: Section,
    slope: DVec3,
    end: f64,
) -> Vec<Outline> {
    if scene.shapes.len() > MAX_SHAPES {
        return Vec::new();
    }
    let [within, out] = section.axes();
    let flat = |point: DVec3| DVec2::new(point.z, point[within]);
    let off = |point: DVec3| point[out] - slope[out] * point.z;
    let cut = |shape: &Shape| match shape {
        Shape::Sphere(sphere) => {
            let (center, radius) = (local(sphere.center), f64::from(sphere.radius));
            ball(center, radius, slope[out], within, out)
        }
        Shape::Plane(plane) => {
            let point = local(plane.point);
            let normal = local(plane.point + plane.normal.as_dvec3()) - point;
            let height = |depth: f64| {
                let beside = (slope[out] * depth - point[out]) * normal[out] + (depth - point.z) * normal.z;
                DVec2::new(depth, point[within] - beside / normal[within])
            };
            vec![height(0.0), height(end)]
        }
        Shape::Triangle(triangle) => {
            let [a, b, c] = triangle.vertices.map(local);
            crossings([[a, b], [b, c], [c, a]].into_iter(), off).map(flat).collect()
        }
        Shape::Box(_) => {
            let corners: Vec<DVec3> = shape.corners(glam::DMat3::IDENTITY).iter().map(local).collect();
            let edges = (0..8_usize).flat_map(|corner| {
                let others = [1, 2, 4].into_iter().filter(move |bit| corner & bit == 0);
                others.map(move |bit| [corner, corner | bit])
            });
            around(crossings(edges.map(|edge| edge.map(|corner| corners[corner])), off).map(flat))
        }
        Shape::Cylinder(cylinder) => {
            let [start, end] =
                [cylinder.start, cylinder.end].map(|middle| rim(middle, cylinder.axis(), cylinder.radius));
            let edges = (0..CORNERS).flat_map(|number| {
                let [a, b, c] = [start(number), end(number), start(number + 1)].map(local);
                [[a, b], [a, c], [b, local(end(number + 1))]]
            });
            around(crossings(edges, off).map(flat))
        }
        Shape::Rectangle(_) => {
            let corners: Vec<DVec3> = shape.corners(glam::DMat3::IDENTITY).iter().map(local).collect();
            let edges = (0..4).map(|number| [corners[number], corners[(number + 1) % 4]]);
            crossings(edges, off).map(flat).collect()
        }
        Shape::Disc(disc) => {
            let rim = rim(disc.center, disc.axis(), disc.radius);
            let edges = (0..CORNERS).map(|number| [rim(number), rim(number + 1)].map(local));
            crossings(edges, off).map(flat).collect()
        }
    };
    let outlines = scene.shapes.iter().filter_map(|of| {
        let corners = between(between(cut(&of.shape), |depth| depth), |depth| end - depth);
        let is_finite = corners.iter().all(|corner| corner.is_finite());
        (corners.len() >= 2 && is_finite).then(|| Outline {
            corners: corners.into_iter().map(|corner| corner.to_array()).collect(),
            color: color(&scene.materials[of.material as usize]),
        })
    });
    outlines.collect()
}

/// The ellipse that the plane `point[out] = slope * depth` cuts of a ball.
fn ball(center: DVec3, radius: f64, slope: f64, within: usize, out: usize) -> Vec<DVec2> {
    // A quadratic equation in depth and height; completing its square gives the middle and the half axes.
    let steepness = 1.0 + slope * slope;
    let middle = (slope * center[out] + center.z) / steepness;
    let squared = radius * radius - center[out].powi(2) - center.z.powi(2) + steepness * middle * middle;
    if squared <= 0.0 {
        return Vec::new();
    }
    let half = squared.sqrt();
    let corner = |number: u32| {
        let (sin, cos) = (TAU * f64::from(number) / f64::from(CORNERS)).sin_cos();
        DVec2::new(middle + half / steepness.sqrt() * cos, center[within] + half * sin)
    };
    (0..CORNERS).map(corner).collect()
}

/// The corners of a polygon that stands for the circle of this radius around an axis.
fn rim(middle: DVec3, axis: DVec3, radius: f32) -> impl Fn(u32) -> DVec3 {
    let (across, other) = axis.any_orthonormal_pair();
    move |number| {
        let (sin, cos) = (TAU * f64::from(number) / f64::from(CORNERS)).sin_cos();
        middle + f64::from(radius) * (cos * across + sin * other)
    }
}

/// Where edges cross the plane on which `off` is zero.
fn crossings(
    edges: impl Iterator<Item = [DVec3; 2]>,
    off: impl Fn(DVec3) -> f64,
) -> impl Iterator<Item = DVec3> {
    edges.filter_map(move |[a, b]| {
        let (from, to) = (off(a), off(b));
        ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
    })
}

/// The corners of a convex polygon in their order around it.
fn around(corners: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut corners: Vec<DVec2> = corners.collect();
    let middle = corners.iter().sum::<DVec2>() / corners.len().max(1) as f64;
    corners.sort_by(|a, b| (a - middle).to_angle().total_cmp(&(b - middle).to_angle()));
    corners
}

/// The part of a convex polygon, or of a line, whose depths have a value of at least zero.
fn between(corners: Vec<DVec2>, value: impl Fn(f64) -> f64) -> Vec<DVec2> {
    let mut left = Vec::new();
    for (number, corner) in corners.iter().enumerate() {
        let next = corners[(number + 1) % corners.len()];
        let (from, to) = (value(corner.x), value(next.x));
        if from >= 0.0 {
            left.push(*corner);
        }
        // The edge of a line leads there and back, and is cut once.
        let is_back = corners.len() == 2 && number == 1;
        if (from >= 0.0) != (to >= 0.0) && !is_back {
            left.push(*corner + (next - *corner) * (from / (from - to)));
        }
    }
    left
}

/// A colour of the hue of a material, in sRGB.
fn color(material: &Material) -> [f32; 3] {
    let seen = material.brightest(DVec3::ONE, DVec3::ONE) + material.reflectance().as_dvec3();
    let most = seen.max_element();
    let linear = if most > 0.0 { seen * (BRIGHTEST / most) } else { DVec3::splat(0.2) };
    linear.to_array().map(|level| to_srgb(level) as f32)
}
