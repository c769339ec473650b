//! What a signal leaves behind: nothing.
#![cfg(target_os = "linux")]

mod common;

use common::{Killed, thinlens};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// More samples than anybody waits for.
const LONG: [&str; 5] = ["render", "-q", "-n", "16777216", "-o"];
/// What makes `env` start a program that these signals end.
const DEFAULT_SIGNALS: &str = "--default-signal=INT,TERM,HUP,QUIT";
/// Long enough for a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

fn names(folder: &Path) -> Vec<String> {
    let entries =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    entries.map(|name| name.to_string_lossy().into_owned()).collect()
}

/// The program under test, which a signal ends whatever the signals do that this test was started with: a job in the
/// background may ignore some, and what it starts would too.
fn mortal(folder: &Path) -> Command {
    let plain = thinlens(folder);
    let mut command = Command::new("env");
    command.arg(DEFAULT_SIGNALS).arg(plain.get_program()).current_dir(folder);
    for (name, value) in plain.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    command
}

/// Waits until something is so.
fn until(what: &str, mut so: impl FnMut() -> bool) {
    let started = Instant::now();
    while !so() {
        assert!(started.elapsed() < PATIENCE, "waited in vain for {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn parts(folder: &Path) -> usize {
    names(folder).iter().filter(|name| name.starts_with(".thinlens-") && name.ends_with(".part")).count()
}

fn send(signal: &str, child: &Child) {
    common::send_signal(signal, &child.id().to_string());
}

fn status_of(mut child: Killed) -> Option<i32> {
    let mut status = None;
    until("the end", || {
        status = child.0.try_wait().expect("a process");
        status.is_some()
    });
    status.and_then(|status| status.code())
}

/// Catches parts that a signal leaves, an older picture that it takes, and a status that hides it.
#[test]
fn a_signal_leaves_nothing_behind() {
    for (signal, status) in [("INT", 130), ("TERM", 143), ("HUP", 129), ("QUIT", 131)] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let folder = folder.path();
        std::fs::write(folder.join("long.png"), "older").expect("a file");
        let mut command = mortal(folder);
        command.args(LONG).args(["long.png", "--stats", "long.json"]);
        let child = Killed(command.spawn().expect("it starts"));
        until("both parts", || parts(folder) == 2);
        send(signal, &child.0);
        assert_eq!(status_of(child), Some(status), "{signal}");
        assert_eq!(names(folder), ["long.png"], "{signal}");
        assert_eq!(std::fs::read(folder.join("long.png")).expect("a file"), b"older");
    }
}

/// Catches the same of sheets, and of the figures of a bench.
#[test]
fn sheets_and_figures_leave_nothing_behind() {
    for arguments in [
        &["sweep", "-q", "-n", "16777216", "-o", "long.png"][..],
        &["bench", "version-4", "-n", "16777216", "--json=long.json"],
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let folder = folder.path();
        let mut command = mortal(folder);
        command.args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
        let child = Killed(command.spawn().expect("it starts"));
        until("a part", || parts(folder) == 1);
        send("TERM", &child.0);
        assert_eq!(status_of(child), Some(143), "{arguments:?}");
        assert_eq!(names(folder), Vec::<String>::new(), "{arguments:?}");
    }
}

/// Catches a program that a signal ends though it was told to live on, as `nohup` and a shell's `&` tell it.
#[test]
fn a_signal_that_is_ignored_stays_ignored() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let mut command = Command::new("sh");
    command.args(["-c", "trap '' HUP INT; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_thinlens")]);
    command.args(LONG).arg("long.png").current_dir(folder).env("XDG_CACHE_HOME", common::CACHE);
    let child = Killed(command.spawn().expect("it starts"));
    until("a part", || parts(folder) == 1);
    send("HUP", &child.0);
    send("INT", &child.0);
    send("TERM", &child.0);
    assert_eq!(status_of(child), Some(143), "an ignored signal ended it");
    assert_eq!(names(folder), Vec::<String>::new());
}

/// Catches a bar that stays on the terminal.
#[test]
fn the_terminal_is_left_as_it_was() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    // A terminal for the program, whose output goes to a file.
    let program = format!(
        "stty cols 100; exec env {DEFAULT_SIGNALS} {} render -n 16777216 -o long.png",
        thinlens::settings::quoted(env!("CARGO_BIN_EXE_thinlens").as_ref())
    );
    let mut command = Command::new("script");
    command.args(["-q", "-e", "-f", "-c", &program, "typed"]).current_dir(folder);
    command.env("XDG_CACHE_HOME", common::CACHE).env("TERM", "xterm").env("SHELL", "/bin/sh");
    command.stdin(Stdio::null()).stdout(Stdio::null());
    let child = Killed(command.spawn().expect("script, of util-linux"));
    let typed =
        || std::fs::read(folder.join("typed")).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    until("a bar", || typed().is_ok_and(|typed| typed.contains("samples per pixel")));
    let part = names(folder).into_iter().find(|name| name.ends_with(".part")).expect("a part");
    let id = part.split('-').nth(1).expect("its process");
    common::send_signal("INT", id);
    assert_eq!(status_of(child), Some(130));
    let typed = typed().expect("what was on the terminal");
    let end = typed.rsplit("samples per pixel").next().expect("an end");
    // The line is emptied, and the cursor is at its beginning and not hidden.
    assert!(end.contains("\r\u{1b}[2K") || end.contains("\u{1b}[2K"), "{end:?}");
    assert!(!typed.contains("\u{1b}[?25l") || typed.ends_with("\u{1b}[?25h"), "{typed:?}");
    assert_eq!(parts(folder), 0);
}
