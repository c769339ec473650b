//! How long a hand at a slider waits for the picture, and how many pictures it gets a second.
//!
//! `cargo bench --bench viewer_latency` starts the viewer in a window of 1280x720 under Xvfb and drags its focal
//! plane to and fro, 125 times a second as a mouse reports, without a pause. It is measured on the
//! screen: a frame shows the slider's knob and the picture of one and the same setting, so an event is
//! answered once the knob is where the event put it. The viewer's log says how long a frame took from
//! the first event that it answers to handing the picture over. With `--all-open` every section of the panel is
//! unfolded, and the drawing of the optics open.

#[path = "../tests/common/mod.rs"]
mod common;

use common::viewer::{SECTIONS, Viewer};
use std::path::Path;
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, MOTION_NOTIFY_EVENT};
use x11rb::protocol::xtest::ConnectionExt;

/// The size of the picture. With the panel, the window has 1280x720 pixels.
const SIZE: [u16; 2] = [960, 720];
const CONTROL: &str = "Focal plane distance";
const EVENT_EVERY: Duration = Duration::from_millis(8);
const LOOK_EVERY: Duration = Duration::from_millis(1);
const SWEEPS: i32 = 4;
/// Where a sweep turns, as shares of the slider's width.
const TURNS: [f64; 2] = [0.1, 0.9];
/// Right after a turn the knob may still be on its way to it, on the same pixels.
const UNCLEAR: Duration = Duration::from_millis(300);
/// The reference that the viewer is compared with.
const TARGET: Duration = Duration::from_millis(33);

/// A position of the pointer or of the knob along the slider, in pixels of the screen.
#[derive(Clone, Copy)]
struct Seen {
    at: Instant,
    x: f64,
}

/// Drags to and fro, and gives each sweep's events.
fn drag(display: &str, [x, y, width, height]: [i32; 4]) -> Vec<Vec<Seen>> {
    let (connection, screen) = x11rb::connect(Some(display)).expect("a connection to Xvfb");
    let root = connection.setup().roots[screen].root;
    let send = |kind: u8, detail: u8, x: i32| {
        let (x, y) =
            (i16::try_from(x).expect("on the screen"), i16::try_from(y + height / 2).expect("likewise"));
        connection
            .xtest_fake_input(kind, detail, 0, root, x, y, 0)
            .expect("a request")
            .check()
            .expect("input");
    };
    let [left, right] = TURNS.map(|share| x + (share * f64::from(width)) as i32);
    send(MOTION_NOTIFY_EVENT, 0, left);
    std::thread::sleep(Duration::from_millis(200));
    send(BUTTON_PRESS_EVENT, 1, left);
    std::thread::sleep(Duration::from_millis(200));
    let mut due = Instant::now();
    let mut sweep = |number: i32| {
        let to = |step: i32| if number % 2 == 0 { left + step } else { right - step };
        let mut events = Vec::new();
        for step in 1..=right - left {
            due += EVENT_EVERY;
            std::thread::sleep(due.saturating_duration_since(Instant::now()));
            events.push(Seen { at: Instant::now(), x: f64::from(to(step)) });
            send(MOTION_NOTIFY_EVENT, 0, to(step));
        }
        events
    };
    let sweeps = (0..SWEEPS).map(&mut sweep).collect();
    std::thread::sleep(Duration::from_millis(200));
    send(BUTTON_RELEASE_EVENT, 1, left);
    sweeps
}

/// The middle of the knob of the slider, which is brighter than the slider, and has the accent colour while it is held.
fn knob(viewer: &Viewer, [x, y, width, height]: [i32; 4]) -> Option<f64> {
    let corner = [x, y + height / 2].map(|place| i16::try_from(place).expect("on the screen"));
    let row = viewer.screen(corner, [u16::try_from(width).expect("a width"), 1]);
    let bright = (0..).zip(&row).filter(|(_, pixel)| pixel[0] > 180 && pixel[1] > 150);
    let columns: Vec<i32> = bright.map(|(column, _)| column).collect();
    Some(f64::from(x) + f64::from(columns.first()? + columns.last()?) / 2.0)
}

/// Median, 95th percentile and worst, in milliseconds.
fn summary(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
    format!("median {:.1} ms, 95th percentile {:.1} ms, worst {:.1} ms", at(0.5), at(0.95), at(1.0))
}

/// How long each event of a sweep waited until the knob was where it put it, in milliseconds.
fn waits(sweep: &[Seen], shown: &[Seen]) -> Vec<f64> {
    let (Some(first), Some(last)) = (sweep.first(), sweep.last()) else {
        return Vec::new();
    };
    let direction = (last.x - first.x).signum();
    let clear = sweep.iter().filter(|event| event.at > first.at + UNCLEAR && event.at < last.at - UNCLEAR);
    clear
        .map(|event| {
            let answer =
                shown.iter().find(|seen| seen.at > event.at && direction * (seen.x - event.x) > -0.6);
            let answer = answer.expect("every event is answered before its sweep ends");
            1e3 * (answer.at - event.at).as_secs_f64()
        })
        .collect()
}

/// Makes the viewer that is started in this folder open with all of the panel unfolded.
fn unfold_all(folder: &Path) {
    let folds: Vec<String> = SECTIONS.iter().map(|section| format!("\"{section}\": true")).collect();
    Viewer::remember(folder, &format!("{{\"greeted\": true, \"folds\": {{{}}}}}", folds.join(", ")));
}

fn main() {
    let scene = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let scene = scene.unwrap_or_else(|| "version-4".into());
    let all_open = std::env::args().any(|argument| argument == "--all-open");
    let folder = tempfile::tempdir().expect("a temporary folder");
    if all_open {
        unfold_all(folder.path());
    }
    let size = format!("{}x{}", SIZE[0], SIZE[1]);
    let viewer = Viewer::start_in(folder.path(), SIZE, &["--size", &size, &scene, "-n", "256"]);
    viewer.wait_for("first picture", |viewer| viewer.shown.borrow().0 > 1);
    if all_open {
        assert!(viewer.controls.borrow().contains_key("Aperture"), "the section Lens is open");
        viewer.click("Optics", |viewer| viewer.diagram.borrow().is_some());
    }
    let control = viewer.controls.borrow()[CONTROL];
    let display = viewer.display.clone();
    while viewer.listen(Duration::ZERO).is_some() {}

    let (sweeps, shown) = std::thread::scope(|scope| {
        let hand = scope.spawn(|| drag(&display, control));
        let mut shown: Vec<Seen> = Vec::new();
        while !hand.is_finished() {
            let x = knob(&viewer, control);
            let at = Instant::now();
            if let Some(x) = x.filter(|x| shown.last().is_none_or(|last| last.x != *x)) {
                shown.push(Seen { at, x });
            }
            std::thread::sleep(LOOK_EVERY);
        }
        (hand.join().expect("a hand"), shown)
    });
    let mut inside = Vec::new();
    while let Some(line) = viewer.listen(Duration::from_millis(20)) {
        let took = line.split("presented ").nth(1).and_then(|rest| rest.split(' ').next());
        inside.extend(took.and_then(|number| number.parse::<f64>().ok()));
    }
    viewer.close();

    let outside: Vec<f64> = sweeps.iter().flat_map(|sweep| waits(sweep, &shown)).collect();
    let events: usize = sweeps.iter().map(Vec::len).sum();
    let (start, end) = (sweeps[0][0].at, sweeps.iter().flatten().last().expect("events").at);
    let seconds = (end - start).as_secs_f64();
    let settings = shown.iter().filter(|seen| seen.at >= start && seen.at <= end).count();
    let panels = if all_open { ", all panels open" } else { "" };
    println!("{scene}, {}x{}{panels}, {events} events in {seconds:.1} s", SIZE[0], SIZE[1]);
    println!("event to screen:   {}", summary(outside.clone()));
    println!("event to handover: {}", summary(inside));
    println!("settings shown:    {:.1} a second", settings as f64 / seconds);
    let late = outside.iter().filter(|wait| **wait > 1e3 * TARGET.as_secs_f64()).count();
    println!(
        "later than {} ms:  {:.1}% of the events",
        TARGET.as_millis(),
        100.0 * late as f64 / outside.len() as f64
    );
}
