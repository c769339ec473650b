//! What it costs to trace and accumulate in two passes rather than in one kernel.
//!
//! `cargo bench --bench two_pass` renders one 16-sample batch after another of a built-in scene, in
//! turn with the two passes and with `fused.comp`, which adds to the film itself, and prints the
//! medians of the device's own times and their ratio.

use std::sync::Arc;
use thinlens::error::Result;
use thinlens::gpu_types::{AccumulatePush, Camera, Counters, SceneData, TracePush, lens_constants, limits};
use thinlens::interface::binding;
use thinlens::passes::{
    Accumulate, AdaptiveBuffers, ApertureBuffers, BlueNoiseTile, FacetAlbedo, SceneBuffers, Trace,
};
use thinlens::renderer::schedule::Batch;
use thinlens::scene::{self, SceneRef};
use thinlens::settings::Settings;
use thinlens::vulkan::{
    Binding, BindingSet, Buffer, Commands, ComputePipeline, Device, Image, Instance, Recording, Residence,
    Shader, Timer,
};

const SIZE: [u32; 2] = [640, 480];
const SAMPLES: u32 = 16;
const ROUNDS: usize = 21;

/// The device's time for what `record` records, in seconds.
fn time(commands: &mut Commands, timer: &Timer, record: impl FnOnce(&mut Recording<'_>)) -> Result<f64> {
    let mut recording = commands.begin()?;
    recording.start(timer);
    record(&mut recording);
    recording.stop(timer);
    recording.submit()?;
    commands.wait()?;
    Ok(timer.elapsed()?.expect("a queue with a clock").as_secs_f64())
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn measure(device: &Arc<Device>, name: &str) -> Result<()> {
    let mut settings = Settings::of_scene(SceneRef::new(scene::load(name)?));
    settings.estimator.size = SIZE;
    let estimator = &settings.estimator;
    let constants = lens_constants(estimator);
    let batch = Arc::new(Image::rgba32f(device, "batch", SIZE)?);
    let film = Arc::new(Image::rgba32f(device, "film", SIZE)?);
    let counters =
        Arc::new(Buffer::new(device, "counters", size_of::<Counters>() as u64, Residence::Device)?);
    let scene = SceneBuffers::new(device, &SceneData::new(&estimator.scene, estimator.shutter))?;
    let tile = BlueNoiseTile::new(device)?;
    let albedo = FacetAlbedo::new(device)?;
    let (trace, accumulate) = (
        Trace::new(device, Trace::SHADERS[0], &constants, &scene, &tile, &albedo)?,
        Accumulate::new(device, Accumulate::SHADER, &constants, &tile)?,
    );
    let aperture = ApertureBuffers::new(device, &[])?;
    let adaptive = AdaptiveBuffers::new(device, None)?;
    let traced = trace.bind(&scene, &aperture, &batch, &counters, &adaptive, 0)?;
    let accumulated = accumulate.bind(&batch, &film, &adaptive, 0)?;
    let spirv = thinlens_test_shaders::spirv("fused", "").expect("a shader that there is");
    let fused = Shader { name: "fused", spirv };
    let fused = ComputePipeline::new(device, fused, &[scene.constants(), &constants].concat())?;
    let mut bindings = scene.bindings();
    bindings.extend([
        (binding::FILM_IMAGE, Binding::Image(Arc::clone(&film))),
        (binding::COUNTERS, Binding::Buffer(Arc::clone(&counters))),
        adaptive.bind_active(0),
        tile.binding(),
    ]);
    bindings.extend(aperture.bindings());
    let fused_bindings = BindingSet::new(&fused, &bindings)?;

    let mut commands = Commands::new(device)?;
    let mut recording = commands.begin()?;
    recording.clear(&batch);
    recording.clear(&film);
    adaptive.moments().iter().for_each(|moments| recording.clear(moments));
    recording.submit()?;
    let timer = Timer::new(device)?;
    let (mut two, mut one) = (Vec::new(), Vec::new());
    for round in 0..=ROUNDS {
        let first_sample = SAMPLES * u32::try_from(round).expect("few rounds");
        let lattice = Batch::whole(first_sample, u32::MAX, SAMPLES, SAMPLES).lattice(SIZE);
        let push = TracePush {
            camera: Camera::new(estimator),
            lattice,
            seed: 0,
            limits: limits(estimator),
            first_sample,
            sample_count: SAMPLES,
        };
        let merge = AccumulatePush { lattice, seed: 0, first_sample, jitter: estimator.jitter, reach: 0 };
        let two_passes = time(&mut commands, &timer, |recording| {
            trace.record(recording, &traced, &push, SIZE);
            recording.barrier();
            accumulate.record(recording, &accumulated, &merge, SIZE);
        })?;
        let one_kernel = time(&mut commands, &timer, |recording| {
            recording.dispatch(&fused, &fused_bindings, bytemuck::bytes_of(&push), SIZE);
        })?;
        // The first round compiles.
        if round > 0 {
            two.push(two_passes);
            one.push(one_kernel);
        }
    }
    let (two, one) = (median(&mut two), median(&mut one));
    let rate = |seconds: f64| f64::from(SIZE[0] * SIZE[1] * SAMPLES) / seconds / 1e6;
    println!(
        "{name:16} two passes {:7.2} ms ({:5.1} M samples/s), one kernel {:7.2} ms ({:5.1} M samples/s), ratio {:.3}",
        1e3 * two,
        rate(two),
        1e3 * one,
        rate(one),
        two / one
    );
    Ok(())
}

fn main() -> Result<()> {
    let instance = Instance::new(false, None)?;
    let device = Device::open(&instance, std::env::var("THINLENS_DEVICE").ok().as_deref(), None)?;
    println!(
        "{} ({}), {}x{}, {SAMPLES} samples, {ROUNDS} rounds",
        device.info().name,
        device.info().driver,
        SIZE[0],
        SIZE[1]
    );
    // The bench has one shader, with the integrator whitted.
    for builtin in scene::BUILTINS.into_iter().filter(|of| !of.toml.contains("integrator")) {
        measure(&device, builtin.name)?;
    }
    Ok(())
}
