//! The resolve pass against pictures that were looked at. The passes before it are compared with the oracle.
//!
//! A picture that is missing is a failure. After a wanted change, look at what
//! `THINLENS_BLESS=1 cargo test --release --test golden` writes into `tests/golden`, and commit it.

mod common;

use anyhow::{Context, Result, ensure};
use common::{Gpu, decode_png, pixels, probe, prove};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thinlens::gpu_types::{OverlayScale, ResolvePush};
use thinlens::interface::binding;
use thinlens::output::write_png;
use thinlens::passes::{AdaptiveBuffers, Resolve, ResolveKind};
use thinlens::pending_file::PendingFile;
use thinlens::vulkan::{Binding, BindingSet, Buffer, Commands, ComputePipeline, Image, Residence};

const BLESS: &str = "THINLENS_BLESS";

/// How many of 255 levels drivers' powers and roundings may differ by.
const LEVELS: u8 = 1;

/// A film, and how to show it.
struct Case {
    name: &'static str,
    extent: [u32; 2],
    film: Vec<[f32; 4]>,
    preview_stride: u32,
    exposure_stops: f32,
    /// Whether the pass is told that some pixels have no sample.
    has_holes: bool,
    blue_first: bool,
}

/// What the resolve pass makes of it: r, g, b, a bytes.
fn resolve(gpu: &Gpu, case: &Case) -> Result<Vec<u8>> {
    let device = gpu.device();
    let film = Arc::new(Image::rgba32f(device, "film", case.extent)?);
    let picture = Arc::new(Image::rgba8(device, "picture", case.extent)?);
    let surfaces = Arc::new(Image::rgba32f(device, "surfaces", [1, 1])?);
    let adaptive = AdaptiveBuffers::new(device, None)?;
    let mut commands = Commands::new(device)?;
    let mut recording = commands.begin()?;
    recording.clear(&surfaces);
    adaptive.moments().iter().for_each(|moments| recording.clear(moments));
    recording.clear(&film);
    recording.clear(&picture);
    recording.submit()?;
    commands.wait()?;

    let texels = Arc::new(Buffer::upload(device, "texels", &case.film)?);
    let fill = ComputePipeline::new(device, gpu.shader("fill"), &[])?;
    let filled = [
        (binding::PROBE_INPUTS, Binding::Buffer(texels)),
        (binding::FILM_IMAGE, Binding::Image(Arc::clone(&film))),
    ];
    probe::run(gpu, &fill, &BindingSet::new(&fill, &filled)?, &[], case.extent);

    let kind = if case.has_holes { ResolveKind::WithHoles } else { ResolveKind::WithoutHoles };
    let resolve = Resolve::new(device, gpu.shader("resolve"), kind)?;
    let bindings = resolve.bind(&film, &picture, &surfaces, &adaptive)?;
    let push = ResolvePush {
        extent: case.extent,
        preview_stride: case.preview_stride,
        exposure: case.exposure_stops.exp2(),
        overlay: OverlayScale::default(),
        blue_first: case.blue_first.into(),
    };
    let read = Buffer::new(device, "read-back", picture.byte_len(), Residence::Host)?;
    let mut recording = commands.begin()?;
    resolve.record(&mut recording, &bindings, &push);
    recording.barrier();
    recording.copy_image(&picture, &read);
    recording.submit()?;
    commands.wait()?;
    Ok(read.bytes()[..usize::try_from(picture.byte_len())?].to_vec())
}

fn film(extent: [u32; 2], texel: impl Fn(u32, u32) -> [f32; 4]) -> Vec<[f32; 4]> {
    pixels(extent).map(|[x, y]| texel(x, y)).collect()
}

/// Bands of red, green, blue, white and a mixture, from black on the left to beyond white.
fn bands(x: u32, y: u32) -> [f32; 4] {
    let value = 1.2 * x as f32 / 95.0;
    let [r, g, b] =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3], [1.0, 0.4, 0.1]][(y / 10) as usize];
    // The foot of the sRGB curve has a band of its own.
    if y % 10 < 3 {
        [0.01 * value, 0.01 * value, 0.01 * value, 1.0]
    } else {
        [r * value, g * value, b * value, 1.0]
    }
}

fn cases() -> Vec<Case> {
    let case = |name: &'static str, extent, film, preview_stride, exposure_stops| Case {
        name,
        extent,
        film,
        preview_stride,
        exposure_stops,
        has_holes: !name.starts_with("bands") && !name.starts_with("preview"),
        blue_first: false,
    };
    let extent = [96, 50];
    let garbage = [f32::NAN, 1e9, -1e9, 0.0];
    // Where a pixel has no sample its colours may hold anything.
    let holes = film(extent, |x, y| if (x * 7 + y * 13) % 11 < 4 { garbage } else { bands(x, y) });
    // In the corner, samples are farther apart than the search reaches.
    let islands =
        film(
            extent,
            |x, y| if x % 9 == 4 && y % 9 == 4 && (x > 30 || y > 20) { bands(x, y) } else { garbage },
        );
    let lattice = |stride: u32, site: u32| {
        film(
            extent,
            move |x, y| if x % stride == site && y % stride == site { bands(x, y) } else { [0.0; 4] },
        )
    };
    vec![
        case("bands", extent, film(extent, bands), 1, 0.0),
        case("bands-brighter", extent, film(extent, bands), 1, 1.5),
        case("bands-darker", extent, film(extent, bands), 1, -2.0),
        case("holes", extent, holes, 1, 0.0),
        case("islands", extent, islands, 1, 0.0),
        case("preview-of-a-quarter", extent, lattice(2, 0), 2, 0.0),
        case("preview-of-a-sixteenth", extent, lattice(4, 2), 4, 0.0),
    ]
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join("golden").join(name).with_extension("png")
}

/// Holds a picture against the one on disk.
fn hold(name: &str, extent: [u32; 2], picture: &[u8]) -> Result<u8> {
    let path = path(name);
    let expected = std::fs::read(&path).with_context(|| {
        format!("there is no {}: run with {BLESS}=1, look at it, and commit it", path.display())
    })?;
    let (size, expected) = decode_png(&expected);
    ensure!(size == extent, "{name}: {extent:?} pixels, not {size:?}");
    let mut worst = 0;
    for (number, (pixel, expected)) in picture.chunks(4).zip(&expected).enumerate() {
        for (got, expected) in pixel.iter().zip(expected) {
            worst = worst.max(got.abs_diff(*expected));
        }
        ensure!(worst <= LEVELS, "{name}: pixel {number} is {pixel:?}, not {expected:?}");
    }
    Ok(worst)
}

/// Catches another exposure or encoding, a picture that is turned, and pixels without a sample that
/// show garbage, black, or another pixel than the nearest that has one.
#[test]
fn films_are_shown_as_the_pictures_that_were_looked_at() {
    let cases = cases();
    if std::env::var_os(BLESS).is_some() {
        let gpu = Gpu::new();
        for case in &cases {
            let file = PendingFile::create(&path(case.name)).expect("a writable folder");
            write_png(file, case.extent, &resolve(&gpu, case).expect("a picture"), None)
                .expect("a picture file");
        }
    }
    let check = |gpu: &Gpu| -> Result<String> {
        let mut worst = 0;
        for case in &cases {
            worst = worst.max(hold(case.name, case.extent, &resolve(gpu, case)?)?);
        }
        Ok(format!("{} pictures, {worst} of 255 levels off at most", cases.len()))
    };
    prove(check, &["resolve", "gamma_of_2.2", "srgb_without_its_foot"]);
}

/// Catches a window with red for blue.
#[test]
fn a_window_that_wants_blue_first_gets_it() {
    let gpu = Gpu::new();
    let mut case = cases().remove(0);
    let red_first = resolve(&gpu, &case).expect("a picture");
    case.blue_first = true;
    let blue_first = resolve(&gpu, &case).expect("a picture");
    let turned = red_first.chunks(4).flat_map(|pixel| [pixel[2], pixel[1], pixel[0], pixel[3]]);
    assert_eq!(blue_first, turned.collect::<Vec<_>>());
}

/// Catches a comparison that passes where there is nothing to compare with.
#[test]
fn a_missing_picture_is_a_failure() {
    let error = hold("no-such-picture", [1, 1], &[0; 4]).expect_err("there is none");
    assert!(error.to_string().contains(BLESS), "{error}");
}
