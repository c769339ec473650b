//! The three passes, in the order of the data: a pipeline and its `record()` each. A pass, its
//! shader, its file and its debug label share one name.

mod accumulate;
mod resolve;
mod trace;

pub use accumulate::Accumulate;
pub use resolve::Resolve;
pub use trace::{SceneBuffers, Trace};
