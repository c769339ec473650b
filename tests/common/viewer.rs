//! The viewer under Xvfb, driven as a user would. Needs Xvfb and xdotool: a missing one fails.
//!
//! A machine may be busy, so nothing here waits for a time. The viewer's log says in their order which events it
//! has seen, which frames it began, and what is set and shown: a test waits until an event was seen and drawn before it
//! looks or goes on.

mod input;
pub mod log;
pub mod x11;

use super::{CACHE, Killed};
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;
use tempfile::TempDir;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::Window;
use x11rb::rust_connection::RustConnection;

/// Long enough for a busy machine; what is waited for comes in well under a second elsewhere.
const PATIENCE: Duration = Duration::from_secs(60);

/// The width of the panel, which stands at the left of the picture.
pub const PANEL: u16 = 320;
/// The sections of the panel that are folded at first.
pub const SECTIONS: [&str; 10] = [
    "Lens",
    "Aperture shape",
    "Viewpoint",
    "Shift, tilt, colour errors",
    "Light",
    "Sampling",
    "View",
    "Output",
    "Files",
    "Device",
];

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
    /// The file or scene that was opened last.
    pub opened: RefCell<String>,
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
    /// The size of the window.
    pub size: [u16; 2],
    _server: Killed,
}

/// Where the viewer keeps what it remembers, in the folder that it is started in.
pub const MEMORY: &str = "thinlens/viewer.json";

impl Viewer {
    /// Starts a display and the viewer in it under validation, with a picture of this size, and waits for its panel.
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

    /// Writes the memory of the viewer that is started in this folder.
    pub fn remember(folder: &Path, memory: &str) {
        let file = folder.join(MEMORY);
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        std::fs::write(file, memory).expect("a memory");
    }

    /// Starts a display and the viewer in it, in this folder. Its picture must come out in this size.
    pub fn start_in(folder: &Path, size: [u16; 2], arguments: &[&str]) -> Self {
        Self::start_with(folder, size, arguments, &[])
    }

    /// Starts a display and the viewer in it, in this folder and with these variables in its environment.
    pub fn start_with(folder: &Path, size: [u16; 2], arguments: &[&str], variables: &[(&str, &str)]) -> Self {
        // The greeting lies over the picture. Tests that want it write a memory without this.
        if !folder.join(MEMORY).exists() {
            Self::remember(folder, "{\"greeted\": true}");
        }
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
            opened: RefCell::default(),
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
            size: [size[0] + PANEL, size[1]],
            _server: server,
        };
        viewer.wait_for("the panel", |viewer| viewer.controls.borrow().contains_key("Reset"));
        // Where a window gets the focus together with its first key, the key may come before the modifier that is held.
        viewer.xdotool("search --class thinlens windowfocus --sync");
        viewer
    }
}
