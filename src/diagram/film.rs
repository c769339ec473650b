//! The pictures of the film around a pixel: the circle of confusion on the grid of the pixels, and what the renderer shows
//! there.

use super::sheet::{Anchor, LINE, MARGIN, Pane, Point, Role, text_width};
use super::words::{millimetres, pixels};
use super::{Diagram, ImageSide};
use crate::renderer::Excerpt;

/// The circle of confusion takes this share of the picture of the film.
const BLUR_SHARE: f64 = 0.72;
/// At least so many pixels are shown each way.
const MIN_PIXELS: f64 = 5.0;
/// The lines of the grid are at least this far apart.
const MIN_SPACING: f64 = 5.0;
/// The picture is drawn with at most about so many squares each way. If there are more pixels, a square is the mean of some.
const MAX_SQUARES: f64 = 48.0;

/// The pixels of a square part of the film, magnified.
struct Grid {
    middle: Point,
    /// How many pixels are shown each way.
    shown: f64,
    /// The width of a pixel on the sheet.
    scale: f64,
    /// The left and the right end of a line of text.
    ends: [f32; 2],
    /// Where the texts below begin.
    bottom: f32,
}

impl Grid {
    /// Begins a picture of so many pixels each way, with the first of the titles for which there is room. `None` if the
    /// picture would be too small.
    fn begin(pane: &mut Pane, shown: f64, titles: &[&str]) -> Option<Self> {
        pane.rectangle(pane.min, pane.max, Role::Paper);
        let (left, right) = (pane.min[0] + MARGIN, pane.max[0] - MARGIN);
        let (top, bottom) = (pane.min[1] + MARGIN + LINE, pane.max[1] - 2.0 * LINE - MARGIN);
        if let Some(title) = titles.iter().find(|title| text_width(title) <= right - left) {
            let place = [left, pane.min[1] + 0.5 * (MARGIN + LINE)];
            pane.text(place, Anchor::Start, Role::Text, (*title).into());
        }
        let half_side = f64::from(0.5 * (right - left).min(bottom - top));
        (half_side >= 4.0).then(|| Self {
            middle: [0.5 * (left + right), 0.5 * (top + bottom)],
            shown,
            scale: 2.0 * half_side / shown,
            ends: [left, right],
            bottom,
        })
    }

    /// Where a place is drawn that is so many pixels to the right and down from the middle of the pixel in the middle.
    fn place(&self, [x, y]: [f64; 2]) -> Point {
        [self.middle[0] + (x * self.scale) as f32, self.middle[1] + (y * self.scale) as f32]
    }

    /// Writes the first of these texts for which there is room into a line below the picture.
    fn say(&self, pane: &mut Pane, line: f32, role: Role, texts: impl IntoIterator<Item = String>) {
        let [left, right] = self.ends;
        if let Some(text) = texts.into_iter().find(|text| text_width(text) <= right - left) {
            pane.text([left, self.bottom + (line + 0.6) * LINE], Anchor::Start, role, text);
        }
    }
}

/// How many pixels the pictures of the film show each way.
pub(super) fn shown(diagram: &Diagram, others: &[Diagram]) -> f64 {
    let widest = others.iter().map(|other| other.image.blur_pixels).fold(diagram.image.blur_pixels, f64::max);
    (widest / BLUR_SHARE).max(MIN_PIXELS)
}

/// Draws the film around the pixel, as the picture shows it: upright. The blur of the other points is an outline.
pub(super) fn draw(diagram: &Diagram, others: &[Diagram], min: Point, max: Point) -> Pane {
    let mut pane = Pane::new(min, max);
    let titles = ["On the film, magnified", "On the film"];
    let Some(grid) = Grid::begin(&mut pane, shown(diagram, others), &titles) else {
        return pane;
    };
    let image = &diagram.image;
    let Grid { shown, scale, .. } = grid;
    let place = |at| grid.place(at);
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
        grid.say(&mut pane, 0.0, Role::Blur, names);
    }
    let square = match step {
        1.0 => ["a square is a pixel".to_owned(), String::new()],
        step => [format!("a square is {step} pixels wide"), format!("a square: {step} pixels")],
    };
    grid.say(&mut pane, 1.0, Role::Faint, square);
    pane
}

/// Draws what the renderer shows in the same pixels. Also gives the place of the pixel in the middle.
pub(super) fn draw_picture(
    picture: &Excerpt,
    shown: f64,
    min: Point,
    max: Point,
) -> (Pane, Option<[Point; 2]>) {
    let mut pane = Pane::new(min, max);
    let Some(grid) = Grid::begin(&mut pane, shown, &["The picture there", "Picture"]) else {
        return (pane, None);
    };
    let end = 0.5 * shown;
    let step = (shown / MAX_SQUARES).ceil() as i32;
    // The pixel in the middle is in the middle square.
    let first = |square: i32| square * step - step / 2;
    let reach = (end / f64::from(step)).ceil() as i32;
    let edges = |square: i32| {
        let from = f64::from(first(square)) - 0.5;
        [from.max(-end), (from + f64::from(step)).min(end)]
    };
    let squares =
        || (-reach..=reach).map(|square| (square, edges(square))).filter(|(_, [from, to])| from < to);
    for (row, [top, bottom]) in squares() {
        for (column, [left, right]) in squares() {
            let pixels = (0..step).flat_map(|down| (0..step).map(move |right| (right, down)));
            let colors = pixels.filter_map(|(x, y)| picture.pixel(first(column) + x, first(row) + y));
            if let Some(color) = mean(colors) {
                pane.square(grid.place([left, top]), grid.place([right, bottom]), Role::Shown(color));
            }
        }
    }
    let middle = [-0.5, 0.5].map(|at| grid.place([at, at]));
    let [[left, top], [right, bottom]] = middle;
    // It can be seen on every colour.
    for (role, width) in [(Role::Paper, 3.0), (Role::Text, 1.0)] {
        pane.outline(vec![[left, top], [right, top], [right, bottom], [left, bottom]], role, width);
    }
    (pane, Some(middle))
}

fn mean(colors: impl Iterator<Item = [u8; 3]>) -> Option<[u8; 3]> {
    let (mut sums, mut count) = ([0_u32; 3], 0);
    for color in colors {
        (0..3).for_each(|channel| sums[channel] += u32::from(color[channel]));
        count += 1;
    }
    (count > 0).then(|| sums.map(|sum| ((sum + count / 2) / count) as u8))
}
