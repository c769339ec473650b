//! The part of the panel that says what forms the picture: lens, pinhole or hole.

use super::widgets::{Layout, combo, named, note_item, tooltip};
use super::{LOGARITHMIC, Panel};
use crate::scene::{CameraModel, MAX_LENGTH, MIN_LENGTH, PRESETS};
use crate::settings::Estimator;
use imgui::{SliderFlags, Ui};

/// The full stops that have a button.
const STOPS: [(f64, &str); 11] = [
    (1.2, "f/1.2"),
    (1.4, "f/1.4"),
    (2.0, "f/2"),
    (2.8, "f/2.8"),
    (4.0, "f/4"),
    (5.6, "f/5.6"),
    (8.0, "f/8"),
    (11.0, "f/11"),
    (16.0, "f/16"),
    (22.0, "f/22"),
    (32.0, "f/32"),
];
const STOPS_PER_ROW: usize = 6;
/// The f-number slider goes this far.
const F_NUMBERS: [f32; 2] = [0.5, 128.0];

/// The choices, as people know them, and what they do.
const MODELS: [(CameraModel, &str, &str); 3] = [
    (
        CameraModel::ThinLens,
        "Thin lens",
        "Sharp in one plane, and blurred before and behind it: the wider, the more. An ideal lens: real ones also have coloured reflections, which their coatings leave over.",
    ),
    (CameraModel::Pinhole, "Ideal pinhole", "A hole without size: everything is sharp."),
    (
        CameraModel::Hole,
        "Hole, no lens",
        "A box with a hole: upside down, for the light crosses in the hole; sharp through a small one, fuzzy and brighter through a large one.",
    ),
];

impl Panel {
    /// The width of what lets the light in, and the focal plane.
    pub(super) fn aperture_and_focus(&mut self, ui: &Ui, layout: &mut Layout) {
        match self.settings.estimator.model {
            CameraModel::ThinLens => self.lens(ui, layout),
            CameraModel::Pinhole => {}
            CameraModel::Hole => self.hole(ui, layout),
        }
    }

    /// What forms the picture, and the f-number.
    pub(super) fn opening(&mut self, ui: &Ui, layout: &mut Layout) {
        let estimator = &mut self.settings.estimator;
        choose_model(ui, estimator, layout);
        choose_preset(ui, estimator, layout);
        if estimator.model == CameraModel::ThinLens {
            f_number(ui, estimator, layout);
        }
    }

    fn lens(&mut self, ui: &Ui, layout: &mut Layout) {
        let initial = &self.initial.estimator.lens;
        let widest =
            if initial.diameter > 0.0 { 8.0 * initial.diameter } else { 0.1 * initial.focal_distance };
        let nearest = (initial.focal_distance / 20.0).max(MIN_LENGTH);
        let farthest = (initial.focal_distance * 20.0).min(MAX_LENGTH);
        let widest = widest.min(MAX_LENGTH);
        let estimator = &mut self.settings.estimator;
        named(
            ui,
            "Lens diameter",
            "How wide the lens is, in scene units; of an eye, the pupil. A wide one blurs more and needs more points per pixel. 0 is a pinhole: everything is sharp.",
            layout,
            |id| {
                diameter_slider(ui, id, widest, &mut estimator.lens.diameter);
            },
        );
        named(
            ui,
            "Focal plane distance",
            "How far away the plane lies in which everything is sharp, in scene units.",
            layout,
            |id| {
                ui.slider_config(id, nearest, farthest)
                    .display_format("%.4g")
                    .flags(LOGARITHMIC)
                    .build(&mut estimator.lens.focal_distance);
            },
        );
    }

    fn hole(&mut self, ui: &Ui, layout: &mut Layout) {
        let widest = (20.0 * self.initial.estimator.camera.default_hole_diameter()).min(MAX_LENGTH);
        let hole = &mut self.settings.estimator.hole;
        named(
            ui,
            "Hole diameter",
            "How wide the hole is, in scene units. The picture of a far point is as wide.",
            layout,
            |id| {
                diameter_slider(ui, id, widest, &mut hole.diameter);
            },
        );
        ui.checkbox("Upright", &mut hole.upright);
        note_item(ui, "Upright", layout);
        tooltip(ui, "On the film the picture is upside down. This turns it, as you turn a slide.");
    }
}

fn diameter_slider(ui: &Ui, id: String, widest: f32, diameter: &mut f32) {
    ui.slider_config(id, 0.0, widest)
        .display_format("%.4g")
        .flags(SliderFlags::ALWAYS_CLAMP | SliderFlags::NO_ROUND_TO_FORMAT)
        .build(diameter);
}

fn choose_model(ui: &Ui, estimator: &mut Estimator, layout: &mut Layout) {
    let model = &mut estimator.model;
    let shown = MODELS.iter().find(|entry| entry.0 == *model).map_or("", |entry| entry.1);
    combo(ui, "Camera", shown, "What forms the picture.", layout, |layout| {
        for (choice, label, help) in MODELS {
            if ui.selectable_config(label).selected(choice == *model).build() {
                *model = choice;
            }
            note_item(ui, label, layout);
            tooltip(ui, help);
        }
    });
}

fn choose_preset(ui: &Ui, estimator: &mut Estimator, layout: &mut Layout) {
    let help = "Puts a lens that people know in front of the camera. What is in focus stays in focus.";
    combo(ui, "Known lenses", "Known lenses", help, layout, |layout| {
        for preset in &PRESETS {
            if ui.selectable(preset.label) {
                estimator.take_preset(preset);
            }
            note_item(ui, preset.label, layout);
            tooltip(ui, preset.help);
        }
    });
}

fn f_number(ui: &Ui, estimator: &mut Estimator, layout: &mut Layout) {
    // The same value as the diameter: what does not change is left to the bit.
    let mut number = estimator.f_number() as f32;
    let set = |estimator: &mut Estimator, number: f64| {
        estimator.lens.diameter = estimator.camera.diameter_of_f_number(number) as f32;
    };
    named(
        ui,
        "f-number",
        "The lens diameter as photographers give it: the film's distance divided by the diameter. Each stop, a button here, halves the light.",
        layout,
        |id| {
            let [low, high] = F_NUMBERS;
            if ui.slider_config(id, low, high).display_format("f/%.3g").flags(LOGARITHMIC).build(&mut number)
            {
                set(estimator, f64::from(number));
            }
        },
    );
    let width = (ui.content_region_avail()[0] + 4.0) / STOPS_PER_ROW as f32 - 4.0;
    let _spacing = ui.push_style_var(imgui::StyleVar::ItemSpacing([4.0, 4.0]));
    let _padding = ui.push_style_var(imgui::StyleVar::FramePadding([2.0, 3.0]));
    for (i, (stop, name)) in STOPS.into_iter().enumerate() {
        if i % STOPS_PER_ROW != 0 {
            ui.same_line();
        }
        if ui.button_with_size(name, [width, 0.0]) {
            set(estimator, stop);
        }
        note_item(ui, name, layout);
    }
}
