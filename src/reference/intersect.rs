//! Rays against shapes, by the textbook.

use super::Ray;
use crate::scene::{Aabb, Plane, Scene, Sphere, Triangle};
use glam::{DMat3, DVec3};

/// A point where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Along the ray.
    pub distance: f64,
    /// Unit length, on the side the ray comes from.
    pub normal: DVec3,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

/// The nearest hit farther than `least`.
pub fn intersect(scene: &Scene, ray: Ray, least: f64) -> Option<Hit> {
    let spheres = scene.spheres.iter().map(|of| (sphere(&of.shape, ray, least), of.material));
    let boxes = scene.boxes.iter().map(|of| (aabb(&of.shape, ray, least), of.material));
    let triangles = scene.triangles.iter().map(|of| (triangle(&of.shape, ray, least), of.material));
    let planes = scene.planes.iter().map(|of| (plane(&of.shape, ray, least), of.material));
    let hits = spheres.chain(boxes).chain(triangles).chain(planes).filter_map(|(hit, material)| {
        let (distance, outward) = hit?;
        let normal = if outward.dot(ray.direction) > 0.0 { -outward } else { outward };
        Some(Hit { distance, normal, material })
    });
    hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

type Crossing = Option<(f64, DVec3)>;

/// |o + t d - c|^2 = r^2.
fn sphere(sphere: &Sphere, ray: Ray, least: f64) -> Crossing {
    let center = sphere.center.as_dvec3();
    let radius = f64::from(sphere.radius);
    let from_center = ray.origin - center;
    let half_b = from_center.dot(ray.direction);
    let discriminant = half_b * half_b - (from_center.length_squared() - radius * radius);
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let distance = [-half_b - root, -half_b + root].into_iter().find(|distance| *distance > least)?;
    let normal = (ray.origin + distance * ray.direction - center) / radius;
    Some((distance, normal))
}

/// The six faces one by one.
fn aabb(aabb: &Aabb, ray: Ray, least: f64) -> Crossing {
    let (lower, upper) = (aabb.lower.as_dvec3().to_array(), aabb.upper.as_dvec3().to_array());
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let mut nearest: Crossing = None;
    for axis in 0..3 {
        for (face, sign) in [(lower[axis], -1.0), (upper[axis], 1.0)] {
            let distance = (face - origin[axis]) / direction[axis];
            let inside = (0..3).filter(|other| *other != axis).all(|other| {
                let at = origin[other] + distance * direction[other];
                (lower[other]..=upper[other]).contains(&at)
            });
            if distance.is_finite()
                && distance > least
                && inside
                && nearest.is_none_or(|(best, _)| distance < best)
            {
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                nearest = Some((distance, DVec3::from_array(normal)));
            }
        }
    }
    nearest
}

/// o + t d = a + b1 (b - a) + b2 (c - a), by Cramer's rule.
fn triangle(triangle: &Triangle, ray: Ray, least: f64) -> Crossing {
    let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
    let (edge1, edge2) = (b - a, c - a);
    let matrix = DMat3::from_cols(edge1, edge2, -ray.direction);
    if matrix.determinant() == 0.0 {
        return None;
    }
    let [b1, b2, distance] = (matrix.inverse() * (ray.origin - a)).to_array();
    let inside = b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    (inside && distance > least).then(|| (distance, edge1.cross(edge2).normalize()))
}

/// n . (o + t d - p) = 0.
fn plane(plane: &Plane, ray: Ray, least: f64) -> Crossing {
    let normal = plane.normal.as_dvec3().normalize();
    let distance = normal.dot(plane.point.as_dvec3() - ray.origin) / normal.dot(ray.direction);
    (distance.is_finite() && distance > least).then_some((distance, normal))
}
