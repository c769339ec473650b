//! The loader, the instance, and the validation messenger.

use super::validation::{FEATURES, LAYER, Messages, settings, watches};
use super::{check, loader_changes};
use crate::error::{Error, Result};
use ash::{ext, khr, vk};
use std::ffi::{CStr, CString};
use std::sync::Arc;
use winit::raw_window_handle::RawDisplayHandle;

/// A Vulkan 1.3 instance.
pub struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) entry: ash::Entry,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    pub(super) debug_utils: bool,
    watches_synchronization: bool,
    messages: Box<Messages>,
}

impl Instance {
    /// Loads Vulkan. With a display, surfaces of its windows can be made. With `validation`, the Khronos validation layer
    /// is on, with synchronization checks where it has them.
    ///
    /// # Errors
    /// [`Error::NoLoader`], [`Error::NoValidationLayer`], [`Error::NoDevice`], or [`Error::Window`] where no
    /// driver draws to such a display.
    pub fn new(validation: bool, display: Option<RawDisplayHandle>) -> Result<Arc<Self>> {
        // SAFETY: loading the system's Vulkan loader, whose initializers are trusted.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| Error::NoLoader(error.to_string()))?;
        let mut offered = extensions(&entry, None)?;
        let mut layers = Vec::new();
        let mut watch = Vec::new();
        if validation {
            if !has_layer(&entry)? {
                return Err(Error::NoValidationLayer);
            }
            layers.push(LAYER.as_ptr());
            let of_layer = extensions(&entry, Some(LAYER))?;
            if !of_layer.iter().any(|name| name.as_c_str() == ext::debug_utils::NAME) {
                return Err(Error::NoValidationLayer);
            }
            watch = watches(&of_layer);
            if watch.is_empty() {
                log::warn!(
                    "the validation layer installed here cannot watch synchronization, so a missing barrier goes \
                     unseen; a newer package vulkan-validationlayers can"
                );
            }
            offered.extend(of_layer);
        }
        let has = |name: &CStr| offered.iter().any(|extension| extension.as_c_str() == name);

        let of_surface = display.map_or(Ok(&[][..]), ash_window::enumerate_required_extensions);
        let of_surface: Vec<&CStr> = check("finding the window system's extensions", of_surface)?
            .iter()
            // SAFETY: ash gives the names as static strings that end in NUL.
            .map(|name| unsafe { CStr::from_ptr(*name) })
            .collect();
        // The loader brings one, the layer another; debuggers such as RenderDoc want the objects' names too.
        let optional = [khr::portability_enumeration::NAME, ext::debug_utils::NAME];
        let (mut wanted, mut missing) = (Vec::new(), Vec::new());
        for name in &of_surface {
            if has(name) { wanted.push(name.as_ptr()) } else { missing.push(name.to_string_lossy()) }
        }
        wanted.extend(optional.iter().filter(|name| has(name)).map(|name| name.as_ptr()));
        wanted.extend(watch.iter().map(|name| name.as_ptr()));
        let flags = if has(khr::portability_enumeration::NAME) {
            // Without it, MoltenVK stays hidden.
            vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR
        } else {
            vk::InstanceCreateFlags::empty()
        };
        let debug_utils = has(ext::debug_utils::NAME);

        let messages = Box::<Messages>::default();
        let application =
            vk::ApplicationInfo::default().application_name(c"thinlens").api_version(vk::API_VERSION_1_3);
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&FEATURES);
        let settings = settings();
        let mut settings = vk::LayerSettingsCreateInfoEXT::default().settings(&settings);
        let mut messenger = messages.messenger();
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_extension_names(&wanted)
            .enabled_layer_names(&layers)
            .flags(flags);
        if watch.contains(&ext::layer_settings::NAME) {
            info = info.push_next(&mut settings);
        }
        if watch.contains(&ext::validation_features::NAME) {
            info = info.push_next(&mut features);
        }
        if validation {
            info = info.push_next(&mut messenger);
        }
        // SAFETY: info and what it points to live through the call.
        let created = unsafe {
            let _lists = loader_changes();
            entry.create_instance(&info, None)
        };
        let raw = match created {
            Err(vk::Result::ERROR_INCOMPATIBLE_DRIVER) => {
                return Err(Error::NoDevice("no driver is installed".into()));
            }
            other => check("creating an instance", other)?,
        };
        let mut instance = Self {
            raw,
            entry,
            messenger: None,
            debug_utils,
            watches_synchronization: !watch.is_empty(),
            messages,
        };
        // Tested only now, for a system without any driver has an error of its own.
        if !missing.is_empty() {
            return Err(Error::Window(format!(
                "no Vulkan driver here can draw to such a window ({} is missing)",
                missing.join(", ")
            )));
        }
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

    /// Whether the validation layer is on and reports missing barriers.
    pub fn watches_synchronization(&self) -> bool {
        self.watches_synchronization
    }

    /// The validation layer's warnings and errors so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.messages.list()
    }

    /// Fails if the validation layer had anything to say. It may speak until the device is dropped, so ask after that.
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
            let _lists = loader_changes();
            if let Some((debug, messenger)) = &self.messenger {
                debug.destroy_debug_utils_messenger(*messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

/// The extensions that the loader and the drivers offer, or those that a layer offers.
fn extensions(entry: &ash::Entry, layer: Option<&CStr>) -> Result<Vec<CString>> {
    // SAFETY: a query without preconditions.
    let properties = unsafe { entry.enumerate_instance_extension_properties(layer) };
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
