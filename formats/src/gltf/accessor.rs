//! Numbers out of the bytes of a document.

use std::borrow::Cow;

use serde::Deserialize;

use super::document::{Document, element_of};
use crate::error::{Problem, quote};

/// Most elements of one accessor: they may have no bytes behind them, and take 24 bytes in memory.
const MAX_ELEMENTS: u64 = 4_000_000;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor<'a> {
    buffer_view: Option<u64>,
    #[serde(default)]
    byte_offset: u64,
    component_type: u64,
    #[serde(default)]
    normalized: bool,
    count: u64,
    #[serde(rename = "type", borrow)]
    kind: Cow<'a, str>,
    sparse: Option<Sparse>,
}

/// Elements that replace some of an accessor's.
#[derive(Deserialize)]
struct Sparse {
    count: u64,
    indices: SparseIndices,
    values: SparseValues,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct SparseIndices {
    buffer_view: u64,
    #[serde(default)]
    byte_offset: u64,
    component_type: u64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct SparseValues {
    buffer_view: u64,
    #[serde(default)]
    byte_offset: u64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: u64,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: Option<u64>,
}

/// Type of a number in a buffer.
#[derive(Clone, Copy)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: u64) -> Result<Self, Problem> {
        Ok(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => {
                return Err(Problem::Invalid {
                    what: "componentType".to_owned(),
                    found: code.to_string(),
                    expected: "5120 to 5123, 5125 or 5126",
                });
            }
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    fn read(self, bytes: &[u8]) -> f64 {
        match (self, bytes) {
            (Self::I8, &[a]) => f64::from(i8::from_le_bytes([a])),
            (Self::U8, &[a]) => f64::from(a),
            (Self::I16, &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
            (Self::U16, &[a, b]) => f64::from(u16::from_le_bytes([a, b])),
            (Self::U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (Self::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => f64::NAN,
        }
    }

    /// What an integer is divided by where it stands for a fraction.
    fn one(self) -> f64 {
        match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::U32 | Self::F32 => 1.0,
        }
    }
}

/// Where elements are in a view.
struct Run {
    view: u64,
    offset: u64,
    count: u64,
    component: Component,
}

impl Document<'_> {
    /// How many elements an accessor has; no more than can be held.
    pub(super) fn count(&self, accessor: u64) -> Result<usize, Problem> {
        let accessor: Accessor<'_> = self.element("accessor", &self.accessors, accessor)?;
        if accessor.count > MAX_ELEMENTS {
            return Err(Problem::Limit {
                what: "elements of one accessor",
                found: accessor.count,
                limit: MAX_ELEMENTS,
            });
        }
        Ok(accessor.count as usize)
    }

    /// The numbers of an accessor whose elements have `N` components.
    pub(super) fn vectors<const N: usize>(&self, index: u64) -> Result<Vec<[f64; N]>, Problem> {
        let count = self.count(index)?;
        let accessor: Accessor<'_> = self.element("accessor", &self.accessors, index)?;
        let expected = ["\"SCALAR\"", "\"VEC2\"", "\"VEC3\"", "\"VEC4\""];
        let expected = expected.get(N - 1).copied().unwrap_or_default();
        if quote(&accessor.kind) != expected {
            return Err(Problem::Invalid {
                what: format!("the type of accessor {index}"),
                found: quote(&accessor.kind),
                expected,
            });
        }
        let component = Component::of(accessor.component_type)?;
        let mut vectors = match accessor.buffer_view {
            None => vec![[0.0; N]; count],
            Some(view) => self.run(&Run {
                view,
                offset: accessor.byte_offset,
                count: accessor.count,
                component,
            })?,
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace(&mut vectors, sparse, component)?;
        }
        if accessor.normalized {
            let normal = |number: f64| (number / component.one()).max(-1.0);
            vectors = vectors.into_iter().map(|v| v.map(normal)).collect();
        }
        Ok(vectors)
    }

    fn replace<const N: usize>(
        &self,
        vectors: &mut [[f64; N]],
        sparse: &Sparse,
        component: Component,
    ) -> Result<(), Problem> {
        let count = vectors.len();
        if sparse.count > count as u64 {
            return Err(Problem::Invalid {
                what: "the count of sparse elements".to_owned(),
                found: sparse.count.to_string(),
                expected: "no more than the accessor has",
            });
        }
        let indices = self.run::<1>(&Run {
            view: sparse.indices.buffer_view,
            offset: sparse.indices.byte_offset,
            count: sparse.count,
            component: Component::of(sparse.indices.component_type)?,
        })?;
        let values = self.run::<N>(&Run {
            view: sparse.values.buffer_view,
            offset: sparse.values.byte_offset,
            count: sparse.count,
            component,
        })?;
        for ([index], value) in indices.into_iter().zip(values) {
            let place = vectors.get_mut(index as usize);
            *place.ok_or(Problem::IndexOutOfRange {
                what: "sparse element",
                index: index as u64,
                count,
            })? = value;
        }
        Ok(())
    }

    fn run<const N: usize>(&self, run: &Run) -> Result<Vec<[f64; N]>, Problem> {
        let view: View = self.element("buffer view", &self.views, run.view)?;
        let buffer = element_of("buffer", &self.buffers, view.buffer)?;
        let size = run.component.size();
        let (element, stride) = ((N * size) as u64, view.byte_stride);
        let stride = stride.unwrap_or(element);
        if stride < element {
            return Err(Problem::Invalid {
                what: format!("the byteStride of buffer view {}", run.view),
                found: stride.to_string(),
                expected: "at least the size of an element",
            });
        }
        let outside = || Problem::Invalid {
            what: format!(
                "the end of {} elements in buffer view {}",
                run.count, run.view
            ),
            found: "outside".to_owned(),
            expected: "inside the view, and that inside its buffer",
        };
        let bytes = slice(buffer, view.byte_offset, view.byte_length).ok_or_else(outside)?;
        let Some(last) = run.count.checked_sub(1) else {
            return Ok(Vec::new());
        };
        let length = last
            .checked_mul(stride)
            .and_then(|l| l.checked_add(element));
        let bytes = length.and_then(|length| slice(bytes, run.offset, length));
        let elements = bytes.ok_or_else(outside)?.chunks(stride as usize);
        let vector = |element: &[u8]| {
            let mut components = element.chunks(size).map(|bytes| run.component.read(bytes));
            std::array::from_fn(|_| components.next().unwrap_or(f64::NAN))
        };
        Ok(elements.map(vector).collect())
    }
}

fn slice(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    bytes.get(start..end)
}
