//! Changes of bytes, whatever they mean.

use fastrand::Rng;

/// Inputs are no longer than this.
pub const MAX_INPUT_BYTES: usize = 60_000;

/// Flips, sets, drops, repeats and moves bytes, cuts the end off, or goes on as another input does.
pub fn change(random: &mut Rng, bytes: &mut Vec<u8>, other: &[u8]) {
    let place = random.usize(..=bytes.len());
    let end = (place + random.usize(1..=16)).min(bytes.len());
    match random.u8(..9) {
        0 | 1 => {
            if let Some(byte) = bytes.get_mut(place) {
                *byte ^= 1 << random.u8(..8);
            }
        }
        2 => {
            if let Some(byte) = bytes.get_mut(place) {
                *byte = random.u8(..);
            }
        }
        3 => drop(bytes.drain(place..end)),
        4 => {
            let part = bytes[place..end].repeat(random.usize(1..=4));
            drop(bytes.splice(place..place, part));
        }
        5 => bytes.truncate(place),
        6 => {
            bytes.truncate(place);
            bytes.extend(&other[random.usize(..=other.len())..]);
        }
        7 => number(random, bytes, place),
        _ => bytes.insert(place, random.u8(..)),
    }
    bytes.truncate(MAX_INPUT_BYTES);
}

/// Writes an extreme number over what is there, of two, four or eight bytes and either order.
fn number(random: &mut Rng, bytes: &mut [u8], place: usize) {
    const NUMBERS: [u64; 14] = [
        0,
        1,
        2,
        0x7f,
        0xff,
        0x7fff,
        0xffff,
        16384,
        16385,
        300_000,
        0x7fff_ffff,
        0x8000_0000,
        0xffff_ffff,
        u64::MAX,
    ];
    let width = [2, 4, 4, 8][random.usize(..4)];
    let number = NUMBERS[random.usize(..NUMBERS.len())];
    // Fields of files often begin at a multiple of their width.
    let place = if random.bool() { place / width * width } else { place };
    let ordered = if random.bool() {
        number.to_le_bytes()
    } else {
        number.rotate_right(8 * width as u32).to_be_bytes()
    };
    bytes.iter_mut().skip(place).zip(ordered).take(width).for_each(|(byte, new)| *byte = new);
}

/// A part of a file that has parts: its kind, and what it holds.
#[derive(Clone)]
pub struct Part {
    pub kind: Vec<u8>,
    pub data: Vec<u8>,
}

/// Changes what is in parts, drops some, repeats and moves them, and takes some of another file.
pub fn change_parts(random: &mut Rng, parts: &mut Vec<Part>, others: &[Part]) {
    if parts.is_empty() {
        return parts.extend_from_slice(others);
    }
    let [place, second] = [(); 2].map(|()| random.usize(..parts.len()));
    match random.u8(..10) {
        0 => drop(parts.remove(place)),
        1 => {
            let part = parts[place].clone();
            let copies = if random.u8(..20) == 0 { 200 } else { random.usize(1..3) };
            let copies = copies.min(MAX_INPUT_BYTES / (part.data.len() + 12));
            drop(parts.splice(place..place, vec![part; copies]));
        }
        2 => parts.swap(place, second),
        3 | 4 => {
            if !others.is_empty() {
                parts.insert(place, others[random.usize(..others.len())].clone());
            }
        }
        5 => {
            let kind = &mut parts[place].kind;
            let letter = random.usize(..kind.len().max(1));
            if let Some(letter) = kind.get_mut(letter) {
                *letter = if random.bool() { *letter ^ 0x20 } else { random.u8(..) };
            }
        }
        _ => {
            let other = others.get(place).map_or(&[][..], |other| &other.data);
            change(random, &mut parts[place].data, other);
        }
    }
}
