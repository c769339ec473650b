//! Draws the panel.

mod aperture;
mod compare;
mod drawing;
mod files;
mod grasp;
mod lens;
mod lesson;
mod light;
mod message;
mod numbers;
mod optics;
mod output;
mod overlay;
mod rows;
mod sampling;
mod sensor;
mod tolerance;
mod widgets;

use super::area::Area;
use super::dialog::Purpose;
use super::guide::Guide;
use super::message::Offer;
use super::panel::{Panel, builtin};
use super::telemetry;
use crate::diagram::{Diagram, sharp_depths};
use crate::renderer::{Excerpt, Picked, Progress};
use crate::scene::CameraModel;
use crate::settings::Part;
use imgui::{Condition, StyleColor, StyleVar, Ui, WindowFlags};
use optics::Seen;
use widgets::{
    Folds, LONGEST, Layout, Side, button, combo, edge, from_end, note_item, pressed, section, tick, tooltip,
};

/// The space around what lies over the picture, in points.
const MARGIN: f32 = 12.0;
/// The least height of the sections. In a lower window, the whole panel scrolls.
const MIN_SECTIONS: f32 = 150.0;
const BACKGROUND: [f32; 4] = [0.08, 0.09, 0.11, 1.0];

/// What the panel shows besides the settings.
pub(super) struct Status<'a> {
    pub(super) progress: Progress,
    /// Whether there is a change to undo or to redo.
    pub(super) can_undo: bool,
    pub(super) can_redo: bool,
    pub(super) device: &'a str,
    /// What is under the pointer, while the pointer is over the picture.
    pub(super) picked: Option<&'a Picked>,
    /// The optics of the pixel that was clicked last.
    pub(super) diagram: Option<&'a Diagram>,
    /// The picture around that pixel.
    pub(super) excerpt: Option<&'a Excerpt>,
    /// What another thread is loading, if anything.
    pub(super) loading: Option<String>,
}

/// What a button or a key does beyond changing a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Action {
    /// Focus on what is in the middle of the picture.
    Autofocus,
    /// Restore the settings that the scene was opened with.
    Reset,
    /// Restore the position of the camera that the scene was opened with.
    ResetCamera,
    /// Move the camera until all of the scene is in the picture.
    ViewAll,
    /// Undo the last change.
    Undo,
    /// Redo the change that was undone last.
    Redo,
    /// Hold the picture for comparison, or release it.
    Compare,
    /// Pause rendering, or continue.
    Pause,
    /// Open or close the drawing of the optics.
    Optics,
    /// Show or hide the list of keys.
    Keys,
    /// Begin or leave the lesson.
    Lesson,
    /// Hide everything but the picture, or show it.
    Hide,
    /// Let the user choose a file in a dialog of the system.
    Browse(Purpose),
    /// Write the picture to the file that is named.
    SavePicture,
    /// Write the picture once it has all of its points, or not.
    SaveWhenDone,
    /// Begin to render the picture to the file that is named, in the chosen size.
    Render,
    /// Do what a message offers.
    Accept(Offer),
    /// Write the scene to the file that is named.
    SaveScene,
    /// Put the command that renders the picture into the clipboard.
    CopyCommand,
}

impl Panel {
    /// Draws the panel and what lies over the picture, and changes the settings as the user does.
    /// `room` is the part of the window that is left for the picture, and `area` the picture itself.
    pub(super) fn draw(&mut self, ui: &Ui, status: &Status<'_>, room: &Area, area: &Area) -> Option<Action> {
        let mut layout = Vec::new();
        let mut action = None;
        if !self.hidden {
            let [width, _] = room.min();
            let _style = (
                ui.push_style_var(StyleVar::WindowRounding(0.0)),
                ui.push_style_var(StyleVar::WindowBorderSize(0.0)),
                ui.push_style_color(StyleColor::WindowBg, BACKGROUND),
            );
            ui.window("##panel")
                .position([0.0; 2], Condition::Always)
                // The panel covers whole pixels, and nothing else paints them.
                .size([width.ceil(), ui.io().display_size[1].ceil()], Condition::Always)
                .flags(
                    WindowFlags::NO_TITLE_BAR
                        | WindowFlags::NO_MOVE
                        | WindowFlags::NO_RESIZE
                        | WindowFlags::NO_COLLAPSE
                        | WindowFlags::NO_SAVED_SETTINGS
                        | WindowFlags::NO_BRING_TO_FRONT_ON_FOCUS,
                )
                .build(|| action = self.column_of_controls(ui, status, &mut layout));
            self.edge(ui, room, &mut layout);
        }
        output::paint_around(ui, room, area);
        self.leave_hidden_field();
        self.divider(ui, area, &mut layout);
        if !self.hidden {
            let sharp = sharp_depths(&self.settings);
            let estimator = &mut self.settings.estimator;
            let before = (estimator.camera, estimator.lens);
            let seen = Seen { diagram: status.diagram, excerpt: status.excerpt, sharp };
            let saved = self.optics.draw(ui, seen, room, estimator, &mut layout);
            self.zoom_lock.follow(Part::Top, before, estimator);
            match saved {
                Some(Ok(file)) => self.messages.say(format!("saved {}", file.display())),
                Some(Err(error)) => self.messages.fail(error.to_string()),
                None => {}
            }
            if self.thirds {
                output::thirds(ui, area);
            }
            overlay::legend(ui, &self.settings, area);
            self.teach(ui, area, &mut layout);
        }
        self.guide = self.guide.and_then(|guide| guide.draw(ui, area));
        action = self.messages.draw(ui, area, &mut layout).map(Action::Accept).or(action);
        if layout != self.layout {
            for (name, [x, y, width, height]) in &layout {
                log::debug!("{} '{name}' at {x} {y} {width} {height}", telemetry::CONTROL);
            }
            self.layout = layout;
        }
        action
    }

    /// Draws what stays in view, and below it the sections, which scroll.
    fn column_of_controls(&mut self, ui: &Ui, status: &Status<'_>, layout: &mut Layout) -> Option<Action> {
        let mut folds = std::mem::take(&mut self.folds);
        self.scene_chooser(ui, layout);
        self.main_sliders(ui, layout);
        self.rows(ui, Part::Points, layout);
        self.progress(ui, status);
        let mut action = self.buttons(ui, status, layout);
        section(ui, "What is sharp", true, &mut folds, layout, |_| self.numbers(ui, status.picked));
        let [_, room] = ui.content_region_avail();
        ui.child_window("##sections").size([0.0, room.max(MIN_SECTIONS)]).build(|| {
            action = self.sections(ui, status, &mut folds, layout).or(action);
        });
        self.folds = folds;
        action
    }

    /// Draws the sliders of the lens or the hole. A pinhole has none: those of the lens are greyed, so that nothing moves.
    fn main_sliders(&mut self, ui: &Ui, layout: &mut Layout) {
        if self.settings.estimator.model == CameraModel::Pinhole {
            let (settings, typing) = (self.settings.clone(), self.typing.take());
            self.settings.estimator.model = CameraModel::ThinLens;
            ui.disabled(true, || self.rows(ui, Part::Top, layout));
            // What is grey changes nothing, whatever is clicked there.
            (self.settings, self.typing) = (settings, typing);
        } else {
            self.rows(ui, Part::Top, layout);
        }
    }

    fn buttons(&mut self, ui: &Ui, status: &Status<'_>, layout: &mut Layout) -> Option<Action> {
        let mut action = None;
        // Four buttons fit in a row of the narrowest panel.
        let _spacing = ui.push_style_var(imgui::StyleVar::ItemSpacing([6.0, 8.0]));
        let mut ask = |name, asks, help| {
            if button(ui, name, help, layout) {
                action = Some(asks);
            }
            ui.same_line();
        };
        ask(
            "Autofocus",
            Action::Autofocus,
            "Focuses on what is in the middle of the picture. To focus on something else, right-click it, or point at it and press F. Ctrl and the wheel move the focal plane.",
        );
        ask("Reset", Action::Reset, "Restores the settings that the scene was opened with.");
        let help = "Focuses on what you click next in the picture, as a right click does at once.";
        if button(ui, "Pick focus", help, layout) {
            self.guide = Some(Guide::Focus);
        }
        ui.same_line();
        let help = "Draws what the lens does with the light of one pixel (O). Click the picture to choose the pixel.";
        let is_open = self.optics.open.then(|| pressed(ui));
        if button(ui, "Optics", help, layout) {
            action = Some(Action::Optics);
        }
        drop(is_open);
        for (name, asks, help) in [
            ("Undo", Action::Undo, "Undoes the last change (Ctrl+Z)."),
            ("Redo", Action::Redo, "Redoes the change that was undone last (Ctrl+Shift+Z)."),
            (
                "Compare",
                Action::Compare,
                "Holds this picture on the left, so that you see your changes beside it (C). Press again to release it.",
            ),
            (
                if self.paused { "Go on" } else { "Pause" },
                Action::Pause,
                "Stops rendering; the picture stays as it is (P).",
            ),
            ("?", Action::Keys, "Lists what the mouse and the keys do (?)."),
        ] {
            let (can, is_on) = match asks {
                Action::Undo => (status.can_undo, false),
                Action::Redo => (status.can_redo, false),
                Action::Compare => (true, self.held.is_some()),
                Action::Pause => (true, self.paused),
                _ => (true, self.keys),
            };
            ui.disabled(!can, || {
                let _pressed = is_on.then(|| pressed(ui));
                if ui.button(name) {
                    action = Some(asks);
                }
            });
            note_item(ui, name, layout);
            tooltip(ui, help);
            ui.same_line();
        }
        ui.new_line();
        action
    }

    fn sections(
        &mut self,
        ui: &Ui,
        status: &Status<'_>,
        folds: &mut Folds,
        layout: &mut Layout,
    ) -> Option<Action> {
        let mut action = None;
        section(ui, "Lens", false, folds, layout, |layout| self.lens(ui, layout));
        ui.disabled(self.settings.estimator.model == CameraModel::Pinhole, || {
            section(ui, "Aperture shape", false, folds, layout, |layout| self.aperture(ui, layout));
        });
        if self.settings.estimator.scene.stage().is_some() {
            section(ui, "Model", true, folds, layout, |layout| self.rows(ui, Part::Model, layout));
        }
        section(ui, "Viewpoint", false, folds, layout, |layout| {
            self.rows(ui, Part::Viewpoint, layout);
            tick(
                ui,
                "Focus follows",
                "While the camera moves, the focal plane stays on what you focused on last. Without this, its distance stays as it is.",
                &mut self.follows,
                layout,
            );
            ui.same_line();
            let help = "Restores the position of the camera that the scene was opened with (Home), and nothing else.";
            if button(ui, "Reset camera", help, layout) {
                action = Some(Action::ResetCamera);
            }
        });
        section(ui, "Shift, tilt, colour errors", false, folds, layout, |layout| {
            self.rows(ui, Part::Movements, layout);
        });
        section(ui, "Light", false, folds, layout, |layout| self.light(ui, layout));
        section(ui, "Sampling", false, folds, layout, |layout| self.rows(ui, Part::Sampling, layout));
        section(ui, "View", false, folds, layout, |layout| self.rows(ui, Part::View, layout));
        section(ui, "Output", false, folds, layout, |layout| action = self.output(ui, layout).or(action));
        section(ui, "Files", false, folds, layout, |layout| {
            action = self.files(ui, &status.progress, layout).or(action)
        });
        section(ui, "Device", false, folds, layout, |_| sampling::device(ui, status));
        action
    }

    /// Lets the user drag the right edge of the panel.
    fn edge(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) {
        let ([x, _], [_, height]) = (area.min(), ui.io().display_size);
        if let Some(place) = edge(ui, "Edge of the panel", [x, 0.0], Side::Right(height), layout) {
            self.width = place.round();
        }
    }

    /// Notes that the picture is held. The line starts in the middle.
    pub(super) fn hold(&mut self) {
        self.held = Some(compare::held(self.shown(), 0.5));
    }

    fn scene_chooser(&mut self, ui: &Ui, layout: &mut Layout) {
        let mut chosen = None;
        let shown = self.settings.estimator.scene.source.clone();
        let help = "The scene: a built-in one, or one that you have opened.";
        let room = ui.content_region_avail()[0] - 40.0;
        let preview = from_end(ui, &shown.to_string_lossy(), room);
        combo(ui, "Scene", &preview, help, layout, |layout| {
            for (number, name) in self.scenes.iter().enumerate() {
                // imgui needs an id, because two scenes may be shown by the same name.
                let _id = ui.push_id_usize(number);
                let label = from_end(ui, &name.to_string_lossy(), LONGEST);
                if ui.selectable_config(label).selected(*name == shown).build() {
                    chosen = Some(name.clone());
                }
                if let Some(builtin) = builtin(name) {
                    note_item(ui, builtin.name, layout);
                    ui.text_disabled(format!("    {}", builtin.about));
                }
            }
        });
        if let Some(name) = chosen {
            self.open(&name);
        }
    }
}
