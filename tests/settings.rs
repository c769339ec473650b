//! A walk over the list of settings: what follows from it holds of each of them.

mod common;

use common::run;
use std::path::Path;
use thinlens::scene::{self, SceneRef};
use thinlens::settings::{Access, Called, Changes, Role, SETTINGS, Setting, Settings, Value};

/// Those that have a value of their own.
fn own() -> impl Iterator<Item = &'static Setting> {
    SETTINGS.iter().filter(|setting| !setting.is_alias())
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
        (Access::Single(_, range) | Access::Seconds(_, range), Value::Single(now)) => {
            Value::Single(single(*now, *range))
        }
        (Access::Double(_, range), Value::Double(now)) => Value::Double(number(*now, *range)),
        (Access::Whole(_, [low, high]), Value::Whole(now)) => {
            Value::Whole(if now < high { now + 1 } else { *low })
        }
        (Access::WholeOrZero(_, [low, _], _), Value::Whole(now)) => {
            Value::Whole(if now == low { low + 1 } else { *low })
        }
        (Access::Switch(_), Value::Switch(now)) => Value::Switch(!now),
        (Access::Vector(..), Value::Vector(now)) => Value::Vector(*now / 3.0 + 0.1),
        (Access::Size(..), Value::Size([width, height])) => Value::Size([width + 1, height + 2]),
        (Access::Choice { names, .. }, Value::Name(now)) => {
            Value::Name(names().into_iter().rev().find(|name| name != now).expect("another name"))
        }
        (Access::Image(_), Value::File(None)) => Value::File(Some(image(folder))),
        (_, now) => panic!("--{} is {now:?}", setting.flag),
    }
}

/// Words that the setting's option refuses as out of its range, if it has one.
fn out_of_range(setting: &Setting) -> Vec<String> {
    let around = |low: f64, high: f64| vec![(low - 1.0).to_string(), (high * 2.0).to_string(), "NaN".into()];
    match &setting.access {
        Access::Single(_, [low, high]) | Access::Seconds(_, [low, high]) => {
            around((*low).into(), (*high).into())
        }
        Access::Double(_, [low, high]) => around(*low, *high),
        Access::Whole(_, [low, high]) => {
            let around = [low.checked_sub(1), high.checked_add(1)];
            around.into_iter().flatten().map(|number| number.to_string()).collect()
        }
        Access::WholeOrZero(_, [low, high], _) => vec![(low - 1).to_string(), (high + 1).to_string()],
        Access::Vector(_, [low, high]) => {
            vec![format!("0,{},1", low * 2.0), format!("1,0,{}", high * 2.0), "NaN,0,0".into()]
        }
        Access::Size(_, [low, high]) => vec![format!("{}x9", low - 1), format!("9x{}", high + 1)],
        Access::Switch(_) | Access::Choice { .. } | Access::Image(_) => Vec::new(),
    }
}

/// The flags of the settings in which two differ.
fn difference(a: &Settings, b: &Settings) -> Vec<&'static str> {
    own().filter(|setting| setting.get(a) != setting.get(b)).map(|setting| setting.flag).collect()
}

/// Catches a setting whose value is read from one place and written to another, that pictures do not carry, that
/// belongs to the other half, and an alias that changes more or less than it says.
#[test]
fn each_setting_changes_what_it_says_and_is_carried_by_pictures() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let plain = plain();
    for setting in SETTINGS {
        let (flag, mut settings) = (setting.flag, plain.clone());
        let value = match &setting.access {
            Access::Choice { names, .. } if setting.is_alias() => {
                // A lens that changes the field of view too.
                Value::Name(names()[names().len() / 2])
            }
            _ => another(setting, &setting.get(&plain), folder.path()),
        };
        Changes::of(flag, value.clone()).apply(&mut settings).expect("a value that it may have");
        let changed = difference(&settings, &plain);
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
                assert_eq!(estimator != plain.estimator, role == Role::Estimator, "--{flag}");
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
    let plain = plain();
    let mut refused = 0;
    for setting in SETTINGS {
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
    for setting in SETTINGS {
        assert!(shown(&render, setting), "--{}", setting.flag);
        assert_eq!(shown(&save, setting), setting.key.is_some(), "save --{}", setting.flag);
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
    for (index, setting) in SETTINGS.iter().enumerate() {
        let before = &SETTINGS[..index];
        assert!(before.iter().all(|other| other.flag != setting.flag), "--{}", setting.flag);
        let same_key = |other: &&Setting| setting.key.is_some() && other.key == setting.key;
        assert!(!before.iter().any(|other| same_key(&other)), "{}", setting.name(Called::Key));
        if let (Access::Choice { names, .. }, false) = (&setting.access, setting.is_alias()) {
            for name in names() {
                let mut settings = plain();
                setting.set(&mut settings, &Value::Name(name)).expect("a choice");
                assert_eq!(setting.get(&settings), Value::Name(name), "--{}", setting.flag);
            }
        }
    }
}
