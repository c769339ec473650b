//! What a window needs of Vulkan: a swapchain that comes and goes, frames in flight, and imgui's
//! renderer.

use super::loader::Loader;
use crate::error::{Error, Result};
use crate::output;
use crate::renderer::{Pace, Picked, Prepared, Progress, Question, Renderer};
use crate::settings::{DeviceChoice, Settings};
use crate::vulkan::{
    Acquired, AcquiredImage, Commands, Device, FRAMES_IN_FLIGHT, Image, Instance, Surface, Swapchain,
};
use imgui_rs_vulkan_renderer::{DynamicRendering, Options};
use std::path::Path;
use std::sync::Arc;
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

/// What the device says to a question of [`Graphics::draw`]: nothing, where the scene has changed since.
pub(super) struct Answer(pub(super) Option<Picked>);

/// The order is the order of dropping: imgui's renderer keeps raw handles of the device, and the
/// surface must go before the window.
pub(super) struct Graphics {
    overlay: Option<imgui_rs_vulkan_renderer::Renderer>,
    swapchain: Option<Swapchain>,
    /// A picture to compare with.
    held: Option<Image>,
    renderer: Renderer,
    frames: [Commands; FRAMES_IN_FLIGHT],
    next_frame: usize,
    /// Whether a frame has a question to answer.
    asked: [bool; FRAMES_IN_FLIGHT],
    pub(super) loader: Loader,
    surface: Arc<Surface>,
    choice: DeviceChoice,
    waker: EventLoopProxy<()>,
    device: Arc<Device>,
    window: Arc<Window>,
}

impl Graphics {
    pub(super) fn new(
        window: &Arc<Window>,
        instance: &Arc<Instance>,
        choice: &DeviceChoice,
        waker: &EventLoopProxy<()>,
        settings: &Settings,
    ) -> Result<Self> {
        let surface = Surface::new(instance, window)?;
        Self::on(instance, window, &surface, choice, waker, settings)
    }

    fn on(
        instance: &Arc<Instance>,
        window: &Arc<Window>,
        surface: &Arc<Surface>,
        choice: &DeviceChoice,
        waker: &EventLoopProxy<()>,
        settings: &Settings,
    ) -> Result<Self> {
        let device = Device::open(instance, choice.device.as_deref(), Some(surface))?;
        device.keep_pipelines();
        let renderer = Renderer::new(&device, settings)?;
        Ok(Self {
            overlay: None,
            swapchain: None,
            held: None,
            loader: Loader::new(renderer.preparer(), renderer.prepared().clone(), waker.clone()),
            renderer,
            frames: [Commands::new(&device)?, Commands::new(&device)?],
            next_frame: 0,
            asked: [false; FRAMES_IN_FLIGHT],
            surface: Arc::clone(surface),
            choice: choice.clone(),
            waker: waker.clone(),
            device,
            window: Arc::clone(window),
        })
    }

    /// The same on a device that is opened anew.
    pub(super) fn again(&self, settings: &Settings) -> Result<Self> {
        Self::on(self.device.instance(), &self.window, &self.surface, &self.choice, &self.waker, settings)
    }

    pub(super) fn device_name(&self) -> &str {
        &self.device.info().name
    }

    /// What is allocated on the device: names and bytes.
    pub(super) fn memory(&self) -> Vec<(String, u64)> {
        self.device.memory()
    }

    pub(super) fn progress(&self) -> Progress {
        self.renderer.progress()
    }

    pub(super) fn finished(&self) -> bool {
        self.renderer.finished()
    }

    /// Makes the swapchain fit the window, and imgui's renderer the fonts. None while the window
    /// has no area; else the size to render at.
    pub(super) fn fit(&mut self, window: [u32; 2], imgui: &mut imgui::Context) -> Result<Option<[u32; 2]>> {
        if window.contains(&0) {
            self.swapchain = None;
        } else if self.swapchain.is_none() {
            self.swapchain = Swapchain::new(&self.device, &self.surface, window)?;
        }
        let Some(swapchain) = &self.swapchain else {
            return Ok(None);
        };
        let extent = swapchain.extent();
        self.renderer.set_blue_first(swapchain.blue_first());
        if self.overlay.is_none() {
            // It uploads the fonts by itself.
            let (device, queue, allocator) = self.device.raw_parts();
            let options = Options { in_flight_frames: FRAMES_IN_FLIGHT, ..Options::default() };
            let target = DynamicRendering {
                color_attachment_format: swapchain.format(),
                depth_attachment_format: None,
            };
            let overlay = imgui_rs_vulkan_renderer::Renderer::with_gpu_allocator(
                allocator,
                device,
                *queue,
                self.frames[0].raw_pool(),
                target,
                imgui,
                Some(options),
            );
            self.overlay = Some(overlay.map_err(overlay_error)?);
        }
        Ok(Some(extent))
    }

    /// The window changed: another swapchain before the next frame.
    pub(super) fn refit(&mut self) {
        self.swapchain = None;
    }

    /// Renders these settings from now on, if what they need is ready. Otherwise another thread makes it, and this
    /// gives false.
    pub(super) fn set(&mut self, settings: &Settings) -> Result<bool> {
        settings.check()?;
        // The first picture is not to wait for what answers questions.
        let answers = self.renderer.prepared().answers() || self.renderer.progress().samples > 0;
        let ready = self.renderer.prepared().fits(settings, answers);
        if ready {
            self.renderer.set(settings)?;
        } else {
            self.loader.prepare(settings);
        }
        Ok(ready)
    }

    /// Renders these settings from now on, with parts that were made for them.
    pub(super) fn set_prepared(&mut self, settings: &Settings, prepared: &Prepared) -> Result<()> {
        self.renderer.set_prepared(settings, prepared)
    }

    /// Goes on with what is rendered, in this size.
    pub(super) fn go_on(&mut self, shown: &Settings) -> Result<()> {
        self.renderer.set(shown)
    }

    /// Whether questions can be asked.
    pub(super) fn answers(&self) -> bool {
        self.renderer.prepared().answers()
    }

    /// Holds the picture as it is now, to compare others with.
    pub(super) fn hold(&mut self) -> Result<()> {
        self.device.wait_idle()?;
        self.held = Some(self.renderer.hold_picture()?);
        Ok(())
    }

    /// Saves the picture as it is now: that of so many samples as it has.
    pub(super) fn save(&mut self, settings: &Settings, path: &Path) -> Result<()> {
        self.device.wait_idle()?;
        let saved = output::save(&mut self.renderer, settings, path);
        self.renderer.set(settings)?;
        saved
    }

    /// Whether a picture is held that is as large as the window.
    pub(super) fn holds(&self) -> bool {
        let extent = self.swapchain.as_ref().map(Swapchain::extent);
        self.held.as_ref().is_some_and(|held| Some(held.extent()) == extent)
    }

    /// Lets it go.
    pub(super) fn let_go(&mut self) -> Result<()> {
        self.device.wait_idle()?;
        self.held = None;
        Ok(())
    }

    /// Waits until the next frame's commands are free, and takes in what they measured. With `all`, for
    /// every frame under way: then none stands between what the hand does next and the screen.
    ///
    /// Gives the answer to what was asked in that frame, if anything.
    pub(super) fn wait_for_frame(&mut self, all: bool) -> Result<Option<Answer>> {
        for frame in self.frames.iter().filter(|_| all) {
            frame.wait()?;
        }
        self.frames[self.next_frame].wait()?;
        self.renderer.collect(self.next_frame)?;
        let asked = std::mem::take(&mut self.asked[self.next_frame]);
        Ok(asked.then(|| Answer(self.renderer.picked(self.next_frame))))
    }

    /// The next image to draw to. None where the window has changed or is hidden.
    pub(super) fn acquire(&mut self) -> Result<Option<AcquiredImage>> {
        let Some(swapchain) = &mut self.swapchain else {
            return Ok(None);
        };
        Ok(match swapchain.acquire()? {
            Acquired::Image(image) => Some(image),
            Acquired::NotReady => None,
            Acquired::Stale => {
                self.swapchain = None;
                None
            }
        })
    }

    /// Traces for as long as `pace` says, if at all, and shows the picture on `image` with imgui on top.
    /// [`Self::wait_for_frame`] comes first. `split`: up to which column the held picture is shown. `question`: of a place of the picture.
    pub(super) fn draw(
        &mut self,
        image: &AcquiredImage,
        imgui: &mut imgui::Context,
        pace: Option<Pace>,
        question: Option<Question>,
        split: u32,
    ) -> Result<()> {
        let panel = imgui.render();
        let Some(swapchain) = &mut self.swapchain else {
            return Ok(());
        };
        let frame = self.next_frame;
        self.next_frame = (frame + 1) % FRAMES_IN_FLIGHT;
        let mut recording = self.frames[frame].begin()?;
        if let Some(pace) = pace.filter(|_| !self.renderer.finished()) {
            self.renderer.record(&mut recording, frame, pace);
        }
        self.renderer.record_resolve(&mut recording);
        if let Some(question) = question {
            self.asked[frame] = self.renderer.record_pick(&mut recording, frame, question);
        }

        let left = self.held.as_ref().map(|held| (held, split));
        swapchain.begin_drawing(&mut recording, image, self.renderer.picture(), left);
        if let Some(overlay) = &mut self.overlay {
            overlay.cmd_draw(recording.raw(), panel).map_err(overlay_error)?;
        }
        self.window.pre_present_notify();
        if !swapchain.present(recording, image)? {
            self.swapchain = None;
        }
        Ok(())
    }

    /// The font atlas changed. imgui's renderer reads it when it is made.
    pub(super) fn reload_fonts(&mut self) -> Result<()> {
        self.device.wait_idle()?;
        self.overlay = None;
        Ok(())
    }
}

impl Drop for Graphics {
    fn drop(&mut self) {
        // Nothing may be in use when the parts are dropped; a lost device uses nothing.
        let _ = self.device.wait_idle();
    }
}

fn overlay_error(error: imgui_rs_vulkan_renderer::RendererError) -> Error {
    Error::Window(format!("drawing the panel failed: {error}"))
}
