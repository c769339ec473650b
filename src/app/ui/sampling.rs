//! The parts of the panel for the progress of the picture and for the device.

use super::Status;
use super::widgets::tooltip;
use crate::app::panel::Panel;
use crate::app::theme::{self, BAR};
use crate::renderer::Progress;
use imgui::Ui;

impl Panel {
    pub(super) fn progress(&self, ui: &Ui, status: &Status<'_>) {
        let Progress { samples, active_pixels, traced, device_time, .. } = status.progress;
        let target = self.settings.samples;
        let mut text = format!("{samples} / {target} points");
        let [width, height] = self.settings.estimator.size.map(u64::from);
        if let Some(loading) = &status.loading {
            text.clone_from(loading);
        } else if let Some(active) = active_pixels {
            let share = 100.0 * active as f64 / (width * height) as f64;
            text += &format!(", {share:.1}% of the pixels go on");
        } else if self.paused {
            text += ", paused";
        } else if samples < target && traced > 0 {
            let left = u64::from(target - samples) * width * height;
            let seconds = left as f64 * device_time.as_secs_f64() / traced as f64;
            text += &match seconds {
                ..100.0 => format!(", {seconds:.0} s left"),
                ..6000.0 => format!(", {:.0} min left", seconds / 60.0),
                _ => format!(", {:.1} h left", seconds / 3600.0),
            };
        }
        let close = theme::close(ui);
        ui.text(text);
        drop(close);
        tooltip(
            ui,
            "How many points each pixel has of those that it will have. The picture gets less grainy with each of them. Changing the lens or the camera begins anew.",
        );
        let ([x, y], [width, _]) = (ui.cursor_screen_pos(), ui.content_region_avail());
        let share = (samples as f32 / target as f32).min(1.0);
        let list = ui.get_window_draw_list();
        for (part, color) in [(1.0, theme::EDGE), (share, theme::FILLED)] {
            list.add_rect([x, y], [x + part * width, y + BAR], color).filled(true).build();
        }
        drop(list);
        ui.dummy([width, BAR]);
    }
}

pub(super) fn device(ui: &Ui, status: &Status<'_>) {
    let Progress { traced, device_time, rejected_samples, .. } = status.progress;
    ui.text_wrapped(status.device);
    let seconds = device_time.as_secs_f64();
    if seconds > 0.0 {
        ui.text(format!("{:.1} M samples per second", traced as f64 / seconds / 1e6));
    } else {
        ui.text("measuring ...");
    }
    if rejected_samples > 0 {
        ui.text_wrapped(format!("{rejected_samples} samples were not finite and are left out"));
    }
}
