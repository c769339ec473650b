//! The part of the panel for the lens, the ideal pinhole or the hole.

use super::widgets::{Layout, note_item, tooltip};
use crate::app::guide::Guide;
use crate::app::panel::Panel;
use crate::app::theme::{self, ICON_GAP};
use crate::app::words::length;
use crate::scene::{CameraModel, FOCAL_DISTANCES};
use crate::settings::Part;
use imgui::Ui;
use std::mem::discriminant;

/// The f-numbers of the third stops, as they are engraved on lenses. Every third one is a full stop and has a button.
const THIRD_STOPS: [(f64, &str); 31] = [
    (1.0, "f/1"),
    (1.1, "f/1.1"),
    (1.2, "f/1.2"),
    (1.4, "f/1.4"),
    (1.6, "f/1.6"),
    (1.8, "f/1.8"),
    (2.0, "f/2"),
    (2.2, "f/2.2"),
    (2.5, "f/2.5"),
    (2.8, "f/2.8"),
    (3.2, "f/3.2"),
    (3.5, "f/3.5"),
    (4.0, "f/4"),
    (4.5, "f/4.5"),
    (5.0, "f/5"),
    (5.6, "f/5.6"),
    (6.3, "f/6.3"),
    (7.1, "f/7.1"),
    (8.0, "f/8"),
    (9.0, "f/9"),
    (10.0, "f/10"),
    (11.0, "f/11"),
    (13.0, "f/13"),
    (14.0, "f/14"),
    (16.0, "f/16"),
    (18.0, "f/18"),
    (20.0, "f/20"),
    (22.0, "f/22"),
    (25.0, "f/25"),
    (29.0, "f/29"),
    (32.0, "f/32"),
];
const STOPS_PER_ROW: usize = 6;
/// Two f-numbers that differ by less than this share are the same stop.
const SAME_STOP: f64 = 1e-3;

impl Panel {
    /// Draws the list of camera models, the sensor, the focal length, the f-number with its stops, and what follows.
    pub(super) fn lens(&mut self, ui: &Ui, layout: &mut Layout) {
        self.rows(ui, Part::Camera, layout);
        self.rows(ui, Part::Lens, layout);
        let camera = &self.settings.estimator.camera;
        ui.text(format!("35 mm equivalent: {:.0} mm", camera.focal_length_35mm()));
        tooltip(ui, "The focal length that gives the same field of view on full frame, 36 x 24 mm.");
        if self.settings.estimator.model != CameraModel::ThinLens {
            return;
        }
        let before = self.settings.estimator.lens.diameter;
        self.stops(ui, layout);
        if self.settings.estimator.lens.diameter.to_bits() != before.to_bits() {
            self.zoom_lock.keeps_f_number = true;
        }
        ui.checkbox("Keep the f-number", &mut self.zoom_lock.keeps_f_number);
        note_item(ui, "Keep the f-number", layout);
        tooltip(
            ui,
            "On: zooming and another sensor keep the f-number, as the zoom lenses of photographers do. Off: the lens keeps its diameter. It follows which of the two you set last.",
        );
        let hyperfocal = self.settings.hyperfocal_distance();
        ui.disabled(hyperfocal <= 0.0, || {
            if ui.button("Hyperfocal") {
                self.settings.estimator.lens.focal_distance = at_or_beyond(hyperfocal);
            }
        });
        note_item(ui, "Hyperfocal", layout);
        tooltip(
            ui,
            "Focuses at the hyperfocal distance: everything is sharp from half this distance to the horizon.",
        );
        ui.same_line();
        ui.text(format!("at {}", length(hyperfocal)));
    }

    /// Draws a button for each full stop, and two that go on by a third of a stop.
    fn stops(&mut self, ui: &Ui, layout: &mut Layout) {
        let estimator = &mut self.settings.estimator;
        let now = estimator.f_number();
        let width = (ui.content_region_avail()[0] + ICON_GAP) / STOPS_PER_ROW as f32 - ICON_GAP;
        let _table = theme::table(ui);
        for (i, (stop, name)) in THIRD_STOPS.into_iter().step_by(3).enumerate() {
            if i % STOPS_PER_ROW != 0 {
                ui.same_line();
            }
            let _on = ((now / stop - 1.0).abs() < SAME_STOP).then(|| theme::on(ui));
            if ui.button_with_size(name, [width, 0.0]) {
                estimator.set_f_number(stop);
            }
            note_item(ui, name, layout);
            tooltip(ui, "Sets this f-number. Each full stop lets in half the light of the one before.");
        }
        let stops = THIRD_STOPS.map(|(stop, _)| stop);
        let wider = stops.into_iter().rev().find(|stop| *stop < now * (1.0 - SAME_STOP));
        let narrower = stops.into_iter().find(|stop| *stop > now * (1.0 + SAME_STOP));
        let half = 0.5 * (ui.content_region_avail()[0] - ICON_GAP);
        for (name, help, next) in [
            ("1/3 stop wider", "Lets in a quarter more light: the next wider stop.", wider),
            ("1/3 stop narrower", "Lets in a fifth less light: the next narrower stop.", narrower),
        ] {
            ui.disabled(next.is_none(), || {
                if ui.button_with_size(name, [half, 0.0])
                    && let Some(stop) = next
                {
                    estimator.set_f_number(stop);
                }
            });
            note_item(ui, name, layout);
            tooltip(ui, help);
            ui.same_line();
        }
        ui.new_line();
        for (name, guide, help) in [
            (
                "Sharp and blurred",
                Guide::blur(),
                "Chooses the focal plane and the f-number for you: click what should be sharp, and then what should be blurred over so many pixels.",
            ),
            (
                "Sharp range",
                Guide::range(),
                "Chooses the focal plane and the f-number for you: click the nearest and the farthest thing that should be sharp.",
            ),
        ] {
            let same = |now: &Guide| discriminant(now) == discriminant(&guide);
            let is_on = self.guide.as_ref().is_some_and(same);
            let on = is_on.then(|| theme::on(ui));
            if ui.button_with_size(name, [half, 0.0]) {
                self.guide = (!is_on).then_some(guide);
            }
            drop(on);
            note_item(ui, name, layout);
            tooltip(ui, help);
            ui.same_line();
        }
        ui.new_line();
    }
}

/// The nearest f32 that is not nearer than this distance, within the range of focal distances.
fn at_or_beyond(distance: f64) -> f32 {
    let rounded = distance as f32;
    let beyond = if f64::from(rounded) < distance { rounded.next_up() } else { rounded };
    beyond.clamp(FOCAL_DISTANCES[0], FOCAL_DISTANCES[1])
}
