//! The Khronos validation layer, with synchronization checks, and what it says.

use ash::vk;
use std::ffi::{CStr, c_void};
use std::sync::{Mutex, PoisonError};

pub(super) const LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Hazards between the commands of one command buffer, on top of the layer's usual checks.
pub(super) const FEATURES: [vk::ValidationFeatureEnableEXT; 1] =
    [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];

/// The warnings and errors of the validation layer, as they came.
#[derive(Debug, Default)]
pub(super) struct Messages(Mutex<Vec<String>>);

impl Messages {
    pub(super) fn list(&self) -> Vec<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The messenger that fills `self`, which must outlive it and not move.
    pub(super) fn messenger(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
        use vk::{DebugUtilsMessageSeverityFlagsEXT as Severity, DebugUtilsMessageTypeFlagsEXT as Kind};
        vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(Severity::WARNING | Severity::ERROR)
            // GENERAL messages are the loader's, about other drivers and layers on the system;
            // PERFORMANCE ones advise against the layout GENERAL, which storage images keep here.
            .message_type(Kind::VALIDATION)
            .pfn_user_callback(Some(receive))
            .user_data(std::ptr::from_ref(self).cast_mut().cast())
    }
}

unsafe extern "system" fn receive(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    messages: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: user_data is the `Messages` that `messenger` was called on, which outlives the
    // messenger; the layer gives valid data with a NUL-terminated message or none.
    let (messages, text) = unsafe {
        let text = data
            .as_ref()
            .filter(|data| !data.p_message.is_null())
            .map_or_else(String::new, |data| CStr::from_ptr(data.p_message).to_string_lossy().into_owned());
        (&*messages.cast::<Messages>(), text)
    };
    eprintln!("validation: {text}");
    messages.0.lock().unwrap_or_else(PoisonError::into_inner).push(text);
    vk::FALSE
}
