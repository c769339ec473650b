//! Lenses that are chosen by how sharp the picture should be at two depths.

use super::{Camera, DIAMETERS, FOCAL_DISTANCES, Lens};

/// Depths that differ by less than this, relative to their size, are the same.
const SAME: f64 = 1e-4;
/// A far point, whose blur is that of a point at infinity.
const FAR: f64 = 1e15;
/// The f-number of the widest lens that is possible in air: its light comes from all sides of a half space.
const WIDEST: f64 = 0.5;

impl Camera {
    /// The lens that is focused at the depth `sharp` and spreads a point at the depth `blurred` over so many pixels of
    /// a picture of this height: `F` is the first depth `s`, and `D = c z s / (k |z - s|)`. The second depth can be
    /// infinite.
    ///
    /// # Errors
    /// The reason why no lens does this.
    pub fn lens_for_blur(&self, sharp: f64, blurred: f64, pixels: f64, height: u32) -> Result<Lens, String> {
        apart(sharp, blurred).map_err(|depth| {
            format!("both places are {depth} away, so a lens blurs both or neither; choose places at different depths")
        })?;
        self.lens_at(sharp, blurred, pixels, height)
    }

    /// The lens that blurs points at both depths over `tolerance` pixels, and all points between them less:
    /// `F = 2 a b / (a + b)`, with the diameter for that tolerance. One depth can be infinite.
    ///
    /// # Errors
    /// The reason why no lens does this.
    pub fn lens_for_range(&self, a: f64, b: f64, tolerance: f64, height: u32) -> Result<Lens, String> {
        apart(a, b).map_err(|depth| {
            format!("both places are {depth} away, so every lens that is focused there does; choose places at different depths")
        })?;
        let focal_distance = 2.0 / (a.recip() + b.recip());
        self.lens_at(focal_distance, a.min(b), tolerance, height)
    }

    fn lens_at(&self, focal_distance: f64, depth: f64, pixels: f64, height: u32) -> Result<Lens, String> {
        let focal_distance = focal_distance as f32;
        let within = |value: f32, [low, high]: [f32; 2]| value >= low && value <= high;
        if !within(focal_distance, FOCAL_DISTANCES) {
            return Err("the lens would have to be focused at infinity; choose a place that is nearer".into());
        }
        // The reason reads on after what the user calls the focal distance.
        self.can_focus(&Lens::new(1.0, focal_distance)).map_err(|why| format!("the focal distance {why}"))?;
        let of_one = self.circle_of_confusion(&Lens::new(1.0, focal_distance), depth.min(FAR), height);
        let diameter = (pixels / of_one.abs()) as f32;
        let f_number = self.f_number(diameter);
        if !within(diameter, DIAMETERS) || f_number < WIDEST {
            return Err(format!(
                "this takes f/{f_number:.2}, but no lens is wider than f/{WIDEST}; ask for less blur, or choose places \
                 whose depths differ more"
            ));
        }
        Ok(Lens::new(diameter, focal_distance))
    }
}

/// Checks that two depths are different, and in front of the lens.
fn apart(a: f64, b: f64) -> Result<(), f64> {
    let is_apart = (a.recip() - b.recip()).abs() > SAME * a.recip().max(b.recip());
    if is_apart && a > 0.0 && b > 0.0 { Ok(()) } else { Err(a.max(b)) }
}
