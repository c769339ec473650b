//! Presets: well-known lenses.

use super::{Camera, CameraModel, Lens, Sensor};

/// The focal length of an eye in air: its film, the retina, is 17 mm behind a lens that would do the same in air.
const EYE_MM: f64 = 17.0;

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
    /// A lens of this focal length and f-number. The sensor stays, but for the eye's, which becomes full frame.
    Photographic {
        focal_length_mm: f64,
        f_number: f64,
    },
    /// An eye with a pupil of this diameter, and its own film and field of view.
    Eye {
        pupil_mm: f64,
    },
}

/// Every preset.
pub static PRESETS: [Preset; 6] = [
    Preset {
        name: "pinhole",
        label: "Pinhole",
        help: "A hole of no size: everything is sharp, as in most computer graphics.",
        effect: Effect::Pinhole,
    },
    fifty(
        "50mm-f1.8",
        "50 mm f/1.8",
        "The normal lens that many photographers start with. Focused at close range, it has a wider field of view than a real one: that of 45.5 mm at half a metre. Focus breathing makes it that of a real one.",
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
        help: "An eye in bright light: f/8.5, with a film 17 mm behind the lens.",
        effect: Effect::Eye { pupil_mm: 2.0 },
    },
    Preset {
        name: "eye-8mm",
        label: "Eye, 8 mm pupil",
        help: "A young eye in the dark: f/2.1. Its depth of field is smaller.",
        effect: Effect::Eye { pupil_mm: 8.0 },
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

    /// The preset that is on the camera, if one is.
    pub fn on(camera: &Camera, model: CameraModel, lens: &Lens) -> Option<&'static Self> {
        PRESETS.iter().find(|preset| {
            let (mut same_camera, mut same_model, mut same_lens) = (*camera, model, *lens);
            preset.apply(&mut same_camera, &mut same_model, &mut same_lens);
            (same_camera, same_model, same_lens) == (*camera, model, *lens)
        })
    }

    /// Whether photographers know the lens by its f-number.
    pub fn has_f_number(&self) -> bool {
        matches!(self.effect, Effect::Photographic { .. })
    }

    /// Puts the lens on the camera. What is in focus stays in focus.
    pub fn apply(&self, camera: &mut Camera, model: &mut CameraModel, lens: &mut Lens) {
        *model = CameraModel::ThinLens;
        match self.effect {
            Effect::Pinhole => *model = CameraModel::Pinhole,
            Effect::Photographic { focal_length_mm, f_number } => {
                if camera.sensor == Sensor::EYE {
                    camera.sensor = Sensor::FULL_FRAME;
                }
                camera.set_focal_length_mm(focal_length_mm);
                lens.diameter = camera.diameter_of_f_number(f_number) as f32;
            }
            Effect::Eye { pupil_mm } => {
                camera.sensor = Sensor::EYE;
                camera.set_focal_length_mm(EYE_MM);
                lens.diameter = camera.units_of_mm(pupil_mm) as f32;
            }
        }
    }
}
