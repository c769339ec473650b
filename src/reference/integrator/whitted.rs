//! Whitted's integrator: direct light with hard shadows, ambient light, and mirrors. K. Suffern, chapters 14 to 16 and
//! 24.

use super::MIN_DISTANCE;
use crate::reference::Ray;
use crate::reference::intersect::intersect;
use crate::reference::light::{arriving, background};
use crate::reference::material::kind_of;
use crate::reference::surface::Surface;
use crate::scene::{Material, Scene};
use glam::DVec3;

/// The radiance that arrives along `ray`, with at most `bounces` reflections.
pub fn radiance(scene: &Scene, ray: Ray, bounces: u32) -> DVec3 {
    radiance_beyond(scene, ray, 0.0, bounces)
}

fn radiance_beyond(scene: &Scene, ray: Ray, min_distance: f64, bounces: u32) -> DVec3 {
    let Some(hit) = intersect(scene, ray, min_distance) else {
        return background(scene, ray.direction);
    };
    let material = &scene.materials[hit.material as usize];
    let surface = Surface::new(&ray, &hit);
    let min_distance = MIN_DISTANCE * surface.magnitude;
    let mut sum = emitted_and_reflected(scene, material, &surface, &ray, min_distance);
    if let Some((direction, weight)) = kind_of(material).mirrored(&surface, -ray.direction)
        && bounces > 0
    {
        let mirrored = Ray { origin: surface.position, direction, time: ray.time };
        sum += weight * radiance_beyond(scene, mirrored, min_distance, bounces - 1);
    }
    sum
}

fn emitted_and_reflected(
    scene: &Scene,
    material: &Material,
    surface: &Surface,
    ray: &Ray,
    min_distance: f64,
) -> DVec3 {
    let material = kind_of(material);
    let mut sum = material.emission() + material.ambient(surface) * scene.ambient.as_dvec3();
    for light in &scene.lights {
        let (to_light, light_distance) = arriving(&light.kind, surface.position);
        let cosine = surface.shading_normal.dot(to_light);
        let behind = surface.normal.dot(to_light) <= 0.0;
        let shadow_ray = Ray { origin: surface.position, direction: to_light, time: ray.time };
        let in_shadow = || {
            let blocker = intersect(scene, shadow_ray, min_distance);
            light.shadows && blocker.is_some_and(|hit| hit.distance < light_distance)
        };
        if cosine > 0.0 && !behind && !in_shadow() {
            sum += material.f(surface, to_light, -ray.direction) * light.radiance.as_dvec3() * cosine;
        }
    }
    sum
}
