//! The materials of a document or line, each once.

use super::stored::{Appearance, StoredMaterial};
use crate::scene::Material;

/// Materials under way. Few a file, so they are compared one by one.
#[derive(Clone, Debug, Default)]
pub(super) struct Materials<'a> {
    list: Vec<&'a Material>,
}

impl<'a> Materials<'a> {
    /// The index of a material, added if there is no equal one.
    pub(super) fn index(&mut self, material: &'a Material) -> usize {
        let known = self.list.iter().rposition(|known| *known == material);
        known.unwrap_or_else(|| {
            self.list.push(material);
            self.list.len() - 1
        })
    }

    /// What is written, nothing if there are none.
    pub(super) fn into_appearance(self) -> Option<Appearance<'a>> {
        let materials: Vec<_> = self.list.into_iter().map(StoredMaterial::from).collect();
        (!materials.is_empty()).then_some(Appearance {
            materials,
            default_theme: "default",
        })
    }
}
