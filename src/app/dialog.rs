//! The system's own dialogs in which a file is chosen.

use super::message::Kind;
use log::{Level, Log, Metadata, Record};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use winit::window::Window;

/// What a file is chosen for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    Open,
    Save(Kind),
}

/// A dialog that is open. A thread waits for it, so that the viewer goes on.
pub(super) struct Dialog {
    purpose: Purpose,
    answer: Receiver<Result<Option<PathBuf>, String>>,
}

impl Dialog {
    /// Opens a dialog that suggests this file. `wake` is called once it is closed.
    pub(super) fn open(
        purpose: Purpose,
        suggested: &Path,
        window: &Window,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let dialog = rfd::FileDialog::new().set_parent(window);
        let dialog = match suggested.parent().filter(|folder| folder.is_dir()) {
            Some(folder) => dialog.set_directory(folder),
            None => dialog,
        };
        let dialog = match purpose {
            Purpose::Open => dialog
                .set_title("Open")
                .add_filter("Scenes, meshes and pictures", &["toml", "obj", "png", "exr"])
                .add_filter("All files", &["*"]),
            Purpose::Save(Kind::Picture) => dialog
                .set_title("Save the picture")
                .add_filter("PNG, the picture as it is shown", &["png"])
                .add_filter("EXR, linear light", &["exr"]),
            Purpose::Save(Kind::Scene) => dialog.set_title("Save the scene").add_filter("Scene", &["toml"]),
        };
        let dialog = match (purpose, suggested.file_name()) {
            (Purpose::Save(_), Some(name)) => dialog.set_file_name(name.to_string_lossy()),
            _ => dialog,
        };
        let (sender, answer) = channel();
        std::thread::spawn(move || {
            let chosen = match purpose {
                Purpose::Open => dialog.pick_file(),
                Purpose::Save(_) => dialog.save_file(),
            };
            // Sending fails only when the window has closed.
            let _ = sender.send(match (chosen, failure()) {
                (None, Some(why)) => Err(why),
                (chosen, _) => Ok(chosen),
            });
            wake();
        });
        Self { purpose, answer }
    }

    /// Once the dialog is closed: what it was for, and the file, or why there was no dialog. There is no file if the user
    /// has changed their mind.
    pub(super) fn poll(&self) -> Option<(Purpose, Result<Option<PathBuf>, String>)> {
        match self.answer.try_recv() {
            Ok(answer) => Some((self.purpose, answer)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some((self.purpose, Err("the dialog has failed".into()))),
        }
    }
}

thread_local! {
    /// What rfd has logged as an error on this thread.
    static ERRORS: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

/// Why no dialog could be opened on this thread, if none could: neither by the desktop's portal nor by the program
/// zenity.
fn failure() -> Option<String> {
    let errors = ERRORS.take();
    let failed = errors.iter().any(|error| error.contains("zenity"));
    failed.then(|| errors.join("; "))
}

/// A log that also hears why rfd opens no dialog. rfd tells that only to the log: a dialog that does not open and one
/// that the user closes both give no file.
pub struct DialogLog<L>(pub L);

impl<L: Log> Log for DialogLog<L> {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        is_of_dialogs(metadata) || self.0.enabled(metadata)
    }

    fn log(&self, record: &Record<'_>) {
        if !is_of_dialogs(record.metadata()) {
            self.0.log(record);
        } else if record.level() == Level::Error {
            ERRORS.with_borrow_mut(|errors| errors.push(record.args().to_string()));
        }
    }

    fn flush(&self) {
        self.0.flush();
    }
}

fn is_of_dialogs(metadata: &Metadata<'_>) -> bool {
    metadata.target().starts_with("rfd")
}
