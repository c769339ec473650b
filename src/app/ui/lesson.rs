//! What is written over the picture for those who are new: the greeting, and the lesson.

use super::widgets::{Layout, button, note_item, note_window};
use crate::app::area::Area;
use crate::app::lesson::{Lesson, STEPS};
use crate::app::over_picture::{Over, Place};
use crate::app::panel::Panel;
use crate::app::theme::{self, FRAME_GAP, FRAME_STROKE, LESSON_WIDTH, ROUNDING};
use imgui::{Key, MouseButton, Ui, WindowHoveredFlags};

const GREETING: [&str; 3] = [
    "Drag the picture to look around. Right-click something to focus on it.",
    "The three sliders are the lens and its rays. H hides everything but the picture.",
    "O draws what the lens does with light. ? lists all that the mouse and the keys do.",
];
const FAREWELL: &str = "That was the lesson. docs/optics.md has the formulas behind it.";

impl Panel {
    /// Draws the greeting or the lesson, if there is one.
    pub(super) fn teach(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) {
        if self.greets {
            self.greeting(ui, area, layout);
        }
        if let Some(lesson) = self.lesson {
            let (next, finished) = self.lesson_step(lesson, ui, area, layout);
            self.lesson = next;
            if finished {
                self.messages.say(FAREWELL.into());
            }
        }
    }

    /// Draws the greeting, which goes when the hand does something else than pressing its button.
    fn greeting(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) {
        let widest = GREETING.map(|line| ui.calc_text_size(line)[0]).into_iter().fold(0.0, f32::max);
        let (mut starts, mut is_over) = (false, false);
        Over::new("##greeting", Place::LowerLeft, [widest, 0.0]).draw(ui, area, || {
            let wrapping = ui.push_text_wrap_pos();
            GREETING.into_iter().for_each(|line| ui.text_wrapped(line));
            drop(wrapping);
            ui.spacing();
            let help = "Six steps that show what a lens does. Each one notices when you have done it.";
            starts = button(ui, "Start the lesson", help, layout);
            is_over = ui.is_window_hovered_with_flags(WindowHoveredFlags::ALLOW_WHEN_BLOCKED_BY_ACTIVE_ITEM);
            note_window(ui, "Greeting", layout);
        });
        let io = ui.io();
        let pressed = [MouseButton::Left, MouseButton::Middle, MouseButton::Right]
            .into_iter()
            .any(|mouse_button| ui.is_mouse_clicked(mouse_button) && !is_over);
        // What follows in imgui's list are the buttons of the mouse.
        let mut keys = Key::VARIANTS.into_iter().take_while(|key| *key != Key::MouseLeft);
        let typed = keys.any(|key| ui.is_key_pressed_no_repeat(key));
        if starts {
            self.lesson = Some(Lesson::new(self.seen()));
        }
        self.greets = !(starts || pressed || typed || io.mouse_wheel != 0.0);
    }

    /// Draws a step of the lesson, and points at the control that it needs. Returns what comes next, and whether the
    /// lesson is finished.
    fn lesson_step(
        &self,
        mut lesson: Lesson,
        ui: &Ui,
        area: &Area,
        layout: &mut Layout,
    ) -> (Option<Lesson>, bool) {
        lesson.check(&self.seen());
        let (step, last) = (lesson.step(), lesson.number() == STEPS.len());
        let (mut goes_on, mut leaves) = (false, false);
        Over::new("##lesson", Place::LowerLeft, [LESSON_WIDTH, 0.0]).draw(ui, area, || {
            let wrapping = ui.push_text_wrap_pos();
            ui.text_colored(theme::ACCENT, format!("{} of {}: {}", lesson.number(), STEPS.len(), step.title));
            ui.text_wrapped(step.text);
            drop(wrapping);
            ui.spacing();
            let name = match (lesson.done, last) {
                (true, true) => "Finish",
                (true, false) => "Next step",
                (false, _) => "Skip step",
            };
            goes_on = ui.button(name);
            note_item(ui, name, layout);
            ui.same_line();
            leaves = ui.button("Leave the lesson");
            note_item(ui, "Leave the lesson", layout);
            if lesson.done {
                ui.same_line();
                ui.align_text_to_frame_padding();
                ui.text_colored(theme::ACCENT, "Done.");
            }
            note_window(ui, "Lesson", layout);
        });
        if !lesson.done {
            self.point_at(ui, step.controls);
        }
        if goes_on { (lesson.next(self.seen()), last) } else { ((!leaves).then_some(lesson), false) }
    }

    /// Frames the first of these controls that was in view in the last frame.
    fn point_at(&self, ui: &Ui, controls: &[&str]) {
        let place = |control: &&str| self.layout.iter().find(|(name, _)| name == control);
        if let Some((_, rectangle)) = controls.iter().find_map(place) {
            let scale = ui.io().display_framebuffer_scale;
            let [left, top, width, height] = rectangle.map(|pixels| pixels as f32);
            let beyond = FRAME_GAP;
            let min = [left / scale[0] - beyond, top / scale[1] - beyond];
            let max = [(left + width) / scale[0] + beyond, (top + height) / scale[1] + beyond];
            let list = ui.get_foreground_draw_list();
            list.add_rect(min, max, theme::ACCENT).rounding(ROUNDING).thickness(FRAME_STROKE).build();
        }
    }
}
