//! The drawing of the optics: its points and lines against the equations, on the device's own rays.

mod common;

use anyhow::{Result, ensure};
use common::{Gpu, prove, small};
use glam::DVec3;
use thinlens::app::diagram::{Diagram, Line};
use thinlens::renderer::Question;
use thinlens::scene::{CameraModel, Hole};
use thinlens::settings::Settings;

const RAYS: u32 = 9;

fn drawn(gpu: &Gpu, settings: &Settings, position: [f32; 2]) -> Result<Diagram> {
    let picked =
        gpu.renderer(settings).pick(Question { position, fan: RAYS, samples: RAYS })?.expect("an answer");
    Ok(Diagram::new(&settings.estimator, &picked))
}

/// Where a line is at a depth.
fn at([from, to]: Line, depth: f64) -> DVec3 {
    from + (to - from) * ((depth - from.z) / (to - from).z)
}

/// A film position on the view plane at depth one, by the picture's edges: right, up, forward.
fn slope(settings: &Settings, [x, y]: [f32; 2]) -> DVec3 {
    let [width, height] = settings.estimator.size.map(f64::from);
    let half = (0.5 * settings.estimator.camera.vfov_radians).tan();
    let up = half * (1.0 - 2.0 * f64::from(y) / height);
    DVec3::new(half * (2.0 * f64::from(x) - width) / height, up, 1.0)
}

/// Catches a drawing that is turned, mirrored, beside the pixel or of another lens: p must be where the device
/// looks, q on the way to it, every ray must start on the lens and pass p, and the fan must end at its rim.
#[test]
fn p_lies_where_the_device_focuses() {
    let mut oval = small("version-4");
    oval.estimator.aperture.anamorphic = 2.0;
    let check = |gpu: &Gpu| -> Result<String> {
        let plain = small("version-4");
        let mut worst = 0.0_f64;
        for (settings, position) in
            [(&plain, [32.5, 24.5]), (&plain, [5.5, 40.5]), (&plain, [60.5, 30.5]), (&oval, [10.5, 38.5])]
        {
            let lens = settings.estimator.lens;
            let (radius, focal_distance) = (f64::from(lens.diameter) / 2.0, f64::from(lens.focal_distance));
            let half_width = radius / f64::from(settings.estimator.aperture.anamorphic);
            let diagram = drawn(gpu, settings, position)?;
            let (depth, p) = diagram.focus.expect("a lens has a focal plane");
            let expected = focal_distance * slope(settings, position);
            ensure!((depth - focal_distance).abs() < 1e-6, "the focal plane is drawn at {depth}");
            let mut near = |what: &str, point: DVec3, expected: DVec3| -> Result<()> {
                let off = point.distance(expected) / focal_distance;
                worst = worst.max(off);
                ensure!(off < 1e-4, "{position:?}: {what} is at {point}, not {expected}");
                Ok(())
            };
            near("p", p, expected)?;
            near("q", diagram.q, expected * (diagram.view_plane / focal_distance))?;
            for ray in diagram.fan_up.iter().chain(&diagram.fan_across).chain([&diagram.centre]) {
                near("a ray", at(*ray, focal_distance), expected)?;
            }
            // Samples are of anywhere in the pixel.
            ensure!(diagram.samples.len() == RAYS as usize, "{} samples", diagram.samples.len());
            for ray in &diagram.samples {
                ensure!(ray[0].z.abs() < 1e-6 && ray[0].length() < radius * 1.0001, "{} is no lens", ray[0]);
            }
            let rims = [(&diagram.fan_up, radius * DVec3::Y), (&diagram.fan_across, half_width * DVec3::X)];
            for (fan, rim) in rims {
                near("a rim", fan[0][0], -rim)?;
                near("a rim", fan[fan.len() - 1][0], rim)?;
            }
            let [width, height] = diagram.half_aperture;
            near("the opening", DVec3::new(width, height, 0.0), DVec3::new(half_width, radius, 0.0))?;
            near("the centre", diagram.centre[0], DVec3::ZERO)?;
            let hit = diagram.hit.expect("a surface");
            near("the hit", hit, at(diagram.centre, hit.z))?;
        }
        Ok(format!("within {worst:.1e} F"))
    };
    prove(check, &["pick", "fan", "focal_sphere"]);
}

/// Catches an image side that is not the lens's: light must cross where `1 / i = 1 / f - 1 / z` says, spread on
/// the film over the circle of confusion around p', and turn the picture upside down; and a hole must bend
/// nothing.
#[test]
fn light_spreads_on_the_film_over_the_circle_of_confusion() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    for focal_distance in [3.0, 10.6, 40.0] {
        settings.estimator.lens.focal_distance = focal_distance;
        let (focal_distance, position) = (f64::from(focal_distance), [20.5, 38.5]);
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let (image, hit) = (&diagram.image, diagram.hit.expect("a surface"));
        let (v, z) = (0.012 / (0.5 * settings.estimator.camera.vfov_radians).tan() / 0.05, hit.z);
        assert!((image.film_distance / v - 1.0).abs() < 1e-9, "the film stands {} away", image.film_distance);
        let p = -v * slope(&settings, position);
        assert!(image.p.distance(p) < 1e-5 * v, "p' is at {}, not {p}", image.p);

        let diameter = f64::from(settings.estimator.lens.diameter);
        let spread = diameter * v * (z.recip() - focal_distance.recip()).abs();
        assert!((image.blur / spread - 1.0).abs() < 1e-4, "{} wide, not {spread}", image.blur);
        let pixels = spread * 24.0 / v / (0.5 * settings.estimator.camera.vfov_radians).tan();
        assert!((image.blur_pixels / pixels - 1.0).abs() < 1e-4, "{} px, not {pixels}", image.blur_pixels);

        let crossing = (v.recip() + focal_distance.recip() - z.recip()).recip();
        assert!((image.crossing.expect("it is real") / crossing - 1.0).abs() < 1e-6);
        let meets = -hit * (crossing / z);
        for line in image.light_up.iter().chain(&image.light_across) {
            let off = at(*line, -crossing).distance(meets);
            assert!(off < 1e-5 * v, "light passes {off} beside the picture of what is seen");
            let on_film = at(*line, -v).distance(p);
            assert!(on_film < 0.5 * spread * 1.0001 + 1e-5 * v, "light falls {on_film} beside p'");
        }
        let rims = [0, image.light_up.len() - 1].map(|i| at(image.light_up[i], -v));
        assert!(
            (rims[0].distance(rims[1]) / spread - 1.0).abs() < 1e-3,
            "the fan is not as wide as its blur"
        );
    }

    settings.estimator.model = CameraModel::Hole;
    settings.estimator.hole = Hole { diameter: 0.1, upright: false };
    let diagram = drawn(&gpu, &settings, [20.5, 10.5]).expect("it is drawn");
    let (image, hit) = (&diagram.image, diagram.hit.expect("a surface"));
    assert!(diagram.focus.is_none() && image.crossing.is_none(), "a hole does not focus");
    let width = 0.1_f32 as f64 * (1.0 + image.film_distance / hit.z);
    assert!((image.blur / width - 1.0).abs() < 1e-4, "{} wide, not {width}", image.blur);
    for line in &image.light_up {
        let straight = (line[0] - hit).normalize().cross((line[1] - line[0]).normalize()).length();
        assert!(straight < 1e-5, "a hole bends light by {straight}");
    }
    settings.estimator.model = CameraModel::Pinhole;
    let diagram = drawn(&gpu, &settings, [20.5, 38.5]).expect("it is drawn");
    assert!(diagram.half_aperture == [0.0; 2] && diagram.image.blur < 1e-12, "a pinhole blurs nothing");
}
