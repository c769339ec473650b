//! What is shown instead of the picture, and its legend.

use super::widgets::{Layout, combo, named, note_item, tooltip};
use super::{LOGARITHMIC, MARGIN, Panel};
use crate::interface::{BEHIND, IN_FRONT, MARK, SLICE};
use crate::scene::Overlay;
use crate::settings::{Settings, TOLERANCES};
use imgui::{Condition, Ui, WindowFlags};

const CHOICES: [(Option<Overlay>, &str, &str); 7] = [
    (None, "Picture", "The picture alone."),
    (
        Some(Overlay::FocusPeaking),
        "Focus peaking",
        "The picture, with all marked that is sharp: blurred over less than the tolerance.",
    ),
    (Some(Overlay::FocalPlane), "Focal plane", "The picture, with what the focal plane cuts marked."),
    (
        Some(Overlay::Blur),
        "Circle of confusion",
        "Over how many pixels a point blurs: blue in front of the focal plane, orange behind it, white where it is sharp.",
    ),
    (Some(Overlay::Depth), "Depth", "The distance along the axis: white at the lens, black far away."),
    (
        Some(Overlay::Count),
        "Sample counts",
        "How many points each pixel has: black for none, white for as many as the slider says.",
    ),
    (
        Some(Overlay::Error),
        "Error",
        "How far off each pixel may still be, as a share of its brightness. Measuring it starts the picture anew.",
    ),
];

/// Colours of a legend from left to right, linear, and what stands below: left, middle, right.
type Scale = (&'static [[f32; 3]], [String; 3]);

const WIDTH: f32 = 260.0;

impl Panel {
    pub(super) fn view(&mut self, ui: &Ui, layout: &mut Layout) {
        let now = self.settings.view.overlay;
        let shown = CHOICES.iter().find(|entry| entry.0 == now).map_or("", |entry| entry.1);
        combo(ui, "Show", shown, "What is shown, instead of the picture or on it.", layout, |layout| {
            for (choice, label, help) in CHOICES {
                if ui.selectable_config(label).selected(choice == now).build() {
                    self.settings.show(choice);
                }
                note_item(ui, label, layout);
                tooltip(ui, help);
            }
        });
        let tolerance = &mut self.settings.view.tolerance;
        named(ui, "Tolerance", "How wide a circle of confusion may be that counts as sharp.", layout, |id| {
            ui.slider_config(id, TOLERANCES[0].max(0.1), 30.0)
                .display_format("%.2f px")
                .flags(LOGARITHMIC)
                .build(tolerance);
        });
    }
}

/// At the lower right.
pub(super) fn legend(ui: &Ui, settings: &Settings) {
    let Some(overlay) = settings.view.overlay else {
        return;
    };
    let [width, height] = ui.io().display_size;
    let name = CHOICES.iter().find(|entry| entry.0 == Some(overlay)).map_or("", |entry| entry.1);
    ui.window("##legend")
        .position([width - MARGIN, height - MARGIN], Condition::Always)
        .position_pivot([1.0, 1.0])
        .size([WIDTH, 0.0], Condition::Always)
        .flags(
            WindowFlags::NO_DECORATION
                | WindowFlags::NO_INPUTS
                | WindowFlags::NO_DOCKING
                | WindowFlags::NO_FOCUS_ON_APPEARING,
        )
        .build(|| {
            ui.text(name);
            let (colors, labels) = scale(settings, overlay);
            bar(ui, colors);
            let [left, middle, right] = &labels;
            let room = ui.content_region_avail()[0];
            ui.text(left);
            for (label, share) in [(middle, 0.5), (right, 1.0)] {
                let [text_width, _] = ui.calc_text_size(label);
                ui.same_line_with_pos(ui.cursor_start_pos()[0] + share * (room - text_width));
                ui.text(label);
            }
        });
}

fn scale(settings: &Settings, overlay: Overlay) -> Scale {
    let full = settings.overlay_scale(overlay);
    let distance = settings.estimator.lens.focal_distance;
    let [none, text] = [String::new, String::new];
    let labels = |left: String, middle: String, right: String| [left, middle, right];
    match overlay {
        Overlay::Count => (&[[0.0; 3], [1.0; 3]], labels("0".into(), none(), format!("{full:.0} points"))),
        Overlay::Error => (
            &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0; 3]],
            labels("0".into(), none(), format!("{:.0}% or more", 100.0 * full)),
        ),
        Overlay::Depth => (
            // Even steps of the share F / (F + depth).
            &[[1.0; 3], [0.75; 3], [0.5; 3], [0.25; 3], [0.0; 3]],
            labels("lens".into(), format!("{distance:.4}"), "far away".into()),
        ),
        Overlay::Blur => (
            &[IN_FRONT, [1.0; 3], BEHIND],
            labels(format!("{full:.0} px in front"), "sharp".into(), format!("behind {full:.0} px")),
        ),
        Overlay::FocusPeaking => {
            (&[MARK; 2], labels(format!("blurred over {full:.2} px at most"), text(), none()))
        }
        Overlay::FocalPlane => (&[SLICE; 2], labels(format!("at a depth of {distance:.4}"), text(), none())),
    }
}

/// A bar that goes evenly from colour to colour, in linear light as the picture does.
fn bar(ui: &Ui, colors: &[[f32; 3]]) {
    let steps = 64;
    let [x, y] = ui.cursor_screen_pos();
    let [width, _] = ui.content_region_avail();
    let list = ui.get_window_draw_list();
    for step in 0..steps {
        let at = (step as f32 + 0.5) / steps as f32 * (colors.len() - 1) as f32;
        let (left, share) = (at as usize, at.fract());
        let linear = [0, 1, 2].map(|c| colors[left][c] + share * (colors[left + 1][c] - colors[left][c]));
        let [from, to] = [step, step + 1].map(|step| x + width * step as f32 / steps as f32);
        list.add_rect([from, y], [to, y + 14.0], linear.map(encoded)).filled(true).build();
    }
    ui.dummy([width, 18.0]);
}

/// The sRGB encoding: IEC 61966-2-1.
fn encoded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}
