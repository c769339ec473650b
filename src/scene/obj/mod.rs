//! Reads Wavefront OBJ text: positions, normals, faces and the names of materials (Wavefront, *Object
//! Files*, appendix B1 of the Advanced Visualizer manual), and the MTL texts beside it. Curves, points,
//! lines, groups and texture coordinates are passed over. No library is used: those at hand take every line for UTF-8,
//! do not say which line is wrong, and do not join lines that end in a backslash.

mod library;
mod polygon;
mod search;
mod text;

pub(super) use library::{Library, Paint, parse_library};
pub(super) use search::find_libraries;
pub(super) use text::Foreign;

use glam::{DVec3, Vec3};
use polygon::Polygon;
use std::collections::{HashMap, HashSet};
use std::num::NonZeroU32;
use text::{keyword, lines, name, number_of, three, words};

/// The contents of a file. Every index is within its list.
#[derive(Debug, Default)]
pub(super) struct Obj {
    pub(super) positions: Vec<DVec3>,
    /// The normals: each of length one, or zero where the file's cannot be used.
    pub(super) normals: Vec<Vec3>,
    pub(super) faces: Vec<Face>,
    /// Names that `usemtl` gave, which faces name by index.
    pub(super) materials: Vec<Vec<u8>>,
    /// The texts that follow `mtllib`, each once.
    pub(super) libraries: Vec<Vec<u8>>,
    /// Normals without a direction: numbers are missing, are no numbers, or are all zero.
    pub(super) unusable_normals: Tally,
    /// Faces with fewer than three corners, which are left out.
    pub(super) short_faces: Tally,
    /// Polygons whose edges cross, so that their triangles are a guess.
    pub(super) crossed_faces: Tally,
}

/// A triangle of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    pub(super) corners: [Corner; 3],
    pub(super) material: Option<u32>,
}

/// A corner of a face.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Corner {
    /// Index into the positions.
    pub(super) position: u32,
    /// Number of its normal, from 1, where it has one.
    pub(super) normal: Option<NonZeroU32>,
}

/// How often something occurs, and the first line where it does.
#[derive(Debug, Default)]
pub(super) struct Tally {
    pub(super) count: usize,
    pub(super) line: usize,
}

impl Tally {
    /// Whether this occurrence is the first.
    fn note(&mut self, line: usize) -> bool {
        if self.count == 0 {
            self.line = line;
        }
        self.count += 1;
        self.count == 1
    }
}

/// What is wrong with a file.
pub(super) enum ObjError {
    /// A line is wrong: its number, from 1.
    Line(usize, String),
    /// The file is not an OBJ text.
    Foreign(Foreign),
}

/// The largest index so far, where it stands, and how it is written there. An index may name something that comes later
/// in the file, so only its end tells whether the index is right.
#[derive(Default)]
struct Largest {
    end: usize,
    line: usize,
}

#[derive(Default)]
struct Reader {
    obj: Obj,
    material: Option<u32>,
    index_of_material: HashMap<Vec<u8>, u32>,
    known_libraries: HashSet<Vec<u8>>,
    largest_position: Largest,
    largest_normal: Largest,
    polygons: Vec<Polygon>,
    corners: Vec<Corner>,
    /// Whether any line was understood.
    is_obj: bool,
}

/// Reads OBJ text in any encoding.
pub(super) fn parse(bytes: &[u8]) -> Result<Obj, ObjError> {
    let text = text::decode(bytes).map_err(ObjError::Foreign)?;
    let mut reader = Reader::default();
    for (number, line) in lines(&text) {
        reader.read(number, &line).map_err(|message| ObjError::Line(number, message))?;
    }
    if !reader.is_obj {
        return Err(ObjError::Foreign(Foreign("text without a line of OBJ; export the mesh as OBJ")));
    }
    let Reader { mut obj, largest_position, largest_normal, polygons, .. } = reader;
    for (largest, count, what) in [
        (largest_position, obj.positions.len(), "positions (v)"),
        (largest_normal, obj.normals.len(), "normals (vn)"),
    ] {
        if largest.end > count {
            let message =
                format!("the face names number {} of the {count} {what}; is the file whole?", largest.end);
            return Err(ObjError::Line(largest.line, message));
        }
    }
    obj.crossed_faces = polygon::cut(&polygons, &obj.positions, &mut obj.faces);
    Ok(obj)
}

impl Reader {
    fn read(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let (keyword, rest) = keyword(line);
        match keyword {
            b"v" => self.obj.positions.push(three(words(rest))?),
            b"vn" => self.normal(number, rest),
            b"f" | b"fo" => self.face(number, rest)?,
            b"usemtl" => self.use_material(name(rest)),
            b"mtllib" => {
                if self.known_libraries.insert(name(rest).to_vec()) {
                    self.obj.libraries.push(name(rest).to_vec());
                }
            }
            b"vt" | b"vp" | b"l" | b"p" | b"curv" | b"curv2" | b"surf" => {}
            _ => return Ok(()),
        }
        self.is_obj = true;
        Ok(())
    }

    fn normal(&mut self, number: usize, rest: &[u8]) {
        let mut numbers = words(rest).map(|word| number_of::<f64>(word).unwrap_or(f64::NAN));
        let normal = DVec3::from_array([0; 3].map(|_| numbers.next().unwrap_or(f64::NAN)));
        // The squares of the largest numbers are infinite, and those of the smallest are zero.
        let unit = (normal / normal.abs().max_element()).try_normalize();
        match unit.filter(|_| normal.is_finite()) {
            Some(unit) => self.obj.normals.push(unit.as_vec3()),
            None => {
                self.obj.normals.push(Vec3::ZERO);
                self.obj.unusable_normals.note(number);
            }
        }
    }

    fn face(&mut self, number: usize, rest: &[u8]) -> Result<(), String> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for word in words(rest) {
            let corner = self.corner(number, word).ok_or_else(|| {
                let word = String::from_utf8_lossy(word);
                format!("'{word}' is not a corner of a face; a corner is v, v/vt, v//vn or v/vt/vn, counted from 1")
            })?;
            corners.push(corner);
        }
        if let [first, rest @ ..] = &*corners
            && rest.len() > 1
        {
            if rest.len() > 2 {
                let index = |len: usize| u32::try_from(len).map_err(|_| "the file has too many faces");
                let (first, triangles) = (index(self.obj.faces.len())?, index(rest.len() - 1)?);
                self.polygons.push(Polygon { first, triangles, line: number });
            }
            let fan = rest.windows(2).map(|pair| [*first, pair[0], pair[1]]);
            self.obj.faces.extend(fan.map(|corners| Face { corners, material: self.material }));
        } else {
            self.obj.short_faces.note(number);
        }
        self.corners = corners;
        Ok(())
    }

    fn corner(&mut self, number: usize, word: &[u8]) -> Option<Corner> {
        let mut parts = word.split(|byte| *byte == b'/');
        let position = self.largest_position.note(number, parts.next()?, self.obj.positions.len())?;
        let texture = parts.next().unwrap_or_default();
        if !texture.is_empty() {
            number_of::<i64>(texture)?;
        }
        let normal = match parts.next().unwrap_or_default() {
            b"" => None,
            part => {
                let index = self.largest_normal.note(number, part, self.obj.normals.len())?;
                NonZeroU32::new(index + 1)
            }
        };
        parts.next().is_none().then_some(Corner { position, normal })
    }

    fn use_material(&mut self, name: &[u8]) {
        let index = self.index_of_material.get(name).copied().unwrap_or_else(|| {
            let index = u32::try_from(self.obj.materials.len()).unwrap_or(u32::MAX);
            self.obj.materials.push(name.to_vec());
            self.index_of_material.insert(name.to_vec(), index);
            index
        });
        self.material = Some(index);
    }
}

impl Largest {
    /// The index, counted from 0, of an item that is written as counted from 1, or backwards from -1. There are `count`
    /// items so far.
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
