//! The icons of buttons. They are drawn with lines, so that they are sharp at every scale of the display.

use super::widgets::{Layout, note_item, tooltip};
use crate::app::theme::{self, ICON, STROKE};
use imgui::{DrawListMut, ImColor32, StyleColor, Ui};
use std::f32::consts::FRAC_PI_2;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Icon {
    /// The frame of an autofocus point.
    Point,
    /// A lens that bends two rays.
    Optics,
    Undo,
    Redo,
    /// A picture of two halves.
    Compare,
    Pause,
    GoOn,
    Help,
    Close,
}

/// A button with an icon.
pub(super) struct IconButton {
    pub(super) icon: Icon,
    /// The tests and the lesson find it by this name.
    pub(super) name: &'static str,
    /// What it is called, its key, and what it does.
    pub(super) help: &'static str,
    pub(super) is_on: bool,
    pub(super) can: bool,
}

impl IconButton {
    /// Draws the button. Returns whether it is pressed.
    pub(super) fn draw(&self, ui: &Ui, layout: &mut Layout) -> bool {
        let mut pressed = false;
        let _on = self.is_on.then(|| theme::on(ui));
        ui.disabled(!self.can, || {
            pressed = ui.button_with_size(format!("##{}", self.name), [ICON; 2]);
            let (min, max) = (ui.item_rect_min(), ui.item_rect_max());
            let mut color = ui.style_color(StyleColor::Text);
            color[3] *= theme::opacity(ui);
            let middle = [0, 1].map(|axis| 0.5 * (min[axis] + max[axis]));
            self.icon.paint(ui, middle, color);
        });
        note_item(ui, self.name, layout);
        tooltip(ui, self.help);
        pressed
    }
}

impl Icon {
    /// Paints the icon around this place. It fits into a square of 14 points.
    fn paint(self, ui: &Ui, [x, y]: [f32; 2], color: theme::Color) {
        let list = &ui.get_window_draw_list();
        let color = ImColor32::from(color);
        let at = |[right, down]: [f32; 2]| [x + right, y + down];
        let line = |points: &[[f32; 2]]| {
            let points: Vec<_> = points.iter().map(|point| at(*point)).collect();
            list.add_polyline(points, color).thickness(STROKE).build();
        };
        match self {
            Self::Point => {
                for [right, down] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
                    let corner = |across: f32, along: f32| [right * across, down * along];
                    line(&[corner(2.5, 5.5), corner(6.5, 5.5), corner(6.5, 2.5)]);
                }
                list.add_circle([x, y], 1.8, color).filled(true).build();
            }
            Self::Optics => {
                // Both faces of the lens bulge.
                let face = |side: f32| arc([-1.0 - 5.6 * side, 0.0], 8.2, [-0.82 * side, 0.82 * side], side);
                let lens: Vec<_> = [face(1.0), face(-1.0)].concat().into_iter().map(at).collect();
                list.add_polyline(lens, color).filled(true).build();
                for side in [-1.0, 1.0] {
                    line(&[[-7.5, 3.5 * side], [-3.0, 3.5 * side]]);
                    line(&[[1.5, 3.0 * side], [7.5, 0.0]]);
                }
            }
            Self::Undo => turned_arrow(line, -1.0),
            Self::Redo => turned_arrow(line, 1.0),
            Self::Compare => {
                list.add_rect(at([-6.5, -5.0]), at([0.0, 5.0]), color).filled(true).build();
                list.add_rect(at([-6.5, -5.0]), at([6.5, 5.0]), color).thickness(STROKE).build();
            }
            Self::Pause => {
                for left in [-4.5, 1.5] {
                    list.add_rect(at([left, -5.0]), at([left + 3.0, 5.0]), color).filled(true).build();
                }
            }
            Self::GoOn => {
                list.add_triangle(at([-4.0, -5.5]), at([-4.0, 5.5]), at([5.5, 0.0]), color)
                    .filled(true)
                    .build();
            }
            Self::Help => help(ui, list, [x, y], color),
            Self::Close => {
                line(&[[-3.5, -3.5], [3.5, 3.5]]);
                line(&[[-3.5, 3.5], [3.5, -3.5]]);
            }
        }
    }
}

/// A part of a circle, between two angles that are measured from the right or, on the other side, from the left.
fn arc([x, y]: [f32; 2], radius: f32, [from, to]: [f32; 2], side: f32) -> Vec<[f32; 2]> {
    let steps = 10_u8;
    let angles = (0..=steps).map(|step| from + (to - from) * f32::from(step) / f32::from(steps));
    angles.map(|angle| [x + side * radius * angle.cos(), y + radius * angle.sin()]).collect()
}

/// An arrow that turns back to this side.
fn turned_arrow(line: impl Fn(&[[f32; 2]]), side: f32) {
    let mut way = vec![[6.0 * side, -2.0]];
    way.extend(arc([-2.5 * side, 1.5], 3.5, [-FRAC_PI_2, FRAC_PI_2], -side));
    way.push([2.0 * side, 5.0]);
    line(&way);
    line(&[[2.5 * side, -5.5], [6.0 * side, -2.0], [2.5 * side, 1.5]]);
}

fn help(ui: &Ui, list: &DrawListMut<'_>, [x, y]: [f32; 2], color: ImColor32) {
    let [width, height] = ui.calc_text_size("?");
    list.add_text([x - 0.5 * width, y - 0.5 * height], color, "?");
}
