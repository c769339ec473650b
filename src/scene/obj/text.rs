//! What OBJ and MTL texts have in common: their encodings, lines, words, numbers and names. A name is a
//! string of bytes, for nobody knows in which encoding it was written.

use super::super::MAX_LENGTH;
use crate::input_file;
use glam::DVec3;
use memchr::{memchr, memchr2};
use std::borrow::Cow;
use std::str::FromStr;

/// Says what a file is that is not an OBJ or MTL text, and what to do, in words that follow "it is".
#[derive(Debug)]
pub(in super::super) struct Foreign(pub(in super::super) &'static str);

/// How texts of other kinds begin, beside those that [`input_file::kind`] knows. No OBJ or MTL text begins so.
const FOREIGN: [(&[u8], &str); 2] = [
    (b"<", input_file::WEB_PAGE),
    (b"{", "JSON, such as glTF; convert it to OBJ with a modeller such as Blender"),
];

/// How much of a file is looked at to tell what it is.
const SAMPLE: usize = 4096;

/// The keywords of both formats. A line that begins with one does not continue the line above.
const KEYWORDS: [&[u8]; 57] = [
    b"v",
    b"vt",
    b"vn",
    b"vp",
    b"p",
    b"l",
    b"f",
    b"fo",
    b"g",
    b"s",
    b"mg",
    b"o",
    b"usemtl",
    b"mtllib",
    b"usemap",
    b"maplib",
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
    b"call",
    b"csh",
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"curv",
    b"curv2",
    b"surf",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
    b"newmtl",
    b"Ka",
    b"Kd",
    b"Ks",
    b"Ke",
    b"Tf",
    b"Tr",
    b"Ns",
    b"Ni",
    b"d",
    b"illum",
    b"sharpness",
    b"bump",
    b"disp",
    b"decal",
    b"refl",
    b"norm",
];

/// The text as bytes of which the ASCII ones are ASCII: UTF-16 becomes UTF-8, byte order marks are taken off,
/// and any other encoding stays as it is.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Foreign> {
    refuse_foreign(bytes)?;
    let text = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, rest @ ..] => Cow::Owned(from_utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(from_utf16(rest, u16::from_be_bytes)),
        _ => match zeros(bytes) {
            // Half of the bytes of ASCII in UTF-16 are zero.
            [few, many, units] if many > 4 * few && 4 * many > units => {
                Cow::Owned(from_utf16(bytes, u16::from_le_bytes))
            }
            [many, few, units] if many > 4 * few && 4 * many > units => {
                Cow::Owned(from_utf16(bytes, u16::from_be_bytes))
            }
            _ => Cow::Borrowed(bytes),
        },
    };
    refuse_foreign(&text)?;
    if memchr(0, &text[..text.len().min(SAMPLE)]).is_some() {
        return Err(Foreign("a binary file; convert it to OBJ with a modeller such as Blender"));
    }
    Ok(text)
}

fn refuse_foreign(text: &[u8]) -> Result<(), Foreign> {
    let start = text.trim_ascii_start();
    let of_text =
        || FOREIGN.iter().find(|(beginning, _)| start.starts_with(beginning)).map(|(_, what)| *what);
    if let Some(what) = input_file::kind(start).or_else(of_text) {
        return Err(Foreign(what));
    }
    Ok(())
}

/// How many bytes at even and at odd places are zero, and the number of pairs, in the file's beginning.
fn zeros(bytes: &[u8]) -> [usize; 3] {
    let (pairs, _) = bytes[..bytes.len().min(SAMPLE)].as_chunks::<2>();
    let zeros = |place: usize| pairs.iter().filter(|pair| pair[place] == 0).count();
    [zeros(0), zeros(1), pairs.len()]
}

/// UTF-8, but for halves of pairs without their other half: they get the three bytes of their number, so
/// that different names stay different.
fn from_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Vec<u8> {
    let (pairs, _) = bytes.as_chunks::<2>();
    let mut text = Vec::with_capacity(pairs.len());
    for letter in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        match letter {
            Ok(letter) => text.extend_from_slice(letter.encode_utf8(&mut [0; 4]).as_bytes()),
            Err(half) => {
                let half = half.unpaired_surrogate();
                let tail = |shift: u32| 0x80 | (half >> shift & 0x3f) as u8;
                text.extend_from_slice(&[0xe0 | (half >> 12) as u8, tail(6), tail(0)]);
            }
        }
    }
    text
}

/// Lines and their numbers from 1; they end in LF, CR LF or CR. A backslash at the end of a line joins it
/// with the next one, as white space would, unless the line has a comment, or the next one is empty, is a
/// comment or begins with a keyword: then the backslash is a name's last letter.
pub(super) fn lines(text: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let (mut rest, mut next) = (text, 1);
    std::iter::from_fn(move || {
        let number = next;
        let mut line = Cow::Borrowed(take_line(&mut rest)?);
        next += 1;
        while let Some(start) = line.trim_ascii_end().strip_suffix(b"\\") {
            let goes_on = memchr(b'#', start).is_none() && {
                let following = take_line(&mut { rest }).unwrap_or_default();
                let word = following.split(is_space).find(|word| !word.is_empty()).unwrap_or_default();
                !word.is_empty() && word[0] != b'#' && !KEYWORDS.contains(&word) && !word.starts_with(b"map_")
            };
            if !goes_on {
                break;
            }
            let mut joined = start.trim_ascii_end().to_vec();
            joined.push(b' ');
            joined.extend_from_slice(take_line(&mut rest).unwrap_or_default().trim_ascii_start());
            line = Cow::Owned(joined);
            next += 1;
        }
        Some((number, line))
    })
}

/// Takes the first line off, and gives it without its end.
fn take_line<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    if rest.is_empty() {
        return None;
    }
    let end = memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
    let (line, after) = rest.split_at(end);
    *rest = match after {
        [b'\r', b'\n', after @ ..] | [_, after @ ..] => after,
        [] => after,
    };
    Some(line)
}

/// White space, the vertical tab too.
fn is_space(byte: &u8) -> bool {
    byte.is_ascii_whitespace() || *byte == 0x0b
}

/// The line's first word, and what follows it.
pub(super) fn keyword(line: &[u8]) -> (&[u8], &[u8]) {
    let start = line.iter().position(|byte| !is_space(byte)).unwrap_or(line.len());
    let line = &line[start..];
    let end = line.iter().position(is_space).unwrap_or(line.len());
    line.split_at(end)
}

/// The words of what follows a keyword, where they are numbers: a comment may follow right behind one, and
/// so may a backslash that joins nothing.
pub(super) fn words(rest: &[u8]) -> impl Iterator<Item = &[u8]> {
    let rest = &rest[..memchr(b'#', rest).unwrap_or(rest.len())];
    let end = rest.trim_ascii_end();
    end.strip_suffix(b"\\").unwrap_or(end).split(is_space).filter(|word| !word.is_empty())
}

/// What follows a keyword, where it is a name, in which there may be spaces.
pub(super) fn name(rest: &[u8]) -> &[u8] {
    let start = rest.iter().position(|byte| !is_space(byte)).unwrap_or(rest.len());
    let end = rest.iter().rposition(|byte| !is_space(byte)).map_or(start, |last| last + 1);
    &rest[start..end]
}

/// A name as it is written, and then without what may be comments behind it, the longest first. There may
/// be a `#` in a name, so only a look at where it is used tells.
pub(super) fn readings(name: &[u8]) -> impl Iterator<Item = &[u8]> {
    /// No file has names with more of them, unless it was made to take long.
    const MOST: usize = 8;
    let is_comment = |at: &usize| name[*at] == b'#' && is_space(&name[at - 1]);
    let cuts = (1..name.len()).rev().filter(is_comment).map(|at| self::name(&name[..at]));
    std::iter::once(name).chain(cuts).take(MOST)
}

pub(super) fn number_of<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A number that is finite, and no larger than lengths may be.
pub(super) fn length_of(word: &[u8]) -> Result<f64, String> {
    let limit = f64::from(MAX_LENGTH);
    number_of(word).filter(|number| (-limit..=limit).contains(number)).ok_or_else(|| {
        let advice = match word.contains(&b',') {
            true => "write a point for the comma",
            false => "export the mesh again, or in other units",
        };
        format!("'{}' is not a number from -{limit:e} to {limit:e}; {advice}", String::from_utf8_lossy(word))
    })
}

/// The first three numbers; more may follow.
pub(super) fn three<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<DVec3, String> {
    let mut number = || length_of(words.next().ok_or("three numbers are needed here")?);
    Ok(DVec3::new(number()?, number()?, number()?))
}
