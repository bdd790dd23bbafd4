//! The graphics device: chosen once, opened once.

use crate::error::{Error, Result};
use std::sync::{Arc, Mutex};

/// An open graphics device. Opening takes a fraction of a second, so keep it.
pub struct Renderer {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    failure: Arc<Mutex<Option<String>>>,
}

impl Renderer {
    /// Opens the best adapter: a real GPU where there is one, else a software renderer (lavapipe).
    ///
    /// # Errors
    /// [`Error::NoAdapter`] when the machine has none, [`Error::Device`] when none can be opened.
    pub fn new() -> Result<Self> {
        let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
        description.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(description);
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        adapters.sort_by_key(|adapter| rank(adapter.get_info().device_type));
        let mut refusals = Vec::new();
        for adapter in &adapters {
            match open(adapter) {
                Ok(renderer) => return Ok(renderer),
                Err(refusal) => refusals.push(format!("{}: {refusal}", adapter.get_info().name)),
            }
        }
        match refusals.is_empty() {
            true => Err(Error::NoAdapter),
            false => Err(Error::Device(refusals.join("; "))),
        }
    }

    /// Name and kind of the adapter that draws, for reports: which hardware the proof ran on.
    #[must_use]
    pub fn adapter_name(&self) -> String {
        let wgpu::AdapterInfo {
            name,
            device_type,
            backend,
            driver_info,
            ..
        } = &self.info;
        let kind = match device_type {
            wgpu::DeviceType::Cpu => "software",
            _ => "GPU",
        };
        let driver = match driver_info.as_str() {
            "" => String::new(),
            version => format!(", {version}"),
        };
        format!("{name} ({kind}, {backend}{driver})")
    }

    /// The longest side of a picture that the adapter draws, in pixels.
    #[must_use]
    pub fn max_resolution(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// Refuses sides that the adapter cannot draw.
    pub(crate) fn check_resolution(&self, asked: u32) -> Result<()> {
        let limit = self.max_resolution();
        match (1..=limit).contains(&asked) {
            true => Ok(()),
            false => Err(Error::Resolution { asked, limit }),
        }
    }

    /// Waits until `submission` is done and its buffers are mapped.
    pub(crate) fn wait(&self, submission: Option<wgpu::SubmissionIndex>) -> Result<()> {
        let wait = wgpu::PollType::Wait {
            submission_index: submission,
            timeout: None,
        };
        self.device
            .poll(wait)
            .map_err(|error| Error::Gpu(error.to_string()))?;
        self.check_failure()
    }

    /// Passes on what the driver reported since the last call.
    pub(crate) fn check_failure(&self) -> Result<()> {
        let mut failure = self
            .failure
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner());
        failure
            .take()
            .map_or(Ok(()), |message| Err(Error::Gpu(message)))
    }
}

/// Order of preference, lowest first.
fn rank(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

/// Opens one adapter with all that it can do, and catches its errors (wgpu would panic on them).
fn open(adapter: &wgpu::Adapter) -> std::result::Result<Renderer, wgpu::RequestDeviceError> {
    let request = adapter.request_device(&wgpu::DeviceDescriptor {
        label: Some("renderer"),
        required_limits: adapter.limits(),
        ..Default::default()
    });
    let (device, queue) = pollster::block_on(request)?;
    let failure = Arc::new(Mutex::new(None));
    let reported = Arc::clone(&failure);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        let mut first = reported
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner());
        first.get_or_insert_with(|| error.to_string());
    }));
    Ok(Renderer {
        device,
        queue,
        info: adapter.get_info(),
        failure,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opens_and_names_its_adapter() {
        let renderer = Renderer::new().unwrap();
        assert!(
            renderer.adapter_name().contains('('),
            "{}",
            renderer.adapter_name()
        );
        assert!(renderer.max_resolution() >= 4096);
    }

    #[test]
    fn prefers_hardware() {
        assert!(rank(wgpu::DeviceType::DiscreteGpu) < rank(wgpu::DeviceType::Cpu));
        assert!(rank(wgpu::DeviceType::VirtualGpu) < rank(wgpu::DeviceType::Cpu));
    }

    #[test]
    fn missing_adapter_names_the_package() {
        assert!(Error::NoAdapter.to_string().contains("mesa-vulkan-drivers"));
    }

    #[test]
    fn driver_errors_are_returned() {
        let renderer = Renderer::new().unwrap();
        let limit = renderer.device.limits().max_buffer_size;
        let _too_large = renderer.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: limit.saturating_add(4),
            usage: wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        assert!(matches!(renderer.check_failure(), Err(Error::Gpu(_))));
        assert!(renderer.check_failure().is_ok());
    }
}
