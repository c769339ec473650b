//! Presets: well-known lenses.

use super::{Camera, CameraModel, Lens, vfov_of_focal_length};

/// A well-known lens.
#[derive(Debug, Clone, Copy)]
pub struct Preset {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its name in the panel.
    pub label: &'static str,
    /// A description in plain words.
    pub help: &'static str,
    effect: Effect,
}

#[derive(Debug, Clone, Copy)]
enum Effect {
    Pinhole,
    /// A lens of this focal length and f-number, focused at infinity, with a frame that is 24 mm high.
    Photographic {
        focal_length_mm: f64,
        f_number: f64,
    },
    /// The pupil of an eye. The field of view stays as it is, because that of an eye depends on what it looks at.
    Pupil {
        diameter_mm: f64,
    },
}

/// Every preset.
pub const PRESETS: [Preset; 6] = [
    Preset {
        name: "pinhole",
        label: "Pinhole",
        help: "A hole of no size: everything is sharp, as in most computer graphics.",
        effect: Effect::Pinhole,
    },
    fifty(
        "50mm-f1.8",
        "50 mm f/1.8",
        "The normal lens that many photographers start with. Focused at close range, it has a wider field of view than a real one: that of 45.5 mm at half a metre.",
        1.8,
    ),
    fifty("50mm-f1.4", "50 mm f/1.4", "A wider lens: it lets in 1.7 times the light, and blurs more.", 1.4),
    fifty(
        "50mm-f1.2",
        "50 mm f/1.2",
        "About as wide as such lenses get: little more than a plane is sharp.",
        1.2,
    ),
    Preset {
        name: "eye-2mm",
        label: "Eye, 2 mm pupil",
        help: "The pupil of an eye in bright light.",
        effect: Effect::Pupil { diameter_mm: 2.0 },
    },
    Preset {
        name: "eye-8mm",
        label: "Eye, 8 mm pupil",
        help: "The pupil of a young eye in the dark: its depth of field is smaller.",
        effect: Effect::Pupil { diameter_mm: 8.0 },
    },
];

const fn fifty(name: &'static str, label: &'static str, help: &'static str, f_number: f64) -> Preset {
    Preset { name, label, help, effect: Effect::Photographic { focal_length_mm: 50.0, f_number } }
}

impl Preset {
    /// The preset of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// Puts the lens on the camera. What is in focus stays in focus.
    pub fn apply(&self, camera: &mut Camera, model: &mut CameraModel, lens: &mut Lens) {
        *model = CameraModel::ThinLens;
        match self.effect {
            Effect::Pinhole => *model = CameraModel::Pinhole,
            Effect::Photographic { focal_length_mm, f_number } => {
                camera.vfov_radians = vfov_of_focal_length(focal_length_mm);
                lens.diameter = camera.diameter_of_f_number(f_number) as f32;
            }
            Effect::Pupil { diameter_mm } => lens.diameter = camera.units_of_mm(diameter_mm) as f32,
        }
    }
}
