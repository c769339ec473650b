//! The viewer under Xvfb, driven as a user would. Needs Xvfb and xdotool: a missing one fails.
//!
//! A machine may be busy, so nothing here waits for a time. The viewer's log says in their order which events it
//! has seen, which frames it began, and what is set and shown: a test waits until an event was seen and drawn before it
//! looks or goes on.

pub mod x11;

use super::{CACHE, Killed};
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use thinlens::app::telemetry;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::Window;
use x11rb::rust_connection::RustConnection;

/// After an event the viewer draws three frames at least. Two see what comes of it, and are over when the third
/// one begins.
const FRAMES: usize = 3;
/// Long enough for a busy machine; what is waited for comes in well under a second elsewhere.
const PATIENCE: Duration = Duration::from_secs(60);

/// A display that nobody sees.
pub struct Server {
    process: Killed,
    pub display: String,
}

impl Server {
    pub fn start() -> Self {
        let mut process = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map(Killed)
            .expect("Xvfb, which setup.sh installs");
        let mut number = String::new();
        let out = process.0.stdout.take().expect("piped");
        BufReader::new(out).read_line(&mut number).expect("Xvfb says its display");
        Self { process, display: format!(":{}", number.trim()) }
    }
}

/// A viewer with a display of its own.
pub struct Viewer {
    program: Killed,
    lines: Receiver<String>,
    pub controls: RefCell<HashMap<String, [i32; 4]>>,
    /// Samples and target that were shown last.
    pub shown: RefCell<(u32, u32)>,
    /// Lens diameter, focal distance and jitter.
    pub state: RefCell<[f32; 3]>,
    /// Lens centre, and what the camera looks at.
    pub camera: RefCell<[f32; 6]>,
    /// Camera model, field of view in degrees, blades, cat's eye.
    pub view: RefCell<String>,
    /// The pixel whose optics were drawn last, and p there: right, up, depth.
    pub diagram: RefCell<Option<([f32; 2], [f64; 3])>>,
    /// What was shown last: points, and the picture's size.
    pub last_shown: RefCell<String>,
    /// What the panel said last.
    pub message: RefCell<String>,
    /// What is allocated on the device: names and bytes.
    pub memory: RefCell<Vec<(String, u64)>>,
    /// The command line that was copied last.
    pub copied: RefCell<Option<String>>,
    /// Where the viewer saw the pointer last.
    pointer: Cell<Option<[i32; 2]>>,
    /// Presses, releases and turns of the wheel that it has seen, and how many buttons and keys it knows as held.
    inputs: Cell<usize>,
    held: Cell<usize>,
    /// Whether it has drawn all there is to draw, and waits for an event.
    idle: Cell<bool>,
    /// All samples that were shown, since it was cleared last.
    pub history: RefCell<Vec<u32>>,
    pub display: String,
    /// Where the viewer runs, and what it remembers.
    pub folder: PathBuf,
    _folder: Option<TempDir>,
    connection: RustConnection,
    root: Window,
    pub size: [u16; 2],
    _server: Killed,
}

impl Viewer {
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

    /// Starts a display and the viewer in it under validation, and waits for its panel.
    pub fn start(size: [u16; 2], arguments: &[&str]) -> Self {
        Self::start_as_user(size, &[&["--validation"], arguments].concat())
    }

    /// Starts a display and the viewer in it with no more checks than a user has, and waits for its panel.
    pub fn start_as_user(size: [u16; 2], arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let size_argument = format!("{}x{}", size[0], size[1]);
        let mut viewer =
            Self::start_in(folder.path(), size, &[&["--size", &size_argument], arguments].concat());
        viewer._folder = Some(folder);
        viewer
    }

    /// Starts a display and the viewer in it, in this folder. Its window must come out in this size.
    pub fn start_in(folder: &Path, size: [u16; 2], arguments: &[&str]) -> Self {
        Self::start_with(folder, size, arguments, &[])
    }

    /// Starts a display and the viewer in it, in this folder and with these variables in its environment.
    pub fn start_with(folder: &Path, size: [u16; 2], arguments: &[&str], variables: &[(&str, &str)]) -> Self {
        let Server { process: server, display } = Server::start();
        let mut program = Command::new(env!("CARGO_BIN_EXE_thinlens"))
            .arg("view")
            .args(arguments)
            .current_dir(folder)
            .env("DISPLAY", &display)
            .env("XDG_STATE_HOME", folder)
            .env("XDG_CACHE_HOME", CACHE)
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .env("RUST_LOG", "thinlens=trace")
            .envs(variables.iter().copied())
            .stderr(Stdio::piped())
            .spawn()
            .map(Killed)
            .expect("it starts");
        let (sender, lines) = channel();
        let log = BufReader::new(program.0.stderr.take().expect("piped"));
        std::thread::spawn(move || {
            for line in log.lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        let (connection, screen) = x11rb::connect(Some(&display)).expect("a connection to Xvfb");
        let root = connection.setup().roots[screen].root;
        let viewer = Self {
            program,
            lines,
            controls: RefCell::default(),
            shown: RefCell::default(),
            state: RefCell::default(),
            camera: RefCell::default(),
            view: RefCell::default(),
            diagram: RefCell::default(),
            last_shown: RefCell::default(),
            message: RefCell::default(),
            memory: RefCell::default(),
            copied: RefCell::default(),
            pointer: Cell::default(),
            inputs: Cell::default(),
            held: Cell::default(),
            idle: Cell::default(),
            history: RefCell::default(),
            display,
            folder: folder.to_path_buf(),
            _folder: None,
            connection,
            root,
            size,
            _server: server,
        };
        viewer.wait_for("the panel", |viewer| viewer.controls.borrow().contains_key("Reset"));
        viewer
    }

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

    /// Has xdotool do something, whenever the viewer may notice it.
    pub fn xdotool(&self, arguments: &str) {
        let status =
            Command::new("xdotool").args(arguments.split(' ')).env("DISPLAY", &self.display).status();
        assert!(status.expect("xdotool, which setup.sh installs").success(), "xdotool {arguments}");
    }

    /// Moves the pointer to a place in the window, and waits until the viewer has drawn what comes of it.
    pub fn point(&self, place: [i32; 2]) {
        let is_there = self.pointer.get() == Some(place);
        self.xdotool(&format!("mousemove {} {}", place[0], place[1]));
        if !is_there {
            self.wait_for("pointer", |viewer| viewer.pointer.get() == Some(place));
            self.frames(FRAMES);
        }
    }

    /// Presses or lets go, after which so many buttons and keys are held, and waits until the viewer has drawn
    /// what comes of it.
    pub fn hands(&self, arguments: &str, held: usize) {
        let before = self.inputs.get();
        self.xdotool(arguments);
        self.wait_for(arguments, |viewer| viewer.inputs.get() > before && viewer.held.get() == held);
        self.frames(FRAMES);
    }

    /// Presses keys and lets them go at once, for a key that is held acts again. Without a window manager, the
    /// window has to be told that it is meant.
    pub fn press(&self, keys: &str) {
        self.hands(&format!("search --class thinlens windowfocus --sync key --delay 0 {keys}"), 0);
    }

    /// Turns the wheel away at a place of the picture, while so many keys are held. Xvfb may send more than one
    /// notch: those that are still on their way come before the pointer's next move.
    pub fn wheel(&self, [x, y]: [i32; 2], held: usize) {
        self.point([x, y]);
        self.hands("click 4", held);
        self.point([x + 1, y]);
    }

    /// Drags over the picture, a step at a time.
    pub fn drag_picture(&self, button: u8, from: [i32; 2], to: [i32; 2]) {
        let at = |step: i32| {
            self.point([0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * step / 4));
        };
        at(0);
        self.hands(&format!("mousedown {button}"), 1);
        (1..=4).for_each(at);
        self.hands(&format!("mouseup {button}"), 0);
    }

    /// Drags a slider from one share of its width to others, a step at a time as a hand does.
    pub fn drag(&self, control: &str, shares: &[f64], reached: impl Fn(&Self) -> bool) {
        self.until(control, reached, || {
            let at = |share: f64| {
                let [x, y, width, height] = self.controls.borrow()[control];
                let x = x + (f64::from(width) * share).round() as i32;
                self.point([x.max(0), y + height / 2]);
            };
            at(shares[0]);
            self.hands("mousedown 1", 1);
            shares[1..].iter().copied().for_each(at);
            self.hands("mouseup 1", 0);
            self.point_away();
        });
    }

    /// Does something, once, and waits until it has come to this.
    pub fn until(&self, what: &str, reached: impl Fn(&Self) -> bool, act: impl Fn()) {
        act();
        self.wait_for(what, reached);
    }

    pub fn click(&self, control: &str, reached: impl Fn(&Self) -> bool) {
        self.until(control, reached, || self.click_once(control));
    }

    pub fn click_once(&self, control: &str) {
        // What has just unfolded may not have come to rest yet.
        loop {
            let place @ [x, y, _, height] = self.controls.borrow()[control];
            self.point([x + height / 2, y + height / 2]);
            if self.controls.borrow()[control] == place {
                break;
            }
        }
        self.hands("mousedown 1", 1);
        self.hands("mouseup 1", 0);
        self.point_away();
    }

    /// Out of the way of tooltips and highlights.
    fn point_away(&self) {
        self.point(self.size.map(|extent| i32::from(extent) - 5));
    }

    /// Gives the window another size.
    pub fn resize(&mut self, size: [u16; 2]) {
        let [width, height] = size;
        self.xdotool(&format!("search --class thinlens windowsize {width} {height}"));
        let shown = format!("of {width}x{height}");
        self.wait_for("another size", |viewer| viewer.last_shown.borrow().contains(&shown));
        self.size = size;
    }

    /// Waits until the viewer has begun that many frames more.
    fn frames(&self, count: usize) {
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
