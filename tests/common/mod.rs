//! What the tests share: a device that validation watches, small settings, and the program itself.
#![allow(dead_code, reason = "each test file uses a part")]

pub mod mesh;
pub mod probe;
pub mod scenes;
pub mod statistics;
pub mod viewer;

use glam::DVec3;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output};
use std::sync::Arc;
use thinlens::error::Error;
use thinlens::passes::Shaders;
use thinlens::reference::{Reference, intersect};
use thinlens::renderer::Renderer;
use thinlens::scene::{self, Scene, SceneRef};
use thinlens::settings::{Estimator, Settings};
use thinlens::vulkan::{Device, Instance, Shader, Traits};

/// The cache folder of the programs that tests start: what is the user's is left alone, and what
/// drivers keep there is still at hand in the next test.
pub const CACHE: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/cache");

/// Whether these are the tests of `as_gpu.rs`, which run what else only a GPU runs.
pub fn as_gpu() -> bool {
    env!("CARGO_CRATE_NAME") == "as_gpu"
}

/// A device under validation, and shaders for it. A test that leaves a message behind fails.
pub struct Gpu {
    device: Option<Arc<Device>>,
    instance: Arc<Instance>,
    expected: Vec<&'static str>,
    /// The fault that its shaders have.
    fault: &'static str,
}

impl Gpu {
    /// The best device. No device, or no validation layer, fails the test.
    pub fn new() -> Self {
        Self::used_as(as_gpu().then_some(Traits::GPU))
    }

    /// Likewise, used as a device with these traits in place of its own.
    pub fn used_as(traits: Option<Traits>) -> Self {
        let instance = Instance::new(true, None).expect("a Vulkan loader and the validation layer");
        assert!(instance.watches_synchronization(), "this validation layer sees no missing barrier");
        let device = Device::open_as(&instance, None, None, traits).expect("a Vulkan 1.3 device");
        Self { device: Some(device), instance, expected: Vec::new(), fault: "" }
    }

    pub fn device(&self) -> &Arc<Device> {
        self.device.as_ref().expect("it is there until the end")
    }

    /// A shader of the program or of `tests/probes`.
    pub fn shader(&self, name: &'static str) -> Shader {
        let spirv = thinlens_test_shaders::spirv;
        let spirv = spirv(name, self.fault).or_else(|| spirv(name, "")).expect("a shader that there is");
        Shader { name, spirv }
    }

    pub fn renderer(&self, settings: &Settings) -> Renderer {
        let shaders = Shaders {
            trace: ["trace", "trace_path"].map(|name| self.shader(name)),
            accumulate: self.shader("accumulate"),
            select: self.shader("select"),
            resolve: self.shader("resolve"),
            pick: self.shader("pick"),
            geometry: self.shader("geometry"),
        };
        Renderer::with_shaders(self.device(), shaders, settings).expect("a renderer")
    }

    /// The next check wants a message that contains this, and no other.
    pub fn expect_message(&mut self, part: &'static str) {
        self.expected.push(part);
    }

    pub fn messages(&self) -> Vec<String> {
        self.instance.validation_messages()
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        self.device = None;
        if std::thread::panicking() {
            return;
        }
        let messages = self.messages();
        for part in &self.expected {
            assert!(
                messages.iter().any(|message| message.contains(part)),
                "no message has '{part}': {messages:#?}"
            );
        }
        for message in &messages {
            let expected = self.expected.iter().any(|part| message.contains(part));
            assert!(expected, "validation: {message}");
        }
    }
}

/// Proves that a check sees mistakes: it must pass with the shaders as they are, and fail with each of the faults
/// asked for, by their tags or names in `tests/faults`. A check gives its figures, or what is wrong. The faults try the
/// tests and not the driver, so the tests that run once more as a GPU leave them out, and so does `THINLENS_FAULTS=none`, for
/// a driver that needs hours for them.
pub fn prove(check: impl Fn(&Gpu) -> anyhow::Result<String>, asked: &[&str]) {
    let mut gpu = Gpu::new();
    match check(&gpu) {
        Ok(figures) => println!("holds: {figures}"),
        Err(error) => panic!("{error:#}"),
    }
    // The same tests have found the same faults on the device as it is.
    if as_gpu() || std::env::var_os("THINLENS_FAULTS").is_some_and(|choice| choice == "none") {
        println!("no fault was planted");
        return;
    }
    for asked in asked {
        assert!(
            thinlens_test_shaders::faults(asked).next().is_some(),
            "no fault has the tag or name {asked}"
        );
    }
    let faults: BTreeSet<_> = asked.iter().flat_map(|asked| thinlens_test_shaders::faults(asked)).collect();
    for fault in faults {
        assert!(thinlens_test_shaders::has_fault(fault), "no shader has the fault {fault}");
        gpu.fault = fault;
        match check(&gpu) {
            Ok(figures) => panic!("does not see the fault {fault}: {figures}"),
            Err(error) if is_finding(&error) => println!("fails with {fault}: {error}"),
            Err(error) => panic!("cannot be checked with the fault {fault}: {error:#}"),
        }
    }
}

/// Whether a check found something, and not only could not be made.
fn is_finding(error: &anyhow::Error) -> bool {
    match error.downcast_ref::<Error>() {
        Some(Error::Disagreement { .. }) => true,
        Some(_) => false,
        None => !error.is::<std::io::Error>(),
    }
}

/// A built-in scene, small: 64 x 48 pixels, 8 samples.
pub fn small(scene: &str) -> Settings {
    let mut settings = Settings::of_scene(SceneRef::new(scene::load(scene).expect("a built-in scene")));
    settings.estimator.size = [64, 48];
    settings.samples = 8;
    settings
}

/// A scene from TOML.
pub fn scene_of(toml: &str) -> SceneRef {
    SceneRef::new(plain_scene_of(toml))
}

/// A scene from TOML that the test may change.
pub fn plain_scene_of(toml: &str) -> Scene {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("test.toml");
    std::fs::write(&path, toml).expect("a writable temporary folder");
    scene::load(path.to_str().expect("a plain path")).expect("a valid scene")
}

/// The settings of a scene from TOML, at this size and so many samples per pixel.
pub fn settings_of(toml: &str, size: [u32; 2], samples: u32) -> Settings {
    let mut settings = Settings::of_scene(scene_of(toml));
    (settings.estimator.size, settings.samples) = (size, samples);
    settings
}

/// The place of the slanted cameras of the tests and its frame, by the book, not by the program: right, up, backwards.
pub fn slanted_frame() -> (DVec3, [DVec3; 3]) {
    let (eye, look_at, up) =
        (DVec3::new(3.0, 4.0, 12.0), DVec3::new(-2.0, 1.0, -9.0), DVec3::new(0.2, 1.0, 0.0));
    let w = (eye - look_at).normalize();
    let u = up.cross(w).normalize();
    (eye, [u, w.cross(u), w])
}

/// The pixels of a picture, row by row from the top left.
pub fn pixels([width, height]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
}

/// The diameter in pixels of the picture of a point at depth `z`: by similar triangles, the cone from
/// the lens through the point is D |z - F| / z wide in the focal plane, of which a pixel is F / k.
pub fn circle_of_confusion(diameter: f64, focal_distance: f64, z: f64, k: f64) -> f64 {
    diameter * (z - focal_distance).abs() / (z * focal_distance) * k
}

/// What the oracle sees through the lens centre, so far from a pixel's centre: the depth along the axis, and the
/// name of the material.
pub fn seen(estimator: &Estimator, pixel: [u32; 2], offset: [f64; 2]) -> Option<(f64, &str)> {
    let (depth, hit) = met(estimator, pixel, offset)?;
    Some((depth, &estimator.scene.material_names[hit.material as usize]))
}

/// Likewise, with all that the oracle knows of what is met there.
pub fn met(estimator: &Estimator, pixel: [u32; 2], offset: [f64; 2]) -> Option<(f64, intersect::Hit)> {
    let ray = Reference::new(estimator).primary_ray(pixel, offset, [0.0; 2], 0.0);
    let hit = intersect::intersect(&estimator.scene, ray, 0.0)?;
    let axis = (estimator.camera.look_at - estimator.camera.eye).normalize();
    Some((hit.distance * ray.direction.dot(axis), hit))
}

/// Films of the same settings with the seeds `0 .. count`: r, g, b of each pixel.
pub fn pictures(gpu: &Gpu, settings: &Settings, count: u32) -> anyhow::Result<Vec<Vec<[f64; 3]>>> {
    let mut renderer = gpu.renderer(settings);
    let mut settings = settings.clone();
    let of_seed = |seed| {
        settings.estimator.seed = seed;
        let film = render(&mut renderer, &settings)?;
        Ok(film.iter().map(|texel| [texel[0], texel[1], texel[2]].map(f64::from)).collect())
    };
    (0..count).map(of_seed).collect()
}

/// Renders to the end, and gives the film.
pub fn render(renderer: &mut Renderer, settings: &Settings) -> anyhow::Result<Vec<[f32; 4]>> {
    renderer.set(settings)?;
    renderer.render(|_| ())?;
    Ok(renderer.read_film()?)
}

/// Renders to the end with a renderer of its own, and gives the film.
pub fn film(gpu: &Gpu, settings: &Settings) -> Vec<[f32; 4]> {
    render(&mut gpu.renderer(settings), settings).expect("a film")
}

/// The bits of a film: equal films may differ in -0 and 0, equal bits do not.
pub fn bits(film: &[[f32; 4]]) -> Vec<[u32; 4]> {
    film.iter().map(|texel| texel.map(f32::to_bits)).collect()
}

/// Sends a signal. The shell's own `kill` is wherever a shell is.
pub fn send_signal(signal: &str, process: &str) {
    let sent = Command::new("sh").args(["-c", "kill -s \"$0\" \"$1\"", signal, process]).status();
    assert!(sent.expect("sh").success(), "no {signal} for {process}");
}

/// Kills its process with the test.
pub struct Killed(pub Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The program, with what it prints.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code().expect("it was not killed"),
            stdout: String::from_utf8(output.stdout).expect("UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }
}

/// The program under test, in `folder`, with no display.
pub fn thinlens(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_thinlens"));
    command
        .current_dir(folder)
        .env("XDG_CACHE_HOME", CACHE)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET");
    command
}

/// Runs it with these arguments.
pub fn run(folder: &Path, arguments: &[&str]) -> Run {
    thinlens(folder).args(arguments).output().expect("it starts").into()
}

/// Renders to a PNG under validation, which must succeed, and gives the file's bytes.
pub fn render_png(folder: &Path, arguments: &[&str]) -> Vec<u8> {
    let output: PathBuf = folder.join("render.png");
    let run: Run = thinlens(folder)
        .args(["render", "-o", "render.png", "--validation", "--quiet"])
        .args(arguments)
        .output()
        .expect("it starts")
        .into();
    assert_eq!((run.code, run.stderr.as_str(), run.stdout.as_str()), (0, "", ""), "{arguments:?}");
    std::fs::read(output).expect("the picture")
}

/// Width, height, and r, g, b bytes of a PNG.
pub fn decode_png(bytes: &[u8]) -> ([u32; 2], Vec<[u8; 3]>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a small PNG")];
    let info = reader.next_frame(&mut pixels).expect("a PNG");
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    let pixels = pixels.chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    ([info.width, info.height], pixels)
}
