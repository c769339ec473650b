//! Files as systems have them: links, pipes, rights, long names, two names of one file; and what is said when
//! one cannot be used.
#![cfg(unix)]

mod common;

use common::{Run, run, thinlens};
use std::fs::{self, Permissions};
use std::io::Read;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use thinlens::pending_file::{PendingFile, keep_apart};

const QUICK: [&str; 5] = ["-s", "8x6", "-n", "1", "-q"];

fn write(path: &Path, text: &str) {
    PendingFile::create(path).expect("a file").write(text.as_bytes()).expect("a file");
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// What a path is refused with as an output.
fn refused(path: &Path) -> String {
    PendingFile::create(path).err().unwrap_or_else(|| panic!("{} is taken", path.display())).to_string()
}

/// Catches a link that is replaced by a file, while what it points to stays old; and a part left behind.
#[test]
fn what_a_link_points_to_is_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for deep in ["links", "real"] {
        fs::create_dir(folder.join(deep)).expect("a folder");
    }
    fs::write(folder.join("real/old.png"), "old").expect("a file");
    symlink("real", folder.join("way")).expect("a link");
    let links = [
        ("links/relative.png", "../real/old.png", "real/old.png"),
        ("links/chain.png", "relative.png", "real/old.png"),
        ("links/dangling.png", "../real/new.png", "real/new.png"),
        ("links/two.png", "three.png", "real/three.png"),
        ("links/three.png", "../way/three.png", "real/three.png"),
        ("way/here.png", "old.png", "real/old.png"),
    ];
    for (link, to, _) in links {
        symlink(to, folder.join(link)).expect("a link");
    }
    for (link, _, real) in links {
        let path = folder.join(link);
        write(&path, link);
        assert!(path.is_symlink(), "{link} is no link any more");
        assert_eq!(fs::read_to_string(folder.join(real)).expect("a file"), link);
        assert!(!folder.join(real).is_symlink(), "{link}");
    }
    let absolute = folder.join("links/absolute.png");
    symlink(folder.join("real/whole.png"), &absolute).expect("a link");
    write(&absolute, "whole");
    assert!(absolute.is_symlink());
    assert_eq!(names(&folder.join("links")).len(), 6);
    assert_eq!(names(&folder.join("real")), ["here.png", "new.png", "old.png", "three.png", "whole.png"]);

    symlink("b.png", folder.join("a.png")).expect("a link");
    symlink("a.png", folder.join("b.png")).expect("a link");
    assert!(refused(&folder.join("a.png")).contains("links"), "{}", refused(&folder.join("a.png")));
}

/// Catches rights that a file loses when it is written anew, and one whose rights forbid that.
#[test]
fn a_file_keeps_its_rights() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.png");
    let mode = || fs::metadata(&path).expect("a file").mode() & 0o7777;
    for rights in [0o600, 0o640, 0o664, 0o755, 0o606] {
        fs::write(&path, "old").expect("a file");
        fs::set_permissions(&path, Permissions::from_mode(rights)).expect("rights");
        let pending = PendingFile::create(&path).expect("a file");
        // Others cannot read the part either.
        let part = names(folder.path()).into_iter().find(|name| name.ends_with(".part")).expect("a part");
        let of_part = fs::metadata(folder.path().join(part)).expect("a part").mode() & 0o7777;
        pending.write(b"new").expect("a file");
        assert_eq!((mode(), of_part), (rights, rights), "{rights:o}");
        assert_eq!(fs::read(&path).expect("a file"), b"new");
    }
    for rights in [0o444, 0o400] {
        fs::set_permissions(&path, Permissions::from_mode(rights)).expect("rights");
        assert!(refused(&path).contains("write-protected"), "{}", refused(&path));
        assert_eq!((mode(), fs::read(&path).expect("a file")), (rights, b"new".to_vec()));
    }
    assert_eq!(names(folder.path()), ["a.png"]);
}

/// Catches the other names of a file that change along: copies of whole folders are made of such names.
#[test]
fn another_name_of_a_file_keeps_what_it_had() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [path, copy] = ["a.png", "copy.png"].map(|name| folder.path().join(name));
    fs::write(&path, "old").expect("a file");
    fs::hard_link(&path, &copy).expect("a second name");
    write(&path, "new");
    let read = |path| fs::read_to_string(path).expect("a file");
    assert_eq!([read(&path), read(&copy)], ["new", "old"]);
}

/// Catches a part whose name is longer than its file's.
#[test]
fn a_name_may_be_as_long_as_the_disk_takes_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in [format!("{}.png", "a".repeat(251)), format!("{}a.png", "é".repeat(125))] {
        assert_eq!(name.len(), 255);
        write(&folder.path().join(&name), "new");
        assert!(names(folder.path()).contains(&name));
    }
    let longer = folder.path().join(format!("{}.png", "a".repeat(252)));
    assert!(refused(&longer).contains("choose a shorter"), "{}", refused(&longer));
}

/// Catches part files that are another one's, and those of a process of before that keep their place.
#[test]
fn each_file_has_a_part_of_its_own() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.png");
    let [first, second] = [(), ()].map(|()| PendingFile::create(&path).expect("a file"));
    let parts = names(folder.path());
    assert_eq!(parts.len(), 2, "{parts:?}");
    assert!(parts.iter().all(|name| name.starts_with(".thinlens-")), "{parts:?}");
    // The next one's name is taken.
    let number =
        |name: &str| name.split(['-', '.']).rev().nth(1).and_then(|number| number.parse::<u32>().ok());
    let last = parts.iter().filter_map(|name| number(name)).max().expect("numbers");
    let mut left = Vec::new();
    for next in last + 1..last + 100 {
        let path = folder.path().join(format!(".thinlens-{}-{next}.part", std::process::id()));
        fs::write(&path, "left behind").expect("a file");
        left.push(path);
    }
    let third = PendingFile::create(&path).expect("a file");
    for (pending, text) in [(second, "second"), (first, "first"), (third, "third")] {
        pending.write(text.as_bytes()).expect("a file");
        assert_eq!(fs::read_to_string(&path).expect("a file"), text);
    }
    assert!(left.iter().all(|path| fs::read(path).is_ok_and(|text| text == b"left behind")));
}

/// Catches a pipe or a device that a file takes the place of, and standard output that is written over.
#[test]
fn a_pipe_and_a_device_take_what_is_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let pipe = folder.join("pipe.png");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    let reader = {
        let pipe = pipe.clone();
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            fs::File::open(pipe).and_then(|mut file| file.read_to_end(&mut bytes)).expect("a pipe");
            bytes
        })
    };
    let outcome = run(folder, &[&["render", "-o", "pipe.png"], &QUICK[..]].concat());
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    common::decode_png(&reader.join().expect("a reader"));
    assert!(!fs::metadata(&pipe).expect("a pipe").is_file(), "the pipe became a file");

    symlink("/dev/null", folder.join("null.png")).expect("a link");
    write(&folder.join("null.png"), "nothing");
    assert!(!fs::metadata("/dev/null").expect("a device").is_file());
    symlink("/dev/full", folder.join("full.png")).expect("a link");
    let full = PendingFile::create(&folder.join("full.png")).expect("a device").write(b"something");
    let error = full.expect_err("a full disk").to_string();
    assert!(error.contains("free some space"), "{error}");

    // Standard output that is a file: what was there before, the figures, and then the answer.
    let log = fs::File::create(folder.join("log")).expect("a file");
    let line = format!(
        "echo before; '{}' render -s 8x6 -n 1 -o a.png --stats /dev/stdout; echo after",
        env!("CARGO_BIN_EXE_thinlens")
    );
    let mut shell = Command::new("sh");
    shell.args(["-c", &line]).current_dir(folder).stdout(log).stderr(Stdio::null());
    assert!(shell.env("XDG_CACHE_HOME", common::CACHE).status().expect("sh").success());
    let text = fs::read_to_string(folder.join("log")).expect("a file");
    let parts = ["before\n{", "\"scene\": \"version-4\"", "}\na.png: 8x6", "after\n"];
    let found: Vec<usize> =
        parts.iter().map(|part| text.find(part).unwrap_or_else(|| panic!("{text}"))).collect();
    assert!(found.is_sorted(), "{text}");
}

/// Catches two outputs that are the same file, or an output that overwrites an input, under whatever names.
#[test]
fn no_file_is_taken_for_another() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib own.mtl\nf 1 3 2\n";
    for (name, text) in [("own.obj", obj), ("own.mtl", "newmtl red\nKd 1 0 0\n"), ("other.txt", "other")] {
        fs::write(folder.join(name), text).expect("a file");
    }
    fs::create_dir(folder.join("deep")).expect("a folder");
    let mut mask = png::Encoder::new(fs::File::create(folder.join("mask.png")).expect("a file"), 1, 1);
    mask.set_color(png::ColorType::Grayscale);
    mask.write_header().expect("a header").write_image_data(&[255]).expect("a pixel");
    let scene = "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nvfov_degrees = 60\nlens_diameter = 0.1\n\
                 focal_distance = 5\naperture_image = \"mask.png\"\n[[mesh]]\nfile = \"own.obj\"\n";
    fs::write(folder.join("own.toml"), scene).expect("a scene");
    let sky = scene.replace("aperture_image = \"mask.png\"", "[background]\nimage = \"mask.png\"");
    fs::write(folder.join("sky.toml"), format!("integrator = \"path\"\n{sky}")).expect("a scene");
    symlink("a.png", folder.join("link.png")).expect("a link");
    symlink(".", folder.join("way")).expect("a link");
    symlink("own.obj", folder.join("mesh.png")).expect("a link");
    symlink("own.obj", folder.join("mesh.toml")).expect("a link");
    symlink("own.mtl", folder.join("colours.exr")).expect("a link");
    fs::hard_link(folder.join("own.obj"), folder.join("hard.png")).expect("a second name");
    fs::hard_link(folder.join("other.txt"), folder.join("more.png")).expect("a second name");
    let kept = ["own.obj", "own.mtl", "own.toml", "mask.png", "other.txt"];
    let read = || kept.map(|name| fs::read(folder.join(name)).expect("a file"));
    let before = read();

    let whole = folder.join("a.png");
    let whole = whole.to_str().expect("a plain path");
    let render = [&["render", "version-4"], &QUICK[..]].concat();
    let own = [&["render", "own.toml"], &QUICK[..]].concat();
    let mesh = [&["render", "own.obj"], &QUICK[..]].concat();
    for (arguments, more) in [
        (&render, &["-o", "a.png", "--stats", "a.png"][..]),
        (&render, &["-o", "a.png", "--stats", "./a.png"]),
        (&render, &["-o", "a.png", "--stats", "deep/../a.png"]),
        (&render, &["-o", "a.png", "--stats", whole]),
        (&render, &["-o", "a.png", "--stats", "link.png"]),
        (&render, &["-o", "link.png", "--stats", "way/way/a.png"]),
        (&render, &["-o", "more.png", "--stats", "other.txt"]),
        (&own, &["-o", "a.png", "--stats", "own.toml"]),
        (&own, &["-o", "a.png", "--stats", "deep/../own.obj"]),
        (&own, &["-o", "a.png", "--stats", "own.mtl"]),
        (&own, &["-o", "mask.png"]),
        (&vec!["render", "sky.toml", "-q", "-s", "8x6", "-n", "1"], &["-o", "mask.png"]),
        (&own, &["-o", "mesh.png"]),
        (&own, &["-o", "hard.png"]),
        (&own, &["-o", "colours.exr"]),
        (&mesh, &["-o", "way/hard.png"]),
        (&render, &["-o", "mask.png", "--aperture-image", "way/mask.png"]),
        (&vec!["sweep", "own.toml", "-q", "-s", "8x6", "-n", "1"], &["-o", "mask.png"]),
        (&vec!["save", "own.toml"], &["-o", "mesh.toml"]),
        (&vec!["save", "own.obj"], &["-o", "mesh.toml"]),
        (&vec!["save", "mesh.toml"], &["-o", "mesh.toml"]),
        (&vec!["bench", "own.toml", "--runs", "1"], &["--json=own.obj"]),
        (&vec!["bench", "own.toml", "--runs", "1"], &["--json=./own.toml"]),
    ] {
        let outcome = run(folder, &[arguments, more].concat());
        // A mesh that has the name of a scene file is refused as a scene, so nothing is written either.
        let wrong_use = outcome.code == 2 || outcome.stderr.contains("mesh.toml:1");
        assert!(wrong_use && outcome.stderr.lines().count() == 1, "{more:?}: {}", outcome.stderr);
        assert!(read() == before, "{arguments:?} {more:?} writes over a file");
        assert!(!folder.join("a.png").exists(), "{more:?}");
    }

    // What is asked for and does no harm.
    for arguments in [
        &["render", "version-4", "-o", "a.png", "--stats", "a.json"][..],
        &["render", "--from", "a.png", "-o", "a.png"],
        &["render", "--from", "a.png", "-o", "deep/a.png", "--stats", "deep/a.json"],
        &["save", "own.toml", "-o", "own.toml"],
    ] {
        let quick: &[&str] = if arguments[0] == "render" { &QUICK } else { &[] };
        let outcome = run(folder, &[arguments, quick].concat());
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments:?}");
    }
    let from = ["render", "--from", "a.png", "-o", "b.png", "--stats", "a.png"];
    assert_eq!(run(folder, &from).code, 2);
    common::decode_png(&fs::read(folder.join("a.png")).expect("a picture"));

    let null = Path::new("/dev/null");
    keep_apart(&[("one", null), ("two", null)], &[]).expect("what is thrown away may be thrown away twice");
}

/// Catches advice that does not fit: each failure to write has its own.
#[test]
fn what_cannot_be_written_says_why() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::write(folder.join("file"), "text").expect("a file");
    fs::create_dir(folder.join("folder.png")).expect("a folder");
    symlink("nowhere/a.png", folder.join("link.png")).expect("a link");
    for (path, part) in [
        ("none/a.png", "make the folder first"),
        ("link.png", "nowhere"),
        ("file/a.png", "no folder"),
        ("folder.png", "it is a folder"),
        ("..", "it is a folder"),
    ] {
        let error = refused(&folder.join(path));
        assert!(error.contains(part) && error.contains(path), "{path}: {error}");
    }
    // A limit for files, as of a full disk. A driver may meet it too, so nothing is rendered.
    let line = "trap '' XFSZ; ulimit -f 0; exec \"$0\" save -o a.toml";
    let mut shell = Command::new("sh");
    shell.args(["-c", line, env!("CARGO_BIN_EXE_thinlens")]).current_dir(folder);
    let limited: Run = shell.env("XDG_CACHE_HOME", common::CACHE).output().expect("sh").into();
    assert_eq!(limited.code, 1);
    assert!(limited.stderr.contains("ulimit -f"), "{}", limited.stderr);
    assert_eq!(names(folder), ["file", "folder.png", "link.png"]);
}

/// Catches the same of reading; and a pipe or a device, which scenes and pictures may name, that is read without
/// end.
#[test]
fn what_cannot_be_read_says_why() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::write(folder.join("file"), "text").expect("a file");
    for name in ["folder.toml", "folder.png", "folder.obj"] {
        fs::create_dir(folder.join(name)).expect("a folder");
    }
    for name in ["pipe.toml", "pipe.obj", "pipe.png"] {
        assert!(Command::new("mkfifo").arg(folder.join(name)).status().expect("mkfifo").success());
    }
    for name in ["zero.toml", "zero.obj", "zero.png", "zero.exr"] {
        symlink("/dev/zero", folder.join(name)).expect("a link");
    }
    symlink("gone.toml", folder.join("link.toml")).expect("a link");
    let scene = "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nvfov_degrees = 60\nlens_diameter = 0.1\n\
                 focal_distance = 5\n[[mesh]]\nfile = \"pipe.obj\"\n";
    fs::write(folder.join("mesh.toml"), scene).expect("a scene");
    let image = scene.replace("[[mesh]]\nfile = \"pipe.obj\"", "aperture_image = \"zero.png\"");
    fs::write(folder.join("image.toml"), image).expect("a scene");
    for (name, size) in [("large.toml", 200 << 20), ("large.obj", 5 << 30)] {
        fs::File::create(folder.join(name)).and_then(|file| file.set_len(size)).expect("a file of holes");
    }
    for (arguments, part) in [
        (&["large.toml"][..], "larger than 128 MiB"),
        (&["large.obj"], "larger than 4096 MiB"),
        (&["none.toml"], "check its name"),
        (&["none/a.toml"], "there is no folder none"),
        (&["link.toml"], "link to gone.toml, which does not exist"),
        (&["file/a.toml"], "no folder"),
        (&["folder.toml"], "it is a folder"),
        (&["folder.obj"], "it is a folder"),
        (&["--from", "folder.png"], "it is a folder"),
        (&["--aperture-image", "folder.png"], "it is a folder"),
        (&["pipe.toml"], "it is a pipe"),
        (&["pipe.obj"], "it is a pipe"),
        (&["--from", "pipe.png"], "it is a pipe"),
        (&["--aperture-image", "pipe.png"], "it is a pipe"),
        (&["zero.toml"], "a device"),
        (&["zero.obj"], "a device"),
        (&["--from", "zero.exr"], "a device"),
        (&["--aperture-image", "zero.png"], "a device"),
        (&["mesh.toml"], "mesh.toml:8: cannot read pipe.obj: it is a pipe"),
        (&["image.toml"], "image.toml:7: cannot read zero.png"),
    ] {
        let outcome: Run = thinlens(folder)
            .args(["render", "-o", "a.png"])
            .args(arguments)
            .output()
            .expect("it starts")
            .into();
        assert_eq!(
            (outcome.code, outcome.stderr.lines().count()),
            (1, 1),
            "{arguments:?}: {}",
            outcome.stderr
        );
        assert!(outcome.stderr.contains(part), "{arguments:?}: {}", outcome.stderr);
    }
}
