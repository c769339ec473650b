//! Radiance along a ray: K. Suffern, chapters 14 to 16 and 24.

use super::Ray;
use super::intersect::{Hit, intersect};
use crate::scene::{LightKind, Material, Scene};
use glam::DVec3;
use std::f64::consts::PI;

/// How far a secondary ray must go before it hits, as a share of the coordinates at hand: the
/// rounding error of f64 with room to spare.
const LEAST_DISTANCE: f64 = 1e-10;

/// What f64 may lose of a point of a flat surface, as a share of the coordinates at hand.
const ROUNDING: f64 = 1e-12;

/// What arrives along `ray`, with at most `bounces` reflections.
pub fn radiance(scene: &Scene, ray: Ray, bounces: u32) -> DVec3 {
    radiance_beyond(scene, ray, 0.0, bounces)
}

fn radiance_beyond(scene: &Scene, ray: Ray, least: f64, bounces: u32) -> DVec3 {
    let Some(hit) = intersect(scene, ray, least) else {
        return background(scene, ray.direction);
    };
    let material = &scene.materials[hit.material as usize];
    let position = ray.origin + hit.distance * ray.direction;
    let least = LEAST_DISTANCE * position.abs().max_element().max(hit.distance);
    let mut sum = emitted_and_reflected(scene, material, position, &hit, &ray, least);
    if bounces > 0 && material.reflectance != glam::Vec3::ZERO {
        let direction = mirrored(&hit, ray.direction);
        let mirrored = Ray { origin: position, direction, time: ray.time };
        sum += material.reflectance.as_dvec3() * radiance_beyond(scene, mirrored, least, bounces - 1);
    }
    sum
}

/// Mirrored by the shading normal; what would then enter the surface is mirrored out of it again.
fn mirrored(hit: &Hit, direction: DVec3) -> DVec3 {
    let mirrored = direction - 2.0 * direction.dot(hit.shading_normal) * hit.shading_normal;
    mirrored - 2.0 * mirrored.dot(hit.normal).min(0.0) * hit.normal
}

fn background(scene: &Scene, direction: DVec3) -> DVec3 {
    let height = direction.y.clamp(0.0, 1.0);
    let (horizon, zenith) = (scene.background.horizon.as_dvec3(), scene.background.zenith.as_dvec3());
    horizon.lerp(zenith, height * (2.0 - height))
}

fn emitted_and_reflected(
    scene: &Scene,
    material: &Material,
    position: DVec3,
    hit: &Hit,
    ray: &Ray,
    least: f64,
) -> DVec3 {
    let (to_viewer, time) = (-ray.direction, ray.time);
    // A shape takes its colours along.
    let rounding = ROUNDING * position.abs().max_element().max(hit.distance);
    let color = color(material, position - time * hit.velocity, rounding);
    let mut sum = material.emission.as_dvec3() + f64::from(material.ka) * color * scene.ambient.as_dvec3();
    for light in &scene.lights {
        let (to_light, light_distance) = match light.kind {
            LightKind::Directional(direction) => (direction.as_dvec3().normalize(), f64::INFINITY),
            LightKind::Point(at) => {
                let path = at - position;
                (path.normalize(), path.length())
            }
        };
        let cosine = hit.shading_normal.dot(to_light);
        let behind = hit.normal.dot(to_light) <= 0.0;
        let shadow_ray = Ray { origin: position, direction: to_light, time };
        let in_shadow = || {
            let blocker = intersect(scene, shadow_ray, least);
            light.shadows && blocker.is_some_and(|hit| hit.distance < light_distance)
        };
        if cosine <= 0.0 || behind || in_shadow() {
            continue;
        }
        let mirrored = 2.0 * cosine * hit.shading_normal - to_light;
        let highlight = mirrored.dot(to_viewer);
        let gloss = if material.ks > 0.0 && highlight > 0.0 {
            f64::from(material.ks) * highlight.powf(f64::from(material.exponent))
        } else {
            0.0
        };
        let diffuse = f64::from(material.kd) / PI * color;
        sum += (diffuse + gloss) * light.radiance.as_dvec3() * cosine;
    }
    sum
}

/// A point on the boundary of two cells belongs to the lower one, also where it is `rounding` above.
fn color(material: &Material, position: DVec3, rounding: f64) -> DVec3 {
    let odd = material.checker.as_ref().filter(|checker| {
        let cells = ((position - rounding) / checker.size).floor();
        (cells.x + cells.y + cells.z).rem_euclid(2.0) == 1.0
    });
    odd.map_or(material.color, |checker| checker.odd_color).as_dvec3()
}
