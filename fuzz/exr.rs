//! OpenEXR files, and changes that keep the form of their header: attributes that are as long as they say.

use super::bytes::{self, Part};
use fastrand::Rng;
use std::path::Path;
use thinlens::output::{Origin, write_exr};
use thinlens::pending_file::PendingFile;

/// A small picture that carries these arguments.
pub fn picture(arguments: &[&str]) -> Vec<u8> {
    let origin = Origin::new(arguments.iter().map(Into::into).collect());
    let file = PendingFile::create(Path::new("seed.exr")).expect("a writable folder");
    write_exr(file, [3, 2], &[[0.5; 4]; 6], Some(&origin)).expect("a writable folder");
    std::fs::read("seed.exr").expect("a readable file")
}

/// The attributes of a header, and what follows them.
fn split(bytes: &[u8]) -> Option<(&[u8], Vec<Part>, &[u8])> {
    let (head, mut rest) = bytes.split_at_checked(8)?;
    let mut parts = Vec::new();
    while *rest.first()? != 0 {
        let mut names = rest.splitn(3, |byte| *byte == 0);
        let length = names.next()?.len() + names.next()?.len() + 2;
        let (kind, behind) = rest.split_at_checked(length)?;
        let (size, behind) = behind.split_first_chunk::<4>()?;
        let (data, behind) = behind.split_at_checked(u32::from_le_bytes(*size) as usize)?;
        parts.push(Part { kind: kind.to_vec(), data: data.to_vec() });
        rest = behind;
    }
    Some((head, parts, rest))
}

fn join(head: &[u8], parts: &[Part], rest: &[u8]) -> Vec<u8> {
    let attribute = |part: &Part| {
        let size = u32::try_from(part.data.len()).unwrap_or(u32::MAX).to_le_bytes();
        [&part.kind[..], &size, &part.data].concat()
    };
    [head, &parts.iter().flat_map(attribute).collect::<Vec<u8>>(), rest].concat()
}

/// A file changed in a few places: mostly in its attributes, sometimes as bytes.
pub fn mutate(random: &mut Rng, one: &[u8], other: &[u8]) -> Vec<u8> {
    let parts = split(one).filter(|_| random.u8(..6) > 0);
    let mut bytes = if let Some((head, mut parts, rest)) = parts {
        let others = split(other).map_or(Vec::new(), |(_, parts, _)| parts);
        for _ in 0..random.u8(1..=3) {
            bytes::change_parts(random, &mut parts, &others);
        }
        join(head, &parts, rest)
    } else {
        one.to_vec()
    };
    if random.u8(..6) == 0 {
        bytes::change(random, &mut bytes, other);
    }
    bytes.truncate(bytes::MAX_INPUT_BYTES);
    bytes
}

/// The same file with another text of how it was made.
pub fn with_text(bytes: &[u8], change: impl FnOnce(&[u8]) -> Vec<u8>) -> Vec<u8> {
    let Some((head, mut parts, rest)) = split(bytes) else { return bytes.to_vec() };
    if let Some(part) = parts.iter_mut().find(|part| part.kind.starts_with(b"thinlens\0")) {
        part.data = change(&part.data);
    }
    join(head, &parts, rest)
}
