//! The table `[view]`.

use super::fault::{Fault, named};
use crate::scene::{Overlay, View};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ViewTable {
    exposure: Option<f32>,
    exposure_lock: Option<bool>,
    overlay: Option<Spanned<String>>,
    tolerance: Option<f32>,
}

/// How the picture is shown at first.
pub(super) fn view(table: Option<&Spanned<ViewTable>>) -> Result<View, Fault> {
    let plain = View::default();
    let Some(table) = table.map(Spanned::get_ref) else {
        return Ok(plain);
    };
    let overlay = table.overlay.as_ref();
    Ok(View {
        exposure_stops: table.exposure.unwrap_or(plain.exposure_stops),
        exposure_lock: table.exposure_lock.unwrap_or(plain.exposure_lock),
        overlay: overlay.map(|name| named(&Overlay::NAMES, name, "overlay")).transpose()?,
        tolerance: table.tolerance.unwrap_or(plain.tolerance),
        ..plain
    })
}
