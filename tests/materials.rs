//! What each material scatters, on the device: no light is lost or added, the way of the light can be reversed, and
//! directions are as dense as the paths believe.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::probe::probe;
use common::statistics::{fit_p, sidak};
use common::{Gpu, prove, scene_of};
use std::f64::consts::TAU;
use thinlens::reference::sampler;
use thinlens::scene::SceneRef;
use thinlens::settings::Sampler;

/// A direction to the viewer, a material, a direction to a light, and sample values.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Question {
    to_viewer: [f32; 3],
    material: u32,
    to_light: [f32; 3],
    pad0: u32,
    xi: [f32; 3],
    pad1: u32,
}

/// What `tests/probes/material.comp` answers.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Answer {
    sampled: [f32; 3],
    density: f32,
    weight: [f32; 3],
    scattered_density: f32,
    scattered: [f32; 3],
    density_of_light: f32,
    of_light: [f32; 3],
    pad0: u32,
}

const ROUGHNESS: [f64; 6] = [0.0, 0.1, 0.3, 0.5, 0.7, 1.0];

/// Every kind of material that scatters light, in this color, at every roughness that it can have. The number is the
/// roughness, or 0 if no light can be aimed at: glass scatters into single directions.
fn materials(color: &str) -> (SceneRef, Vec<(String, f64)>) {
    let color = format!("color = {color}");
    let mut kinds =
        vec![(format!("[matte.m]\n{color}\n"), 1.0), (format!("[mirror.m]\nkr = 1\n{color}\n"), 0.0)];
    for roughness in ROUGHNESS {
        kinds.push((format!("[glass.m]\nroughness = {roughness}\n"), 0.0));
    }
    for roughness in ROUGHNESS {
        for table in [
            format!("[metal.m]\n{color}\n"),
            format!("[plastic.m]\n{color}\n"),
            format!("[plastic.m]\n{color}\nindex = 2.4\n"),
            format!("[standard.m]\n{color}\n"),
            format!("[standard.m]\n{color}\nmetallic = 0.6\n"),
        ] {
            kinds.push((format!("{table}roughness = {roughness}\n"), roughness));
        }
    }
    let mut toml = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 9\n"
        .to_owned();
    for (number, (table, _)) in kinds.iter().enumerate() {
        toml += &table.replace(".m]", &format!(".m{number}]"));
        toml += &format!("[[sphere]]\ncenter = [{number}, 0, 0]\nradius = 0.4\nmaterial = \"m{number}\"\n");
    }
    (scene_of(&toml), kinds)
}

/// The number of a material in the scene.
fn number(scene: &SceneRef, kind: usize) -> u32 {
    let name = format!("m{kind}");
    let at = scene.material_names.iter().position(|of| *of == name);
    u32::try_from(at.expect("it is there")).expect("a small scene")
}

fn direction(cosine: f64, turn: f64) -> [f32; 3] {
    let sine = (1.0 - cosine * cosine).sqrt();
    [sine * (TAU * turn).cos(), sine * (TAU * turn).sin(), cosine].map(|part| part as f32)
}

fn random(index: u32, stream: u32) -> [f64; 4] {
    sampler::sample_values(Sampler::Random, stream, [index, 0], 0, 0)
}

fn ask(gpu: &Gpu, scene: &SceneRef, questions: &[Question]) -> Vec<Answer> {
    probe(gpu, "material", Some(scene), &[], questions)
}

/// Catches light that a material loses or adds: white ones reflect all of it, at every roughness and from every direction.
#[test]
fn white_materials_lose_no_light() {
    let check = |gpu: &Gpu| -> Result<String> {
        const SAMPLES: u32 = 2048;
        const ANGLES: [f64; 3] = [0.0, 60.0, 87.0];
        let (scene, kinds) = materials("[1, 1, 1]");
        let mut questions = Vec::new();
        for kind in 0..kinds.len() {
            for angle in ANGLES {
                let to_viewer = direction(angle.to_radians().cos(), 0.3);
                for index in 0..SAMPLES {
                    // These points fill the unit cube evenly: M. Roberts' generalization of the golden ratio.
                    let place = f64::from(index) + 0.5;
                    let xi = [0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9]
                        .map(|step: f64| (place * step).fract() as f32);
                    let material = number(&scene, kind);
                    questions.push(Question { to_viewer, material, xi, ..Zeroable::zeroed() });
                }
            }
        }
        let answers = ask(gpu, &scene, &questions);
        let mut worst = [0.0_f64; 2];
        for (at, answers) in answers.chunks(SAMPLES as usize).enumerate() {
            let sum: f64 = answers.iter().map(|answer| f64::from(answer.weight[1])).sum();
            let (kind, angle) = (&kinds[at / ANGLES.len()].0, ANGLES[at % ANGLES.len()]);
            let off = sum / f64::from(SAMPLES) - 1.0;
            // The table of glass is coarser.
            let of_glass = usize::from(kind.starts_with("[glass"));
            worst[of_glass] = worst[of_glass].max(off.abs());
            ensure!(
                off.abs() < [5e-3, 2e-2][of_glass],
                "at {angle} degrees, {off:.1e} of the light is added: {kind}"
            );
        }
        Ok(format!("{} materials and angles, {worst:.5?} off at most", answers.len() / SAMPLES as usize))
    };
    prove(check, &["furnace"]);
}

/// Catches a material that looks another way if light and viewer change their places.
#[test]
fn the_way_of_the_light_can_be_reversed() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (scene, kinds) = materials("[0.9, 0.5, 0.2]");
        let mut questions = Vec::new();
        for kind in 0..kinds.len() {
            for index in 0..100 {
                let [a, b, c, d] = random(index, 1);
                let (to_viewer, to_light) = (direction(a.max(0.05), b), direction(c.max(0.05), d));
                let material = number(&scene, kind);
                let question = Question { to_viewer, material, to_light, ..Zeroable::zeroed() };
                let reversed = Question { to_viewer: to_light, to_light: to_viewer, ..question };
                questions.extend([question, reversed]);
            }
        }
        let answers = ask(gpu, &scene, &questions);
        let mut worst = 0.0_f64;
        for (at, (questions, answers)) in questions.chunks(2).zip(answers.chunks(2)).enumerate() {
            let brdf = |way: usize, channel: usize| {
                f64::from(answers[way].of_light[channel]) / f64::from(questions[way].to_light[2])
            };
            for channel in 0..3 {
                let (there, back) = (brdf(0, channel), brdf(1, channel));
                let off = (there - back).abs() / there.max(1e-6);
                worst = worst.max(off);
                ensure!(off < 1e-3, "{there} one way, {back} the other: {}", kinds[at / 100].0);
            }
        }
        Ok(format!("{} pairs, {worst:.1e} off at most", answers.len() / 2))
    };
    prove(check, &["reversed"]);
}

/// The hemisphere in pieces of the same solid angle: rows of the same height, and columns.
const PIECES: [usize; 2] = [8, 12];
/// Points in a piece, along each axis, at which its density is read.
const READ: u32 = 16;

fn piece(direction: [f32; 3]) -> usize {
    let [x, y, z] = direction.map(f64::from);
    let place = |value: f64, count: usize| ((value * count as f64) as usize).min(count - 1);
    PIECES[1] * place(z, PIECES[0]) + place((y.atan2(x) / TAU).rem_euclid(1.0), PIECES[1])
}

/// Catches directions that are chosen more or less often than the paths believe, by a chi-square test of each material, and a
/// weight that is not what is scattered from the direction, divided by its density.
#[test]
fn directions_have_their_density() {
    let check = |gpu: &Gpu| -> Result<String> {
        const SAMPLES: u32 = 16384;
        let (scene, kinds) = materials("[0.9, 0.5, 0.2]");
        // Smoother ones are too narrow for the pieces. The code is the same for every roughness.
        let kinds: Vec<_> = (0..kinds.len())
            .filter(|kind| [0.3, 1.0].contains(&kinds[*kind].1))
            .flat_map(|kind| [0.9, 0.3].map(|cosine| (kind, cosine)))
            .collect();
        let [rows, columns] = PIECES.map(|count| READ * count as u32);
        let mut questions = Vec::new();
        for (kind, cosine) in &kinds {
            let (material, to_viewer) = (number(&scene, *kind), direction(*cosine, 0.1));
            let place = |at: u32, count: u32| (f64::from(at) + 0.5) / f64::from(count);
            for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
                let to_light = direction(place(row, rows), place(column, columns));
                questions.push(Question { to_viewer, material, to_light, ..Zeroable::zeroed() });
            }
            for index in 0..SAMPLES {
                let [x, y, z, _] = random(index, 2).map(|value| value as f32);
                questions.push(Question { to_viewer, material, xi: [x, y, z], ..Zeroable::zeroed() });
            }
        }
        let answers = ask(gpu, &scene, &questions);
        let read = (rows * columns) as usize;
        let each = read + SAMPLES as usize;
        let mut least = 1.0_f64;
        for ((kind, cosine), (questions, answers)) in
            kinds.iter().zip(questions.chunks(each).zip(answers.chunks(each)))
        {
            let about = format!("material {kind} at a cosine of {cosine}");
            let pieces = PIECES[0] * PIECES[1];
            let (mut expected, mut counts) = (vec![0.0; pieces + 1], vec![0.0; pieces + 1]);
            for (question, answer) in questions[..read].iter().zip(answers) {
                let share = f64::from(answer.density_of_light) * TAU / read as f64;
                expected[piece(question.to_light)] += share * f64::from(SAMPLES);
            }
            // The rest goes nowhere.
            expected[pieces] = (f64::from(SAMPLES) - expected.iter().sum::<f64>()).max(0.0);
            for answer in &answers[read..] {
                let nowhere = answer.weight == [0.0; 3];
                counts[if nowhere { pieces } else { piece(answer.sampled) }] += 1.0;
                for channel in 0..3 {
                    let [weight, share] = [answer.weight, answer.scattered].map(|of| f64::from(of[channel]));
                    let off = weight * f64::from(answer.density) - share;
                    ensure!(off.abs() <= 1e-3 * share, "{about}: a weight of {weight}: {answer:?}");
                }
                let [density, again] = [answer.density, answer.scattered_density].map(f64::from);
                ensure!(nowhere || (density / again - 1.0).abs() < 1e-3, "{about}: {density}, not {again}");
            }
            let p = fit_p(&counts, &expected);
            least = least.min(p);
            ensure!(p > sidak(kinds.len()), "{about}: p = {p:.1e}");
        }
        Ok(format!("{} materials and angles, least p = {least:.1e}", kinds.len()))
    };
    prove(check, &["lobes"]);
}
