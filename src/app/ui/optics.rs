//! The strip below the picture that draws the optics of one pixel.

use super::drawing::paint;
use super::grasp::note_handles;
use super::widgets::{Layout, Side, button, edge, note, note_item, note_window, tooltip};
use crate::app::area::Area;
use crate::app::optics::Optics;
use crate::app::save_as::{absolute, unused_name};
use crate::app::theme::{self, RAYS_WIDTH, VIEWS_WIDTH};
use crate::diagram::{self, Diagram, KEPT, Look, VIEWS};
use crate::error::Result;
use crate::output;
use crate::renderer::Excerpt;
use crate::settings::Estimator;
use imgui::{Condition, Ui, WindowFlags};
use std::path::{Path, PathBuf};

/// The names of saved drawings. If there is such a file already, the name gets a number.
const FILES: [&str; 2] = ["lens.svg", "lens.png"];
/// The smallest and the largest number of rays.
const RAYS: [u32; 2] = [3, 65];
/// What the drawing shows.
pub(super) struct Seen<'a> {
    /// The optics of the pixel.
    pub(super) diagram: Option<&'a Diagram>,
    /// The picture around the pixel.
    pub(super) excerpt: Option<&'a Excerpt>,
    /// The depths between which everything is sharp, for a lens.
    pub(super) sharp: Option<[f64; 2]>,
}

impl Optics {
    /// Draws the strip below the picture, if it is open. Returns the file that the drawing was saved to.
    pub(super) fn draw(
        &mut self,
        ui: &Ui,
        Seen { diagram, excerpt, sharp }: Seen<'_>,
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
        let part = theme::part(ui);
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
                    Some(diagram) => {
                        let mut saves = None;
                        for (label, name, file, help) in [
                            ("Save SVG", "Save drawing", FILES[0], "Saves the drawing as an SVG file in the current folder. It can be enlarged without limit."),
                            ("Save PNG", "Save drawing as PNG", FILES[1], "Saves the drawing as a PNG file in the current folder, in twice as many pixels."),
                        ] {
                            ui.same_line();
                            if ui.button(label) {
                                saves = Some(file);
                            }
                            note_item(ui, name, layout);
                            tooltip(ui, help);
                        }
                        self.keep(ui, diagram, layout);
                        let look = Look {
                            size: ui.content_region_avail().map(f32::floor),
                            view: self.view,
                            to_scale: self.to_scale,
                            sharp,
                            kept: self.kept,
                            picture: excerpt,
                            scale: self.held.map(|held| held.scale),
                        };
                        let corner = ui.cursor_screen_pos();
                        let drawing = diagram::draw(diagram, &look);
                        self.reach = drawing.reach;
                        paint(ui, &drawing);
                        self.take_hold(ui, diagram, &drawing, corner, estimator);
                        note_handles(ui, &drawing, corner, layout);
                        if let Some([min, max]) = drawing.middle_pixel {
                            let at = [0, 1].map(|axis| corner[axis] + min[axis]);
                            note(ui, "Pixel in the drawing", at, [max[0] - min[0], max[1] - min[1]], layout);
                        }
                        if let Some(name) = saves {
                            let file = absolute(Path::new(&unused_name(name)));
                            saved = Some(output::save_drawing(&drawing, &file).map(|()| file));
                        }
                    }
                    None => ui.text_disabled("waiting for the device ..."),
                }
            });
        drop(part);
        if let Some(place) = edge(ui, "Edge of the drawing", [left, top], Side::Top(width), layout) {
            self.height = (bottom - place).round();
        }
        saved
    }

    /// Draws the buttons that keep the light of a point in the section.
    fn keep(&mut self, ui: &Ui, diagram: &Diagram, layout: &mut Layout) {
        if !self.view.is_section() {
            return;
        }
        let free = self.kept.iter_mut().find(|kept| kept.is_none());
        ui.same_line();
        ui.disabled(free.is_none() || diagram.hit.is_none(), || {
            let help = "Keeps the light of this point in the drawing while you choose the next one: blue in front of the focal plane, white in focus, orange behind it. Two can be kept.";
            if button(ui, "Keep", help, layout)
                && let (Some(free), Some(hit)) = (free, diagram.hit)
            {
                *free = Some(hit.z);
            }
        });
        if self.kept.iter().any(Option::is_some) {
            ui.same_line();
            if button(ui, "Forget", "Takes the kept light out of the drawing.", layout) {
                self.kept = [None; KEPT];
            }
        }
    }

    fn controls(&mut self, ui: &Ui, layout: &mut Layout) {
        ui.set_next_item_width(RAYS_WIDTH);
        ui.slider_config("##rays", RAYS[0], RAYS[1]).display_format("%d rays").build(&mut self.rays);
        note_item(ui, "Rays", layout);
        tooltip(
            ui,
            "The number of rays that are drawn through the lens. Click the picture to choose another pixel.",
        );
        ui.same_line();
        ui.set_next_item_width(VIEWS_WIDTH);
        match ui.begin_combo("##drawing", self.view.entry().label) {
            Some(_open) => {
                for entry in &VIEWS {
                    if ui.selectable_config(entry.label).selected(entry.view == self.view).build() {
                        self.view = entry.view;
                    }
                    note_item(ui, entry.label, layout);
                }
            }
            // While the list is open, the last item is an entry of it and not the list.
            None => {
                note_item(ui, "Drawing", layout);
                tooltip(ui, &format!("{}.", self.view.entry().help));
            }
        }
        if self.view.is_section() {
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

/// Paints the background of the strip, except for this rectangle, which the views cover.
fn background(ui: &Ui, [[left, top], [right, bottom]]: [[f32; 2]; 2]) {
    let ([x, y], [width, height]) = (ui.window_pos(), ui.window_size());
    let (end_x, end_y) = (x + width, y + height);
    let list = ui.get_window_draw_list();
    list.with_clip_rect([x, y], [end_x, end_y], || {
        for (from, to) in [
            ([x, y], [end_x, top]),
            ([x, top], [left, bottom]),
            ([right, top], [end_x, bottom]),
            ([x, bottom], [end_x, end_y]),
        ] {
            list.add_rect(from, to, theme::GROUND).filled(true).build();
        }
    });
}
