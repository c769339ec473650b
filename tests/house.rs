//! Rules of the house that the compiler does not know: which module may use which, and that planted
//! faults are looked for.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use thinlens::interface;

/// A module and what it may use of the crate, besides `error`.
const ARROWS: [(&str, &[&str]); 18] = [
    ("cli", &["diagram", "settings", "scene"]),
    ("app", &["diagram", "renderer", "output", "settings", "scene", "vulkan", "pending_file"]),
    ("bench", &["renderer", "output", "settings", "vulkan", "pending_file"]),
    (
        "output",
        &["diagram", "renderer", "settings", "scene", "vulkan", "pending_file", "input_file", "interrupt"],
    ),
    ("diagram", &["renderer", "settings", "scene"]),
    ("renderer", &["passes", "gpu_types", "interface", "settings", "scene", "vulkan"]),
    ("passes", &["vulkan", "gpu_types", "interface"]),
    ("gpu_types", &["scene", "settings", "interface"]),
    ("verify", &["renderer", "reference", "scene", "settings", "vulkan"]),
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

/// The files that are modules, each by its path from the crate's root, without `mod.rs`: `scene/shape/sphere`.
fn module_files() -> BTreeMap<String, String> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut modules = BTreeMap::new();
    walk(&source, &mut |path| {
        let inside = path.strip_prefix(&source).expect("it lies there").with_extension("");
        let module = if inside.ends_with("mod") { inside.parent().expect("a folder") } else { &inside };
        let name = module.to_str().expect("a plain name").replace('\\', "/");
        let text = std::fs::read_to_string(path).expect("a readable file");
        let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
        modules.insert(name, code.join("\n"));
    });
    modules
}

/// The paths that a text names from `crate` or `super` on, and those of its `pub use`: with their braces opened.
fn named_paths(code: &str) -> Vec<Vec<String>> {
    let is_name = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == '#';
    let mut paths = Vec::new();
    for start in ["crate", "super"] {
        for (at, _) in code.match_indices(&format!("{start}::")) {
            // Not the second half of a longer name, and not the rest of `super::super`.
            if !code[..at].ends_with(|before: char| is_name(before) || before == ':') {
                open_braces(&code[at..], &[], &mut paths);
            }
        }
    }
    paths
}

/// Adds the paths of a tree of imports, `a::{b, c::d}`, and gives the text behind it.
fn open_braces<'a>(text: &'a str, before: &[String], paths: &mut Vec<Vec<String>>) -> &'a str {
    let mut path = before.to_vec();
    let mut rest = text;
    loop {
        let end = rest.find(|letter: char| !letter.is_alphanumeric() && !"_#*".contains(letter));
        let (name, behind) = rest.split_at(end.unwrap_or(rest.len()));
        if !name.is_empty() {
            path.push(name.trim_start_matches("r#").to_owned());
        }
        match behind.strip_prefix("::") {
            Some(further) => rest = further,
            None if name.is_empty() && behind.starts_with('{') => {
                rest = &behind[1..];
                // Each part ends with a comma, or the brace.
                while let Some(part) = rest.get(..1).filter(|part| *part != "}") {
                    rest = if part.trim().is_empty() || part == "," {
                        &rest[1..]
                    } else {
                        open_braces(rest, &path, paths)
                    };
                }
                return rest.get(1..).unwrap_or_default();
            }
            None => {
                paths.push(path);
                // Over `as other`, and what is no import after all.
                return behind.find([',', '}']).map_or("", |end| &behind[end..]);
            }
        }
    }
}

/// Where a module takes a name from: the module itself, or the one that it hands the name on from.
fn origin(modules: &BTreeMap<String, String>, module: &str, name: &str) -> String {
    let code = modules.get(module).map_or("", String::as_str);
    let inner = |child: &str| if module.is_empty() { child.to_owned() } else { format!("{module}/{child}") };
    if modules.contains_key(&inner(name)) {
        return inner(name);
    }
    for (at, _) in code.match_indices("use ") {
        let mut handed_on = Vec::new();
        open_braces(&code[at + 4..], &[], &mut handed_on);
        for path in handed_on {
            // "use" may stand in a message too.
            let [first, .., last] = path.as_slice() else { continue };
            let child = inner(first);
            let defines = || {
                let kinds = ["struct", "enum", "trait", "fn", "const", "type", "macro_rules!"];
                let within =
                    |(of, _): &(&String, &String)| **of == child || of.starts_with(&format!("{child}/"));
                let has = |code: &str| kinds.iter().any(|kind| code.contains(&format!("{kind} {name}")));
                modules.iter().filter(within).any(|(_, code)| has(code))
            };
            if modules.contains_key(&child) && (last == name || last == "*" && defines()) {
                return origin(modules, &child, name);
            }
        }
    }
    module.to_owned()
}

/// The modules that each module uses, but for those that it lies in: a module may use what is around it.
fn arrows_between(modules: &BTreeMap<String, String>) -> BTreeMap<String, BTreeSet<String>> {
    let used = |module: &String, code: &String| {
        let mut used = BTreeSet::new();
        for path in named_paths(code) {
            let mut at = if path[0] == "crate" { String::new() } else { module.clone() };
            for name in &path {
                match name.as_str() {
                    "crate" => {}
                    "super" => at.truncate(at.rfind('/').unwrap_or(0)),
                    "self" => break,
                    name => at = origin(modules, &at, name),
                }
            }
            let around = at.is_empty() || *module == at || module.starts_with(&format!("{at}/"));
            if !around && modules.contains_key(&at) {
                used.insert(at);
            }
        }
        // A module uses its own children: whoever uses the module uses them.
        let is_child = |of: &&String| {
            of.strip_prefix(module.as_str())
                .is_some_and(|rest| rest.starts_with('/') && !rest[1..].contains('/'))
        };
        used.extend(modules.keys().filter(is_child).cloned());
        (module.clone(), used)
    };
    let inner = modules.iter().filter(|(module, _)| !["lib", "main", ""].contains(&module.as_str()));
    inner.map(|(module, code)| used(module, code)).collect()
}

/// Modules that use one another, each circle by those on it.
fn circles(arrows: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<Vec<String>> {
    let reached_from = |start: &String| {
        let mut reached = BTreeSet::new();
        let mut open = vec![start];
        while let Some(module) = open.pop() {
            for next in arrows.get(module).into_iter().flatten() {
                if reached.insert(next) {
                    open.push(next);
                }
            }
        }
        reached
    };
    let reached: BTreeMap<&String, BTreeSet<&String>> =
        arrows.keys().map(|module| (module, reached_from(module))).collect();
    let on_circle = |module: &&String| reached[*module].contains(*module);
    let same = |module: &&String| {
        let others = arrows.keys().filter(|other| reached[*module].contains(*other));
        others.filter(|other| reached[*other].contains(*module)).cloned().collect()
    };
    arrows.keys().filter(on_circle).map(|module| same(&module)).collect()
}

/// Catches modules that use one another, directly or through others: none of them can be read, tested or moved
/// alone.
#[test]
fn modules_form_no_circle() {
    let modules = module_files();
    let arrows = arrows_between(&modules);
    assert!(arrows["scene/toml"].contains("scene/shape"), "{:?}", arrows["scene/toml"]);
    assert!(arrows["scene/shape/plane"].contains("scene/toml/number"), "{:?}", arrows["scene/shape/plane"]);
    assert!(arrows["scene/toml/camera"].contains("scene/aperture"), "{:?}", arrows["scene/toml/camera"]);
    assert_eq!(circles(&arrows), BTreeSet::new());
}

/// The check above must see a circle through braces, names that are handed on, and modules within modules.
#[test]
fn a_circle_is_found() {
    let found = |files: &[(&str, &str)]| {
        let modules = files.iter().map(|(name, code)| ((*name).to_owned(), (*code).to_owned())).collect();
        circles(&arrows_between(&modules)).into_iter().next().unwrap_or_default()
    };
    let root = ("a", "mod b; mod c; pub use b::B; pub use c::*; struct A;");
    assert_eq!(
        found(&[root, ("a/b", "use super::A; struct B;"), ("a/c", "use super::{A, B}; struct C;")]),
        [""; 0]
    );
    let through_names =
        [root, ("a/b", "fn f(c: crate::a::C) {}"), ("a/c", "use super::{A, B as D}; struct C;")];
    assert_eq!(found(&through_names), ["a/b", "a/c"]);
    let within =
        [root, ("a/b", "mod d;"), ("a/b/d", "use super::super::c::{X, C};"), ("a/c", "use super::b;")];
    assert_eq!(found(&within), ["a/b", "a/b/d", "a/c"]);
}

/// The faults that a test's calls of `prove` ask for: the texts in the last list of each call.
fn asked_for(test: &str) -> Vec<&str> {
    let calls = test.split("prove(").skip(1).filter_map(|call| call.split(");\n}").next());
    let lists = calls.flat_map(|call| call.split(");\n").filter_map(|call| call.rsplit_once("&[")));
    lists.flat_map(|(_, list)| list.split('"').skip(1).step_by(2)).collect()
}

/// Catches a fault that no test asks for, by its name or by a tag: it would prove nothing.
#[test]
fn every_planted_fault_is_looked_for() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let mut sources = Vec::new();
    walk(&tests, &mut |path| sources.push(std::fs::read_to_string(path).expect("a readable file")));
    let asked: BTreeSet<_> = sources.iter().flat_map(|source| asked_for(source)).collect();
    let faults = |asked: &&str| thinlens_test_shaders::faults(asked).collect::<Vec<_>>();
    let looked_for: BTreeSet<_> = asked.iter().flat_map(faults).collect();
    let forgotten: Vec<_> =
        thinlens_test_shaders::names().filter(|name| !looked_for.contains(name)).collect();
    assert_eq!(forgotten, Vec::<&str>::new());
    assert!(looked_for.len() > 50, "the tests are read");
}

#[test]
fn what_a_test_asks_for_is_read() {
    let test =
        "prove(|gpu| hold(&[\"x\"]), &[\"a\", \"b\"]);\n    prove(check, &[\"c\"]);\n}\nf(&[\"d\"]);\n}\n";
    assert_eq!(asked_for(test), ["a", "b", "c"]);
}

/// The kinds of everything that has a file for each: what they are kinds of, and their names.
const KINDS: [(&str, &[&str]); 6] = [
    ("aperture", interface::aperture::NAMES),
    ("integrator", interface::integrator::NAMES),
    ("light", interface::light::NAMES),
    ("material", interface::material::NAMES),
    ("shape", interface::shape::NAMES),
    ("texture", interface::texture::NAMES),
];

/// What a kind lacks: the files on every side, its row in the description of scene files, and a planted fault.
fn missing(of: &str, kind: &str, has_file: impl Fn(&str) -> bool, rows: &str) -> Vec<String> {
    let shader = format!("{of}/{kind}.glsl");
    let mut files = vec![
        format!("shaders/{shader}"),
        format!("src/reference/{of}/{kind}.rs"),
        format!("tests/faults/{shader}.txt"),
    ];
    // There is nothing to say of an integrator in a scene file.
    if of != "integrator" {
        files.push(format!("src/scene/{of}/{kind}.rs"));
    }
    let mut missing: Vec<String> = files.into_iter().filter(|file| !has_file(file)).collect();
    let headers = [kind.to_owned(), format!("[{kind}]"), format!("[[{kind}]]")];
    if !headers.iter().any(|header| rows.lines().any(|line| line.starts_with(&format!("| `{header}` |")))) {
        missing.push(format!("a row of {kind} in docs/scenes.md"));
    }
    missing
}

/// Catches a kind that is there on one side only, that no reader is told of, or in which no test looks for a mistake.
/// That the device is asked about it, too, `tests/surfaces.rs` and `tests/aperture.rs` see to.
#[test]
fn every_kind_is_complete() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let rows = std::fs::read_to_string(root.join("docs/scenes.md")).expect("a readable file");
    let mut kinds = 0;
    for (of, names) in KINDS {
        for kind in names.iter().map(|name| name.to_lowercase()) {
            let has_file = |file: &str| root.join(file).is_file();
            assert_eq!(missing(of, &kind, has_file, &rows), Vec::<String>::new(), "{of} {kind}");
            kinds += 1;

            // And each of them is missed.
            let shader = format!("{of}/{kind}.glsl");
            for gone in [
                format!("shaders/{shader}"),
                format!("src/reference/{of}/{kind}.rs"),
                format!("tests/faults/{shader}.txt"),
            ] {
                let found = missing(of, &kind, |file| file != gone && has_file(file), &rows);
                assert_eq!(found, [gone]);
            }
            let undocumented = rows.replace(&format!("{kind}]"), "").replace(&format!("`{kind}`"), "");
            assert_eq!(missing(of, &kind, has_file, &undocumented).len(), 1, "{of} {kind}");
        }
    }
    assert!(kinds > 15, "only {kinds} kinds were looked at");
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

/// What a line of `app` spells out of the look of the viewer, if anything: a colour, a size of what is drawn, or a style.
fn spelled_out(line: &str) -> Option<&str> {
    let code = line.split("//").next().unwrap_or_default();
    let is_number = |text: &str| {
        let text = text.trim();
        text.contains('.') && text.parse::<f32>().is_ok()
    };
    let is_color = |inner: &str| {
        let repeated = inner.split_once(';').is_some_and(|(number, times)| {
            is_number(number) && ["3", "4"].contains(&times.trim()) && number.trim() != "0.0"
        });
        repeated || (inner.split(',').count() >= 3 && inner.split(',').all(is_number))
    };
    let brackets = code.split('[').skip(1).filter_map(|rest| rest.split(']').next());
    let color = brackets.into_iter().any(is_color);
    let sizes = [".rounding(", ".thickness(", "set_next_item_width(", "_with_spacing(", "_with_pos("];
    let size = sizes.iter().any(|call| {
        let given = code.split(call).skip(1).filter_map(|rest| rest.split([',', ')']).next());
        given.into_iter().any(|number| is_number(number) && !["0.0", "-1.0"].contains(&number.trim()))
    });
    let style = ["StyleVar::", "StyleColor::"]
        .iter()
        .any(|kind| code.contains(kind) && !code.contains("style_color("));
    (color || size || style).then_some(line)
}

/// Catches a colour, a space or a width that stands beside the theme: the parts of the viewer would look each in its own
/// way again.
#[test]
fn only_the_theme_says_how_the_viewer_looks() {
    let app = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/app");
    // Directions of flight.
    let others = ["theme.rs", "navigate.rs"];
    let mut found = Vec::new();
    walk(&app, &mut |path| {
        if others.iter().any(|other| path.ends_with(other)) {
            return;
        }
        let text = std::fs::read_to_string(path).expect("a readable file");
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let own = text.split("#[cfg(test)]").next().unwrap_or_default();
        found.extend(own.lines().filter_map(spelled_out).map(|line| format!("{name}: {}", line.trim())));
    });
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn a_spelled_out_look_is_found() {
    for bad in [
        "const LINE: [f32; 4] = [1.0, 1.0, 1.0, 0.45];",
        "ui.text_colored([1.0, 0.85, 0.5, 1.0], keys);",
        "beside(ui, help, [1.0; 4]);",
        "list.add_rect(a, b, color).rounding(4.0).build();",
        "ui.set_next_item_width(150.0);",
        "let _spacing = ui.push_style_var(StyleVar::ItemSpacing([6.0, 8.0]));",
    ] {
        assert!(spelled_out(bad).is_some(), "{bad}");
    }
    for good in [
        "list.add_rect(a, b, theme::EDGE).rounding(ROUNDING).build();",
        "ui.set_next_item_width(-1.0);",
        "const BLURS: [f32; 2] = [1.0, 200.0];",
        "let color = ui.style_color(StyleColor::Text);",
    ] {
        assert_eq!(spelled_out(good), None);
    }
}
