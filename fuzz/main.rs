//! Tries what reads others' files, and the command line, with inputs that are wrong in random ways.
//!
//! `cargo test` tries a few of them, always the same ones. By hand:
//! `cargo test --release --test fuzz -- scene --inputs 1000000 --seed 2` tries many, and
//! `cargo test --release --test fuzz -- scene --input FILE` one that was kept.
//!
//! Every input is made from earlier ones. One whose error has new words, or whose content is of a new kind, becomes
//! such an earlier one itself. Catches panics, memory beyond 1 GiB (the program then ends, and the input stays in
//! the folder that was named at the start), settings that do not come back from their own arguments, and saved
//! scenes that cannot be read. Inputs that take long are reported.

mod bytes;
mod exr;
mod oracle;
mod png;
mod seeds;
mod targets;
mod text;

use cap::Cap;
use fastrand::Rng;
use std::alloc::System;
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use targets::{TARGETS, Target};

const MAX_MEMORY: usize = 1 << 30;
/// Inputs of each target that `cargo test` tries.
const FEW: u64 = 3000;
/// Inputs of each kind that others are made from, at most.
const MAX_KEPT: usize = 2000;
const LONG: Duration = Duration::from_secs(1);

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, MAX_MEMORY);

/// What the last panic said, and where.
static PANIC: Mutex<String> = Mutex::new(String::new());

fn main() -> ExitCode {
    let options = Options::of(std::env::args().skip(1));
    let folder = Folder::new();
    set_hook(Box::new(|panic| *PANIC.lock().expect("nobody panics with it") = panic.to_string()));
    let mut failures = 0;
    for target in TARGETS.iter().filter(|target| options.wants(target.name)) {
        failures += match &options.input {
            Some(input) => once(target, input),
            None => many(target, &options, &folder),
        };
    }
    if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// What the command line asks for. Words that only Rust's own test runner knows are passed over.
struct Options {
    names: Vec<String>,
    inputs: u64,
    seed: u64,
    /// Whether every new kind of outcome is told: it shows what the inputs reach.
    tells: bool,
    /// The bytes of one input to try again.
    input: Option<Vec<u8>>,
}

impl Options {
    fn of(mut words: impl Iterator<Item = String>) -> Self {
        let mut options = Self { names: Vec::new(), inputs: FEW, seed: 1, tells: false, input: None };
        let number = |word: Option<String>| word.and_then(|word| word.parse().ok()).expect("a number");
        while let Some(word) = words.next() {
            match word.as_str() {
                "--inputs" => options.inputs = number(words.next()),
                "--seed" => options.seed = number(words.next()),
                "--tell" => options.tells = true,
                "--input" => {
                    options.input =
                        Some(std::fs::read(words.next().expect("a file")).expect("a readable file"));
                }
                "--skip" | "--test-threads" | "--color" | "--format" => drop(words.next()),
                flag if flag.starts_with('-') => {}
                _ => options.names.push(word),
            }
        }
        options
    }

    fn wants(&self, target: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|name| target.contains(name.as_str()))
    }
}

/// The folder that inputs are written to, in memory where the system has such a place. The program works in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let in_memory = Path::new("/dev/shm");
        let place = if in_memory.is_dir() { in_memory.to_path_buf() } else { std::env::temp_dir() };
        let folder = tempfile::Builder::new().prefix("thinlens-fuzz-").tempdir_in(place).expect("a folder");
        std::env::set_current_dir(folder.path()).expect("a folder");
        seeds::write_companions();
        Self(folder)
    }
}

/// What one input came to: what kind of thing it is, or the error. An oracle that fails panics.
type Outcome = Result<String, String>;

fn attempt(target: &Target, input: &[u8]) -> Result<Outcome, String> {
    catch_unwind(AssertUnwindSafe(|| (target.run)(input)))
        .map_err(|_| PANIC.lock().expect("nobody panics with it").clone())
}

fn once(target: &Target, input: &[u8]) -> usize {
    let start = Instant::now();
    let outcome = attempt(target, input);
    println!("{}: {outcome:?} in {:?}", target.name, start.elapsed());
    usize::from(outcome.is_err())
}

fn many(target: &Target, options: &Options, folder: &Folder) -> usize {
    let mut random = Rng::with_seed(options.seed);
    let seeds = (target.seeds)();
    // Those that were right, and those that were wrong in a way of their own.
    let mut kept = [seeds.clone(), Vec::new()];
    let mut shapes = HashSet::new();
    let mut failures: HashSet<String> = HashSet::new();
    let (mut accepted, mut slowest) = (0, Duration::ZERO);
    println!("{}: {} inputs, by way of {}", target.name, options.inputs, folder.0.path().display());
    let start = Instant::now();
    for number in 0..options.inputs {
        let input = match usize::try_from(number).ok().and_then(|number| seeds.get(number)) {
            Some(seed) => seed.clone(),
            None => {
                let [one, other] = [(); 2].map(|()| {
                    // What is wrong already is mostly wrong for the same reason again.
                    let from = usize::from(random.u8(..5) == 0 && !kept[1].is_empty());
                    &kept[from][random.usize(..kept[from].len())]
                });
                (target.mutate)(&mut random, one, other)
            }
        };
        let begin = Instant::now();
        let outcome = attempt(target, &input);
        let mut took = begin.elapsed();
        // Other programs may have had the processor: what is slow itself is slow again and again.
        for _ in 0..4 {
            if took > LONG {
                let begin = Instant::now();
                let _ = attempt(target, &input);
                took = took.min(begin.elapsed());
            }
        }
        slowest = slowest.max(took);
        if took > LONG {
            let file = keep(target, &input, &format!("slow-{number}"));
            println!("{}: {took:.1?} for {}", target.name, file.display());
        }
        let (wrong, shape) = match outcome {
            Err(panic) => {
                if failures.insert(shape(&panic)) {
                    let file = keep(target, &input, &number.to_string());
                    println!("{}: {panic}\n    with {}", target.name, file.display());
                }
                continue;
            }
            Ok(Ok(kind)) => (0, kind),
            Ok(Err(error)) => (1, shape(&error)),
        };
        accepted += 1 - wrong;
        if shapes.insert(shape.clone()) {
            if options.tells {
                println!("{}: {shape}", ["right", "wrong"][wrong]);
            }
            let kept = &mut kept[wrong];
            if kept.len() < MAX_KEPT {
                kept.push(input);
            } else {
                let place = random.usize(..MAX_KEPT);
                kept[place] = input;
            }
        }
    }
    println!(
        "{}: {} inputs in {:.1?}, {accepted} accepted, {} kinds of outcome, slowest {slowest:.1?}, at most {} MiB, \
         {} failures",
        target.name,
        options.inputs,
        start.elapsed(),
        shapes.len(),
        MEMORY.max_allocated() >> 20,
        failures.len()
    );
    assert!(accepted > 0 || options.inputs < FEW, "no input is right, so that little is tried");
    failures.len()
}

/// Keeps an input for people, in the folder `fuzz` of the folder that the tests were built in.
fn keep(target: &Target, input: &[u8], name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("fuzz");
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join(format!("{}-{name}.{}", target.name, target.extension));
    std::fs::write(&file, input).expect("a writable folder");
    file
}

/// The words of a message, without those that have digits, and without what it quotes.
fn shape(message: &str) -> String {
    let parts = message.split(['\'', '"', '`']).step_by(2).collect::<Vec<_>>().join("'");
    let words = parts.split(|letter: char| !letter.is_alphanumeric());
    let words =
        words.map(|word| if word.contains(|letter: char| letter.is_ascii_digit()) { "#" } else { word });
    words.collect::<Vec<_>>().join(" ").chars().take(160).collect()
}
