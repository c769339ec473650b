//! Lamps, chosen in proportion to their power: Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th edition,
//! section 12.

use crate::reference::Ray;
use crate::reference::intersect::Hit;
use crate::reference::sampler::in_cone;
use crate::reference::shape::{around, point};
use crate::scene::{Material, Scene, Shaded, Shape};
use glam::DVec3;
use std::f64::consts::TAU;

/// The lamps of a scene.
pub(in crate::reference) struct Lamps<'a> {
    /// Each with its radiance, and with the power of all lamps up to this one.
    lamps: Vec<(&'a Shaded, DVec3, f64)>,
}

/// A direction in which a lamp is seen.
pub(in crate::reference) struct LampSample {
    pub(in crate::reference) direction: DVec3,
    pub(in crate::reference) distance: f64,
    pub(in crate::reference) radiance: DVec3,
    /// Of the directions, per solid angle.
    pub(in crate::reference) density: f64,
}

pub(in crate::reference) fn luminance(radiance: DVec3) -> f64 {
    radiance.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// The solid angle of a sphere from a point outside, and the cosine at the edge of its cone.
fn cone(radius: f64, distance: f64) -> (f64, f64) {
    let cosine = (1.0 - (radius / distance).powi(2)).sqrt();
    (TAU * (1.0 - cosine), cosine)
}

impl<'a> Lamps<'a> {
    pub(in crate::reference) fn of(scene: &'a Scene) -> Self {
        let mut power = 0.0;
        let lamp = |of: &'a Shaded| {
            let Material::Emissive(material) = &scene.materials[of.material as usize] else { return None };
            let radiance = material.radiance.as_dvec3();
            let own = luminance(radiance) * of.shape.area()?;
            power += own;
            (own > 0.0).then_some((of, radiance, power))
        };
        Self { lamps: scene.shapes.iter().filter_map(lamp).collect() }
    }

    pub(in crate::reference) fn is_empty(&self) -> bool {
        self.lamps.is_empty()
    }

    fn power(&self) -> f64 {
        self.lamps.last().map_or(0.0, |(.., power)| *power)
    }

    /// A direction from a point towards a lamp, by four values in [0, 1). `None` without lamps.
    pub(in crate::reference) fn sample(&self, from: DVec3, time: f64, xi: [f64; 4]) -> Option<LampSample> {
        let (lamp, radiance, _) = self.lamps.iter().find(|(.., end)| xi[0] < end / self.power())?;
        let displacement = time * lamp.velocity.as_dvec3();
        let chance = luminance(*radiance) * lamp.shape.area()? / self.power();
        if let Shape::Sphere(sphere) = &lamp.shape {
            let (to_center, radius) = (sphere.center + displacement - from, f64::from(sphere.radius));
            if to_center.length() > radius {
                let (solid_angle, cosine) = cone(radius, to_center.length());
                let direction = around(to_center.normalize(), in_cone([xi[1], xi[2]], cosine));
                let along = to_center.dot(direction);
                let across = to_center.length_squared() - along * along;
                let distance = along - (radius * radius - across).max(0.0).sqrt();
                return Some(LampSample {
                    direction,
                    distance,
                    radiance: *radiance,
                    density: chance / solid_angle,
                });
            }
        }
        let (point, normal) = point(&lamp.shape, [xi[1], xi[2]])?;
        let to_point = point + displacement - from;
        let direction = to_point.normalize();
        let seen_area = lamp.shape.area()? * normal.dot(direction).abs() / to_point.length_squared();
        (seen_area > 0.0).then(|| LampSample {
            direction,
            distance: to_point.length(),
            radiance: *radiance,
            density: chance / seen_area,
        })
    }

    /// The density with which [`Lamps::sample`] chooses the direction of a ray that has met a lamp. Infinite shapes are
    /// not chosen.
    pub(in crate::reference) fn density(&self, ray: &Ray, hit: &Hit, radiance: DVec3) -> f64 {
        let Some(area) = hit.shape.area() else { return 0.0 };
        let chance = luminance(radiance) * area / self.power();
        match &hit.shape {
            Shape::Sphere(sphere) if !hit.from_behind => {
                let center = sphere.center + ray.time * hit.velocity;
                chance / cone(sphere.radius.into(), center.distance(ray.origin)).0
            }
            _ => {
                let seen_area = area * hit.normal.dot(ray.direction).abs() / (hit.distance * hit.distance);
                chance / seen_area
            }
        }
    }
}
