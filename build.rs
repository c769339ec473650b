//! Compiles the program's compute shaders, `shaders/*.comp`, to SPIR-V in `OUT_DIR`, where
//! `src/vulkan/pipeline.rs` embeds them. Shaders include files by their paths in `shaders`. They also include files
//! that this script generates from `src/interface.rs`: `interface.glsl` contains its numbers, and `shape/kinds.glsl`
//! includes the file of every kind of shape. Lights, materials, textures and apertures have a `kinds.glsl` too.
//!
//! The build script of `tests/shaders` uses this one to compile the shaders that only tests and benches need.

use glslang::{
    Compiler, CompilerOptions, Program, Shader, ShaderInput, ShaderSource, ShaderStage, SourceLanguage,
    SpirvVersion, Target, VulkanVersion,
    error::GlslangError,
    include::{IncludeHandler, IncludeResult, IncludeType},
};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

#[path = "src/interface.rs"]
#[allow(dead_code, reason = "only its lists are read here")]
mod interface;

/// The sources of the shaders: the root of this package, and the text of `interface.glsl`.
pub struct Sources {
    root: PathBuf,
    interface: String,
}

/// The folders of `shaders` that contain a file for each kind, with the names of the kinds.
const KINDS: &[(&str, &[&str])] = &[
    ("aperture", interface::aperture::NAMES),
    ("light", interface::light::NAMES),
    ("material", interface::material::NAMES),
    ("shape", interface::shape::NAMES),
    ("texture", interface::texture::NAMES),
];

/// A compiled shader.
pub struct Compiled {
    /// The SPIR-V.
    pub words: Vec<u32>,
    /// The names of the source files: the shader's own, and all that it includes.
    pub files: Vec<String>,
}

/// Takes the name of a source file and its text, and returns the text to compile instead.
pub type Edit<'a> = &'a dyn Fn(&str, String) -> String;

fn main() {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let sources = Sources::new(Path::new(""));
    let mut failed = false;
    for path in sources.shaders("shaders") {
        match sources.compile(&path, &|_, text| text) {
            Ok(compiled) => {
                let name = path.file_name().expect("a file has a name").to_string_lossy();
                write_words(&out.join(format!("{name}.spv")), &compiled.words);
            }
            Err(error) => {
                failed = true;
                report(&path, "", &error);
            }
        }
    }
    if failed {
        std::process::exit(1);
    }
}

/// Writes SPIR-V as bytes, little-endian.
pub fn write_words(path: &Path, words: &[u32]) {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    std::fs::write(path, bytes).expect("OUT_DIR is writable");
}

impl Sources {
    /// The sources of the package in the folder `root`. Cargo runs the build script again when one of them changes.
    pub fn new(root: &Path) -> Self {
        for file in ["build.rs", "src/interface.rs", "shaders"] {
            println!("cargo::rerun-if-changed={}", root.join(file).display());
        }
        Self { root: root.to_owned(), interface: interface_glsl() }
    }

    /// The compute shaders of a folder, in the order of their names.
    pub fn shaders(&self, folder: &str) -> Vec<PathBuf> {
        let folder = self.root.join(folder);
        println!("cargo::rerun-if-changed={}", folder.display());
        let entries = std::fs::read_dir(folder).expect("the folder is part of the package");
        let paths = entries.map(|entry| entry.expect("a readable entry").path());
        let mut shaders: Vec<_> =
            paths.filter(|path| path.extension().is_some_and(|extension| extension == "comp")).collect();
        shaders.sort();
        shaders
    }

    /// Generates the `kinds.glsl` of a folder, which includes the file of every kind. A kind need not define every
    /// function. For each function that some kinds define, a macro goes through these kinds:
    /// `FOR_EACH_APERTURE_POINT(DO)` is `DO(DISC, disc) DO(BLADES, blades)` and so on.
    fn kinds_glsl(&self, folder: &str) -> Option<String> {
        let (_, names) = KINDS.iter().find(|(of, _)| *of == folder)?;
        let upper = folder.to_uppercase();
        let mut glsl = format!("#ifndef {upper}_KINDS_GLSL\n#define {upper}_KINDS_GLSL\n");
        let mut of_functions = BTreeMap::<String, Vec<&str>>::new();
        for name in *names {
            let kind = name.to_lowercase();
            let file = format!("{folder}/{kind}.glsl");
            let text = std::fs::read_to_string(self.root.join("shaders").join(&file)).ok()?;
            for function in functions(&text, &kind) {
                of_functions.entry(function.to_uppercase()).or_default().push(name);
            }
            writeln!(glsl, "#include \"{file}\"").expect("a string grows");
        }
        for (function, kinds) in of_functions {
            writeln!(glsl, "{}", for_each(&format!("{upper}_{function}"), &kinds)).expect("a string grows");
        }
        if folder == "shape" {
            glsl += &shape_ranges();
        }
        Some(glsl + "#endif\n")
    }

    /// Compiles a shader after `edit` has changed the text of its files.
    pub fn compile(&self, path: &Path, edit: Edit<'_>) -> Result<Compiled, GlslangError> {
        let compiler = Compiler::acquire().expect("glslang starts once a process");
        let name = path.file_name().expect("a file has a name").to_string_lossy().into_owned();
        let text = std::fs::read_to_string(path).expect("a readable shader");
        let source = ShaderSource::from(edit(&name, text));
        let options = CompilerOptions {
            source_language: SourceLanguage::GLSL,
            target: Target::Vulkan {
                version: VulkanVersion::Vulkan1_3,
                spirv_version: SpirvVersion::SPIRV1_6,
            },
            ..CompilerOptions::default()
        };
        let mut includes = Includes { sources: self, edit, files: vec![name] };
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
        Ok(Compiled { words, files: includes.files })
    }
}

/// Finds the file of each `#include "name"`, and keeps the names of all files that it found.
struct Includes<'a> {
    sources: &'a Sources,
    edit: Edit<'a>,
    files: Vec<String>,
}

impl IncludeHandler for Includes<'_> {
    fn include(
        &mut self,
        _kind: IncludeType,
        name: &str,
        _includer: &str,
        _depth: usize,
    ) -> Option<IncludeResult> {
        let text = match name {
            "interface.glsl" => self.sources.interface.clone(),
            _ => match name.strip_suffix("/kinds.glsl") {
                Some(folder) => self.sources.kinds_glsl(folder)?,
                None => std::fs::read_to_string(self.sources.root.join("shaders").join(name)).ok()?,
            },
        };
        self.files.push(name.to_owned());
        Some(IncludeResult { data: (self.edit)(name, text), name: name.to_owned() })
    }
}

/// `src/interface.rs` in GLSL.
fn interface_glsl() -> String {
    let mut glsl = String::from("#ifndef INTERFACE_GLSL\n#define INTERFACE_GLSL\n");
    let mut add = |kind: &str, name: &str, value: String| {
        writeln!(glsl, "const {kind} {name} = {value};").expect("a string grows");
    };
    for (start, names) in interface::LISTS {
        for (number, name) in names.iter().enumerate() {
            add("uint", &format!("{start}{name}"), format!("{number}u"));
        }
    }
    for (name, number) in interface::NUMBERS {
        match number {
            interface::Number::U32(value) => add("uint", name, format!("{value}u")),
            interface::Number::F32(value) => add("float", name, format!("{value:?}")),
            interface::Number::Vec3([x, y, z]) => add("vec3", name, format!("vec3({x:?}, {y:?}, {z:?})")),
        }
    }
    glsl + "#endif\n"
}

/// The constants and macros that shaders need for shapes alone. `KIND_BEGIN` and `KIND_END` are the range of a kind in
/// the list.
fn shape_ranges() -> String {
    use interface::shape::{FIRST_UNBOUNDED, NAMES};
    let mut glsl = String::new();
    let mut begin = "0u".to_owned();
    let mut ends = Vec::new();
    for (number, name) in NAMES.iter().enumerate() {
        let end = format!("{name}_END");
        write!(
            glsl,
            "layout(constant_id = ID_SHAPE_END + {number}u) const uint {end} = 0u;\n\
             const uint {name}_BEGIN = {begin};\n"
        )
        .expect("a string grows");
        begin.clone_from(&end);
        ends.push(end);
    }
    let (bounded, unbounded) = NAMES.split_at(FIRST_UNBOUNDED as usize);
    for (name, kinds) in [("BOUNDED_", bounded), ("UNBOUNDED_", unbounded), ("", NAMES)] {
        writeln!(glsl, "{}", for_each(&format!("{name}KIND"), kinds)).expect("a string grows");
    }
    let bits = |count: usize| (1_u32 << count) - 1;
    writeln!(
        glsl,
        "const uint BOUNDED_KINDS = {}u;\nconst uint ALL_KINDS = {}u;\nconst uint SHAPE_KIND_COUNT = {}u;\n\
         const uint BOUNDED_SHAPES_END = {};\nconst uint SHAPES_END = {};",
        bits(bounded.len()),
        bits(NAMES.len()),
        NAMES.len(),
        ends[bounded.len() - 1],
        ends[NAMES.len() - 1]
    )
    .expect("a string grows");
    glsl
}

/// A macro that applies another macro to each of these kinds.
fn for_each(name: &str, kinds: &[&str]) -> String {
    let each: String = kinds.iter().map(|kind| format!(" DO({kind}, {})", kind.to_lowercase())).collect();
    format!("#define FOR_EACH_{name}(DO){each}")
}

/// The functions that the file of a kind defines. `sphere_distance` is the function `distance` of the kind `sphere`.
/// A definition ends its first line with `{`, or with `(` if its parameters are on lines of their own.
fn functions<'a>(text: &'a str, kind: &str) -> Vec<&'a str> {
    let start = format!("{kind}_");
    let defined = |line: &'a str| {
        let (declared, rest) = line.split_once('(')?;
        let (_, name) = declared.split_once(' ')?;
        ((rest.ends_with('{') || rest.is_empty()) && !line.starts_with(' '))
            .then(|| name.strip_prefix(&start))
            .flatten()
    };
    text.lines().filter_map(defined).collect()
}

/// Prints a compiler error so that cargo shows it, which it does only for lines that start with `cargo::error=`. The
/// shader's path replaces "0", which is glslang's name for it. `with` tells how the shader was edited, if it was.
pub fn report(path: &Path, with: &str, error: &GlslangError) {
    let log = error.to_string();
    let errors: Vec<&str> = log.lines().filter(|line| line.contains("ERROR")).collect();
    let lines = if errors.is_empty() { log.lines().collect() } else { errors };
    println!("cargo::error={} does not compile{with}", path.display());
    for line in lines {
        let line = line.replace("ERROR: 0:", &format!("{}:", path.display()));
        println!("cargo::error={}", line.replace("ERROR: ", ""));
    }
}
