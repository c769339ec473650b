//! The shaders that only tests and benches need: those of the program with the mistakes of `tests/faults`, the
//! probes of `tests/probes`, and what benches compare with.

/// A shader in SPIR-V: the name of its file without `.comp`, the fault planted in it (empty where there is none),
/// and where it lies.
type Entry = (&'static str, &'static str, &'static str);

const SHADERS: &[Entry] = include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// The SPIR-V of a shader, which lives as long as the program. None where there is no such shader, or where the
/// fault does not lie in its source.
///
/// # Panics
/// Where the file that the build script wrote is gone.
pub fn spirv(name: &str, fault: &str) -> Option<&'static [u8]> {
    let (.., path) = SHADERS.iter().find(|shader| (shader.0, shader.1) == (name, fault))?;
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    Some(bytes.leak())
}

/// Every fault's name and tags.
const FAULTS: &[(&str, &[&str])] = include!(concat!(env!("OUT_DIR"), "/faults.rs"));

/// The faults that have this tag, or the one that has this name.
pub fn faults(asked: &str) -> impl Iterator<Item = &'static str> {
    FAULTS.iter().filter(move |(name, tags)| *name == asked || tags.contains(&asked)).map(|(name, _)| *name)
}

/// The names of all faults.
pub fn names() -> impl Iterator<Item = &'static str> {
    FAULTS.iter().map(|(name, _)| *name)
}

/// Whether any shader has this fault.
pub fn has_fault(fault: &str) -> bool {
    SHADERS.iter().any(|shader| shader.1 == fault)
}
