//! Draws the panel.

mod aperture;
mod color;
mod compare;
mod drawing;
mod files;
mod grasp;
mod icons;
mod keys;
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
mod scenes;
mod sensor;
mod tolerance;
mod widgets;

use super::area::Area;
use super::dialog::Purpose;
use super::guide::Guide;
use super::message::Offer;
use super::panel::Panel;
use super::telemetry;
use super::theme::{self, GROUP_GAP, ICON, ICON_GAP, MIN_SECTIONS, SPACING};
use crate::diagram::{Diagram, sharp_depths};
use crate::renderer::{Excerpt, Picked, Progress};
use crate::scene::CameraModel;
use crate::settings::Part;
use icons::{Icon, IconButton};
use imgui::{Condition, TextureId, Ui, WindowFlags};
use optics::Seen;
use widgets::{Folds, Layout, Row, Side, button, edge, section, tick};

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
    /// The thumbnails of the built-in scenes.
    pub(super) thumbnails: Option<TextureId>,
    /// What another thread is loading, if anything.
    pub(super) loading: Option<String>,
}

/// What a button or a key does beyond changing a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Action {
    /// Focus on what is in the middle of the picture.
    Autofocus,
    /// Focus on what is clicked next, or leave that.
    PickFocus,
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

/// A button in the head of the panel, with an icon or with its name.
struct HeadButton {
    asks: Action,
    icon: Option<Icon>,
    name: &'static str,
    help: &'static str,
    is_on: bool,
    can: bool,
}

impl HeadButton {
    fn width(&self, ui: &Ui) -> f32 {
        let padding = 2.0 * ui.clone_style().frame_padding[0];
        self.icon.map_or_else(|| ui.calc_text_size(self.name)[0] + padding, |_| ICON)
    }

    /// Draws the button. Returns whether it is pressed.
    fn draw(&self, ui: &Ui, layout: &mut Layout) -> bool {
        let Self { icon, name, help, is_on, can, .. } = *self;
        match icon {
            Some(icon) => IconButton { icon, name, help, is_on, can }.draw(ui, layout),
            None => button(ui, name, help, layout),
        }
    }
}

impl Panel {
    /// Draws the panel and what lies over the picture, and changes the settings as the user does.
    /// `room` is the part of the window that is left for the picture, and `area` the picture itself.
    pub(super) fn draw(&mut self, ui: &Ui, status: &Status<'_>, room: &Area, area: &Area) -> Option<Action> {
        let mut layout = Vec::new();
        let mut action = None;
        if !self.hidden {
            let [width, _] = room.min();
            let _part = theme::part(ui);
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
        keys::keys(ui, &mut self.keys, [room, &Area::window(ui)], &mut layout);
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
        let mut action = self.scene_and_help(ui, status, layout);
        self.main_sliders(ui, layout);
        self.rows(ui, Part::Points, layout);
        self.progress(ui, status);
        action = self.buttons(ui, status, layout).or(action);
        section(ui, "What is sharp", true, &mut folds, layout, |layout| {
            self.numbers(ui, status.picked);
            self.rows(ui, Part::Sharp, layout);
        });
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

    /// Draws the row of buttons in groups: for focus and light, for changes, and for the picture.
    fn buttons(&self, ui: &Ui, status: &Status<'_>, layout: &mut Layout) -> Option<Action> {
        let usual = |asks, icon, name, help| HeadButton { asks, icon, name, help, is_on: false, can: true };
        let (pause, pauses) = if self.paused { (Icon::GoOn, "Go on") } else { (Icon::Pause, "Pause") };
        let groups = [
            vec![
                usual(
                    Action::Autofocus,
                    None,
                    "Autofocus",
                    "Focuses on what is in the middle of the picture. To focus on something else, right-click it, or point at it and press F. Ctrl and the wheel move the focal plane.",
                ),
                HeadButton {
                    is_on: self.guide == Some(Guide::Focus),
                    ..usual(
                        Action::PickFocus,
                        Some(Icon::Point),
                        "Pick focus",
                        "Pick focus: focuses on what you click next in the picture, as a right click does at once.",
                    )
                },
                HeadButton {
                    is_on: self.optics.open,
                    ..usual(
                        Action::Optics,
                        Some(Icon::Optics),
                        "Optics",
                        "Optics (O): draws what the lens does with the light of one pixel. Click the picture to choose the pixel.",
                    )
                },
            ],
            vec![
                HeadButton {
                    can: status.can_undo,
                    ..usual(
                        Action::Undo,
                        Some(Icon::Undo),
                        "Undo",
                        "Undo (Ctrl+Z): takes back the last change.",
                    )
                },
                HeadButton {
                    can: status.can_redo,
                    ..usual(
                        Action::Redo,
                        Some(Icon::Redo),
                        "Redo",
                        "Redo (Ctrl+Shift+Z): makes the change again that was undone last.",
                    )
                },
                usual(
                    Action::Reset,
                    None,
                    "Reset",
                    "Restores all settings that the scene was opened with, those of the camera too. It can be undone.",
                ),
            ],
            vec![
                HeadButton {
                    is_on: self.held.is_some(),
                    ..usual(
                        Action::Compare,
                        Some(Icon::Compare),
                        "Compare",
                        "Compare (C): holds this picture on the left, so that you see your changes beside it. Press again to release it.",
                    )
                },
                HeadButton {
                    is_on: self.paused,
                    ..usual(
                        Action::Pause,
                        Some(pause),
                        pauses,
                        "Pause (P): stops rendering, and the picture stays as it is. Press again to go on.",
                    )
                },
            ],
        ];
        let mut action = None;
        let mut row = Row::default();
        for group in &groups {
            for (number, button) in group.iter().enumerate() {
                row.next(ui, button.width(ui), if number == 0 { GROUP_GAP } else { ICON_GAP });
                if button.draw(ui, layout) {
                    action = Some(button.asks);
                }
            }
        }
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

    /// Draws the list of scenes, and at its right the button for help.
    fn scene_and_help(&mut self, ui: &Ui, status: &Status<'_>, layout: &mut Layout) -> Option<Action> {
        let width = ui.content_region_avail()[0] - ICON - SPACING[0];
        self.scene_chooser(ui, width, status.thumbnails, layout);
        ui.same_line();
        let help = "Help (?): lists what the mouse and the keys do.";
        let button = IconButton { icon: Icon::Help, name: "Help", help, is_on: self.keys, can: true };
        button.draw(ui, layout).then_some(Action::Keys)
    }
}
