//! What must not stay behind when a signal ends the program: part files, and a bar on the terminal.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

type Removal = Box<dyn FnOnce() + Send>;

/// The files to remove, in the order in which they were made.
static LEFTOVERS: Mutex<BTreeMap<u64, Removal>> = Mutex::new(BTreeMap::new());

/// Something that is removed should a signal end the program while this lives.
pub(crate) struct Leftover(u64);

impl Leftover {
    /// Makes something, and says how it is removed. No signal ends the program in between.
    pub(crate) fn of<T, E>(
        make: impl FnOnce() -> Result<T, E>,
        remove: impl FnOnce() + Send + 'static,
    ) -> Result<(T, Self), E> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let mut leftovers = lock();
        let made = make()?;
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        leftovers.insert(number, Box::new(remove));
        Ok((made, Self(number)))
    }
}

impl Drop for Leftover {
    fn drop(&mut self) {
        lock().remove(&self.0);
    }
}

fn lock() -> MutexGuard<'static, BTreeMap<u64, Removal>> {
    LEFTOVERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is left, and ends the program. The lock is held until the end, so that nothing new is made.
fn end(exit: impl FnOnce()) {
    let mut leftovers = lock();
    while let Some((_, remove)) = leftovers.pop_first() {
        remove();
    }
    exit();
}

/// From now on the signals that end programs leave nothing behind: Ctrl-C, and on Unix SIGTERM, SIGHUP and
/// SIGQUIT too. The exit status is 128 + the signal. A second signal does not wait for the first.
pub fn install() {
    if let Err(error) = listen() {
        log::warn!("signals are not handled ({error}); one may leave a .thinlens-*.part file behind");
    }
}

#[cfg(unix)]
fn listen() -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::{flag, iterator::Signals, low_level};
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    let signals: Vec<i32> =
        [SIGINT, SIGTERM, SIGHUP, SIGQUIT].into_iter().filter(|signal| !is_ignored(*signal)).collect();
    let ending = Arc::new(AtomicBool::new(false));
    for signal in &signals {
        // In this order: the first signal only sets the flag, the second finds it set.
        flag::register_conditional_shutdown(*signal, 128 + signal, Arc::clone(&ending))?;
        flag::register(*signal, Arc::clone(&ending))?;
    }
    let mut signals = Signals::new(&signals)?;
    std::thread::Builder::new().name("signals".into()).spawn(move || {
        if let Some(signal) = signals.forever().next() {
            // Without the exit handlers of drivers, which other threads are still in.
            end(|| low_level::exit(128 + signal));
        }
    })?;
    Ok(())
}

#[cfg(windows)]
fn listen() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| end(|| std::process::exit(130)))
}

/// Whether whoever started the program wants it to live on, as `nohup` does. Only Linux says so without unsafe
/// code.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}
