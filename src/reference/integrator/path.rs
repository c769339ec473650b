//! Path tracing: J. Kajiya, "The Rendering Equation", SIGGRAPH 1986.

use super::{Limits, MIN_DISTANCE, PathValues};
use crate::reference::Ray;
use crate::reference::intersect::intersect;
use crate::reference::light::lamps::{LampSample, Lamps, luminance};
use crate::reference::light::sky;
use crate::reference::material::{Kind, Scatter, kind_of};
use crate::reference::sampler::Use;
use crate::reference::surface::Surface;
use crate::scene::{Glass, Material, Scene};
use glam::DVec3;

/// The radiance that arrives along `ray`.
pub(super) fn radiance(scene: &Scene, ray: Ray, limits: &Limits, values: PathValues<'_>) -> DVec3 {
    Path { scene, lamps: Lamps::of(scene), limits, values }.radiance(
        ray,
        0.0,
        DVec3::ONE,
        Bounces::default(),
        &[],
        None,
    )
}

/// What stays the same along a path.
struct Path<'a> {
    scene: &'a Scene,
    lamps: Lamps<'a>,
    limits: &'a Limits,
    values: PathValues<'a>,
}

/// How often a path has been scattered.
#[derive(Clone, Copy, Default)]
struct Bounces {
    all: u32,
    /// By surfaces that spread light.
    diffuse: u32,
}

impl Path<'_> {
    /// The radiance along a ray that has bounced so often. `importance` is the share of this radiance that reaches the
    /// lens; it decides only how probably the path goes on. The ray is inside of the bodies with the materials `inside`,
    /// the last of which it has entered last. Its direction was chosen with this density, unless it was the only one.
    fn radiance(
        &self,
        ray: Ray,
        min_distance: f64,
        importance: DVec3,
        bounces: Bounces,
        inside: &[u32],
        density: Option<f64>,
    ) -> DVec3 {
        let Some(hit) = intersect(self.scene, ray, min_distance) else {
            let seen = sky::radiance(&self.scene.background, ray.direction);
            let sampled = self.scene.background.panorama().zip(density);
            return sampled.map_or(seen, |(panorama, density)| {
                share(density, self.share_of_sky() * sky::density(panorama, ray.direction)) * seen
            });
        };
        let left = self.left_after(hit.distance, inside);
        let importance = importance * left;
        let material = &self.scene.materials[hit.material as usize];
        let mut surface = Surface::new(&ray, &hit);
        let mut beyond = inside.to_vec();
        if matches!(material, Material::Glass(_)) {
            if surface.from_behind {
                if let Some(at) = beyond.iter().rposition(|body| *body == hit.material) {
                    beyond.remove(at);
                }
            } else {
                beyond.push(hit.material);
            }
            surface.index_ratio = self.index(&beyond) / self.index(inside);
        }
        let material = kind_of(material);
        let mut emitted = material.emission();
        if let Some(density) = density.filter(|_| emitted != DVec3::ZERO) {
            emitted *= share(density, (1.0 - self.share_of_sky()) * self.lamps.density(&ray, &hit, emitted));
        }
        if bounces.all == self.limits.max_bounces {
            return left * emitted;
        }
        let may_spread = bounces.diffuse < self.limits.diffuse_bounces;
        let min_distance = MIN_DISTANCE * surface.magnitude;
        let direct = if may_spread {
            self.direct_light(material, &surface, &ray, min_distance, bounces.all, inside)
        } else {
            DVec3::ZERO
        };
        let shown = left * (emitted + direct);
        let [first, second, third, chance] = (self.values)(bounces.all, Use::Direction);
        let Some(Scatter { direction, weight, density }) =
            material.sample(&surface, -ray.direction, [first, second, third])
        else {
            return shown;
        };
        let spreads = density.is_some();
        let survival = survival((importance * weight).max_element(), bounces.all);
        if chance >= survival || (spreads && !may_spread) {
            return shown;
        }
        let weight = weight / survival;
        let further = Ray { origin: surface.position, direction, time: ray.time };
        let passes = direction.dot(surface.normal) < 0.0;
        let inside = if passes { &beyond } else { inside };
        let importance = importance * weight;
        let next = Bounces { all: bounces.all + 1, diffuse: bounces.diffuse + u32::from(spreads) };
        let found = left * weight * self.radiance(further, min_distance, importance, next, inside, density);
        let most = if bounces.all == 0 { self.limits.most_indirect } else { f64::INFINITY };
        shown + found * (most / luminance(found)).min(1.0)
    }

    /// The share of light samples that go to the sky.
    fn share_of_sky(&self) -> f64 {
        match (self.scene.background.panorama(), self.lamps.is_empty()) {
            (None, _) => 0.0,
            (Some(_), true) => 1.0,
            (Some(_), false) => 0.5,
        }
    }

    /// A direction from a point in which the sky or a lamp can be seen.
    fn sample_light(&self, from: DVec3, time: f64, xi: [f64; 4]) -> Option<LampSample> {
        let of_sky = self.share_of_sky();
        match self.scene.background.panorama() {
            Some(panorama) if xi[3] < of_sky => {
                let (direction, density) = sky::sample(panorama, [xi[1], xi[2]]);
                let radiance = sky::radiance(&self.scene.background, direction);
                Some(LampSample { direction, distance: f64::INFINITY, radiance, density: of_sky * density })
            }
            _ => {
                let lamp = self.lamps.sample(from, time, xi)?;
                Some(LampSample { density: (1.0 - of_sky) * lamp.density, ..lamp })
            }
        }
    }

    /// The light of a lamp or of the sky that the surface scatters back along the ray.
    fn direct_light(
        &self,
        material: &dyn Kind,
        surface: &Surface,
        ray: &Ray,
        min_distance: f64,
        bounce: u32,
        inside: &[u32],
    ) -> DVec3 {
        let values = || (self.values)(bounce, Use::Light);
        let Some(lamp) = self.sample_light(surface.position, ray.time, values()) else {
            return DVec3::ZERO;
        };
        let in_front =
            surface.normal.dot(lamp.direction) > 0.0 && surface.shading_normal.dot(lamp.direction) > 0.0;
        let scattered = material.scattered(surface, lamp.direction, -ray.direction).filter(|_| in_front);
        let Some((reflected, density)) = scattered else {
            return DVec3::ZERO;
        };
        let shadow_ray = Ray { origin: surface.position, direction: lamp.direction, time: ray.time };
        let blocker = intersect(self.scene, shadow_ray, min_distance);
        if blocker.is_some_and(|hit| hit.distance < 0.9999 * lamp.distance) {
            return DVec3::ZERO;
        }
        let arriving = self.left_after(lamp.distance, inside) * lamp.radiance;
        share(lamp.density, density) * reflected * arriving / lamp.density
    }

    /// The body that a ray entered last, if it is inside of any.
    fn body(&self, inside: &[u32]) -> Option<&Glass> {
        match inside.last().map(|body| &self.scene.materials[*body as usize]) {
            Some(Material::Glass(body)) => Some(body),
            _ => None,
        }
    }

    fn index(&self, inside: &[u32]) -> f64 {
        self.body(inside).map_or(1.0, |body| body.index.into())
    }

    /// The share of light that is left after this distance, by Beer's law.
    fn left_after(&self, distance: f64, inside: &[u32]) -> DVec3 {
        self.body(inside).map_or(DVec3::ONE, |body| {
            body.color.as_dvec3().max(DVec3::splat(1e-6)).powf(distance / f64::from(body.color_distance))
        })
    }
}

/// The share that a sample counts whose direction another strategy chooses with the other density: the power heuristic of
/// E. Veach, 1997.
fn share(own: f64, other: f64) -> f64 {
    own.powi(2) / (own.powi(2) + other.powi(2))
}

/// The probability that a path goes on. Paths of one or two surfaces do, unless they carry nothing.
fn survival(most: f64, bounce: u32) -> f64 {
    match bounce {
        0 | 1 if most > 0.0 => 1.0,
        _ => most.min(0.95),
    }
}
