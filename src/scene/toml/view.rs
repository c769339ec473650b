//! The table `[view]`.

use super::error::{ParseError, named};
use super::number::ranged;
use crate::scene::{EXPOSURES, Overlay, TOLERANCES, View};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ViewTable {
    exposure: Option<Spanned<f32>>,
    exposure_lock: Option<bool>,
    overlay: Option<Spanned<String>>,
    tolerance: Option<Spanned<f32>>,
}

/// How the picture is shown by default.
pub(super) fn view(table: Option<&Spanned<ViewTable>>) -> Result<View, ParseError> {
    let plain = View::default();
    let Some(table) = table.map(Spanned::get_ref) else {
        return Ok(plain);
    };
    let overlay = table.overlay.as_ref();
    Ok(View {
        exposure_stops: ranged("exposure", table.exposure.as_ref(), EXPOSURES)?
            .unwrap_or(plain.exposure_stops),
        exposure_lock: table.exposure_lock.unwrap_or(plain.exposure_lock),
        overlay: overlay.map(|name| named(&Overlay::NAMES, name, "overlay")).transpose()?,
        tolerance: ranged("tolerance", table.tolerance.as_ref(), TOLERANCES)?.unwrap_or(plain.tolerance),
        ..plain
    })
}
