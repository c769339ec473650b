//! The window: how it opens, and what its events do.

mod frame;

use super::Options;
use super::area::Area;
use super::clipboard::Clipboard;
use super::focus::Focus;
use super::graphics::Graphics;
use super::history::History;
use super::keys::HeldKeys;
use super::loader::Loader;
use super::memory;
use super::navigate::Navigate;
use super::panel::{Panel, State};
use super::telemetry::{self, Telemetry};
use super::theme;
use crate::error::{Error, Result};
use crate::scene::MAX_EXTENT;
use crate::vulkan::Instance;
use imgui_winit_support::{HiDpiMode, WinitPlatform};
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{Event, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::raw_window_handle::HasDisplayHandle;
use winit::window::{Window, WindowId};

/// The window's size at the first start, in points.
const DEFAULT_SIZE: [f64; 2] = [1280.0, 720.0];
/// imgui needs one frame to notice an event and another to draw the effect.
const FRAMES_AFTER_EVENT: u32 = 3;
/// How long the pointer rests on a control before its tooltip comes.
const TOOLTIP_DELAY: Duration = Duration::from_millis(500);
/// imgui handles one press or release per frame, even when several arrive at once. This is the most frames that are
/// drawn to catch up.
const MAX_FRAMES_TO_DRAW: u32 = 30;
/// The driver's thread that presents frames also reads from the window's connection. It can queue an event that winit
/// does not notice until the next one arrives (seen with Mesa 25). So winit checks for events this often while a frame
/// may still be on its way to the screen.
const LOOK_AGAIN: Duration = Duration::from_millis(20);
/// How long after it began a frame may still be on its way to the screen.
const MAY_BE_PRESENTING: Duration = Duration::from_secs(5);

/// The application as winit drives it.
pub(super) struct Viewer {
    options: Options,
    /// Wakes the event loop from another thread.
    waker: EventLoopProxy<()>,
    open: Option<OpenWindow>,
    /// The loader of the window that was closed, which may still be busy.
    closing: Option<Loader>,
    instance: Option<Arc<Instance>>,
    error: Option<Error>,
}

struct OpenWindow {
    graphics: Graphics,
    platform: WinitPlatform,
    imgui: imgui::Context,
    panel: Panel,
    focus: Focus,
    navigate: Navigate,
    history: History<State>,
    /// Wakes the window when another thread has news.
    waker: EventLoopProxy<()>,
    held_keys: HeldKeys,
    has_clipboard: bool,
    window: Arc<Window>,
    last_frame: Instant,
    pointer_moved: Instant,
    /// When the oldest event arrived whose effect no frame has shown yet.
    unshown_since: Option<Instant>,
    frames_to_draw: u32,
    /// Whether the viewer has nothing to do until the next event.
    idle: bool,
    /// Whether a control was held, or the camera or the focal plane was moving, in the last frame.
    dragging: bool,
    /// The title of the window.
    title: String,
    telemetry: Telemetry,
    loader: Loader,
    /// The number of times that the device was lost.
    losses: u32,
    occluded: bool,
}

impl Viewer {
    pub(super) fn new(options: Options, waker: EventLoopProxy<()>) -> Self {
        Self { options, waker, open: None, closing: None, instance: None, error: None }
    }

    /// Waits for the loader, and returns the error that ended the viewer, if there was one.
    pub(super) fn finish(self) -> Result<()> {
        drop((self.open, self.closing));
        self.error.map_or(Ok(()), Err)?;
        self.instance.map_or(Ok(()), |instance| instance.check_validation())
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let display = event_loop.display_handle().map_err(|error| Error::Window(error.to_string()))?;
        let instance = Instance::new(self.options.device.validation, Some(display.as_raw()))?;
        self.instance = Some(Arc::clone(&instance));
        self.open = Some(OpenWindow::new(event_loop, &self.options, &instance, &self.waker)?);
        Ok(())
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: Error) {
        self.error.get_or_insert(error);
        event_loop.exit();
    }
}

impl ApplicationHandler for Viewer {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.open.is_none()
            && let Err(error) = self.open(event_loop)
        {
            self.fail(event_loop, error);
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, window_id: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else {
            return;
        };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => {
                let drawn = match open.frame() {
                    Err(error @ Error::DeviceLost { .. }) => open.reopen(error, &self.waker),
                    drawn => drawn,
                };
                if let Err(error) = drawn {
                    self.fail(event_loop, error);
                }
            }
            event => {
                match event {
                    WindowEvent::Resized(_) => open.graphics.refit(),
                    WindowEvent::DroppedFile(ref path) => open.panel.open(path),
                    WindowEvent::CursorMoved { .. } => open.pointer_moved = Instant::now(),
                    WindowEvent::Occluded(occluded) => open.occluded = occluded,
                    _ => {}
                }
                let more = u32::from(report_input(&event));
                open.frames_to_draw =
                    (open.frames_to_draw + more).clamp(FRAMES_AFTER_EVENT, MAX_FRAMES_TO_DRAW);
                open.unshown_since.get_or_insert_with(Instant::now);
                let scale = open.platform.hidpi_factor();
                open.held_keys.take(&event, open.imgui.io_mut());
                let event: Event<()> = Event::WindowEvent { window_id, event };
                open.platform.handle_event(open.imgui.io_mut(), &open.window, &event);
                if open.platform.hidpi_factor() != scale {
                    open.load_fonts();
                    if let Err(error) = open.graphics.reload_fonts() {
                        self.fail(event_loop, error);
                    }
                }
            }
        }
    }

    /// Another thread has something ready.
    fn user_event(&mut self, _event_loop: &ActiveEventLoop, (): ()) {
        if let Some(open) = &mut self.open {
            open.frames_to_draw = open.frames_to_draw.max(FRAMES_AFTER_EVENT);
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Some(open) = &mut self.open else {
            return;
        };
        // Drawing waits for the display, so asking for the next frame at once does not spin.
        let fades_at = open.panel.messages.fades_at();
        let fades = fades_at.is_some_and(|at| at <= Instant::now());
        let busy = open.frames_to_draw > 0 || fades || !(open.graphics.finished() || open.rests());
        let busy = busy && !open.is_hidden();
        if busy {
            open.window.request_redraw();
        }
        let idle = !busy && open.graphics.has_started() && !open.loader.is_busy();
        if idle && !open.idle {
            log::trace!("{}", telemetry::IDLE);
        }
        open.idle = idle;
        event_loop.set_control_flow(if open.last_frame.elapsed() < MAY_BE_PRESENTING {
            ControlFlow::wait_duration(LOOK_AGAIN)
        } else {
            fades_at.map_or(ControlFlow::Wait, ControlFlow::WaitUntil)
        });
    }

    fn exiting(&mut self, _event_loop: &ActiveEventLoop) {
        // Settings that ended the viewer must not end it again at the next start.
        if let Some(open) = self.open.as_ref().filter(|_| self.error.is_none()) {
            let mut sizes = self.options.memory.sizes.clone();
            let size = open.window.inner_size();
            sizes.insert(percent(open.window.scale_factor()), [size.width, size.height]);
            open.panel.memory(sizes).save();
        }
        // The loader cannot end in the middle of a step. So the window closes before the loader is waited for.
        self.closing = self.open.take().map(OpenWindow::close);
    }
}

/// The scale of the display on which the window will probably open.
fn scale_of(event_loop: &ActiveEventLoop) -> f64 {
    let monitor = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
    monitor.map_or(1.0, |monitor| monitor.scale_factor())
}

fn percent(scale: f64) -> u32 {
    (100.0 * scale).round() as u32
}

/// The part of a window of this many pixels that the picture takes.
fn area(panel: &Panel, window: [u32; 2], scale: f64) -> Area {
    let scale = scale as f32;
    let [width, height] = window.map(|extent| extent as f32 / scale);
    Area::beside([panel.column(width), panel.strip(height)], window, scale)
}

/// Writes input events to the log. Returns whether a button or a key changed.
fn report_input(event: &WindowEvent) -> bool {
    let state = match event {
        WindowEvent::MouseInput { state, .. } => state,
        // When the window gets the focus, winit reports held keys again in made-up events.
        WindowEvent::KeyboardInput { event, is_synthetic: false, .. } if !event.repeat => &event.state,
        WindowEvent::CursorMoved { position, .. } => {
            log::trace!("{} {} {}", telemetry::POINTER_AT, position.x, position.y);
            return false;
        }
        WindowEvent::CursorLeft { .. } => {
            log::trace!("{}", telemetry::POINTER_LEFT);
            return false;
        }
        WindowEvent::MouseWheel { .. } => {
            log::trace!("{} Turned", telemetry::INPUT);
            return false;
        }
        _ => return false,
    };
    log::trace!("{} {state:?}", telemetry::INPUT);
    true
}

impl OpenWindow {
    fn new(
        event_loop: &ActiveEventLoop,
        options: &Options,
        instance: &Arc<Instance>,
        waker: &EventLoopProxy<()>,
    ) -> Result<Self> {
        let mut panel = Panel::new(options);
        let scale = scale_of(event_loop);
        let [width, height] = match (options.size, options.memory.sizes.get(&percent(scale))) {
            // The panel stands beside the picture, and the drawing of the optics below it.
            (Some([width, height]), _) => {
                let pixels = |points: f32| (f64::from(points) * scale).round() as u32;
                [width + pixels(panel.column(f32::INFINITY)), height + pixels(panel.strip(f32::INFINITY))]
            }
            (None, Some(size)) => *size,
            (None, None) => DEFAULT_SIZE.map(|points| (points * scale).round() as u32),
        };
        let attributes = Window::default_attributes()
            .with_title(panel.title())
            .with_min_inner_size(PhysicalSize::new(64, 64))
            .with_inner_size(PhysicalSize::new(width, height));
        let window = event_loop.create_window(attributes);
        let window = Arc::new(window.map_err(|error| Error::Window(error.to_string()))?);
        let size = window.inner_size();
        let area = panel.picture_in(area(&panel, [size.width, size.height], window.scale_factor()));
        panel.settings.estimator.size = area.pixels.map(|extent| extent.clamp(1, MAX_EXTENT));
        let graphics = Graphics::new(&window, instance, &options.device)?;
        let loader = Loader::new(graphics.device(), &panel.settings, waker.clone());

        let mut imgui = imgui::Context::create();
        imgui.set_ini_filename(memory::file("windows.ini"));
        let clipboard = Clipboard::new();
        let has_clipboard = clipboard.is_there();
        imgui.set_clipboard_backend(clipboard);
        imgui.io_mut().config_windows_move_from_title_bar_only = true;
        imgui.io_mut().hover_delay_normal = TOOLTIP_DELAY.as_secs_f32();
        imgui.io_mut().config_flags |= imgui::ConfigFlags::NAV_ENABLE_KEYBOARD;
        let mut platform = WinitPlatform::new(&mut imgui);
        platform.attach_window(imgui.io_mut(), &window, HiDpiMode::Default);
        let mut open = Self {
            graphics,
            platform,
            imgui,
            history: History::new(panel.state()),
            panel,
            waker: waker.clone(),
            focus: Focus::default(),
            navigate: Navigate::default(),
            held_keys: HeldKeys::default(),
            has_clipboard,
            window,
            last_frame: Instant::now(),
            pointer_moved: Instant::now(),
            unshown_since: None,
            frames_to_draw: FRAMES_AFTER_EVENT,
            idle: false,
            dragging: false,
            title: String::new(),
            telemetry: Telemetry::default(),
            loader,
            losses: 0,
            occluded: false,
        };
        open.load_fonts();
        theme::apply(open.imgui.style_mut());
        Ok(open)
    }

    /// Closes the window, and returns the loader, which may still be busy.
    fn close(self) -> Loader {
        self.window.set_visible(false);
        let Self { graphics, window, loader, .. } = self;
        drop((graphics, window));
        log::debug!("{}", telemetry::CLOSED);
        loader
    }

    fn is_hidden(&self) -> bool {
        let size = self.window.inner_size();
        self.occluded || size.width == 0 || size.height == 0 || self.window.is_minimized() == Some(true)
    }

    /// Whether rendering is paused and there is a picture to show.
    fn rests(&self) -> bool {
        self.panel.paused && self.graphics.progress().samples > 0
    }

    fn load_fonts(&mut self) {
        let scale = self.platform.hidpi_factor() as f32;
        theme::load_letters(self.imgui.fonts(), scale);
        self.imgui.io_mut().font_global_scale = scale.recip();
    }
}
