//! Headless renderer: what can be seen from an eye, as an item buffer of feature ids (a cube map
//! that proves that nothing visible was left out of an answer), and the pictures that people look
//! at, in plan and in perspective. It draws with wgpu on whatever adapter there is, in software
//! (Mesa lavapipe) where there is no GPU. It depends on no other crate of the workspace: what
//! verifies an answer must share no geometry with what computes it.

#![forbid(unsafe_code)]

mod cube_map;
mod device;
mod error;
mod item_buffer;
mod picture;
mod pyramid;
mod readback;
mod scene_mesh;
mod target;

pub use cube_map::{CubeMap, Face, Seen, Sighting, pixel_direction};
pub use device::Renderer;
pub use error::Error;
pub use item_buffer::ItemBuffer;
pub use picture::{
    Area, Image, Observer, PictureCell, PictureColumn, PictureFeature, PictureScene, PlanView,
    Sight, Status, View, heat_map, plan, sight_map,
};
pub use scene_mesh::SceneMesh;
