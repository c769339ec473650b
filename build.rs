//! Compiles compute shaders to SPIR-V in `OUT_DIR`: those of the program, which
//! `src/vulkan/pipeline.rs` embeds, and those that benches and tests embed.

use glslang::{
    Compiler, CompilerOptions, Program, Shader, ShaderInput, ShaderSource, ShaderStage, SourceLanguage,
    SpirvVersion, Target, VulkanVersion,
    error::GlslangError,
    include::{IncludeHandler, IncludeResult, IncludeType},
};
use std::path::{Path, PathBuf};

const FOLDERS: [&str; 3] = ["shaders", "benches", "tests"];

/// Finds `#include "name"` in `shaders/include`.
struct Includes(PathBuf);

impl IncludeHandler for Includes {
    fn include(
        &mut self,
        _kind: IncludeType,
        name: &str,
        _includer: &str,
        _depth: usize,
    ) -> Option<IncludeResult> {
        let path = self.0.join(name);
        Some(IncludeResult { data: std::fs::read_to_string(&path).ok()?, name: path.display().to_string() })
    }
}

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let mut failed = false;
    for path in FOLDERS.iter().flat_map(|folder| files(folder)) {
        if path.extension().is_none_or(|extension| extension != "comp") {
            continue;
        }
        match compile(&path) {
            Ok(words) => {
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
                let name = path.file_name().expect("a file has a name").to_string_lossy();
                std::fs::write(out.join(format!("{name}.spv")), bytes).expect("OUT_DIR is writable");
            }
            Err(error) => {
                failed = true;
                report(&path, &error.to_string());
            }
        }
    }
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

fn compile(path: &Path) -> Result<Vec<u32>, GlslangError> {
    let compiler = Compiler::acquire().expect("glslang starts once a process");
    let text = std::fs::read_to_string(path).expect("a readable shader");
    let source = ShaderSource::from(text);
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        target: Target::Vulkan { version: VulkanVersion::Vulkan1_3, spirv_version: SpirvVersion::SPIRV1_6 },
        ..CompilerOptions::default()
    };
    let mut includes = Includes(Path::new("shaders").join("include"));
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
    program.compile(ShaderStage::Compute)
}

/// glslang names the file it was given "0"; cargo shows what a build script says as an error only
/// behind `cargo::error=`.
fn report(path: &Path, log: &str) {
    let errors: Vec<&str> = log.lines().filter(|line| line.contains("ERROR")).collect();
    let lines = if errors.is_empty() { log.lines().collect() } else { errors };
    println!("cargo::error={} does not compile", path.display());
    for line in lines {
        let line = line.replace("ERROR: 0:", &format!("{}:", path.display()));
        println!("cargo::error={}", line.replace("ERROR: ", ""));
    }
}
