//! The storage form of a model: small, exact to the last bit, and safe to read whatever it holds.
//!
//! Each distinct position is kept once, as whole millimetres from the one before and the few last
//! bits that these leave open; surfaces refer to positions by number. All columns of a kind stand
//! together and are compressed.

mod container;
mod coordinates;
mod memory;
mod model;
mod shape;

use crate::error::Problem;
use crate::scene::{Geometry, Part, Shape};
use model::StoredModel;
use shape::StoredShape;

/// A shape on its own, as it is stored once for all its instances.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PackedShape {
    /// The shape, to be read by [`unpack_shape`].
    pub content: Vec<u8>,
    /// The same for equal shapes and for no others, whatever version of the compressor is used.
    pub digest: [u8; 16],
}

/// Packs the geometries and parts of a model. Geometries that share a shape still do when they are
/// unpacked.
///
/// # Errors
/// [`Problem::Limit`] for a model that [`unpack`] would refuse for its size.
pub fn pack(geometries: &[Geometry], parts: &[Part]) -> Result<Vec<u8>, Problem> {
    let stored = StoredModel::of(geometries, parts)?;
    container::seal(&container::payload(&stored)?)
}

/// Unpacks a model, bit for bit as it was packed.
///
/// # Errors
/// [`Problem`] for content that was not written by [`pack`].
pub fn unpack(content: &[u8]) -> Result<(Vec<Part>, Vec<Geometry>), Problem> {
    container::open::<StoredModel>(content)?.into_model()
}

/// Packs a shape on its own.
///
/// # Errors
/// [`Problem::Limit`] for a shape that [`unpack_shape`] would refuse for its size.
pub fn pack_shape(shape: &Shape) -> Result<PackedShape, Problem> {
    let payload = container::payload(&StoredShape::of(shape, &mut memory::Memory::default())?)?;
    Ok(PackedShape {
        digest: container::digest(&payload),
        content: container::seal(&payload)?,
    })
}

/// Unpacks a shape, bit for bit as it was packed.
///
/// # Errors
/// [`Problem`] for content that was not written by [`pack_shape`].
pub fn unpack_shape(content: &[u8]) -> Result<Shape, Problem> {
    container::open::<StoredShape>(content)?.into_shape(&mut memory::Memory::default())
}
