//! What rough surfaces reflect in all directions together: the table of `examples/facet_albedo.rs`.

/// The corners of each cell of the first table: two of a row of nodes, and two of the next. A corner has two numbers of 16
/// bits. At the end of each row of cells are the means over all directions. Then comes the table of glass.
const TABLE: &[u8] = include_bytes!("../../../shaders/facet_albedo.bin");
const COLUMNS: usize = 64;
const ROWS: usize = 32;

/// The share of light that leaves a rough surface after one reflection.
#[derive(Debug, Clone, Copy)]
pub(super) struct Albedo {
    /// If its facets reflect everything.
    pub(super) all: f64,
    /// If its facets reflect the share `(1 - cos)^5`.
    pub(super) grazing: f64,
}

impl Albedo {
    /// That of light from a direction with this cosine, or of light from everywhere.
    pub(super) fn new(cosine: Option<f64>, roughness: f32) -> Self {
        let roughness = f64::from(roughness);
        if roughness < 0.03 {
            // The mean is the integral of 2 c (1 - c)^5.
            let grazing = cosine.map_or(1.0 / 21.0, |cosine| (1.0 - cosine).max(0.0).powi(5));
            return Self { all: 1.0, grazing };
        }
        let row = (roughness * (ROWS - 1) as f64).min((ROWS - 1) as f64);
        let column = cosine.map_or((COLUMNS - 1) as f64, |cosine| cosine.sqrt() * (COLUMNS - 1) as f64);
        let cell = |place: f64, nodes: usize| (place as usize).min(nodes - 2);
        let (up, left) =
            (cell(row, ROWS), if cosine.is_some() { cell(column, COLUMNS) } else { COLUMNS - 1 });
        let weights = [(row - up as f64).clamp(0.0, 1.0), (column - left as f64).clamp(0.0, 1.0)];
        let number = |corner: usize, part: usize| {
            let at = 16 * (up * COLUMNS + left) + 4 * corner + 2 * part;
            f64::from(u16::from_le_bytes([TABLE[at], TABLE[at + 1]])) / 65535.0
        };
        let value = |part: usize| {
            let weight = |corner: usize| {
                let share = |weight: f64, far: bool| if far { weight } else { 1.0 - weight };
                share(weights[0], corner >= 2) * share(weights[1], corner % 2 == 1)
            };
            (0..4).map(|corner| weight(corner) * number(corner, part)).sum()
        };
        Self { all: value(0), grazing: value(1) }
    }

    /// The share of light that leaves rough glass after one reflection or refraction. `ratio` is the refractive index beyond
    /// the surface, relative to that on this side. The second table has the eight corners of each cell.
    pub(super) fn of_glass(cosine: f64, roughness: f32, ratio: f64) -> f64 {
        const CELLS: usize = 16;
        // The index 4 is at the end, 1 in the middle, and 1/4 at the beginning.
        let root = ((ratio - 1.0) / (ratio + 1.0) / 0.6).clamp(-1.0, 1.0);
        let axes = [cosine.sqrt(), f64::from(roughness), 0.5 + 0.5 * root.signum() * root.abs().sqrt()];
        let axes = axes.map(|place| CELLS as f64 * place);
        let cell = axes.map(|place| (place as usize).min(CELLS - 1));
        let texel = COLUMNS * (ROWS - 1) + cell.into_iter().fold(0, |at, cell| at * CELLS + cell);
        let corner = |corner: usize| {
            let at = 16 * texel + 2 * corner;
            let share = f64::from(u16::from_le_bytes([TABLE[at], TABLE[at + 1]])) / 65535.0;
            let weight = |axis: usize| {
                let far = axes[axis] - cell[axis] as f64;
                if corner & (4 >> axis) == 0 { 1.0 - far } else { far }
            };
            share * weight(0) * weight(1) * weight(2)
        };
        (0..8).map(corner).sum()
    }

    /// The share that facets of this reflectance do not reflect at once.
    pub(super) fn unreflected(self, reflectance: f64) -> f64 {
        1.0 - reflectance * self.all - (1.0 - reflectance) * self.grazing
    }
}
