//! An upper bound for the luminance that a pixel's rays can meet. An adaptive picture needs the bound where something
//! bright may have been missed by all samples so far. See `shaders/core/adaptive.glsl`.

use super::Camera;
use crate::interface::DISPERSION;
use crate::scene::{Frame, Integrator, Plane, Scene, luminance};
use crate::settings::Estimator;
use glam::{DQuat, DVec2, DVec3, Vec3};

/// An upper bound for the luminance that a pixel's rays can meet, for each cell of a grid over the picture.
///
/// A shape counts in the rectangle that bounds its picture, seen through all points of the aperture and at all times,
/// even if other shapes hide it. It counts with the luminance that it has where all lights shine on it from the front
/// and its highlight points at the camera. A mirror counts as if it showed the brightest thing of the scene, wherever
/// that is.
#[derive(Debug, Clone, PartialEq)]
pub struct Brightest {
    /// The bound of each cell, row by row from the top left.
    pub luminances: Vec<f32>,
    /// Width and height of a cell in pixels.
    pub cell: u32,
    columns: u32,
}

impl Brightest {
    /// The most cells that a grid has. One update of a buffer can write as many.
    pub const MAX_CELLS: u32 = 16384;

    /// The width and height of a cell in pixels, and the numbers of columns and rows. The cells are as small as
    /// [`Self::MAX_CELLS`] allows.
    pub fn grid(size: [u32; 2]) -> [u32; 3] {
        let cells = |edge: u32| size.map(|length| length.div_ceil(edge));
        let fits = |[columns, rows]: [u32; 2]| columns.saturating_mul(rows) <= Self::MAX_CELLS;
        let cell = (1..).find(|edge| fits(cells(*edge))).unwrap_or(u32::MAX);
        let [columns, rows] = cells(cell);
        [cell, columns, rows]
    }

    /// For a picture of these settings.
    pub fn new(estimator: &Estimator) -> Self {
        let [cell, columns, rows] = Self::grid(estimator.size);
        let scene = &*estimator.scene;
        let of_materials = luminances(estimator);
        let sky = luminance(sky(scene)) as f32;
        let mut grid = Self { luminances: vec![sky; (columns * rows) as usize], cell, columns };
        // Three colours may come from three things.
        let things = if estimator.dispersion() == 0.0 { 1.0 } else { 3.0 };
        let share = (things * estimator.aperture.largest_share(estimator.model)) as f32;
        let view = View::new(estimator);
        for (plane, of) in scene.of_kind::<Plane>() {
            grid.raise(of_materials[of.material as usize], |cell| view.sees(plane, cell));
        }
        // Shapes that are no brighter than this cannot raise any cell.
        let least = grid.luminances.iter().copied().fold(f32::INFINITY, f32::min);
        let cover = |bright: &f32| (*bright > least).then(|| Coverage::new([columns, rows], cell));
        let mut coverages: Vec<Option<Coverage>> = of_materials.iter().map(cover).collect();
        let axes = view.frame.world_from_camera;
        for of in scene.shapes.iter().filter(|of| of.shape.is_bounded()) {
            if let Some(coverage) = &mut coverages[of.material as usize] {
                coverage.add(view.area(of.shape.corners(axes).iter(), of.velocity));
            }
        }
        for (bright, coverage) in of_materials.iter().zip(&coverages) {
            for cell in coverage.iter().flat_map(Coverage::covered) {
                grid.luminances[cell] = grid.luminances[cell].max(*bright);
            }
        }
        grid.luminances.iter_mut().for_each(|luminance| *luminance *= share);
        grid
    }

    /// The bound of a pixel.
    pub fn at(&self, [x, y]: [u32; 2]) -> f32 {
        self.luminances[(y / self.cell * self.columns + x / self.cell) as usize]
    }

    /// Raises the bound to at least `bright` in the cells for which `sees` is true.
    fn raise(&mut self, bright: f32, sees: impl Fn(Area) -> bool) {
        let edge = f64::from(self.cell);
        for (luminance, index) in self.luminances.iter_mut().zip(0..) {
            let from = edge * DVec2::new(f64::from(index % self.columns), f64::from(index / self.columns));
            if bright > *luminance && sees(Area { from, to: from + edge }) {
                *luminance = bright;
            }
        }
    }
}

fn sky(scene: &Scene) -> DVec3 {
    scene.background.brightest().as_dvec3()
}

/// The highest luminance that each material can show, by its own light or as a mirror of the brightest thing.
fn luminances(estimator: &Estimator) -> Vec<f32> {
    let (scene, max_bounces) = (&*estimator.scene, estimator.max_bounces);
    let light: DVec3 = match estimator.integrator {
        Integrator::Whitted => scene.lights.iter().map(|light| light.radiance.as_dvec3()).sum(),
        // The light of the whole sky. That of lamps comes with every sample.
        Integrator::Path => scene.background.most_irradiance(),
    };
    let own: Vec<DVec3> =
        scene.materials.iter().map(|material| material.brightest(light, scene.ambient.as_dvec3())).collect();
    let mut seen = own.clone();
    let mirrors = scene.materials.iter().any(|material| material.reflectance() != Vec3::ZERO);
    for _ in 0..if mirrors { max_bounces } else { 0 } {
        let most = seen.iter().copied().fold(sky(scene), DVec3::max);
        for ((seen, own), material) in seen.iter_mut().zip(&own).zip(&scene.materials) {
            // Without mirrors this must be zero. Mirrors that amplify make `most` infinite, and zero times infinity
            // is NaN.
            let reflectance = material.reflectance();
            let mirrored = reflectance.as_dvec3() * most;
            *seen = own.max(DVec3::select(reflectance.cmpeq(Vec3::ZERO), DVec3::ZERO, mirrored));
        }
    }
    seen.into_iter().map(|color| luminance(color) as f32).collect()
}

/// A rectangle of the picture, in pixels from its top left corner.
#[derive(Debug, Clone, Copy)]
struct Area {
    from: DVec2,
    to: DVec2,
}

/// Where a lens is in focus.
#[derive(Clone, Copy)]
struct Focus {
    /// `1 / z` on the optical axis.
    inverse_distance: f64,
    /// How it grows with the film point: see [`crate::scene::FocalPlane`].
    slope: DVec2,
}

impl Focus {
    /// The film point whose ray through a point `l` of the lens goes through the point `at`. `None` if there is none because
    /// `at` does not lie before the lens.
    ///
    /// The ray runs along `(q, -1) - l s`, where `s` is `1 / z` at `q`, which is linear in `q`. So the condition that the ray
    /// is parallel to `at - l` is linear in `q` too.
    fn film_point(&self, at: DVec3, l: DVec3) -> Option<DVec2> {
        let way = at - l;
        let (depth, aside) = (-way.z, way.truncate());
        let below = depth * (1.0 - self.slope.dot(l.truncate())) - l.z * self.slope.dot(aside);
        let straight = 1.0 - self.slope.dot(l.truncate()) + l.z * self.inverse_distance;
        let focus = self.inverse_distance * depth + self.slope.dot(aside);
        (below > 0.0 && straight > 0.0).then(|| (straight * aside + focus * l.truncate()) / below)
    }
}

/// The projection of points of the scene onto the film.
struct View {
    frame: Frame,
    eye: DVec3,
    /// The corners of a square around the lens.
    lens: [DVec3; 4],
    /// Where the lens is in focus: for all light, or for each of the three colours.
    focus: Vec<Focus>,
    /// Scales points of the view plane at distance one to pixels, with y down.
    pixels: DVec2,
    /// The pixel that looks along the optical axis.
    film_centre: DVec2,
    /// How far beyond the edge of its start pixel a sample can lie, and half a pixel for rounding.
    margin: f64,
    half_shutter: f64,
}

impl View {
    fn new(estimator: &Estimator) -> Self {
        let camera = Camera::new(estimator);
        let [width, height] = estimator.size.map(f64::from);
        let (plane, shift) = (estimator.focal_plane(), estimator.focused_camera().shift());
        let pixels = DVec2::new(1.0, -1.0) / f64::from(camera.inverse_view_distance);
        let turn = DQuat::from_rotation_arc(DVec3::NEG_Z, plane.lens_axis());
        let radius = f64::from(camera.lens_radius);
        let inverse_distance = f64::from(camera.inverse_focal_distance) - plane.slope.dot(shift);
        let on_film = estimator.focused_camera().film_distance().recip();
        // Light of another colour is bent by so much more: 1 / z + 1 / v grows by this share.
        let of_more = |more: f64| Focus {
            inverse_distance: (1.0 + more) * inverse_distance + more * on_film,
            slope: (1.0 + more) * plane.slope,
        };
        let focus = match estimator.dispersion() {
            0.0 => vec![of_more(0.0)],
            dispersion => DISPERSION.map(|of| of_more(dispersion * f64::from(of))).to_vec(),
        };
        Self {
            frame: estimator.camera.frame(),
            eye: estimator.camera.eye,
            lens: [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
                .map(|(x, y)| turn * (radius * DVec3::new(x, y, 0.0))),
            focus,
            pixels,
            film_centre: 0.5 * DVec2::new(width, height) - shift * pixels,
            margin: 0.5 * f64::from(camera.jitter).max(1.0),
            half_shutter: 0.5 * f64::from(estimator.shutter),
        }
    }

    /// Bounds the picture of a convex shape with these corners.
    ///
    /// From one point of the lens, the picture of the shape lies within those of its corners, because perspective maps
    /// convex shapes to convex ones. For the same reason, the picture of a point from all points of the lens lies within
    /// those from the corners of a square around the lens.
    fn area(&self, corners: impl Iterator<Item = DVec3>, velocity: Vec3) -> Area {
        let way = velocity.as_dvec3();
        let times: &[f64] =
            if velocity == Vec3::ZERO { &[0.0] } else { &[-self.half_shutter, self.half_shutter] };
        let mut area = Area { from: DVec2::INFINITY, to: DVec2::NEG_INFINITY };
        let (mut any_before, mut any_behind) = (false, false);
        let camera_from_world = self.frame.world_from_camera.transpose();
        for corner in corners.flat_map(|corner| times.iter().map(move |time| corner + *time * way)) {
            let at = camera_from_world * (corner - self.eye);
            let of_lens = || self.lens.into_iter();
            for (focus, lens_point) in self.focus.iter().flat_map(|focus| of_lens().map(move |l| (focus, l)))
            {
                let Some(q) = focus.film_point(at, lens_point) else {
                    any_behind = true;
                    continue;
                };
                any_before = true;
                let middle = self.film_centre + q * self.pixels;
                (area.from, area.to) =
                    (area.from.min(middle - self.margin), area.to.max(middle + self.margin));
            }
        }
        if any_before && any_behind {
            // The shape crosses the plane of the lens, so its picture has no bounds.
            return Area { from: DVec2::NEG_INFINITY, to: DVec2::INFINITY };
        }
        area
    }

    /// Whether rays through an area of the film can meet a plane. A ray's distance from the plane at its start, and the
    /// rate at which it approaches the plane, are linear in the point of the film, and in the point of the lens, that it
    /// passes. So it is enough to test the corners of the area and of a square around the lens.
    fn sees(&self, plane: &Plane, area: Area) -> bool {
        let Frame { world_from_camera } = self.frame;
        let normal = world_from_camera.transpose() * plane.normal.as_dvec3().normalize();
        let eye = world_from_camera.transpose() * (plane.point - self.eye);
        let area = [area.from - self.margin, area.to + self.margin];
        let heights = || self.lens.iter().map(|l| normal.dot(eye - *l));
        if heights().any(|height| height >= 0.0) && heights().any(|height| height <= 0.0) {
            return true;
        }
        let of_area = || area.into_iter().flat_map(|x| area.map(|y| DVec2::new(x.x, y.y)));
        let meets = |focus: &Focus, l: DVec3, height: f64| {
            of_area().any(|at| {
                let q = (at - self.film_centre) / self.pixels;
                let direction = q.extend(-1.0) - l * (focus.inverse_distance + focus.slope.dot(q));
                height * normal.dot(direction) >= 0.0
            })
        };
        self.focus
            .iter()
            .any(|focus| self.lens.iter().zip(heights()).any(|(l, height)| meets(focus, *l, height)))
    }
}

/// The cells of the grid that at least one of many rectangles covers. What is stored is the difference between a cell
/// and its predecessors in both directions, so that adding a rectangle of any size takes four additions.
struct Coverage {
    differences: Vec<i32>,
    columns: usize,
    rows: usize,
    cell: u32,
}

impl Coverage {
    fn new([columns, rows]: [u32; 2], cell: u32) -> Self {
        let [columns, rows] = [columns, rows].map(|count| count as usize);
        Self { differences: vec![0; (columns + 1) * (rows + 1)], columns, rows, cell }
    }

    fn add(&mut self, area: Area) {
        let [from, to] = [area.from, area.to].map(|at| (at / f64::from(self.cell)).floor());
        // An overflow can make a NaN, which becomes the picture's edge here.
        let first = |at: f64, most: usize| at.clamp(0.0, most as f64) as usize;
        let [left, top] = [first(from.x, self.columns), first(from.y, self.rows)];
        let [right, bottom] = [first(to.x + 1.0, self.columns), first(to.y + 1.0, self.rows)];
        if left < right && top < bottom {
            for (x, y, by) in [(left, top, 1), (right, top, -1), (left, bottom, -1), (right, bottom, 1)] {
                self.differences[y * (self.columns + 1) + x] += by;
            }
        }
    }

    /// The indices of the covered cells.
    fn covered(&self) -> Vec<usize> {
        let mut above = vec![0; self.columns];
        let mut cells = Vec::new();
        for row in 0..self.rows {
            let mut sum = 0;
            for (column, above) in above.iter_mut().enumerate() {
                sum += self.differences[row * (self.columns + 1) + column];
                *above += sum;
                if *above > 0 {
                    cells.push(row * self.columns + column);
                }
            }
        }
        cells
    }
}
