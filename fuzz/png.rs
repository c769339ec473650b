//! PNG files, right in form, and changes that keep them so: checksums are of what is there.

use super::bytes::{self, Part};
use fastrand::Rng;
use flate2::{Compression, Crc, write::ZlibEncoder};
use std::io::Write;

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// First column and row, and the steps to the next ones, of each pass of an interlaced image (PNG specification, 8.2).
const PASSES: [[u32; 4]; 7] =
    [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

fn part(kind: &[u8], data: impl Into<Vec<u8>>) -> Part {
    Part { kind: kind.to_vec(), data: data.into() }
}

pub fn zlib(data: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(data).and_then(|()| encoder.finish()).expect("memory takes it")
}

/// An image of this colour type and depth with random pixels, and with other chunks before them.
pub fn image(random: &mut Rng, [color, depth]: [u8; 2], interlaced: bool, others: Vec<Part>) -> Vec<u8> {
    let [width, height] = [(); 2].map(|()| random.u32(1..=40));
    let channels = match color {
        2 => 3,
        4 => 2,
        6 => 4,
        _ => 1,
    };
    let mut rows = Vec::new();
    let passes = if interlaced { &PASSES[..] } else { &[[0, 0, 1, 1]] };
    for [x, y, step_x, step_y] in passes {
        let columns = width.saturating_sub(*x).div_ceil(*step_x);
        let lines = if columns == 0 { 0 } else { height.saturating_sub(*y).div_ceil(*step_y) };
        for _ in 0..lines {
            rows.push(random.u8(..5));
            let bits = columns * channels * u32::from(depth);
            rows.extend((0..bits.div_ceil(8)).map(|_| random.u8(..)));
        }
    }
    let size = [width.to_be_bytes(), height.to_be_bytes()].concat();
    let header = [&size[..], &[depth, color, 0, 0, u8::from(interlaced)]].concat();
    let mut parts = vec![part(b"IHDR", header)];
    if color == 3 {
        parts.push(part(b"PLTE", (0..3 << depth).map(|_| random.u8(..)).collect::<Vec<_>>()));
        if random.bool() {
            parts.push(part(b"tRNS", (0..1 << depth).map(|_| random.u8(..)).collect::<Vec<_>>()));
        }
    } else if random.bool() && channels % 2 == 1 {
        parts.push(part(b"tRNS", vec![0; 2 * channels as usize]));
    }
    parts.extend(others);
    let packed = zlib(&rows);
    let first = random.usize(..=packed.len());
    parts.extend([part(b"IDAT", &packed[..first]), part(b"IDAT", &packed[first..]), part(b"IEND", [])]);
    join(&parts)
}

/// The chunks that can hold a text of this name, each in its own form.
pub fn texts(name: &str, text: &str) -> [Part; 4] {
    let (name, text) = (name.as_bytes(), text.as_bytes());
    [
        part(b"tEXt", [name, b"\0", text].concat()),
        part(b"zTXt", [name, b"\0\0", &zlib(text)].concat()),
        part(b"iTXt", [name, b"\0\0\0\0\0", text].concat()),
        part(b"iTXt", [name, b"\0\x01\0\0\0", &zlib(text)].concat()),
    ]
}

fn join(parts: &[Part]) -> Vec<u8> {
    let mut bytes = SIGNATURE.to_vec();
    for Part { kind, data } in parts {
        let mut sum = Crc::new();
        sum.update(kind);
        sum.update(data);
        bytes.extend(u32::try_from(data.len()).unwrap_or(u32::MAX).to_be_bytes());
        bytes.extend(kind);
        bytes.extend(data);
        bytes.extend(sum.sum().to_be_bytes());
    }
    bytes
}

/// The chunks of a file, up to where it is none.
fn split(bytes: &[u8]) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut rest = bytes.get(SIGNATURE.len()..).unwrap_or_default();
    while let Some((length, behind)) = rest.split_first_chunk::<4>() {
        let length = u32::from_be_bytes(*length) as usize;
        let Some((kind, behind)) = behind.split_first_chunk::<4>() else { break };
        let Some(data) = behind.get(..length) else { break };
        parts.push(part(kind, data));
        rest = behind.get(length + 4..).unwrap_or_default();
    }
    parts
}

/// A file changed in a few places: mostly in its chunks, sometimes as bytes.
pub fn mutate(random: &mut Rng, one: &[u8], other: &[u8]) -> Vec<u8> {
    if random.u8(..8) == 0 {
        let mut bytes = one.to_vec();
        bytes::change(random, &mut bytes, other);
        return bytes;
    }
    let (mut parts, others) = (split(one), split(other));
    for _ in 0..random.u8(1..=3) {
        // The header decides about the most.
        match parts.first_mut().filter(|_| random.u8(..4) == 0) {
            Some(header) => bytes::change(random, &mut header.data, &[]),
            None => bytes::change_parts(random, &mut parts, &others),
        }
    }
    let mut bytes = join(&parts);
    bytes.truncate(bytes::MAX_INPUT_BYTES);
    bytes
}

/// The same file with another text of how it was made, sometimes in another of the chunks for texts.
pub fn with_text(random: &mut Rng, bytes: &[u8], change: impl FnOnce(&mut Rng, &[u8]) -> Vec<u8>) -> Vec<u8> {
    const NAME: &[u8] = b"thinlens\0";
    let mut parts = split(bytes);
    let plain = parts.iter().position(|part| part.kind == b"tEXt" && part.data.starts_with(NAME));
    if let Some(place) = plain {
        let text = change(random, &parts[place].data[NAME.len()..]);
        let kind = random.usize(..12);
        let [plain, packed, international, both] = texts("thinlens", &String::from_utf8_lossy(&text));
        parts[place] = match kind {
            0 => packed,
            1 => international,
            2 => both,
            _ => plain,
        };
    }
    join(&parts)
}
