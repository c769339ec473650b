//! What happens with the light of a point, in words.

use super::Diagram;
use super::paths::SHARP;
use crate::scene::CameraModel;

/// A sentence that says where the light of the point meets, and what the film shows of it.
pub fn sentence(diagram: &Diagram) -> String {
    let image = &diagram.image;
    let Some(hit) = diagram.hit else {
        return "This pixel shows the background, which has no distance. Click an object to see its light."
            .into();
    };
    let point = match diagram.material.as_str() {
        _ if diagram.is_moved => format!("a point in this direction at {}", depth(diagram, hit.z)),
        "" => format!("this point at {}", depth(diagram, hit.z)),
        material => format!("this point ({material}, at {})", depth(diagram, hit.z)),
    };
    let spread = format!("{} ({})", pixels(image.blur_pixels), millimetres(image.blur * diagram.mm_per_unit));
    match diagram.model {
        CameraModel::Pinhole => {
            format!("Only one ray of {point} comes through an ideal pinhole, so it is sharp at every depth.")
        }
        CameraModel::Hole => {
            format!(
                "Light from {point} goes straight through the hole and does not meet: on the film it is spread over \
                 {spread}."
            )
        }
        CameraModel::ThinLens if image.blur_pixels <= SHARP => {
            format!(
                "Light from {point} meets on the film, so it is sharp there: {}.",
                pixels(image.blur_pixels)
            )
        }
        CameraModel::ThinLens => match image.crossing {
            None => format!(
                "Light from {point} is still spreading behind the lens and meets nowhere: on the film it is spread over \
                 {spread}."
            ),
            Some(crossing) => {
                let off = millimetres((crossing - image.film_distance).abs() * diagram.mm_per_unit);
                let meets = if crossing < image.film_distance {
                    format!("meets {off} in front of the film")
                } else {
                    format!("would only meet {off} behind the film")
                };
                format!("Light from {point} {meets}, so it is spread over {spread} there.")
            }
        },
    }
}

/// What stands at the place where light meets.
pub(super) fn meeting(diagram: &Diagram) -> Option<String> {
    let image = &diagram.image;
    let off = image.crossing? - image.film_distance;
    if image.blur_pixels <= SHARP {
        return Some("light meets here, on the film: sharp".into());
    }
    let side = if off < 0.0 { "in front of" } else { "behind" };
    Some(format!("light meets here, {} {side} the film", millimetres(off.abs() * diagram.mm_per_unit)))
}

/// A depth in scene units, and its real length.
pub fn depth(diagram: &Diagram, units: f64) -> String {
    if units.is_infinite() {
        return "infinity".into();
    }
    format!("{} = {}", digits(units, 3), millimetres(units * diagram.mm_per_unit))
}

/// A length in millimetres, in the unit that people use for it.
pub fn millimetres(length: f64) -> String {
    let (value, unit) = match length {
        length if length < 100.0 => (length, "mm"),
        length if length < 1000.0 => (length / 10.0, "cm"),
        length if length < 1e6 => (length / 1000.0, "m"),
        length => (length / 1e6, "km"),
    };
    format!("{} {unit}", digits(value, 2))
}

/// A number of pixels.
pub(super) fn pixels(number: f64) -> String {
    format!("{} pixels", digits(number, 2))
}

/// A number with at least so many digits, and none that mean nothing: at most three behind the point.
pub(super) fn digits(value: f64, count: i32) -> String {
    if value.abs() < 5e-4 {
        return "0".into();
    }
    let decimals = (count - 1 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 3);
    format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
}
