//! The Khronos validation layer: asking for synchronization checks, and collecting its messages.

use ash::{ext, vk};
use std::borrow::Cow;
use std::ffi::{CStr, CString, c_char, c_void};
use std::sync::{Mutex, PoisonError};

pub(super) const LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// The layer's extensions by which it is asked to watch synchronization: hazards between commands, on top of its usual
/// checks. A layer has the one, the other, or both. Where it has both, both are used, for an older layer may not know
/// all settings of the first.
const WATCHES: [&CStr; 2] = [ext::layer_settings::NAME, ext::validation_features::NAME];

/// Those of [`WATCHES`] that a layer has. A layer that has none cannot watch synchronization.
pub(super) fn watches(extensions: &[CString]) -> Vec<&'static CStr> {
    WATCHES.into_iter().filter(|name| extensions.iter().any(|offered| offered.as_c_str() == *name)).collect()
}

/// What is asked for by `VK_EXT_validation_features`.
pub(super) const FEATURES: [vk::ValidationFeatureEnableEXT; 1] =
    [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];

/// What is asked for by `VK_EXT_layer_settings`. Layers from 1.3.290 on watch what shaders access through descriptors only
/// if a setting of its own is on: without it, no hazard between two dispatches is seen.
const SETTINGS: [&CStr; 3] =
    [c"validate_sync", c"syncval_shader_accesses_heuristic", c"syncval_submit_time_validation"];

/// The [`SETTINGS`], each switched on.
pub(super) fn settings() -> [vk::LayerSettingEXT<'static>; SETTINGS.len()] {
    const ON: &vk::Bool32 = &vk::TRUE;
    SETTINGS.map(|name| vk::LayerSettingEXT {
        p_layer_name: LAYER.as_ptr(),
        p_setting_name: name.as_ptr(),
        ty: vk::LayerSettingTypeEXT::BOOL32,
        // The setter of ash counts bytes here, but Vulkan counts values.
        value_count: 1,
        p_values: std::ptr::from_ref(ON).cast(),
        ..Default::default()
    })
}

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
    // messenger; the layer gives valid data, its strings NUL-terminated or none.
    let (messages, text) = unsafe {
        let string = |start: *const c_char| match start.is_null() {
            true => Cow::default(),
            false => CStr::from_ptr(start).to_string_lossy(),
        };
        let text =
            data.as_ref().map(|data| text_of(&string(data.p_message_id_name), &string(data.p_message)));
        (&*messages.cast::<Messages>(), text.unwrap_or_default())
    };
    eprintln!("validation: {text}");
    messages.0.lock().unwrap_or_else(PoisonError::into_inner).push(text);
    vk::FALSE
}

/// A message with its id, which names the rule that was broken. Older layers write the id into the message themselves.
fn text_of(id: &str, message: &str) -> String {
    if message.contains(id) { message.to_owned() } else { format!("{id}: {message}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches a layer that is asked in a way that it does not offer, which fails the instance, and one that is
    /// said to watch synchronization but was never asked to.
    #[test]
    fn a_layer_is_asked_in_the_ways_that_it_offers() {
        let asked =
            |names: &[&CStr]| watches(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
        let (settings, features) = (ext::layer_settings::NAME, ext::validation_features::NAME);
        assert!(asked(&[ext::debug_utils::NAME]).is_empty());
        assert_eq!(asked(&[ext::debug_utils::NAME, features]), [features]);
        assert_eq!(asked(&[features, settings]), [settings, features]);
        assert_eq!(asked(&[settings]), [settings]);
    }

    /// Catches a message that does not say which rule was broken, or says it twice.
    #[test]
    fn a_message_has_its_id_once() {
        let id = "VUID-vkCmdDispatch-None-08600";
        let newer = "vkCmdDispatch(): the set was never bound.";
        assert_eq!(
            text_of(id, newer),
            "VUID-vkCmdDispatch-None-08600: vkCmdDispatch(): the set was never bound."
        );
        let older = format!("Validation Error: [ {id} ] Object 0 | {newer}");
        assert_eq!(text_of(id, &older), older);
        assert_eq!(text_of("", newer), newer);
    }
}
