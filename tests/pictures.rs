//! Pictures that others made or changed: what they carry is found wherever it stands, and what they claim costs
//! nothing.

mod common;

use common::run;
use exr::prelude::{AnyChannel, AnyChannels, attribute};
use exr::prelude::{Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage};
use png::chunk::ChunkType;
use png::text_metadata::{ITXtChunk, TEXtChunk, ZTXtChunk};
use png::{BitDepth, ColorType};
use std::io::Cursor;
use std::path::Path;
use thinlens::output::Origin;
use thinlens::scene::ApertureImage;

const ARGUMENTS: [&str; 3] = ["suffern-boxes", "--size=24x18", "--samples=2"];
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// How a picture of these arguments was made, as it says so.
fn text() -> String {
    let arguments = ARGUMENTS.map(|argument| format!("\"{argument}\"")).join(",");
    format!("{{\"version\":\"0.1.0\",\"arguments\":[{arguments}]}}")
}

/// The CRC of a PNG's chunks (PNG specification, annex D), bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc)))
}

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind, data].concat();
    [&(data.len() as u32).to_be_bytes()[..], &body, &crc(&body).to_be_bytes()].concat()
}

/// A header of this size, bits, colour type and interlacing.
fn header([width, height]: [u32; 2], bits: u8, color: ColorType, interlaced: bool) -> Vec<u8> {
    let size = [width, height].map(u32::to_be_bytes).concat();
    chunk(b"IHDR", &[&size[..], &[bits, color as u8, 0, 0, u8::from(interlaced)]].concat())
}

/// A zlib stream that is not packed.
fn stored(data: &[u8]) -> Vec<u8> {
    let [low, high] = (data.len() as u16).to_le_bytes();
    let sums = data.iter().fold((1_u32, 0_u32), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65521;
        (a, (a + b) % 65521)
    });
    [&[0x78, 1, 1, low, high, !low, !high], data, &(sums.1 << 16 | sums.0).to_be_bytes()].concat()
}

fn png_of(parts: &[Vec<u8>]) -> Vec<u8> {
    [SIGNATURE, &parts.concat(), &chunk(b"IEND", &[])].concat()
}

/// A picture of one pixel, with whatever `write` puts before and behind it.
fn png_with(write: impl Fn(&mut png::Writer<&mut Vec<u8>>, bool)) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    write(&mut writer, true);
    writer.write_image_data(&[1, 2, 3]).expect("a pixel");
    write(&mut writer, false);
    writer.finish().expect("an end");
    bytes
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> std::path::PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("a file");
    path
}

/// Catches a text that is found only where, and in the form, that thinlens itself writes it.
#[test]
fn a_png_says_how_it_was_made_wherever_it_does() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut packed = ITXtChunk::new("thinlens", text());
    packed.compress_text().expect("packed");
    for is_before in [true, false] {
        for form in ["tEXt", "zTXt", "iTXt", "iTXt, packed"] {
            let bytes = png_with(|writer, before| {
                if before != is_before {
                    // Another program's, which is not taken for it.
                    let other = TEXtChunk::new("Software", "thinlens");
                    return writer.write_text_chunk(&other).expect("text");
                }
                match form {
                    "tEXt" => writer.write_text_chunk(&TEXtChunk::new("thinlens", text())),
                    "zTXt" => writer.write_text_chunk(&ZTXtChunk::new("thinlens", text())),
                    "iTXt" => writer.write_text_chunk(&ITXtChunk::new("thinlens", text())),
                    _ => writer.write_text_chunk(&packed),
                }
                .expect("text");
            });
            let path = write(folder.path(), "a.png", &bytes);
            let origin = Origin::read(&path).unwrap_or_else(|error| panic!("{form}, {is_before}: {error}"));
            assert_eq!(origin.arguments, ARGUMENTS, "{form}, {is_before}");
        }
    }
    // Cut off behind the text.
    let whole = png_with(|writer, before| {
        if before {
            writer.write_text_chunk(&TEXtChunk::new("thinlens", text())).expect("text");
        }
    });
    let path = write(folder.path(), "cut.png", &whole[..whole.len() - 20]);
    assert_eq!(Origin::read(&path).expect("how it was made").arguments, ARGUMENTS);
    // An EXR under a PNG's name, and in capitals.
    let path = write(folder.path(), "exr.PNG", &exr_with(&text()));
    assert_eq!(Origin::read(&path).expect("how it was made").arguments, ARGUMENTS);
}

/// Catches a text that grows without end once it is unpacked.
#[test]
fn a_text_that_unpacks_to_too_much_is_none() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bomb = ZTXtChunk::new("thinlens", "x".repeat(64 << 20));
    let bytes = png_with(|writer, before| {
        if before {
            writer.write_text_chunk(&bomb).expect("text");
        }
    });
    let path = write(folder.path(), "a.png", &bytes);
    let error = Origin::read(&path).expect_err("too much").to_string();
    assert!(error.contains("cannot be rendered again"), "{error}");
}

/// An EXR of one pixel that carries a text.
fn exr_with(text: &str) -> Vec<u8> {
    let channel = AnyChannel::new("R", FlatSamples::F32(vec![1.0]));
    let mut attributes = LayerAttributes::default();
    let value = attribute::AttributeValue::Text(attribute::Text::from(text));
    attributes.other.insert(attribute::Text::from("thinlens"), value);
    let channels = AnyChannels::sort([channel].into_iter().collect());
    let layer = Layer::new((1, 1), attributes, Encoding::UNCOMPRESSED, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).expect("an EXR");
    bytes.into_inner()
}

/// Catches advice about paths and permissions where the file is at fault, a panic, and a header that is believed.
#[test]
fn a_damaged_picture_is_called_that() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let exr = exr_with(&text());
    let at = |part: &[u8]| exr.windows(part.len()).position(|bytes| bytes == part).expect("it is in there");
    let changed = |at: usize, with: &[u8]| {
        let mut bytes = exr.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        bytes
    };
    // A name, a type, each with its end, and then the length.
    let window = at(b"dataWindow\0box2i\0") + 17;
    let length = at(b"thinlens\0string\0") + 16;
    let cut_png = &png_with(|_, _| {})[..30];
    let huge_text =
        [SIGNATURE, &header([1, 1], 8, ColorType::Rgb, false), b"\x7f\xff\xff\xfftEXtthinlens\0{"].concat();
    for (name, bytes, part) in [
        ("empty.exr", Vec::new(), "it is empty"),
        ("cut.exr", exr[..length].to_vec(), "damaged"),
        ("short.exr", changed(window, &7_i32.to_le_bytes()), "damaged"),
        ("long.exr", changed(length, &i32::MAX.to_le_bytes()), "damaged"),
        ("negative.exr", changed(length, &(-5_i32).to_le_bytes()), "damaged"),
        ("jpeg.png", b"\xff\xd8\xff\xe0\0\x10JFIF\0".to_vec(), "it is a JPEG picture"),
        ("jpeg.exr", b"\xff\xd8\xff\xe0\0\x10JFIF\0".to_vec(), "it is a JPEG picture"),
        ("webp.png", b"RIFF\x10\0\0\0WEBPVP8 ".to_vec(), "WebP"),
        ("text.png", b"what is this?".to_vec(), "it is not a picture"),
        ("lfs.png", b"version https://git-lfs.github.com/spec/v1\n".to_vec(), "git lfs pull"),
        ("cut.png", cut_png.to_vec(), "damaged"),
        ("huge.png", huge_text, "damaged"),
        ("plain.png", png_with(|_, _| {}), "did not write it"),
    ] {
        write(folder, name, &bytes);
        let outcome = run(folder, &["render", "--from", name, "-o", "out.png"]);
        assert_eq!((outcome.code, outcome.stderr.lines().count()), (2, 1), "{name}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(part), "{name}: {}", outcome.stderr);
    }
    // Two thousand million pixels either way: the text alone is asked for.
    let vast = changed(window + 4 + 8, &[i32::MAX - 1; 2].map(i32::to_le_bytes).concat());
    let path = write(folder, "vast.exr", &vast);
    if let Err(error) = Origin::read(&path) {
        assert!(error.to_string().contains("damaged"), "{error}");
    }
    assert!(!folder.join("out.png").exists());
}

/// Catches an image that is believed to be as large as it says before there is anything of it, and one that makes
/// its decoder panic.
#[test]
fn an_aperture_that_cannot_be_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let data = chunk(b"IDAT", &stored(&[0, 0]));
    let grey = |size, interlaced| png_of(&[header(size, 8, ColorType::Grayscale, interlaced), data.clone()]);
    let palette = |length: usize, clear: usize| {
        let header = header([1, 1], 8, ColorType::Indexed, false);
        png_of(&[header, chunk(b"PLTE", &vec![9; length]), chunk(b"tRNS", &vec![9; clear]), data.clone()])
    };
    let scene = "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nvfov_degrees = 60\nlens_diameter = 0.1\n\
                 focal_distance = 5\naperture_image = \"a.png\"\n";
    write(folder, "scene.toml", scene.as_bytes());
    let claim = [131_072, 0x7fff_ffff];
    for (what, bytes, part) in [
        ("tall", grey(claim, false), "131072 x 2147483647 pixels"),
        ("tall, interlaced", grey(claim, true), "16384 at most"),
        ("wide", grey([16385, 1], false), "16384 at most"),
        ("large", grey([16384, 16384], false), "damaged"),
        ("large, interlaced", grey([16384, 16384], true), "damaged"),
        ("16 bits", png_of(&[header([16384; 2], 16, ColorType::Rgba, true), data.clone()]), "damaged"),
        ("no pixel", grey([0, 1], false), "damaged"),
        ("a palette of 13 bytes", palette(13, 2), "damaged"),
        ("a palette of 4 bytes", palette(4, 1), "damaged"),
        ("a palette of 2 bytes", palette(2, 1), "damaged"),
        ("no palette", png_of(&[header([1, 1], 8, ColorType::Indexed, false), data.clone()]), "damaged"),
        ("a JPEG", b"\xff\xd8\xff\xe0\0\x10JFIF\0".to_vec(), "it is a JPEG picture"),
        ("black", grey([1, 1], false), "black all over"),
    ] {
        write(folder, "a.png", &bytes);
        for arguments in [&["--aperture-image", "a.png"][..], &["scene.toml"]] {
            let outcome = run(folder, &[&["render", "-o", "out.png"], arguments].concat());
            assert_eq!((outcome.code, outcome.stderr.lines().count()), (1, 1), "{what}: {}", outcome.stderr);
            assert!(outcome.stderr.contains(part), "{what}: {}", outcome.stderr);
            assert!(arguments.len() == 2 || outcome.stderr.contains("scene.toml:7: "), "{}", outcome.stderr);
        }
    }
}

/// Catches rows of an interlaced image that land elsewhere, and one encoding that lets in other light than
/// another.
#[test]
fn an_aperture_is_the_same_in_every_encoding() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let passes =
        [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
    for [width, height] in [[1, 1], [1, 9], [9, 1], [2, 3], [5, 5], [13, 8], [300, 7], [3, 600]] {
        // Even levels, of which two halves are a whole.
        let level = |x: u32, y: u32| ((x * 37 + y * 101 + x * y) % 127 * 2) as u8;
        let row = |y: u32, first: u32, step: u32| {
            [0].into_iter().chain((first..width).step_by(step as usize).map(move |x| level(x, y)))
        };
        let plain: Vec<u8> = (0..height).flat_map(|y| row(y, 0, 1)).collect();
        let of_pass = |[first, top, step, down]: [u32; 4]| {
            let height = if first < width { height } else { 0 };
            (top..height).step_by(down as usize).flat_map(move |y| row(y, first, step))
        };
        let interlaced: Vec<u8> = passes.into_iter().flat_map(of_pass).collect();
        let of = |data: &[u8], interlaced| {
            let header = header([width, height], 8, ColorType::Grayscale, interlaced);
            let path = write(folder.path(), "a.png", &png_of(&[header, chunk(b"IDAT", &stored(data))]));
            ApertureImage::read(&path).map(|image| (image.size, image.cells.clone()))
        };
        let levels: Vec<u8> = (0..height).flat_map(|y| (0..width).map(move |x| level(x, y))).collect();
        let mut pixels = Vec::new();
        let mut encoder = png::Encoder::new(&mut pixels, width, height);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        let rgba: Vec<u8> = levels.iter().flat_map(|level| [*level, *level, *level, 255]).collect();
        encoder.write_header().expect("a header").write_image_data(&rgba).expect("pixels");
        let path = write(folder.path(), "rgba.png", &pixels);
        let expected = ApertureImage::read(&path).map(|image| (image.size, image.cells.clone()));
        if width * height == 1 {
            assert!(expected.is_err(), "a black pixel");
            continue;
        }
        let expected = expected.expect("an aperture");
        assert!(of(&plain, false).expect("an aperture") == expected, "{width} x {height}");
        assert!(of(&interlaced, true).expect("an aperture") == expected, "{width} x {height}, interlaced");
        // Each cell is the mean of its pixels.
        let step = width.max(height).div_ceil(256);
        let (size, cells) = expected;
        assert_eq!(size, [width.div_ceil(step), height.div_ceil(step)]);
        for (index, cell) in (0..).zip(&cells) {
            let [left, top] = [index % size[0] * step, index / size[0] * step];
            let inside = (top..(top + step).min(height))
                .flat_map(|y| (left..(left + step).min(width)).map(move |x| (x, y)));
            let sum: u32 = inside.map(|(x, y)| u32::from(level(x, y))).sum();
            let mean = f64::from(sum) / f64::from(step * step) / 255.0;
            assert!((f64::from(*cell) - mean).abs() < 1e-7, "{width} x {height}, cell {index}");
        }
    }
}

/// Catches a chunk that ends within itself and is read past its end.
#[test]
fn no_prefix_of_a_picture_panics() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let png = png_with(|writer, before| {
        if !before {
            writer
                .write_chunk(ChunkType(*b"tEXt"), format!("thinlens\0{}", text()).as_bytes())
                .expect("text");
        }
    });
    for (name, whole) in [("a.png", png), ("a.exr", exr_with(&text()))] {
        for end in 0..whole.len() {
            let path = write(folder.path(), name, &whole[..end]);
            let _ = (Origin::read(&path), ApertureImage::read(&path));
        }
    }
}
