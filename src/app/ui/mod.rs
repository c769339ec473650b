//! Draws the panel.

mod aperture;
mod compare;
mod files;
mod lens;
mod message;
mod numbers;
mod optics;
mod overlay;
mod paper;
mod rows;
mod sampling;
mod tolerance;
mod widgets;

use super::diagram::Diagram;
use super::panel::{Panel, builtin};
use super::telemetry;
use crate::renderer::{Picked, Progress};
use crate::scene::CameraModel;
use crate::settings::Part;
use imgui::{Condition, Ui};
use widgets::{Layout, combo, note_item, section, tooltip};

/// The width of the panel, in points.
const PANEL_WIDTH: f32 = 320.0;
/// The space around the panel, in points.
const MARGIN: f32 = 12.0;

/// What the panel shows besides the settings.
pub(super) struct Status<'a> {
    pub(super) progress: Progress,
    pub(super) device: &'a str,
    /// What is under the pointer, while the pointer is over the picture.
    pub(super) picked: Option<&'a Picked>,
    /// The optics of the pixel that was clicked last.
    pub(super) diagram: Option<&'a Diagram>,
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
    /// Write the picture to the file that is named.
    SavePicture,
    /// Write the scene to the file that is named.
    SaveScene,
    /// Put the command that renders the picture into the clipboard.
    CopyCommand,
}

impl Panel {
    /// Draws the panel, and changes the settings as the user does.
    pub(super) fn draw(&mut self, ui: &Ui, status: &Status<'_>) -> Option<Action> {
        let mut layout = Vec::new();
        let mut action = None;
        let [_, height] = ui.io().display_size;
        ui.window("thinlens")
            .position([MARGIN; 2], Condition::FirstUseEver)
            .size([PANEL_WIDTH, 0.0], Condition::Always)
            .size_constraints([PANEL_WIDTH, 0.0], [PANEL_WIDTH, (height - 2.0 * MARGIN).max(64.0)])
            .resizable(false)
            .build(|| {
                self.scene_chooser(ui, &mut layout);
                self.rows(ui, Part::Top, &mut layout);
                self.rows(ui, Part::Points, &mut layout);
                self.progress(ui, status);
                let mut button = |name, asks| {
                    if ui.button(name) {
                        action = Some(asks);
                    }
                };
                button("Autofocus", Action::Autofocus);
                note_item(ui, "Autofocus", &mut layout);
                tooltip(
                    ui,
                    "Focuses on what is in the middle of the picture. To focus on something else, right-click it, or point at it and press F. Ctrl and the wheel move the focal plane.",
                );
                ui.same_line();
                button("Reset", Action::Reset);
                note_item(ui, "Reset", &mut layout);
                tooltip(ui, "Restores the settings that the scene was opened with.");
                ui.same_line();
                ui.checkbox("Optics", &mut self.optics.open);
                note_item(ui, "Optics", &mut layout);
                tooltip(
                    ui,
                    "Draws to scale what the lens does with the light of one pixel. Click the picture to choose the pixel.",
                );
                for (name, asks, help) in [
                    ("Undo", Action::Undo, "Undoes the last change (Ctrl+Z)."),
                    ("Redo", Action::Redo, "Redoes the change that was undone last (Ctrl+Shift+Z)."),
                    ("Compare", Action::Compare, "Holds this picture on the left, so that you see your changes beside it (C). Press again to release it."),
                    (if self.paused { "Go on" } else { "Pause" }, Action::Pause, "Stops rendering; the picture stays as it is (P)."),
                    ("?", Action::Keys, "Lists what the mouse and the keys do (?)."),
                ] {
                    button(name, asks);
                    note_item(ui, name, &mut layout);
                    tooltip(ui, help);
                    ui.same_line();
                }
                ui.new_line();
                section(ui, "Lens", false, &mut layout, |layout| self.lens(ui, layout));
                if self.settings.estimator.model != CameraModel::Pinhole {
                    section(ui, "Aperture shape", false, &mut layout, |layout| self.aperture(ui, layout));
                }
                section(ui, "Viewpoint", false, &mut layout, |layout| {
                    self.rows(ui, Part::Viewpoint, layout);
                    if ui.button("Reset camera") {
                        action = Some(Action::ResetCamera);
                    }
                    note_item(ui, "Reset camera", layout);
                    tooltip(ui, "Restores the position of the camera that the scene was opened with (Home), and nothing else.");
                });
                section(ui, "What is sharp", true, &mut layout, |_| self.numbers(ui, status.picked));
                section(ui, "Light", false, &mut layout, |layout| self.rows(ui, Part::Light, layout));
                section(ui, "Sampling", false, &mut layout, |layout| {
 self.rows(ui, Part::Sampling, layout);
});
                section(ui, "View", false, &mut layout, |layout| self.rows(ui, Part::View, layout));
                section(ui, "Files", false, &mut layout, |layout| {
                    action = self.files(ui, layout).or(action);
                });
                section(ui, "Device", false, &mut layout, |_| sampling::device(ui, status));
            });
        self.divider(ui, &mut layout);
        self.optics.draw(ui, status.diagram, &mut layout);
        overlay::legend(ui, &self.settings);
        self.messages.draw(ui, &mut layout);
        if layout != self.layout {
            for (name, [x, y, width, height]) in &layout {
                log::debug!("{} '{name}' at {x} {y} {width} {height}", telemetry::CONTROL);
            }
            self.layout = layout;
        }
        action
    }

    /// Notes that the picture is held. The line starts in the middle of the area right of the panel.
    pub(super) fn hold(&mut self) {
        let width = self.settings.estimator.size[0] as f32;
        let left = (PANEL_WIDTH + 2.0 * MARGIN) / width;
        self.held = Some(compare::held(self.shown(), if left < 0.8 { 0.5 * (left + 1.0) } else { 0.5 }));
    }

    fn scene_chooser(&mut self, ui: &Ui, layout: &mut Layout) {
        let mut chosen = None;
        let shown = self.settings.estimator.scene.source.clone();
        let help = "The scene: a built-in one, or one that you have opened.";
        combo(ui, "Scene", &shown.to_string_lossy(), help, layout, |layout| {
            for (number, name) in self.scenes.iter().enumerate() {
                // imgui needs an id, because two scenes may be shown by the same name.
                let _id = ui.push_id_usize(number);
                if ui.selectable_config(name.to_string_lossy()).selected(*name == shown).build() {
                    chosen = Some(name.clone());
                }
                if let Some(builtin) = builtin(name) {
                    note_item(ui, builtin, layout);
                }
            }
        });
        if let Some(name) = chosen {
            self.open(&name);
        }
    }

    /// Draws the rows of a part of the panel.
    fn rows(&mut self, ui: &Ui, part: Part, layout: &mut Layout) {
        rows::rows(ui, part, &mut self.settings, &self.initial, layout);
    }
}
