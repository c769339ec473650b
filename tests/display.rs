//! The viewer where variables name displays that are gone. Needs Xvfb: a missing one fails.
#![cfg(target_os = "linux")]

mod common;

use common::Killed;
use common::viewer::Server;
use std::ffi::OsString;
use std::io::{BufRead, BufReader};
use std::os::unix::net::UnixListener;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Stdio};

/// The viewer, in this folder, with these variables.
fn viewer(folder: &Path, variables: &[(&str, OsString)]) -> Command {
    let mut command = common::thinlens(folder);
    command
        .args(["view", "suffern-boxes", "--size", "320x240", "-n", "1"])
        .env("XDG_STATE_HOME", folder)
        .env("RUST_LOG", "thinlens=debug")
        .env_remove("XDG_RUNTIME_DIR")
        .envs(variables.iter().map(|(name, value)| (name, value)));
    command
}

/// Catches a viewer that writes a file though a window could open, and one that waits for a compositor that will
/// never answer. A signal ends the viewer too.
#[test]
fn x11_is_used_where_no_compositor_answers() {
    let server = Server::start();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    // A socket whose owner is gone, and one whose owner says nothing.
    drop(UnixListener::bind(folder.join("dead")).expect("a socket"));
    let _silent = UnixListener::bind(folder.join("silent")).expect("a socket");
    std::fs::write(folder.join("file"), "no socket").expect("a file");
    let value = |text: &str| OsString::from(text);
    let runtime = ("XDG_RUNTIME_DIR", folder.into());
    for (variables, what) in [
        (vec![("WAYLAND_DISPLAY", value("gone")), runtime.clone()], "no socket"),
        (vec![("WAYLAND_DISPLAY", value("dead")), runtime.clone()], "a dead socket"),
        (vec![("WAYLAND_DISPLAY", value("silent")), runtime.clone()], "a silent socket"),
        (vec![("WAYLAND_DISPLAY", value("file")), runtime.clone()], "a file"),
        (vec![("WAYLAND_DISPLAY", folder.join("dead").into())], "a whole path"),
        (vec![("WAYLAND_DISPLAY", value("wayland-0"))], "no folder"),
        (vec![("WAYLAND_SOCKET", value("99"))], "a socket that is not open"),
        (vec![("WAYLAND_SOCKET", value("none"))], "a socket that is not a number"),
        (vec![("WAYLAND_SOCKET", value("99")), ("WAYLAND_DISPLAY", value("dead")), runtime.clone()], "both"),
    ] {
        let mut command = viewer(folder, &[&variables[..], &[("DISPLAY", value(&server.display))]].concat());
        let mut viewer =
            Killed(command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("it starts"));
        let log = BufReader::new(viewer.0.stderr.take().expect("piped"));
        let (mut lines, mut seen) = (log.lines().map_while(Result::ok), Vec::new());
        // The rest is not read, but the pipe stays open.
        let shown =
            lines.by_ref().inspect(|line| seen.push(line.clone())).any(|line| line.contains("shown 1/1"));
        assert!(shown, "{what}: no window: {seen:#?}");
        common::send_signal("TERM", &viewer.0.id().to_string());
        let status = viewer.0.wait().expect("a process");
        assert_eq!((status.code(), status.signal()), (Some(143), None), "{what}");
        assert!(!folder.join("thinlens.png").exists(), "{what}: a file in place of the window");
    }
}

/// Catches a file manager's way to open a file, `thinlens FILE`, that is refused, and a saved picture that is rendered with
/// other settings than its own. Without a display, the viewer writes a file instead of opening a window.
#[test]
fn a_file_alone_is_viewed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let view = |arguments: &[&str]| {
        let mut command = common::thinlens(folder);
        let run: common::Run = command
            .args(arguments)
            .env("XDG_STATE_HOME", folder)
            .env("DISPLAY", ":4711")
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .output()
            .expect("it starts")
            .into();
        run
    };
    let small = ["--size", "32x24", "-n", "1"];
    std::fs::write(folder.join("a scene.toml"), include_str!("../src/scene/builtin/passing.toml"))
        .expect("a file");
    let picture = common::render_png(folder, &[&["passing"], &small[..]].concat());
    std::fs::write(folder.join("saved.png"), picture).expect("a file");
    for name in ["passing", "a scene.toml", "saved.png"] {
        let run = view(&[&[name], &small[..]].concat());
        assert_eq!(run.code, 0, "{name}: {}", run.stderr);
        assert!(run.stderr.contains("no display"), "{name}: {}", run.stderr);
        std::fs::remove_file(folder.join("thinlens.png")).expect("a picture");
    }
    let run = view(&["gone.obj"]);
    assert!(run.code == 1 && run.stderr.contains("gone.obj: there is no such file"), "{}", run.stderr);
    let run = view(&["nonsense"]);
    assert!(run.code == 2 && run.stderr.contains("unrecognized subcommand"), "{}", run.stderr);
}

/// Catches a file that is not written where there is no display at all, whatever is named.
#[test]
fn with_dead_displays_alone_a_file_is_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let value = |text: &str| OsString::from(text);
    for variables in [
        vec![("DISPLAY", value(":4711"))],
        vec![("WAYLAND_DISPLAY", value("gone")), ("XDG_RUNTIME_DIR", folder.into())],
        vec![
            ("DISPLAY", value(":4711")),
            ("WAYLAND_DISPLAY", value("gone")),
            ("XDG_RUNTIME_DIR", folder.into()),
        ],
        vec![("DISPLAY", value("")), ("WAYLAND_DISPLAY", value(""))],
    ] {
        let run: common::Run = viewer(folder, &variables).output().expect("it starts").into();
        assert_eq!(run.code, 0, "{variables:?}: {}", run.stderr);
        assert!(run.stderr.contains("no display"), "{}", run.stderr);
        std::fs::remove_file(folder.join("thinlens.png")).expect("a picture");
    }
}
