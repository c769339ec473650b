//! The system's clipboard, for imgui.

/// Copies nothing if the system has no clipboard.
pub(super) struct Clipboard(Option<arboard::Clipboard>);

impl Clipboard {
    pub(super) fn new() -> Self {
        let system = arboard::Clipboard::new();
        Self(system.inspect_err(|error| log::warn!("no clipboard: {error}")).ok())
    }

    pub(super) fn is_there(&self) -> bool {
        self.0.is_some()
    }
}

impl imgui::ClipboardBackend for Clipboard {
    fn get(&mut self) -> Option<String> {
        self.0.as_mut()?.get_text().ok()
    }

    fn set(&mut self, text: &str) {
        let copied = self.0.as_mut().map(|system| system.set_text(text));
        if let Some(Err(error)) = copied {
            log::warn!("cannot copy: {error}");
        }
    }
}
