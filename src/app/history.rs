//! Undo and redo.

/// Changes that are kept.
const MOST: usize = 500;

/// What there was before, and what was undone, the latest last.
pub(super) struct History<T> {
    past: Vec<T>,
    now: T,
    undone: Vec<T>,
}

impl<T: Clone + PartialEq> History<T> {
    pub(super) fn new(now: T) -> Self {
        Self { past: Vec::new(), now, undone: Vec::new() }
    }

    /// Takes in how things are, once a change is over.
    pub(super) fn record(&mut self, now: &T) {
        if *now == self.now {
            return;
        }
        self.undone.clear();
        self.past.push(std::mem::replace(&mut self.now, now.clone()));
        if self.past.len() > MOST {
            self.past.remove(0);
        }
    }

    /// One change back. None where there is nothing to undo.
    pub(super) fn undo(&mut self) -> Option<T> {
        let before = self.past.pop()?;
        self.undone.push(std::mem::replace(&mut self.now, before));
        Some(self.now.clone())
    }

    /// One undone change forth again.
    pub(super) fn redo(&mut self) -> Option<T> {
        let after = self.undone.pop()?;
        self.past.push(std::mem::replace(&mut self.now, after));
        Some(self.now.clone())
    }
}
