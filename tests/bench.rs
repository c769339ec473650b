//! `thinlens bench`: that its figures are there and fit each other. No test says how large a time may be.

mod common;

use common::run;
use serde_json::Value;
use std::path::Path;

const SMALL: [&str; 8] = ["bench", "suffern-boxes", "--size", "32x24", "--samples", "4", "--runs", "3"];

fn figures(folder: &Path, more: &[&str]) -> Value {
    let run = run(folder, &[&SMALL[..], more, &["--json"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    serde_json::from_str(&run.stdout).expect("nothing but JSON on standard output")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// The five numbers of a spread, which must be in order and above zero.
fn spread(value: &Value) -> [f64; 5] {
    let numbers =
        ["min", "lower_quartile", "median", "upper_quartile", "max"].map(|name| number(&value[name]));
    assert!(numbers.is_sorted() && numbers[0] > 0.0, "{value}");
    numbers
}

/// Catches a figure that is missing or of another thing, a sampler left out, errors that do not fall,
/// and, for the whole of it, what validation has to say.
#[test]
fn the_figures_are_there_and_fit_each_other() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let report = figures(folder.path(), &["--validation"]);
    assert!(
        ["device", "driver"].iter().all(|key| report[*key].as_str().is_some_and(|text| !text.is_empty()))
    );
    assert_eq!(report["runs"], 3);
    let scenes = report["scenes"].as_array().expect("scenes");
    assert_eq!(scenes.len(), 1);
    let scene = &scenes[0];
    assert_eq!((&scene["scene"], &scene["samples"]), (&"suffern-boxes".into(), &4.into()));
    assert_eq!(scene["size"], serde_json::json!([32, 24]));
    assert_eq!(scene["error_size"], serde_json::json!([32, 24]));
    for key in ["from_start", "from_change"] {
        spread(&scene["first_picture"][key]);
    }

    let variants = scene["variants"].as_array().expect("variants");
    let names: Vec<_> = variants.iter().map(|variant| variant["variant"].as_str().expect("a name")).collect();
    for name in ["sobol", "random"] {
        assert!(names.contains(&name), "{names:?}");
    }
    for variant in variants {
        let [.., samples, _, _] = spread(&variant["msamples_per_second"]);
        let [.., on_device, _, _] = spread(&variant["msamples_per_device_second"]);
        let [.., rays, _, _] = spread(&variant["mrays_per_second"]);
        assert!(rays > samples, "a sample has a ray at least, and shadow rays here");
        assert!(on_device >= samples, "the device does not work longer than it is waited for");
        spread(&variant["submissions"]["device_seconds"]);
        // Passes of 1, 2 and 4 samples fit in one submission of so small a picture; there are three runs.
        assert!(variant["submissions"]["count"].as_u64().is_some_and(|count| count >= 3));

        let points = variant["convergence"].as_array().expect("errors");
        let asked: Vec<_> = points.iter().map(|point| number(&point["samples"])).collect();
        assert_eq!(asked, [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0]);
        let medians = |key: &str| points.iter().map(|point| spread(&point[key])[2]).collect::<Vec<_>>();
        assert!(medians("seconds").is_sorted(), "{:?}", medians("seconds"));
        assert!(medians("samples_traced").iter().zip(&asked).all(|(traced, asked)| traced <= asked));
        let errors = medians("rmse");
        let falls = errors.windows(3).all(|errors| errors[2] < errors[0]);
        assert!(falls && errors[8] < errors[0] / 8.0, "{}: {errors:?}", variant["variant"]);
    }
}

/// Catches errors that are not of the settings' own pictures: those follow from the seeds, whatever the
/// time it takes.
#[test]
fn errors_are_the_same_every_time_and_differ_between_samplers() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let errors = || -> Vec<Value> {
        let report = figures(folder.path(), &[]);
        let variants = report["scenes"][0]["variants"].as_array().expect("variants").clone();
        let points = |variant: &Value| variant["convergence"].as_array().expect("errors").clone();
        variants.iter().flat_map(points).map(|point| point["rmse"].clone()).collect()
    };
    let first = errors();
    assert_eq!(first, errors());
    assert_ne!(first[0], first[9], "samplers");
    assert_ne!(first[0]["min"], first[0]["max"], "seeds");
}

/// Catches a table that leaves something out, and a file that is not the JSON.
#[test]
fn there_is_a_table_and_a_file_beside_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = run(folder.path(), &[&SMALL[..], &["--json=figures.json"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    for part in ["suffern-boxes, 32x24", "sobol", "random", "M rays/s", "first picture", "RMSE", "  256"] {
        assert!(run.stdout.contains(part), "no {part}: {}", run.stdout);
    }
    let text = std::fs::read_to_string(folder.path().join("figures.json")).expect("the file");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(report["scenes"][0]["scene"], "suffern-boxes");
}

/// Catches wrong use that is measured all the same, or that is no fault of the user's.
#[test]
fn wrong_use_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (arguments, code, part) in [
        (&["bench", "--runs", "0"][..], 2, "from 1 to 1000"),
        (&["bench", "--runs", "-1"], 2, "--runs"),
        (&["bench", "--samples", "0"], 2, "from 1 to 16777216"),
        (&["bench", "--size", "0x10"], 2, "from 1 to 16384"),
        (&["bench", "suffern-boxes", "verson-4"], 2, "did you mean version-4?"),
        (&["bench", "--device", "99"], 2, "there are: 0 "),
        (&["bench", "--json=none/figures.json"], 1, "cannot write none/figures.json"),
        (&["bench", "none.toml"], 1, "cannot read none.toml"),
    ] {
        let run = run(folder.path(), arguments);
        assert_eq!((run.code, run.stdout.as_str()), (code, ""), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments:?}: '{}' does not say '{part}'", run.stderr);
    }
}
