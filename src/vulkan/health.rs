//! What is known of a device that stops working.

use crate::error::Error;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// For tests: the device counts as lost from so many submissions of the program on, and one that is opened after
/// that is not lost again.
const LOSE_DEVICE_AT: &str = "THINLENS_TEST_LOSE_DEVICE_AT";

/// What the device was given last, and whether it works.
#[derive(Default)]
pub(super) struct Health {
    passes: Mutex<Vec<&'static str>>,
    is_lost: AtomicBool,
}

impl Health {
    /// These passes are handed to the device. False where a test has it count as lost.
    pub(super) fn submits(&self, passes: &[&'static str]) -> bool {
        static LEFT: OnceLock<AtomicU32> = OnceLock::new();
        let left = LEFT.get_or_init(|| {
            let wanted = std::env::var(LOSE_DEVICE_AT).ok().and_then(|number| number.parse().ok());
            AtomicU32::new(wanted.unwrap_or(0))
        });
        if !passes.is_empty() {
            passes.clone_into(&mut self.passes.lock().unwrap_or_else(PoisonError::into_inner));
        }
        let before = left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
        if before == Ok(1) {
            self.is_lost.store(true, Ordering::Relaxed);
        }
        !self.is_lost.load(Ordering::Relaxed)
    }

    /// What to tell of a device that is lost.
    pub(super) fn error(&self) -> Error {
        let passes = self.passes.lock().unwrap_or_else(PoisonError::into_inner).join(", ");
        Error::DeviceLost { passes: if passes.is_empty() { "copies".into() } else { passes } }
    }
}
