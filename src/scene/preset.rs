//! Lenses that people know.

use super::{Camera, CameraModel, Lens, vfov_of_focal_length};

/// A lens, by its name.
#[derive(Debug, Clone, Copy)]
pub struct Preset {
    /// On the command line.
    pub name: &'static str,
    /// For people.
    pub label: &'static str,
    /// What it shows, in plain words.
    pub help: &'static str,
    opening: Opening,
}

#[derive(Debug, Clone, Copy)]
enum Opening {
    Pinhole,
    /// Of a lens that is focused at infinity on a 24 mm high frame.
    Photographic {
        focal_length_mm: f64,
        f_number: f64,
    },
    /// The field of view stays as it is: an eye has another for each thing that it looks at.
    Pupil {
        diameter_mm: f64,
    },
}

/// Every preset.
pub const PRESETS: [Preset; 6] = [
    Preset {
        name: "pinhole",
        label: "Pinhole",
        help: "A hole without size: everything is sharp, as in most computer graphics.",
        opening: Opening::Pinhole,
    },
    fifty(
        "50mm-f1.8",
        "50 mm f/1.8",
        "The normal lens that many photographers start with. Focused near by it frames a little wider than a real one: as 45.5 mm would at half a metre.",
        1.8,
    ),
    fifty("50mm-f1.4", "50 mm f/1.4", "Its wider sister: lets in 1.7 times the light, and blurs more.", 1.4),
    fifty("50mm-f1.2", "50 mm f/1.2", "As wide as such lenses come: little more than a plane is sharp.", 1.2),
    Preset {
        name: "eye-2mm",
        label: "Eye, 2 mm pupil",
        help: "The pupil of an eye in bright light.",
        opening: Opening::Pupil { diameter_mm: 2.0 },
    },
    Preset {
        name: "eye-8mm",
        label: "Eye, 8 mm pupil",
        help: "The pupil of a young eye in the dark: it sees less depth sharp.",
        opening: Opening::Pupil { diameter_mm: 8.0 },
    },
];

const fn fifty(name: &'static str, label: &'static str, help: &'static str, f_number: f64) -> Preset {
    Preset { name, label, help, opening: Opening::Photographic { focal_length_mm: 50.0, f_number } }
}

impl Preset {
    /// The preset of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// Puts the lens in front of the camera. What is in focus stays in focus.
    pub fn apply(&self, camera: &mut Camera, model: &mut CameraModel, lens: &mut Lens) {
        *model = CameraModel::ThinLens;
        match self.opening {
            Opening::Pinhole => *model = CameraModel::Pinhole,
            Opening::Photographic { focal_length_mm, f_number } => {
                camera.vfov_radians = vfov_of_focal_length(focal_length_mm);
                lens.diameter = camera.diameter_of_f_number(f_number) as f32;
            }
            Opening::Pupil { diameter_mm } => lens.diameter = camera.units_of_mm(diameter_mm) as f32,
        }
    }
}
