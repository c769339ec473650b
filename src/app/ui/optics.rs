//! The strip below the picture that draws the optics of one pixel.

use super::BACKGROUND;
use super::drawing::paint;
use super::grasp::note_handles;
use super::paper::{Color, FAINT, FRAME, LETTER, Paper, View};
use super::widgets::{Layout, Side, edge, note_item, note_window, tooltip};
use crate::app::area::Area;
use crate::app::panel::{Optics, Shown};
use crate::app::save_as::{absolute, unused_name};
use crate::app::words::length;
use crate::diagram::{self, Diagram, Line, Look};
use crate::error::Result;
use crate::output;
use crate::settings::Estimator;
use glam::DVec3;
use imgui::{Condition, StyleColor, StyleVar, Ui, WindowFlags};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

const GLASS: Color = [0.45, 0.75, 1.0, 1.0];
const FOCUS: Color = [1.0, 0.66, 0.15, 1.0];
const PRIMARY: Color = [1.0, 0.93, 0.55, 0.75];
const LIGHT: Color = [0.45, 0.85, 0.70, 0.80];
const FAINT_LIGHT: Color = [0.45, 0.85, 0.70, 0.30];
const BLUR: Color = [1.0, 0.36, 0.42, 1.0];
const CENTRE: Color = [1.0, 1.0, 1.0, 0.95];

/// The space between the views, in points.
const GAP: f32 = 6.0;
/// The rim of the lens is drawn as a polygon with this many sides.
const RIM_SIDES: u32 = 96;
/// The name of a saved drawing. If there is such a file already, the name gets a number.
const FILE: &str = "lens.svg";
/// The smallest and the largest number of rays.
const RAYS: [u32; 2] = [3, 65];
/// The drawings, each with its name and what it shows.
const DRAWINGS: [(Shown, &str, &str); 3] = [
    (Shown::Side, "From the side", "Film, lens, focal plane and object from the right."),
    (Shown::Above, "From above", "Film, lens, focal plane and object from above."),
    (
        Shown::Book,
        "Letters of the book",
        "Four views to scale, with the letters of Suffern's book: a centre ray goes from the lens through q on the view \
         plane to p on the focal plane, and primary rays go from points of the lens through p. On the film, p' is where \
         the centre ray ends.",
    ),
];

impl Optics {
    /// Draws the strip below the picture, if it is open. Returns the file that the drawing was saved to.
    pub(super) fn draw(
        &mut self,
        ui: &Ui,
        diagram: Option<&Diagram>,
        sharp: Option<[f64; 2]>,
        area: &Area,
        estimator: &mut Estimator,
        layout: &mut Layout,
    ) -> Option<Result<PathBuf>> {
        if !self.open {
            return None;
        }
        let mut saved = None;
        let moved = diagram.zip(self.pin.depth).map(|(diagram, depth)| diagram.with_point_at(depth));
        let diagram = moved.as_ref().or(diagram);
        let ([left, _], [_, top], [_, bottom]) = (area.min(), area.max(), ui.io().display_size);
        let width = area.size()[0];
        let style = (
            ui.push_style_var(StyleVar::WindowRounding(0.0)),
            ui.push_style_var(StyleVar::WindowBorderSize(0.0)),
            ui.push_style_color(StyleColor::WindowBg, BACKGROUND),
        );
        ui.window("##optics")
            .position([left, top], Condition::Always)
            // The strip covers whole pixels, and nothing else paints them.
            .size([width.ceil(), (bottom - top).ceil()], Condition::Always)
            // `background` paints only what the views leave free: a software device is slow to paint an area twice.
            .flags(
                WindowFlags::NO_TITLE_BAR
                    | WindowFlags::NO_MOVE
                    | WindowFlags::NO_RESIZE
                    | WindowFlags::NO_SCROLLBAR
                    | WindowFlags::NO_SCROLL_WITH_MOUSE
                    | WindowFlags::NO_COLLAPSE
                    | WindowFlags::NO_SAVED_SETTINGS
                    | WindowFlags::NO_BACKGROUND
                    | WindowFlags::NO_BRING_TO_FRONT_ON_FOCUS,
            )
            .build(|| {
                note_window(ui, "Drawing of the optics", layout);
                let ([left, top], [width, height]) = (ui.cursor_screen_pos(), ui.content_region_avail());
                let top_of_papers = top + ui.frame_height_with_spacing();
                // Without a drawing, nothing else paints the area of the views.
                let papers = [[left, top_of_papers], [left + width, top + height]];
                background(ui, if diagram.is_some() { papers } else { [papers[0]; 2] });
                self.controls(ui, layout);
                match diagram {
                    Some(diagram) if self.shown == Shown::Book => {
                        ui.same_line();
                        ui.text(legend(diagram));
                        views(ui, diagram);
                    }
                    Some(diagram) => {
                        ui.same_line();
                        let saves = ui.button("Save##drawing");
                        note_item(ui, "Save drawing", layout);
                        tooltip(ui, "Saves the drawing as an SVG file in the current folder.");
                        let look = Look {
                            size: ui.content_region_avail().map(f32::floor),
                            above: self.shown == Shown::Above,
                            to_scale: self.to_scale,
                            sharp,
                            scale: self.held.map(|held| held.scale),
                        };
                        let corner = ui.cursor_screen_pos();
                        let drawing = diagram::draw(diagram, &look);
                        paint(ui, &drawing);
                        self.take_hold(ui, diagram, &drawing, corner, estimator);
                        note_handles(ui, &drawing, corner, layout);
                        if saves {
                            let file = absolute(Path::new(&unused_name(FILE)));
                            saved = Some(output::save_drawing(&drawing, &file).map(|()| file));
                        }
                    }
                    None => ui.text_disabled("waiting for the device ..."),
                }
            });
        drop(style);
        if let Some(place) = edge(ui, "Edge of the drawing", [left, top], Side::Top(width), layout) {
            self.height = (bottom - place).round();
        }
        saved
    }

    fn controls(&mut self, ui: &Ui, layout: &mut Layout) {
        ui.set_next_item_width(80.0);
        ui.slider_config("##rays", RAYS[0], RAYS[1]).display_format("%d rays").build(&mut self.rays);
        note_item(ui, "Rays", layout);
        tooltip(
            ui,
            "The number of rays that are drawn through the lens. Click the picture to choose another pixel.",
        );
        ui.same_line();
        ui.set_next_item_width(150.0);
        let (_, shown, help) =
            DRAWINGS.into_iter().find(|drawing| drawing.0 == self.shown).unwrap_or(DRAWINGS[0]);
        match ui.begin_combo("##drawing", shown) {
            Some(_open) => {
                for (drawing, name, _) in DRAWINGS {
                    if ui.selectable_config(name).selected(drawing == self.shown).build() {
                        self.shown = drawing;
                    }
                    note_item(ui, name, layout);
                }
            }
            // While the list is open, the last item is an entry of it and not the list.
            None => {
                note_item(ui, "Drawing", layout);
                tooltip(ui, help);
            }
        }
        if self.shown != Shown::Book {
            ui.same_line();
            ui.checkbox("To scale", &mut self.to_scale);
            note_item(ui, "To scale", layout);
            tooltip(
                ui,
                "Gives depths and heights the same scale everywhere. Otherwise the side of the film and the heights are \
                 magnified, and the drawing says how much.",
            );
        }
    }
}

/// Draws the four views with the letters of the book.
fn views(ui: &Ui, diagram: &Diagram) {
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
    scene_side(side, View::Side, diagram);
    let above = Paper::new(&list, corner(left, middle[1] + half), corner(middle[0] - half, bottom));
    scene_side(above, View::Top, diagram);
    front(Paper::new(&list, corner(middle[0] + half, top), corner(right, middle[1] - half)), diagram);
    film_side(Paper::new(&list, corner(middle[0] + half, middle[1] + half), corner(right, bottom)), diagram);
    drop(list);
    ui.dummy([width, (height - 1.0).max(0.0)]);
}

/// Draws the view in front of the lens: lens, view plane, focal plane, the centre ray and the fan of primary rays.
fn scene_side(mut paper: Paper<'_>, side: View, diagram: &Diagram) {
    let (fan, axis) = match side {
        View::Side => (&diagram.fan_up, 1),
        View::Top | View::Front => (&diagram.fan_across, 0),
    };
    let (half, half_aperture) = (diagram.half_picture[axis], diagram.half_aperture[axis]);
    let points = [Some(diagram.q), diagram.focus.map(|focus| focus.1), diagram.hit];
    let aside = points.into_iter().flatten().map(|point| side.flat(point)[1]);
    let aside: Vec<f64> = aside.chain([half, -half, half_aperture, -half_aperture]).collect();
    let bounds = [[-0.05 * diagram.reach, diagram.reach], around(&aside)];
    paper.fit(bounds, side);
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
        paper.upright(0.0, [-half_aperture, half_aperture], GLASS, 4.0);
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

/// Paints the background of the strip, except for this rectangle, which the views cover.
fn background(ui: &Ui, [[left, top], [right, bottom]]: [[f32; 2]; 2]) {
    let ([x, y], [width, height]) = (ui.window_pos(), ui.window_size());
    let (end_x, end_y) = (x + width, y + height);
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

/// Draws the view from behind: the lens and the middle of the view plane, with the samples and their rays.
fn front(mut paper: Paper<'_>, diagram: &Diagram) {
    let at_view_plane = |ray: &Line| {
        let [from, to] = *ray;
        from + (to - from) * (diagram.view_plane / (to - from).z.max(1e-9))
    };
    let half = diagram.half_aperture;
    let points = [half, half.map(|extent| -extent), View::Front.flat(diagram.q)];
    let bounds = [0, 1].map(|axis| around(&points.map(|point| point[axis])));
    paper.fit(bounds, View::Front);
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

/// Draws the view behind the lens, from the right: lens and film, the light of the visible point, and its circle of
/// confusion.
fn film_side(mut paper: Paper<'_>, diagram: &Diagram) {
    let image = &diagram.image;
    let v = image.film_distance;
    let [across, half_aperture] = diagram.half_aperture;
    let end = image.light_up.first().map_or(-1.08 * v, |line| line[1].z);
    let aside: Vec<f64> = (image.light_up.iter().flatten())
        .map(|point| point.y)
        .chain([image.p.y, half_aperture, -half_aperture])
        .collect();
    paper.fit([[1.06 * end, 0.10 * v], around(&aside)], View::Side);
    let list = paper.list;
    list.with_clip_rect_intersect(paper.min, paper.max, || {
        paper.line([DVec3::new(0.0, 0.0, -2.0 * v), DVec3::new(0.0, 0.0, v)], FRAME, 1.0);
        paper.tall(-v, FAINT);
        for line in &image.light_up {
            paper.line(*line, LIGHT, 1.0);
        }
        paper.dashed([DVec3::ZERO, image.p], CENTRE);
        paper.upright(0.0, [-half_aperture, half_aperture], GLASS, 4.0);
        paper.dot(image.p, FOCUS, "p'");
        // The chief ray ends in the middle of the circle of confusion, which has the shape of the aperture.
        let half = 0.5 * image.blur * (half_aperture / across.max(half_aperture).max(f64::MIN_POSITIVE));
        paper.upright(-v, [image.p.y - half, image.p.y + half], BLUR, 4.0);
        paper.title("Behind the lens: film and circle of confusion");
        paper.scale_bar();
        paper.foot(-v, "film", FAINT, false);
    });
}

/// The line of text below the drawing.
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

/// The range of these values, with some space on both sides.
fn around(values: &[f64]) -> [f64; 2] {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let room = 0.18 * (high - low).max(1e-12);
    [low - room, high + room]
}
