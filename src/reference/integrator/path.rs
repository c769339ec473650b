//! Path tracing: J. Kajiya, "The Rendering Equation", SIGGRAPH 1986.

use super::{Limits, MIN_DISTANCE, PathValues};
use crate::reference::Ray;
use crate::reference::intersect::intersect;
use crate::reference::light::background;
use crate::reference::material::kind_of;
use crate::reference::sampler::Use;
use crate::reference::surface::Surface;
use crate::scene::Scene;
use glam::DVec3;

/// The radiance that arrives along `ray`.
pub(super) fn radiance(scene: &Scene, ray: Ray, limits: &Limits, values: PathValues<'_>) -> DVec3 {
    radiance_after(scene, ray, 0.0, DVec3::ONE, 0, limits, values)
}

/// The radiance along a ray that has bounced so often. `importance` is the share of this radiance that reaches the lens;
/// it decides only how probably the path goes on.
fn radiance_after(
    scene: &Scene,
    ray: Ray,
    min_distance: f64,
    importance: DVec3,
    bounce: u32,
    limits: &Limits,
    values: PathValues<'_>,
) -> DVec3 {
    let Some(hit) = intersect(scene, ray, min_distance) else {
        return background(scene, ray.direction);
    };
    let material = kind_of(&scene.materials[hit.material as usize]);
    let surface = Surface::new(&ray, &hit);
    let emitted = material.emission();
    if bounce == limits.max_bounces {
        return emitted;
    }
    let [first, second, third, chance] = values(bounce, Use::Direction);
    let Some((direction, weight)) = material.sample(&surface, -ray.direction, [first, second, third]) else {
        return emitted;
    };
    let survival = survival((importance * weight).max_element(), bounce);
    if chance >= survival {
        return emitted;
    }
    let weight = weight / survival;
    let further = Ray { origin: surface.position, direction, time: ray.time };
    let min_distance = MIN_DISTANCE * surface.magnitude;
    let arriving =
        radiance_after(scene, further, min_distance, importance * weight, bounce + 1, limits, values);
    emitted + weight * arriving
}

/// The probability that a path goes on. Paths of one or two surfaces do, unless they carry nothing.
fn survival(most: f64, bounce: u32) -> f64 {
    match bounce {
        0 | 1 if most > 0.0 => 1.0,
        _ => most.min(0.95),
    }
}
