//! The viewer in the hands of a monkey.

mod common;

use common::render_png;
use common::viewer::{PANEL, Viewer};
use fastrand::Rng;
use std::collections::HashSet;
use std::time::{Duration, Instant};

const SIZE: [u16; 2] = [900, 800];
const ACTIONS: usize = 120;
const SEED: u64 = 20_261_126;
/// Bytes that imgui's vertices may take more: their buffers grow with what was drawn at most.
const VERTICES: u64 = 512 << 10;

const KEYS: [&str; 20] = [
    "o",
    "c",
    "p",
    "f",
    "w",
    "e",
    "Home",
    "question",
    "F1",
    "Escape",
    "Tab",
    "space",
    "Down",
    "Right",
    "ctrl+z",
    "ctrl+z",
    "ctrl+shift+z",
    "ctrl+y",
    "ctrl+s",
    "ctrl+c",
];
const SCENES: [&str; 4] = ["version-4", "suffern-boxes", "suffern-mirror", "passing"];
/// What is typed into whatever takes it.
const WORDS: [&str; 5] = ["0.5", "1e-30", "nan", "nowhere.toml", "999999999999"];

struct Monkey<'a> {
    viewer: &'a Viewer,
    random: Rng,
    size: [u16; 2],
}

impl Monkey<'_> {
    /// A few frames, or a moment in which nothing is drawn.
    fn look(&self) {
        let (mut frames, deadline) = (0, Instant::now() + Duration::from_secs(2));
        while frames < 3 && Instant::now() < deadline {
            match self.viewer.listen(Duration::from_millis(60)) {
                Some(line) if line.ends_with("frame") => frames += 1,
                Some(_) => {}
                None => break,
            }
        }
    }

    fn place(&mut self) -> [i32; 2] {
        self.size.map(|extent| self.random.i32(0..i32::from(extent)))
    }

    fn drag(&mut self, button: u8, from: [i32; 2]) {
        let to = self.place();
        self.viewer.xdotool(&format!("mousemove {} {}", from[0], from[1]));
        self.look();
        self.viewer.xdotool(&format!("mousedown {button}"));
        self.look();
        self.viewer.xdotool(&format!("mousemove {} {}", (from[0] + to[0]) / 2, (from[1] + to[1]) / 2));
        self.look();
        self.viewer.xdotool(&format!("mousemove {} {}", to[0], to[1]));
        self.look();
        self.viewer.xdotool(&format!("mouseup {button}"));
    }

    /// Does something, and says what.
    fn act(&mut self) -> String {
        let viewer = self.viewer;
        let names: Vec<String> = {
            let mut names: Vec<String> = viewer.controls.borrow().keys().cloned().collect();
            names.sort();
            names
        };
        let name = names[self.random.usize(0..names.len())].clone();
        let [x, y, width, height] = viewer.controls.borrow()[&name];
        // No panel is dragged out of reach by its title.
        let held = [x + (f64::from(width) * self.random.f64()) as i32, (y + height / 2).max(40)];
        let place = self.place();
        let at = format!("mousemove {} {}", place[0], place[1]);
        match self.random.u32(0..12) {
            0..3 => {
                viewer.xdotool(&format!("mousemove {} {}", held[0], held[1]));
                self.look();
                viewer.xdotool("click 1");
                format!("click {name}")
            }
            3..5 => {
                self.drag(1, held);
                format!("drag {name}")
            }
            5 => {
                let button = [1, 2, 3][self.random.usize(0..3)];
                let from = [place[0].max(i32::from(self.size[0]).min(345)), place[1].max(40)];
                self.drag(button, from);
                format!("drag the picture with {button}")
            }
            6 => {
                let wheel =
                    ["click 4", "click 5", "keydown ctrl click 4 keyup ctrl"][self.random.usize(0..3)];
                viewer.xdotool(&format!("{at} {wheel}"));
                format!("{wheel} at {place:?}")
            }
            7..9 => {
                let key = KEYS[self.random.usize(0..KEYS.len())];
                viewer.xdotool(&at);
                viewer.press(key);
                format!("press {key}")
            }
            9 => {
                self.size = [self.random.u16(70..1100), self.random.u16(70..900)];
                let [width, height] = self.size;
                viewer.xdotool(&format!("search --class thinlens windowsize {width} {height}"));
                format!("resize to {width} x {height}")
            }
            10 => {
                let scene = SCENES[self.random.usize(0..4)];
                if self.choose(scene) { format!("scene {scene}") } else { format!("no scene {scene}") }
            }
            _ => {
                let word = WORDS[self.random.usize(0..WORDS.len())];
                viewer.xdotool(&format!("mousemove {} {}", held[0], held[1]));
                self.look();
                viewer.xdotool("keydown ctrl click 1 keyup ctrl");
                self.look();
                viewer.xdotool(&format!("type {word}"));
                viewer.press("Return");
                format!("type {word} into {name}")
            }
        }
    }

    /// Chooses a scene, if the choices can be reached.
    fn choose(&self, scene: &str) -> bool {
        let viewer = self.viewer;
        viewer.controls.borrow_mut().remove(scene);
        viewer.press("Escape");
        viewer.xdotool("mousemove 100 100");
        (0..5).for_each(|_| viewer.xdotool("click --repeat 10 4"));
        self.look();
        let Some([x, y, _, height]) = viewer.controls.borrow().get("Scene").copied() else {
            return false;
        };
        if !self.click([x + 20, y + height / 2]) {
            return false;
        }
        let Some([x, y, _, height]) = viewer.controls.borrow().get(scene).copied() else {
            return false;
        };
        self.click([x + height / 2, y + height / 2])
    }

    /// Clicks, if that is in the window.
    fn click(&self, place: [i32; 2]) -> bool {
        let inside = [0, 1].into_iter().all(|axis| (0..i32::from(self.size[axis])).contains(&place[axis]));
        if inside {
            self.viewer.point(place);
            self.viewer.hands("mousedown 1", 1);
            self.viewer.hands("mouseup 1", 0);
        }
        inside
    }
}

/// Catches what no one thought of: actions that end the viewer, that break Vulkan's rules, or that leave memory
/// of the device behind.
#[test]
fn many_actions_leave_nothing_behind() {
    let viewer = Viewer::start(SIZE, &["-n", "4"]);
    viewer.wait_until_done();
    let start = (*viewer.state.borrow(), *viewer.camera.borrow(), viewer.shown.borrow().1);
    let plain = viewer.folder.join("plain.png");
    std::fs::write(&plain, render_png(&viewer.folder, &["-n", "4", "-s", "40x30"])).expect("a picture");
    let mut monkey = Monkey { viewer: &viewer, random: Rng::with_seed(SEED), size: viewer.size };
    let home = |monkey: &mut Monkey<'_>| {
        // Whatever was being typed is over.
        viewer.press("Escape");
        viewer.rest();
        // A saved picture sets everything, and can be dropped whatever the panel looks like.
        viewer.until(
            "version-4",
            // It may be paused, and then shows fewer points than it goes for.
            |viewer| (*viewer.state.borrow(), *viewer.camera.borrow(), viewer.shown.borrow().1) == start,
            || viewer.drop_file(&plain),
        );
        // Depths that an overlay has shown stay as long as the size does.
        for [width, height] in [SIZE.map(|extent| extent - 20), SIZE] {
            let before = viewer.last_shown.borrow().clone();
            viewer.xdotool(&format!("search --class thinlens windowsize {} {height}", width + PANEL));
            // The panel may be wider, and the drawing of the optics may stand below.
            viewer.wait_for("another size", |viewer| *viewer.last_shown.borrow() != before);
            viewer.rest();
        }
        if viewer.picture_size()[1] < SIZE[1] {
            viewer.until("no drawing", |viewer| viewer.picture_size()[1] == SIZE[1], || viewer.press("o"));
        }
        // So is its edge where it was.
        let [x, y, width, height] = viewer.controls.borrow()["Edge of the panel"];
        let edge = [x + width / 2, y + height / 2];
        viewer.drag_picture(1, edge, [i32::from(PANEL) - width / 2, edge[1]]);
        let shown = format!("of {}x{}", SIZE[0], SIZE[1]);
        viewer.wait_for("the panel's own width", |viewer| viewer.last_shown.borrow().ends_with(&shown));
        monkey.size = viewer.size;
        viewer.rest();
        let holds =
            |viewer: &Viewer| viewer.memory.borrow().iter().any(|(name, _)| name.contains("held picture"));
        if holds(&viewer) {
            viewer.until("letting go", |viewer| !holds(viewer), || viewer.press("c"));
        }
    };
    // What is made once, and stays.
    for key in ["o", "c", "c", "o", "f"] {
        viewer.press(key);
        monkey.look();
    }
    home(&mut monkey);
    let before = viewer.memory.borrow().clone();
    let mut seen = HashSet::new();
    for number in 0..ACTIONS {
        let action = monkey.act();
        monkey.look();
        seen.insert(viewer.memory.borrow().clone());
        println!("{number}: {action}");
    }
    assert!(seen.len() > 12, "the monkey reaches little: memory was used in {} ways", seen.len());
    home(&mut monkey);
    let after = viewer.memory.borrow().clone();
    // What is made when it is asked for may not have been asked for again.
    let mut known: Vec<&str> = before.iter().map(|(name, _)| name.as_str()).collect();
    for (name, bytes) in &after {
        let place = known.iter().position(|known| known == name);
        known.remove(place.unwrap_or_else(|| panic!("{bytes} bytes of {name} are left behind: {after:?}")));
    }
    let bytes = |memory: &[(String, u64)]| memory.iter().map(|(_, bytes)| bytes).sum::<u64>();
    println!("{} ways of using memory, {} bytes before, {} after", seen.len(), bytes(&before), bytes(&after));
    assert!(bytes(&after) <= bytes(&before) + VERTICES, "before: {before:?}\nafter: {after:?}");
    viewer.close();
}
