//! A walk over the list of settings: what follows from it holds of each of them.

mod common;

use common::run;
use std::path::Path;
use thinlens::error::Error;
use thinlens::output;
use thinlens::scene::{
    self, FORMATS, SENSOR_SIDES_MM, SceneRef, Sensor, TOLERANCES_MM, TOLERANCES_PIXELS, Tolerance,
};
use thinlens::settings::{Access, Called, Changes, Role, Setting, Settings, Value, Widget, list};

/// The settings of a built-in scene. For a setting of a model, those of a lone mesh, and for the integrator, those of a
/// scene that each integrator can render.
fn plain_for(setting: &Setting, folder: &Path) -> Settings {
    if setting.flag == "integrator" {
        let file = folder.join("plain.toml");
        let camera =
            "eye = [0, 0, 3]\nlook_at = [0, 0, 0]\nvfov_degrees = 30\nlens_diameter = 0\nfocal_distance = 3";
        std::fs::write(&file, format!("[camera]\n{camera}\n")).expect("a scene");
        return Settings::of_scene(SceneRef::new(scene::load(&file).expect("a scene")));
    }
    if !setting.is_of_model() {
        return plain();
    }
    let file = folder.join("some.obj");
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a mesh");
    Settings::of_scene(SceneRef::new(scene::load(&file).expect("a mesh")))
}

fn plain() -> Settings {
    Settings::of_scene(SceneRef::new(scene::load("version-4").expect("a built-in scene")))
}

/// An image that light comes in through.
fn image(folder: &Path) -> std::path::PathBuf {
    let path = folder.join("opening.png");
    let mut encoder = png::Encoder::new(std::fs::File::create(&path).expect("a file"), 2, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().expect("a header").write_image_data(&[255, 40]).expect("pixels");
    path
}

/// A value that the setting may have, and has not.
fn another(setting: &Setting, now: &Value, folder: &Path) -> Value {
    let number = |now: f64, [low, high]: [f64; 2]| {
        let next = 1.0_f64.max(now) / 3.0;
        if next > low && next < high && next != now { next } else { 0.5 * (low + high) }
    };
    let single = |now: f32, range: [f32; 2]| number(now.into(), range.map(f64::from)) as f32;
    match (&setting.access, now) {
        (Access::Single(_, range, _), Value::Single(now)) => Value::Single(single(*now, *range)),
        (Access::Double(_, range, _), Value::Double(now)) => Value::Double(number(*now, *range)),
        (Access::Whole(_, [low, high]), Value::Whole(now)) => {
            Value::Whole(if now < high { now + 1 } else { *low })
        }
        (Access::WholeOrZero(_, [low, _], _), Value::Whole(now)) => {
            Value::Whole(if now == low { low + 1 } else { *low })
        }
        (Access::Switch(_), Value::Switch(now)) => Value::Switch(!now),
        (Access::Vector(..) | Access::Color(..), Value::Vector(now)) => Value::Vector(*now / 3.0 + 0.1),
        (Access::Size(..), Value::Size([width, height])) => Value::Size([width + 1, height + 2]),
        // The last one of the known lenses that has a field of view, and the last one of others.
        (Access::Choice(_, choices), Value::Name(now)) => {
            let mut names: Vec<&str> = choices().iter().map(|choice| choice.name).collect();
            names.sort_by_key(|name| name.starts_with("50mm"));
            Value::Name(names.into_iter().rev().find(|name| name != now).expect("another name"))
        }
        (Access::Sensor(_), Value::Sensor(_)) => Value::Sensor(Sensor { width_mm: 23.6, height_mm: 15.75 }),
        (Access::Tolerance(_), Value::Tolerance(_)) => Value::Tolerance(Tolerance::Pixels(2.5)),
        (Access::Image(_), Value::File(None)) => Value::File(Some(image(folder))),
        (_, now) => panic!("--{} is {now:?}", setting.flag),
    }
}

/// Words that the setting's option refuses as out of its range, if it has one.
fn out_of_range(setting: &Setting) -> Vec<String> {
    let around = |low: f64, high: f64| vec![(low - 1.0).to_string(), (high * 2.0).to_string(), "NaN".into()];
    match &setting.access {
        Access::Single(_, [low, high], _) => around((*low).into(), (*high).into()),
        Access::Double(_, [low, high], _) => around(*low, *high),
        Access::Whole(_, [low, high]) => {
            let around = [low.checked_sub(1), high.checked_add(1)];
            around.into_iter().flatten().map(|number| number.to_string()).collect()
        }
        Access::WholeOrZero(_, [low, high], _) => {
            // One less than 1 is 0, which is allowed.
            let around = [*low - 1, *high + 1];
            around.into_iter().filter(|number| *number > 0).map(|number| number.to_string()).collect()
        }
        Access::Vector(_, [low, high]) | Access::Color(_, [low, high]) => {
            let low = low.min(-1.0);
            vec![format!("0,{},1", low * 2.0), format!("1,0,{}", high * 2.0), "NaN,0,0".into()]
        }
        Access::Size(_, [low, high]) => vec![format!("{}x9", low - 1), format!("9x{}", high + 1)],
        Access::Sensor(_) => ["0x24", "36x2000", "-3x24", "NaNx24"].map(String::from).to_vec(),
        Access::Tolerance(_) => ["0.05", "2000px", "NaN", "20mm", "0mm", "-1mm"].map(String::from).to_vec(),
        Access::Switch(_) | Access::Choice(..) | Access::Image(_) => Vec::new(),
    }
}

/// The flags of the settings in which two differ.
fn difference(a: &Settings, b: &Settings) -> Vec<&'static str> {
    list::own().filter(|setting| setting.get(a) != setting.get(b)).map(|setting| setting.flag).collect()
}

/// Catches a setting whose value is read from one place and written to another, that pictures do not carry, that
/// belongs to the other half, and an alias that changes more or less than it says.
#[test]
fn each_setting_changes_what_it_says_and_is_carried_by_pictures() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for setting in list::all() {
        let plain = plain_for(setting, folder.path());
        let (flag, mut settings) = (setting.flag, plain.clone());
        let value = another(setting, &setting.get(&plain), folder.path());
        Changes::of(flag, value.clone()).apply(&mut settings).expect("a value that it may have");
        let mut changed = difference(&settings, &plain);
        if setting.is_of_model() {
            // The camera and the lens follow how the model stands.
            changed.retain(|flag| list::setting(flag).is_of_model());
        }
        match setting.role {
            Role::Alias(others) => {
                assert!(changed.iter().all(|flag| others.contains(flag)), "--{flag} changes {changed:?}");
                assert!(!changed.is_empty(), "--{flag} changes nothing");
            }
            role => {
                assert_eq!(changed, [flag]);
                assert_eq!(setting.get(&settings), value, "--{flag}");
                // The overlay of the error needs a film that keeps moments.
                let mut estimator = settings.estimator.clone();
                estimator.keeps_moments = plain.estimator.keeps_moments;
                let restarts = [Role::Estimator, Role::Model].contains(&role);
                assert_eq!(estimator != plain.estimator, restarts, "--{flag}");
                assert_eq!(settings.view != plain.view, role == Role::View, "--{flag}");
            }
        }
        let again = Settings::of_arguments(&settings.arguments()).expect("settings");
        assert_eq!(difference(&again, &settings), Vec::<&str>::new(), "--{flag} is lost");
    }
}

/// Catches a range that is not looked at, and an error that names something else than the user did.
#[test]
fn a_value_out_of_range_is_refused_by_the_name_that_the_user_gave() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut refused = 0;
    for setting in list::all() {
        let plain = plain_for(setting, folder.path());
        for word in out_of_range(setting) {
            let value = setting.parse(&word).expect("a number");
            let error = Changes::of(setting.flag, value).apply(&mut plain.clone()).expect_err(setting.flag);
            let error = error.to_string();
            let flag = format!("--{} ", setting.flag);
            assert!(error.starts_with(&flag) && error.contains("must be from"), "{word}: {error}");
            refused += 1;
        }
    }
    assert!(refused > 50, "only {refused} values were tried");
}

/// A scene file with every key that has a value in these settings, but for one line in place of another key's.
fn scene_with(settings: &Settings, instead_of: &str, line: &str) -> String {
    let mut tables = [("", String::new()), ("camera", "[camera]\n".into()), ("view", "[view]\n".into())];
    for setting in list::own() {
        let Some(key) = &setting.key else { continue };
        let value = match setting.get(settings) {
            Value::Single(number) => format!("{number:?}"),
            Value::Double(number) => format!("{number:?}"),
            Value::Whole(number) => number.to_string(),
            Value::Switch(is) => is.to_string(),
            Value::Vector(place) => format!("{:?}", place.to_array()),
            Value::Size(size) => format!("{size:?}"),
            Value::Name("none") | Value::File(_) | Value::Metres(_) => continue,
            Value::Name(name) => format!("{name:?}"),
            Value::Tolerance(tolerance) => format!("\"{tolerance}\""),
            Value::Sensor(sensor) => format!("\"{sensor}\""),
        };
        let line = if key.name == instead_of { line.into() } else { format!("{} = {value}", key.name) };
        let table = tables.iter_mut().find(|(name, _)| *name == key.table).expect("a table");
        table.1 += &format!("{line}\n");
    }
    tables.map(|(_, text)| text).concat()
}

/// Catches a key of a scene file whose range is not looked at, or whose error has another line or another name.
#[test]
fn a_value_out_of_range_in_a_scene_file_is_refused_by_its_key() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (plain, file) = (plain(), folder.path().join("some.toml"));
    let load = |text: &str| {
        std::fs::write(&file, text).expect("a file");
        scene::load(&file)
    };
    load(&scene_with(&plain, "", "")).expect("a scene");
    let mut refused = 0;
    for setting in list::all() {
        let Some(key) = &setting.key else { continue };
        let instead_of = match setting.flag {
            "f-number" => "lens_diameter",
            "focal-length" => "vfov_degrees",
            _ => key.name,
        };
        for word in out_of_range(setting) {
            let value = match setting.access {
                Access::Size(..) => format!("[{}]", word.replace('x', ", ")),
                Access::Vector(..) | Access::Color(..) => format!("[{}]", word.to_lowercase()),
                Access::Sensor(_) => format!("{word:?}"),
                Access::Tolerance(_) if word.ends_with('m') || word.ends_with('x') => format!("{word:?}"),
                _ => word.to_lowercase(),
            };
            let line = format!("{} = {value}", key.name);
            let text = scene_with(&plain, instead_of, &line);
            let expected = text.lines().position(|other| other == line).expect("the line") + 1;
            match load(&text) {
                Err(Error::Scene { line, message, .. }) => {
                    assert_eq!(line, expected, "{}: {message}", key.name);
                    let begins = message.starts_with(&format!("{} is ", key.name));
                    assert!(begins && message.contains("must be from"), "{value}: {message}");
                }
                other => panic!("{} = {value}: {other:?}", key.name),
            }
            refused += 1;
        }
    }
    assert!(refused > 40, "only {refused} values were tried");
}

/// Catches an option that is missing in the help of a command, and one that is shown where it does nothing.
#[test]
fn each_setting_has_an_option_and_those_that_do_nothing_are_not_shown() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = |command: &str| {
        let text = run(folder.path(), &[command, "--help"]).stdout;
        text.split_whitespace().map(str::to_owned).collect::<Vec<_>>()
    };
    let shown = |help: &[String], setting: &Setting| {
        help.iter().any(|word| word.split('[').next() == Some(&format!("--{}", setting.flag)))
    };
    let [render, save, verify] = ["render", "save", "verify"].map(help);
    for setting in list::all() {
        assert!(shown(&render, setting), "--{}", setting.flag);
        let is_of_scene = setting.key.is_some() || setting.is_of_model();
        assert_eq!(shown(&save, setting), is_of_scene, "save --{}", setting.flag);
        let shows = setting.role == Role::View || setting.flag == "noise-threshold";
        assert_eq!(shown(&verify, setting), !shows, "verify --{}", setting.flag);
        let text = render.join(" ");
        let first_words: Vec<&str> = setting.help.split_whitespace().take(6).collect();
        assert!(text.contains(&first_words.join(" ")), "--{}: {first_words:?}", setting.flag);
    }
}

/// Catches two settings of one name, and choices that do not come back by their names.
#[test]
fn names_are_names_of_one_thing() {
    for (index, setting) in list::all().enumerate() {
        for called in [Called::Flag, Called::Key, Called::Label] {
            let name = setting.name(called);
            assert!(list::all().take(index).all(|other| other.name(called) != name), "{name}");
        }
        if let (Access::Choice(_, choices), false) = (&setting.access, setting.is_alias()) {
            for choice in choices() {
                let mut settings = plain();
                setting.set(&mut settings, &Value::Name(choice.name)).expect("a choice");
                assert_eq!(setting.get(&settings), Value::Name(choice.name), "--{}", setting.flag);
            }
        }
    }
}

/// Catches a setting that a saved scene lacks or has under another key, one that says how a scene is sampled and gets
/// into its file, and one that is lost, or kept, when another scene is opened.
#[test]
fn each_setting_of_a_scene_is_saved_and_the_others_stay() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (plain, file) = (plain(), folder.path().join("saved.toml"));
    let text_of = |settings: &Settings| {
        output::save_scene(settings, &file).expect("a saved scene");
        std::fs::read_to_string(&file).expect("text")
    };
    let unchanged = text_of(&plain);
    // tests/model.rs looks at those of a model.
    for setting in list::own().filter(|setting| !setting.is_of_model()) {
        let (flag, mut settings) = (setting.flag, plain.clone());
        let value = another(setting, &setting.get(&plain), folder.path());
        setting.set(&mut settings, &value).expect("a value that it may have");
        let text = text_of(&settings);
        let again = Settings::of_scene(SceneRef::new(scene::load(&file).expect("a scene")));
        let stays = plain.with_scene(again.estimator.scene.clone());
        let kept = settings.with_scene(plain.estimator.scene.clone());
        if let Some(key) = &setting.key {
            // The brightness stays though the shutter or the film is another one.
            let lost: Vec<&str> =
                difference(&again, &settings).into_iter().filter(|flag| *flag != "exposure").collect();
            assert_eq!(lost, Vec::<&str>::new(), "--{flag} is lost");
            assert!(text.contains(&format!("{} = ", key.name)), "{} is not written", key.name);
            let of_picture = ["size", "overlay", "tolerance"].contains(&flag);
            assert_eq!(difference(&kept, &plain).contains(&flag), of_picture, "--{flag} in another scene");
            let of_window = ["size", "tolerance"].contains(&flag);
            assert_eq!(difference(&stays, &plain).contains(&flag), !of_window, "--{flag} of the scene");
        } else {
            assert_eq!(text, unchanged, "--{flag} says how a scene is sampled, and is saved");
            assert_eq!(difference(&kept, &settings), Vec::<&str>::new(), "--{flag} in another scene");
        }
    }
}

/// Catches a row whose widget does not fit what the setting is, so that it does nothing, and a slider that goes where
/// the setting may not be.
#[test]
fn each_row_fits_its_setting() {
    let plain = plain();
    for setting in list::all() {
        let Some(row) = &setting.row else { continue };
        let within = |[low, high]: [f64; 2]| match &row.widget {
            Widget::Slider(slider) => {
                let [first, last] = (slider.range)(&plain).map(f64::from);
                assert!(first < last, "{}: {first} to {last}", row.label);
                // A range in f64 is met as nearly as f32 can.
                let [low, high] = [low - 1e-6 * low.abs(), high + 1e-6 * high.abs()];
                assert!(first >= low && last <= high, "{}", row.label);
                // A slider shows its number, and what it shows has a unit or is a number.
                assert!(
                    setting.shown(&plain).contains(|letter: char| letter.is_ascii_digit() || letter == 'o')
                );
                true
            }
            Widget::BoxOf { ticked, plain } => {
                [ticked, plain].into_iter().all(|number| (low..=high).contains(&f64::from(*number)))
            }
            Widget::Drag => matches!(setting.access, Access::Vector(..)),
            Widget::Color => matches!(setting.access, Access::Color(..)),
            Widget::Box | Widget::List | Widget::Length => false,
        };
        let fits = match &setting.access {
            Access::Single(_, range, _) => within(range.map(f64::from)),
            Access::Double(_, range, _) | Access::Vector(_, range) | Access::Color(_, range) => {
                within(*range)
            }
            Access::Whole(_, range) => within(range.map(f64::from)),
            Access::WholeOrZero(_, [_, high], _) => within([0.0, f64::from(*high)]),
            Access::Switch(_) => matches!(row.widget, Widget::Box),
            Access::Choice(..) => matches!(row.widget, Widget::List),
            Access::Tolerance(_) => matches!(row.widget, Widget::Length),
            Access::Sensor(_) => matches!(row.widget, Widget::List),
            Access::Size(..) | Access::Image(_) => false,
        };
        assert!(fits, "{}", row.label);
    }
}

/// What the documentation says of all settings, group by group.
fn tables() -> String {
    let mut text = String::new();
    for group in &list::GROUPS {
        text += &format!(
            "\n## {}\n\n| option | meaning | default | range | in a scene file | in the viewer |\n",
            group.title
        );
        text += "|---|---|---|---|---|---|\n";
        for setting in group.settings {
            let letter = setting.letter.map_or_else(String::new, |letter| format!("`-{letter}`, "));
            let (names, range) = match &setting.access {
                Access::Choice(_, choices) => (
                    choices()
                        .iter()
                        .map(|choice| format!("`{}`", choice.name))
                        .collect::<Vec<_>>()
                        .join(", "),
                    String::new(),
                ),
                Access::Single(_, range, _) => (String::new(), span(*range)),
                Access::Double(_, range, _) | Access::Vector(_, range) | Access::Color(_, range) => {
                    (String::new(), span(*range))
                }
                Access::Whole(_, range) | Access::Size(_, range) => (String::new(), span(*range)),
                Access::WholeOrZero(_, range, _) => (String::new(), format!("0, {}", span(*range))),
                Access::Sensor(_) => (
                    FORMATS.map(|format| format!("`{}`", format.name)).join(", "),
                    format!(", or each side {} mm", span(SENSOR_SIDES_MM)),
                ),
                Access::Tolerance(_) => {
                    (String::new(), format!("{} mm, {} px", span(TOLERANCES_MM), span(TOLERANCES_PIXELS)))
                }
                Access::Switch(_) | Access::Image(_) => (String::new(), String::new()),
            };
            let value = if setting.value_name.is_empty() { "NAME" } else { setting.value_name };
            let option = match setting.access {
                Access::Switch(_) => format!("`--{}[=false]`", setting.flag),
                _ => format!("{letter}`--{} {value}`", setting.flag),
            };
            let key = setting.key.as_ref().map_or_else(String::new, |key| match key.table {
                "" => format!("`{}`", key.name),
                table => format!("`{}` in `[{table}]`", key.name),
            });
            let label = setting.row.as_ref().map_or("", |row| row.label);
            let range = [names, range].concat();
            text += &format!(
                "| {option} | {} | {} | {range} | {key} | {label} |\n",
                setting.help, setting.default
            );
        }
    }
    text
}

/// A range in few digits.
fn span<T: std::fmt::Display + std::fmt::LowerExp>(range: [T; 2]) -> String {
    let [low, high] = range.map(|end| {
        let (plain, power) = (end.to_string(), format!("{end:e}"));
        if plain.len() > 6 && power.len() < plain.len() { power } else { plain }
    });
    format!("{low} to {high}")
}

/// Catches a page of options that is not what the list says. `THINLENS_BLESS=1` writes it.
#[test]
fn the_page_of_options_is_what_the_list_says() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/options.md");
    let page = std::fs::read_to_string(path).expect("the page");
    let (begin, end) = ("<!-- from the list of settings -->\n", "\n<!-- end of the list -->\n");
    let (before, rest) = page.split_once(begin).expect("where the tables begin");
    let (tables_there, after) = rest.split_once(end).expect("where the tables end");
    if std::env::var_os("THINLENS_BLESS").is_some() {
        std::fs::write(path, [before, begin, &tables(), end, after].concat()).expect("a writable page");
    } else {
        let list = tables();
        let differs = tables_there.lines().zip(list.lines()).find(|(page, list)| page != list);
        assert!(
            tables_there == list,
            "docs/options.md differs at {differs:?}; THINLENS_BLESS=1 cargo test --release --test settings writes it"
        );
    }
    let scenes =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scenes.md")).expect("the page");
    for key in list::all().filter_map(|setting| setting.key.as_ref()) {
        let named = [format!("`{}`", key.name), format!("{} = ", key.name)];
        assert!(named.iter().any(|name| scenes.contains(name)), "docs/scenes.md does not know {}", key.name);
    }
}
