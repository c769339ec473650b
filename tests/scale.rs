//! The same things at any size, at any place, and seen from any distance: what f32 loses there may not show.

mod common;

use anyhow::{Result, ensure};
use common::probe::{RayAnswer, RayQuestion, probe};
use common::{Gpu, prove, settings_of};
use glam::{DVec3, dvec3};
use std::f64::consts::TAU;
use thinlens::error::Error;
use thinlens::renderer::Renderer;
use thinlens::settings::Settings;
use thinlens::verify::{MAX_MISMATCH_SHARE, verify};

/// Where a still life stands, how large it is, and from how far away it is seen.
#[derive(Debug, Clone, Copy)]
struct Place {
    at: DVec3,
    unit: f64,
    /// The distance from the eye, in units.
    distance: f64,
    /// Whether the ball is one of many triangles, so that there is a tree.
    faceted: bool,
}

const HERE: Place = Place { at: DVec3::ZERO, unit: 1.0, distance: 9.0, faceted: false };

/// A ball, a low checkered box on the boundaries of its checker's cells, and a triangle, on a checkered floor. The
/// picture is four units high, wherever it is taken from.
fn still_life(place: Place) -> Settings {
    let Place { at, unit, distance, faceted } = place;
    let point = |x: f64, y: f64, z: f64| {
        let point = at + unit * dvec3(x, y, z);
        format!("[{:?}, {:?}, {:?}]", point.x, point.y, point.z)
    };
    let eye = distance * dvec3(0.35, 0.6, 0.72).normalize();
    let vfov = (2.0 * (2.0 / distance).atan()).to_degrees();
    let mut toml = format!(
        "[camera]\neye = {}\nlook_at = {}\nvfov_degrees = {vfov}\nlens_diameter = {}\nfocal_distance = {}\n\
         [background]\nhorizon = [0.9, 0.6, 0.4]\nzenith = [0.1, 0.2, 0.6]\n[ambient]\nradiance = 0.2\n\
         [[directional]]\ndirection = [1, 1, 0.2]\nradiance = 2\n[[point]]\nposition = {}\nradiance = 1.5\n\
         [matte.floor]\nka = 1\nkd = 0.8\ncolor = {{ even = [0.8, 0.8, 0.7], odd = [0.1, 0.2, 0.4], size = {} }}\n\
         [matte.checks]\nka = 1\nkd = 0.8\ncolor = {{ even = [0.9, 0.2, 0.1], odd = [0.1, 0.7, 0.2], size = {} }}\n\
         [mirror.ball]\nkr = 0.8\ncolor = [1, 1, 1]\n",
        point(eye.x, eye.y, eye.z),
        point(0.0, 0.5, 0.0),
        0.2 * unit,
        distance * unit,
        point(-2.0, 3.0, 2.0),
        1.3 * unit,
        0.125 * unit,
    );
    let mut add = |kind: &str, keys: String, material: &str| {
        toml += &format!("[[{kind}]]\n{keys}\nmaterial = \"{material}\"\n");
    };
    add("plane", format!("point = {}\nnormal = [0, 1, 0]", point(0.0, 0.0, 0.0)), "floor");
    let corners = [point(-1.5, 0.0, -0.5), point(-1.0, 0.125, 0.75)];
    add("box", format!("lower = {}\nupper = {}", corners[0], corners[1]), "checks");
    let corners = [point(0.9, 0.0, 0.3), point(1.4, 0.0, -0.2), point(1.1, 0.9, 0.1)];
    add("triangle", format!("vertices = [{}]", corners.join(", ")), "floor");
    // From far away, mirror images in the ball are too small to be compared with f64.
    let ball = if distance < 100.0 { "ball" } else { "floor" };
    if faceted {
        let on_ball = |across: u32, up: u32| {
            let (turn, height) = (TAU * f64::from(across) / 24.0, TAU * f64::from(up) / 24.0);
            point(0.5 * turn.cos() * height.sin(), 0.5 - 0.5 * height.cos(), 0.5 * turn.sin() * height.sin())
        };
        for (across, up) in (0..24).flat_map(|across| (0..12).map(move |up| (across, up))) {
            let [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| on_ball(across + x, up + y));
            if up > 0 {
                add("triangle", format!("vertices = [{a}, {b}, {c}]"), ball);
            }
            if up < 11 {
                add("triangle", format!("vertices = [{a}, {c}, {d}]"), ball);
            }
        }
    } else {
        add("sphere", format!("center = {}\nradius = {}", point(0.0, 0.5, 0.0), 0.5 * unit), ball);
    }
    settings_of(&toml, [64, 48], 4)
}

/// How much may differ where a ray's direction is rounded: at the edges, by as much of a pixel as the distance has
/// roundings.
const SHARE_AN_UNIT: f64 = 1e-6;

/// The largest share of a picture's samples that are not the oracle's.
fn hold(gpu: &Gpu, places: &[Place]) -> Result<String> {
    let mut renderer: Renderer = gpu.renderer(&still_life(places[0]));
    let mut largest = 0.0_f64;
    for place in places {
        let (share, brightness) = match verify(&mut renderer, &still_life(*place)) {
            Ok(agreement) => (agreement.mismatch_share(), agreement.brightness_difference()),
            Err(Error::Disagreement { mismatches, brightness, .. }) => (mismatches, brightness),
            Err(error) => return Err(error.into()),
        };
        let allowed = MAX_MISMATCH_SHARE + SHARE_AN_UNIT * place.distance;
        ensure!(
            share < allowed && brightness.abs() < MAX_MISMATCH_SHARE,
            "{place:?}: {share:.1e} differ, {brightness:.1e} brighter"
        );
        largest = largest.max(share);
        ensure!(renderer.progress().rejected_samples == 0, "{place:?}: samples are rejected");
    }
    Ok(format!("{} places, at most {largest:.1e} of a picture's samples differ", places.len()))
}

/// Catches shadows that leave what casts them, or that a surface casts on itself, and rays that pass between the
/// triangles of a mesh, where a long lens looks from far away.
#[test]
fn from_far_away_it_is_the_same_still_life() {
    let mut places = Vec::new();
    for distance in [9.0, 500.0, 2500.0, 11_000.0] {
        places.extend([false, true].map(|faceted| Place { distance, faceted, ..HERE }));
    }
    prove(|gpu| hold(gpu, &places), &["offset_by_the_length_of_the_ray", "hits_beside_their_surface"]);
}

/// Catches rays that pass between the triangles of a closed mesh, where they come from far away: each must meet the
/// ball's near side.
#[test]
fn a_mesh_is_closed_from_far_away_too() {
    let settings = still_life(Place { faceted: true, ..HERE });
    let mut random = fastrand::Rng::with_seed(5);
    let mut questions = Vec::new();
    for distance in [10.0, 1e3, 1e4, 1e5] {
        for _ in 0..4096 {
            let mut place = || dvec3(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5);
            // The ray comes from above, and passes the middle at four fifths of the radius at most.
            let middle = dvec3(0.0, 0.5, 0.0);
            let from = (place() + 0.6 * DVec3::Y).normalize();
            let aim = middle + 0.46 * place();
            let limit = distance as f32;
            questions.push(RayQuestion { limit, ..RayQuestion::new(aim + distance * from, -from) });
        }
    }
    let check = |gpu: &Gpu| -> Result<String> {
        let answers: Vec<RayAnswer> =
            probe(gpu, "intersect", Some(&settings.estimator.scene), &[], &questions);
        let through =
            questions.iter().zip(&answers).filter(|(question, answer)| answer.distance >= question.limit);
        let through = through.count();
        ensure!(through == 0, "{through} of {} rays pass through", questions.len());
        Ok(format!("{} rays meet the near side", questions.len()))
    };
    prove(check, &["rays_that_start_at_the_eye"]);
}

/// Catches shadows and checkers that are lost far from the origin: in kilometres from a village's corner, and in a
/// country's map coordinates.
#[test]
fn far_from_the_origin_it_is_the_same_still_life() {
    let mut places = Vec::new();
    for at in
        [dvec3(20_000.0, 0.0, 20_000.0), dvec3(500_000.3, 4100.25, -4_500_000.7), dvec3(0.0, 4096.0, 0.0)]
    {
        places.extend([false, true].map(|faceted| Place { at, faceted, ..HERE }));
    }
    prove(|gpu| hold(gpu, &places), &["checker_without_its_phase"]);
}

/// Catches lengths that are no share of anything: the same in millimetres, in kilometres, and smaller still, and
/// both at once.
#[test]
fn in_other_units_it_is_the_same_still_life() {
    let mut places = Vec::new();
    for (unit, at) in
        [(1000.0, DVec3::ZERO), (1e-3, DVec3::ZERO), (1e6, DVec3::ZERO), (100.0, dvec3(0.0, 4100.0, 0.0))]
    {
        places.extend([false, true].map(|faceted| Place { unit, at, faceted, ..HERE }));
    }
    prove(|gpu| hold(gpu, &places), &["checker_shifted_by_a_length", "checker_shifted_the_other_way"]);
}

/// Catches a node's children that are not there but are met all the same, from so far away that the slack of the
/// boxes is larger than they are: the search goes astray among other nodes' records.
#[test]
fn from_afar_no_child_is_met_that_is_not_there() {
    let mut toml = String::from(
        "[camera]\neye = [0, 1, 5]\nlook_at = [0, 1, 0]\nvfov_degrees = 30\nlens_diameter = 0\n\
         focal_distance = 5\n[ambient]\nradiance = 1\n[[point]]\nposition = [0, 5, 5]\nradiance = 2\n\
         [matte.m]\nka = 1\nkd = 1\ncolor = [1, 1, 1]\n[[sphere]]\ncenter = [0, 1, 0]\nradius = 1e8\n\
         material = \"m\"\n",
    );
    for number in 0..70 {
        let (x, z) = (number % 10 - 5, number / 10 - 5);
        toml += &format!("[[sphere]]\ncenter = [{x}, -5, {z}]\nradius = 0.1\nmaterial = \"m\"\n");
    }
    let settings = settings_of(&toml, [32, 24], 1);
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings);
        common::render(&mut renderer, &settings)?;
        let rejected = renderer.progress().rejected_samples;
        ensure!(rejected == 0, "{rejected} of 768 samples are given up");
        Ok("no sample is given up".into())
    };
    prove(check, &["tree_children_that_are_not_there"]);
}

/// Catches a picture whose f32 are too coarse and that nobody is warned of, and a warning where all is well.
#[test]
fn a_warning_says_where_f32_is_too_coarse() {
    let near_by = |place: Place| still_life(place).estimator.too_coarse();
    for place in [
        HERE,
        Place { distance: 11_000.0, ..HERE },
        Place { at: dvec3(500_000.3, 4100.25, -4_500_000.7), ..HERE },
        Place { unit: 1e-3, ..HERE },
    ] {
        assert_eq!(near_by(place), None, "{place:?}");
    }
    // The camera flies off to another country.
    let mut settings = still_life(HERE);
    settings.estimator.camera.eye += dvec3(0.0, 0.0, 3e6);
    settings.estimator.camera.look_at += dvec3(0.0, 0.0, 3e6);
    let warning = settings.estimator.too_coarse();
    assert!(warning.is_some_and(|warning| warning.contains("the middle of the scene")));
}
