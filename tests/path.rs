//! The integrator "path": it follows the oracle sample by sample, loses no light, and obeys the laws of optics.

mod common;

use anyhow::{Result, ensure};
use common::scenes::PATHS;
use common::{Gpu, bits, film, prove, scene_of, settings_of};
use glam::DVec3;
use std::f64::consts::PI;
use thinlens::scene::Integrator;
use thinlens::settings::{Sampler, Settings};
use thinlens::verify::verify;

/// Catches any factor, direction or decision of a path that is not that of the oracle: metal, glass in glass, lamps,
/// mirrors, checkers and the sky, with each sampler.
#[test]
fn paths_follow_the_oracle() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for (_, sampler) in Sampler::NAMES {
            let mut settings = settings_of(PATHS, [48, 36], 6);
            settings.estimator.sampler = sampler;
            let agreement = verify(&mut gpu.renderer(&settings), &settings)?;
            let differ = 100.0 * agreement.mismatch_share();
            // These shapes are large, so that few paths are led astray.
            ensure!(differ < 0.2, "{differ:.3}% of the samples differ");
            figures.push(format!("{differ:.3}% differ"));
        }
        Ok(figures.join(", "))
    };
    prove(check, &["paths"]);
}

/// Catches a limit that ends paths too early or too late, that cuts off light of the first surface, or changes a colour.
#[test]
fn limits_of_paths_follow_the_oracle() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut settings = settings_of(PATHS, [48, 36], 6);
        (settings.estimator.diffuse_bounces, settings.estimator.clamp) = (2, 0.4);
        let agreement = verify(&mut gpu.renderer(&settings), &settings)?;
        let differ = 100.0 * agreement.mismatch_share();
        ensure!(differ < 0.2, "{differ:.3}% of the samples differ");

        // A limit that nothing reaches changes no bit, and one scattering is direct light alone where nothing mirrors.
        let mut floor = below("[[sphere]]\ncenter = [0.4, 0.8, 0]\nradius = 0.3\nmaterial = \"lamp\"\n", 16);
        let direct = bits(&film(gpu, &floor));
        floor.estimator.clamp = 6e4;
        ensure!(bits(&film(gpu, &floor)) == direct, "a clamp of 60000 cuts something off");
        (floor.estimator.max_bounces, floor.estimator.diffuse_bounces) = (9, 1);
        ensure!(bits(&film(gpu, &floor)) == direct, "one diffuse bounce is not direct light");
        Ok(format!("{differ:.3}% differ"))
    };
    prove(check, &["limits"]);
}

/// A ball of this material, in a camera that sees nothing else, under a sky of radiance 1.
fn furnace(material: &str) -> Settings {
    let scene = format!(
        "integrator = \"path\"\nmax_bounces = 64\n[camera]\neye = [0, 0, 3]\nlook_at = [0, 0, 0]\nvfov_degrees = 30\n\
         lens_diameter = 0\nfocal_distance = 3\n[background]\ncolor = [1, 1, 1]\n{material}\n\
         [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n"
    );
    settings_of(&scene, [48, 32], 64)
}

/// Catches materials that add or lose light: in a sky of one radiance, a white thing that absorbs nothing cannot be seen.
/// Where paths may end by chance, it can be seen as noise, but not in the mean.
#[test]
fn white_things_vanish_in_a_white_sky() {
    let gpu = Gpu::new();
    let white = "color = [1, 1, 1]";
    for (material, every_pixel, mean) in [
        (format!("[matte.m]\n{white}"), 1e-5, 1e-6),
        (format!("[mirror.m]\n{white}\nkr = 1"), 1e-5, 1e-6),
        (format!("[metal.m]\n{white}"), 1e-5, 1e-6),
        ("[glass.m]".to_owned(), 0.2, 1e-3),
        ("[glass.m]\nindex = 2.4".to_owned(), 0.3, 2e-3),
        ("[glass.m]\nroughness = 0.4".to_owned(), 0.5, 5e-3),
        (format!("[metal.m]\n{white}\nroughness = 0.7"), 0.5, 5e-3),
    ] {
        let film = film(&gpu, &furnace(&material));
        let off = film.iter().flat_map(|texel| &texel[..3]).map(|channel| f64::from(channel - 1.0));
        let worst = off.clone().fold(0.0, |worst: f64, off| worst.max(off.abs()));
        let sum = off.sum::<f64>() / (3 * film.len()) as f64;
        assert!(
            worst < every_pixel && sum.abs() < mean,
            "{material}: {worst:.1e} at most, {sum:.1e} in the mean"
        );
    }
}

/// Catches a path that renders what it has no meaning for, and a message that does not say what to use instead.
#[test]
fn what_an_integrator_cannot_render_is_refused() {
    let camera = "[camera]\neye = [0, 0, 3]\nlook_at = [0, 0, 0]\nvfov_degrees = 30\nlens_diameter = 0\n\
                  focal_distance = 3\n";
    let ball = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
    let matte = "[matte.m]\ncolor = [0.5, 0.5, 0.5]\n";
    for (integrator, tables, expected) in [
        (Integrator::Path, format!("[ambient]\nradiance = 1\n{matte}"), "give [background] a color"),
        (
            Integrator::Path,
            format!("[[point]]\nposition = [0, 9, 0]\nradiance = 1\n{matte}"),
            "use emissive materials",
        ),
        (
            Integrator::Path,
            "[phong.m]\ncolor = [0.5, 0.5, 0.5]\nka = 1\nkd = 1\nks = 1\nexponent = 9\n".into(),
            "use matte",
        ),
        (
            Integrator::Path,
            "[mirror.m]\ncolor = [1, 1, 1]\nkr = 1\nks = 1\n".into(),
            "use matte or mirror without them",
        ),
        (Integrator::Path, "[matte.m]\nkd = 1.5\ncolor = [0.5, 0.8, 0.5]\n".into(), "at most 1"),
        (Integrator::Path, "[plastic.m]\ncolor = [0.5, 1.1, 0.5]\n".into(), "at most 1"),
        (Integrator::Path, "[standard.m]\ncolor = [0.5, 0.5, 1.1]\n".into(), "at most 1"),
        (Integrator::Whitted, "[glass.m]\n".into(), "needs the integrator path"),
        (Integrator::Whitted, "[plastic.m]\ncolor = [1, 1, 1]\n".into(), "needs the integrator path"),
        (Integrator::Whitted, "[standard.m]\ncolor = [1, 1, 1]\n".into(), "needs the integrator path"),
        (Integrator::Whitted, "[metal.m]\ncolor = [1, 1, 1]\n".into(), "needs the integrator path"),
    ] {
        let mut settings = Settings::of_scene(scene_of(&format!("{camera}{tables}{ball}")));
        settings.estimator.integrator = integrator;
        let refused = settings.check().expect_err(&tables).to_string();
        assert!(refused.contains(expected) && refused.starts_with("--integrator "), "{tables}: {refused}");
    }
}

/// Catches a refraction that bends the wrong way, and absorption that does not grow with the way: what is seen through a
/// slab of colored glass, at a right angle and at a slanted one, is what the laws of Snell, Fresnel and Beer say.
#[test]
fn a_slab_of_glass_obeys_snell_fresnel_and_beer() {
    let gpu = Gpu::new();
    let (index, thickness, left) = (1.5_f64, 0.5_f64, 0.4_f64);
    for angle in [0.0_f64, 40.0, 75.0] {
        // The camera looks along the slanted ray, at a slab of 0.5 that a white sky lies behind.
        let (sine, cosine) = angle.to_radians().sin_cos();
        let scene = format!(
            "integrator = \"path\"\nmax_bounces = 64\n[camera]\neye = [{}, 0, {}]\nlook_at = [0, 0, 0]\n\
             vfov_degrees = 0.01\nlens_diameter = 0\nfocal_distance = 3\n[background]\ncolor = [1, 1, 1]\n\
             [glass.m]\nindex = {index}\ncolor = [{left}, {left}, {left}]\ncolor_distance = {thickness}\n\
             [[box]]\nlower = [-1e3, -1e3, -0.5]\nupper = [1e3, 1e3, 0]\nmaterial = \"m\"\n",
            9.0 * sine,
            9.0 * cosine
        );
        let film = film(&gpu, &settings_of(&scene, [16, 16], 4096));
        let mean: f64 = film.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / film.len() as f64;
        let inside = (1.0 - (sine / index).powi(2)).sqrt();
        let across = ((cosine - index * inside) / (cosine + index * inside)).powi(2);
        let along = ((index * cosine - inside) / (index * cosine + inside)).powi(2);
        let (reflected, passed) = ((across + along) / 2.0, left.powf(1.0 / inside));
        // What comes out in front or behind after any number of ways through the slab.
        let expected = reflected + (1.0 - reflected).powi(2) * passed / (1.0 - reflected * passed);
        assert!((mean - expected).abs() < 2e-3, "at {angle} degrees: {mean}, not {expected}");
    }
}

/// A floor of albedo 0.5 that is seen from nearby, slanted, and a lamp of radiance 3 above its middle.
fn below(lamp: &str, samples: u32) -> Settings {
    let scene = format!(
        "integrator = \"path\"\nmax_bounces = 1\n[camera]\neye = [0.3, 0.2, 0.4]\nlook_at = [0, 0, 0]\n\
         vfov_degrees = 0.01\nlens_diameter = 0\nfocal_distance = 1\n[matte.floor]\ncolor = [0.5, 0.5, 0.5]\n\
         [emissive.lamp]\nradiance = 3\n[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n{lamp}"
    );
    settings_of(&scene, [16, 16], samples)
}

/// The irradiance at the origin of a floor below a polygon of radiance 1, by J. Lambert: the sum over its edges of the angle
/// that each spans, times the cosine between the normals of the floor and of the plane through the edge.
fn lambert(corners: &[DVec3]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edge = |(a, b): (&DVec3, &DVec3)| a.angle_between(*b) * a.cross(*b).normalize().y;
    (corners.iter().zip(next).map(edge).sum::<f64>() / 2.0).abs()
}

/// Catches a lamp that is too bright or too dark: the light of a sphere and of polygons has closed forms. A beginner's
/// mistake, such as a forgotten cosine, passes for right as long as the oracle shares it.
#[test]
fn the_light_of_a_lamp_has_its_closed_form() {
    let gpu = Gpu::new();
    let corners = [[-0.5, 1.0, -0.4], [0.6, 1.2, 0.1], [0.1, 0.9, 0.8]].map(DVec3::from_array);
    let [a, b, c] = corners.map(|corner| corner.to_array());
    let triangle = format!("[[triangle]]\nvertices = [{a:?}, {b:?}, {c:?}]\nmaterial = \"lamp\"\n");
    // Only the lower face of this box is seen.
    let face =
        [[-0.5, 1.0, -0.3], [0.7, 1.0, -0.3], [0.7, 1.0, 0.6], [-0.5, 1.0, 0.6]].map(DVec3::from_array);
    let flat = "[[box]]\nlower = [-0.5, 1, -0.3]\nupper = [0.7, 1.1, 0.6]\nmaterial = \"lamp\"\n";
    let sphere = "[[sphere]]\ncenter = [0.6, 0.8, 0]\nradius = 0.3\nmaterial = \"lamp\"\n";
    // A sphere that is all above the floor counts by the cosine of its middle.
    let of_sphere = PI * 0.3_f64.powi(2) * 0.8;
    // Its second edge is a little slanted, as numbers with three digits are.
    let edges = [[0.8, 0.3, 0.1], [-0.3, 0.7, 0.302]].map(DVec3::from_array);
    let straight = edges[1] - edges[1].project_onto(edges[0]);
    let corner = DVec3::new(-0.7, 0.8, 0.2);
    let window = [corner, corner + edges[0], corner + edges[0] + straight, corner + straight];
    let rectangle = format!(
        "[[rectangle]]\ncorner = {corner}\nedges = [{}, {}]\nmaterial = \"lamp\"\n",
        edges[0], edges[1]
    );
    // A disc that hangs level, beside the middle: J. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors",
    // B-13. One that is turned is nearly a polygon of very many corners.
    let (radius, height, beside) = (0.5_f64, 0.8_f64, 0.9_f64);
    let [h, r] = [height, radius].map(|length| (length / beside).powi(2));
    let level_irradiance = PI / 2.0 * (1.0 - (1.0 + h - r) / ((1.0 + h + r).powi(2) - 4.0 * r).sqrt());
    let level = format!(
        "[[disc]]\ncenter = [{beside}, {height}, 0]\nnormal = [0, 2, 0]\nradius = {radius}\nmaterial = \"lamp\"\n"
    );
    let (center, normal) = (DVec3::new(0.3, 0.9, -0.6), DVec3::new(0.6, -1.0, 0.2));
    let (across, other) = normal.normalize().any_orthonormal_pair();
    let rim: Vec<DVec3> = (0..4096)
        .map(|number| f64::from(number) * 2.0 * PI / 4096.0)
        .map(|angle| center + radius * (angle.cos() * across + angle.sin() * other))
        .collect();
    let turned =
        format!("[[disc]]\ncenter = {center}\nnormal = {normal}\nradius = {radius}\nmaterial = \"lamp\"\n");
    // A second lamp that is out of sight, to be chosen in vain.
    let below_floor = "[[sphere]]\ncenter = [0, -2, 0]\nradius = 0.5\nmaterial = \"lamp\"\n";
    for (lamp, irradiance) in [
        (sphere.to_owned(), of_sphere),
        (triangle, lambert(&corners)),
        (flat.to_owned(), lambert(&face)),
        (rectangle, lambert(&window)),
        (level, level_irradiance),
        (turned, lambert(&rim)),
        (format!("{sphere}{below_floor}"), of_sphere),
    ] {
        let film = film(&gpu, &below(&lamp, 1024));
        let mean = film.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / film.len() as f64;
        let expected = 0.5 / PI * 3.0 * irradiance;
        assert!((mean / expected - 1.0).abs() < 3e-3, "{lamp}: {mean}, not {expected}");
    }
}

/// Catches light that a lamp brings twice or not at all where another strategy finds it: a small lamp is found by light
/// samples, a large one by the directions of the surface, and a room whose walls all glow is as bright everywhere as they are.
#[test]
fn the_strategies_share_the_light() {
    let gpu = Gpu::new();
    let rough = "color = [1, 1, 1]\nroughness = 0.2\n";
    for material in [
        "[matte.m]\ncolor = [1, 1, 1]\n".to_owned(),
        format!("[metal.m]\n{rough}"),
        format!("[plastic.m]\n{rough}"),
    ] {
        let scene = format!(
            "integrator = \"path\"\nmax_bounces = 1\n[camera]\neye = [0, 0, 3]\nlook_at = [0, 0, 0]\nvfov_degrees = 10\n\
             lens_diameter = 0\nfocal_distance = 3\n[emissive.lamp]\nradiance = 1\n{material}\
             [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n\
             [[sphere]]\ncenter = [1, 0, 0]\nradius = 9\nmaterial = \"lamp\"\n"
        );
        let film = film(&gpu, &settings_of(&scene, [16, 16], 1024));
        let mean = film.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / film.len() as f64;
        assert!((0.997..1.003).contains(&mean), "{material}: {mean}");
    }
}

/// Catches light that a lamp sends through a coloured body as if it were clear: a floor and a small lamp one unit away lie in
/// a body of index 1, which absorbs half of the light on each unit, and the camera looks in from outside.
#[test]
fn a_body_absorbs_the_light_of_the_lamps_inside() {
    let check = |gpu: &Gpu| -> Result<String> {
        let scene = "integrator = \"path\"\nmax_bounces = 2\n[camera]\neye = [0, 4, 3]\nlook_at = [0, 0, 0]\n\
                     vfov_degrees = 0.01\nlens_diameter = 0\nfocal_distance = 5\n[matte.floor]\ncolor = [0.5, 0.5, 0.5]\n\
                     [emissive.lamp]\nradiance = 3\n[glass.tint]\nindex = 1\ncolor = [0.5, 0.5, 0.5]\n\
                     [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n\
                     [[box]]\nlower = [-9, -1, -9]\nupper = [9, 2, 9]\nmaterial = \"tint\"\n\
                     [[sphere]]\ncenter = [0.6, 0.8, 0]\nradius = 0.02\nmaterial = \"lamp\"\n";
        let film = film(gpu, &settings_of(scene, [16, 16], 1024));
        let mean = film.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / film.len() as f64;
        // The ray of the camera is in the body for 2 units of height, on 5 units for 4 of height.
        let left = 0.5_f64.powf(1.0 + 2.5);
        let expected = left * 0.5 * 3.0 * 0.02_f64.powi(2) * 0.8;
        ensure!((mean / expected - 1.0).abs() < 0.02, "{mean}, not {expected}");
        Ok(format!("{mean}"))
    };
    prove(check, &["body_absorbs_nothing_of_its_lamps"]);
}
