//! The parts of the window that use Vulkan: a swapchain that is replaced as the window changes, frames in flight, and
//! imgui's renderer.

use super::thumbnails;
use crate::error::{Error, Result};
use crate::output;
use crate::renderer::{Excerpt, Pace, Picked, Prepared, Progress, Question, Renderer};
use crate::settings::{DeviceChoice, Settings};
use crate::vulkan::{
    Acquired, AcquiredImage, Commands, Device, FRAMES_IN_FLIGHT, Image, Instance, Surface, Swapchain, Texture,
};
use imgui::TextureId;
use imgui_rs_vulkan_renderer::{DynamicRendering, Options};
use std::path::Path;
use std::sync::Arc;
use winit::window::Window;

/// The answer to a question of [`Graphics::draw`]. It holds `None` if the scene has changed since the question.
pub(super) struct Answer(pub(super) Option<Picked>);

/// What a frame asks the device besides its picture.
#[derive(Default)]
pub(super) struct Wanted {
    pub(super) question: Option<Question>,
    /// The pixel around which the picture is wanted, and how far.
    pub(super) excerpt: Option<([u32; 2], u32)>,
}

/// The order of the fields is the order in which they are dropped: imgui's renderer keeps raw handles of the device,
/// and the surface must be dropped before the window.
pub(super) struct Graphics {
    overlay: Option<imgui_rs_vulkan_renderer::Renderer>,
    thumbnails: Option<(Texture, TextureId)>,
    swapchain: Option<Swapchain>,
    /// The picture that is held for comparison.
    held: Option<Image>,
    /// `None` until the loader has made it.
    renderer: Option<Renderer>,
    frames: [Commands; FRAMES_IN_FLIGHT],
    next_frame: usize,
    /// For each frame in flight, whether it has a question to answer.
    asked: [bool; FRAMES_IN_FLIGHT],
    /// The part of the picture that was read last.
    excerpt: Option<Excerpt>,
    surface: Arc<Surface>,
    choice: DeviceChoice,
    device: Arc<Device>,
    window: Arc<Window>,
}

impl Graphics {
    pub(super) fn new(window: &Arc<Window>, instance: &Arc<Instance>, choice: &DeviceChoice) -> Result<Self> {
        let surface = Surface::new(instance, window)?;
        Self::on(instance, window, &surface, choice)
    }

    fn on(
        instance: &Arc<Instance>,
        window: &Arc<Window>,
        surface: &Arc<Surface>,
        choice: &DeviceChoice,
    ) -> Result<Self> {
        let device = Device::open(instance, choice.device.as_deref(), Some(surface))?;
        device.keep_pipelines();
        Ok(Self {
            overlay: None,
            thumbnails: None,
            swapchain: None,
            held: None,
            renderer: None,
            frames: [Commands::new(&device)?, Commands::new(&device)?],
            next_frame: 0,
            asked: [false; FRAMES_IN_FLIGHT],
            excerpt: None,
            surface: Arc::clone(surface),
            choice: choice.clone(),
            device,
            window: Arc::clone(window),
        })
    }

    /// Opens the device again, and makes everything anew on it.
    pub(super) fn reopen(&self) -> Result<Self> {
        Self::on(self.device.instance(), &self.window, &self.surface, &self.choice)
    }

    pub(super) fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// Shows the pictures of this renderer from now on.
    pub(super) fn start(&mut self, renderer: Renderer) {
        self.renderer = Some(renderer);
    }

    /// What the panel knows the thumbnails by.
    pub(super) fn thumbnails(&self) -> Option<TextureId> {
        self.thumbnails.as_ref().map(|(_, id)| *id)
    }

    /// Whether there is a renderer.
    pub(super) fn has_started(&self) -> bool {
        self.renderer.is_some()
    }

    pub(super) fn device_name(&self) -> &str {
        &self.device.info().name
    }

    /// The allocations on the device: their names and bytes.
    pub(super) fn memory(&self) -> Vec<(String, u64)> {
        self.device.memory()
    }

    pub(super) fn progress(&self) -> Progress {
        self.renderer.as_ref().map(Renderer::progress).unwrap_or_default()
    }

    /// Whether there is nothing more to trace at the moment.
    pub(super) fn finished(&self) -> bool {
        self.renderer.as_ref().is_none_or(Renderer::finished)
    }

    /// Makes the swapchain fit the window and imgui's renderer fit the fonts. Returns the window's size, or `None`
    /// while the window has no area.
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
        if self.overlay.is_none() {
            let texture = match self.thumbnails.take() {
                Some((texture, _)) => texture,
                None => thumbnails::upload(&self.device)?,
            };
            // It uploads the fonts when it is made.
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
            let overlay = self.overlay.insert(overlay.map_err(overlay_error)?);
            let id = overlay.textures().insert(texture.descriptor_set());
            self.thumbnails = Some((texture, id));
        }
        Ok(Some(extent))
    }

    /// Replaces the swapchain before the next frame, because the window has changed.
    pub(super) fn refit(&mut self) {
        self.swapchain = None;
    }

    /// Renders these settings from now on, if what they need is ready. Otherwise this returns false.
    pub(super) fn set(&mut self, settings: &Settings) -> Result<bool> {
        if let Some(renderer) = &mut self.renderer {
            // The first picture should not wait for the passes that answer questions.
            let answers = renderer.prepared().answers() || renderer.progress().samples > 0;
            let prepared = renderer.prepared();
            if prepared.fits(settings, answers) || prepared.nearly_fits(settings, answers) {
                return renderer.set(settings).map(|()| true);
            }
        }
        settings.check().map(|()| false)
    }

    /// Renders these settings from now on, with parts that were prepared for them.
    pub(super) fn set_prepared(&mut self, settings: &Settings, prepared: &Prepared) -> Result<()> {
        self.renderer.as_mut().map_or(Ok(()), |renderer| renderer.set_prepared(settings, prepared))
    }

    /// Continues to render these settings, which may differ from the current ones in the size alone.
    pub(super) fn go_on(&mut self, shown: &Settings) -> Result<()> {
        self.renderer.as_mut().map_or(Ok(()), |renderer| renderer.set(shown))
    }

    /// Whether the renderer can answer questions.
    pub(super) fn answers(&self) -> bool {
        self.renderer.as_ref().is_some_and(|renderer| renderer.prepared().answers())
    }

    /// Holds the picture as it is now, for comparison.
    pub(super) fn hold(&mut self) -> Result<()> {
        self.device.wait_idle()?;
        self.held = self.renderer.as_mut().map(Renderer::hold_picture).transpose()?;
        Ok(())
    }

    /// Saves the picture as it is now, if there is one, with the samples that it has so far.
    pub(super) fn save(&mut self, settings: &Settings, path: &Path) -> Result<()> {
        let Some(renderer) = &mut self.renderer else {
            return Ok(());
        };
        self.device.wait_idle()?;
        let saved = output::save(renderer, settings, path);
        renderer.set(settings)?;
        saved
    }

    /// Whether a picture of this size is held.
    pub(super) fn holds(&self, size: [u32; 2]) -> bool {
        self.held.as_ref().is_some_and(|held| held.extent() == size)
    }

    /// Releases the held picture.
    pub(super) fn let_go(&mut self) -> Result<()> {
        self.device.wait_idle()?;
        self.held = None;
        Ok(())
    }

    /// Waits until the commands of the next frame are free, and collects what they measured. With `all`, waits for
    /// every frame in flight, so that none delays the picture of the next input.
    ///
    /// Returns the answer to the question of that frame, if it had one.
    pub(super) fn wait_for_frame(&mut self, all: bool) -> Result<Option<Answer>> {
        for frame in self.frames.iter().filter(|_| all) {
            frame.wait()?;
        }
        self.frames[self.next_frame].wait()?;
        let Some(renderer) = &mut self.renderer else {
            return Ok(None);
        };
        renderer.collect(self.next_frame)?;
        let asked = std::mem::take(&mut self.asked[self.next_frame]);
        Ok(asked.then(|| Answer(renderer.picked(self.next_frame))))
    }

    /// Takes the part of the picture that the next frame has read. Call [`Self::wait_for_frame`] first. Returns whether it
    /// differs from the last one.
    pub(super) fn take_excerpt(&mut self) -> bool {
        let read = self.renderer.as_mut().and_then(|renderer| renderer.excerpt(self.next_frame));
        let differs = read.is_some() && read != self.excerpt;
        self.excerpt = read.or(self.excerpt.take());
        differs
    }

    /// The part of the picture that was read last.
    pub(super) fn excerpt(&self) -> Option<&Excerpt> {
        self.excerpt.as_ref()
    }

    /// The next image to draw to. `None` if the window has changed or is hidden.
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

    /// Traces for as long as `pace` says, if it is given, and draws the picture and the panel to `image`. Call
    /// [`Self::wait_for_frame`] first. The picture is drawn with its upper left corner at `corner`, and the held picture
    /// up to the column `split` of the picture. The answers to what is
    /// `wanted` come when the frame is done.
    pub(super) fn draw(
        &mut self,
        image: &AcquiredImage,
        imgui: &mut imgui::Context,
        pace: Option<Pace>,
        wanted: Wanted,
        corner: [u32; 2],
        split: u32,
    ) -> Result<()> {
        let panel = imgui.render();
        let Some(swapchain) = &mut self.swapchain else {
            return Ok(());
        };
        let frame = self.next_frame;
        self.next_frame = (frame + 1) % FRAMES_IN_FLIGHT;
        let mut recording = self.frames[frame].begin()?;
        if let Some(renderer) = &mut self.renderer {
            renderer.set_blue_first(swapchain.blue_first());
            if let Some(pace) = pace.filter(|_| !renderer.finished()) {
                renderer.record(&mut recording, frame, pace);
            }
            renderer.record_resolve(&mut recording);
            if let Some(question) = wanted.question {
                self.asked[frame] = renderer.record_pick(&mut recording, frame, question);
            }
            if let Some((middle, reach)) = wanted.excerpt {
                renderer.record_excerpt(&mut recording, frame, middle, reach)?;
            }
        }

        let left = self.held.as_ref().map(|held| (held, split));
        let picture = self.renderer.as_ref().map(Renderer::picture);
        swapchain.begin_drawing(&mut recording, image, corner, picture, left);
        if let Some(overlay) = &mut self.overlay {
            overlay.cmd_draw(recording.raw(), panel).map_err(overlay_error)?;
        }
        self.window.pre_present_notify();
        if !swapchain.present(recording, image)? {
            self.swapchain = None;
        }
        Ok(())
    }

    /// Drops imgui's renderer, because the fonts have changed: it reads them when it is made.
    pub(super) fn reload_fonts(&mut self) -> Result<()> {
        self.device.wait_idle()?;
        self.overlay = None;
        Ok(())
    }
}

impl Drop for Graphics {
    fn drop(&mut self) {
        // The parts must not be in use when they are dropped. An error means that the device is lost and uses nothing.
        let _ = self.device.wait_idle();
    }
}

fn overlay_error(error: imgui_rs_vulkan_renderer::RendererError) -> Error {
    Error::Window(format!("drawing the panel failed: {error}"))
}
