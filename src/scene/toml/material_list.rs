//! The materials of a scene file, by their names.

use super::error::ParseError;
use crate::scene::Material;
use std::collections::BTreeMap;
use toml::Spanned;

/// The tables `[KIND.NAME]` of one kind, by name.
pub(super) type Named<T> = BTreeMap<Spanned<String>, T>;

/// The materials, and the index of each by its name.
#[derive(Default)]
pub(super) struct MaterialList {
    pub(super) materials: Vec<Material>,
    pub(super) names: Vec<String>,
    index: BTreeMap<String, u32>,
}

impl MaterialList {
    /// Adds the materials of one kind. Two materials must not have the same name, even if they are of different kinds.
    pub(super) fn add<T: Into<Material>>(&mut self, tables: Named<T>) -> Result<(), ParseError> {
        for (name, table) in tables {
            let number = u32::try_from(self.materials.len()).unwrap_or(u32::MAX);
            if self.index.insert(name.get_ref().clone(), number).is_some() {
                let message = format!("there is another material called '{}'", name.get_ref());
                return Err(ParseError::at(&name, &message));
            }
            self.materials.push(table.into());
            self.names.push(name.get_ref().clone());
        }
        Ok(())
    }

    pub(super) fn find(&self, name: &Spanned<String>) -> Result<u32, ParseError> {
        self.index.get(name.get_ref()).copied().ok_or_else(|| {
            let known: Vec<&str> = self.index.keys().map(String::as_str).collect();
            let message = format!("no material '{}'; there are: {}", name.get_ref(), known.join(", "));
            ParseError::at(name, &message)
        })
    }
}
