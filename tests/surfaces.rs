//! What rays meet and what they show there: the shaders' functions one by one, against the oracle.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::probe::{FAR, RayAnswer, RayQuestion, probe};
use common::scenes::{EVERYTHING, PATHS, ROOM, one_behind_the_other};
use common::{Gpu, plain_scene_of, prove, scene_of};
use glam::{DVec2, DVec3, Vec3};
use std::sync::Arc;
use thinlens::gpu_types::SceneData;
use thinlens::interface::{light, material, shape, texture};
use thinlens::reference::integrator::whitted::radiance;
use thinlens::reference::intersect::intersect;
use thinlens::reference::sampler;
use thinlens::scene::{Background, Box, SceneRef, Shaded, Sphere, Triangle};
use thinlens::settings::Sampler;

/// Values in [-1, 1), four for each index.
fn random(index: u32, stream: u32) -> [f64; 4] {
    sampler::sample_values(Sampler::Random, stream, [index, 0], 0, 0).map(|value| 2.0 * value - 1.0)
}

fn random_direction(index: u32, stream: u32) -> DVec3 {
    // A point of the sphere from its height and its angle: Archimedes.
    let [height, turn, ..] = random(index, stream);
    let angle = std::f64::consts::PI * turn;
    let radius = (1.0 - height * height).sqrt();
    DVec3::new(radius * angle.cos(), height, radius * angle.sin())
}

/// Rays from all around, and from inside, the cube of half edge `extent` around the origin, half of
/// them aimed near the middle; and rays along the axes, whose directions have zeros.
fn rays(extent: f64, count: u32) -> Vec<RayQuestion> {
    let somewhere = |index, stream| {
        let [x, y, z, _] = random(index, stream);
        extent * DVec3::new(x, y, z)
    };
    let mut all: Vec<_> = (0..count)
        .map(|index| {
            let origin = somewhere(index, 1);
            let direction =
                if index % 2 == 0 { random_direction(index, 2) } else { 0.4 * somewhere(index, 3) - origin };
            RayQuestion::new(origin, direction)
        })
        .collect();
    for index in 0..count / 8 {
        for axis in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
            all.push(RayQuestion::new(somewhere(index, 4), axis));
        }
    }
    all
}

const CAMERA: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                      focal_distance = 9\n";

/// Shapes, each with a material of its own in the order of the shaders' numbers.
fn scene(shapes: &[(&str, &str)]) -> SceneRef {
    let mut toml = CAMERA.to_owned();
    for (number, (kind, keys)) in shapes.iter().enumerate() {
        toml += &format!(
            "[emissive.m{number}]\nradiance = {number}\n[[{kind}]]\n{keys}\nmaterial = \"m{number}\"\n"
        );
    }
    scene_of(&toml)
}

fn shapes() -> Vec<(&'static str, SceneRef)> {
    let sphere = ("sphere", "center = [0.3, -0.2, 0.4]\nradius = 1.3");
    let far_sphere = ("sphere", "center = [1.5, 0.5, -0.9]\nradius = 0.4");
    let a_box = ("box", "lower = [-1.2, -0.7, -0.4]\nupper = [0.9, 0.8, 1.1]");
    let triangle = ("triangle", "vertices = [[-1.5, -1, 0.3], [1.2, -0.8, -0.2], [0.1, 1.6, 0.5]]");
    let cylinder = ("cylinder", "start = [-1.1, 0.4, -0.8]\nend = [0.9, -0.6, 1.2]\nradius = 0.7");
    let rectangle = ("rectangle", "corner = [-1.4, -0.9, 0.3]\nedges = [[2, 1, -0.5], [-0.5, 2, 2]]");
    let disc = ("disc", "center = [0.2, 0.3, -0.4]\nnormal = [0.4, -1.2, 0.5]\nradius = 1.2");
    let plane = ("plane", "point = [0.2, -0.5, 0.1]\nnormal = [0.3, 2, -0.4]");
    vec![
        ("sphere", scene(&[sphere])),
        ("box", scene(&[a_box])),
        ("triangle", scene(&[triangle])),
        ("cylinder", scene(&[cylinder])),
        ("rectangle", scene(&[rectangle])),
        ("disc", scene(&[disc])),
        ("plane", scene(&[plane])),
        ("all of them", scene(&[sphere, far_sphere, a_box, triangle, cylinder, rectangle, disc, plane])),
        ("a crowd", crowd()),
        ("a chain", chain()),
    ]
}

/// Its tree is deeper than the part of the shaders' stack that is spelled out.
fn chain() -> SceneRef {
    let scene = scene_of(&(CAMERA.to_owned() + &one_behind_the_other()));
    let depth = SceneData::new(&scene, 1.0).tree_depth;
    assert!(depth > 20, "the chain's tree is {depth} deep only");
    scene
}

/// Many small shapes of each kind, enough of them for a tree.
fn crowd() -> SceneRef {
    let mut toml = CAMERA.to_owned();
    for number in 0..30 {
        toml += &format!("[emissive.m{number}]\nradiance = {number}\n");
    }
    let at = |index: u32, stream: u32| {
        let [x, y, z, size] = random(index, stream);
        (3.0 * DVec3::new(x, y, z), 0.06 + 0.05 * size)
    };
    for index in 0..250 {
        let material = format!("material = \"m{}\"\n", index % 30);
        let (center, radius) = at(index, 5);
        toml += &format!("[[sphere]]\ncenter = {center}\nradius = {radius}\n{material}");
        let (center, half) = at(index, 6);
        toml += &format!("[[box]]\nlower = {}\nupper = {}\n{material}", center - half, center + 2.0 * half);
        let (center, radius) = at(index, 17);
        let end = center + 4.0 * radius * random_direction(index, 18);
        toml += &format!("[[cylinder]]\nstart = {center}\nend = {end}\nradius = {radius}\n{material}");
        let (corner, size) = at(index, 19);
        let edge = 4.0 * size * random_direction(index, 20);
        let across = edge.cross(random_direction(index, 21));
        toml += &format!("[[rectangle]]\ncorner = {corner}\nedges = [{edge}, {across}]\n{material}");
        let (center, radius) = at(index, 22);
        let normal = random_direction(index, 23);
        toml +=
            &format!("[[disc]]\ncenter = {center}\nnormal = {normal}\nradius = {}\n{material}", 2.0 * radius);
        let (center, size) = at(index, 7);
        let [a, b] = [8, 9].map(|stream| center + 6.0 * size * random_direction(index, stream));
        toml += &format!("[[triangle]]\nvertices = [{center}, {a}, {b}]\n{material}");
    }
    scene_of(&toml)
}

/// The scene [`EVERYTHING`], and triangles with normals at their corners, so that it has a tree.
fn everything_and_smooth_triangles() -> SceneRef {
    let mut scene = plain_scene_of(EVERYTHING);
    // Without a shadow, nothing else keeps light from a surface's back.
    scene.lights[1].shadows = false;
    let shiny = scene.of_kind::<Box>().next().expect("a box").1.material;
    let mirror = scene.of_kind::<Sphere>().next().expect("a sphere").1.material;
    for index in 0..200 {
        let [x, y, z, _] = random(index, 10);
        let center = DVec3::new(2.0 * x, 1.0 + y, 2.0 * z);
        let vertices = [11, 12, 13].map(|stream| center + 0.5 * random_direction(index, stream));
        let [a, b, c] = vertices;
        let across = (b - a).cross(c - a).normalize().as_vec3();
        // The normals lean so far that some mirrored rays would go below the surface, and some normals are on its other
        // side.
        let spread = if index % 3 == 0 { 4.0 } else { 1.2 };
        let normals = [14, 15, 16]
            .map(|stream| (across + spread * random_direction(index, stream).as_vec3()).normalize());
        let material = if index % 4 == 0 { mirror } else { shiny };
        Arc::make_mut(&mut scene.shapes)
            .push(Shaded::still(Triangle { vertices, normals: Some(normals) }, material));
    }
    SceneRef::new(scene)
}

/// Catches a kind that the tests below do not ask the device about.
#[test]
fn every_kind_is_asked_about() {
    let scenes = shapes().into_iter().map(|(_, scene)| scene).chain([EVERYTHING, PATHS].map(scene_of));
    let mut there = [0; 4];
    for scene in scenes {
        let data = SceneData::new(&scene, 1.0);
        // There is one background, which is in no list.
        let lights =
            data.colors.light_kinds | u32::from(scene.background != Background::BLACK) << light::BACKGROUND;
        let kinds = [data.shape_kinds, data.colors.material_kinds, data.colors.texture_kinds, lights];
        there = [0, 1, 2, 3].map(|of| there[of] | kinds[of]);
    }
    let names = [shape::NAMES, material::NAMES, texture::NAMES, light::NAMES];
    assert_eq!(there, names.map(|names| (1 << names.len()) - 1));
}

/// Whether two places on a shape are the same: what goes around it is from 0 to 1, and begins where it ends.
fn same_place(uv: [f32; 2], expected: DVec2) -> bool {
    let [u, v] = [0, 1].map(|axis| (f64::from(uv[axis]) - expected[axis]).abs());
    let most = 2e-3 * expected.abs().max_element().max(1.0);
    v < most && (u < most || (1.0 - u).abs() < most)
}

/// Catches an intersection that is wrong anywhere: from inside, from behind, along an axis, on the
/// wrong face, or of the shape behind the nearest. Rays from everywhere, against each kind of shape
/// and all together. At an edge rounding decides what a ray meets, so a few may differ, and are counted.
#[test]
fn rays_meet_what_the_oracles_meet() {
    let check = |gpu: &Gpu| -> Result<String> {
        let questions = rays(4.0, 8192);
        let (mut met, mut missed, mut differ) = (0, 0, 0_usize);
        let (mut worst_distance, mut worst_normal) = (0.0_f64, 0.0_f64);
        for (name, scene) in shapes() {
            let mut off = Vec::new();
            for (question, answer) in
                questions.iter().zip(probe::<_, RayAnswer>(gpu, "intersect", Some(&scene), &[], &questions))
            {
                let expected = intersect(&scene, question.ray(), 0.0);
                let hit = answer.distance < FAR;
                let same = match expected {
                    None => !hit && answer.occluded == 0,
                    Some(expected) => {
                        let distance = (f64::from(answer.distance) - expected.distance).abs()
                            / expected.distance.max(1.0);
                        let normal = Vec3::from_array(answer.normal).as_dvec3();
                        // The oracle's looks at the ray's origin, the device's where the shape's own does.
                        let side = if expected.from_behind { -1.0 } else { 1.0 };
                        let turn = (normal - side * expected.normal).length();
                        let same = hit
                            && same_place(answer.uv, expected.uv)
                            && answer.occluded == 1
                            && answer.material == expected.material
                            && distance < 1e-4
                            && turn < 1e-3;
                        if same {
                            (worst_distance, worst_normal) =
                                (worst_distance.max(distance), worst_normal.max(turn));
                        }
                        same
                    }
                };
                *if expected.is_some() { &mut met } else { &mut missed } += 1;
                if !same {
                    off.push((question, answer, expected));
                }
            }
            ensure!(
                off.len() * 5000 <= questions.len(),
                "{name}: {} of {} rays differ, such as {:?}",
                off.len(),
                questions.len(),
                off[0]
            );
            differ += off.len();
        }
        Ok(format!(
            "{met} hits and {missed} misses, {differ} differ, the others by {worst_distance:.1e} of the distance and \
             {worst_normal:.1e} of the normal"
        ))
    };
    prove(check, &["hit"]);
}

/// Catches shadows cast by what lies beyond the lamp, and none by what lies just before it: whether
/// a hit counts turns where the limit passes it.
#[test]
fn only_what_lies_nearer_than_the_limit_occludes() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut count = 0;
        for (name, scene) in shapes() {
            let hits = rays(4.0, 2048).into_iter().filter_map(|question| {
                let hit = intersect(&scene, question.ray(), 0.0)?;
                // A hit at the origin's own surface is too near for a share of it to matter.
                (hit.distance > 0.01).then_some((question, hit.distance as f32))
            });
            let questions: Vec<_> = hits
                .flat_map(|(question, distance)| {
                    [0.99, 1.01, 1e6].map(|share| RayQuestion { limit: share * distance, ..question })
                })
                .collect();
            let answers: Vec<RayAnswer> = probe(gpu, "intersect", Some(&scene), &[], &questions);
            let wrong = (answers.chunks(3))
                .filter(|of_hit| [0, 1, 2].map(|i| of_hit[i].occluded) != [0, 1, 1])
                .count();
            ensure!(
                wrong * 1000 <= answers.len() / 3,
                "{name}: {wrong} of {} hits occlude wrongly",
                answers.len() / 3
            );
            count += answers.len() / 3;
        }
        Ok(format!("{count} hits, each before, behind and far below the limit"))
    };
    prove(check, &["shadow_ray"]);
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Shown {
    radiance: [f32; 3],
    rays: u32,
}

/// A lamp that many rays meet. The one among everything else is small.
const LAMP: &str = "[camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 4\n[emissive.lamp]\nradiance = 3\ncolor = [0.9, 0.6, 0.2]\n\
                    [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"lamp\"\n";

/// Catches a wrong factor, light, shadow, checker, highlight, mirror or sky: the radiance along rays
/// from everywhere in scenes with every kind of thing. At edges, of shapes, shadows and checks, a few
/// may differ, and are counted.
#[test]
fn rays_show_what_the_oracles_show() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut count, mut differ, mut worst) = (0, 0, 0.0_f64);
        for (name, scene, extent) in [
            ("everything", scene_of(EVERYTHING), 3.0),
            ("everything and smooth triangles", everything_and_smooth_triangles(), 3.0),
            ("room", scene_of(ROOM), 0.95),
            ("lamp", scene_of(LAMP), 3.0),
        ] {
            for max_bounces in [0_u32, 1, 4] {
                let rays = rays(extent, 8192);
                let shown: Vec<Shown> =
                    probe(gpu, "radiance", Some(&scene), bytemuck::bytes_of(&max_bounces), &rays);
                let mut off = 0;
                for (ray, shown) in rays.iter().zip(shown) {
                    let got = Vec3::from_array(shown.radiance).as_dvec3();
                    ensure!(got.is_finite(), "{name}: {ray:?} shows {got}");
                    ensure!(shown.rays >= 1, "a ray that is not counted");
                    let expected = radiance(&scene, ray.ray(), max_bounces);
                    let error = (got - expected).abs().max_element() / expected.max_element().max(1.0);
                    if error > 2e-4 {
                        off += 1;
                    } else {
                        worst = worst.max(error);
                    }
                }
                ensure!(
                    off * 400 <= rays.len(),
                    "{name}, {max_bounces} bounces: {off} of {} rays differ",
                    rays.len()
                );
                (count, differ) = (count + rays.len(), differ + off);
            }
        }
        Ok(format!("{count} rays, {differ} differ, the others by {worst:.1e} at most"))
    };
    prove(check, &["shading"]);
}
