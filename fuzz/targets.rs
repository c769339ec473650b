//! What is tried: each with what its inputs are made from, how they are changed, and what reads them.

use super::Outcome;
use super::{exr, oracle, png, seeds, text};
use clap::Parser;
use fastrand::Rng;
use glam::DVec3;
use std::ffi::{OsStr, OsString};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use thinlens::cli::{Cli, Command, SettingsArgs, ViewArgs};
use thinlens::error::{Error, Result};
use thinlens::output::Origin;
use thinlens::scene::{self, ApertureImage, Box, Plane, SceneRef, Sphere, Triangle};
use thinlens::settings::Settings;

/// Something that reads what others made.
pub struct Target {
    pub name: &'static str,
    /// Of the files with its inputs.
    pub extension: &'static str,
    pub seeds: fn() -> Vec<Vec<u8>>,
    pub mutate: fn(&mut Rng, &[u8], &[u8]) -> Vec<u8>,
    pub run: fn(&[u8]) -> Outcome,
}

pub const TARGETS: [Target; 7] = [
    Target {
        name: "scene",
        extension: "toml",
        seeds: seeds::scenes,
        mutate: |random, one, other| text::mutate(random, one, other, &seeds::SCENE_WORDS),
        run: |input| of_file("input.toml", input, input),
    },
    Target {
        name: "obj",
        extension: "obj",
        seeds: seeds::meshes,
        mutate: |random, one, other| text::mutate(random, one, other, &seeds::OBJ_WORDS),
        run: mesh,
    },
    Target {
        name: "mtl",
        extension: "mtl",
        seeds: seeds::libraries,
        mutate: |random, one, other| text::mutate(random, one, other, &seeds::MTL_WORDS),
        run: library,
    },
    Target { name: "aperture", extension: "png", seeds: seeds::images, mutate: png::mutate, run: aperture },
    Target {
        name: "from-png",
        extension: "png",
        seeds: seeds::png_pictures,
        mutate: |random, one, other| match random.u8(..3) {
            0 => png::mutate(random, one, other),
            _ => png::with_text(random, one, |random, text| text::mutate(random, text, &[], &seeds::OPTIONS)),
        },
        run: |input| picture("input.png", input),
    },
    Target {
        name: "from-exr",
        extension: "exr",
        seeds: seeds::exr_pictures,
        mutate: |random, one, other| match random.u8(..3) {
            0 => exr::mutate(random, one, other),
            _ => exr::with_text(one, |text| text::mutate(random, text, &[], &seeds::OPTIONS)),
        },
        run: |input| picture("input.exr", input),
    },
    Target {
        name: "command-line",
        extension: "txt",
        seeds: seeds::command_lines,
        mutate: |random, one, other| text::mutate(random, one, other, &seeds::OPTIONS),
        run: command_line,
    },
];

/// One of so many, the same for equal inputs, so that an input that was kept does the same again.
fn one_of(input: &[u8], many: u64) -> bool {
    let mut hasher = DefaultHasher::new();
    input.hash(&mut hasher);
    hasher.finish().is_multiple_of(many)
}

fn write(name: &str, bytes: &[u8]) {
    std::fs::write(name, bytes).expect("a writable folder");
}

/// What is wrong, or a panic for words that help nobody.
fn words(error: &Error) -> String {
    let text = error.to_string();
    assert!(!text.trim().is_empty(), "an error without words");
    text
}

/// Loads a scene or mesh from a file with these bytes.
fn of_file(name: &str, bytes: &[u8], input: &[u8]) -> Outcome {
    write(name, bytes);
    let scene = scene::load(name).map_err(|error| words(&error))?;
    let settings = Settings::of_scene(SceneRef::new(scene));
    settings.check().map_err(|error| words(&error))?;
    Ok(accepted(&settings, one_of(input, 10)))
}

/// Holds settings against all that has to hold of them, and gives what kind they are of.
fn accepted(settings: &Settings, save: bool) -> String {
    oracle::arguments(settings);
    let depth = oracle::on_device(settings);
    if save {
        oracle::saved(settings);
    }
    let (estimator, scene) = (&settings.estimator, &*settings.estimator.scene);
    let many = |count: usize| count.ilog2().min(7);
    let shapes = [
        scene.of_kind::<Sphere>().count(),
        scene.of_kind::<Box>().count(),
        scene.of_kind::<Triangle>().count(),
        scene.of_kind::<Plane>().count(),
    ];
    format!(
        "{:?} {:?} {:?} {} {:?} {:?} {:?}",
        shapes.map(|count| many(count + 1)),
        [scene.lights.len(), scene.materials.len(), depth as usize].map(|count| many(count + 1)),
        estimator.model,
        estimator.scene.moves(),
        settings.view.overlay,
        [
            estimator.aperture.blades > 0,
            estimator.aperture.image.is_some(),
            estimator.aperture.cats_eye > 0.0
        ],
        [settings.view.exposure_lock, estimator.is_adaptive(), estimator.f_number().is_finite()],
    )
}

/// An OBJ on its own, or for some inputs in a scene that places it.
fn mesh(input: &[u8]) -> Outcome {
    if one_of(input, 3) {
        write("input.obj", input);
        return of_file("around.toml", seeds::AROUND_MESH.as_bytes(), input);
    }
    of_file("input.obj", input, input)
}

/// An MTL beside a mesh that has all its names.
fn library(input: &[u8]) -> Outcome {
    write("input.mtl", input);
    let outcome = of_file("colors.obj", seeds::COLORED_MESH.as_bytes(), input)?;
    let scene = scene::load("colors.obj").map_err(|error| words(&error))?;
    let inside = |color: f64| (0.0..=1.0).contains(&color);
    let colors = scene.materials.iter().map(|material| material.brightest(DVec3::ZERO, DVec3::ONE));
    let mut distinct = Vec::new();
    for color in colors {
        assert!(color.to_array().into_iter().all(inside), "the colour {color} of an MTL file");
        let kind = color.to_array().map(|part| (part * 2.0).ceil() as u8);
        if !distinct.contains(&kind) {
            distinct.push(kind);
        }
    }
    Ok(format!("{outcome} {distinct:?}"))
}

fn aperture(input: &[u8]) -> Outcome {
    write("input.png", input);
    let image = ApertureImage::read(Path::new("input.png")).map_err(|error| words(&error))?;
    let [width, height] = image.size.map(|extent| extent as usize);
    assert!(width.max(height) <= 256 && image.cells.len() == width * height, "{image:?}");
    assert!(image.cells.iter().all(|cell| (0.0..=1.0).contains(cell)), "light of {image:?}");
    let aperture = scene::Aperture { image: Some(image), ..Default::default() };
    let area = aperture.relative_area();
    assert!(area > 0.0 && area < 1.3, "{area} of the area of a disc");
    // The header's depth, colour type and interlacing tell images apart.
    let (size, kind) = ([width, height].map(usize::ilog2), input.get(24..29));
    Ok(format!("{size:?} {kind:?} {area:.1}"))
}

/// A picture that says how it was made.
fn picture(name: &str, input: &[u8]) -> Outcome {
    write(name, input);
    let origin = Origin::read(Path::new(name)).map_err(|error| words(&error))?;
    let settings = SettingsArgs::default().of_picture(&origin.arguments).map_err(|error| words(&error))?;
    Ok(accepted(&settings, one_of(input, 10)))
}

/// A line of arguments, each on a line of its own.
fn command_line(input: &[u8]) -> Outcome {
    let arguments = input.split(|byte| *byte == b'\n').map(|word| OsString::from(OsStr::from_bytes(word)));
    let cli = Cli::try_parse_from(std::iter::once("thinlens".into()).chain(arguments));
    let cli = cli.map_err(|error| error.to_string())?;
    let command = cli.command.unwrap_or_else(|| Command::View(ViewArgs::default()));
    let kind = match &command {
        Command::View(_) => "view",
        Command::Render(_) => "render",
        Command::Sweep(_) => "sweep",
        Command::Diagram(_) => "diagram",
        Command::Save(_) => "save",
        Command::Verify(_) => "verify",
        Command::Bench(_) => "bench",
        Command::Scenes => "scenes",
        Command::Devices => "devices",
    };
    let save = matches!(command, Command::Save(_));
    let pictures = pictures(command).map_err(|error| words(&error))?;
    let kinds: Vec<String> = pictures.iter().take(2).map(|settings| accepted(settings, save)).collect();
    Ok(format!("{kind} {kinds:?}"))
}

/// The settings of all pictures that a command asks for, as the program makes them.
fn pictures(command: Command) -> Result<Vec<Settings>> {
    Ok(match command {
        Command::View(args) => vec![args.settings.for_viewer()?],
        Command::Render(args) => vec![match &args.from {
            Some(picture) => args.settings.of_picture(&Origin::read(picture)?.arguments)?,
            None => args.settings.for_render()?,
        }],
        Command::Sweep(args) => {
            let pictures = args.sweep().pictures(&args.settings.for_render()?)?;
            assert!(!pictures.is_empty(), "a sheet without pictures");
            pictures.iter().for_each(|picture| drop(args.sweep().labels(picture)));
            pictures
        }
        Command::Diagram(args) => vec![args.settings.for_render()?],
        Command::Save(args) => vec![args.settings.for_render()?],
        Command::Verify(args) => args.settings.for_verify()?,
        Command::Bench(args) => args.pictures()?,
        Command::Devices | Command::Scenes => Vec::new(),
    })
}
