//! Undo and redo.

/// The largest number of changes that can be undone.
const MOST: usize = 500;

/// Earlier states and undone states, each with the latest one last.
pub(super) struct History<T> {
    past: Vec<T>,
    now: T,
    undone: Vec<T>,
}

impl<T: Clone + PartialEq> History<T> {
    pub(super) fn new(now: T) -> Self {
        Self { past: Vec::new(), now, undone: Vec::new() }
    }

    /// Records the current state, once a change is over.
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

    pub(super) fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    pub(super) fn can_redo(&self) -> bool {
        !self.undone.is_empty()
    }

    /// Undoes the last change. `None` if there is nothing to undo.
    pub(super) fn undo(&mut self) -> Option<T> {
        let before = self.past.pop()?;
        self.undone.push(std::mem::replace(&mut self.now, before));
        Some(self.now.clone())
    }

    /// Redoes the change that was undone last. `None` if there is none.
    pub(super) fn redo(&mut self) -> Option<T> {
        let after = self.undone.pop()?;
        self.past.push(std::mem::replace(&mut self.now, after));
        Some(self.now.clone())
    }
}
