//! The panel.

use crate::error::Error;
use crate::renderer::Progress;
use crate::scene::{self, BUILTINS, MAX_LENGTH, MIN_LENGTH, SceneRef};
use crate::settings::{DEFAULT_JITTER, Overlay, Settings};
use imgui::{Condition, SliderFlags, Ui};

/// The points slider goes this far, or as far as was asked for.
const MAX_POINTS: u32 = 4096;

/// What the panel edits, and what it has to know for it.
pub(super) struct Panel {
    /// What is rendered now.
    pub(super) settings: Settings,
    /// What Reset goes back to.
    initial: Settings,
    /// What the renderer took last, and the name of its scene.
    accepted: (Settings, String),
    max_points: u32,
    /// As named: a built-in or a file.
    scene: String,
    /// The choices: the built-ins, and the file that the viewer was opened with.
    scenes: Vec<String>,
    message: Option<String>,
    /// Where the controls were drawn, to tell when they moved.
    layout: Vec<(&'static str, [i32; 4])>,
}

/// What the panel shows of the renderer.
pub(super) struct Status<'a> {
    pub(super) progress: Progress,
    pub(super) device: &'a str,
}

impl Panel {
    pub(super) fn new(settings: Settings, scene: String) -> Self {
        let mut scenes: Vec<String> = BUILTINS.iter().map(|builtin| builtin.name.to_owned()).collect();
        if !scenes.contains(&scene) {
            scenes.push(scene.clone());
        }
        Self {
            initial: settings.clone(),
            accepted: (settings.clone(), scene.clone()),
            max_points: settings.samples.max(MAX_POINTS),
            settings,
            scene,
            scenes,
            message: None,
            layout: Vec::new(),
        }
    }

    /// Draws the panel and changes the settings as told.
    pub(super) fn draw(&mut self, ui: &Ui, status: &Status<'_>) {
        let mut layout = Vec::new();
        ui.window("thinlens")
            .position([12.0, 12.0], Condition::FirstUseEver)
            .size([320.0, 0.0], Condition::Always)
            .resizable(false)
            .build(|| {
                ui.set_next_item_width(-1.0);
                self.scene_chooser(ui);
                ui.spacing();
                self.sliders(ui, &mut layout);
                ui.separator();
                self.status(ui, status);
                if ui.button("Reset") {
                    let size = self.settings.estimator.size;
                    self.settings = self.initial.clone();
                    self.settings.estimator.size = size;
                }
                note_item(ui, "Reset", &mut layout);
                tooltip(ui, "Back to the settings that the scene was opened with.");
            });
        if layout != self.layout {
            for (name, [x, y, width, height]) in &layout {
                log::debug!("control '{name}' at {x} {y} {width} {height}");
            }
            self.layout = layout;
        }
    }

    /// The renderer took the settings.
    pub(super) fn accept(&mut self) {
        if self.accepted.0 != self.settings {
            self.accepted = (self.settings.clone(), self.scene.clone());
        }
    }

    /// The renderer did not: back to what it took last, and say why.
    pub(super) fn refuse(&mut self, error: &Error) {
        self.message = Some(error.to_string());
        let size = self.settings.estimator.size;
        (self.settings, self.scene) = self.accepted.clone();
        self.settings.estimator.size = size;
    }

    fn scene_chooser(&mut self, ui: &Ui) {
        let mut chosen = None;
        if let Some(_combo) = ui.begin_combo("##scene", &self.scene) {
            for name in &self.scenes {
                if ui.selectable_config(name).selected(*name == self.scene).build() {
                    chosen = Some(name.clone());
                }
            }
        }
        if let Some(name) = chosen {
            self.open(name);
        }
        if let Some(message) = &self.message {
            ui.text_wrapped(message);
        }
    }

    fn open(&mut self, name: String) {
        match scene::load(&name) {
            Ok(loaded) => {
                let mut settings = Settings::of_scene(SceneRef::new(loaded));
                let (now, estimator) = (&self.settings, &mut settings.estimator);
                estimator.size = now.estimator.size;
                estimator.jitter = now.estimator.jitter;
                (estimator.sampler, estimator.seed) = (now.estimator.sampler, now.estimator.seed);
                estimator.noise_threshold = now.estimator.noise_threshold;
                settings.samples = now.samples;
                settings.view = now.view;
                self.initial = settings.clone();
                self.settings = settings;
                self.scene = name;
                self.message = None;
            }
            Err(error) => self.message = Some(error.to_string()),
        }
    }

    fn sliders(&mut self, ui: &Ui, layout: &mut Vec<(&'static str, [i32; 4])>) {
        let logarithmic =
            SliderFlags::LOGARITHMIC | SliderFlags::ALWAYS_CLAMP | SliderFlags::NO_ROUND_TO_FORMAT;
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
            "How wide the lens is, in scene units. 0 is a pinhole: everything is sharp.",
            layout,
            |id| {
                ui.slider_config(id, 0.0, widest)
                    .display_format("%.4g")
                    .flags(SliderFlags::ALWAYS_CLAMP | SliderFlags::NO_ROUND_TO_FORMAT)
                    .build(&mut estimator.lens.diameter);
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
                    .flags(logarithmic)
                    .build(&mut estimator.lens.focal_distance);
            },
        );
        let (samples, max_points) = (&mut self.settings.samples, self.max_points);
        named(
            ui,
            "Anti-aliasing points per pixel",
            "How many rays are averaged in each pixel: more give less noise. Raising it goes on from what is there.",
            layout,
            |id| {
                ui.slider_config(id, 1, max_points).flags(logarithmic).build(samples);
            },
        );

        let mut centre_only = estimator.jitter == 0.0;
        if ui.checkbox("One centre ray per pixel", &mut centre_only) {
            estimator.jitter = if centre_only { 0.0 } else { DEFAULT_JITTER };
        }
        note_item(ui, "One centre ray per pixel", layout);
        tooltip(
            ui,
            "All rays of a pixel aim at one point in focus: edges in the focal plane turn jagged, blur stays.",
        );

        named(
            ui,
            "Noise threshold",
            "A pixel stops once its error is below this share of its brightness, and the work goes where the noise is. 0: none stops.",
            layout,
            |id| {
                ui.slider_config(id, 0.0, 0.2)
                    .display_format(if estimator.noise_threshold > 0.0 { "%.3f" } else { "off" })
                    .flags(SliderFlags::ALWAYS_CLAMP)
                    .build(&mut estimator.noise_threshold);
            },
        );
        let overlay = &mut self.settings.view.overlay;
        let mut counts = overlay.is_some();
        if ui.checkbox("Show sample counts", &mut counts) {
            *overlay = counts.then_some(Overlay::Count);
        }
        note_item(ui, "Show sample counts", layout);
        tooltip(
            ui,
            "How many points each pixel has: black for none, white for as many as the slider above says.",
        );

        let stops = &mut self.settings.view.exposure_stops;
        named(
            ui,
            "Exposure",
            "Brightness in stops: each doubles it. Changes only how the picture is shown.",
            layout,
            |id| {
                ui.slider_config(id, -5.0_f32, 5.0)
                    .display_format("%+.2f stops")
                    .flags(SliderFlags::ALWAYS_CLAMP)
                    .build(stops);
            },
        );
    }

    fn status(&self, ui: &Ui, status: &Status<'_>) {
        let Progress { samples, traced, device_time, rejected_samples, active_pixels, .. } = status.progress;
        let target = self.settings.samples;
        imgui::ProgressBar::new(samples as f32 / target as f32)
            .size([-1.0, 0.0])
            .overlay_text(format!("{samples} / {target} points"))
            .build(ui);
        let seconds = device_time.as_secs_f64();
        if seconds > 0.0 {
            ui.text(format!("{:.1} M samples per second", traced as f64 / seconds / 1e6));
        } else {
            ui.text("measuring ...");
        }
        if let Some(active) = active_pixels {
            let [width, height] = self.settings.estimator.size.map(u64::from);
            ui.text(format!("{:.1}% of the pixels go on", 100.0 * active as f64 / (width * height) as f64));
        }
        if rejected_samples > 0 {
            ui.text(format!("{rejected_samples} samples were not finite and are left out"));
        }
        ui.text_wrapped(status.device);
    }
}

/// A control with its name above it, as wide as the panel.
fn named(
    ui: &Ui,
    name: &'static str,
    help: &str,
    layout: &mut Vec<(&'static str, [i32; 4])>,
    control: impl FnOnce(String),
) {
    ui.text(name);
    ui.set_next_item_width(-1.0);
    control(format!("##{name}"));
    note_item(ui, name, layout);
    tooltip(ui, help);
}

fn tooltip(ui: &Ui, help: &str) {
    if ui.is_item_hovered() && !ui.is_item_active() {
        ui.tooltip(|| {
            let _wrap = ui.push_text_wrap_pos_with_pos(280.0);
            ui.text_wrapped(help);
        });
    }
}

/// Where the last item is, in physical pixels: left, top, width, height.
fn note_item(ui: &Ui, name: &'static str, layout: &mut Vec<(&'static str, [i32; 4])>) {
    let scale = ui.io().display_framebuffer_scale;
    let (min, max) = (ui.item_rect_min(), ui.item_rect_max());
    let pixels = |value: f32, axis: usize| (value * scale[axis]).round() as i32;
    layout.push((
        name,
        [pixels(min[0], 0), pixels(min[1], 1), pixels(max[0] - min[0], 0), pixels(max[1] - min[1], 1)],
    ));
}
