//! The table `[view]`.

use super::error::{ParseError, named};
use super::quantity::{Quantities, Quantity};
use crate::scene::{EXPOSURES, Overlay, Tolerance, View};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ViewTable {
    exposure: Option<Spanned<Quantity>>,
    exposure_lock: Option<bool>,
    overlay: Option<Spanned<String>>,
    tolerance: Option<Spanned<Written>>,
}

/// A tolerance: a number of pixels, or a text with a unit.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a tolerance is a text like \"0.03 mm\", or a number of pixels")]
enum Written {
    Pixels(f32),
    Text(String),
}

/// How the picture is shown by default.
pub(super) fn view(table: Option<&Spanned<ViewTable>>) -> Result<View, ParseError> {
    let plain = View::default();
    let Some(table) = table.map(Spanned::get_ref) else {
        return Ok(plain);
    };
    let overlay = table.overlay.as_ref();
    // No key of this table is a length in scene units.
    let numbers = Quantities { metres_per_unit: 1.0 };
    Ok(View {
        exposure_stops: numbers
            .single("exposure", table.exposure.as_ref(), EXPOSURES)?
            .unwrap_or(plain.exposure_stops),
        exposure_lock: table.exposure_lock.unwrap_or(plain.exposure_lock),
        overlay: overlay.map(|name| named(&Overlay::NAMES, name, "overlay")).transpose()?,
        tolerance: table.tolerance.as_ref().map(tolerance).transpose()?.unwrap_or(plain.tolerance),
        ..plain
    })
}

fn tolerance(written: &Spanned<Written>) -> Result<Tolerance, ParseError> {
    let tolerance = match written.get_ref() {
        Written::Pixels(pixels) => Ok(Tolerance::Pixels(*pixels)),
        Written::Text(text) => text.parse(),
    };
    let tolerance = tolerance.map_err(|message: &str| ParseError::at(written, message))?;
    tolerance.check().map_err(|wrong| ParseError::at(written, &format!("tolerance {wrong}")))?;
    Ok(tolerance)
}
