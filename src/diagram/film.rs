//! The picture of the film around a pixel: the circle of confusion on the grid of the pixels.

use super::sheet::{Anchor, LINE, MARGIN, Pane, Point, Role, text_width};
use super::words::{millimetres, pixels};
use super::{Diagram, ImageSide};

/// The circle of confusion takes this share of the picture of the film.
const BLUR_SHARE: f64 = 0.72;
/// At least so many pixels are shown each way.
const MIN_PIXELS: f64 = 5.0;
/// The lines of the grid are at least this far apart.
const MIN_SPACING: f64 = 5.0;

/// Draws the film around the pixel, as the picture shows it: upright. The blur of the other points is an outline.
pub(super) fn draw(diagram: &Diagram, others: &[Diagram], min: Point, max: Point) -> Pane {
    let mut pane = Pane::new(min, max);
    pane.rectangle(pane.min, pane.max, Role::Paper);
    let (left, right) = (pane.min[0] + MARGIN, pane.max[0] - MARGIN);
    let (top, bottom) = (pane.min[1] + MARGIN + LINE, pane.max[1] - 2.0 * LINE - MARGIN);
    let title = [left, pane.min[1] + 0.5 * (MARGIN + LINE)];
    pane.text(title, Anchor::Start, Role::Text, "On the film, magnified".into());
    let image = &diagram.image;
    let half_side = f64::from(0.5 * (right - left).min(bottom - top));
    if half_side < 4.0 {
        return pane;
    }
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    let widest = others.iter().map(|other| other.image.blur_pixels).fold(image.blur_pixels, f64::max);
    let shown = (widest / BLUR_SHARE).max(MIN_PIXELS);
    let scale = 2.0 * half_side / shown;
    // To the right and down, in pixels of the picture.
    let place = |[x, y]: [f64; 2]| [middle[0] + (x * scale) as f32, middle[1] + (y * scale) as f32];
    pane.rectangle(place([-0.5; 2]), place([0.5; 2]), Role::Pixel);
    let mut step = 1.0;
    while step * scale < MIN_SPACING {
        step *= 10.0;
    }
    // The edges of the pixels lie half a pixel beside the middle of this one.
    let first = ((-0.5 * shown - 0.5) / step).ceil();
    let lines = (0..).map(|number| (first + f64::from(number)) * step + 0.5);
    for at in lines.take_while(|at| *at <= 0.5 * shown) {
        let end = 0.5 * shown;
        pane.line(place([at, -end]), place([at, end]), Role::Grid, 1.0);
        pane.line(place([-end, at]), place([end, at]), Role::Grid, 1.0);
    }
    // Where the light through a point of the aperture falls.
    let falls_of =
        |image: &ImageSide, [x, y]: [f64; 2]| place([x * image.blur_radius, -y * image.blur_radius]);
    let falls = |corner: [f64; 2]| falls_of(image, corner);
    let is_image = image.openings.len() > 1;
    for opening in image.openings.iter().filter(|_| diagram.hit.is_some()) {
        let corners: Vec<Point> = opening.corners.iter().map(|corner| falls(*corner)).collect();
        pane.area(corners.clone(), Role::BlurInside(opening.light));
        if !is_image {
            pane.outline(corners, Role::Blur, 2.0);
        }
    }
    for other in others.iter().filter(|other| other.image.openings.len() == 1) {
        let corners = other.image.openings[0].corners.iter().map(|corner| falls_of(&other.image, *corner));
        pane.outline(corners.collect(), other.light_role(false), 1.5);
    }
    if diagram.hit.is_some() {
        pane.dot(place([0.0; 2]), 2.5, Role::Blur);
        let pixels = pixels(image.blur_pixels);
        let size = format!("{pixels} = {}", millimetres(image.blur * diagram.mm_per_unit));
        let names = [format!("circle of confusion: {size}"), size, pixels];
        // The longest one for which there is room.
        if let Some(name) = names.into_iter().find(|name| text_width(name) <= right - left) {
            pane.text([left, bottom + 0.6 * LINE], Anchor::Start, Role::Blur, name);
        }
    }
    let square = match step {
        1.0 => "a square is a pixel".to_owned(),
        step => format!("a square is {step} pixels wide"),
    };
    pane.text([left, bottom + 1.6 * LINE], Anchor::Start, Role::Faint, square);
    pane
}
