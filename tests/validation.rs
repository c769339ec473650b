//! Validation is on, sees mistakes, and fails what caused them.

mod common;

use common::{Gpu, run, small};
use std::sync::Arc;
use thinlens::gpu_types::{AccumulatePush, Camera, Counters, SceneData, TracePush, lens_constants};
use thinlens::passes::{
    Accumulate, AdaptiveBuffers, ApertureBuffers, BlueNoiseTile, FacetAlbedo, SceneBuffers, Trace,
};
use thinlens::renderer::Renderer;
use thinlens::renderer::schedule::Batch;
use thinlens::vulkan::{Buffer, Commands, Image, Instance, Residence};

/// Catches a layer that is asked for but not on: a copy beyond a buffer's end must be reported.
#[test]
fn a_deliberate_error_is_caught() {
    let mut gpu = Gpu::new();
    let small = Buffer::new(gpu.device(), "small", 64, Residence::Device).expect("a buffer");
    let large = Buffer::new(gpu.device(), "large", 4096, Residence::Device).expect("a buffer");
    let mut commands = Commands::new(gpu.device()).expect("commands");
    // Recorded, and never run.
    commands.begin().expect("a recording").copy_buffer(&large, &small, 4096);
    assert!(!gpu.messages().is_empty());
    gpu.expect_message("vkCmdCopyBuffer");
}

/// Records trace and accumulate, as the renderer does, with or without what separates them.
fn record_two_passes(gpu: &Gpu, barrier: bool) {
    let settings = small("suffern-boxes");
    let estimator = &settings.estimator;
    let constants = lens_constants(estimator);
    let device = gpu.device();
    let image = |name| Arc::new(Image::rgba32f(device, name, estimator.size).expect("an image"));
    let (batch, film) = (image("batch"), image("film"));
    let size = size_of::<Counters>() as u64;
    let counters = Arc::new(Buffer::new(device, "counters", size, Residence::Device).expect("a buffer"));
    let scene =
        SceneBuffers::new(device, &SceneData::new(&estimator.scene, estimator.shutter)).expect("a scene");
    let tile = BlueNoiseTile::new(device).expect("a tile");
    let albedo = FacetAlbedo::new(device).expect("a table");
    let (trace, accumulate) = (
        Trace::new(device, Trace::SHADERS[0], &constants, &scene, &tile, &albedo).expect("trace"),
        Accumulate::new(device, Accumulate::SHADER, &constants, &tile).expect("accumulate"),
    );
    let aperture = ApertureBuffers::new(device, &[]).expect("an aperture");
    let adaptive = AdaptiveBuffers::new(device, None).expect("images");
    let traced = trace.bind(&scene, &aperture, &batch, &counters, &adaptive, 0).expect("bindings");
    let accumulated = accumulate.bind(&batch, &film, &adaptive, 0).expect("bindings");

    let sample = Batch::interleaved(1);
    let trace_push = TracePush {
        camera: Camera::new(estimator),
        lattice: sample.lattice(estimator.size),
        seed: 0,
        limits: 0,
        first_sample: 0,
        sample_count: 1,
    };
    let lattice = sample.lattice(estimator.size);
    let accumulate_push = AccumulatePush { lattice, seed: 0, first_sample: 0, jitter: 1.0, reach: 0 };
    let mut commands = Commands::new(device).expect("commands");
    let mut recording = commands.begin().expect("a recording");
    recording.clear(&batch);
    recording.clear(&film);
    adaptive.moments().iter().for_each(|moments| recording.clear(moments));
    trace.record(&mut recording, &traced, &trace_push, estimator.size);
    if barrier {
        recording.barrier();
    }
    accumulate.record(&mut recording, &accumulated, &accumulate_push, estimator.size);
    recording.submit().expect("a submission");
    commands.wait().expect("the device");
}

/// Catches synchronization validation that is asked for but not on.
#[test]
fn a_missing_barrier_between_trace_and_accumulate_is_caught() {
    let mut gpu = Gpu::new();
    record_two_passes(&gpu, false);
    gpu.expect_message("SYNC-HAZARD-READ-AFTER-WRITE");
}

/// The same with its barrier: the test above fails for the barrier and for nothing else.
#[test]
fn the_barrier_between_trace_and_accumulate_is_enough() {
    record_two_passes(&Gpu::new(), true);
}

/// Catches objects that are named while another thread makes or unmakes an instance or lists its devices: the
/// loader then reads lists that it is just freeing, and ends the process. Loaders from about 1.3.280 on do.
#[test]
fn objects_are_named_while_instances_come_and_go() {
    let gpu = Gpu::new();
    std::thread::scope(|scope| {
        let others = scope.spawn(|| {
            for _ in 0..40 {
                let instance = Instance::new(false, None).expect("an instance");
                assert!(!instance.devices(None).expect("a list").is_empty());
            }
        });
        while !others.is_finished() {
            Buffer::new(gpu.device(), "named", 64, Residence::Device).expect("a buffer");
        }
        others.join().expect("instances");
    });
}

/// Catches a program that asks for validation and goes on without it.
#[test]
fn a_missing_layer_is_a_failure() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = common::thinlens(folder.path())
        .args(["render", "-o", "out.png", "--validation"])
        .env("VK_LAYER_PATH", folder.path())
        .output();
    let run: common::Run = output.expect("it starts").into();
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(
        run.stderr.contains("VK_LAYER_KHRONOS_validation") && run.stderr.contains("./setup.sh"),
        "{}",
        run.stderr
    );
    assert!(!folder.path().join("out.png").exists());
}

/// The whole program under validation, for every scene, with narrow and wide jitter.
#[test]
fn every_scene_renders_without_a_message() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for scene in ["version-4", "suffern-boxes", "suffern-mirror", "passing"] {
        for jitter in ["0", "1", "3"] {
            for output in ["out.png", "out.exr"] {
                let arguments = [
                    "render",
                    scene,
                    "-o",
                    output,
                    "-n",
                    "20",
                    "--size",
                    "50x40",
                    "--jitter",
                    jitter,
                    "--validation",
                    "-q",
                ];
                let run = run(folder.path(), &arguments);
                assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{scene}, jitter {jitter}");
            }
        }
    }
}

/// Catches a picture that is too large for a list of its pixels, and of which that is not said: more than 2^25
/// pixels are more bytes than lavapipe's shaders can bind.
#[test]
fn a_picture_too_large_for_the_device_is_refused_in_words() {
    let gpu = Gpu::new();
    let mut settings = small("suffern-boxes");
    settings.estimator.size = [8192, 4096];
    settings.estimator.noise_threshold = 0.02;
    if let Err(error) = Renderer::new(gpu.device(), &settings) {
        let told = error.to_string();
        let parts = ["active pixels", "134217732 bytes", "maxStorageBufferRange", "--noise-threshold"];
        assert!(parts.iter().all(|part| told.contains(part)), "{told}");
    }
}
