//! Compiles the shaders that only tests and benches need, and lists them in `shaders.rs`: every shader as it is
//! and with each of the faults of `tests/faults.txt` that lies in its source.

#[path = "../../build.rs"]
#[allow(dead_code, reason = "it is a build script of its own")]
mod product;

use product::Sources;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A mistake to plant: a text that stands once in one file, and what stands there instead.
struct Fault {
    name: String,
    file: String,
    from: String,
    to: String,
}

fn main() {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let root = Path::new("../..");
    let sources = Sources::new(root);
    println!("cargo::rerun-if-changed=build.rs");
    let list = root.join("tests/faults.txt");
    println!("cargo::rerun-if-changed={}", list.display());
    let faults = parse_faults(&std::fs::read_to_string(&list).expect("a readable list of faults"));
    let stale: Vec<_> = faults.iter().filter_map(|fault| why_stale(root, fault, &faults)).collect();
    for why in &stale {
        println!("cargo::error=tests/faults.txt: {why}");
    }

    // Benches measure, and have nothing to find.
    let paths = ["shaders", "tests/probes", "benches"].map(|folder| (folder, sources.shaders(folder)));
    let paths: Vec<_> = paths.iter().flat_map(|(folder, paths)| paths.iter().map(move |path| (*folder, path))).collect();
    let compiled = in_parallel(&paths, |(_, path)| compile(&sources, path, None, &out));
    let mut planted = Vec::new();
    for ((folder, path), compiled) in paths.iter().zip(&compiled) {
        let files = compiled.as_deref().unwrap_or_default();
        let lies_in = |fault: &&Fault| *folder != "benches" && files.contains(&fault.file);
        planted.extend(faults.iter().filter(lies_in).map(|fault| (*path, fault)));
    }
    let faulty = in_parallel(&planted, |(path, fault)| compile(&sources, path, Some(fault), &out));

    let mut table = String::from("&[\n");
    for (path, fault) in paths.iter().map(|(_, path)| (*path, "")).chain(planted.iter().map(|(path, fault)| (*path, fault.name.as_str()))) {
        let file = out.join(file_name(path, fault));
        writeln!(table, "({:?}, {fault:?}, {file:?}),", stem(path)).expect("a string grows");
    }
    std::fs::write(out.join("shaders.rs"), table + "]\n").expect("OUT_DIR is writable");
    if !stale.is_empty() || compiled.iter().chain(&faulty).any(Option::is_none) {
        std::process::exit(1);
    }
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

/// Reads `NAME FILE`, `- OLD` and `+ NEW` lines; `#` starts a comment.
fn parse_faults(text: &str) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(from) = line.strip_prefix("- ") {
            faults.last_mut().expect("a name comes first").from = from.to_owned();
        } else if let Some(to) = line.strip_prefix("+ ") {
            faults.last_mut().expect("a name comes first").to = to.to_owned();
        } else {
            let (name, file) = line.split_once(' ').expect("NAME FILE");
            let (name, file) = (name.to_owned(), file.to_owned());
            faults.push(Fault { name, file, from: String::new(), to: String::new() });
        }
    }
    faults
}

/// Why a fault cannot be planted: the line that it changes has been changed.
fn why_stale(root: &Path, fault: &Fault, all: &[Fault]) -> Option<String> {
    let Fault { name, file, from, .. } = fault;
    let text = std::fs::read_to_string(root.join("shaders").join(file)).unwrap_or_default();
    let times = text.matches(from).count();
    if from.is_empty() || times != 1 {
        return Some(format!("{name}: '{from}' must stand once in {file}, but stands there {times} times"));
    }
    let namesakes = all.iter().filter(|other| other.name == *name).count();
    (namesakes > 1).then(|| format!("{name} is the name of {namesakes} faults"))
}
