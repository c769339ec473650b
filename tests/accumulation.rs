//! Accumulation: which samples end up in which pixel, and with what weight.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::scenes::BURNING;
use common::{Gpu, bits, film, probe, prove, render, scene_of, settings_of, small};
use glam::DVec3;
use std::sync::Arc;
use thinlens::gpu_types::{Camera, Counters, SceneData, TracePush, lens_constants, limits};
use thinlens::passes::{AdaptiveBuffers, ApertureBuffers, BlueNoiseTile, FacetAlbedo, SceneBuffers, Trace};
use thinlens::reference::{self, sampler};
use thinlens::renderer::schedule::Batch;
use thinlens::settings::Settings;
use thinlens::vulkan::{Buffer, Commands, Image, Residence};

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Merge {
    film: [f32; 4],
    batch: [f32; 4],
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Merged {
    texel: [f32; 4],
    batch_is_finite: u32,
    pad0: [u32; 3],
}

/// Every sample of a picture as the trace pass traces it: `samples` times r, g, b of each pixel, and
/// 1, or 0 where it was not finite.
fn record(gpu: &Gpu, settings: &Settings) -> Result<Vec<Vec<[f32; 4]>>> {
    let Settings { estimator, samples, .. } = settings;
    let device = gpu.device();
    let scene = SceneBuffers::new(device, &SceneData::new(&estimator.scene, estimator.shutter))?;
    let tile = BlueNoiseTile::new(device)?;
    let albedo = FacetAlbedo::new(device)?;
    let trace = Trace::new(device, gpu.shader("trace"), &lens_constants(estimator), &scene, &tile, &albedo)?;
    let counters = Buffer::new(device, "counters", size_of::<Counters>() as u64, Residence::Device)?;
    let batch = Arc::new(Image::rgba32f(device, "batch", estimator.size)?);
    let read = Buffer::new(device, "samples", batch.byte_len(), Residence::Host)?;
    let adaptive = AdaptiveBuffers::new(device, None)?;
    let aperture = ApertureBuffers::new(device, &[])?;
    let bindings = trace.bind(&scene, &aperture, &batch, &Arc::new(counters), &adaptive, 0)?;
    let mut commands = Commands::new(device)?;
    let one = |first_sample| {
        let push = TracePush {
            camera: Camera::new(estimator),
            lattice: Batch::whole(first_sample, *samples, 1, 1).lattice(estimator.size),
            seed: estimator.seed,
            limits: limits(estimator),
            first_sample,
            sample_count: 1,
        };
        let mut recording = commands.begin()?;
        recording.clear(&batch);
        adaptive.moments().iter().for_each(|moments| recording.clear(moments));
        trace.record(&mut recording, &bindings, &push, estimator.size);
        recording.barrier();
        recording.copy_image(&batch, &read);
        recording.submit()?;
        commands.wait()?;
        let bytes = usize::try_from(batch.byte_len())?;
        Ok(bytemuck::allocation::pod_collect_to_vec(&read.bytes()[..bytes]))
    };
    (0..*samples).map(one).collect()
}

/// Catches a film that is not the running mean of the samples that landed: recorded samples are
/// played back through the formula in f64, for a jitter that stays at home, none, and one that strays
/// to neighbours. Counts are exact; together they are the samples that landed on the film.
#[test]
fn the_film_is_the_mean_of_what_landed() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for (jitter, samples) in [(0.0, 21), (1.0, 21), (3.0, 12), (2.2, 7)] {
            let mut settings = small("version-4");
            let size = [37, 29];
            (settings.estimator.size, settings.estimator.jitter, settings.samples) = (size, jitter, samples);
            let mut replayed = reference::film::Film::new(size);
            for (index, of_pixels) in (0..).zip(record(gpu, &settings)?) {
                for (number, sample) in (0..).zip(of_pixels) {
                    let pixel = [number % size[0], number / size[0]];
                    let xi = sampler::sample_values(
                        settings.estimator.sampler,
                        settings.estimator.seed,
                        pixel,
                        index,
                        0,
                    );
                    let offset = [xi[0], xi[1]].map(|xi| (xi - 0.5) * f64::from(jitter));
                    ensure!(sample[3] == 1.0, "a sample that is not finite");
                    replayed.add(
                        pixel,
                        offset,
                        DVec3::new(sample[0].into(), sample[1].into(), sample[2].into()),
                    );
                }
            }
            let traced = f64::from(size[0] * size[1] * samples);
            let (mut worst, mut landed) = (0.0_f64, 0.0);
            for (number, (device, expected)) in film(gpu, &settings).iter().zip(replayed.texels()).enumerate()
            {
                ensure!(
                    f64::from(device[3]) == expected[3],
                    "jitter {jitter}, pixel {number}: {} samples, not {}",
                    device[3],
                    expected[3]
                );
                landed += expected[3];
                // Where no sample landed the colours mean nothing.
                for channel in (0..3).filter(|_| expected[3] > 0.0) {
                    let error =
                        (f64::from(device[channel]) - expected[channel]).abs() / expected[channel].max(1.0);
                    worst = worst.max(error);
                    ensure!(error < 1e-6, "jitter {jitter}, pixel {number}: {device:?}, not {expected:?}");
                }
            }
            ensure!((landed == traced) == (jitter <= 1.0), "{landed} of {traced} landed, jitter {jitter}");
            figures.push(format!("jitter {jitter}: {landed} of {traced} landed, means within {worst:.1e}"));
        }
        Ok(figures.join("; "))
    };
    prove(check, &["film"]);
}

/// Catches a NaN or an infinity that passes, whatever its bits and whatever the driver assumes; and
/// garbage that shines through where there is no sample: then the colours may hold anything.
#[test]
fn garbage_is_told_by_its_bits() {
    let garbage = [
        0x7f80_0000,
        0xff80_0000,
        0x7fc0_0000,
        0xffc0_0000,
        0x7f80_0001,
        0xff80_0001,
        0x7fff_ffff,
        0xffff_ffff,
    ]
    .map(f32::from_bits);
    let numbers = [0.0, -0.0, 1.0, -3.5, f32::MAX, f32::MIN, f32::MIN_POSITIVE];
    let check = |gpu: &Gpu| -> Result<String> {
        let mut merges = Vec::new();
        for value in garbage.into_iter().chain(numbers) {
            for channel in 0..3 {
                let mut color = [0.25, 0.5, 0.75];
                color[channel] = value;
                let with_count = |count| [color[0], color[1], color[2], count];
                let good = [0.1, 0.2, 0.3, 5.0];
                merges.push(Merge { film: with_count(0.0), batch: good });
                merges.push(Merge { film: good, batch: with_count(0.0) });
            }
        }
        let merged: Vec<Merged> = probe::probe(gpu, "film", None, &[], &merges);
        for (given, merged) in merges.iter().zip(merged) {
            ensure!(merged.texel == [0.1, 0.2, 0.3, 5.0], "{given:?} makes {merged:?}");
            let finite = given.batch[..3].iter().all(|value| value.is_finite());
            ensure!((merged.batch_is_finite == 1) == finite, "{given:?} is taken for {merged:?}");
        }
        Ok(format!("{} merges with garbage at count 0", merges.len()))
    };
    prove(check, &["garbage", "merge_multiplies_garbage"]);
}

/// Catches colours of an older picture that shine through: the film is taken for empty, whatever it
/// holds, also where a wide jitter leaves a pixel without its first sample.
#[test]
fn an_old_picture_leaves_no_trace() {
    let mut old = small("version-4");
    old.estimator.scene = scene_of(
        "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = 0.1\n\
         focal_distance = 3\n[background]\ncolor = [1e9, 1e9, 1e9]\n",
    );
    let mut new = small("version-4");
    (new.samples, old.samples) = (2, 20);
    let check = |gpu: &Gpu| -> Result<String> {
        let [mut old, mut new] = [old.clone(), new.clone()];
        for jitter in [1.0, 3.0] {
            (old.estimator.jitter, new.estimator.jitter) = (jitter, jitter);
            let mut renderer = gpu.renderer(&old);
            render(&mut renderer, &old)?;
            let same = bits(&render(&mut renderer, &new)?) == bits(&film(gpu, &new));
            ensure!(same, "jitter {jitter}: the old picture is still there");
        }
        Ok("the same bits after a picture of 1e9 as after none".to_owned())
    };
    prove(check, &["count_not_reset"]);
}

/// Catches a NaN or an infinity averaged into a pixel, which would then never recover, and samples
/// that are left out without a word: averaged and rejected samples are all that were traced.
#[test]
fn samples_that_are_not_finite_are_rejected_and_reported() {
    let settings = settings_of(BURNING, [64, 48], 8);
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings);
        let film = render(&mut renderer, &settings)?;
        let progress = renderer.progress();
        ensure!(film.iter().flatten().all(|value| value.is_finite()), "the film is not finite");
        let averaged: f64 = film.iter().map(|texel| f64::from(texel[3])).sum();
        ensure!(progress.traced == 64 * 48 * 8, "{} samples traced", progress.traced);
        ensure!(
            progress.rejected_samples > 0 && averaged as u64 + progress.rejected_samples == progress.traced,
            "{averaged} samples averaged and {} rejected of {}",
            progress.rejected_samples,
            progress.traced
        );
        ensure!(progress.rays >= progress.traced, "less than one ray a sample");
        Ok(format!("{} of {} samples rejected", progress.rejected_samples, progress.traced))
    };
    prove(check, &["garbage", "rejected_not_counted"]);
}
