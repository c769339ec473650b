//! The oracle against closed forms.

mod common;

use common::scenes::FIXED_POINTS;
use common::{scene_of, settings_of};
use glam::DVec3;
use thinlens::reference::film::Film;
use thinlens::reference::integrator::whitted::radiance;
use thinlens::reference::intersect::intersect;
use thinlens::reference::sampler::{concentric_disk, pcg4d, sample_values};
use thinlens::reference::{Ray, Reference, tone};
use thinlens::settings::Sampler;

/// Catches an oracle whose disk map is not Shirley and Chiu's: centre, axes and corners are known,
/// radii stay within one, and the moments are those of a uniform disk.
#[test]
fn the_disk_map_is_concentric() {
    let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12;
    for (square, disk) in FIXED_POINTS {
        assert!(close(concentric_disk(square), disk), "{square:?} to {:?}", concentric_disk(square));
    }
    let n = 400;
    let (mut sum, mut square) = (DVec3::ZERO, DVec3::ZERO);
    for i in 0..n * n {
        let xi = [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
        let [x, y] = concentric_disk(xi);
        assert!(x * x + y * y <= 1.0 + 1e-12);
        sum += DVec3::new(x, y, 0.0);
        square += DVec3::new(x * x, y * y, x * y);
    }
    let (mean, square) = (sum / f64::from(n * n), square / f64::from(n * n));
    assert!(mean.length() < 1e-9, "{mean}");
    assert!((square - DVec3::new(0.25, 0.25, 0.0)).length() < 1e-5, "{square}");
}

/// Catches a hash that is off by a constant: these values come from the definition, worked out apart
/// from this program.
#[test]
fn the_sampler_is_the_one_that_is_cited() {
    assert_eq!(pcg4d([1, 2, 3, 4]), [0x3622_cd16, 0xf114_71d8, 0xe110_9b3f, 0x02b9_4c2f]);
    assert_eq!(pcg4d([640, 480, u32::MAX, 7]), [0x38a5_b8b8, 0xc6be_f138, 0x29d3_dc31, 0x5159_ac80]);
    let mut sums = [0.0; 4];
    for index in 0..10_000 {
        let values = sample_values(Sampler::Random, 3, [17, 5], index, 0);
        for (sum, value) in sums.iter_mut().zip(values) {
            assert!((0.0..1.0).contains(&value));
            *sum += value / 10_000.0;
        }
    }
    // Five standard deviations of the mean of 10,000 uniform values.
    assert!(sums.iter().all(|mean| (mean - 0.5).abs() < 5.0 * (1.0_f64 / 12.0).sqrt() / 100.0), "{sums:?}");
}

const CAMERA: &str = "[camera]\neye = [1, 2, 3]\nlook_at = [0, 1, -4]\nvfov_degrees = 70\n\
                      lens_diameter = 0.8\nfocal_distance = 6\n";

/// Catches a focal sphere, and a field of view measured to the wrong edge: every primary ray of a
/// film position, whatever its lens point, passes through one point of the focal plane, and that
/// point projects back to the film position.
#[test]
fn primary_rays_meet_in_the_focal_plane() {
    let settings = settings_of(CAMERA, [40, 30], 1);
    let estimator = &settings.estimator;
    let frame = estimator.camera.frame();
    let eye = estimator.camera.eye;
    let reference = Reference::new(estimator);
    for pixel in [[0, 0], [39, 0], [0, 29], [39, 29], [20, 15], [7, 22]] {
        for index in 0..50 {
            let sample = reference.sample(pixel, index);
            let along = sample.ray.direction.dot(-frame.w());
            let start = (sample.ray.origin - eye).dot(-frame.w());
            let focus = sample.ray.origin + (6.0 - start) / along * sample.ray.direction;
            // Back through the lens centre: slope times height over twice the half height's slope.
            let relative = focus - eye;
            let k = 15.0 / 35_f64.to_radians().tan();
            let x = 20.0 + k * relative.dot(frame.u()) / 6.0;
            let y = 15.0 - k * relative.dot(frame.v()) / 6.0;
            let expected = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + sample.offset[axis]);
            assert!((x - expected[0]).abs() < 1e-9 && (y - expected[1]).abs() < 1e-9, "{pixel:?}, {index}");
            // Two values for the film, two others for the lens.
            let xi = sample_values(estimator.sampler, estimator.seed, pixel, index, 0);
            assert_eq!(sample.offset, [xi[0] - 0.5, xi[1] - 0.5]);
            let [a, b] =
                concentric_disk([xi[2], xi[3]]).map(|value| value * f64::from(estimator.lens.diameter) / 2.0);
            let lens_point = eye + a * frame.u() + b * frame.v();
            assert!((sample.ray.origin - lens_point).length() < 1e-12, "{pixel:?}, {index}");
        }
    }
}

/// Catches wrong factors in the shading: each term alone has a value that can be written down.
#[test]
fn shading_has_the_values_of_its_formulas() {
    let floor = "[camera]\neye = [0, 5, 0]\nlook_at = [0, 0, 0]\nup = [0, 0, -1]\nvfov_degrees = 1\n\
                 lens_diameter = 0\nfocal_distance = 5\n[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 2, 0]\n\
                 material = \"m\"\n";
    let matte = "[matte.m]\nka = 0.5\nkd = 0.6\ncolor = [1, 0.5, 0.25]\n";
    let light = |direction: &str| format!("[[directional]]\ndirection = {direction}\nradiance = 3\n");
    let lit = |cosine: f64| DVec3::new(1.0, 0.5, 0.25) * (0.6 / std::f64::consts::PI * 3.0 * cosine);
    let blocker = "[[sphere]]\ncenter = [3, 3, 0]\nradius = 0.5\nmaterial = \"m\"\n";
    let slanted = light("[1, 1, 0]");
    let cases = [
        (format!("[ambient]\nradiance = 2\n{matte}"), DVec3::new(1.0, 0.5, 0.25)),
        (format!("{}{matte}", light("[0, 1, 0]")), lit(1.0)),
        (format!("{slanted}{matte}"), lit(0.5_f64.sqrt())),
        (format!("{}{matte}", light("[0, -1, 0]")), DVec3::ZERO),
        (format!("{slanted}{matte}{blocker}"), DVec3::ZERO),
        (format!("{slanted}shadows = false\n{matte}{blocker}"), lit(0.5_f64.sqrt())),
        (format!("[[point]]\nposition = [3, 3, 0]\nradiance = 3\n{matte}"), lit(0.5_f64.sqrt())),
        // What lies beyond the lamp throws no shadow, what lies before it does.
        (format!("[[point]]\nposition = [1, 1, 0]\nradiance = 3\n{matte}{blocker}"), lit(0.5_f64.sqrt())),
        (format!("[[point]]\nposition = [5, 5, 0]\nradiance = 3\n{matte}{blocker}"), DVec3::ZERO),
        ("[emissive.m]\nradiance = 4\ncolor = [0.5, 1, 0]\n".into(), DVec3::new(2.0, 4.0, 0.0)),
        (
            "[background]\nhorizon = [0, 0, 0]\nzenith = [1, 1, 1]\n[mirror.m]\nkr = 0.5\ncolor = [1, 0.5, 0]\n".into(),
            DVec3::new(0.5, 0.25, 0.0),
        ),
        (
            format!("{}[phong.m]\nka = 0\nkd = 0\nks = 0.5\nexponent = 9\ncolor = [1, 1, 1]\n", light("[0, 1, 0]")),
            DVec3::splat(1.5),
        ),
    ];
    for (scene, expected) in cases {
        let settings = settings_of(&format!("{floor}{scene}"), [1, 1], 1);
        let mut estimator = settings.estimator.clone();
        estimator.jitter = 0.0;
        let radiance = Reference::new(&estimator).sample([0, 0], 0).radiance;
        assert!((radiance - expected).length() < 1e-6, "{scene}: {radiance}, not {expected}");
    }
}

/// Catches an intersection with the wrong root, face, side or order: each of these rays meets what a
/// drawing shows. Materials are numbered in the order of the shapes.
#[test]
fn rays_meet_shapes_where_a_drawing_shows() {
    let names = ["a", "b", "c", "d", "e"];
    let materials = names.map(|name| format!("[emissive.{name}]\nradiance = 1\n")).concat();
    let scene = scene_of(&format!(
        "{CAMERA}{materials}[[sphere]]\ncenter = [10, 0, 0]\nradius = 2\nmaterial = \"a\"\n\
         [[box]]\nlower = [-1, -2, -3]\nupper = [1, 2, 3]\nmaterial = \"b\"\n\
         [[triangle]]\nvertices = [[0, 5, 0], [4, 5, 0], [0, 5, 4]]\nmaterial = \"c\"\n\
         [[plane]]\npoint = [7, -9, 3]\nnormal = [0, -3, 0]\nmaterial = \"d\"\n\
         [[plane]]\npoint = [0, 30, 40]\nnormal = [0, 3, 4]\nmaterial = \"e\"\n"
    ));
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let at = DVec3::new;
    let material = |name: &str| {
        let found = names.iter().position(|other| *other == name).expect("a material");
        u32::try_from(found).expect("few materials")
    };
    for (origin, direction, expected) in [
        // The sphere from outside, inside, and off its centre by sqrt(3), where half a chord is 1.
        (at(20.0, 0.0, 0.0), -x, Some((8.0, x, "a"))),
        (at(10.0, 0.0, 0.0), x, Some((2.0, -x, "a"))),
        (at(20.0, 3_f64.sqrt(), 0.0), -x, Some((9.0, at(0.5, 0.75_f64.sqrt(), 0.0), "a"))),
        // The box from each side and from inside; beside it goes on to the plane.
        (at(5.0, 0.0, 0.0), -x, Some((4.0, x, "b"))),
        (at(0.0, -5.0, 0.0), y, Some((3.0, -y, "b"))),
        (at(0.5, 1.0, -7.0), z, Some((4.0, -z, "b"))),
        (at(0.0, 0.0, 0.0), -z, Some((3.0, z, "b"))),
        (at(-1.5, 0.0, 0.0), -y, Some((9.0, y, "d"))),
        // The triangle from above and below, and beside its long edge.
        (at(1.0, 6.0, 1.0), -y, Some((1.0, y, "c"))),
        (at(1.0, 4.5, 2.9), y, Some((0.5, -y, "c"))),
        (at(2.1, 6.0, 2.1), -y, Some((15.0, y, "d"))),
        // The slanted plane at distance 50 from the origin, and away from everything.
        (at(0.0, 0.0, 40.0), at(0.0, 0.6, 0.8), Some((18.0, at(0.0, -0.6, -0.8), "e"))),
        (at(0.0, 0.0, 40.0), at(1.0, 0.0, 0.0), None),
    ] {
        let hit = intersect(&scene, Ray { origin, direction, time: 0.0 }, 0.0);
        let Some((distance, normal, name)) = expected else {
            assert_eq!(hit, None, "{origin} along {direction}");
            continue;
        };
        let hit = hit.unwrap_or_else(|| panic!("{origin} along {direction} meets nothing"));
        let close = (hit.distance - distance).abs() < 1e-6 && (hit.normal - normal).length() < 1e-6;
        assert!(close && hit.material == material(name), "{origin} along {direction}: {hit:?}");
        let beyond = intersect(&scene, Ray { origin, direction, time: 0.0 }, distance + 1e-3);
        assert!(beyond.is_none_or(|beyond| beyond.distance > distance + 1e-3), "{beyond:?} is too near");
    }
}

/// Catches a checker of the wrong size, shift or parity, also below zero; a sky upside down or of
/// another curve; a highlight around the wrong direction; and reflections that stop early or late.
#[test]
fn pictures_have_the_values_of_their_formulas() {
    let ground = "[ambient]\nradiance = 1\n[matte.m]\nka = 1\nkd = 0\n\
                  color = { even = [1, 1, 1], odd = [0, 0, 0], size = 2 }\n\
                  [[plane]]\npoint = [0, 1, 0]\nnormal = [0, 1, 0]\nmaterial = \"m\"\n";
    let down = |x: f64, z: f64| (DVec3::new(x, 5.0, z), -DVec3::Y);
    let sky = "[background]\nhorizon = [1, 0, 0]\nzenith = [0, 0, 1]\n";
    let slope = DVec3::new(3.0, 4.0, 0.0) / 5.0;
    // Two mirrors face each other below a lamp that both show; each reflection keeps half.
    let mirrors = "[background]\ncolor = [1, 1, 1]\n[mirror.m]\nkr = 0.5\ncolor = [1, 1, 1]\nks = 0\n\
                   [[plane]]\npoint = [-1, 0, 0]\nnormal = [1, 0, 0]\nmaterial = \"m\"\n\
                   [[plane]]\npoint = [1, 0, 0]\nnormal = [1, 0, 0]\nmaterial = \"m\"\n\
                   [emissive.lamp]\nradiance = 16\n\
                   [[plane]]\npoint = [0, 10, 0]\nnormal = [0, 1, 0]\nmaterial = \"lamp\"\n";
    // 45 degrees: 10 up means 10 across, five mirrors on the way.
    let up = (DVec3::new(0.0, 0.5, 0.0), DVec3::new(1.0, 1.0, 0.0).normalize());
    let gloss = "[[directional]]\ndirection = [1, 1, 0]\nradiance = 2\n[phong.m]\nka = 0\nkd = 0\nks = 0.25\n\
                 exponent = 3\ncolor = [1, 0, 0]\n\
                 [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"m\"\n";
    // The mirrored light leaves along (-1, 1, 0) / sqrt(2), and the eye is a little beside that.
    let highlight = 0.25 * (1.4 * 0.5_f64.sqrt()).powi(3) * 2.0 * 0.5_f64.sqrt();
    let aside = (DVec3::new(-6.0, 8.0, 0.0), DVec3::new(0.6, -0.8, 0.0));
    let all = DVec3::splat;
    for (scene, (origin, direction), bounces, expected) in [
        (ground, down(0.5, 0.5), 0, all(1.0)),
        (ground, down(2.5, 0.5), 0, all(0.0)),
        (ground, down(2.5, 3.5), 0, all(1.0)),
        (&ground.replace("[0, 1, 0]\nnormal", "[0, 3, 0]\nnormal"), down(2.5, 3.5), 0, all(0.0)),
        (ground, down(-0.5, 0.5), 0, all(0.0)),
        (ground, down(-0.5, -3.0), 0, all(0.0)),
        (ground, down(0.0001, 0.5), 0, all(1.0)),
        // The boundary of two cells belongs to the lower one.
        (ground, down(0.0, 0.5), 0, all(0.0)),
        (&ground.replace("[0, 1, 0]\nnormal", "[0, 2, 0]\nnormal"), down(0.5, 0.5), 0, all(1.0)),
        (sky, (DVec3::ZERO, DVec3::X), 0, DVec3::X),
        (sky, (DVec3::ZERO, -DVec3::Y), 0, DVec3::X),
        (sky, (DVec3::ZERO, DVec3::Y), 0, DVec3::Z),
        (sky, (DVec3::ZERO, slope), 0, DVec3::new(1.0 - 0.96, 0.0, 0.96)),
        (mirrors, up, 4, all(0.0)),
        (mirrors, up, 5, all(0.5)),
        (mirrors, up, 64, all(0.5)),
        (gloss, aside, 0, all(highlight)),
    ] {
        let scene = scene_of(&format!("{CAMERA}{scene}"));
        let got = radiance(&scene, Ray { origin, direction, time: 0.0 }, bounces);
        assert!(
            (got - expected).length() < 1e-6,
            "{origin} along {direction}, {bounces}: {got}, not {expected}"
        );
    }
}

/// Catches another mean, a landing in the wrong pixel, and one beside the film that is kept.
#[test]
fn the_film_averages_what_lands() {
    let mut film = Film::new([2, 1]);
    for (start, offset, value) in [
        ([0, 0], [0.0, 0.0], 1.0),
        ([0, 0], [0.49, -0.5], 4.0),
        ([1, 0], [-0.6, 0.2], 7.0),
        ([0, 0], [0.5, 0.0], 3.0),
        ([0, 0], [-0.51, 0.0], 100.0),
        ([1, 0], [0.0, 0.5], 100.0),
        ([1, 0], [0.0, 0.0], f64::NAN),
    ] {
        film.add(start, offset, DVec3::new(value, 0.5 * value, 0.0));
    }
    assert_eq!(film.rejected, 1);
    assert_eq!(film.texels(), [[4.0, 2.0, 0.0, 3.0], [3.0, 1.5, 0.0, 1.0]]);
}

/// Catches a tone curve with a step: the two branches of sRGB meet.
#[test]
fn srgb_is_continuous_and_keeps_black_and_white() {
    assert_eq!((tone::srgb(-1.0), tone::srgb(0.0)), (0.0, 0.0));
    assert!((tone::srgb(1.0) - 1.0).abs() < 1e-12 && tone::srgb(2.0) == tone::srgb(1.0));
    assert!((tone::srgb(0.003_130_8) - tone::srgb(0.003_130_9)).abs() < 1e-5);
    assert!((tone::srgb(0.214_041_14) - 0.5).abs() < 1e-6);
    assert!((tone::srgb(0.01) - 0.099_852_8).abs() < 1e-6 && (tone::srgb(0.002) - 0.025_84).abs() < 1e-6);
}
