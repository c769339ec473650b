//! The window and its events.

use super::Options;
use super::clipboard::Clipboard;
use super::focus::Focus;
use super::graphics::{Answer, Graphics};
use super::history::History;
use super::keys::Modifiers;
use super::loader::Ready;
use super::navigate::Navigate;
use super::panel::{Panel, State};
use super::telemetry::{self, Telemetry};
use super::ui::{Action, Status};
use super::{keys, memory};
use crate::error::{Error, Result};
use crate::renderer::Pace;
use crate::scene::MAX_EXTENT;
use crate::vulkan::{AcquiredImage, Instance};
use imgui_winit_support::{HiDpiMode, WinitPlatform};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{Event, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::raw_window_handle::HasDisplayHandle;
use winit::window::{Window, WindowId};

const DEFAULT_SIZE: [u32; 2] = [1280, 720];
/// Tracing time a frame while a control is held, so that it follows the hand: an event waits for the frame
/// under way and then for its own.
const DRAGGING_BUDGET: Duration = Duration::from_millis(4);
/// Otherwise: most of a frame, and the window still answers.
const RESTING_BUDGET: Duration = Duration::from_millis(30);
/// imgui takes a frame to notice an event and one more to draw what it did.
const FRAMES_AFTER_EVENT: u32 = 3;
/// It takes presses and releases that come at once a frame each: so many are waited for at most.
const MOST_FRAMES_TO_DRAW: u32 = 30;
/// A thread of the driver that presents frames reads from the window's connection too, and may take in an event on
/// the way, which winit then sleeps on until the next one comes (seen with Mesa 25). So while a frame may still be
/// on its way to the screen, winit looks again this often,
const LOOK_AGAIN: Duration = Duration::from_millis(20);
/// and for this long.
const MAY_BE_PRESENTING: Duration = Duration::from_secs(5);

/// A device that is lost more often than this is not opened again.
const MOST_LOSSES: u32 = 3;

/// The application as winit drives it.
pub(super) struct Viewer {
    options: Options,
    /// Wakes the event loop from another thread.
    waker: EventLoopProxy<()>,
    open: Option<Open>,
    instance: Option<Arc<Instance>>,
    error: Option<Error>,
}

struct Open {
    graphics: Graphics,
    platform: WinitPlatform,
    imgui: imgui::Context,
    panel: Panel,
    focus: Focus,
    navigate: Navigate,
    history: History<State>,
    modifiers: Modifiers,
    has_clipboard: bool,
    window: Arc<Window>,
    last_frame: Instant,
    /// When the first event came that no frame has shown yet.
    unshown_since: Option<Instant>,
    frames_to_draw: u32,
    /// Whether it waits for an event.
    idle: bool,
    /// Whether the last frame had a control held.
    dragging: bool,
    telemetry: Telemetry,
    /// How often the device was lost.
    losses: u32,
    occluded: bool,
}

impl Viewer {
    pub(super) fn new(options: Options, waker: EventLoopProxy<()>) -> Self {
        Self { options, waker, open: None, instance: None, error: None }
    }

    /// Closes the window, if it is still open, and says what ended the viewer.
    pub(super) fn finish(self) -> Result<()> {
        drop(self.open);
        self.error.map_or(Ok(()), Err)?;
        self.instance.map_or(Ok(()), |instance| instance.check_validation())
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let display = event_loop.display_handle().map_err(|error| Error::Window(error.to_string()))?;
        let instance = Instance::new(self.options.device.validation, Some(display.as_raw()))?;
        self.instance = Some(Arc::clone(&instance));
        self.open = Some(Open::new(event_loop, &self.options, &instance, &self.waker)?);
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
                    Err(error @ Error::DeviceLost { .. }) => open.reopen(error),
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
                    WindowEvent::Occluded(occluded) => open.occluded = occluded,
                    _ => {}
                }
                let more = u32::from(report_input(&event));
                open.frames_to_draw =
                    (open.frames_to_draw + more).clamp(FRAMES_AFTER_EVENT, MOST_FRAMES_TO_DRAW);
                open.unshown_since.get_or_insert_with(Instant::now);
                let scale = open.platform.hidpi_factor();
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

    /// Something is ready that another thread has made.
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
        let busy = open.frames_to_draw > 0 || !(open.graphics.finished() || open.rests());
        let busy = busy && !open.is_hidden();
        if busy {
            open.window.request_redraw();
        }
        let idle = !busy && !open.graphics.loader.is_busy();
        if idle && !open.idle {
            log::trace!("{}", telemetry::IDLE);
        }
        open.idle = idle;
        event_loop.set_control_flow(if open.last_frame.elapsed() < MAY_BE_PRESENTING {
            ControlFlow::wait_duration(LOOK_AGAIN)
        } else {
            ControlFlow::Wait
        });
    }

    fn exiting(&mut self, _event_loop: &ActiveEventLoop) {
        // What could not be shown is not to be met again.
        if let Some(open) = self.open.as_ref().filter(|_| self.error.is_none()) {
            open.panel.memory().save();
        }
        self.open = None;
    }
}

/// Says in the log what came from the hand, and gives whether a button or a key changed.
fn report_input(event: &WindowEvent) -> bool {
    let state = match event {
        WindowEvent::MouseInput { state, .. } => state,
        // What is held when the window gets the focus comes twice, once made up.
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

impl Open {
    fn new(
        event_loop: &ActiveEventLoop,
        options: &Options,
        instance: &Arc<Instance>,
        waker: &EventLoopProxy<()>,
    ) -> Result<Self> {
        let [width, height] = options.size.or(options.memory.size).unwrap_or(DEFAULT_SIZE);
        let attributes = Window::default_attributes()
            .with_title("thinlens")
            .with_min_inner_size(PhysicalSize::new(64, 64))
            .with_inner_size(PhysicalSize::new(width, height));
        let window = event_loop.create_window(attributes);
        let window = Arc::new(window.map_err(|error| Error::Window(error.to_string()))?);
        let mut panel = Panel::new(options);
        let size = window.inner_size();
        panel.settings.estimator.size = [size.width, size.height].map(|extent| extent.clamp(1, MAX_EXTENT));
        let graphics = Graphics::new(&window, instance, &options.device, waker, &panel.settings)?;

        let mut imgui = imgui::Context::create();
        imgui.set_ini_filename(memory::file("windows.ini"));
        let clipboard = Clipboard::new();
        let has_clipboard = clipboard.is_there();
        imgui.set_clipboard_backend(clipboard);
        imgui.io_mut().config_windows_move_from_title_bar_only = true;
        imgui.io_mut().config_flags |=
            imgui::ConfigFlags::NAV_ENABLE_KEYBOARD | imgui::ConfigFlags::DOCKING_ENABLE;
        let mut platform = WinitPlatform::new(&mut imgui);
        platform.attach_window(imgui.io_mut(), &window, HiDpiMode::Default);
        let mut open = Self {
            graphics,
            platform,
            imgui,
            history: History::new(panel.state()),
            panel,
            focus: Focus::default(),
            navigate: Navigate::default(),
            modifiers: Modifiers::default(),
            has_clipboard,
            window,
            last_frame: Instant::now(),
            unshown_since: None,
            frames_to_draw: FRAMES_AFTER_EVENT,
            idle: false,
            dragging: false,
            telemetry: Telemetry::default(),
            losses: 0,
            occluded: false,
        };
        open.load_fonts();
        open.style();
        Ok(open)
    }

    fn is_hidden(&self) -> bool {
        let size = self.window.inner_size();
        self.occluded || size.width == 0 || size.height == 0 || self.window.is_minimized() == Some(true)
    }

    /// Whether the picture is to stay as it is, and there is one.
    fn rests(&self) -> bool {
        self.panel.paused && self.graphics.progress().samples > 0
    }

    fn load_fonts(&mut self) {
        let scale = self.platform.hidpi_factor() as f32;
        let fonts = self.imgui.fonts();
        fonts.clear();
        fonts.add_font(&[imgui::FontSource::TtfData {
            data: epaint_default_fonts::UBUNTU_LIGHT,
            size_pixels: 16.0 * scale,
            config: None,
        }]);
        self.imgui.io_mut().font_global_scale = scale.recip();
    }

    fn style(&mut self) {
        let style = self.imgui.style_mut();
        style.use_dark_colors();
        style.window_rounding = 6.0;
        style.frame_rounding = 4.0;
        style.grab_rounding = 4.0;
        style.window_padding = [12.0, 10.0];
        style.frame_padding = [8.0, 4.0];
        style.item_spacing = [8.0, 6.0];
        style.colors[imgui::StyleColor::WindowBg as usize] = [0.08, 0.09, 0.11, 0.88];
        style.colors[imgui::StyleColor::TitleBg as usize] = [0.12, 0.19, 0.29, 0.95];
        style.colors[imgui::StyleColor::PopupBg as usize] = [0.08, 0.09, 0.11, 0.98];
        style.colors[imgui::StyleColor::PlotHistogram as usize] = [0.20, 0.45, 0.80, 1.0];
    }

    fn frame(&mut self) -> Result<()> {
        let Some((image, size)) = self.begin_frame()? else {
            return Ok(());
        };
        let action = self.interact(size);
        self.apply(action, size)?;
        self.draw(&image, size)?;
        self.telemetry.report(&self.panel.settings, self.panel.shown(), self.graphics.progress());
        self.telemetry.report_memory(|| self.graphics.memory());
        if let Some(since) = self.unshown_since.take() {
            let milliseconds = 1e3 * since.elapsed().as_secs_f64();
            log::trace!("{} {milliseconds:.2} ms after its first event", telemetry::PRESENTED);
        }
        Ok(())
    }

    /// Takes in what the device has done, and gives the image to draw to and its size. None where there is none now.
    fn begin_frame(&mut self) -> Result<Option<(AcquiredImage, [u32; 2])>> {
        let size = self.window.inner_size();
        let Some(size) = self.graphics.fit([size.width, size.height], &mut self.imgui)? else {
            return Ok(None);
        };
        log::trace!("{}", telemetry::FRAME);
        self.frames_to_draw = self.frames_to_draw.saturating_sub(1);
        let answer = self.graphics.wait_for_frame(self.dragging)?;
        if let Some(Answer(picked)) = answer {
            self.focus.answer(picked, &self.panel.settings.estimator.lens);
        }
        let Some(image) = self.graphics.acquire()? else {
            self.frames_to_draw += 1;
            return Ok(None);
        };
        let io = self.imgui.io_mut();
        io.update_delta_time(self.last_frame.elapsed());
        self.last_frame = Instant::now();
        // A pointer that the system will not move is no reason to stop.
        if let Err(error) = self.platform.prepare_frame(io, &self.window) {
            log::warn!("pointer: {error}");
        }
        Ok(Some((image, size)))
    }

    /// Draws the panel, and takes in what the hand did.
    fn interact(&mut self, size: [u32; 2]) -> Option<Action> {
        let ui = self.imgui.new_frame();
        ui.dockspace_over_main_viewport();
        let loader = &self.graphics.loader;
        let status = Status {
            progress: self.graphics.progress(),
            device: self.graphics.device_name(),
            picked: self.focus.under_pointer(),
            diagram: self.focus.diagram(),
            loading: loader.opening().map(|name| format!("loading {} ...", name.display())),
        };
        let modifiers = self.modifiers.take(ui);
        let action = self.panel.draw(ui, &status).or_else(|| keys::pressed(ui, modifiers));
        keys::help(ui, &mut self.panel.keys);
        self.navigate.take_input(ui, modifiers, &mut self.panel.settings.estimator.camera);
        let lens = &mut self.panel.settings.estimator.lens;
        self.focus.take_input(ui, modifiers, lens, size);
        self.focus.advance(lens);
        self.focus.draw(ui);
        if self.panel.optics.open {
            self.focus.draw_pin(ui);
        }
        self.dragging = ui.is_any_item_active() || self.focus.is_gliding() || self.navigate.is_moving();
        if ui.io().want_text_input {
            self.frames_to_draw = self.frames_to_draw.max(1); // the caret blinks
        }
        if action == Some(Action::CopyCommand) {
            let line = self.panel.settings.command_line("picture.png");
            log::debug!("{} {line}", telemetry::COPIED);
            self.panel.say(if self.has_clipboard {
                "The command line is in the clipboard.".into()
            } else {
                format!("there is no clipboard; the command line is: {line}")
            });
            ui.set_clipboard_text(line);
        }
        self.platform.prepare_render(ui, &self.window);
        action
    }

    /// Does what was asked for, and has the renderer follow the settings as soon as it can.
    fn apply(&mut self, action: Option<Action>, size: [u32; 2]) -> Result<()> {
        if self.panel.held.is_some() && !self.graphics.holds() {
            self.panel.held = None;
            self.graphics.let_go()?;
            self.panel.say("The held picture is gone: it does not fit the window any more.".into());
        }
        if let Some(action) = action {
            self.act(action)?;
        }
        if let Some(name) = self.panel.to_open.take() {
            log::debug!("{} {}", telemetry::LOADING, name.display());
            self.graphics.loader.open(&name, &self.panel.settings);
        }
        self.panel.settings.estimator.size = size;
        let mut set = self.take_ready(size);
        if let Ok(false) = set {
            set = self.graphics.set(&self.panel.settings);
        }
        match set {
            Ok(true) => {
                self.panel.accept();
                if !self.dragging {
                    self.history.record(&self.panel.state());
                }
                return Ok(());
            }
            // It is being made ready.
            Ok(false) => self.panel.accepted.settings.estimator.size = size,
            Err(error @ Error::DeviceLost { .. }) => return Err(error),
            // A scene that does not fit, say. The renderer still has what it had.
            Err(error) => self.panel.refuse(&error),
        }
        self.graphics.go_on(self.panel.shown())
    }

    /// Shows what the other thread has made ready. True where the renderer has it.
    fn take_ready(&mut self, size: [u32; 2]) -> Result<bool> {
        let prepared = match self.graphics.loader.next() {
            None => return Ok(false),
            Some(Ready::Prepared(prepared)) => prepared?,
            Some(Ready::Opened { name, opened: Ok(opened) }) => {
                let (content, prepared) = *opened;
                log::debug!("{} {}", telemetry::LOADED, name.display());
                self.panel.show(&name, &content);
                self.panel.settings.estimator.size = size;
                self.focus.stop();
                prepared
            }
            Some(Ready::Opened { opened: Err(error @ Error::DeviceLost { .. }), .. }) => return Err(error),
            Some(Ready::Opened { opened: Err(error), .. }) => {
                // What is set stays.
                self.panel.say(error.to_string());
                return Ok(false);
            }
        };
        // Something may have changed meanwhile.
        let fits = prepared.fits(&self.panel.settings, true);
        if fits {
            self.graphics.set_prepared(&self.panel.settings, &prepared)?;
        }
        Ok(fits)
    }

    /// Goes on with the picture, and shows it with the panel.
    fn draw(&mut self, image: &AcquiredImage, size: [u32; 2]) -> Result<()> {
        let finished_before = self.graphics.finished();
        let budget = if self.dragging { DRAGGING_BUDGET } else { RESTING_BUDGET };
        let pace = (!self.rests()).then_some(Pace { budget, preview: true });
        let rays = self.panel.optics.open.then_some(self.panel.optics.rays);
        let can_ask = self.graphics.answers();
        let question = if can_ask { self.focus.question(&self.panel.shown().estimator, rays) } else { None };
        let split = self.panel.held.as_ref().map_or(0.0, |held| held.share * size[0] as f32);
        self.graphics.draw(image, &mut self.imgui, pace, question, split.round() as u32)?;
        if self.focus.is_busy() || self.navigate.is_moving() {
            self.frames_to_draw = self.frames_to_draw.max(1);
        }
        if !finished_before && self.graphics.finished() {
            // What was just recorded is on the screen; the panel's figures come a frame later.
            self.frames_to_draw = self.frames_to_draw.max(FRAMES_AFTER_EVENT);
        }
        Ok(())
    }

    /// Opens the device again, after it was lost, and goes on with what was shown.
    fn reopen(&mut self, error: Error) -> Result<()> {
        self.losses += 1;
        if self.losses > MOST_LOSSES {
            return Err(error);
        }
        log::warn!("{error}");
        self.graphics = self.graphics.again(self.panel.shown())?;
        self.focus.forget();
        self.panel.held = None;
        self.panel.say(format!("{error}. It is open again."));
        self.frames_to_draw = FRAMES_AFTER_EVENT;
        Ok(())
    }

    fn act(&mut self, action: Action) -> Result<()> {
        if matches!(action, Action::Undo | Action::Redo | Action::Reset) {
            // A change that is still under way ends here.
            self.focus.stop();
            self.history.record(&self.panel.state());
        }
        match action {
            Action::Autofocus => {
                self.focus.send_to(self.panel.settings.estimator.size.map(|extent| 0.5 * extent as f32));
            }
            Action::Reset => self.panel.reset(),
            Action::ResetCamera => self.panel.reset_camera(),
            Action::Undo => self.history.undo().into_iter().for_each(|state| self.panel.restore(state)),
            Action::Redo => self.history.redo().into_iter().for_each(|state| self.panel.restore(state)),
            Action::Compare => self.compare()?,
            Action::Pause => self.panel.paused ^= true,
            Action::Optics => self.panel.optics.open ^= true,
            Action::Keys => self.panel.keys ^= true,
            // Done where imgui, which has the clipboard, is at hand.
            Action::CopyCommand => {}
            Action::SaveScene => self.panel.save_scene(),
            Action::SavePicture => {
                let file = self.panel.picture_file();
                match self.graphics.save(self.panel.shown(), Path::new(&file)) {
                    Ok(()) => self.panel.picture_is_saved(),
                    Err(error) => self.panel.say(error.to_string()),
                }
            }
        }
        Ok(())
    }

    /// Holds the picture on the left, or lets it go.
    fn compare(&mut self) -> Result<()> {
        if self.panel.held.is_some() {
            self.panel.held = None;
            return self.graphics.let_go();
        }
        self.graphics.hold()?;
        self.panel.hold();
        Ok(())
    }
}
