//! Rules of the house that the compiler does not know: which module may use which, and that planted
//! faults are looked for.

use std::path::Path;

/// A module and what it may use of the crate, besides `error`.
const ARROWS: [(&str, &[&str]); 17] = [
    ("cli", &["settings", "scene"]),
    ("app", &["renderer", "output", "settings", "scene", "vulkan", "pending_file"]),
    ("bench", &["renderer", "output", "settings", "vulkan", "pending_file"]),
    ("output", &["renderer", "settings", "scene", "vulkan", "pending_file", "input_file", "interrupt"]),
    ("renderer", &["passes", "gpu_types", "interface", "settings", "scene", "vulkan"]),
    ("passes", &["vulkan", "gpu_types", "interface"]),
    ("gpu_types", &["scene", "settings", "interface"]),
    ("verify", &["renderer", "reference", "settings", "vulkan"]),
    ("reference", &["scene", "settings"]),
    ("settings", &["scene"]),
    ("scene", &["input_file", "interface"]),
    ("vulkan", &["pending_file"]),
    ("pending_file", &["interrupt"]),
    ("input_file", &[]),
    ("interrupt", &[]),
    ("interface", &[]),
    ("error", &[]),
];

/// `(module, used module)` for every path into the crate in a source text.
fn uses(module: &str, text: &str) -> Vec<(String, String)> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split("crate::").skip(1).map(str::to_owned).collect::<Vec<_>>())
        .map(|path| {
            let name: String =
                path.chars().take_while(|letter| letter.is_alphanumeric() || *letter == '_').collect();
            (module.to_owned(), name)
        })
        .collect()
}

fn forbidden(module: &str, text: &str) -> Vec<String> {
    let (_, allowed) =
        ARROWS.iter().find(|(name, _)| *name == module).unwrap_or_else(|| panic!("no arrows for {module}"));
    uses(module, text)
        .into_iter()
        .filter(|(from, to)| from != to && to != "error" && !allowed.contains(&to.as_str()))
        .map(|(from, to)| format!("{from} uses {to}"))
        .collect()
}

fn walk(folder: &Path, check: &mut impl FnMut(&Path)) {
    for entry in std::fs::read_dir(folder).expect("a readable folder") {
        let path = entry.expect("a readable entry").path();
        if path.is_dir() {
            walk(&path, check);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            check(&path);
        }
    }
}

/// Catches a shortcut between modules: `vulkan` that knows scenes cannot be reused, and an oracle
/// that uses the GPU's twins inherits their mistakes.
#[test]
fn modules_use_only_what_the_design_allows() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = 0;
    walk(&source, &mut |path| {
        let inside = path.strip_prefix(&source).expect("it lies there");
        let first = inside.iter().next().expect("it has a name").to_string_lossy();
        let module = first.trim_end_matches(".rs");
        if module == "lib" || module == "main" {
            return;
        }
        let text = std::fs::read_to_string(path).expect("a readable file");
        assert_eq!(forbidden(module, &text), Vec::<String>::new(), "{}", inside.display());
        files += 1;
    });
    assert!(files > 20, "only {files} files were read");
}

/// The check above must see a forbidden path, wherever it stands.
#[test]
fn a_forbidden_arrow_is_found() {
    assert_eq!(forbidden("vulkan", "use crate::scene::Scene;"), ["vulkan uses scene"]);
    assert_eq!(forbidden("scene", "fn f(a: crate::gpu_types::Sphere) {}"), ["scene uses gpu_types"]);
    assert!(forbidden("passes", "use crate::vulkan::Image; // not crate::scene").is_empty());
}

/// Catches a planted fault that no test looks for: it would prove nothing.
#[test]
fn every_planted_fault_is_looked_for() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let list = std::fs::read_to_string(tests.join("faults.txt")).expect("a readable list");
    let mut sources = String::new();
    walk(&tests, &mut |path| sources += &std::fs::read_to_string(path).expect("a readable file"));
    let is_name = |line: &&str| line.starts_with(|first: char| first.is_ascii_lowercase());
    let names = list.lines().filter(is_name).filter_map(|line| line.split(' ').next());
    let forgotten: Vec<_> = names.clone().filter(|name| !sources.contains(&format!("\"{name}\""))).collect();
    assert_eq!(forgotten, Vec::<&str>::new());
    assert!(names.count() > 50, "the list is read");
}

/// Every `folder/file` of the project that a text names in backquotes.
fn paths(text: &str) -> Vec<&str> {
    let quoted = text.split('`').skip(1).step_by(2);
    quoted
        .filter(|path| {
            ["src/", "shaders/", "tests/", "benches/", "docs/"].iter().any(|start| path.starts_with(start))
        })
        // `shaders/*.comp` and `tests/probes/NAME.comp` stand for several.
        .filter(|path| {
            path.bytes()
                .all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"/._-".contains(&byte))
        })
        .collect()
}

/// Catches a text that sends its reader to a file that has moved.
#[test]
fn files_that_texts_name_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut texts = vec![
        root.join("README.md"),
        root.join("docs/optics.md"),
        root.join("docs/scenes.md"),
        root.join("CONTRIBUTING.md"),
    ];
    walk(&root.join("src"), &mut |path| texts.push(path.to_path_buf()));
    walk(&root.join("tests"), &mut |path| texts.push(path.to_path_buf()));
    let mut named = 0;
    for text in texts {
        let content = std::fs::read_to_string(&text).expect("a readable file");
        for path in content.lines().flat_map(paths) {
            assert!(root.join(path).exists(), "{}: there is no {path}", text.display());
            named += 1;
        }
    }
    assert!(named > 50, "only {named} files are named");
    let quoted = ["src/lib.rs", "src/NAME.rs", "x"].map(|path| format!("`{path}`")).join(" or ");
    assert_eq!(paths(&quoted), ["src/lib.rs"]);
}
