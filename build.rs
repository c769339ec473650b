//! Compiles compute shaders to SPIR-V in `OUT_DIR`: those of the program, which
//! `src/vulkan/pipeline.rs` embeds, and those that benches and tests embed.
//!
//! Tests also get each shader with each of the mistakes of `tests/faults.txt` that lies in its
//! source, and a table of all of these in `test_shaders.rs`.

use glslang::{
    Compiler, CompilerOptions, Program, Shader, ShaderInput, ShaderSource, ShaderStage, SourceLanguage,
    SpirvVersion, Target, VulkanVersion,
    error::GlslangError,
    include::{IncludeHandler, IncludeResult, IncludeType},
};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const FOLDERS: [&str; 3] = ["shaders", "benches", "tests/probes"];
const FAULTS: &str = "tests/faults.txt";

/// A mistake to plant: a text that stands once in one file, and what stands there instead.
struct Fault {
    name: String,
    file: String,
    from: String,
    to: String,
}

/// Finds `#include "name"` in `shaders/include`, and notes what it found.
struct Includes<'a> {
    fault: Option<&'a Fault>,
    found: Vec<String>,
}

impl IncludeHandler for Includes<'_> {
    fn include(
        &mut self,
        _kind: IncludeType,
        name: &str,
        _includer: &str,
        _depth: usize,
    ) -> Option<IncludeResult> {
        let path = Path::new("shaders").join("include").join(name);
        let text = read(&path, self.fault)?;
        self.found.push(name.to_owned());
        Some(IncludeResult { data: text, name: path.display().to_string() })
    }
}

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={FAULTS}");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let faults = parse_faults(&std::fs::read_to_string(FAULTS).expect("a readable list of faults"));
    for fault in &faults {
        check(fault, &faults);
    }
    let mut table = String::from("&[\n");
    let mut failed = false;
    let mut build = |path: &Path, fault: Option<&Fault>| {
        let name = path.file_stem().expect("a file has a name").to_string_lossy();
        let fault_name = fault.map_or("", |fault| &fault.name);
        match compile(path, fault) {
            Ok((words, found)) => {
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
                let file = if fault.is_some() {
                    format!("{name}.{fault_name}.spv")
                } else {
                    format!("{name}.comp.spv")
                };
                std::fs::write(out.join(&file), bytes).expect("OUT_DIR is writable");
                writeln!(
                    table,
                    "(\"{name}\", \"{fault_name}\", include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{file}\"))),"
                )
                .expect("a string grows");
                found
            }
            Err(error) => {
                failed = true;
                report(path, fault_name, &error);
                Vec::new()
            }
        }
    };
    for path in FOLDERS.iter().flat_map(|folder| files(folder)) {
        if path.extension().is_none_or(|extension| extension != "comp") {
            continue;
        }
        let mut sources = build(&path, None);
        sources.push(path.file_name().expect("a file has a name").to_string_lossy().into_owned());
        // Benches measure, and have nothing to find.
        let planted =
            faults.iter().filter(|fault| sources.contains(&fault.file) && !path.starts_with("benches"));
        for fault in planted {
            build(&path, Some(fault));
        }
    }
    std::fs::write(out.join("test_shaders.rs"), table + "]\n").expect("OUT_DIR is writable");
    if failed {
        std::process::exit(1);
    }
}

/// The files of a folder. Cargo runs this again when one of them, or their number, changes.
fn files(folder: &str) -> Vec<PathBuf> {
    println!("cargo::rerun-if-changed={folder}");
    let entries = std::fs::read_dir(folder).expect("the folder is part of the package");
    entries.map(|entry| entry.expect("a readable entry").path()).collect()
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

/// Stops the build at a fault that cannot be planted: the line that it changes has been changed.
fn check(fault: &Fault, all: &[Fault]) {
    let Fault { name, file, from, .. } = fault;
    let folders = [Path::new("shaders"), Path::new("shaders/include")];
    let texts = folders.iter().filter_map(|folder| std::fs::read_to_string(folder.join(file)).ok());
    let times: usize = texts.map(|text| text.matches(from).count()).sum();
    let namesakes = all.iter().filter(|other| other.name == *name).count();
    if from.is_empty() || times != 1 || namesakes != 1 {
        println!(
            "cargo::error={FAULTS}: {name}: '{from}' must stand once in {file}, but stands there {times} times"
        );
        std::process::exit(1);
    }
}

/// A source's text, with the fault planted if it belongs there.
fn read(path: &Path, fault: Option<&Fault>) -> Option<String> {
    let text = std::fs::read_to_string(path).ok()?;
    let Some(fault) = fault.filter(|fault| path.ends_with(&fault.file)) else {
        return Some(text);
    };
    Some(text.replace(&fault.from, &fault.to))
}

/// The SPIR-V, and the names of the files that were included.
fn compile(path: &Path, fault: Option<&Fault>) -> Result<(Vec<u32>, Vec<String>), GlslangError> {
    let compiler = Compiler::acquire().expect("glslang starts once a process");
    let text = read(path, fault).expect("a readable shader");
    let source = ShaderSource::from(text);
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        target: Target::Vulkan { version: VulkanVersion::Vulkan1_3, spirv_version: SpirvVersion::SPIRV1_6 },
        ..CompilerOptions::default()
    };
    let mut includes = Includes { fault, found: Vec::new() };
    let input = ShaderInput::new(
        &source,
        ShaderStage::Compute,
        &options,
        None::<&[(&str, Option<&str>)]>,
        Some(&mut includes),
    )?;
    let shader = Shader::new(compiler, input).parse()?;
    let mut program = Program::new(compiler);
    program.add_shader(&shader);
    let words = program.compile(ShaderStage::Compute)?;
    Ok((words, includes.found))
}

/// glslang names the file it was given "0"; cargo shows what a build script says as an error only
/// behind `cargo::error=`.
fn report(path: &Path, fault: &str, error: &GlslangError) {
    let log = error.to_string();
    let errors: Vec<&str> = log.lines().filter(|line| line.contains("ERROR")).collect();
    let lines = if errors.is_empty() { log.lines().collect() } else { errors };
    let with = if fault.is_empty() { String::new() } else { format!(" with the fault {fault}") };
    println!("cargo::error={} does not compile{with}", path.display());
    for line in lines {
        let line = line.replace("ERROR: 0:", &format!("{}:", path.display()));
        println!("cargo::error={}", line.replace("ERROR: ", ""));
    }
}
