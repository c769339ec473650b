//! Scene files: what they mean, and where their errors point.

use glam::{DVec3, Vec3};
use thinlens::error::Error;
use thinlens::scene::{
    self, BUILTINS, Box, CameraModel, Checker, LightKind, Matte, Metal, Overlay, Phong, Plane, Rectangle,
    SceneRef, Sphere, Texture, Tolerance, Triangle, View,
};
use thinlens::settings::{Access, Settings, Unit, list};

/// A valid file; every error below is one line changed or added.
const VALID: &str = r#"size = [64, 48]
[camera]
eye = [0, 0, 0]
look_at = [0, 0, -1]
vfov_degrees = 60
lens_diameter = 0.1
focal_distance = 5
[ambient]
radiance = 1
[[point]]
position = [0, 5, 0]
radiance = 2
[matte.red]
ka = 0.5
kd = 0.5
color = [1, 0, 0]
[phong.blue]
ka = 0.5
kd = 0.5
ks = 0.2
exponent = 10
color = { even = [0, 0, 1], odd = [1, 1, 1], size = 2 }
[[sphere]]
center = [0, 0, -5]
radius = 1
material = "red"
[[triangle]]
vertices = [[0, 0, -9], [1, 0, -9], [0, 1, -9]]
material = "blue"
"#;

fn load(text: &str) -> Result<scene::Scene, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("test.toml");
    std::fs::write(&path, text).expect("a writable temporary folder");
    scene::load(path.to_str().expect("a plain path"))
}

/// The message of an error, which must name the file and the line that `at` stands in.
fn error_at(at: &str, text: &str) -> String {
    let wanted = text.find(at).map(|start| text[..start].matches('\n').count() + 1).expect("it stands there");
    match load(text).expect_err("the file is wrong") {
        Error::Scene { file, line, message } => {
            assert!(file.ends_with("test.toml"), "{file}");
            assert_eq!(line, wanted, "{message}");
            assert!(!message.contains('\n'), "{message}");
            message
        }
        other => panic!("{other}"),
    }
}

/// Catches keys that are read into the wrong field.
#[test]
fn a_file_means_what_it_says() {
    let scene = load(VALID).expect("valid");
    assert_eq!(scene.name, "test");
    assert_eq!(scene.size, [64, 48]);
    assert_eq!((scene.lens.diameter, scene.lens.focal_distance), (0.1, 5.0));
    assert!((scene.camera.vfov_radians - 60_f64.to_radians()).abs() < 1e-12);
    assert_eq!(scene.lights.len(), 1);
    assert!(
        matches!(scene.lights[0].kind, LightKind::Point(light) if light.position.to_array() == [0.0, 5.0, 0.0])
    );
    let red = &scene.materials[scene.of_kind::<Sphere>().next().expect("a sphere").1.material as usize];
    assert_eq!(*red, Matte { color: Texture::constant(Vec3::X), ka: 0.5, kd: 0.5 }.into());
    let blue = &scene.materials[scene.of_kind::<Triangle>().next().expect("a triangle").1.material as usize];
    let color = Checker { even: Vec3::Z, odd: Vec3::ONE, size: 2.0 }.into();
    assert_eq!(*blue, Phong { color, ka: 0.5, kd: 0.5, ks: 0.2, exponent: 10.0 }.into());
}

/// Catches a view that is read and forgotten, and a preset that does not give the lens and the field of view, or that
/// wins over what is said beside it.
#[test]
fn a_file_says_how_the_picture_is_shown_and_with_which_lens() {
    let with = |camera: &str| {
        let text = VALID.replacen("vfov_degrees = 60\n", "", 1).replacen("lens_diameter = 0.1\n", camera, 1);
        load(&format!(
            "{text}[view]\nexposure = -1.5\nexposure_lock = false\noverlay = \"depth\"\ntolerance = 2\n"
        ))
        .expect("valid")
    };
    let scene = with("preset = \"50mm-f1.4\"\n");
    let view = View {
        exposure_stops: -1.5,
        exposure_lock: false,
        overlay: Some(Overlay::Depth),
        tolerance: Tolerance::Pixels(2.0),
        ..View::default()
    };
    assert_eq!(scene.view, view);
    assert_eq!(Settings::of_scene(SceneRef::new(with("preset = \"50mm-f1.4\"\n"))).view, view);
    assert!((scene.camera.focal_length_mm() - 50.0).abs() < 1e-9);
    assert!((scene.camera.f_number(scene.lens.diameter) - 1.4).abs() < 1e-6);
    let scene = with("preset = \"50mm-f1.4\"\nf_number = 4\nvfov_degrees = 40\n");
    assert!((scene.camera.vfov_degrees() - 40.0).abs() < 1e-9);
    assert!((scene.camera.f_number(scene.lens.diameter) - 4.0).abs() < 1e-6);
    // A lens keeps its focal length and its f-number on another sensor, which sees less through it.
    let aps_c = "sensor = \"aps-c\"\nfocus_breathing = true\n";
    for lens in ["preset = \"50mm-f1.4\"\n", "focal_length = 50\nf_number = 1.4\n"] {
        let camera = with(&format!("{aps_c}{lens}")).camera;
        assert_eq!((camera.sensor.width_mm, camera.focus_breathing), (23.5, true));
        assert!((camera.focal_length_mm() - 50.0).abs() < 1e-9, "{lens}: {}", camera.focal_length_mm());
        assert!((camera.vfov_degrees() - 17.733).abs() < 1e-3, "{lens}: {}", camera.vfov_degrees());
    }
    assert_eq!(
        with("sensor = \"30x20.5\"\nvfov_degrees = 40\nlens_diameter = 1\n").camera.sensor.height_mm,
        20.5
    );
    let scene = with("preset = \"pinhole\"\nvfov_degrees = 40\n");
    assert_eq!((scene.model, scene.lens.diameter), (CameraModel::Pinhole, 0.0));
    let scene = with("preset = \"pinhole\"\nvfov_degrees = 40\nmodel = \"thin-lens\"\nlens_diameter = 3\n");
    assert_eq!((scene.model, scene.lens.diameter), (CameraModel::ThinLens, 3.0));
}

/// Catches errors that point nowhere, and mistakes that pass as something else.
#[test]
fn an_error_names_its_line_and_what_would_be_right() {
    let with = |old: &str, new: &str| {
        assert!(VALID.contains(old));
        VALID.replacen(old, new, 1)
    };
    let rectangle = |edges: &str| {
        format!("{VALID}[[rectangle]]\ncorner = [0, 0, -9]\nedges = {edges}\nmaterial = \"red\"\n")
    };
    for (at, text, part) in [
        ("vfov_degres", with("vfov_degrees = 60", "vfov_degres = 60"), "vfov_degrees"),
        ("radios", with("radius = 1\n", "radius = 1\nradios = 2\n"), "radios"),
        ("[[cone", format!("{VALID}[[cone]]\nradius = 1\n"), "cone"),
        ("= 180", with("= 60", "= 180"), "vfov_degrees is 180, but must be from 0.01 to 175"),
        ("[camera]", with("vfov_degrees = 60", "view_distance = 1e-6\npixel_size = 1e9"), "175"),
        ("= -0.1", with("= 0.1", "= -0.1"), "from 0"),
        ("= 0e0", with("focal_distance = 5", "focal_distance = 0e0"), "must be from"),
        ("= nan", with("focal_distance = 5", "focal_distance = nan"), "must be from"),
        ("= -1\n", with("radius = 1\n", "radius = -1\n"), "radius is -1, but must be from"),
        ("\"rde\"", with("\"red\"", "\"rde\""), "blue, red"),
        ("[[0, 0, -9]", with("[1, 0, -9]", "[0, 0, -9]"), "one line"),
        ("[[1, 1, 0]", rectangle("[[1, 1, 0], [0, 2, 0]]"), "must be perpendicular"),
        ("[[1, 1, 0]", rectangle("[[1, 1, 0], [-2, -2, 0]]"), "same direction"),
        ("[[1, 1, 0]", rectangle("[[1, 1, 0], [0, 0, 0]]"), "too short"),
        ("[1, 1, 0]", rectangle("[1, 1, 0]"), "two edges, [[x, y, z], [x, y, z]]"),
        ("[1, 0]", with("[1, 0, 0]", "[1, 0]"), "[r, g, b]"),
        ("[camera]", with("vfov_degrees = 60\n", ""), "vfov_degrees, or focal_length"),
        ("\"50mm\"", with("vfov_degrees = 60", "preset = \"50mm\""), "50mm-f1.8, 50mm-f1.4"),
        ("[camera]", with("vfov_degrees = 60", "preset = \"pinhole\""), "has a field of view"),
        (
            "\"lens\"",
            with("vfov_degrees = 60", "vfov_degrees = 60\nmodel = \"lens\""),
            "thin-lens, pinhole, hole",
        ),
        (
            "metres_per_unit = 0",
            with("vfov_degrees = 60", "vfov_degrees = 60\nmetres_per_unit = 0"),
            "from 1e-15",
        ),
        (
            "\"super-8\"",
            with("vfov_degrees = 60", "vfov_degrees = 60\nsensor = \"super-8\""),
            "full-frame, aps-c",
        ),
        (
            "= 5\n",
            with("vfov_degrees = 60", "focal_length = 5000\nfocus_breathing = true"),
            "focal_distance is 5, but with focus breathing a lens of 5000",
        ),
        ("[camera]", with("vfov_degrees = 60", "vfov_degrees = 60\nfocal_length = 50"), "vfov_degrees, or"),
        ("[camera]", with("lens_diameter = 0.1\n", ""), "lens_diameter, f_number or a preset"),
        ("\"blur\"", with("[camera]", "[view]\noverlay = \"blur\"\n[camera]"), "circle-of-confusion, depth"),
        ("exposures", with("[camera]", "[view]\nexposures = 1\n[camera]"), "exposure"),
        (
            "[camera]",
            with("look_at = [0, 0, -1]", "look_at = [0, 0, 0]"),
            "eye and look_at are the same point",
        ),
        ("[camera]", with("look_at = [0, 0, -1]", "look_at = [0, -1, 0]"), "line of sight"),
        ("[64, 0]", with("[64, 48]", "[64, 0]"), "from 1 to 16384"),
        ("[phong.red]", with("[phong.blue]", "[phong.red]"), "another material called 'red'"),
        ("[matte.red\n", with("[matte.red]", "[matte.red"), ""),
        ("", String::new(), "camera"),
    ] {
        let message = error_at(at, &text);
        assert!(message.contains(part), "{at}: '{message}' does not say '{part}'");
    }
}

/// Catches edges that are a little slanted because of their few digits, and stay so.
#[test]
fn the_edges_of_a_rectangle_are_perpendicular() {
    let edges = "[[0.707, 0.707, 0.02], [-0.353, 0.354, 0.001]]";
    let text = format!("{VALID}[[rectangle]]\ncorner = [0, 1, -9]\nedges = {edges}\nmaterial = \"red\"\n");
    let scene = load(&text).expect("valid");
    let [a, b] = scene.of_kind::<Rectangle>().next().expect("a rectangle").0.edges;
    assert!(a.dot(b).abs() < 1e-15, "{a} and {b}");
    assert!(a == DVec3::new(0.707, 0.707, 0.02) && b.distance(DVec3::new(-0.353, 0.354, 0.001)) < 1e-3);
}

/// A text for a number of each kind, and the number in the unit that the option has. A length is in metres.
fn text_of(unit: Unit) -> (&'static str, f64) {
    match unit {
        Unit::Plain => ("3/4", 0.75),
        Unit::FNumber => ("f/2,8", 2.8),
        Unit::Seconds => ("1/250 s", 0.004),
        Unit::Length => ("12,5 cm", 0.125),
        Unit::Metres => ("5 cm", 0.05),
        Unit::Millimetres => ("8.5 cm", 85.0),
        Unit::Degrees => ("12.5°", 12.5),
        Unit::Stops => ("-1/3 EV", -1.0 / 3.0),
        Unit::Iso => ("ISO 400", 400.0),
        Unit::Pixels | Unit::Fraction => unreachable!("no key is of this kind"),
    }
}

/// Catches a key that does not read what its option reads, a unit that is ignored, a fraction that is upside down, and a
/// length that is divided by the length of a scene unit twice, not at all, or by that of another file.
#[test]
fn numbers_of_camera_and_view_may_have_units() {
    let base = VALID.replace("[ambient]", "[view]\n[ambient]");
    let mut keys = 0;
    for setting in list::all() {
        let Some(key) = setting.key.filter(|key| ["camera", "view"].contains(&key.table)) else { continue };
        let (Access::Single(_, _, unit) | Access::Double(_, _, unit)) = &setting.access else { continue };
        keys += 1;
        let (text, number) = text_of(*unit);
        let number = if *unit == Unit::Length { number / 0.05 } else { number };
        // No two keys may say the same.
        let other = match key.name {
            "f_number" => "lens_diameter",
            "focal_length" => "vfov_degrees",
            name => name,
        };
        let kept: Vec<&str> = base.lines().filter(|line| !line.starts_with(other)).collect();
        let header = format!("[{}]", key.table);
        let metres = if key.name == "metres_per_unit" { "" } else { "metres_per_unit = 0.05\n" };
        let with = |value: &str| {
            let line = format!("{header}\n{} = {value}", key.name);
            // The length of a scene unit comes after the keys that depend on it.
            let file = kept.join("\n").replacen(&header, &line, 1);
            let file = file.replacen("look_at = [0, 0, -1]\n", &format!("look_at = [0, 0, -1]\n{metres}"), 1);
            Settings::of_scene(SceneRef::new(load(&file).unwrap_or_else(|error| panic!("{value}: {error}"))))
        };
        let (by_text, by_number) = (with(&format!("\"{text}\"")), with(&format!("{number}")));
        let is = setting.number(&by_text).expect("a number");
        assert!((is / number - 1.0).abs() < 1e-6, "{} = \"{text}\" is {is}, not {number}", key.name);
        assert_eq!(setting.get(&by_text), setting.get(&by_number), "{}", key.name);
        let mut by_option = with(&format!("{number}"));
        setting.set(&mut by_option, &setting.parse(text).expect(text)).expect("a number");
        let is = setting.number(&by_option).expect("a number");
        assert!((is / number - 1.0).abs() < 1e-6, "{} {text} is {is}, not {number}", setting.flag);
    }
    assert!(keys > 15, "only {keys} keys were tried");
    // The two lengths of the book have no options.
    let book = VALID.replacen("vfov_degrees = 60", "view_distance = \"4 m\"\npixel_size = 0.5", 1);
    let book = book.replacen("[ambient]", "metres_per_unit = 0.01\n[ambient]", 1);
    let camera = load(&book).expect("valid").camera;
    let tan = (0.5 * camera.vfov_radians).tan();
    assert!((tan - 24.0 * 0.5 / 400.0).abs() < 1e-12, "{tan}");
}

/// Catches a number with a unit that is refused without its key, its line, its text, or what can be written instead.
#[test]
fn a_wrong_unit_is_told_what_can_be_written() {
    let with = |line: &str| VALID.replacen("vfov_degrees = 60", &format!("vfov_degrees = 60\n{line}"), 1);
    for (line, parts) in [
        ("shutter = \"fast\"", &["shutter is \"fast\", but a time is written like 1/250"][..]),
        ("shutter = \"1/0\"", &["shutter is \"1/0\"", "1/250"]),
        ("shutter = \"85 mm\"", &["shutter is \"85 mm\"", "1/250"]),
        ("hole_diameter = \"1 inch\"", &["hole_diameter is \"1 inch\"", "17 mm, 35 cm or 1.2 m"]),
        ("hole_diameter = \"1,250 m\"", &["hole_diameter is", "write 1.250 or 1250"]),
        ("hole_diameter = \"-1 m\"", &["hole_diameter is -1, but must be from 0", "the text \"-1 m\""]),
        ("lens_shift = \"2 km\"", &["lens_shift is 2e6, but must be", "here is the text \"2 km\""]),
        ("iso = \"nan\"", &["iso is NaN, but must be", "here is the text"]),
        ("iso = true", &["iso must be a number, or a text in quotes", "ISO 400", "here is true"]),
        ("shutter = 1/250", &["'1/250' is not a number", "stands in quotes: \"1/250\""]),
        ("lens_shift = 85mm", &["'85mm' is not a number", "stands in quotes: \"85mm\""]),
    ] {
        let message = error_at(line, &with(line));
        for part in parts {
            assert!(message.contains(part), "{line}: '{message}' does not say '{part}'");
        }
    }
    // A shape has plain numbers only.
    let message = error_at("radius = 1m", &VALID.replacen("radius = 1", "radius = 1m", 1));
    assert!(!message.contains("quotes"), "{message}");
    let message = error_at("radius = \"", &VALID.replacen("radius = 1", "radius = \"1 m\"", 1));
    assert!(message.contains("radius must be a number; here is the text"), "{message}");
}

/// Catches a saved scene whose lengths in metres are those of another scene unit, a text that is written for a number, and
/// a text that is lost although nothing changed.
#[test]
fn a_saved_scene_has_plain_numbers_where_something_changed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("test.toml");
    let text = VALID.replacen(
        "focal_distance = 5",
        "focal_distance = \"1.2 m\"\nshutter = \"1/250\"\niso = \"ISO 200\"\nmetres_per_unit = 0.05",
        1,
    );
    std::fs::write(&path, text).expect("a writable temporary folder");
    let mut settings = Settings::of_scene(SceneRef::new(scene::load(&path).expect("valid")));
    assert_eq!(settings.estimator.lens.focal_distance, 24.0);
    let saved = settings.scene_file(folder.path()).expect("it can be saved");
    for line in ["focal_distance = \"1.2 m\"", "shutter = \"1/250\"", "iso = \"ISO 200\""] {
        assert!(saved.contains(line), "{line}: {saved}");
    }
    settings.view.iso = 400.0;
    settings.estimator.camera.metres_per_unit = 0.1;
    let saved = settings.scene_file(folder.path()).expect("it can be saved");
    for line in ["focal_distance = 24.0\n", "iso = 400.0\n"] {
        assert!(saved.contains(line), "{line}: {saved}");
    }
    std::fs::write(&path, saved).expect("a writable temporary folder");
    assert_eq!(scene::load(&path).expect("valid").lens.focal_distance, 24.0);
}

/// Catches a file whose reading panics: every prefix of a valid one is fine or an error.
#[test]
fn no_prefix_of_a_file_panics() {
    for end in 0..VALID.len() {
        let _ = load(&VALID[..end]);
    }
}

/// Catches a built-in that strays from the figures it claims to be.
#[test]
fn the_built_in_scenes_are_those_of_the_book() {
    let boxes = scene::load("suffern-boxes").expect("a built-in");
    assert_eq!(boxes.size, [400, 300]);
    assert!((boxes.camera.view_distance_pixels(300) - 800.0).abs() < 1e-9, "k is 800 pixels");
    assert_eq!((boxes.lens.diameter, boxes.lens.focal_distance), (2.0, 74.0));
    let of_boxes: Vec<_> = boxes.of_kind::<Box>().collect();
    assert_eq!(of_boxes.len(), 3);
    // The focal plane lies on the front of the middle box.
    let depth = boxes.camera.frame().axial_depth(boxes.camera.eye, of_boxes[1].0.upper);
    assert!((depth - 74.0).abs() < 1e-9);

    let mirror = scene::load("suffern-mirror").expect("a built-in");
    assert_eq!(mirror.size, [450, 300]);
    assert!((mirror.camera.view_distance_pixels(300) - 600.0).abs() < 1e-9, "k is 600 pixels");
    // The red plane lies on the focal plane, 100 along the axis, and across it.
    let (camera, red) = (&mirror.camera, *mirror.of_kind::<Plane>().nth(1).expect("a plane").0);
    let depth = camera.frame().axial_depth(camera.eye, red.point);
    assert!((depth - 100.0).abs() < 1e-4, "{depth}");
    assert!(red.normal.as_dvec3().normalize().dot(camera.frame().w()) > 1.0 - 1e-12);

    let version_4 = scene::load("version-4").expect("a built-in");
    assert!(
        version_4.of_kind::<Sphere>().count() >= 10
            && version_4.of_kind::<Triangle>().count() > 0
            && version_4.of_kind::<Box>().count() >= 3
    );
}

/// Catches a misspelt name that gives no hint, and a built-in that does not load.
#[test]
fn scenes_are_found_by_name() {
    for builtin in BUILTINS {
        assert_eq!(scene::load(builtin.name).expect("it is built in").name, builtin.name);
    }
    for (name, hint) in
        [("version4", "version-4"), ("boxes", "suffern-boxes"), ("zzz", "the built-in ones are")]
    {
        let error = scene::load(name).expect_err("no such scene");
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains(hint), "{error}");
    }
    let error = scene::load("nowhere/scene.toml").expect_err("no such file");
    assert_eq!(error.exit_code(), 1);
    assert!(error.to_string().contains("nowhere/scene.toml"), "{error}");
}

/// Catches a measured metal whose numbers are not those that are documented, and one that is not documented.
#[test]
fn measured_metals_have_the_documented_colors() {
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scenes.md")).expect("the page");
    let mut known = Vec::new();
    for line in page.lines() {
        let Some((name, rest)) = line.strip_prefix("| `\"").and_then(|rest| rest.split_once("\"` | ")) else {
            continue;
        };
        let numbers: Vec<f32> =
            rest.trim_end_matches(" |").split(", ").map(|number| number.parse().expect("a number")).collect();
        let text = VALID.replacen(
            "[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]",
            &format!("[metal.red]\ncolor = \"{name}\""),
            1,
        );
        let scene = load(&text).expect("a metal");
        let red = &scene.materials[scene.of_kind::<Sphere>().next().expect("a sphere").1.material as usize];
        let color = Texture::constant(Vec3::from_slice(&numbers));
        assert_eq!(*red, Metal { color, roughness: 0.0 }.into());
        known.push(name);
    }
    let other = VALID.replacen(
        "[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]",
        "[metal.red]\ncolor = \"tin\"",
        1,
    );
    let message = error_at("color = \"tin\"", &other);
    assert!(message.ends_with(&known.join(", ")), "{message}");
}

/// Catches documentation of keys that are no longer read.
#[test]
fn the_documented_example_is_valid() {
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scenes.md")).expect("the page");
    let example =
        page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let scene = load(example).expect("the example");
    let counts = (scene.of_kind::<Sphere>().count(), scene.of_kind::<Plane>().count(), scene.lights.len());
    assert_eq!(counts, (1, 1, 1));
}
