//! A thread for slow work: it makes the renderer, reads files, builds trees, uploads them and compiles passes, while the
//! window continues with what it has.

use super::content::Content;
use crate::error::Result;
use crate::renderer::{Prepared, Preparer, Renderer};
use crate::settings::Settings;
use crate::vulkan::Device;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use winit::event_loop::EventLoopProxy;

/// The thread and its pending requests. The newest request to open something replaces older ones.
pub(super) struct Loader {
    /// `None` once the thread is to end.
    requests: Option<Sender<Request>>,
    answers: Receiver<Answer>,
    renderer: Receiver<Result<Renderer>>,
    thread: Option<JoinHandle<()>>,
    /// The file or scene that is being opened.
    loading: Option<PathBuf>,
    /// Whether something is being prepared.
    preparing: bool,
    /// The number of the newest request to open something.
    newest: Arc<AtomicU64>,
}

enum Request {
    Open { number: u64, name: PathBuf, now: Box<Settings> },
    Prepare(Box<Settings>),
}

enum Answer {
    Opened { number: u64, name: PathBuf, opened: Result<Box<(Content, Prepared)>> },
    Prepared(Result<Box<(Settings, Prepared)>>),
}

/// A result of the thread.
pub(super) enum Ready {
    /// The file or scene that was opened, and the parts that its settings need.
    Opened { name: PathBuf, opened: Result<Box<(Content, Prepared)>> },
    /// The parts that settings need, and these settings, with the scene as it is to be shown.
    Prepared(Result<Box<(Settings, Prepared)>>),
}

impl Loader {
    /// Starts the thread, which first makes a renderer for these settings. `waker` is notified whenever something is
    /// ready.
    pub(super) fn new(device: &Arc<Device>, settings: &Settings, waker: EventLoopProxy<()>) -> Self {
        let (requests, incoming) = channel();
        let (done, answers) = channel();
        let (made, renderer) = channel();
        let newest = Arc::new(AtomicU64::new(0));
        // Sending fails only when the window has closed, and then nobody needs the answer.
        let wake = move || {
            let _ = waker.send_event(());
        };
        let (device, settings, of_worker) = (Arc::clone(device), settings.clone(), Arc::clone(&newest));
        let work = move || {
            let renderer = Renderer::new(&device, &settings);
            let parts = renderer.as_ref().ok().map(|made| (made.preparer(), made.prepared().clone()));
            let _ = made.send(renderer);
            wake();
            let Some((preparer, last)) = parts else { return };
            let answer = move |answer| {
                let _ = done.send(answer);
                wake();
            };
            let mut worker = Worker { preparer, last, newest: of_worker, answer };
            while worker.work(&incoming) {}
        };
        Self {
            requests: Some(requests),
            answers,
            renderer,
            thread: Some(std::thread::spawn(work)),
            loading: None,
            preparing: false,
            newest,
        }
    }

    /// Opens a scene, a mesh or a picture, which replaces what is shown now.
    pub(super) fn open(&mut self, name: &Path, now: &Settings) {
        let number = self.newest.fetch_add(1, Ordering::Relaxed) + 1;
        self.loading = Some(name.to_path_buf());
        self.ask(Request::Open { number, name: name.to_path_buf(), now: Box::new(now.clone()) });
    }

    /// Prepares the parts that these settings need, unless something is being prepared already: that cannot be stopped,
    /// and while a slider moves, it is better than nothing.
    pub(super) fn prepare(&mut self, settings: &Settings) {
        if !self.preparing {
            self.preparing = true;
            self.ask(Request::Prepare(Box::new(settings.clone())));
        }
    }

    fn ask(&self, request: Request) {
        // Sending fails only when the thread has ended, which it does when the loader is dropped.
        let _ = self.requests.as_ref().map(|requests| requests.send(request));
    }

    /// The renderer, once it is made. Nothing else is ready before.
    pub(super) fn renderer(&self) -> Option<Result<Renderer>> {
        self.renderer.try_recv().ok()
    }

    /// The name of what is being opened.
    pub(super) fn loading(&self) -> Option<&Path> {
        self.loading.as_deref()
    }

    /// Whether anything is being opened or prepared.
    pub(super) fn is_busy(&self) -> bool {
        self.loading.is_some() || self.preparing
    }

    /// The next thing that is ready and still wanted.
    pub(super) fn next(&mut self) -> Option<Ready> {
        while let Ok(answer) = self.answers.try_recv() {
            match answer {
                Answer::Opened { number, name, opened } => {
                    if number == self.newest.load(Ordering::Relaxed) {
                        self.loading = None;
                        return Some(Ready::Opened { name, opened });
                    }
                }
                Answer::Prepared(prepared) => {
                    self.preparing = false;
                    return Some(Ready::Prepared(prepared));
                }
            }
        }
        None
    }
}

impl Drop for Loader {
    /// Waits for the current step to end: a driver cannot be told to stop compiling.
    fn drop(&mut self) {
        self.requests = None;
        self.newest.fetch_add(1, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

struct Worker<F> {
    preparer: Arc<Preparer>,
    /// The parts that were made last. New settings share those that fit them.
    last: Prepared,
    newest: Arc<AtomicU64>,
    answer: F,
}

impl<F: Fn(Answer)> Worker<F> {
    /// Waits for requests, and handles the newest of each kind. Returns false when there will be no more.
    fn work(&mut self, incoming: &Receiver<Request>) -> bool {
        let Ok(first) = incoming.recv() else {
            return false;
        };
        let (mut open, mut prepare) = (None, None);
        for request in std::iter::once(first).chain(incoming.try_iter()) {
            match request {
                Request::Open { .. } => open = Some(request),
                Request::Prepare(settings) => prepare = Some(settings),
            }
        }
        // What the current picture needs comes first, because it takes less time than opening another picture.
        if let Some(settings) = prepare {
            let mut settings = *settings;
            let prepared = settings.restage().and_then(|()| self.prepare(&settings));
            let prepared = prepared.map(|prepared| Box::new((settings, prepared)));
            (self.answer)(Answer::Prepared(prepared));
        }
        if let Some(Request::Open { number, name, now }) = open {
            let opened = Content::read(&name);
            // A newer request to open something may have arrived.
            if number == self.newest.load(Ordering::Relaxed) {
                let opened = opened.and_then(|content| {
                    let prepared = self.prepare(&content.settings(&now))?;
                    Ok(Box::new((content, prepared)))
                });
                (self.answer)(Answer::Opened { number, name, opened });
            }
        }
        true
    }

    fn prepare(&mut self, settings: &Settings) -> Result<Prepared> {
        let prepared = self.preparer.prepare(settings, true, Some(&self.last))?;
        self.last = prepared.clone();
        Ok(prepared)
    }
}
