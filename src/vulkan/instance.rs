//! The loader, the instance, and the validation messenger.

use super::check;
use super::validation::{FEATURES, LAYER, Messages};
use crate::error::{Error, Result};
use ash::{ext, khr, vk};
use std::ffi::{CStr, c_char};
use std::sync::Arc;
use winit::raw_window_handle::RawDisplayHandle;

/// A Vulkan 1.3 instance.
pub struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) entry: ash::Entry,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    pub(super) debug_utils: bool,
    messages: Box<Messages>,
}

impl Instance {
    /// Loads Vulkan. With a display, its surfaces can be made; with `validation`, the Khronos layer
    /// is on, with synchronization checks.
    ///
    /// # Errors
    /// [`Error::NoLoader`], [`Error::NoValidationLayer`], or what Vulkan says.
    pub fn new(validation: bool, display: Option<RawDisplayHandle>) -> Result<Arc<Self>> {
        // SAFETY: loading the system's Vulkan loader, whose initializers are trusted.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| Error::NoLoader(error.to_string()))?;
        let available = extensions(&entry)?;
        let has = |name: &CStr| available.iter().any(|extension| extension == name);

        let mut wanted: Vec<*const c_char> = Vec::new();
        if let Some(display) = display {
            let surface = check(
                "finding the window system's extensions",
                ash_window::enumerate_required_extensions(display),
            )?;
            wanted.extend_from_slice(surface);
        }
        let mut flags = vk::InstanceCreateFlags::empty();
        if has(khr::portability_enumeration::NAME) {
            // Without it, MoltenVK stays hidden.
            wanted.push(khr::portability_enumeration::NAME.as_ptr());
            flags |= vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR;
        }
        let mut layers = Vec::new();
        if validation {
            if !has_layer(&entry)? {
                return Err(Error::NoValidationLayer);
            }
            layers.push(LAYER.as_ptr());
            wanted.push(ext::validation_features::NAME.as_ptr());
        }
        // The layer brings its own; debuggers such as RenderDoc want the names too.
        let debug_utils = validation || has(ext::debug_utils::NAME);
        if debug_utils {
            wanted.push(ext::debug_utils::NAME.as_ptr());
        }

        let messages = Box::<Messages>::default();
        let application =
            vk::ApplicationInfo::default().application_name(c"thinlens").api_version(vk::API_VERSION_1_3);
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&FEATURES);
        let mut messenger = messages.messenger();
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_extension_names(&wanted)
            .enabled_layer_names(&layers)
            .flags(flags);
        if validation {
            info = info.push_next(&mut features).push_next(&mut messenger);
        }
        // SAFETY: info and what it points to live through the call.
        let raw = match unsafe { entry.create_instance(&info, None) } {
            Err(vk::Result::ERROR_INCOMPATIBLE_DRIVER) => {
                return Err(Error::NoDevice("no driver is installed".into()));
            }
            other => check("creating an instance", other)?,
        };
        let mut instance = Self { raw, entry, messenger: None, debug_utils, messages };
        if validation {
            let debug = ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
            // SAFETY: the messages it points to are boxed and dropped after it, in Drop.
            let messenger =
                unsafe { debug.create_debug_utils_messenger(&instance.messages.messenger(), None) };
            let messenger = check("creating the validation messenger", messenger)?;
            instance.messenger = Some((debug, messenger));
        }
        Ok(Arc::new(instance))
    }

    /// The validation layer's warnings and errors so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.messages.list()
    }

    /// Whether the layer kept silent. It speaks until the device is gone, so that is when to ask.
    ///
    /// # Errors
    /// [`Error::Validation`].
    pub fn check_validation(&self) -> Result<()> {
        match self.validation_messages().len() {
            0 => Ok(()),
            count => Err(Error::Validation(count)),
        }
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: every child holds an Arc of this instance, so none is left; the messenger goes
        // before the instance it came from.
        unsafe {
            if let Some((debug, messenger)) = &self.messenger {
                debug.destroy_debug_utils_messenger(*messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

fn extensions(entry: &ash::Entry) -> Result<Vec<std::ffi::CString>> {
    // SAFETY: a query without preconditions.
    let properties = unsafe { entry.enumerate_instance_extension_properties(None) };
    let properties = check("listing instance extensions", properties)?;
    Ok(properties
        .iter()
        .filter_map(|extension| extension.extension_name_as_c_str().ok().map(CStr::to_owned))
        .collect())
}

fn has_layer(entry: &ash::Entry) -> Result<bool> {
    // SAFETY: a query without preconditions.
    let layers = unsafe { entry.enumerate_instance_layer_properties() };
    let layers = check("listing layers", layers)?;
    Ok(layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(LAYER)))
}
