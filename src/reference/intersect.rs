//! Rays against shapes, by the textbook.

use super::Ray;
use crate::scene::{Aabb, Plane, Scene, Shaded, Sphere, Triangle};
use glam::{DMat3, DVec3};

/// A point where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Along the ray.
    pub distance: f64,
    /// Across the surface. Unit length, on the side the ray comes from.
    pub normal: DVec3,
    /// What light and mirrors see: [`Triangle::normals`] interpolated, elsewhere `normal`. Unit length,
    /// within a right angle of `normal`.
    pub shading_normal: DVec3,
    /// Index into [`Scene::materials`].
    pub material: u32,
    /// Of what was hit, in scene units a second.
    pub velocity: DVec3,
}

/// The nearest hit farther than `least`.
pub fn intersect(scene: &Scene, ray: Ray, least: f64) -> Option<Hit> {
    let spheres = crossings(&scene.spheres, ray, |shape, ray| flat(sphere(shape, ray, least)));
    let boxes = crossings(&scene.boxes, ray, |shape, ray| flat(aabb(shape, ray, least)));
    let triangles = crossings(&scene.triangles, ray, |shape, ray| triangle(shape, ray, least));
    let planes = crossings(&scene.planes, ray, |shape, ray| flat(plane(shape, ray, least)));
    let hits = spheres.chain(boxes).chain(planes).chain(triangles);
    hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Where the ray meets each shape. To a moving shape it is the ray that moves, the other way.
fn crossings<T>(
    shapes: &[Shaded<T>],
    ray: Ray,
    cross: impl Fn(&T, Ray) -> Option<(f64, DVec3, DVec3)>,
) -> impl Iterator<Item = Hit> {
    shapes.iter().filter_map(move |of| {
        let velocity = of.velocity.as_dvec3();
        let seen = Ray { origin: ray.origin - ray.time * velocity, ..ray };
        let (distance, outward, shading) = cross(&of.shape, seen)?;
        let side = if outward.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
        let (normal, shading_normal) = (side * outward, side * shading);
        Some(Hit { distance, normal, shading_normal, material: of.material, velocity })
    })
}

fn flat(crossing: Option<Crossing>) -> Option<(f64, DVec3, DVec3)> {
    crossing.map(|(distance, normal)| (distance, normal, normal))
}

/// Distance and normal.
type Crossing = (f64, DVec3);

/// |o + t d - c|^2 = r^2.
fn sphere(sphere: &Sphere, ray: Ray, least: f64) -> Option<Crossing> {
    let center = sphere.center;
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
fn aabb(aabb: &Aabb, ray: Ray, least: f64) -> Option<Crossing> {
    let (lower, upper) = (aabb.lower.to_array(), aabb.upper.to_array());
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let mut nearest: Option<Crossing> = None;
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

/// o + t d = a + b1 (b - a) + b2 (c - a), by Cramer's rule. Distance, normal, shading normal.
fn triangle(triangle: &Triangle, ray: Ray, least: f64) -> Option<(f64, DVec3, DVec3)> {
    let [a, b, c] = triangle.vertices;
    let (edge1, edge2) = (b - a, c - a);
    let matrix = DMat3::from_cols(edge1, edge2, -ray.direction);
    if matrix.determinant() == 0.0 {
        return None;
    }
    let [b1, b2, distance] = (matrix.inverse() * (ray.origin - a)).to_array();
    let inside = b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    (inside && distance > least).then(|| {
        let normal = edge1.cross(edge2).normalize();
        (distance, normal, shading_normal(triangle, b1, b2, normal))
    })
}

fn shading_normal(triangle: &Triangle, b1: f64, b2: f64, normal: DVec3) -> DVec3 {
    let Some(corners) = triangle.normals else {
        return normal;
    };
    let [n0, n1, n2] = corners.map(|corner| corner.as_dvec3());
    let mean = ((1.0 - b1 - b2) * n0 + b1 * n1 + b2 * n2).try_normalize().unwrap_or(normal);
    if mean.dot(normal) < 0.0 { -mean } else { mean }
}

/// n . (o + t d - p) = 0.
fn plane(plane: &Plane, ray: Ray, least: f64) -> Option<Crossing> {
    let normal = plane.normal.as_dvec3().normalize();
    let distance = normal.dot(plane.point - ray.origin) / normal.dot(ray.direction);
    (distance.is_finite() && distance > least).then_some((distance, normal))
}
