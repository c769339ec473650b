//! A picture that another process renders to a file, while the viewer goes on.

use crate::error::Error;
use crate::settings::Settings;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};

/// The process, which is stopped when this is dropped.
pub(super) struct RenderJob {
    process: Child,
    lines: Receiver<String>,
    /// The file that it writes once it is done.
    pub(super) file: PathBuf,
    /// How far it is, in words.
    pub(super) progress: String,
    /// The last line that it wrote, which says what is wrong if it fails.
    last: String,
}

impl RenderJob {
    /// Starts to render these settings, in this size and on this device. `wake` is called whenever there is news.
    pub(super) fn start(
        settings: &Settings,
        size: [u32; 2],
        device: &str,
        file: &Path,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, Error> {
        let mut settings = settings.clone();
        settings.estimator.size = size;
        let failed = |error: std::io::Error| {
            Error::OutOfRange(format!("cannot start another thinlens to render: {error}"))
        };
        let mut command = Command::new(std::env::current_exe().map_err(failed)?);
        command.arg("render").args(settings.arguments_from_anywhere());
        command.arg(format!("--device={device}"));
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        command.arg("-o").arg(file);
        let mut process = command.spawn().map_err(failed)?;
        let (sender, lines) = channel();
        if let Some(errors) = process.stderr.take() {
            std::thread::spawn(move || listen(errors, &sender, wake));
        }
        let (file, progress) = (file.to_path_buf(), "it begins".into());
        Ok(Self { process, lines, file, progress, last: String::new() })
    }

    /// Takes in what the process wrote. Once it has ended, returns the file, or why there is none.
    pub(super) fn poll(&mut self) -> Option<Result<PathBuf, String>> {
        for line in self.lines.try_iter() {
            if line.contains("samples per pixel") {
                self.progress.clone_from(&line);
            }
            self.last = line;
        }
        match self.process.try_wait() {
            Ok(None) => None,
            Ok(Some(status)) if status.success() => Some(Ok(self.file.clone())),
            Ok(Some(_)) => {
                // What it wrote last may have come since.
                self.last = self.lines.try_iter().last().unwrap_or(std::mem::take(&mut self.last));
                Some(Err(self.last.clone()))
            }
            Err(error) => Some(Err(error.to_string())),
        }
    }
}

impl Drop for RenderJob {
    fn drop(&mut self) {
        // This fails if the process has ended already. It is asked to end, so that it removes what it has begun to write.
        #[cfg(unix)]
        let _ = rustix::process::kill_process(
            rustix::process::Pid::from_child(&self.process),
            rustix::process::Signal::TERM,
        );
        #[cfg(not(unix))]
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Passes on each line, and wakes the viewer for it and for the end.
fn listen(errors: impl Read, lines: &Sender<String>, wake: impl Fn()) {
    for line in BufReader::new(errors).lines().map_while(Result::ok) {
        if lines.send(line).is_err() {
            return;
        }
        wake();
    }
    wake();
}
