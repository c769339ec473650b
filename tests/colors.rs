//! The colour errors of a lens whose focal length depends on the wavelength.

mod common;

use anyhow::{Result, ensure};
use common::scenes::EVERYTHING;
use common::{Gpu, film, pixels, prove, settings_of};
use thinlens::scene::CameraModel;
use thinlens::settings::{Estimator, Settings};
use thinlens::verify::verify;

const SIZE: [u32; 2] = [160, 120];

/// A white square of this width in front of the lens.
fn white(width: f64, depth: f64, diameter: f64, focal_distance: f64, abbe_number: u32) -> Settings {
    let half = 0.5 * width;
    let toml = format!(
        "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nmetres_per_unit = 0.03\n\
         lens_diameter = {diameter}\nfocal_distance = {focal_distance}\nabbe_number = {abbe_number}\n\
         [emissive.lamp]\nradiance = 1\n[[box]]\nlower = [-{half}, -{half}, {}]\nupper = [{half}, {half}, -{depth}]\n\
         material = \"lamp\"\n",
        -depth - 1e-3
    );
    settings_of(&toml, SIZE, 4096)
}

/// The light of each colour, and the diameter of the disc that has its second moment across x.
fn spots(film: &[[f32; 4]]) -> [(f64, f64); 3] {
    [0, 1, 2].map(|color| {
        let light = |index: usize| f64::from(film[index][color]);
        let sum: f64 = (0..film.len()).map(light).sum();
        let squared = |(index, [x, _]): (usize, [u32; 2])| light(index) * (f64::from(x) + 0.5 - 80.0).powi(2);
        let square: f64 = pixels(SIZE).enumerate().map(squared).sum();
        (sum, 4.0 * (square / sum).sqrt())
    })
}

/// Catches colours that are all in focus in one plane, in that of another colour, or as far apart as the depth and not the
/// focal length says: a white lamp out of focus spreads over another circle in each colour, by the equation of the thin lens
/// with `1 / f` that is larger by `(1 / l^2 - 1 / 550^2) / (1 / 486.1^2 - 1 / 656.3^2) / V` for the wavelength `l`. And light
/// that is lost: each colour has as much of it.
#[test]
fn each_colour_spreads_over_its_own_circle() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut worst, mut shown) = (0.0_f64, Vec::new());
        for (depth, diameter, focal_distance, abbe_number) in
            [(10.0, 0.5, 6.0, 20), (10.0, 0.4, 8.0, 3), (8.0, 0.8, 30.0, 20)]
        {
            let width = 0.08;
            let settings = white(width, depth, diameter, focal_distance, abbe_number);
            let Estimator { camera, .. } = &settings.estimator;
            let k = 60.0 / 20_f64.to_radians().tan();
            let on_film = camera.film_distance().recip();
            let spots = spots(&film(gpu, &settings));
            let mut blurs = [0.0; 3];
            for (color, wavelength) in [610.0_f64, 550.0, 465.0].into_iter().enumerate() {
                let index = |nanometres: f64| nanometres.powi(-2);
                let more = (index(wavelength) - index(550.0))
                    / (index(486.1) - index(656.3))
                    / f64::from(abbe_number);
                let in_focus = (1.0 + more) * (1.0 / focal_distance + on_film) - on_film;
                let blur = diameter * k * (in_focus - 1.0 / depth).abs();
                // The lamp's own square and the pixel's add their second moments, a twelfth of their areas.
                let own = width / depth * k;
                let expected = (blur * blur + 16.0 / 12.0 * (own * own + 1.0)).sqrt();
                let (_, got) = spots[color];
                let error = (got / expected - 1.0).abs();
                worst = worst.max(error);
                ensure!(error < 0.02, "colour {color}, V {abbe_number}: {got:.2} px, not {expected:.2}");
                blurs[color] = blur;
            }
            shown.push(format!("{blurs:.1?} px"));
            for (sum, _) in spots {
                ensure!(
                    (sum / spots[1].0 - 1.0).abs() < 0.01,
                    "{sum} of one colour, {} of green",
                    spots[1].0
                );
            }
        }
        Ok(format!("circles of {} within {:.2}%", shown.join(", "), 100.0 * worst))
    };
    prove(check, &["dispersion"]);
}

/// Catches white that is tinted where nothing is blurred: in the middle of a large square in focus, and in one that is not.
#[test]
fn white_stays_white() {
    let gpu = Gpu::new();
    for focal_distance in [10.0, 6.0] {
        let mut settings = white(6.0, 10.0, 0.3, focal_distance, 20);
        settings.samples = 16;
        let film = film(&gpu, &settings);
        let middle = film[(60 * SIZE[0] + 80) as usize];
        assert!(middle[..3].iter().all(|light| *light == 1.0), "{middle:?}");
        // At the edge there is a fringe.
        let tinted = film.iter().filter(|texel| (texel[0] - texel[2]).abs() > 0.02).count();
        assert!(tinted > 20, "{tinted} pixels of a fringe");
    }
}

/// Catches colour errors that the device has and the oracle has not, with and without a tilt, and some without a lens.
#[test]
fn pictures_with_colour_errors_are_those_of_the_oracle() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings_of(EVERYTHING, [64, 48], 8));
        let (mut samples, mut mismatches) = (0, 0);
        for (abbe_number, tilt, shift, model) in [
            (30, 0.0, [0.0, 0.0], CameraModel::ThinLens),
            (4, 16.0, [4.0, -6.0], CameraModel::ThinLens),
            (30, 0.0, [0.0, 0.0], CameraModel::Hole),
        ] {
            let mut settings = settings_of(EVERYTHING, [64, 48], 8);
            let Estimator { lens, camera, hole, .. } = &mut settings.estimator;
            (lens.abbe_number, lens.tilt_degrees, camera.lens_shift_mm) = (abbe_number, tilt, shift);
            (camera.metres_per_unit, hole.diameter) = (0.03, 0.1);
            settings.estimator.model = model;
            let agreement = verify(&mut renderer, &settings)?;
            samples += agreement.samples;
            mismatches += agreement.mismatches;
        }
        Ok(format!("{samples} samples, {mismatches} differ"))
    };
    prove(check, &["dispersion", "colour_error_of_a_lens_without_tilt"]);
}
