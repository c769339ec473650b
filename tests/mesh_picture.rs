//! How meshes are shown: the stage around a lone one, and light on smooth normals.

mod common;

use common::Gpu;
use common::mesh::{HEAD, across, load, sphere};
use glam::{DVec3, Vec3};
use std::fmt::Write;
use thinlens::reference::Ray;
use thinlens::reference::integrator::whitted::radiance;
use thinlens::reference::intersect::intersect;
use thinlens::scene::{Plane, Scene, SceneRef, Triangle};
use thinlens::settings::Settings;

/// Catches a mesh that leaves the picture or is lost in it, floats above or sinks into the ground, or is
/// focused elsewhere than on its nearest point; for sizes from a tenth of a millimetre to ten thousand
/// kilometres, far from the origin, flat, thin, or a single triangle.
#[test]
fn a_lone_mesh_is_framed_and_in_focus_at_its_nearest_point() {
    let mut random = fastrand::Rng::with_seed(7);
    for case in 0..400 {
        let size = 10_f64.powf(random.f64() * 9.0 - 3.0);
        let mut extent = DVec3::new(random.f64(), random.f64(), random.f64()) * size;
        if case % 4 == 1 {
            extent[random.usize(0..3)] = 0.0;
        }
        let offset = DVec3::new(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5) * 20.0 * size;
        let count = if case % 5 == 2 { 3 } else { 30 };
        let mut obj = String::new();
        for _ in 0..count {
            let at = offset + extent * DVec3::new(random.f64(), random.f64(), random.f64());
            writeln!(obj, "v {} {} {}", at.x, at.y, at.z).expect("text");
        }
        (1..=count - 2).for_each(|i| writeln!(obj, "f {i} {} {}", i + 1, i + 2).expect("text"));
        let scene = match load(&[("some.obj", obj.as_bytes())]) {
            Ok(scene) => scene,
            Err(error) => panic!("{error} for size {size}"),
        };
        assert_eq!(scene.name, "some.obj");
        check_stage(&scene);
        Settings::of_scene(SceneRef::new(scene)).check().expect("every number is in its range");
    }
}

fn check_stage(scene: &Scene) {
    let (camera, lens) = (&scene.camera, &scene.lens);
    let frame = camera.frame();
    let vertices: Vec<DVec3> =
        scene.of_kind::<Triangle>().flat_map(|(triangle, _)| triangle.vertices).collect();
    let lower = vertices.iter().copied().reduce(DVec3::min).expect("vertices");
    let upper = vertices.iter().copied().reduce(DVec3::max).expect("vertices");
    let diagonal = (upper - lower).length();
    let highest = (0.5 * camera.vfov_radians).tan();
    let widest = highest * f64::from(scene.size[0]) / f64::from(scene.size[1]);
    let mut fill = 0_f64;
    for corner in 0..8_u32 {
        let bits = DVec3::from_array([0, 1, 2].map(|bit| f64::from(corner >> bit & 1)));
        let at = lower + bits * (upper - lower) - camera.eye;
        let depth = -at.dot(frame.w());
        assert!(depth > 0.05 * diagonal, "the eye stands clear of the mesh");
        fill = fill.max((at.dot(frame.u()) / depth / widest).abs());
        fill = fill.max((at.dot(frame.v()) / depth / highest).abs());
    }
    // A box that the camera looks along is held farther away than it would need.
    assert!((0.3..0.85).contains(&fill), "the box fills {fill} of the picture");
    let ground = *scene.of_kind::<Plane>().next().expect("a plane").0;
    let gap = (lower.y - ground.point.y) / diagonal;
    assert!(ground.normal == Vec3::Y && (0.0..2e-3).contains(&gap), "the mesh is {gap} above the ground");
    let depths = vertices.iter().map(|vertex| frame.axial_depth(camera.eye, *vertex));
    let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(near, far), z| (near.min(z), far.max(z)));
    let focus = f64::from(lens.focal_distance);
    assert!((focus / near - 1.0).abs() < 1e-5, "{focus} is not {near}");
    let k = camera.view_distance_pixels(720);
    let blur = common::circle_of_confusion(f64::from(lens.diameter), focus, far, k);
    let distant = common::circle_of_confusion(f64::from(lens.diameter), focus, 1e3 * focus, k);
    assert!(blur < 18.1 && distant > 18.0, "blurred over {blur} pixels, the distance over {distant}");
    assert!(far < 1.2 * near || blur > 8.0, "blurred over {blur} pixels only, from {near} to {far}");
    assert!(
        scene.lights.iter().any(|light| light.shadows) && scene.lights.iter().any(|light| !light.shadows)
    );
}

/// Catches an oracle that shades with the wrong corner's normal, or with none: on a sphere's
/// triangles, the given normals are the sphere's, so at corners the shading normal is the position, and
/// in between the corners' mean.
#[test]
fn the_oracle_interpolates_normals() {
    let toml = format!("{HEAD}[[mesh]]\nfile = \"m.obj\"\n");
    let obj = sphere(3, false, true);
    let scene = load(&[("t.toml", toml.as_bytes()), ("m.obj", obj.as_bytes())]).expect("a mesh");
    let mut random = fastrand::Rng::with_seed(3);
    for (triangle, _) in scene.of_kind::<Triangle>() {
        let corners = triangle.vertices;
        let flat = across(triangle).normalize();
        let outward = if flat.dot(corners[0]) > 0.0 { flat } else { -flat };
        let mut weights = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        weights.extend((0..5).map(|_| {
            let (a, b) = (random.f64(), random.f64());
            if a + b < 1.0 { [a, b, 1.0 - a - b] } else { [1.0 - a, 1.0 - b, a + b - 1.0] }
        }));
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        for [a, b, c] in weights {
            // A little inwards, for a ray that meets an edge may pass by.
            let at = (a * corners[0] + b * corners[1] + c * corners[2]).lerp(middle, 1e-6);
            let expected = (a * corners[0] + b * corners[1] + c * corners[2]).normalize();
            for side in [1.0, -1.0] {
                let direction = -side * outward;
                let ray = Ray { origin: at - 0.1 * direction, direction, time: 0.0 };
                let hit = intersect(&scene, ray, 0.0).expect("it meets the triangle");
                assert!((hit.distance - 0.1).abs() < 1e-6, "{hit:?}");
                assert!((hit.normal - side * outward).length() < 1e-6, "{hit:?}");
                assert!((hit.shading_normal - side * expected).length() < 1e-5, "{hit:?}, not {expected}");
            }
        }
    }
}

/// Catches light and mirrors that use the wrong one of the two normals. The floor lies in y = 0; its
/// normals are those given.
#[test]
fn light_and_mirrors_see_the_shading_normal_above_the_surface() {
    let floor = |normals: [&str; 3], rest: &str| {
        let toml = format!("{HEAD}{rest}[[mesh]]\nfile = \"m.obj\"\nmaterial = \"m\"\n");
        let [a, b, c] = normals;
        let obj = format!("v -9 0 9\nv 9 0 9\nv 0 0 -9\nvn {a}\nvn {b}\nvn {c}\nf 1//1 2//2 3//3\n");
        load(&[("t.toml", toml.as_bytes()), ("m.obj", obj.as_bytes())]).expect("a mesh")
    };
    let light = |direction: &str| {
        format!(
            "[[directional]]\ndirection = {direction}\nradiance = 2\n[matte.m]\nka = 0\nkd = 1\ncolor = [1, 1, 1]\n"
        )
    };
    let down = Ray { origin: DVec3::Y, direction: -DVec3::Y, time: 0.0 };
    let matte = |cosine: f64| DVec3::splat(2.0 / std::f64::consts::PI * cosine);
    for (normal, direction, expected) in [
        ("0 1 0", "[0, 1, 0]", matte(1.0)),
        ("3 4 0", "[0, 1, 0]", matte(0.8)),
        ("-3 -4 0", "[0, 1, 0]", matte(0.8)),
        ("3 4 0", "[3, 4, 0]", matte(1.0)),
        // Below the surface, and behind the shading normal.
        ("4 3 0", "[4, -1, 0]", matte(0.0)),
        ("4 3 0", "[-4, 1, 0]", matte(0.0)),
    ] {
        let got = radiance(&floor([normal; 3], &light(direction)), down, 0);
        assert!((got - expected).length() < 1e-6, "{normal}, light from {direction}: {got}, not {expected}");
    }
    // A sum of zero falls back to the geometric normal.
    let zero = floor(["1 0 0", "-1 0 0", "0 0 1"], &light("[0, 1, 0]"));
    let ray = Ray { origin: DVec3::new(0.0, 1.0, 9.0 - 1e-9), direction: -DVec3::Y, time: 0.0 };
    assert!((radiance(&zero, ray, 0) - matte(0.0)).length() < 1e-3, "almost zero is not zero");
    let zero = floor(["1 0 0", "-1 0 0", "0 1 0"], &light("[0, 1, 0]"));
    let ray = Ray { origin: DVec3::new(0.0, 1.0, 9.0), direction: -DVec3::Y, time: 0.0 };
    assert!((radiance(&zero, ray, 0) - matte(1.0)).length() < 1e-6);

    let sky =
        "[background]\nhorizon = [0, 0, 0]\nzenith = [1, 1, 1]\n[mirror.m]\nkr = 1\ncolor = [1, 1, 1]\n";
    let slanted = Ray { origin: DVec3::Y, direction: DVec3::new(0.6, -0.8, 0.0), time: 0.0 };
    for (normal, height) in [
        ("0 1 0", 0.8_f64),
        // Turned by 10 degrees: the mirrored ray turns by 20.
        ("0.173648178 0.984807753 0", (53.130_102_f64 - 20.0).to_radians().sin()),
        // Turned by 30 degrees: the mirrored ray would go below the surface, and is turned above it by as much.
        ("0.5 0.866025404 0", (60.0 - 53.130_102_f64).to_radians().sin()),
    ] {
        let got = radiance(&floor([normal; 3], sky), slanted, 1);
        let expected = height * (2.0 - height);
        assert!((got - DVec3::splat(expected)).length() < 1e-6, "{normal}: {got}, not {expected}");
    }
}

/// Catches a tree of a single shape that is taken for none: it was not shown.
#[test]
fn a_mesh_of_one_triangle_is_shown() {
    let gpu = Gpu::new();
    let scene = load(&[("one.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]).expect("a mesh");
    let mut settings = Settings::of_scene(SceneRef::new(scene));
    (settings.estimator.size, settings.samples) = ([64, 36], 4);
    thinlens::verify::verify(&mut gpu.renderer(&settings), &settings)
        .unwrap_or_else(|error| panic!("{error}"));
}
