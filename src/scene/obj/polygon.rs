//! Cuts polygons into triangles.

use super::{Corner, Face, Tally};
use earcut::Earcut;
use glam::DVec3;

/// A polygon of more than three corners, as the fan of triangles that it is read as.
pub(super) struct Polygon {
    /// The first of its triangles.
    pub(super) first: u32,
    /// How many triangles there are: two less than the polygon has corners.
    pub(super) triangles: u32,
    /// The line where it stands.
    pub(super) line: usize,
}

/// Differences of areas up to this share of the polygon's area may come from rounding.
const ROUNDING: f64 = 1e-9;

/// How often a polygon may visit each of its positions, on average. A polygon with a hole visits those twice where a line
/// leads to the hole.
const MAX_VISITS: usize = 3;

/// The most corners of a polygon that is cut: cutting takes up to quadratic time.
const MAX_CORNERS: usize = 1 << 17;

/// Cuts polygons anew whose fans reach out of them. Gives the number of polygons that have no right cut, because their
/// edges cross. Each polygon keeps its number of triangles, some of which may have no area.
pub(super) fn cut(polygons: &[Polygon], positions: &[DVec3], faces: &mut [Face]) -> Tally {
    let mut crossed = Tally::default();
    let mut cutter = Cutter::default();
    let mut across: Vec<DVec3> = Vec::new();
    for polygon in polygons {
        let fan = &mut faces[polygon.first as usize..][..polygon.triangles as usize];
        // A triangle of a fan has the fan's first corner and two neighbours.
        let corner = |index: usize| match index {
            0 | 1 => fan[0].corners[index],
            _ => fan[index - 2].corners[2],
        };
        let ring = || (0..fan.len() + 2).map(corner);
        let place = |corner: Corner| positions[corner.position as usize];
        let first = place(corner(0));
        // The normals of the triangles. Each is as long as twice the triangle's area.
        across.clear();
        across.extend(fan.iter().map(|triangle| {
            let [_, b, c] = triangle.corners.map(|corner| place(corner) - first);
            b.cross(c)
        }));
        let normal: DVec3 = across.iter().sum();
        let least = -ROUNDING * normal.length_squared();
        if across.iter().all(|across| across.dot(normal) >= least) {
            continue;
        }
        cutter.corners.clear();
        cutter.corners.extend(ring());
        cutter.corners.truncate(period(&cutter.corners));
        if is_tangled(&cutter.corners) {
            crossed.note(polygon.line);
            continue;
        }
        if !cutter.cut(|corner| place(corner) - first, normal) {
            crossed.note(polygon.line);
        }
        let mut triangles = cutter.triangles.chunks_exact(3);
        for face in fan {
            let corners = match triangles.next() {
                Some(triangle) => [0, 1, 2].map(|corner: usize| cutter.corners[triangle[corner] as usize]),
                None => [cutter.corners[0]; 3],
            };
            *face = Face { corners, material: face.material };
        }
    }
    crossed
}

/// The number of corners after which a polygon repeats itself, if it goes round many times.
fn period(corners: &[Corner]) -> usize {
    let count = corners.len();
    let same = |a: &[Corner], b: &[Corner]| a.iter().map(|of| of.position).eq(b.iter().map(|of| of.position));
    let repeats = |period: &usize| {
        count.is_multiple_of(*period) && same(&corners[*period..], &corners[..count - period])
    };
    (3..=count / 2).find(repeats).unwrap_or(count)
}

/// Whether the corners form a line to and fro and no polygon. Such a line takes long to cut, and has no right cut.
fn is_tangled(corners: &[Corner]) -> bool {
    let mut positions: Vec<u32> = corners.iter().map(|corner| corner.position).collect();
    positions.sort_unstable();
    positions.dedup();
    corners.len() > MAX_CORNERS || corners.len() > MAX_VISITS * positions.len()
}

#[derive(Default)]
struct Cutter {
    earcut: Earcut<f64>,
    corners: Vec<Corner>,
    flat: Vec<[f64; 2]>,
    triangles: Vec<u32>,
}

impl Cutter {
    /// Fills `triangles` with indices of `corners`, wound as the polygon is. Gives whether the triangles cover exactly what
    /// the polygon covers, which is impossible where its edges cross.
    fn cut(&mut self, place: impl Fn(Corner) -> DVec3, normal: DVec3) -> bool {
        // Projected along the axis that is nearest to its normal, a flat polygon is only stretched.
        let size = normal.abs();
        let [u, v] = if size.x >= size.max_element() {
            [1, 2]
        } else if size.y >= size.z {
            [2, 0]
        } else {
            [0, 1]
        };
        let depth = 3 - u - v;
        let mirrored = normal[depth] < 0.0;
        self.flat.clear();
        self.flat.extend(self.corners.iter().map(|corner| {
            let place = place(*corner);
            if mirrored { [place[v], place[u]] } else { [place[u], place[v]] }
        }));
        self.triangles.clear();
        self.earcut.earcut(self.flat.iter().copied(), &[] as &[u32], &mut self.triangles);
        for triangle in self.triangles.chunks_exact_mut(3) {
            let [a, b, c] = [0, 1, 2].map(|corner: usize| self.flat[triangle[corner] as usize]);
            if (b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]) {
                triangle.swap(1, 2);
            }
        }
        let no_holes: &[u32] = &[];
        earcut::deviation(self.flat.iter().copied(), no_holes, &self.triangles) <= ROUNDING
    }
}
