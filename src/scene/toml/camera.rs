//! The table `[camera]`.

use super::fault::{Fault, fault, named};
use super::number::{NonNegative, Positive, Vector};
use crate::scene::{
    Aperture, ApertureImage, Camera, CameraModel, DEFAULT_SHUTTER, Hole, Lens, METRES_PER_UNIT, PRESETS,
    VFOV_DEGREES, View,
};
use glam::DVec3;
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraTable {
    eye: Vector,
    look_at: Vector,
    #[serde(default = "upwards")]
    up: Vector,
    preset: Option<Spanned<String>>,
    vfov_degrees: Option<Positive>,
    view_distance: Option<Positive>,
    pixel_size: Option<Positive>,
    #[serde(default = "unit")]
    metres_per_unit: f64,
    model: Option<Spanned<String>>,
    lens_diameter: Option<NonNegative>,
    f_number: Option<Positive>,
    focal_distance: Positive,
    hole_diameter: Option<NonNegative>,
    #[serde(default)]
    upright: bool,
    blades: Option<u32>,
    blade_rotation_degrees: Option<f32>,
    roundness: Option<f32>,
    anamorphic: Option<f32>,
    cats_eye: Option<f32>,
    aperture_image: Option<Spanned<String>>,
    shutter: Option<Positive>,
    iso: Option<Positive>,
}

const NEEDS_VFOV: &str = "the camera needs either vfov_degrees, or view_distance and pixel_size, or a preset that has a field of view";

fn unit() -> f64 {
    1.0
}

fn upwards() -> Vector {
    Vector(DVec3::Y)
}

/// What the camera's table says.
pub(super) struct Shot {
    pub(super) camera: Camera,
    pub(super) model: CameraModel,
    pub(super) lens: Lens,
    pub(super) hole: Hole,
    pub(super) aperture: Aperture,
    pub(super) shutter: f32,
    pub(super) iso: f32,
}

impl Shot {
    /// Of a picture that is so large. An image of the aperture lies in `folder`, unless its path says otherwise.
    pub(super) fn new(table: &Spanned<CameraTable>, size: [u32; 2], folder: &Path) -> Result<Self, Fault> {
        let span = table;
        let table = table.get_ref();
        let preset = table.preset.as_ref();
        let preset = preset
            .map(|name| named(&PRESETS.map(|preset| (preset.name, preset)), name, "preset"))
            .transpose()?;
        if !METRES_PER_UNIT.contains(&table.metres_per_unit) {
            let (low, high) = (METRES_PER_UNIT.start(), METRES_PER_UNIT.end());
            let message =
                format!("metres_per_unit is {}, but must be from {low:e} to {high:e}", table.metres_per_unit);
            return Err(fault(span, &message));
        }

        let (eye, look_at, up) = (table.eye.0, table.look_at.0, table.up.0);
        let mut camera =
            Camera { eye, look_at, up, vfov_radians: f64::NAN, metres_per_unit: table.metres_per_unit };
        let mut model = CameraModel::default();
        let mut lens = Lens { diameter: f32::NAN, focal_distance: table.focal_distance.f32() };
        let vfov_radians = table.vfov_radians(size).map_err(|message| fault(span, message))?;
        if let Some(preset) = preset {
            preset.apply(&mut camera, &mut model, &mut lens);
        }
        // What is given beside a preset changes it.
        camera.vfov_radians = vfov_radians.unwrap_or(camera.vfov_radians);
        if camera.vfov_radians.is_nan() {
            return Err(fault(span, NEEDS_VFOV));
        }
        if !VFOV_DEGREES.contains(&camera.vfov_radians.to_degrees()) {
            let degrees = camera.vfov_radians.to_degrees();
            let (low, high) = (VFOV_DEGREES.start(), VFOV_DEGREES.end());
            let message =
                format!("a vertical field of view of {degrees} degrees must be from {low} to {high}");
            return Err(fault(span, &message));
        }
        if let Some(message) = camera.fault() {
            return Err(fault(span, message));
        }
        if let Some(name) = &table.model {
            model = named(&CameraModel::NAMES, name, "camera model")?;
        }
        match (&table.lens_diameter, &table.f_number) {
            (Some(diameter), None) => lens.diameter = diameter.0,
            (None, Some(f_number)) => lens.diameter = camera.diameter_of_f_number(f_number.f64()) as f32,
            (None, None) if model == CameraModel::Pinhole && lens.diameter.is_nan() => lens.diameter = 0.0,
            (None, None) if !lens.diameter.is_nan() => {}
            _ => return Err(fault(span, "the camera needs either lens_diameter, f_number or a preset")),
        }
        let hole = table.hole_diameter.as_ref();
        let diameter = hole.map_or(camera.default_hole_diameter(), |diameter| diameter.0);
        Ok(Self {
            camera,
            model,
            lens,
            hole: Hole { diameter, upright: table.upright },
            aperture: aperture(span, folder)?,
            shutter: table.shutter.as_ref().map_or(DEFAULT_SHUTTER, Positive::f32),
            iso: table.iso.as_ref().map_or(View::default().iso, Positive::f32),
        })
    }
}

impl CameraTable {
    /// The vertical field of view, if the table gives one.
    fn vfov_radians(&self, size: [u32; 2]) -> Result<Option<f64>, &'static str> {
        match (&self.vfov_degrees, &self.view_distance, &self.pixel_size) {
            (None, None, None) => Ok(None),
            (Some(degrees), None, None) => Ok(Some(degrees.f64().to_radians())),
            (None, Some(distance), Some(pixel)) => {
                let half_height = 0.5 * f64::from(size[1]) * pixel.f64();
                Ok(Some(2.0 * (half_height / distance.f64()).atan()))
            }
            _ => Err(NEEDS_VFOV),
        }
    }
}

fn aperture(table: &Spanned<CameraTable>, folder: &Path) -> Result<Aperture, Fault> {
    let CameraTable {
        blades, blade_rotation_degrees, roundness, anamorphic, cats_eye, aperture_image, ..
    } = table.get_ref();
    let read = |file: &Spanned<String>| {
        let image = ApertureImage::read(&folder.join(file.get_ref()));
        image.map_err(|error| fault(file, &error.to_string()))
    };
    let plain = Aperture::default();
    let aperture = Aperture {
        blades: blades.unwrap_or(plain.blades),
        rotation_degrees: blade_rotation_degrees.unwrap_or(plain.rotation_degrees),
        roundness: roundness.unwrap_or(plain.roundness),
        anamorphic: anamorphic.unwrap_or(plain.anamorphic),
        cats_eye: cats_eye.unwrap_or(plain.cats_eye),
        image: aperture_image.as_ref().map(read).transpose()?,
    };
    match aperture.fault() {
        Some(message) => Err(fault(table, &message)),
        None => Ok(aperture),
    }
}
