//! How much one file may hold, so that no input takes memory or time out of proportion.

use super::json::check_count;
use crate::error::Problem;

/// The most of everything that is read.
#[derive(Clone, Debug)]
pub(super) struct Limits {
    /// Bytes of a document, which is read whole.
    pub(super) document_bytes: u64,
    /// Bytes of one line of a sequence.
    pub(super) line_bytes: u64,
    /// City objects in a file: 16 bytes of each are kept to find a second one of the same name.
    pub(super) objects: u64,
    /// Vertices in the list of one document or line, 24 bytes each.
    pub(super) vertices: u64,
    /// Vertices and rings of all surfaces of one feature, up to 50 bytes each; of all templates too.
    pub(super) feature_vertices: u64,
    /// Geometries of one feature: each may carry a long name.
    pub(super) feature_geometries: u64,
    /// Bytes of all attributes of one feature: as values in memory they take up to 40 times as much.
    pub(super) feature_attribute_bytes: u64,
    /// Vertices and rings of the templates placed in one feature: whoever uses it expands them.
    pub(super) feature_instance_vertices: u64,
    /// The same of a whole file. A template of a megabyte costs 60 bytes to place, so this one
    /// bounds the time that users of the features need.
    pub(super) instance_vertices: u64,
}

impl Limits {
    /// What the reader takes: some hundred times what the largest features that are published need.
    pub(super) const STANDARD: Self = Self {
        document_bytes: 2 << 30,
        line_bytes: 128 << 20,
        objects: 10_000_000,
        vertices: 32_000_000,
        feature_vertices: 4_000_000,
        feature_geometries: 100_000,
        feature_attribute_bytes: 4 << 20,
        feature_instance_vertices: 10_000_000,
        instance_vertices: 1_000_000_000,
    };
}

/// What has been used up of the limits.
#[derive(Debug)]
pub(super) struct Budget<'l> {
    pub(super) limits: &'l Limits,
    objects: u64,
    instance_vertices: u64,
    feature: FeatureBudget,
}

/// What the feature that is read at the moment has used up.
#[derive(Debug, Default)]
struct FeatureBudget {
    vertices: u64,
    geometries: u64,
    attribute_bytes: u64,
    instance_vertices: u64,
}

impl<'l> Budget<'l> {
    /// A fresh budget for a file.
    pub(super) fn new(limits: &'l Limits) -> Self {
        Self {
            limits,
            objects: 0,
            instance_vertices: 0,
            feature: FeatureBudget::default(),
        }
    }

    /// Begins another feature, or the list of templates.
    pub(super) fn start_feature(&mut self) {
        self.feature = FeatureBudget::default();
    }

    /// About how many bytes the feature takes in memory, instances apart.
    pub(super) fn feature_bytes(&self) -> usize {
        let used = &self.feature;
        let bytes = 48 * used.vertices + 200 * used.geometries + 10 * used.attribute_bytes;
        500 + bytes as usize
    }

    /// About how many bytes its instances take once they are expanded.
    pub(super) fn placed_bytes(&self) -> usize {
        48 * self.feature.instance_vertices as usize
    }

    pub(super) fn objects(&mut self, count: usize) -> Result<(), Problem> {
        spend("objects", &mut self.objects, count, self.limits.objects)
    }

    pub(super) fn feature_vertices(&mut self, count: usize) -> Result<(), Problem> {
        let limit = self.limits.feature_vertices;
        let what = "vertices and rings of one feature";
        spend(what, &mut self.feature.vertices, count, limit)
    }

    pub(super) fn feature_geometry(&mut self) -> Result<(), Problem> {
        let limit = self.limits.feature_geometries;
        let what = "geometries of one feature";
        spend(what, &mut self.feature.geometries, 1, limit)
    }

    pub(super) fn feature_attributes(&mut self, bytes: usize) -> Result<(), Problem> {
        let limit = self.limits.feature_attribute_bytes;
        let what = "bytes of attributes of one feature";
        spend(what, &mut self.feature.attribute_bytes, bytes, limit)
    }

    pub(super) fn instance_vertices(&mut self, count: usize) -> Result<(), Problem> {
        let used = &mut self.feature.instance_vertices;
        let what = "vertices and rings of template instances in one feature";
        spend(what, used, count, self.limits.feature_instance_vertices)?;
        let limit = self.limits.instance_vertices;
        let what = "vertices and rings of template instances";
        spend(what, &mut self.instance_vertices, count, limit)
    }
}

/// Adds to what is used, if the sum stays within the limit.
fn spend(what: &'static str, used: &mut u64, count: usize, limit: u64) -> Result<(), Problem> {
    let found = used.saturating_add(count as u64);
    check_count(what, found, limit)?;
    *used = found;
    Ok(())
}
