//! Compiles the shaders that only tests and benches need, and lists them in `shaders.rs`: every shader as it is
//! and with each of the faults of `tests/faults` that lies in its source.
//!
//! A folder like `shaders` has the faults of each shader: those of `shaders/core/film.glsl` are in
//! `tests/faults/core/film.glsl.txt`. A fault is
//!
//! ```text
//! NAME: TAG, TAG
//! - a text that stands once in the shader
//! + the text that replaces it
//! ```
//!
//! A test asks for faults by their tags, or for one by its name; a fault that only one test asks for needs no tag.

#[path = "../../build.rs"]
#[allow(dead_code, reason = "it is a build script of its own")]
mod product;

use product::Sources;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Shaders that tests try with few of the faults of their files: the tags of these faults. A fault without a tag is planted
/// wherever it fits. If a test asks for a fault that its shader lacks, the test fails, because it does not see the fault.
const TRIED: &[(&str, &[&str])] = &[
    ("trace_path", &["paths", "sky", "limits"]),
    ("pick", &["pick", "fan", "framing", "lens", "movements"]),
    ("radiance", &["shading", "shadow_ray"]),
    ("intersect", &["hit", "shadow_ray"]),
    ("aperture", &["aperture"]),
    ("warps", &["disk", "landing"]),
    ("path", &["path"]),
    ("material", &["furnace", "reversed", "lobes"]),
];

/// A mistake to plant: a text that stands once in one file, and what stands there instead.
struct Fault {
    name: String,
    tags: Vec<String>,
    file: String,
    from: String,
    to: String,
}

fn main() {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let root = Path::new("../..");
    let sources = Sources::new(root);
    println!("cargo::rerun-if-changed=build.rs");
    let faults = read_faults(&root.join("tests/faults"));
    let stale: Vec<_> = faults.iter().filter_map(|fault| why_stale(root, fault, &faults)).collect();
    for why in &stale {
        println!("cargo::error=tests/faults: {why}");
    }

    // Benches measure, and have nothing to find.
    let paths = ["shaders", "tests/probes", "benches"].map(|folder| (folder, sources.shaders(folder)));
    let paths: Vec<_> = paths.iter().flat_map(|(folder, paths)| paths.iter().map(move |path| (*folder, path))).collect();
    let compiled = in_parallel(&paths, |(_, path)| compile(&sources, path, None, &out));
    let mut planted = Vec::new();
    for ((folder, path), compiled) in paths.iter().zip(&compiled) {
        let files = compiled.as_deref().unwrap_or_default();
        let lies_in = |fault: &&Fault| *folder != "benches" && files.contains(&fault.file);
        let tried = |fault: &&Fault| is_tried(&stem(path), &fault.tags);
        planted.extend(faults.iter().filter(lies_in).filter(tried).map(|fault| (*path, fault)));
    }
    let faulty = in_parallel(&planted, |(path, fault)| compile(&sources, path, Some(fault), &out));

    let mut table = String::from("&[\n");
    for (path, fault) in paths.iter().map(|(_, path)| (*path, "")).chain(planted.iter().map(|(path, fault)| (*path, fault.name.as_str()))) {
        let file = out.join(file_name(path, fault));
        writeln!(table, "({:?}, {fault:?}, {file:?}),", stem(path)).expect("a string grows");
    }
    std::fs::write(out.join("shaders.rs"), table + "]\n").expect("OUT_DIR is writable");
    let names: Vec<_> = faults.iter().map(|fault| (&fault.name, &fault.tags)).collect();
    let list = format!("&{names:?}").replace(", [", ", &[");
    std::fs::write(out.join("faults.rs"), list).expect("OUT_DIR is writable");
    if !stale.is_empty() || compiled.iter().chain(&faulty).any(Option::is_none) {
        std::process::exit(1);
    }
}

/// Whether tests try a shader with a fault that has these tags.
fn is_tried(shader: &str, tags: &[String]) -> bool {
    let any_of = |list: &[&str]| tags.iter().any(|tag| list.contains(&tag.as_str()));
    let listed = TRIED.iter().find(|(name, _)| *name == shader);
    tags.is_empty() || listed.map_or(true, |(_, tags)| any_of(tags))
}

/// What `work` makes of each, on every core, in their order.
fn in_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(at) else { break };
                    let result = work(item);
                    done.lock().expect("no thread panicked").push((at, result));
                }
            });
        }
    });
    let mut done = done.into_inner().expect("no thread panicked");
    done.sort_by_key(|(at, _)| *at);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Writes the shader's SPIR-V to `out`, and gives the names of the files that it is made of. Says why where it does
/// not compile.
fn compile(sources: &Sources, path: &Path, fault: Option<&Fault>, out: &Path) -> Option<Vec<String>> {
    let plant = |file: &str, text: String| match fault {
        Some(fault) if fault.file == file => text.replace(&fault.from, &fault.to),
        _ => text,
    };
    let name = fault.map_or("", |fault| fault.name.as_str());
    match sources.compile(path, &plant) {
        Ok(compiled) => {
            product::write_words(&out.join(file_name(path, name)), &compiled.words);
            Some(compiled.files)
        }
        Err(error) => {
            let with = if name.is_empty() { String::new() } else { format!(" with the fault {name}") };
            product::report(path, &with, &error);
            None
        }
    }
}

fn stem(path: &Path) -> String {
    path.file_stem().expect("a file has a name").to_string_lossy().into_owned()
}

fn file_name(path: &Path, fault: &str) -> String {
    if fault.is_empty() { format!("{}.spv", stem(path)) } else { format!("{}.{fault}.spv", stem(path)) }
}

/// The faults of every file in a folder and in those inside it.
fn read_faults(folder: &Path) -> Vec<Fault> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut faults = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(inner) = folders.pop() {
        for entry in std::fs::read_dir(&inner).expect("a readable folder") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let shader = path.strip_prefix(folder).expect("it lies there").with_extension("");
                let text = std::fs::read_to_string(&path).expect("a readable list of faults");
                faults.extend(parse_faults(&shader.to_string_lossy().replace('\\', "/"), &text));
            }
        }
    }
    faults.sort_by(|a, b| a.name.cmp(&b.name));
    faults
}

/// Reads the faults of one shader. A `#` starts a comment.
fn parse_faults(file: &str, text: &str) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(from) = line.strip_prefix("- ") {
            faults.last_mut().expect("a name comes first").from = from.to_owned();
        } else if let Some(to) = line.strip_prefix("+ ") {
            faults.last_mut().expect("a name comes first").to = to.to_owned();
        } else {
            let (name, tags) = line.split_once(": ").unwrap_or((line, ""));
            let tags = tags.split(", ").filter(|tag| !tag.is_empty()).map(str::to_owned).collect();
            let (name, file) = (name.to_owned(), file.to_owned());
            faults.push(Fault { name, tags, file, from: String::new(), to: String::new() });
        }
    }
    faults
}

/// Why a fault cannot be planted: the line that it changes has been changed, or its name is taken.
fn why_stale(root: &Path, fault: &Fault, all: &[Fault]) -> Option<String> {
    let Fault { name, file, from, .. } = fault;
    let text = std::fs::read_to_string(root.join("shaders").join(file)).unwrap_or_default();
    let times = text.matches(from).count();
    if from.is_empty() || times != 1 {
        return Some(format!("{name}: '{from}' must stand once in {file}, but stands there {times} times"));
    }
    let namesakes = all.iter().filter(|other| other.name == *name || other.tags.contains(name)).count();
    (namesakes > 1).then(|| format!("{name} is the name or a tag of {namesakes} faults"))
}
