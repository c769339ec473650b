//! The film, by the formula of the running mean.

use glam::DVec3;

/// Mean r, g, b and count of each pixel.
pub struct Film {
    size: [u32; 2],
    texels: Vec<[f64; 4]>,
    /// The number of samples that were not finite.
    pub rejected: u64,
}

impl Film {
    /// An empty film.
    pub fn new(size: [u32; 2]) -> Self {
        let pixels = size[0] as usize * size[1] as usize;
        Self { size, texels: vec![[0.0; 4]; pixels], rejected: 0 }
    }

    /// Averages a sample into the pixel it lands in: `mean = (sample + count * mean) / (count + 1)`.
    /// A sample that lands outside the film is lost.
    pub fn add(&mut self, start: [u32; 2], offset: [f64; 2], sample: DVec3) {
        if !sample.is_finite() {
            self.rejected += 1;
            return;
        }
        let landing = [0, 1].map(|axis| i64::from(start[axis]) + (offset[axis] + 0.5).floor() as i64);
        let inside = (0..2).all(|axis| (0..i64::from(self.size[axis])).contains(&landing[axis]));
        if let (true, [Ok(x), Ok(y)]) = (inside, landing.map(usize::try_from)) {
            let texel = &mut self.texels[y * self.size[0] as usize + x];
            let count = texel[3];
            for (mean, value) in texel.iter_mut().zip(sample.to_array()) {
                *mean = (value + count * *mean) / (count + 1.0);
            }
            texel[3] = count + 1.0;
        }
    }

    /// The means and counts, row by row from the top left.
    pub fn texels(&self) -> &[[f64; 4]] {
        &self.texels
    }
}
