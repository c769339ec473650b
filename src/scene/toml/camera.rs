//! The table `[camera]`.

use super::error::{ParseError, named};
use super::number::Vector;
use super::quantity::{Quantities, Quantity};
use crate::scene::{
    ABBE_NUMBERS, ANAMORPHICS, Aperture, ApertureImage, BLADES, CATS_EYES, Camera, CameraModel,
    DEFAULT_SHUTTER, DIAMETERS, F_NUMBERS, FOCAL_DISTANCES, FOCAL_LENGTHS_MM, Hole, ISOS, Lens, MAX_LENGTH,
    METRES_PER_UNIT, MIN_LENGTH, PRESETS, PROFILES, ROTATIONS, ROUNDNESSES, SHIFTS_MM, SHUTTERS, Sensor,
    TILTS, VFOV_DEGREES, View, in_range, in_range_or_zero,
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
    sensor: Option<Spanned<String>>,
    vfov_degrees: Option<Spanned<Quantity>>,
    focal_length: Option<Spanned<Quantity>>,
    #[serde(default)]
    focus_breathing: bool,
    lens_shift: Option<Spanned<Quantity>>,
    lens_rise: Option<Spanned<Quantity>>,
    lens_tilt_degrees: Option<Spanned<Quantity>>,
    tilt_direction_degrees: Option<Spanned<Quantity>>,
    abbe_number: Option<Spanned<u32>>,
    view_distance: Option<Spanned<Quantity>>,
    pixel_size: Option<Spanned<Quantity>>,
    metres_per_unit: Option<Spanned<Quantity>>,
    model: Option<Spanned<String>>,
    lens_diameter: Option<Spanned<Quantity>>,
    f_number: Option<Spanned<Quantity>>,
    focal_distance: Spanned<Quantity>,
    hole_diameter: Option<Spanned<Quantity>>,
    #[serde(default)]
    upright: bool,
    blades: Option<Spanned<u32>>,
    blade_rotation_degrees: Option<Spanned<Quantity>>,
    roundness: Option<Spanned<Quantity>>,
    anamorphic: Option<Spanned<Quantity>>,
    cats_eye: Option<Spanned<Quantity>>,
    aperture_image: Option<Spanned<String>>,
    bokeh_profile: Option<Spanned<Quantity>>,
    shutter: Option<Spanned<Quantity>>,
    iso: Option<Spanned<Quantity>>,
}

const NEEDS_VFOV: &str = "the camera needs either vfov_degrees, or focal_length, or view_distance and pixel_size, or a preset that has a field of view";

fn upwards() -> Vector {
    Vector(DVec3::Y)
}

/// What the table `[camera]` describes.
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
    /// Reads the table, for a picture of this size. The path of an aperture image is relative to `folder`.
    pub(super) fn new(
        table: &Spanned<CameraTable>,
        size: [u32; 2],
        folder: &Path,
    ) -> Result<Self, ParseError> {
        let span = table;
        let table = table.get_ref();
        let preset = table.preset.as_ref();
        let preset = preset
            .map(|name| named(&PRESETS.map(|preset| (preset.name, preset)), name, "preset"))
            .transpose()?;
        let metres = Quantities { metres_per_unit: 1.0 };
        let metres_per_unit = table.metres_per_unit.as_ref();
        let metres_per_unit =
            metres.double("metres_per_unit", metres_per_unit, METRES_PER_UNIT)?.unwrap_or(1.0);
        let numbers = Quantities { metres_per_unit };
        let (eye, look_at, up) = (table.eye.0, table.look_at.0, table.up.0);
        let sensor = table.sensor.as_ref().map(sensor).transpose()?.unwrap_or(Sensor::FULL_FRAME);
        let focus_breathing = table.focus_breathing;
        let shift = numbers.single("lens_shift", table.lens_shift.as_ref(), SHIFTS_MM)?.unwrap_or(0.0);
        let rise = numbers.single("lens_rise", table.lens_rise.as_ref(), SHIFTS_MM)?.unwrap_or(0.0);
        let lens_shift_mm = [shift, rise];
        let mut camera = Camera {
            eye,
            look_at,
            up,
            vfov_radians: f64::NAN,
            metres_per_unit,
            sensor,
            focus_breathing,
            lens_shift_mm,
        };
        let mut model = CameraModel::default();
        let focal_distance =
            numbers.single("focal_distance", Some(&table.focal_distance), FOCAL_DISTANCES)?;
        let mut lens = Lens::new(f32::NAN, focal_distance.unwrap_or(f32::NAN));
        lens.tilt_degrees =
            numbers.single("lens_tilt_degrees", table.lens_tilt_degrees.as_ref(), TILTS)?.unwrap_or(0.0);
        let direction = table.tilt_direction_degrees.as_ref();
        if let Some(number) = &table.abbe_number {
            lens.abbe_number = *number.get_ref();
            in_range_or_zero(lens.abbe_number, ABBE_NUMBERS, "a lens without colour errors")
                .map_err(|wrong| ParseError::at(number, &format!("abbe_number {wrong}")))?;
        }
        lens.tilt_direction_degrees =
            numbers.single("tilt_direction_degrees", direction, ROTATIONS)?.unwrap_or(0.0);
        let given_vfov = vfov_radians(span, &numbers, size, &sensor)?;
        if let Some(preset) = preset {
            preset.apply(&mut camera, &mut model, &mut lens);
        }
        // Other keys change what the preset gives.
        if table.sensor.is_some() {
            camera.sensor = sensor;
        }
        camera.vfov_radians = given_vfov.unwrap_or(camera.vfov_radians);
        if camera.vfov_radians.is_nan() {
            return Err(ParseError::at(span, NEEDS_VFOV));
        }
        // The angle may come from `view_distance` or from the preset, whose ranges are not checked otherwise.
        in_range(camera.vfov_radians.to_degrees(), VFOV_DEGREES).map_err(|wrong| {
            ParseError::at(span, &format!("the vertical field of view in degrees {wrong}"))
        })?;
        camera.validate(|| ["eye", "look_at", "up"]).map_err(|message| ParseError::at(span, &message))?;
        if let Some(name) = &table.model {
            model = named(&CameraModel::NAMES, name, "camera model")?;
        }
        let diameter = numbers.single("lens_diameter", table.lens_diameter.as_ref(), DIAMETERS)?;
        match (diameter, numbers.double("f_number", table.f_number.as_ref(), F_NUMBERS)?) {
            (Some(diameter), None) => lens.diameter = diameter,
            (None, Some(f_number)) => lens.diameter = camera.diameter_of_f_number(f_number) as f32,
            (None, None) if model == CameraModel::Pinhole && lens.diameter.is_nan() => lens.diameter = 0.0,
            (None, None) if !lens.diameter.is_nan() => {}
            _ => {
                return Err(ParseError::at(
                    span,
                    "the camera needs either lens_diameter, f_number or a preset",
                ));
            }
        }
        if model == CameraModel::ThinLens {
            camera
                .can_focus(&lens)
                .map_err(|wrong| ParseError::at(&table.focal_distance, &format!("focal_distance {wrong}")))?;
        }
        let hole = numbers.single("hole_diameter", table.hole_diameter.as_ref(), DIAMETERS)?;
        let diameter = hole.unwrap_or(camera.default_hole_diameter());
        Ok(Self {
            camera,
            model,
            lens,
            hole: Hole { diameter, upright: table.upright },
            aperture: aperture(span, &numbers, folder)?,
            shutter: numbers.single("shutter", table.shutter.as_ref(), SHUTTERS)?.unwrap_or(DEFAULT_SHUTTER),
            iso: numbers.single("iso", table.iso.as_ref(), ISOS)?.unwrap_or(View::default().iso),
        })
    }
}

/// The vertical field of view, if the table gives it.
fn vfov_radians(
    span: &Spanned<CameraTable>,
    numbers: &Quantities,
    size: [u32; 2],
    sensor: &Sensor,
) -> Result<Option<f64>, ParseError> {
    let table = span.get_ref();
    let lengths = [MIN_LENGTH, MAX_LENGTH].map(f64::from);
    let degrees = numbers.double("vfov_degrees", table.vfov_degrees.as_ref(), VFOV_DEGREES)?;
    let focal_length = numbers.double("focal_length", table.focal_length.as_ref(), FOCAL_LENGTHS_MM)?;
    let distance = numbers.double("view_distance", table.view_distance.as_ref(), lengths)?;
    let pixel = numbers.double("pixel_size", table.pixel_size.as_ref(), lengths)?;
    match (degrees, focal_length, distance, pixel) {
        (None, None, None, None) => Ok(None),
        (Some(degrees), None, None, None) => Ok(Some(degrees.to_radians())),
        (None, Some(mm), None, None) => Ok(Some(sensor.vfov_of_focal_length(mm))),
        (None, None, Some(distance), Some(pixel)) => {
            let half_height = 0.5 * f64::from(size[1]) * pixel;
            Ok(Some(2.0 * (half_height / distance).atan()))
        }
        _ => Err(ParseError::at(span, NEEDS_VFOV)),
    }
}

fn sensor(text: &Spanned<String>) -> Result<Sensor, ParseError> {
    let sensor: Sensor = text.get_ref().parse().map_err(|message: String| ParseError::at(text, &message))?;
    sensor.check().map_err(|wrong| ParseError::at(text, &format!("sensor {wrong}")))?;
    Ok(sensor)
}

fn aperture(
    span: &Spanned<CameraTable>,
    numbers: &Quantities,
    folder: &Path,
) -> Result<Aperture, ParseError> {
    let table = span.get_ref();
    let read = |file: &Spanned<String>| {
        let image = ApertureImage::read(&folder.join(file.get_ref()));
        image.map_err(|error| ParseError::at(file, &error.to_string()))
    };
    if let Some(blades) = &table.blades {
        in_range_or_zero(*blades.get_ref(), BLADES, "a disc")
            .map_err(|wrong| ParseError::at(blades, &format!("blades {wrong}")))?;
    }
    let rotation = table.blade_rotation_degrees.as_ref();
    let plain = Aperture::default();
    let aperture = Aperture {
        blades: table.blades.as_ref().map_or(plain.blades, |blades| *blades.get_ref()),
        rotation_degrees: numbers
            .single("blade_rotation_degrees", rotation, ROTATIONS)?
            .unwrap_or(plain.rotation_degrees),
        roundness: numbers
            .single("roundness", table.roundness.as_ref(), ROUNDNESSES)?
            .unwrap_or(plain.roundness),
        anamorphic: numbers
            .single("anamorphic", table.anamorphic.as_ref(), ANAMORPHICS)?
            .unwrap_or(plain.anamorphic),
        cats_eye: numbers.single("cats_eye", table.cats_eye.as_ref(), CATS_EYES)?.unwrap_or(plain.cats_eye),
        image: table.aperture_image.as_ref().map(read).transpose()?,
        profile: numbers
            .single("bokeh_profile", table.bokeh_profile.as_ref(), PROFILES)?
            .unwrap_or(plain.profile),
    };
    aperture
        .validate(|| ["blades", "cats_eye", "aperture_image"])
        .map_err(|message| ParseError::at(span, &message))?;
    Ok(aperture)
}
