//! The program as a user or a CI job runs it.

mod common;

use common::{decode_png, render_png, run, thinlens};
use std::path::Path;

const SMALL: [&str; 4] = ["--size", "48x36", "--samples", "9"];

fn render(folder: &Path, more: &[&str]) -> Vec<u8> {
    render_png(folder, &[&SMALL[..], more].concat())
}

/// Catches flags that are parsed and then forgotten.
#[test]
fn flags_change_the_picture_and_only_as_they_should() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let plain = render(folder, &[]);
    assert_eq!(plain, render(folder, &["version-4"]), "version-4 is the default");
    assert_eq!(decode_png(&plain).0, [48, 36]);
    for more in [
        &["suffern-boxes"][..],
        &["--lens-diameter", "1.5"],
        &["--focal-distance", "4"],
        &["--jitter", "0"],
        &["--max-bounces", "0"],
        &["--seed", "1"],
        &["--sampler", "random"],
        &["--samples", "10"],
        &["--exposure", "1"],
    ] {
        assert_ne!(plain, render(folder, more), "{more:?}");
    }
    let pinhole = |distance| render(folder, &["--lens-diameter", "0", "--focal-distance", distance]);
    assert_eq!(decode_png(&pinhole("3")), decode_png(&pinhole("77")));
}

/// Catches an option, a flag or a list that is refused, or counted twice, if it is given again at the end of a command.
#[test]
fn of_an_option_that_is_given_twice_the_last_counts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let once = render(folder, &["--blades", "6", "--upright=false"]);
    let twice = [
        "--seed",
        "5",
        "--blades",
        "3",
        "--upright",
        "--seed",
        "0",
        "--blades",
        "6",
        "--upright=false",
        "-q",
    ];
    assert_eq!(once, render(folder, &twice));
    let lists = ["--f-numbers", "2,4", "--columns", "2", "--f-numbers", "8", "--columns", "1"];
    let sheet = run(folder, &[&["sweep", "-o", "sheet.png"], &SMALL[..], &lists].concat());
    assert_eq!(sheet.code, 0, "{}", sheet.stderr);
    assert!(sheet.stdout.contains("1 pictures of 48x36"), "{}", sheet.stdout);
    let scenes = run(folder, &["render", "passing", "version-4", "-o", "out.png"]);
    assert_eq!(scenes.code, 2, "two scenes are not one: {}", scenes.stdout);
}

/// Catches an option that takes a number only as computers write it, a unit that counts as another length than the
/// scene says, also where the scene's unit is given behind it, and a sweep that reads numbers in another way.
#[test]
fn numbers_are_given_as_people_type_them() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let saved = |options: &[&str]| {
        let outcome = run(folder, &[&["save", "-o", "out.toml"], options].concat());
        assert_eq!(outcome.code, 0, "{options:?}: {}", outcome.stderr);
        std::fs::read_to_string(folder.join("out.toml")).expect("a scene")
    };
    for (typed, plain) in [
        (&["--shutter", "1/250"][..], &["--shutter", "0.004"][..]),
        (&["--shutter", "1/250 s"], &["--shutter", "0.004"]),
        (&["--f-number", "f/2.8"], &["--f-number", "2.8"]),
        (&["--f-number", "2,8"], &["--f-number", "2.8"]),
        // A unit of version-4 is 5 cm long.
        (&["--focal-distance", "1.2m"], &["--focal-distance", "24"]),
        (&["--lens-diameter", "17 mm"], &["--lens-diameter", "0.34"]),
        (
            &["--lens-diameter", "17 mm", "--metres-per-unit", "1 m"],
            &["--lens-diameter", "0.017", "--metres-per-unit", "1"],
        ),
        (&["--vfov", "30°"], &["--vfov", "30"]),
        (&["--exposure", "-1/2"], &["--exposure", "-0.5"]),
        (&["--iso", "ISO 400"], &["--iso", "400"]),
    ] {
        assert_eq!(saved(typed), saved(plain), "{typed:?}");
    }
    for (option, text, part) in [
        ("--shutter", "1/", "written like 1/250"),
        ("--f-number", "1/4", "written like 2.8 or f/2.8"),
        ("--focal-distance", "3 feet", "or like 17 mm, 35 cm or 1.2 m"),
        ("--iso", "1,600", "could mean two numbers"),
    ] {
        let outcome = run(folder, &["save", "-o", "none.toml", option, text]);
        assert_eq!(outcome.code, 2, "{option} {text}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(part) && outcome.stderr.contains(text), "{}", outcome.stderr);
    }
    let sheet = |list: &str| {
        let outcome = run(
            folder,
            &[&["sweep", "-q", "-o", "sheet.png", "--focal-distances", list], &SMALL[..]].concat(),
        );
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        decode_png(&std::fs::read(folder.join("sheet.png")).expect("a sheet"))
    };
    assert_eq!(sheet("50cm,1.2m"), sheet("10,24"));
}

/// Catches a picture that depends on the number of threads.
#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let picture = |threads: &str| {
        let output = thinlens(folder.path())
            .args(["render", "-o", "out.exr", "-q", "--jitter", "3"])
            .args(SMALL)
            .env("LP_NUM_THREADS", threads)
            .output()
            .expect("it starts");
        assert!(output.status.success());
        std::fs::read(folder.path().join("out.exr")).expect("the picture")
    };
    assert_eq!(picture("1"), picture("2"));
}

/// Catches an EXR without its counts, with channels mixed up, or encoded like a PNG.
#[test]
fn an_exr_holds_linear_values_and_counts() {
    use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
    let folder = tempfile::tempdir().expect("a temporary folder");
    let png = decode_png(&render(folder.path(), &[])).1;
    let run = run(folder.path(), &[&["render", "-q", "-o", "out.exr"], &SMALL[..]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let image = read_first_flat_layer_from_file(folder.path().join("out.exr")).expect("an EXR");
    let layer = &image.layer_data;
    assert_eq!((layer.size.0, layer.size.1), (48, 36));
    let channel = |name: &str| {
        let found = layer.channel_data.list.iter().find(|channel| channel.name.eq(name));
        match &found.unwrap_or_else(|| panic!("no channel {name}")).sample_data {
            FlatSamples::F32(values) => values.clone(),
            _ => panic!("{name} is not f32"),
        }
    };
    assert!(channel("count").iter().all(|count| *count == 9.0));
    let channels = ["R", "G", "B"].map(channel);
    for (index, pixel) in png.iter().enumerate() {
        for (encoded, linear) in pixel.iter().zip(channels.each_ref().map(|channel| channel[index])) {
            let linear = linear.clamp(0.0, 1.0);
            let srgb =
                if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
            // A device may round to the farther neighbour where both are almost equally near.
            assert!((255.0 * srgb - f32::from(*encoded)).abs() < 0.6, "{linear} as {encoded}");
        }
    }
}

/// Catches samples left out without a word: even a quiet run says their number.
#[test]
fn samples_that_are_not_finite_are_said() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("burning.toml"), common::scenes::BURNING).expect("a scene");
    let run =
        run(folder.path(), &["render", "burning.toml", "-o", "out.png", "-q", "-n", "4", "-s", "32x24"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("of 3072 samples are left out"), "{}", run.stderr);
}

/// Catches help that promises the defaults of another command.
#[test]
fn verify_has_defaults_of_its_own() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = run(folder.path(), &["verify", "--help"]).stdout;
    assert!(help.contains("every built-in scene") && help.contains("128x96"), "{help}");
    assert!(!help.contains("version-4") && !help.contains("--exposure"), "{help}");
}

/// Catches figures that are missing or do not fit each other.
#[test]
fn stats_say_what_was_done() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run =
        run(folder.path(), &[&["render", "-o", "out.png", "--stats", "stats.json"], &SMALL[..]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("out.png") && run.stdout.contains("48x36"), "{}", run.stdout);
    let text = std::fs::read_to_string(folder.path().join("stats.json")).expect("the figures");
    let stats: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(stats["scene"], "version-4");
    assert_eq!((&stats["width"], &stats["height"]), (&48.into(), &36.into()));
    assert_eq!(stats["samples_per_pixel"], 9);
    assert_eq!(stats["samples"], 48 * 36 * 9);
    assert_eq!(stats["rejected_samples"], 0);
    let longest = stats["longest_submission_seconds"].as_f64().expect("a number");
    assert!(longest > 0.0 && longest <= stats["seconds"].as_f64().expect("a number"));
    assert!(stats["rays"].as_u64() > stats["samples"].as_u64());
    let rate =
        stats["samples"].as_f64().expect("a number") / stats["seconds"].as_f64().expect("a number") / 1e6;
    assert!((rate / stats["msamples_per_second"].as_f64().expect("a number") - 1.0).abs() < 1e-9);
    for text in ["device", "driver"] {
        assert!(stats[text].as_str().is_some_and(|text| !text.is_empty()));
    }
}

/// Catches wrong use that exits with 0 or 1, that panics, or that does not say what to do.
#[test]
fn wrong_use_exits_with_2_and_says_what_is_right() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (arguments, part) in [
        (&["render"][..], "--output"),
        (&["render", "-o", "out.jpg"], ".png or .exr"),
        (&["render", "verson-4", "-o", "out.png"], "did you mean version-4?"),
        (&["render", "-o", "out.png", "--size", "0x10"], "from 1 to 16384"),
        (&["render", "-o", "out.png", "--size", "20000x10"], "from 1 to 16384"),
        (&["render", "-o", "out.png", "--size", "10"], "1280x720"),
        (&["render", "-o", "out.png", "--samples", "0"], "from 1 to 16777216"),
        (&["render", "-o", "out.png", "--samples", "16777217"], "from 1 to 16777216"),
        (&["render", "-o", "out.png", "--samples", "-1"], "-1"),
        (&["render", "-o", "out.png", "--lens-diameter", "-1"], "lens-diameter is -1"),
        (&["render", "-o", "out.png", "--lens-diameter", "NaN"], "lens-diameter is NaN"),
        (&["render", "-o", "out.png", "--focal-distance", "0"], "focal-distance is 0"),
        (&["render", "-o", "out.png", "--focal-distance", "-2"], "focal-distance is -2"),
        (&["render", "-o", "out.png", "--focal-distance", "inf"], "focal-distance is inf"),
        (&["render", "-o", "out.png", "--jitter", "16"], "from 0 to 15"),
        (&["render", "-o", "out.png", "--max-bounces", "65"], "from 0 to 64"),
        (&["render", "-o", "out.png", "--device", "no such device"], "there are: 0 "),
        (&["render", "-o", "out.png", "--device", "99"], "there are: 0 "),
        // A digit of a device's name or driver is not its index.
        (&["render", "-o", "out.png", "--device", "5"], "there are: 0 "),
        (&["render", "-o", "out.png", "--stats", "out.png"], "the same file"),
        (&["render", "-o", "out.png", "--seed", "-1"], "--seed"),
        (&["render", "-o", "out.png", "--device", ""], "there are: 0 "),
        (&["render", "-o", "out.png", "--samples", "16777216", "--jitter", "2"], "from 1 to 16711680"),
        (&["view", "--samples", "0"], "from 1 to 16777216"),
        (&["rendr"], "render"),
    ] {
        let run = run(folder.path(), arguments);
        assert_eq!(run.code, 2, "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments:?}: '{}' does not say '{part}'", run.stderr);
        assert_eq!(run.stdout, "", "{arguments:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0, "nothing was written");
}

/// Catches failures that exit with 0, take two lines, or leave half a file.
#[test]
fn failures_exit_with_1_and_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("bad.toml"), "[camera]\neye = 7\n").expect("writable");
    std::fs::create_dir(folder.path().join("folder.png")).expect("writable");
    let before = std::fs::read_dir(folder.path()).expect("readable").count();
    for (arguments, part) in [
        (&["render", "none.toml", "-o", "out.png"][..], "cannot read none.toml"),
        (&["render", "bad.toml", "-o", "out.png"], "bad.toml:2: "),
        // Known before the work, not after hours of it.
        (&["render", "-n", "16777216", "-q", "-o", "none/out.png"], "cannot write none/out.png"),
        (
            &["render", "-n", "16777216", "-q", "-o", "out.png", "--stats", "none/s.json"],
            "cannot write none/s.json",
        ),
        (&["render", "-n", "1", "-s", "8x8", "-q", "-o", "folder.png"], "cannot write folder.png"),
        (&["render", "-n", "1", "-s", "8x8", "-q", "-o", "none/out.exr"], "cannot write none/out.exr"),
    ] {
        let run = run(folder.path(), arguments);
        assert_eq!(run.code, 1, "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments:?}: '{}' does not say '{part}'", run.stderr);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), before, "nothing is left behind");
}

/// Catches "no GPU" that passes: without a driver there is no picture and no success.
#[test]
fn no_device_is_a_failure_that_says_what_to_install() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for arguments in [&["render", "-o", "out.png"][..], &["devices"]] {
        let mut command = thinlens(folder.path());
        for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(variable, folder.path().join("none.json"));
        }
        let run: common::Run = command.args(arguments).output().expect("it starts").into();
        assert_eq!(run.code, 1, "{}", run.stderr);
        assert!(run.stderr.contains("lavapipe") && run.stderr.contains("./setup.sh"), "{}", run.stderr);
    }
    assert!(!folder.path().join("out.png").exists());
}

/// Catches lists that are empty, and a device that cannot be named by what the list says.
#[test]
fn scenes_and_devices_are_listed_and_can_be_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenes = run(folder.path(), &["scenes"]);
    assert_eq!(scenes.code, 0);
    for scene in ["version-4", "suffern-boxes", "suffern-mirror", "passing"] {
        assert!(scenes.stdout.contains(scene));
    }
    let devices = run(folder.path(), &["devices"]);
    assert_eq!(devices.code, 0, "{}", devices.stderr);
    let first = devices.stdout.lines().next().expect("a device");
    let (index, rest) = first.split_once("  ").expect("index and name");
    let name = rest.split(" (").next().expect("a name").to_uppercase();
    for device in [index, &name] {
        render(folder.path(), &["--device", device]);
    }
}

/// Catches a viewer that fails where there is no display, instead of giving a picture.
#[test]
fn with_no_display_the_viewer_renders_to_a_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = run(folder.path(), &["view", "suffern-boxes", "--size", "40x30", "--validation"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("no display"), "{}", run.stderr);
    let path = folder.path().join("thinlens.png");
    assert!(run.stdout.contains(path.to_str().expect("a plain path")), "{}", run.stdout);
    let next = format!("{} render suffern-boxes", env!("CARGO_BIN_EXE_thinlens"));
    assert!(run.stdout.contains(&next), "{}", run.stdout);
    assert_eq!(decode_png(&std::fs::read(path).expect("the picture")).0, [40, 30]);
}

/// Catches help that no longer mentions an option.
#[test]
fn help_teaches() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = run(folder.path(), &["--help"]);
    assert_eq!(help.code, 0);
    assert!(help.stdout.contains("Try:") && help.stdout.contains("thinlens render -o picture.png"));
    let help = run(folder.path(), &["render", "--help"]).stdout;
    for option in [
        "--output",
        "--samples",
        "--size",
        "--lens-diameter",
        "--focal-distance",
        "--jitter",
        "--max-bounces",
        "--sampler",
        "--seed",
        "--exposure",
        "--stats",
        "--device",
        "--validation",
        "--quiet",
    ] {
        assert!(help.contains(option), "{option}");
    }
}

/// Catches a panic where the answer cannot be printed: a closed pipe, a full disk.
#[cfg(target_os = "linux")]
#[test]
fn an_answer_that_cannot_be_printed_is_no_panic() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for arguments in [&["scenes"][..], &["devices"], &["render", "-o", "out.png", "-n", "1", "-s", "8x8"]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device");
        let output = thinlens(folder.path()).args(arguments).stdout(full).output().expect("it starts");
        let run: common::Run = output.into();
        assert_eq!(run.code, 1, "{}", run.stderr);
        assert!(run.stderr.contains("standard output") && !run.stderr.contains("panicked"), "{}", run.stderr);
    }
    assert!(folder.path().join("out.png").exists());
}

/// Catches a proof that says nothing, or proves one scene where all were asked for.
#[test]
fn verify_proves_the_device() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let all = run(folder.path(), &["verify", "--size", "32x24", "--samples", "4", "--validation"]);
    assert_eq!((all.code, all.stderr.as_str()), (0, ""), "{}", all.stdout);
    for scene in ["version-4", "suffern-boxes", "suffern-mirror", "passing"] {
        assert!(
            all.stdout.lines().any(|line| line.starts_with(scene) && line.contains("3072 samples")),
            "{}",
            all.stdout
        );
    }
    let one = run(
        folder.path(),
        &["verify", "suffern-boxes", "--size", "32x24", "--samples", "4", "--jitter", "3"],
    );
    assert_eq!((one.code, one.stdout.lines().count()), (0, 2), "{}{}", one.stdout, one.stderr);
}

/// Catches a drawing of another pixel or lens than was asked for, and one that is refused without saying why.
#[test]
fn a_drawing_of_the_optics_is_saved() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let draw = |more: &[&str]| run(folder, &[&["diagram", "-s", "320x240"], more].concat());
    let sentence = |more: &[&str]| {
        let ran = draw(&[&["-o", "lens.svg"], more].concat());
        assert_eq!(ran.code, 0, "{more:?}: {}", ran.stderr);
        let text = std::fs::read_to_string(folder.join("lens.svg")).expect("the drawing");
        assert!(text.contains("On the film") && text.ends_with("</svg>\n"), "{more:?}");
        (ran.stdout, text)
    };
    let (plain, middle) = sentence(&[]);
    assert!(plain.contains("silver") && plain.contains("the film"), "{plain}");
    assert_eq!(sentence(&["--pixel", "160,120"]).1, middle, "the middle is the default");
    for more in [
        &["--pixel", "60,200"][..],
        &["--lens-diameter", "0.1"],
        &["--focal-distance", "20"],
        &["--blades", "5"],
        &["--tolerance", "3"],
        &["--view", "above", "--anamorphic", "2"],
        &["--to-scale"],
        &["--also-at", "5,30"],
        &["--rays", "5"],
        &["--drawing-size", "800x300"],
    ] {
        assert_ne!(sentence(more).1, middle, "{more:?}");
    }
    let picture = |size: &str| {
        let render = ["render", "version-4", "-q", "-n", "1", "-s", size, "-o", "picture.png"];
        assert_eq!(run(folder, &render).code, 0);
    };
    picture("320x240");
    assert_ne!(sentence(&["--picture", "picture.png"]).1, middle, "the pixels are drawn");
    picture("100x80");
    for (more, reason) in [
        (
            &["-o", "a.svg", "--picture", "picture.png"][..],
            "picture.png: it has 100x80 pixels, but the drawing is of a picture with 320x240 pixels",
        ),
        (&["-o", "a.svg", "--picture", "lens.svg"], "lens.svg: it cannot be read"),
        (&["-o", "lens.jpg"], "a drawing is a .svg or a .png; lens.jpg is neither"),
        (&["-o", "a.png", "--drawing-size", "5000x300"], "must be from 200 to 4096"),
        (
            &["-o", "a.svg", "--pixel", "320,0"],
            "pixel is at 320,0, but must be within the picture's 320x240 pixels",
        ),
        (&["-o", "a.svg", "--also-at", "1,2,3"], "--also-at has 3 depths, but can have 2"),
        (&["-o", "a.svg", "--also-at", "-1"], "--also-at is -1, but must be from 1e-6"),
        (&["-o", "a.svg", "--rays", "1"], "rays is 1, but must be from 3 to 65"),
        (
            &["-o", "a.svg", "--drawing-size", "100x300"],
            "the width of the drawing is 100, but must be from 200",
        ),
    ] {
        let ran = draw(more);
        assert!(ran.code == 2 && ran.stderr.contains(reason), "{more:?}: {}", ran.stderr);
    }
    assert!(!folder.join("a.svg").exists(), "what is refused leaves no file");
}

/// Catches a PNG of the drawing in other colours or another size than the SVG, or without its letters.
#[test]
fn a_drawing_is_saved_as_png() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for file in ["lens.svg", "lens.png"] {
        let ran = run(folder, &["diagram", "-q", "-s", "320x240", "--drawing-size", "800x300", "-o", file]);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
    }
    let ([width, height], pixels) = decode_png(&std::fs::read(folder.join("lens.png")).expect("the PNG"));
    assert_eq!([width, height], [1600, 600]);
    let pixel = |[x, y]: [f64; 2]| pixels[(2.0 * y) as usize * width as usize + (2.0 * x) as usize];
    let text = std::fs::read_to_string(folder.join("lens.svg")).expect("the SVG");
    let document = roxmltree::Document::parse(&text).expect("XML");
    let with = |attribute: &str, color: &str| {
        let is = |node: &roxmltree::Node<'_, '_>| node.attribute(attribute) == Some(color);
        document.descendants().find(is).unwrap_or_else(|| panic!("no {attribute} of {color}"))
    };
    // The focal plane is orange, at a place where nothing lies over it.
    let line = with("stroke", "#ffa826").attribute("points").expect("points");
    let (x, y) = line.split_whitespace().next().and_then(|point| point.split_once(',')).expect("a place");
    let [x, y] = [x, y].map(|number| number.parse::<f64>().expect("a number"));
    assert_eq!(pixel([x, y + 2.0]), [0xff, 0xa8, 0x26]);
    // Its name is written in the same colour, thinly.
    let name = with("fill", "#ffa826");
    let number =
        |attribute: &str| name.attribute(attribute).expect("a place").parse::<f64>().expect("a number");
    let [left, base, long] = ["x", "y", "textLength"].map(number);
    let inked = |from: f64, to: f64| {
        let columns = (2.0 * from) as usize..(2.0 * to) as usize;
        let rows = (2.0 * base) as usize - 24..(2.0 * base) as usize;
        let is_orange = |[red, _, blue]: [u8; 3]| red > 120 && blue < 100;
        rows.flat_map(|row| columns.clone().map(move |column| row * width as usize + column))
            .filter(|place| is_orange(pixels[*place]))
            .count()
    };
    let parts = [inked(left, left + 0.5 * long), inked(left + 0.5 * long, left + long + 1.0)];
    assert!(parts.iter().all(|count| *count > 100), "the letters have {parts:?} pixels");
    let paper = [0.05; 3].map(|level: f64| (255.0 * level).round() as u8);
    assert_eq!(pixel([1.0, 1.0]), paper);
}
