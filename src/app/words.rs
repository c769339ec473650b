//! Words for what is seen at a place of the picture.

use crate::renderer::Surface;
use crate::scene::CameraModel;
use crate::settings::Settings;
use glam::DVec3;

/// A blur over fewer pixels than this is shown as none.
const NO_BLUR: f64 = 0.05;

/// A length with four digits, or "infinity".
pub(super) fn length(value: f64) -> String {
    with_digits(4, value)
}

/// A length with so many digits, or "infinity".
pub(super) fn with_digits(digits: i32, value: f64) -> String {
    if value.is_infinite() {
        return "infinity".into();
    }
    let decimals = (digits - 1 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 9);
    format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
}

/// How far a point of the scene is blurred, and on which side of the focal plane it lies. The second text is empty if
/// there is nothing to say.
pub(super) fn blur(settings: &Settings, point: DVec3) -> [String; 2] {
    let estimator = &settings.estimator;
    let (camera, height) = (&estimator.camera, estimator.size[1]);
    let pixels = match estimator.model {
        CameraModel::ThinLens => camera.circle_of_confusion_at(&estimator.lens, point, height),
        CameraModel::Pinhole => return ["sharp, as everything is through a pinhole".into(), String::new()],
        CameraModel::Hole => {
            let depth = camera.frame().axial_depth(camera.eye, point);
            let spread = camera.film_distance().recip() + depth.recip();
            f64::from(estimator.hole.diameter) * spread * camera.view_distance_pixels(height)
        }
    };
    let side = match estimator.model {
        CameraModel::ThinLens if pixels < 0.0 => "in front of the focal plane",
        CameraModel::ThinLens => "behind the focal plane",
        _ => "by the size of the hole",
    };
    let pixels = pixels.abs();
    if pixels < NO_BLUR {
        let is_in_plane = estimator.model == CameraModel::ThinLens && estimator.lens.diameter > 0.0;
        let sharp =
            if is_in_plane { "sharp, in the focal plane" } else { "sharp, as the opening is a point" };
        return [sharp.into(), String::new()];
    }
    let size = if pixels <= settings.tolerance_pixels() {
        format!("sharp: blurred over only {pixels:.2} px")
    } else {
        let millimetres = settings.mm_of_pixels(pixels);
        format!("blurred over {pixels:.2} px ({millimetres:.3} mm)")
    };
    [size, side.into()]
}

/// What is seen at a place, in one line.
pub(super) fn place(settings: &Settings, surface: Option<&Surface>) -> String {
    let Some(Surface { material, depth, point, .. }) = surface else {
        return "background: it is infinitely far away".into();
    };
    let [size, side] = blur(settings, *point);
    let side = if side.is_empty() { side } else { format!(", {side}") };
    format!("{material}, {} away: {size}{side}", length(*depth))
}

#[cfg(test)]
mod tests {
    use super::blur;
    use crate::scene::{self, CameraModel, SceneRef};
    use crate::settings::Settings;

    /// Catches a point in the focal plane that is called blurred or in front, the two sides exchanged, and a hole of
    /// which a focal plane is told.
    #[test]
    fn what_is_in_focus_is_called_sharp() {
        let mut settings = Settings::of_scene(SceneRef::new(scene::load("version-4").expect("a scene")));
        let plane = f64::from(settings.estimator.lens.focal_distance);
        let said = |settings: &Settings, share: f64| {
            let camera = &settings.estimator.camera;
            blur(settings, camera.eye - share * plane * camera.frame().w()).join(", ")
        };
        assert_eq!(said(&settings, 1.0), "sharp, in the focal plane, ");
        let beside = said(&settings, 1.0 + 1e-2);
        assert!(beside.starts_with("sharp: ") && beside.ends_with("behind the focal plane"), "{beside}");
        let near = said(&settings, 0.5);
        assert!(near.starts_with("blurred") && near.ends_with("in front of the focal plane"), "{near}");
        settings.estimator.model = CameraModel::Hole;
        let hole = said(&settings, 1.0);
        assert!(hole.starts_with("blurred") && !hole.contains("plane"), "{hole}");
        settings.estimator.model = CameraModel::Pinhole;
        assert!(said(&settings, 0.5).starts_with("sharp"));
    }
}
