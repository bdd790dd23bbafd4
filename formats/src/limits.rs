//! How much a file may hold, whatever its format, so that no file can take memory out of proportion to its size.

use crate::error::Problem;

/// Most bytes of an object's identifier or class: each geometry carries a copy.
pub(crate) const MAX_NAME_BYTES: usize = 1024;

/// Most bytes of one object's attributes: as values in memory they take up to 40 times as much.
pub(crate) const MAX_ATTRIBUTE_BYTES: usize = 1 << 20;

/// Largest coordinate in metres, either sign. Projected systems stay below 10^8; beyond this, areas
/// and volumes would overflow what the rest of the program can trust.
pub(crate) const MAX_COORDINATE: f64 = 1e9;

/// Deepest nesting of arrays and objects. The geometry of a solid takes 12 levels; serde_json, and
/// what reads the sources later, stops at 128.
pub(crate) const MAX_NESTING: u64 = 100;

/// Highest level of detail. The format defines 0 to 3.3, older files have 4.
pub(crate) const MAX_LEVEL_OF_DETAIL: f64 = 10.0;

/// The most of everything that is read from one file.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    /// Bytes of input.
    pub(crate) input_bytes: u64,
    /// City objects.
    pub(crate) objects: u64,
    /// Vertices of all lists together.
    pub(crate) vertices: u64,
    /// Surfaces given out.
    pub(crate) surfaces: u64,
    /// Vertices and rings given out by instances of templates. A template of a megabyte costs 60
    /// bytes to repeat, so this one holds memory below 1 GB whatever the input.
    pub(crate) instance_vertices: u64,
}

impl Limits {
    /// What readers take: some hundred times a dense square kilometre at four
    /// levels of detail.
    pub(crate) const STANDARD: Self = Self {
        input_bytes: 2 << 30,
        objects: 10_000_000,
        vertices: 100_000_000,
        surfaces: 50_000_000,
        instance_vertices: 10_000_000,
    };
}

/// What has been used up of the limits.
#[derive(Debug)]
pub(crate) struct Budget {
    limits: Limits,
    input_bytes: u64,
    objects: u64,
    vertices: u64,
    surfaces: u64,
    instance_vertices: u64,
}

impl Budget {
    /// A fresh budget for an input of this size.
    pub(crate) fn new(limits: &Limits, input_bytes: usize) -> Result<Self, Problem> {
        let mut budget = Self {
            limits: limits.clone(),
            input_bytes: 0,
            objects: 0,
            vertices: 0,
            surfaces: 0,
            instance_vertices: 0,
        };
        spend(
            "bytes of input",
            &mut budget.input_bytes,
            input_bytes,
            limits.input_bytes,
        )?;
        Ok(budget)
    }

    pub(crate) fn objects(&mut self, count: usize) -> Result<(), Problem> {
        spend("objects", &mut self.objects, count, self.limits.objects)
    }

    pub(crate) fn vertices(&mut self, count: usize) -> Result<(), Problem> {
        spend("vertices", &mut self.vertices, count, self.limits.vertices)
    }

    pub(crate) fn surfaces(&mut self, count: usize) -> Result<(), Problem> {
        spend("surfaces", &mut self.surfaces, count, self.limits.surfaces)
    }

    pub(crate) fn instance_vertices(&mut self, count: usize) -> Result<(), Problem> {
        let limit = self.limits.instance_vertices;
        spend(
            "vertices and rings of template instances",
            &mut self.instance_vertices,
            count,
            limit,
        )
    }
}

/// Adds to what is used, if the sum stays within the limit.
fn spend(what: &'static str, used: &mut u64, count: usize, limit: u64) -> Result<(), Problem> {
    let found = used.saturating_add(count as u64);
    if found > limit {
        return Err(Problem::Limit { what, found, limit });
    }
    *used = found;
    Ok(())
}
