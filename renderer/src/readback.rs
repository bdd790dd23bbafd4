//! The way of pixels back from the device.

use crate::device::Renderer;
use crate::error::{Error, Result};
use crate::target::Target;

/// A buffer that pixels come back through. Rows are padded to what the hardware copies.
pub(crate) struct Readback {
    buffer: wgpu::Buffer,
    size: [u32; 2],
    row_bytes: u32,
    padded_row_bytes: u32,
}

impl Readback {
    /// For pictures of `[width, height]` pixels of `pixel_bytes` each.
    pub(crate) fn new(renderer: &Renderer, size: [u32; 2], pixel_bytes: u32) -> Self {
        let row_bytes = size[0] * pixel_bytes;
        let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = renderer.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(padded_row_bytes) * u64::from(size[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self {
            buffer,
            size,
            row_bytes,
            padded_row_bytes,
        }
    }

    /// Submits `encoder` with a copy of `target` at its end.
    pub(crate) fn submit(
        &self,
        renderer: &Renderer,
        mut encoder: wgpu::CommandEncoder,
        target: &Target,
    ) -> wgpu::SubmissionIndex {
        let [width, height] = self.size;
        encoder.copy_texture_to_buffer(
            target.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.padded_row_bytes),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
        );
        let submission = renderer.queue.submit([encoder.finish()]);
        // A failure shows when the rows are asked for.
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        submission
    }

    /// Waits for `submission` and hands over its rows from the top, without padding.
    pub(crate) fn rows(
        &self,
        renderer: &Renderer,
        submission: wgpu::SubmissionIndex,
        mut row: impl FnMut(u32, &[u8]),
    ) -> Result<()> {
        renderer.wait(Some(submission))?;
        {
            let mapped = self.buffer.get_mapped_range(..);
            let bytes = mapped.map_err(|error| Error::Gpu(error.to_string()))?;
            let rows = bytes.chunks_exact(self.padded_row_bytes as usize);
            for (y, padded) in rows.enumerate() {
                row(y as u32, &padded[..self.row_bytes as usize]);
            }
        }
        self.buffer.unmap();
        Ok(())
    }
}
