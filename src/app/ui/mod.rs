//! The panel.

mod aperture;
mod lens;
mod numbers;
mod optics;
mod overlay;
mod widgets;

use super::diagram::Diagram;
use crate::error::Error;
use crate::renderer::{Picked, Progress};
use crate::scene::{self, ApertureImage, BUILTINS, CameraModel, SceneRef};
use crate::settings::{DEFAULT_JITTER, Settings, View};
use imgui::{Condition, SliderFlags, Ui};
use optics::Optics;
use widgets::{Layout, named, note_item, section, tooltip};

/// The points slider goes this far, or as far as was asked for.
const MAX_POINTS: u32 = 4096;

/// How sliders go over several orders of magnitude.
const LOGARITHMIC: SliderFlags = SliderFlags::from_bits_truncate(
    SliderFlags::LOGARITHMIC.bits()
        | SliderFlags::ALWAYS_CLAMP.bits()
        | SliderFlags::NO_ROUND_TO_FORMAT.bits(),
);

/// Width of the panel, in points.
const PANEL_WIDTH: f32 = 320.0;
/// Around the panel, in points.
const MARGIN: f32 = 12.0;

/// What the panel edits, and what it has to know for it.
pub(super) struct Panel {
    /// What is rendered now.
    pub(super) settings: Settings,
    /// What Reset goes back to.
    initial: Settings,
    /// What the renderer took last, and the name of its scene.
    accepted: (Settings, String),
    max_points: u32,
    /// The last aperture that was an image.
    image: Option<ApertureImage>,
    /// As named: a built-in or a file.
    scene: String,
    /// The choices: the built-ins, and the file that the viewer was opened with.
    scenes: Vec<String>,
    message: Option<String>,
    pub(super) optics: Optics,
    /// Where the controls were drawn, to tell when they moved.
    layout: Layout,
}

/// What the panel shows of the renderer.
pub(super) struct Status<'a> {
    pub(super) progress: Progress,
    pub(super) device: &'a str,
    /// What lies under the pointer, while it is over the picture.
    pub(super) picked: Option<&'a Picked>,
    /// The optics of the pixel that was clicked last.
    pub(super) diagram: Option<&'a Diagram>,
}

/// What a button asks for beyond the settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Action {
    /// Focus on what is in the middle of the picture.
    Autofocus,
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
            image: settings.estimator.aperture.image.clone(),
            settings,
            scene,
            scenes,
            message: None,
            optics: Optics::default(),
            layout: Vec::new(),
        }
    }

    /// Draws the panel and changes the settings as told.
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
                ui.set_next_item_width(-1.0);
                self.scene_chooser(ui);
                self.main_sliders(ui, &mut layout);
                self.progress(ui, status);
                if ui.button("Autofocus") {
                    action = Some(Action::Autofocus);
                }
                note_item(ui, "Autofocus", &mut layout);
                tooltip(
                    ui,
                    "Focuses on what is in the middle of the picture. Right-click anything, or point at it and press F, to focus on that instead; Ctrl and the wheel move the plane by hand.",
                );
                ui.same_line();
                if ui.button("Reset") {
                    let size = self.settings.estimator.size;
                    self.settings = self.initial.clone();
                    self.settings.estimator.size = size;
                }
                note_item(ui, "Reset", &mut layout);
                tooltip(ui, "Back to the settings that the scene was opened with.");
                ui.same_line();
                ui.checkbox("Optics", &mut self.optics.open);
                note_item(ui, "Optics", &mut layout);
                tooltip(
                    ui,
                    "Draws what the lens does with the light of one pixel, to scale. Click the picture to choose the pixel.",
                );
                section(ui, "Lens", false, &mut layout, |layout| self.opening(ui, layout));
                if self.settings.estimator.model != CameraModel::Pinhole {
                    section(ui, "Aperture shape", false, &mut layout, |layout| self.shape(ui, layout));
                }
                section(ui, "What is sharp", true, &mut layout, |_| self.numbers(ui, status.picked));
                section(ui, "Light", false, &mut layout, |layout| self.exposure(ui, layout));
                section(ui, "Sampling", false, &mut layout, |layout| self.sampling(ui, layout));
                section(ui, "View", false, &mut layout, |layout| self.view(ui, layout));
                section(ui, "Device", false, &mut layout, |_| device(ui, status));
            });
        self.optics.draw(ui, status.diagram, &mut layout);
        overlay::legend(ui, &self.settings);
        if layout != self.layout {
            for (name, [x, y, width, height]) in &layout {
                log::debug!("control '{name}' at {x} {y} {width} {height}");
            }
            self.layout = layout;
        }
        action
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
                settings.view = View { iso: settings.view.iso, ..now.view };
                settings.show(now.view.overlay);
                self.initial = settings.clone();
                self.settings = settings;
                self.scene = name;
                self.message = None;
            }
            Err(error) => self.message = Some(error.to_string()),
        }
    }

    fn shape(&mut self, ui: &Ui, layout: &mut Layout) {
        let estimator = &mut self.settings.estimator;
        aperture::edit(ui, &mut estimator.aperture, self.image.as_ref(), estimator.model, layout);
    }

    fn main_sliders(&mut self, ui: &Ui, layout: &mut Layout) {
        self.aperture_and_focus(ui, layout);
        let (samples, max_points) = (&mut self.settings.samples, self.max_points);
        named(
            ui,
            "Anti-aliasing points per pixel",
            "How many rays are averaged in each pixel: more give less noise. Raising it goes on from what is there.",
            layout,
            |id| {
                ui.slider_config(id, 1, max_points).flags(LOGARITHMIC).build(samples);
            },
        );
    }

    fn sampling(&mut self, ui: &Ui, layout: &mut Layout) {
        let estimator = &mut self.settings.estimator;
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
    }

    fn exposure(&mut self, ui: &Ui, layout: &mut Layout) {
        let Settings { estimator, view, .. } = &mut self.settings;
        named(
            ui,
            "Shutter",
            "How long light comes in, in seconds. Twice as long is twice as bright, and what moves is blurred along its way. The aperture's blur is another thing.",
            layout,
            |id| {
                let shown = match estimator.shutter {
                    long if long >= 0.5 => format!("{long:.1} s"),
                    short => format!("1/{:.0} s", short.recip()),
                };
                ui.slider_config(id, 1.0 / 8000.0, 4.0)
                    .display_format(shown)
                    .flags(LOGARITHMIC)
                    .build(&mut estimator.shutter);
            },
        );
        named(ui, "ISO", "The film's speed: twice as fast is twice as bright.", layout, |id| {
            ui.slider_config(id, 25.0, 25600.0)
                .display_format("ISO %.0f")
                .flags(LOGARITHMIC)
                .build(&mut view.iso);
        });
        ui.checkbox("Keep the brightness", &mut view.exposure_lock);
        note_item(ui, "Keep the brightness", layout);
        tooltip(
            ui,
            "On: the picture stays as bright while the aperture changes. Off: it darkens with each stop, as on film.",
        );
        named(
            ui,
            "Exposure",
            "Brightness in stops: each doubles it. Changes only how the picture is shown.",
            layout,
            |id| {
                ui.slider_config(id, -5.0_f32, 5.0)
                    .display_format("%+.2f stops")
                    .flags(SliderFlags::ALWAYS_CLAMP)
                    .build(&mut view.exposure_stops);
            },
        );
    }

    fn progress(&self, ui: &Ui, status: &Status<'_>) {
        let Progress { samples, active_pixels, .. } = status.progress;
        let target = self.settings.samples;
        let text = match active_pixels {
            None => format!("{samples} / {target} points"),
            Some(active) => {
                let [width, height] = self.settings.estimator.size.map(u64::from);
                let share = 100.0 * active as f64 / (width * height) as f64;
                format!("{samples} / {target} points, {share:.1}% of the pixels go on")
            }
        };
        imgui::ProgressBar::new(samples as f32 / target as f32)
            .size([-1.0, 0.0])
            .overlay_text(text)
            .build(ui);
    }
}

fn device(ui: &Ui, status: &Status<'_>) {
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
