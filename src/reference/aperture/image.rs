//! An image. Points are chosen in proportion to its brightness: first the row, then the column. The longer side of the
//! image goes from -1 to 1.

use crate::scene::Mask;

pub(super) fn point(mask: &Mask, xi: [f64; 2]) -> ([f64; 2], f64) {
    let [columns, rows] = mask.size.map(|cells| cells as usize);
    let row_light = (0..rows)
        .map(|row| mask.cells[row * columns..][..columns].iter().copied().map(f64::from).sum::<f64>());
    let down = place(&row_light.collect::<Vec<_>>(), xi[1]);
    let row = (down as usize).min(rows - 1);
    let light: Vec<f64> = mask.cells[row * columns..][..columns].iter().copied().map(f64::from).collect();
    let across = place(&light, xi[0]);
    let longer = columns.max(rows) as f64;
    let point = [(2.0 * across - columns as f64) / longer, (rows as f64 - 2.0 * down) / longer];
    (point, 1.0)
}

/// The point of a row of cells before which this share of the light lies, in cells from the start of the row.
fn place(light: &[f64], share: f64) -> f64 {
    let mut left = share * light.iter().sum::<f64>();
    for (cell, light) in light.iter().enumerate() {
        if left < *light {
            return cell as f64 + left / light;
        }
        left -= light;
    }
    light.len() as f64
}
