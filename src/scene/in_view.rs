//! At which depths a picture has something to focus on.

use super::shape::{Plane, Shape};
use super::{Camera, Scene};
use glam::{DVec2, DVec3};

/// A scene with more shapes than this, such as a mesh, counts as one thing.
const MANY: usize = 64;

/// Where the shapes of a scene are, roughly: the box around each, or one box around all if there are many.
#[derive(Debug, Clone, Default)]
pub struct Extents {
    boxes: Vec<[DVec3; 2]>,
    planes: Vec<Plane>,
}

/// The ranges of axial depth that things have which are in a picture, in scene units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Depths {
    /// Of the shapes that are finite.
    pub shapes: Vec<[f64; 2]>,
    /// Of the planes. Their ends can be infinite.
    pub planes: Vec<[f64; 2]>,
}

impl Depths {
    /// Whether anything may be between these depths.
    pub fn meet(&self, [near, far]: [f64; 2]) -> bool {
        self.shapes.iter().chain(&self.planes).any(|[nearest, farthest]| *nearest <= far && near <= *farthest)
    }

    /// Whether there is anything.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty() && self.planes.is_empty()
    }
}

impl Extents {
    /// The extents of the shapes of this scene.
    pub fn of(scene: &Scene) -> Self {
        let mut boxes: Vec<[DVec3; 2]> = scene.shapes.iter().filter_map(|of| of.shape.bounds()).collect();
        if boxes.len() > MANY {
            boxes = boxes.into_iter().reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]).into_iter().collect();
        }
        let planes = scene.shapes.iter().filter_map(|of| match of.shape {
            Shape::Plane(plane) => Some(plane),
            _ => None,
        });
        Self { boxes, planes: planes.take(MANY).collect() }
    }

    /// The depths of what a picture of this size shows. What is hidden behind other things counts too.
    pub fn depths(&self, camera: &Camera, [width, height]: [u32; 2]) -> Depths {
        let frame = camera.frame();
        let highest = (0.5 * camera.vfov_radians).tan();
        let half = DVec2::new(highest * f64::from(width) / f64::from(height), highest);
        // Right, up and forward.
        let seen = |point: DVec3| {
            let from_eye = point - camera.eye;
            DVec3::new(from_eye.dot(frame.u()), from_eye.dot(frame.v()), -from_eye.dot(frame.w()))
        };
        let shape = |[lower, upper]: &[DVec3; 2]| {
            let corners: [DVec3; 8] = std::array::from_fn(|corner| {
                let side = |bit: usize| corner >> bit & 1 == 1;
                seen(DVec3::select(glam::BVec3::new(side(0), side(1), side(2)), *upper, *lower))
            });
            // All corners are beyond the same side of the picture.
            let beyond = |is: &dyn Fn(DVec3) -> bool| corners.into_iter().all(is);
            let is_out = beyond(&|at| at.z <= 0.0)
                || beyond(&|at| at.x > half.x * at.z)
                || beyond(&|at| -at.x > half.x * at.z)
                || beyond(&|at| at.y > half.y * at.z)
                || beyond(&|at| -at.y > half.y * at.z);
            let depths = corners.map(|at| at.z);
            let nearest = depths.into_iter().fold(f64::INFINITY, f64::min).max(0.0);
            (!is_out).then(|| [nearest, depths.into_iter().fold(0.0, f64::max)])
        };
        let plane = |plane: &Plane| {
            let normal = plane.normal.as_dvec3();
            let distance = normal.dot(plane.point - camera.eye);
            // The inverse of the depth is linear over the picture, so its extremes are at the corners.
            let inverse = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[x, y]| {
                let ray = x * half.x * frame.u() + y * half.y * frame.v() - frame.w();
                normal.dot(ray) / distance
            });
            let nearest = inverse.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let farthest = inverse.into_iter().fold(f64::INFINITY, f64::min).max(0.0);
            (nearest > 0.0).then(|| [nearest.recip(), farthest.recip()])
        };
        Depths {
            shapes: self.boxes.iter().filter_map(shape).collect(),
            planes: self.planes.iter().filter_map(plane).collect(),
        }
    }
}
