//! What happens in a frame of the viewer: input, the renderer's settings, and drawing.

use super::super::area::Area;
use super::super::focus::Focus;
use super::super::graphics::{Answer, Wanted};
use super::super::guide::Guide;
use super::super::lesson::Lesson;
use super::super::loader::{Loader, Ready};
use super::super::message::{Kind, Offer};
use super::super::panel::Panel;
use super::super::ui::{Action, Status};
use super::super::{keys, navigate, telemetry};
use super::{FRAMES_AFTER_EVENT, OpenWindow, TOOLTIP_DELAY, area};
use crate::error::{Error, Result};
use crate::renderer::Pace;
use crate::vulkan::AcquiredImage;
use imgui::Key;
use std::time::{Duration, Instant};
use winit::event_loop::EventLoopProxy;

/// Tracing time per frame while a control is held. It is short so that the picture follows the pointer: an event waits
/// for the frame that is being drawn and then for the frame that shows it.
const DRAGGING_BUDGET: Duration = Duration::from_millis(4);
/// Tracing time per frame otherwise: most of a frame, but short enough that the window stays responsive.
const RESTING_BUDGET: Duration = Duration::from_millis(30);
/// The viewer ends if the device is lost more often than this.
const MAX_LOSSES: u32 = 3;

impl OpenWindow {
    pub(super) fn frame(&mut self) -> Result<()> {
        let Some((image, size)) = self.begin_frame()? else {
            return Ok(());
        };
        let room = area(&self.panel, size, self.platform.hidpi_factor());
        let area = self.panel.picture_in(room);
        let action = self.interact(&room, &area);
        self.apply(action, area.pixels)?;
        self.name_window();
        self.draw(&image, &area)?;
        self.telemetry.report(&self.panel.settings, self.panel.shown(), self.graphics.progress());
        self.telemetry.report_memory(|| self.graphics.memory());
        if let Some(since) = self.unshown_since.take() {
            let milliseconds = 1e3 * since.elapsed().as_secs_f64();
            log::trace!("{} {milliseconds:.2} ms after its first event", telemetry::PRESENTED);
        }
        Ok(())
    }

    /// Collects the results of earlier frames, and returns the image to draw to and its size. `None` if there is no
    /// image to draw to at the moment.
    fn begin_frame(&mut self) -> Result<Option<(AcquiredImage, [u32; 2])>> {
        let size = self.window.inner_size();
        let Some(size) = self.graphics.fit([size.width, size.height], &mut self.imgui)? else {
            return Ok(None);
        };
        log::trace!("{}", telemetry::FRAME);
        self.frames_to_draw = self.frames_to_draw.saturating_sub(1);
        let answer = self.graphics.wait_for_frame(self.dragging)?;
        if self.graphics.take_excerpt() {
            // This frame shows it, and the next one may read another one.
            self.frames_to_draw = self.frames_to_draw.max(FRAMES_AFTER_EVENT);
        }
        if let Some(Answer(picked)) = answer {
            match self.focus.answer(picked, &mut self.panel) {
                Some(Ok(said)) => self.panel.messages.say(said),
                Some(Err(failed)) => self.panel.messages.fail(failed),
                None => {}
            }
        }
        let Some(image) = self.graphics.acquire()? else {
            self.frames_to_draw += 1;
            return Ok(None);
        };
        let io = self.imgui.io_mut();
        io.update_delta_time(self.last_frame.elapsed());
        self.last_frame = Instant::now();
        // The system may refuse to move the pointer; the viewer works without that.
        if let Err(error) = self.platform.prepare_frame(io, &self.window) {
            log::warn!("pointer: {error}");
        }
        Ok(Some((image, size)))
    }

    /// Puts the name of the scene into the title of the window.
    fn name_window(&mut self) {
        let title = self.panel.title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }

    /// Draws the panel and handles the input of the mouse and the keys.
    fn interact(&mut self, room: &Area, area: &Area) -> Option<Action> {
        let ui = self.imgui.new_frame();
        let preparing = (!self.graphics.has_started()).then(|| "preparing ...".into());
        let status = Status {
            progress: self.graphics.progress(),
            can_undo: self.history.can_undo(),
            can_redo: self.history.can_redo(),
            device: self.graphics.device_name(),
            picked: self.focus.under_pointer(),
            diagram: self.focus.diagram(),
            excerpt: self.graphics.excerpt(),
            thumbnails: self.graphics.thumbnails(),
            loading: self
                .loader
                .loading()
                .map(|name| format!("loading {} ...", name.display()))
                .or(preparing),
        };
        self.panel.watch_job();
        let camera = self.panel.settings.estimator.camera;
        let action = self.panel.draw(ui, &status, room, area).or_else(|| keys::pressed(ui, &self.held_keys));
        self.navigate.take_input(ui, &mut self.panel.settings.estimator, area);
        self.focus.take_input(ui, &mut self.panel, area);
        self.focus.follow(&camera, &mut self.panel);
        self.focus.advance(&mut self.panel.settings.estimator.lens);
        self.focus.draw(ui, area);
        if self.panel.optics.open && !self.panel.hidden {
            Focus::draw_pin(ui, self.panel.optics.pin, area);
        }
        // While an arrow key is held, a slider moves: that is one change.
        let steps = [Key::LeftArrow, Key::RightArrow].into_iter().any(|key| ui.is_key_down(key));
        self.dragging =
            steps || ui.is_any_item_active() || self.focus.is_gliding() || self.navigate.is_moving();
        if ui.io().want_text_input {
            self.frames_to_draw = self.frames_to_draw.max(1); // the caret blinks
        }
        if ui.io().want_capture_mouse && self.pointer_moved.elapsed() < TOOLTIP_DELAY.mul_f32(1.5) {
            self.frames_to_draw = self.frames_to_draw.max(1); // a tooltip may be about to come
        }
        if action == Some(Action::CopyCommand) {
            let line = self.panel.settings.command_line("picture.png");
            log::debug!("{} {line}", telemetry::COPIED);
            if self.has_clipboard {
                self.panel.messages.say("The command line is in the clipboard.".into());
            } else {
                self.panel.messages.fail(format!("there is no clipboard; the command line is: {line}"));
            }
            ui.set_clipboard_text(line);
        }
        self.platform.prepare_render(ui, &self.window);
        action
    }

    /// Performs the action, and passes the settings to the renderer once what they need is ready.
    fn apply(&mut self, action: Option<Action>, size: [u32; 2]) -> Result<()> {
        if self.panel.held.is_some() && !self.graphics.holds(size) {
            self.panel.held = None;
            self.graphics.let_go()?;
            self.panel
                .messages
                .say("The held picture is gone: it does not fit the picture's new size.".into());
        }
        let chosen = self.panel.watch_dialog().map(saving);
        let is_done = self.panel.save_when_done && self.graphics.has_started() && self.graphics.finished();
        self.panel.save_when_done &= !is_done;
        for action in action.into_iter().chain(is_done.then_some(Action::SavePicture)).chain(chosen) {
            self.act(action)?;
        }
        if let Some(name) = self.panel.to_open.take() {
            log::debug!("{} {}", telemetry::LOADING, name.display());
            self.loader.open(&name, &self.panel.settings);
        }
        self.panel.settings.estimator.size = size;
        if let Some(renderer) = self.loader.renderer() {
            self.graphics.start(renderer?);
        }
        if self.panel.settings.needs_colors() {
            // This takes no time, and so the picture follows the hand.
            if let Err(error) = self.panel.settings.restage() {
                self.panel.refuse(&error);
            }
        }
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
            // The loader prepares what the settings need.
            Ok(false) => {
                self.panel.accepted.settings.estimator.size = size;
                if self.graphics.has_started() {
                    self.loader.prepare(&self.panel.settings);
                }
            }
            Err(error @ Error::DeviceLost { .. }) => return Err(error),
            // For example, a scene that is too large for the device. The renderer keeps what it had.
            Err(error) => self.panel.refuse(&error),
        }
        self.graphics.go_on(self.panel.shown())
    }

    /// Shows what the other thread has prepared. Returns whether the renderer uses it now.
    fn take_ready(&mut self, size: [u32; 2]) -> Result<bool> {
        let prepared = match self.loader.next() {
            None => return Ok(false),
            Some(Ready::Prepared(ready)) => {
                let (mut settings, prepared) = *ready?;
                if settings.estimator.stage == self.panel.settings.estimator.stage {
                    // Whatever else has changed meanwhile stays changed.
                    self.panel.set_stage(&settings.estimator.scene);
                } else {
                    // The model has been turned on meanwhile, and is shown as it stood on the way.
                    settings.estimator.size = size;
                    self.graphics.set_prepared(&settings, &prepared)?;
                    self.panel.accepted.settings = settings;
                    return Ok(false);
                }
                prepared
            }
            Some(Ready::Opened { name, opened: Ok(opened) }) => {
                let (content, prepared) = *opened;
                log::debug!("{} {}", telemetry::LOADED, name.display());
                self.panel.show(&name, &content);
                self.panel.settings.estimator.size = size;
                self.focus.leave_scene();
                prepared
            }
            Some(Ready::Opened { opened: Err(error @ Error::DeviceLost { .. }), .. }) => return Err(error),
            Some(Ready::Opened { name, opened: Err(error) }) => {
                // The settings stay as they are.
                self.panel.was_not_opened(&name, &error);
                return Ok(false);
            }
        };
        // The settings may have changed while the other thread worked.
        let fits = prepared.fits(&self.panel.settings, true);
        if fits {
            self.graphics.set_prepared(&self.panel.settings, &prepared)?;
        }
        Ok(fits)
    }

    /// Continues the picture, and shows it with the panel on top.
    fn draw(&mut self, image: &AcquiredImage, area: &Area) -> Result<()> {
        let finished_before = self.graphics.finished();
        let budget = if self.dragging { DRAGGING_BUDGET } else { RESTING_BUDGET };
        let pace = (!self.rests()).then_some(Pace { budget, preview: true });
        let optics = &self.panel.optics;
        let drawn = optics.open.then_some((optics.pin, optics.rays));
        let can_ask = self.graphics.answers();
        let question = if can_ask { self.focus.question(&self.panel.shown().estimator, drawn) } else { None };
        let split = self.panel.held.as_ref().map_or(0.0, |held| held.share * area.pixels[0] as f32);
        let excerpt =
            (optics.open && optics.view.is_section()).then(|| (optics.pin.pixel(area.pixels), optics.reach));
        let wanted = Wanted { question, excerpt };
        self.graphics.draw(image, &mut self.imgui, pace, wanted, area.corner, split.round() as u32)?;
        if self.focus.is_busy() || self.navigate.is_moving() {
            self.frames_to_draw = self.frames_to_draw.max(1);
        }
        if !finished_before && self.graphics.finished() {
            // The picture is on the screen already, but the figures in the panel are one frame late.
            self.frames_to_draw = self.frames_to_draw.max(FRAMES_AFTER_EVENT);
        }
        Ok(())
    }

    /// Opens the device again after it was lost, and continues with the settings that were shown.
    pub(super) fn reopen(&mut self, error: Error, waker: &EventLoopProxy<()>) -> Result<()> {
        self.losses += 1;
        if self.losses > MAX_LOSSES {
            return Err(error);
        }
        log::warn!("{error}");
        self.graphics = self.graphics.reopen()?;
        self.loader = Loader::new(self.graphics.device(), self.panel.shown(), waker.clone());
        self.focus.forget();
        self.panel.held = None;
        self.panel.messages.fail(format!("{error}. It is open again."));
        self.frames_to_draw = FRAMES_AFTER_EVENT;
        Ok(())
    }

    fn act(&mut self, action: Action) -> Result<()> {
        if matches!(action, Action::Undo | Action::Redo | Action::Reset) {
            // A change that is still going on becomes an entry of its own in the history.
            self.focus.stop();
            self.history.record(&self.panel.state());
        }
        match action {
            Action::Compare | Action::SavePicture if !self.graphics.has_started() => {
                self.panel.messages.fail("there is no picture yet".into());
            }
            Action::Autofocus => {
                self.focus.send_to(self.panel.settings.estimator.size.map(|extent| 0.5 * extent as f32));
            }
            Action::PickFocus => {
                let guide = &mut self.panel.guide;
                *guide = (*guide != Some(Guide::Focus)).then_some(Guide::Focus);
            }
            Action::Reset => self.panel.reset(),
            Action::ResetCamera => self.move_camera(Panel::reset_camera),
            Action::ViewAll => self.move_camera(|panel| navigate::frame_all(&mut panel.settings.estimator)),
            Action::Undo => self.history.undo().into_iter().for_each(|state| self.panel.restore(state)),
            Action::Redo => self.history.redo().into_iter().for_each(|state| self.panel.restore(state)),
            Action::Compare => self.compare()?,
            Action::Pause => self.panel.paused ^= true,
            Action::Optics => self.panel.optics.open ^= true,
            Action::Keys => self.panel.keys ^= true,
            Action::Lesson => {
                let panel = &mut self.panel;
                panel.lesson = if panel.lesson.is_some() { None } else { Some(Lesson::new(panel.seen())) };
            }
            Action::Hide => {
                self.panel.hidden ^= true;
                if self.panel.hidden {
                    self.panel.messages.say("Press H to show the panel again.".into());
                }
            }
            // `interact` has done it already, because imgui owns the clipboard.
            Action::CopyCommand => {}
            Action::Browse(purpose) => {
                // One at a time.
                if self.panel.dialog.is_none() {
                    let waker = self.waker.clone();
                    // Sending fails only when the window has closed.
                    self.panel.browse(purpose, &self.window, move || {
                        let _ = waker.send_event(());
                    });
                }
            }
            Action::SaveScene => self.panel.save_scene(),
            Action::SaveWhenDone => self.panel.save_when_done ^= true,
            Action::Render => {
                let (device, waker) = (self.graphics.device_name(), self.waker.clone());
                // Sending fails only when the window has closed.
                self.panel.render_to_file(device, move || {
                    let _ = waker.send_event(());
                });
            }
            Action::Accept(offer) => return self.accept(offer),
            Action::SavePicture => {
                if let Some(file) = self.panel.file_for(Kind::Picture) {
                    match self.graphics.save(self.panel.shown(), &file) {
                        Ok(()) => self.panel.picture_is_saved(&file, self.graphics.progress().samples),
                        Err(error) => self.panel.messages.fail(error.to_string()),
                    }
                }
            }
        }
        Ok(())
    }

    /// Does what a message offered.
    fn accept(&mut self, offer: Offer) -> Result<()> {
        let kind = match offer {
            Offer::SaveWhenDone => {
                self.panel.save_when_done = true;
                return Ok(());
            }
            Offer::UseAsAperture => {
                self.panel.use_image();
                return Ok(());
            }
            Offer::Replace(kind) => {
                self.panel.save_as(kind).replaces = true;
                kind
            }
            Offer::KeepBoth(kind) => {
                self.panel.save_as(kind).offered = true;
                kind
            }
        };
        self.act(saving(kind))
    }

    /// Moves the camera at once. The focal plane follows what was focused on.
    fn move_camera(&mut self, mover: impl FnOnce(&mut Panel)) {
        let camera = self.panel.settings.estimator.camera;
        mover(&mut self.panel);
        self.focus.follow(&camera, &mut self.panel);
    }

    /// Holds the picture on the left for comparison, or releases it.
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

/// The action that saves this.
fn saving(kind: Kind) -> Action {
    match kind {
        Kind::Picture => Action::SavePicture,
        Kind::Scene => Action::SaveScene,
    }
}
