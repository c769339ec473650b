//! The integrators, and what each of them can render.

use super::Scene;
use glam::Vec3;

const NO_AMBIENT: &str = "knows no ambient light, because light comes from lamps and from the sky: leave out [ambient], \
                          and give [background] a color";
const NO_LIGHTS: &str = "knows no lights without extent: leave out [[point]] and [[directional]], and use emissive \
                         materials and [background]";

const NO_PANORAMA: &str =
    "does not show an image as the background: use the integrator path, or give [background] a color";

/// What finds the radiance along a ray. Each has a file with its name in `shaders/integrator`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Integrator {
    /// Direct light with hard shadows, ambient light, and mirrors: T. Whitted, and Suffern, chapters 14 to 16 and 24.
    #[default]
    Whitted,
    /// Path tracing: light that arrives by any number of reflections. J. Kajiya, "The Rendering Equation", SIGGRAPH
    /// 1986.
    Path,
}

impl Integrator {
    /// Every integrator, by its name.
    pub const NAMES: [(&'static str, Self); 2] = [("whitted", Self::Whitted), ("path", Self::Path)];

    /// How often light is scattered, if a scene does not say so: mirrors and glass need more than Suffern's scenes.
    pub(super) fn default_max_bounces(self) -> u32 {
        match self {
            Self::Whitted => 5,
            Self::Path => 16,
        }
    }

    /// Says what in a scene this integrator cannot render, and what to use instead, if there is anything.
    ///
    /// # Errors
    /// The reason, as a part of a sentence after the name of the integrator.
    pub fn can_render(self, scene: &Scene) -> Result<(), String> {
        if self == Self::Path && scene.ambient != Vec3::ZERO {
            return Err(NO_AMBIENT.into());
        }
        if self == Self::Path && !scene.lights.is_empty() {
            return Err(NO_LIGHTS.into());
        }
        if self == Self::Whitted && scene.background.panorama().is_some() {
            return Err(NO_PANORAMA.into());
        }
        let named = scene.materials.iter().zip(&scene.material_names);
        let refused = named.filter_map(|(material, name)| Some((material.refusal(self)?, name)));
        let mut reasons =
            refused.map(|(reason, name)| format!("cannot render the material {name}: {reason}"));
        reasons.next().map_or(Ok(()), Err)
    }
}
