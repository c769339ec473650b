//! Changes of texts, by words and lines.

use super::bytes::{self, MAX_INPUT_BYTES};
use fastrand::Rng;

/// Numbers that are hard to hold, and some that are no numbers.
const NUMBERS: [&str; 40] = [
    "0",
    "-0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "2",
    "-2",
    "3",
    "0.5",
    "1e-6",
    "9.99999997e-7",
    "1e-7",
    "1e-20",
    "1e-45",
    "1e-46",
    "5e-324",
    "1e-310",
    "1e9",
    "-1e9",
    "1000000001.0",
    "1e20",
    "3.4e38",
    "1e39",
    "1e308",
    "1e309",
    "-1e308",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "16384",
    "16385",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551616",
];

/// A number, as texts have them.
fn number(random: &mut Rng) -> String {
    match random.u8(..4) {
        0 => format!("{}", random.i32(-9..40)),
        1 => format!("{}", f64::from(random.i32(-2000..2000)) / 100.0),
        _ => NUMBERS[random.usize(..NUMBERS.len())].into(),
    }
}

/// Words, and every other byte by itself.
fn split(text: &[u8]) -> Vec<&[u8]> {
    let in_word = |byte: &u8| byte.is_ascii_alphanumeric() || b"._-+".contains(byte) || *byte >= 0x80;
    text.chunk_by(|a, b| in_word(a) && in_word(b)).collect()
}

/// A text changed in a few places. `known` are the words of its format.
pub fn mutate(random: &mut Rng, one: &[u8], other: &[u8], known: &[&str]) -> Vec<u8> {
    let mut text = one.to_vec();
    for _ in 0..[1, 1, 1, 2, 2, 4][random.usize(..6)] {
        text = match random.u8(..16) {
            0..=8 => words(random, &text, known),
            9..=12 => lines(random, &text, other),
            13 => again(random, &text),
            14 if random.u8(..4) == 0 => encode(random, &text),
            _ => {
                bytes::change(random, &mut text, other);
                text
            }
        };
        text.truncate(MAX_INPUT_BYTES);
    }
    text
}

fn words(random: &mut Rng, text: &[u8], known: &[&str]) -> Vec<u8> {
    let mut words = split(text);
    if words.is_empty() {
        return known[random.usize(..known.len())].into();
    }
    let (place, second) = (random.usize(..words.len()), random.usize(..words.len()));
    // A word rather than the space beside it.
    let place = (place..words.len()).find(|at| words[*at][0].is_ascii_alphanumeric()).unwrap_or(place);
    let is_number = words[place][0].is_ascii_digit() || words[place][0] == b'-';
    let new = if is_number != (random.u8(..8) == 0) {
        number(random)
    } else {
        known[random.usize(..known.len())].to_owned()
    };
    match random.u8(..8) {
        0..=3 => words[place] = new.as_bytes(),
        4 => drop(words.remove(place)),
        5 => words.swap(place, second),
        6 => words[place] = words[second],
        _ => words.insert(second, new.as_bytes()),
    }
    words.concat()
}

fn lines(random: &mut Rng, text: &[u8], other: &[u8]) -> Vec<u8> {
    let lines_of = |text| <[u8]>::split_inclusive(text, |byte| *byte == b'\n').collect::<Vec<_>>();
    let (mut lines, others) = (lines_of(text), lines_of(other));
    if lines.is_empty() || others.is_empty() {
        return other.to_vec();
    }
    let (place, second) = (random.usize(..lines.len()), random.usize(..lines.len()));
    let end = (place + random.usize(1..=5)).min(lines.len());
    let from = random.usize(..others.len());
    let to = (from + random.usize(1..=5)).min(others.len());
    match random.u8(..6) {
        0 => drop(lines.drain(place..end)),
        1 => lines.swap(place, second),
        2 => drop(lines.splice(second..second, lines[place..end].to_vec())),
        3 | 4 => drop(lines.splice(place..place, others[from..to].iter().copied())),
        _ => {
            lines.truncate(place);
            lines.extend(&others[from..]);
        }
    }
    lines.concat()
}

/// Some words or lines again and again, and rarely very often.
fn again(random: &mut Rng, text: &[u8]) -> Vec<u8> {
    let place = random.usize(..=text.len());
    let words = split(&text[place..]);
    let part: Vec<u8> = match random.bool() {
        true => words.iter().take(random.usize(1..=4)).copied().collect::<Vec<_>>().concat(),
        false => text[place..].split_inclusive(|byte| *byte == b'\n').take(2).collect::<Vec<_>>().concat(),
    };
    let most = if random.u8(..40) == 0 { MAX_INPUT_BYTES } else { 400 };
    let times = random.usize(1..=(most / part.len().max(1)).max(1));
    [&text[..place], &part.repeat(times), &text[place..]].concat()
}

/// The same text with other line ends, with a mark, or in UTF-16.
fn encode(random: &mut Rng, text: &[u8]) -> Vec<u8> {
    let units = |bytes: fn(u16) -> [u8; 2]| {
        let text = String::from_utf8_lossy(text);
        text.encode_utf16().flat_map(bytes).collect::<Vec<u8>>()
    };
    let ends = |end: &[u8]| text.split(|byte| *byte == b'\n').collect::<Vec<_>>().join(end);
    match random.u8(..7) {
        0 => ends(b"\r\n"),
        1 => ends(b"\r"),
        2 => ends(b"\\\n"),
        3 => [b"\xef\xbb\xbf", text].concat(),
        4 => [b"\xff\xfe", &*units(u16::to_le_bytes)].concat(),
        5 => [b"\xfe\xff", &*units(u16::to_be_bytes)].concat(),
        _ => units(u16::to_le_bytes),
    }
}
