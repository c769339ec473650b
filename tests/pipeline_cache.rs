//! The pipeline cache on disk, through the program and through the library.

mod common;

use common::{Gpu, Run, film, small, thinlens};
use std::path::{Path, PathBuf};
use thinlens::renderer::Renderer;

/// Renders a small picture under validation with this cache folder, which must succeed whatever is in
/// there, and gives the picture's bytes and the log's lines about the cache.
fn render(folder: &Path, cache: &Path) -> (Vec<u8>, String) {
    let run: Run = thinlens(folder)
        .args(["render", "suffern-boxes", "-o", "out.png", "-n", "1", "-s", "16x12", "-q", "--validation"])
        .env("XDG_CACHE_HOME", cache)
        // Mesa would otherwise compile anew in each of these folders.
        .env("MESA_SHADER_CACHE_DIR", common::CACHE)
        .env("RUST_LOG", "thinlens=debug")
        .output()
        .expect("it starts")
        .into();
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!run.stderr.contains("validation:"), "{}", run.stderr);
    let lines = run.stderr.lines().filter(|line| line.contains("pipeline cache"));
    let log = lines.collect::<Vec<_>>().join("\n");
    (std::fs::read(folder.join("out.png")).expect("the picture"), log)
}

/// The only file in a folder of caches.
fn only_file(folder: &Path) -> PathBuf {
    let entries = std::fs::read_dir(folder).expect("the folder was made");
    let files: Vec<_> = entries.map(|entry| entry.expect("a readable entry").path()).collect();
    assert_eq!(files.len(), 1, "{files:?}");
    files[0].clone()
}

/// Catches a cache that is written and never read, or read and written again each time.
#[cfg(target_os = "linux")]
#[test]
fn the_second_run_loads_what_the_first_one_wrote() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = folder.path().join("cache");
    let (first, log) = render(folder.path(), &cache);
    assert!(log.contains("bytes to") && !log.contains("bytes from"), "{log}");
    let file = only_file(&cache.join("thinlens"));
    let written = std::fs::read(&file).expect("the cache");
    let (second, log) = render(folder.path(), &cache);
    assert!(log.contains("bytes from") && !log.contains("anew"), "{log}");
    assert_eq!(first, second);
    // A driver that has nothing to add keeps it as it is.
    if !log.contains("bytes to") {
        assert_eq!(written, std::fs::read(&file).expect("the cache"));
    }
}

/// Catches bytes that go to the driver as they lie there, which crashes some: whatever is not a whole
/// file of this very device is left aside, and replaced.
#[cfg(target_os = "linux")]
#[test]
fn a_file_that_is_not_ours_is_harmless_and_replaced() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = folder.path().join("cache");
    let (picture, _) = render(folder.path(), &cache);
    let file = only_file(&cache.join("thinlens"));
    let good = std::fs::read(&file).expect("the cache");
    // Ahead of the driver's data are eight bytes of name and eight of checksum; its own header is 32
    // bytes: length, version, vendor, device, UUID.
    let with = |at: usize, byte: u8| {
        let mut bytes = good.clone();
        bytes[at] ^= byte;
        bytes
    };
    let sealed = |mut bytes: Vec<u8>| {
        let hash = bytes[16..].iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
        });
        bytes[8..16].copy_from_slice(&hash.to_le_bytes());
        bytes
    };
    assert_eq!(sealed(good.clone()), good, "the checksum is FNV-1a");
    for (what, bytes, reason) in [
        ("empty", Vec::new(), "cut short"),
        ("cut in the checksum", good[..12].to_vec(), "cut short"),
        ("cut in the driver's header", good[..40].to_vec(), "damaged"),
        ("cut by a byte", good[..good.len() - 1].to_vec(), "damaged"),
        ("longer", [&good[..], b"more"].concat(), "damaged"),
        ("one bit over", with(good.len() - 1, 1), "damaged"),
        ("text", b"this is no cache of pipelines at all".to_vec(), "another kind"),
        ("the driver's bare data", good[16..].to_vec(), "another kind"),
        ("another length of header", sealed(with(16, 1)), "another device"),
        ("another version", sealed(with(20, 2)), "another device"),
        ("another vendor", sealed(with(24, 1)), "another device"),
        ("another device", sealed(with(28, 1)), "another device"),
        ("another driver", sealed(with(47, 1)), "another device"),
        ("whole, but without a header", sealed(good[..24].to_vec()), "damaged"),
    ] {
        std::fs::write(&file, bytes).expect("writable");
        let (again, log) = render(folder.path(), &cache);
        assert!(log.contains(reason) && log.contains("anew") && !log.contains("bytes from"), "{what}: {log}");
        assert_eq!(picture, again, "{what}");
        let (_, log) = render(folder.path(), &cache);
        assert!(log.contains("bytes from"), "{what}: it is not replaced: {log}");
    }
}

/// Catches a cache folder that cannot be made ending a rendering.
#[cfg(target_os = "linux")]
#[test]
fn a_cache_that_cannot_be_written_is_a_line_in_the_log() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = folder.path().join("cache");
    std::fs::write(&cache, "a file, where a folder should be").expect("writable");
    let (_, log) = render(folder.path(), &cache);
    assert!(log.contains("cannot write"), "{log}");
    // Unasked, it is not even that.
    let output = thinlens(folder.path())
        .args(["render", "suffern-boxes", "-o", "out.png", "-n", "1", "-s", "16x12", "-q"])
        .env("XDG_CACHE_HOME", &cache)
        .env("MESA_SHADER_CACHE_DIR", common::CACHE)
        .output();
    let run: Run = output.expect("it starts").into();
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}

/// Catches a device that keeps pipelines without being asked to, a cache that changes the picture, and
/// one that validation has something to say of.
#[test]
fn the_library_keeps_pipelines_only_where_it_is_told_to() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let settings = small("version-4");
    let plain = film(&Gpu::new(), &settings);
    for _ in 0..2 {
        let gpu = Gpu::new();
        gpu.device().keep_pipelines_in(folder.path());
        let mut renderer = Renderer::new(gpu.device(), &settings).expect("a renderer");
        assert_eq!(plain, common::render(&mut renderer, &settings).expect("a film"));
        drop(renderer);
    }
    only_file(folder.path());
}
