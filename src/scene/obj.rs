//! Reads Wavefront OBJ text: positions, normals, faces and the names of materials (Wavefront, *Object
//! Files*, appendix B1 of the Advanced Visualizer manual). Curves, points, lines, groups and texture
//! coordinates are passed over. No library: errors name their line here, whatever the file holds.

use super::MAX_LENGTH;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::str::FromStr;

/// What a file holds, with every index inside its list.
#[derive(Default)]
pub(super) struct Obj {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) faces: Vec<Face>,
    /// Names that `usemtl` gave, which faces name by index.
    pub(super) materials: Vec<String>,
    /// Files that `mtllib` named.
    pub(super) libraries: Vec<String>,
}

/// A triangle of a file.
pub(super) struct Face {
    /// Indices into the positions.
    pub(super) positions: [u32; 3],
    /// Indices into the normals, where all three corners have one.
    pub(super) normals: Option<[u32; 3]>,
    pub(super) material: Option<u32>,
}

/// What is wrong, and in which line, from 1.
pub(super) struct ObjFault {
    pub(super) line: usize,
    pub(super) message: String,
}

/// The largest index met, where, and as written there: an index may name what comes later, so that
/// only the end of the file tells whether it is right.
#[derive(Default)]
struct Largest {
    end: usize,
    line: usize,
}

#[derive(Default)]
struct Reader {
    obj: Obj,
    material: Option<u32>,
    index_of_material: HashMap<String, u32>,
    largest_position: Largest,
    largest_normal: Largest,
    polygon: Vec<(u32, Option<u32>)>,
}

/// Reads OBJ text. Polygons become fans of triangles, so they should be convex.
pub(super) fn parse(text: &[u8]) -> Result<Obj, ObjFault> {
    let mut reader = Reader::default();
    for (number, line) in lines(text) {
        reader.read(number, line).map_err(|message| ObjFault { line: number, message })?;
    }
    let Reader { obj, largest_position, largest_normal, .. } = reader;
    for (largest, count, what) in [
        (largest_position, obj.positions.len(), "positions (v)"),
        (largest_normal, obj.normals.len(), "normals (vn)"),
    ] {
        if largest.end > count {
            let message =
                format!("the face names number {} of the {count} {what}; is the file whole?", largest.end);
            return Err(ObjFault { line: largest.line, message });
        }
    }
    Ok(obj)
}

/// The diffuse colours of an MTL text, by the names of the materials. What cannot be read is passed
/// over.
pub(super) fn parse_library(text: &[u8]) -> HashMap<String, Vec3> {
    let mut colors = HashMap::new();
    let mut name = None;
    for (_, line) in lines(text) {
        let mut words = words(line);
        match words.next() {
            Some(b"newmtl") => name = Some(rest_of(line)),
            Some(b"Kd") => {
                if let (Some(name), Ok(color)) = (&name, three(words)) {
                    colors.insert(name.clone(), color.clamp(DVec3::ZERO, DVec3::ONE).as_vec3());
                }
            }
            _ => {}
        }
    }
    colors
}

impl Reader {
    fn read(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let mut words = words(line);
        match words.next() {
            Some(b"v") => self.obj.positions.push(three(words)?),
            Some(b"vn") => self.obj.normals.push(three(words)?.as_vec3()),
            Some(b"f") => self.face(number, words)?,
            Some(b"usemtl") => self.use_material(rest_of(line)),
            Some(b"mtllib") => self.obj.libraries.push(rest_of(line)),
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, number: usize, words: impl Iterator<Item = &'a [u8]>) -> Result<(), String> {
        self.polygon.clear();
        for word in words {
            let corner = self.corner(number, word).ok_or_else(|| {
                let word = String::from_utf8_lossy(word);
                format!("'{word}' is no corner of a face; one is v, v/vt, v//vn or v/vt/vn, counted from 1")
            })?;
            self.polygon.push(corner);
        }
        if self.polygon.len() < 3 {
            return Err("a face needs three corners or more".into());
        }
        let (first, rest) = (self.polygon[0], &self.polygon[1..]);
        for pair in rest.windows(2) {
            let corners = [first, pair[0], pair[1]];
            let normals = match corners.map(|corner| corner.1) {
                [Some(a), Some(b), Some(c)] => Some([a, b, c]),
                _ => None,
            };
            let positions = corners.map(|corner| corner.0);
            self.obj.faces.push(Face { positions, normals, material: self.material });
        }
        Ok(())
    }

    /// The position's and the normal's index.
    fn corner(&mut self, number: usize, word: &[u8]) -> Option<(u32, Option<u32>)> {
        let mut parts = word.split(|byte| *byte == b'/');
        let position = self.largest_position.note(number, parts.next()?, self.obj.positions.len())?;
        let texture = parts.next().unwrap_or_default();
        if !texture.is_empty() {
            number_of::<i64>(texture)?;
        }
        let normal = match parts.next().unwrap_or_default() {
            b"" => None,
            part => Some(self.largest_normal.note(number, part, self.obj.normals.len())?),
        };
        parts.next().is_none().then_some((position, normal))
    }

    fn use_material(&mut self, name: String) {
        let names = &mut self.obj.materials;
        let index = *self.index_of_material.entry(name).or_insert_with_key(|name| {
            names.push(name.clone());
            u32::try_from(names.len() - 1).unwrap_or(u32::MAX)
        });
        self.material = Some(index);
    }
}

impl Largest {
    /// The index from 0 of what is written from 1, or from -1 backwards. `count` are there so far.
    fn note(&mut self, line: usize, written: &[u8], count: usize) -> Option<u32> {
        let written = number_of::<i64>(written)?;
        let from_one = if written < 0 { i64::try_from(count).ok()? + 1 + written } else { written };
        let index = u32::try_from(from_one).ok()?.checked_sub(1)?;
        let end = index as usize + 1;
        if end > self.end {
            *self = Self { end, line };
        }
        Some(index)
    }
}

/// Lines and their numbers from 1. A backslash at the end of a line joins it with the next one.
fn lines(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let (mut rest, mut next) = (text, 1);
    std::iter::from_fn(move || {
        let number = next;
        let mut end = 0;
        while end < rest.len() {
            let start = end;
            end =
                rest[start..].iter().position(|byte| *byte == b'\n').map_or(rest.len(), |at| start + at + 1);
            next += 1;
            if !rest[start..end].trim_ascii_end().ends_with(b"\\") {
                break;
            }
        }
        let line;
        (line, rest) = rest.split_at(end);
        (end > 0).then_some((number, line))
    })
}

/// The words of a line, without its comment.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty() && *word != b"\\")
        .take_while(|word| word[0] != b'#')
}

/// What follows a line's first word: a name, in which there may be spaces.
fn rest_of(line: &[u8]) -> String {
    let line = line.trim_ascii();
    let start = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    String::from_utf8_lossy(line[start..].trim_ascii()).into_owned()
}

fn number_of<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The first three numbers; more may follow.
fn three<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<DVec3, String> {
    let limit = f64::from(MAX_LENGTH);
    let mut number = || {
        let word = words.next().ok_or("three numbers are needed here")?;
        let number = number_of::<f64>(word).filter(|number| (-limit..=limit).contains(number));
        number.ok_or_else(|| {
            let word = String::from_utf8_lossy(word);
            format!(
                "'{word}' is no number from -{limit:e} to {limit:e}; export the mesh again, or in other units"
            )
        })
    };
    Ok(DVec3::new(number()?, number()?, number()?))
}
