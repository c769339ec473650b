//! What the viewer says in its log, and how a test waits for it.

use super::{PATIENCE, Viewer};
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};
use thinlens::app::telemetry;

impl Viewer {
    /// Takes in the next line of the log, if one comes in time.
    pub fn listen(&self, patience: Duration) -> Option<String> {
        let line = match self.lines.recv_timeout(patience) {
            Ok(line) => line,
            Err(RecvTimeoutError::Timeout) => return None,
            Err(RecvTimeoutError::Disconnected) => panic!("the viewer has ended"),
        };
        assert!(!line.contains("validation:") && !line.contains("panicked"), "{line}");
        self.idle.set(said(&line, telemetry::IDLE).is_some());
        if let Some(pointer) = said(&line, telemetry::POINTER_AT) {
            self.pointer.set(Some(numbers(pointer).try_into().expect("two numbers")));
        }
        if said(&line, telemetry::POINTER_LEFT).is_some() {
            self.pointer.set(None);
        }
        if let Some(input) = said(&line, telemetry::INPUT) {
            self.inputs.set(self.inputs.get() + 1);
            self.held.set(match input {
                "Pressed" => self.held.get() + 1,
                // What was pressed outside of the window is let go in it.
                "Released" => self.held.get().saturating_sub(1),
                _ => self.held.get(),
            });
        }
        if let Some(copied) = said(&line, telemetry::COPIED) {
            *self.copied.borrow_mut() = Some(copied.to_owned());
        }
        if let Some(control) = said(&line, telemetry::CONTROL) {
            let control = control.strip_prefix('\'').expect("a quoted name");
            let (name, place) = control.split_once("' at ").expect("a name and a place");
            let place: Vec<i32> = place.split(' ').map(|number| number.parse().expect("a number")).collect();
            self.controls.borrow_mut().insert(name.to_owned(), place.try_into().expect("four numbers"));
        }
        if let Some(state) = said(&line, telemetry::LENS) {
            *self.state.borrow_mut() = numbers(state).try_into().expect("three numbers");
        }
        if let Some(camera) = said(&line, telemetry::CAMERA) {
            *self.camera.borrow_mut() = numbers(camera).try_into().expect("six numbers");
        }
        if let Some(diagram) = said(&line, telemetry::DIAGRAM) {
            let diagram = diagram.strip_prefix('[').expect("a pixel");
            let (pixel, p) = diagram.split_once("]: p at [").expect("a pixel and p");
            let pixel = numbers(&pixel.replace(',', "")).try_into().expect("two numbers");
            let p =
                numbers(p.trim_end_matches(']').replace(',', "").as_str()).try_into().expect("three numbers");
            *self.diagram.borrow_mut() = Some((pixel, p));
        }
        if let Some(opened) = said(&line, telemetry::LOADED) {
            opened.clone_into(&mut self.opened.borrow_mut());
        }
        if let Some(message) = said(&line, telemetry::MESSAGE) {
            message.clone_into(&mut self.message.borrow_mut());
        }
        if let Some(view) = said(&line, telemetry::VIEW) {
            view.clone_into(&mut self.view.borrow_mut());
        }
        if let Some((_, memory)) = said(&line, telemetry::MEMORY).and_then(|memory| memory.split_once(": ")) {
            let named = memory.trim_matches(['[', ']', '(', ')']).split("), (").map(|allocation| {
                let (name, bytes) = allocation.rsplit_once(", ").expect("a name and bytes");
                (name.to_owned(), bytes.parse().expect("a number"))
            });
            *self.memory.borrow_mut() = named.collect();
        }
        if let Some(shown) = said(&line, telemetry::SHOWN) {
            shown.clone_into(&mut self.last_shown.borrow_mut());
            let (samples, target) = shown.split_once('/').expect("two numbers");
            let target = target.split(' ').next().expect("a number");
            *self.shown.borrow_mut() =
                (samples.parse().expect("a number"), target.parse().expect("a number"));
            self.history.borrow_mut().push(self.shown.borrow().0);
        }
        Some(line)
    }

    /// Takes in the log up to a line that says this, and gives the number of frames that began before it.
    pub fn frames_until(&self, what: &str) -> usize {
        let deadline = Instant::now() + PATIENCE;
        let mut frames = 0;
        loop {
            assert!(Instant::now() < deadline, "no '{what}' after {frames} frames");
            match self.listen(Duration::from_millis(20)) {
                Some(line) if said(&line, what).is_some() => return frames,
                Some(line) if said(&line, telemetry::FRAME).is_some() => frames += 1,
                _ => {}
            }
        }
    }

    /// Waits until the viewer has begun that many frames more.
    pub(super) fn frames(&self, count: usize) {
        let deadline = Instant::now() + PATIENCE;
        let mut seen = 0;
        while seen < count {
            assert!(Instant::now() < deadline, "only {seen} of {count} frames");
            if self
                .listen(Duration::from_millis(20))
                .is_some_and(|line| said(&line, telemetry::FRAME).is_some())
            {
                seen += 1;
            }
        }
    }

    pub fn wait_for(&self, what: &str, reached: impl Fn(&Self) -> bool) {
        let deadline = Instant::now() + PATIENCE;
        while !reached(self) {
            assert!(
                Instant::now() < deadline,
                "no {what}; shown {:?}, lens {:?}, {} inputs, {} held, pointer {:?}",
                self.shown.borrow(),
                self.state.borrow(),
                self.inputs.get(),
                self.held.get(),
                self.pointer.get()
            );
            self.listen(Duration::from_millis(20));
        }
    }

    /// Waits until the viewer has nothing more to do.
    pub fn rest(&self) {
        self.wait_for("rest", |viewer| viewer.idle.get());
    }

    /// Waits until it shows the whole picture, and rests.
    pub fn wait_until_done(&self) {
        self.wait_for("whole picture", |viewer| {
            let (samples, target) = *viewer.shown.borrow();
            samples > 0 && samples == target && viewer.idle.get()
        });
    }
}

/// What the viewer says in a line of its log about this, if it does.
pub fn said<'a>(line: &'a str, what: &str) -> Option<&'a str> {
    let (_, said) = line.split_once("] ")?;
    let rest = said.strip_prefix(what)?;
    if rest.is_empty() { Some(rest) } else { rest.strip_prefix(' ') }
}

/// The numbers among the words of a line.
fn numbers<T: std::str::FromStr>(line: &str) -> Vec<T> {
    line.split(' ').filter_map(|number| number.parse().ok()).collect()
}
