//! OBJ texts, and scenes of them.

use glam::DVec3;
use std::fmt::Write;
use thinlens::error::Error;
use thinlens::scene::{self, Scene, Triangle};

/// A scene file without shapes; nothing but the tables that follow gives light.
pub const HEAD: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 9\n";

/// Loads the first of these files, which lie in one folder.
pub fn load(files: &[(&str, &[u8])]) -> Result<Scene, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a writable temporary folder");
    }
    scene::load(folder.path().join(files[0].0).to_str().expect("a plain path"))
}

pub fn across(triangle: &Triangle) -> DVec3 {
    let [a, b, c] = triangle.vertices;
    (b - a).cross(c - a)
}

/// A sphere of radius one around the origin: each face of an octahedron in `n * n` triangles.
/// With `repeated`, each triangle has positions of its own; with `given`, the file has normals.
pub fn sphere(n: u32, repeated: bool, given: bool) -> String {
    let (mut text, mut faces, mut count) = (String::new(), String::new(), 0);
    let mut numbers = std::collections::HashMap::new();
    for octant in 0..8 {
        let sign = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let mut corner = |i: u32, j: u32| {
            let parts = [i, j, n - i - j].map(f64::from);
            let at = (DVec3::from_array(parts) * DVec3::new(sign(0), sign(1), sign(2))).normalize();
            let written = format!("{:.7} {:.7} {:.7}", at.x + 0.0, at.y + 0.0, at.z + 0.0);
            let number = numbers.get(&written).copied().filter(|_| !repeated).unwrap_or(count + 1);
            if number > count {
                count = number;
                writeln!(text, "v {written}").expect("text");
                if given {
                    writeln!(text, "vn {written}").expect("text");
                }
                numbers.insert(written, number);
            }
            if given { format!("{number}//{number}") } else { number.to_string() }
        };
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            let mut write = |mut corners: [String; 3]| {
                // A mirrored octant is wound the other way.
                if sign(0) * sign(1) * sign(2) < 0.0 {
                    corners.swap(1, 2);
                }
                writeln!(faces, "f {}", corners.join(" ")).expect("text");
            };
            write([corner(i, j), corner(i + 1, j), corner(i, j + 1)]);
            if i + j + 1 < n {
                write([corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
            }
        }
    }
    text + &faces
}
