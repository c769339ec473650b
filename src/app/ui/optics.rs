//! The window that draws the optics of one pixel, to scale.

use super::numbers::length;
use super::widgets::{Layout, note_item, tooltip};
use super::{MARGIN, PANEL_WIDTH};
use crate::app::diagram::{Diagram, Line};
use glam::DVec3;
use imgui::{Condition, DrawListMut, SliderFlags, StyleColor, Ui, WindowFlags};
use std::f64::consts::TAU;

type Color = [f32; 4];

const PAPER: Color = [0.045, 0.05, 0.065, 1.0];
const FRAME: Color = [0.30, 0.33, 0.38, 1.0];
const FAINT: Color = [0.55, 0.58, 0.64, 1.0];
const TEXT: Color = [0.86, 0.88, 0.92, 1.0];
const GLASS: Color = [0.45, 0.75, 1.0, 1.0];
const FOCUS: Color = [1.0, 0.66, 0.15, 1.0];
const PRIMARY: Color = [1.0, 0.93, 0.55, 0.75];
const LIGHT: Color = [0.45, 0.85, 0.70, 0.80];
const FAINT_LIGHT: Color = [0.45, 0.85, 0.70, 0.30];
const BLUR: Color = [1.0, 0.36, 0.42, 1.0];
const CENTRE: Color = [1.0, 1.0, 1.0, 0.95];

/// Lengths of the dashes of the centre ray, and of the gaps, in points.
const DASH: f32 = 5.0;
/// Kept free above and below for words, in points.
const HEAD: f32 = 24.0;
const FOOT: f32 = 18.0;
/// Between the views, in points.
const GAP: f32 = 6.0;
/// Sides of the lens's rim, as drawn.
const RIM_SIDES: u32 = 96;
/// About the width of a letter.
const LETTER: f32 = 8.0;
/// Rays that can be drawn.
const RAYS: [u32; 2] = [3, 65];

/// What the window's own controls say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::app) struct Optics {
    pub(in crate::app) open: bool,
    /// Of each fan, and samples in the front view.
    pub(in crate::app) rays: u32,
    /// How often as high things are drawn in the side and top view, where the lens is too narrow to see.
    pub(in crate::app) stretch: f32,
}

impl Default for Optics {
    fn default() -> Self {
        Self { open: false, rays: 9, stretch: 1.0 }
    }
}

/// Which way one looks at it.
#[derive(Clone, Copy, PartialEq)]
enum View {
    /// From the right: depth to the right, up is up.
    Side,
    /// From above: depth to the right, right is down.
    Top,
    /// From behind the camera.
    Front,
}

impl View {
    fn flat(self, point: DVec3) -> [f64; 2] {
        match self {
            Self::Side => [point.z, point.y],
            Self::Top => [point.z, -point.x],
            Self::Front => [point.x, point.y],
        }
    }
}

impl Optics {
    /// Draws the window, if it is open.
    pub(super) fn draw(&mut self, ui: &Ui, diagram: Option<&Diagram>, layout: &mut Layout) {
        if !self.open {
            return;
        }
        let [width, height] = ui.io().display_size;
        let left = PANEL_WIDTH + 2.0 * MARGIN;
        let size = [(width - left - MARGIN).clamp(200.0, 1100.0), (0.46 * height).max(200.0)];
        let mut open = true;
        ui.window("Optics")
            .position([left, height - size[1] - MARGIN], Condition::FirstUseEver)
            .size(size, Condition::FirstUseEver)
            .opened(&mut open)
            // It has its own: a software device takes its time over what is painted twice.
            .flags(WindowFlags::NO_BACKGROUND)
            .build(|| {
                let ([left, top], [width, height]) = (ui.cursor_screen_pos(), ui.content_region_avail());
                let top_of_papers = top + ui.frame_height_with_spacing();
                // Without a drawing nothing covers it.
                let papers = [[left, top_of_papers], [left + width, top + height]];
                background(ui, if diagram.is_some() { papers } else { [papers[0]; 2] });
                self.controls(ui, layout);
                match diagram {
                    Some(diagram) => {
                        ui.same_line();
                        ui.text(legend(diagram));
                        self.views(ui, diagram);
                    }
                    None => ui.text_disabled("waiting for the device ..."),
                }
            });
        self.open = open;
    }

    fn controls(&mut self, ui: &Ui, layout: &mut Layout) {
        ui.set_next_item_width(110.0);
        ui.slider_config("##rays", RAYS[0], RAYS[1]).display_format("%d rays").build(&mut self.rays);
        note_item(ui, "Rays", layout);
        tooltip(ui, "How many rays are drawn through the lens. Click the picture for another pixel.");
        ui.same_line();
        ui.set_next_item_width(130.0);
        ui.slider_config("##stretch", 1.0, 50.0)
            .display_format(if self.stretch > 1.0 { "%.1fx as high" } else { "to scale" })
            .flags(SliderFlags::LOGARITHMIC | SliderFlags::ALWAYS_CLAMP | SliderFlags::NO_ROUND_TO_FORMAT)
            .build(&mut self.stretch);
        note_item(ui, "Stretch", layout);
        tooltip(
            ui,
            "Draws the side and top view higher than they are, as far as there is room, where the lens is too narrow to see.",
        );
    }

    fn views(&self, ui: &Ui, diagram: &Diagram) {
        let ([left, top], [width, height]) = (ui.cursor_screen_pos(), ui.content_region_avail());
        let middle = [left + (0.6 * width).floor(), top + (0.5 * height).floor()];
        let (right, bottom) = (left + width, top + height);
        let list = ui.get_window_draw_list();
        let half = 0.5 * GAP;
        let color = ui.style_color(StyleColor::WindowBg);
        let gaps = [
            ([middle[0] - half, top], [middle[0] + half, bottom]),
            ([left, middle[1] - half], [right, middle[1] + half]),
        ];
        for (from, to) in gaps {
            list.add_rect(from, to, color).filled(true).build();
        }
        let corner = |x: f32, y: f32| [x, y];
        let side = Paper::new(&list, corner(left, top), corner(middle[0] - half, middle[1] - half));
        self.scene_side(side, View::Side, diagram);
        let above = Paper::new(&list, corner(left, middle[1] + half), corner(middle[0] - half, bottom));
        self.scene_side(above, View::Top, diagram);
        front(Paper::new(&list, corner(middle[0] + half, top), corner(right, middle[1] - half)), diagram);
        film_side(
            Paper::new(&list, corner(middle[0] + half, middle[1] + half), corner(right, bottom)),
            diagram,
        );
        drop(list);
        ui.dummy([width, (height - 1.0).max(0.0)]);
    }

    /// Lens, view plane and focal plane, the centre ray, and the fan of primary rays.
    fn scene_side(&self, mut paper: Paper<'_>, side: View, diagram: &Diagram) {
        let (fan, axis) = match side {
            View::Side => (&diagram.fan_up, 1),
            View::Top | View::Front => (&diagram.fan_across, 0),
        };
        let (half, opening) = (diagram.half_picture[axis], diagram.half_opening[axis]);
        let points = [Some(diagram.q), diagram.focus.map(|focus| focus.1), diagram.hit];
        let aside = points.into_iter().flatten().map(|point| side.flat(point)[1]);
        let aside: Vec<f64> = aside.chain([half, -half, opening, -opening]).collect();
        let bounds = [[-0.05 * diagram.reach, diagram.reach], around(&aside)];
        paper.fit(bounds, f64::from(self.stretch), side);
        let list = paper.list;
        list.with_clip_rect_intersect(paper.min, paper.max, || {
            let axis = [DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0 * diagram.reach)];
            paper.line(axis, FRAME, 1.0);
            paper.upright(diagram.view_plane, [-half, half], FAINT, 1.5);
            for ray in fan {
                paper.line(*ray, PRIMARY, 1.0);
            }
            if let Some(hit) = diagram.hit {
                for ray in fan {
                    paper.line([hit, ray[0]], FAINT_LIGHT, 1.0);
                }
            }
            paper.dashed(diagram.centre, CENTRE);
            if let Some((depth, _)) = diagram.focus {
                paper.tall(depth, FOCUS);
            }
            paper.upright(0.0, [-opening, opening], GLASS, 4.0);
            paper.dot(diagram.q, FAINT, "q");
            if let Some(hit) = diagram.hit {
                paper.dot(hit, LIGHT, "hit");
            }
            if let Some((_, p)) = diagram.focus {
                paper.dot(p, FOCUS, "p");
            }
            paper.title(if side == View::Side { "Side" } else { "Top" });
            paper.scale_bar();
            let label = "view plane";
            let room = LETTER * (label.len() + 1) as f32;
            let at = |depth: f64| paper.place(DVec3::new(0.0, 0.0, depth))[0];
            let next = diagram.focus.as_ref().map_or(f32::INFINITY, |(depth, _)| at(*depth));
            paper.foot(diagram.view_plane, label, FAINT, next - at(diagram.view_plane) < room);
            if let Some((depth, _)) = diagram.focus {
                paper.foot(depth, "focal plane", FOCUS, false);
            }
        });
    }
}

/// Paints the window but for its title and for this rectangle, which the papers cover.
fn background(ui: &Ui, [[left, top], [right, bottom]]: [[f32; 2]; 2]) {
    let ([x, y], [width, height]) = (ui.window_pos(), ui.window_size());
    let (y, end_x, end_y) = (y + ui.frame_height(), x + width, y + height);
    let color = ui.style_color(StyleColor::WindowBg);
    let list = ui.get_window_draw_list();
    list.with_clip_rect([x, y], [end_x, end_y], || {
        for (from, to) in [
            ([x, y], [end_x, top]),
            ([x, top], [left, bottom]),
            ([right, top], [end_x, bottom]),
            ([x, bottom], [end_x, end_y]),
        ] {
            list.add_rect(from, to, color).filled(true).build();
        }
    });
}

/// The lens and the view plane's middle from behind: the samples, and where their rays go.
fn front(mut paper: Paper<'_>, diagram: &Diagram) {
    let at_view_plane = |ray: &Line| {
        let [from, to] = *ray;
        from + (to - from) * (diagram.view_plane / (to - from).z.max(1e-9))
    };
    let half = diagram.half_opening;
    let points = [half, half.map(|extent| -extent), View::Front.flat(diagram.q)];
    let bounds = [0, 1].map(|axis| around(&points.map(|point| point[axis])));
    paper.fit(bounds, 1.0, View::Front);
    let list = paper.list;
    list.with_clip_rect_intersect(paper.min, paper.max, || {
        let [x, y] = diagram.half_picture;
        let corners = [[-x, y], [x, y], [x, -y], [-x, -y], [-x, y]];
        for pair in corners.windows(2) {
            let ends = [0, 1].map(|end| DVec3::new(pair[end][0], pair[end][1], 0.0));
            paper.line(ends, FAINT, 1.0);
        }
        let rim: Vec<[f32; 2]> = (0..=RIM_SIDES)
            .map(|i| {
                let (y, x) = (TAU * f64::from(i) / f64::from(RIM_SIDES)).sin_cos();
                paper.place(DVec3::new(half[0] * x, half[1] * y, 0.0))
            })
            .collect();
        list.add_polyline(rim.clone(), [GLASS[0], GLASS[1], GLASS[2], 0.16]).filled(true).build();
        list.add_polyline(rim, GLASS).thickness(1.5).build();
        for ray in &diagram.samples {
            paper.line([ray[0], at_view_plane(ray)], [PRIMARY[0], PRIMARY[1], PRIMARY[2], 0.30], 1.0);
        }
        for ray in &diagram.samples {
            list.add_circle(paper.place(ray[0]), 2.0, PRIMARY).filled(true).build();
        }
        if let Some(ray) = diagram.samples.first() {
            paper.line([ray[0], at_view_plane(ray)], PRIMARY, 2.0);
        }
        paper.dashed([DVec3::ZERO, diagram.q], CENTRE);
        paper.dot(diagram.q, FAINT, "q");
        paper.title("Front: lens and view plane");
        paper.scale_bar();
    });
}

/// Lens and film, the light of what is seen, and its circle of confusion; from the right.
fn film_side(mut paper: Paper<'_>, diagram: &Diagram) {
    let image = &diagram.image;
    let v = image.film_distance;
    let [across, opening] = diagram.half_opening;
    let end = image.light_up.first().map_or(-1.08 * v, |line| line[1].z);
    let aside: Vec<f64> = (image.light_up.iter().flatten())
        .map(|point| point.y)
        .chain([image.p.y, opening, -opening])
        .collect();
    paper.fit([[1.06 * end, 0.10 * v], around(&aside)], 1.0, View::Side);
    let list = paper.list;
    list.with_clip_rect_intersect(paper.min, paper.max, || {
        paper.line([DVec3::new(0.0, 0.0, -2.0 * v), DVec3::new(0.0, 0.0, v)], FRAME, 1.0);
        paper.tall(-v, FAINT);
        for line in &image.light_up {
            paper.line(*line, LIGHT, 1.0);
        }
        paper.dashed([DVec3::ZERO, image.p], CENTRE);
        paper.upright(0.0, [-opening, opening], GLASS, 4.0);
        paper.dot(image.p, FOCUS, "p'");
        // The chief ray's end is the middle of the circle, which has the opening's shape.
        let half = 0.5 * image.blur * (opening / across.max(opening).max(f64::MIN_POSITIVE));
        paper.upright(-v, [image.p.y - half, image.p.y + half], BLUR, 4.0);
        paper.title("Behind the lens: film and circle of confusion");
        paper.scale_bar();
        paper.foot(-v, "film", FAINT, false);
    });
}

/// What the drawing says in words.
fn legend(diagram: &Diagram) -> String {
    let blur = format!("circle of confusion {:.2} px", diagram.image.blur_pixels);
    match (&diagram.focus, &diagram.hit) {
        (Some((depth, _)), Some(hit)) => {
            format!("in focus at {}, seen at {}: {blur}", length(*depth), length(hit.z))
        }
        (None, Some(hit)) => format!("seen at {}: {blur}", length(hit.z)),
        (_, None) => "background: nothing to blur".into(),
    }
}

/// The least and the most of them, with some room.
fn around(values: &[f64]) -> [f64; 2] {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let room = 0.18 * (high - low).max(1e-12);
    [low - room, high + room]
}

/// A view: a rectangle of the window, and how the scene lies in it.
struct Paper<'a> {
    list: &'a DrawListMut<'a>,
    min: [f32; 2],
    max: [f32; 2],
    side: View,
    /// Of the scene, in the middle of the rectangle.
    middle: [f64; 2],
    /// Points a scene unit.
    scale: [f64; 2],
}

impl<'a> Paper<'a> {
    fn new(list: &'a DrawListMut<'a>, min: [f32; 2], max: [f32; 2]) -> Self {
        let max = [max[0].max(min[0] + 1.0), max[1].max(min[1] + 1.0)];
        list.add_rect(min, max, PAPER).filled(true).rounding(3.0).build();
        list.add_rect(min, max, FRAME).rounding(3.0).build();
        Self { list, min, max, side: View::Side, middle: [0.0; 2], scale: [1.0; 2] }
    }

    /// Puts these bounds into the rectangle, as large as they go, and stretched as far as there is room.
    fn fit(&mut self, bounds: [[f64; 2]; 2], stretch: f64, side: View) {
        let [width, height] = [0, 1].map(|axis| self.max[axis] - self.min[axis]);
        let room = [width, (height - HEAD - FOOT).max(1.0)].map(f64::from);
        let extent = bounds.map(|[low, high]| high - low);
        let widest = room[1] / extent[1].max(1e-12);
        let scale = (room[0] / extent[0]).min(widest);
        self.side = side;
        self.middle = bounds.map(|[low, high]| 0.5 * (low + high));
        self.scale = [scale, (scale * stretch).min(widest)];
    }

    fn place(&self, point: DVec3) -> [f32; 2] {
        let flat = self.side.flat(point);
        let across = 0.5 * f64::from(self.min[0] + self.max[0]);
        [(across + (flat[0] - self.middle[0]) * self.scale[0]) as f32, self.height(flat[1])]
    }

    /// Where something at this distance above the axis is drawn.
    fn height(&self, aside: f64) -> f32 {
        let middle = 0.5 * f64::from(self.min[1] + HEAD + self.max[1] - FOOT);
        (middle - (aside - self.middle[1]) * self.scale[1]) as f32
    }

    fn line(&self, [from, to]: Line, color: Color, thickness: f32) {
        self.list.add_line(self.place(from), self.place(to), color).thickness(thickness).build();
    }

    fn dashed(&self, [from, to]: Line, color: Color) {
        let (from, to) = (self.place(from), self.place(to));
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        // What leaves the paper is not seen, and could be dashes without end.
        let visible = length.min((self.max[0] - self.min[0]).hypot(self.max[1] - self.min[1]) * 1.5);
        let at = |along: f32| [from[0] + dx / length * along, from[1] + dy / length * along];
        let mut along = 0.0;
        while along < visible {
            let end = (along + DASH).min(visible);
            self.list.add_line(at(along), at(end), color).thickness(1.5).build();
            along += 2.0 * DASH;
        }
    }

    /// A line across the axis at a depth, between two distances from it.
    fn upright(&self, depth: f64, [low, high]: [f64; 2], color: Color, thickness: f32) {
        let [x, _] = self.place(DVec3::new(0.0, 0.0, depth));
        self.list.add_line([x, self.height(low)], [x, self.height(high)], color).thickness(thickness).build();
    }

    /// Likewise, all over the paper.
    fn tall(&self, depth: f64, color: Color) {
        let [x, _] = self.place(DVec3::new(0.0, 0.0, depth));
        self.list.add_line([x, self.min[1]], [x, self.max[1]], color).thickness(1.5).build();
    }

    fn dot(&self, point: DVec3, color: Color, name: &str) {
        let [x, y] = self.place(point);
        self.list.add_circle([x, y], 3.5, color).filled(true).build();
        let above = if y - 22.0 > self.min[1] + 18.0 { -20.0 } else { 4.0 };
        self.list.add_text([x + 4.0, y + above], color, name);
    }

    fn title(&self, text: &str) {
        self.list.add_text([self.min[0] + 6.0, self.min[1] + 3.0], TEXT, text);
    }

    /// Names what stands at a depth, at the paper's foot, right or left of it.
    fn foot(&self, depth: f64, text: &str, color: Color, left: bool) {
        let [x, _] = self.place(DVec3::new(0.0, 0.0, depth));
        let aside = if left { -5.0 - LETTER * text.len() as f32 } else { 5.0 };
        self.list.add_text([x + aside, self.max[1] - 20.0], color, text);
    }

    /// A round length, at the upper right.
    fn scale_bar(&self) {
        let most = 0.25 * f64::from(self.max[0] - self.min[0]) / self.scale[0];
        let power = 10.0_f64.powf(most.log10().floor());
        let round = [5.0, 2.0, 1.0].into_iter().find(|digit| digit * power <= most).unwrap_or(1.0) * power;
        let (right, y) = (self.max[0] - 8.0, self.min[1] + 24.0);
        let left = right - (round * self.scale[0]) as f32;
        self.list.add_line([left, y], [right, y], FAINT).thickness(2.0).build();
        let text = round.to_string();
        let width = LETTER * text.len() as f32;
        self.list.add_text([right - width, self.min[1] + 4.0], FAINT, text);
    }
}
