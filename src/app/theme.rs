//! How the viewer looks: its letters, spaces, roundings and colours. Nothing else in `app` spells out any of them.
//!
//! Everything around the picture is a neutral grey, because a tint beside a picture changes how its colours are judged.
//! There is one accent colour, for what is on, held or pointed at.

use imgui::{FontAtlas, FontConfig, FontSource, Style, StyleColor, StyleVar, Ui};

/// Red, green and blue in sRGB, and the opacity.
pub(super) type Color = [f32; 4];

const fn grey(level: f32) -> Color {
    [level, level, level, 1.0]
}

/// The same colour with another opacity.
pub(super) const fn faded([red, green, blue, _]: Color, opacity: f32) -> Color {
    [red, green, blue, opacity]
}

const NOTHING: Color = [0.0; 4];

/// The panel, the strip below the picture, and what the picture leaves free.
pub(super) const GROUND: Color = grey(0.145);
/// Windows over the picture. The picture shines through a little, but no text gets lost on it.
pub(super) const OVER: Color = faded(grey(0.10), 0.94);
/// Lists and tooltips, which may lie over controls, whose texts must not shine through.
pub(super) const OVER_CONTROLS: Color = faded(OVER, 1.0);
/// Buttons and fields: at rest, under the pointer, and pressed.
const RAISED: Color = grey(0.24);
const HOVERED: Color = grey(0.30);
const PRESSED: Color = grey(0.36);
/// Lines between parts, and around what lies over the picture.
pub(super) const EDGE: Color = grey(0.30);
pub(super) const TEXT: Color = grey(0.88);
/// Text that only hints.
const QUIET: Color = grey(0.62);
pub(super) const ACCENT: Color = [0.96, 0.68, 0.26, 1.0];
/// The accent under the pointer.
const ACCENT_HOVERED: Color = [1.0, 0.76, 0.40, 1.0];
/// Text and icons on the accent.
const ON_ACCENT: Color = grey(0.06);
/// The ground of what failed or was refused.
pub(super) const FAILED: Color = [0.46, 0.07, 0.08, 0.97];
/// The reason why something was refused, on the ground of a tooltip.
pub(super) const FAILED_TEXT: Color = [1.0, 0.62, 0.58, 1.0];
/// The part of a slider up to its knob, and the knob.
pub(super) const FILLED: Color = grey(0.52);
const KNOB: Color = grey(0.80);
/// Lines on the picture. A dark shade beneath them sets them off from bright places.
pub(super) const MARK: Color = faded(grey(1.0), 0.90);
pub(super) const FAINT_MARK: Color = faded(grey(1.0), 0.45);
pub(super) const SHADE: Color = faded(grey(0.0), 0.65);
/// Around a part of the drawing that can be moved.
pub(super) const HALO: Color = faded(grey(1.0), 0.30);

/// The size of the letters, in points.
const LETTERS: f32 = 16.0;
/// Thin letters on a dark ground look fainter than they are. This makes them stronger.
const STRENGTH: f32 = 1.2;
/// The opacity of controls that cannot be used now, and of their texts.
const DISABLED: f32 = 0.65;
pub(super) const ROUNDING: f32 = 3.0;
const WINDOW_ROUNDING: f32 = 6.0;
/// Between a control and the next one, to the right and below.
pub(super) const SPACING: [f32; 2] = [6.0, 5.0];
/// Around the text of a button.
const FRAME_PADDING: [f32; 2] = [6.0, 3.0];
/// Around what stands in the panel.
pub(super) const PANEL_PADDING: [f32; 2] = [12.0, 6.0];
/// Around what stands in a window over the picture, and around that window.
pub(super) const PADDING: f32 = 12.0;
pub(super) const MARGIN: f32 = 12.0;
/// The knob of a slider, which is round.
const KNOB_SIZE: f32 = 10.0;
/// imgui leaves this much free around the knob.
const KNOB_MARGIN: f32 = 2.0;
const TRACK_HEIGHT: f32 = 3.0;
/// Between lines of text that belong together, and between a name and its slider.
const CLOSE: f32 = 2.0;
/// A row of icons: the side of a button, the space to the next one, and to the next group.
pub(super) const ICON: f32 = 22.0;
pub(super) const ICON_GAP: f32 = 3.0;
pub(super) const GROUP_GAP: f32 = 9.0;
/// The lines of icons and of marks over the picture.
pub(super) const STROKE: f32 = 1.5;
pub(super) const FRAME_STROKE: f32 = 2.0;
/// From a control to the middle of the line that frames it, which so touches neither the name above nor a neighbour.
pub(super) const FRAME_GAP: f32 = 0.5 * CLOSE;
pub(super) const DIVIDER_SHADE: f32 = 4.0;
/// The bar that shows how far the picture has come.
pub(super) const BAR: f32 = 3.0;

/// The width of the panel unless the user has changed it, and the narrowest one.
pub(super) const PANEL_WIDTH: f32 = 320.0;
pub(super) const MIN_PANEL_WIDTH: f32 = 240.0;
/// The least height of the sections. In a lower window, the whole panel scrolls.
pub(super) const MIN_SECTIONS: f32 = 150.0;
/// The height of the strip below the picture unless the user has changed it, and the lowest one.
pub(super) const STRIP: f32 = 320.0;
pub(super) const MIN_STRIP: f32 = 160.0;
/// The width of the strip with which an edge is dragged.
pub(super) const GRIP: f32 = 6.0;
/// The width of the line of a comparison within which it can be dragged, to each side.
pub(super) const DIVIDER_REACH: f32 = 6.0;
/// A part of the drawing can be grasped from this far away.
pub(super) const GRASP_REACH: f32 = 7.0;
/// The width of a halo.
pub(super) const HALO_WIDTH: f32 = 8.0;

/// The height of a mark on a slider, and its least width.
pub(super) const SLIDER_MARK: [f32; 2] = [2.0, 3.0];
/// The width of the list of units beside a slider.
pub(super) const UNIT_WIDTH: f32 = 64.0;
/// The width of the controls above the drawing of the optics.
pub(super) const RAYS_WIDTH: f32 = 80.0;
pub(super) const VIEWS_WIDTH: f32 = 150.0;
/// The width of the window in which a colour is chosen, without its edges.
pub(super) const PICKER_WIDTH: f32 = 256.0;
/// The width of the name of a drop-down list, unless it is longer.
pub(super) const LIST_NAME: f32 = 88.0;
/// The width of the slider of a blur that is asked for.
pub(super) const BLUR_WIDTH: f32 = 200.0;
/// The largest width of a path in a list.
pub(super) const PATH_WIDTH: f32 = 420.0;
/// The picture of a scene in the list of scenes, and the width of the lines beside it.
pub(super) const THUMBNAIL: [f32; 2] = [112.0, 70.0];
pub(super) const ABOUT_WIDTH: f32 = 280.0;
/// The width of a line of a tooltip, and the space around its text.
pub(super) const TOOLTIP_WIDTH: f32 = 280.0;
pub(super) const TOOLTIP_PADDING: f32 = 8.0;
/// The largest width of a message and of a step of the lesson, and the least width of what holds text.
pub(super) const MESSAGE_WIDTH: f32 = 560.0;
pub(super) const LESSON_WIDTH: f32 = 460.0;
pub(super) const MIN_TEXT_WIDTH: f32 = 80.0;
/// The least width of a message with buttons.
pub(super) const OFFERS_WIDTH: f32 = 200.0;
/// Messages begin below the labels of a comparison.
pub(super) const BELOW_LABELS: f32 = 36.0;
pub(super) const LEGEND_WIDTH: f32 = 260.0;
/// The height of the colours of a legend.
pub(super) const LEGEND_BAR: f32 = 14.0;
/// The space between the keys and what they do.
pub(super) const COLUMN_GAP: f32 = 24.0;
/// The labels of a comparison: their space to the upper edge, to the line, and around their text.
pub(super) const LABEL_TOP: f32 = 10.0;
pub(super) const LABEL_GAP: f32 = 12.0;
pub(super) const LABEL_PADDING: [f32; 2] = [6.0, 4.0];
/// The handle in the middle of the line of a comparison.
pub(super) const HANDLE: f32 = 9.0;
/// The radius of the mark on what is brought into focus, of its middle, and of the mark on the pixel that is drawn.
pub(super) const FOCUS_MARK: f32 = 13.0;
pub(super) const DOT: f32 = 1.5;
pub(super) const PIN: f32 = 4.0;

/// The colour of each part of imgui.
fn color(of: StyleColor) -> Color {
    use StyleColor as Of;
    match of {
        Of::Text => TEXT,
        Of::TextDisabled => QUIET,
        Of::WindowBg | Of::TitleBg | Of::TitleBgActive | Of::TitleBgCollapsed => OVER,
        Of::PopupBg => OVER_CONTROLS,
        Of::ChildBg
        | Of::BorderShadow
        | Of::MenuBarBg
        | Of::ScrollbarBg
        | Of::TableRowBg
        | Of::TableRowBgAlt => NOTHING,
        Of::Border
        | Of::Separator
        | Of::ResizeGrip
        | Of::TableHeaderBg
        | Of::TableBorderStrong
        | Of::TableBorderLight => EDGE,
        Of::FrameBgHovered | Of::ButtonHovered | Of::HeaderHovered | Of::TabHovered => HOVERED,
        Of::FrameBgActive
        | Of::ButtonActive
        | Of::Header
        | Of::HeaderActive
        | Of::ScrollbarGrab
        | Of::TabActive
        | Of::TabUnfocusedActive => PRESSED,
        Of::ScrollbarGrabHovered | Of::ScrollbarGrabActive | Of::PlotHistogram | Of::PlotLines => FILLED,
        Of::SliderGrab => KNOB,
        Of::CheckMark
        | Of::SliderGrabActive
        | Of::SeparatorHovered
        | Of::SeparatorActive
        | Of::ResizeGripHovered
        | Of::ResizeGripActive
        | Of::PlotLinesHovered
        | Of::PlotHistogramHovered
        | Of::DragDropTarget
        | Of::NavHighlight
        | Of::NavWindowingHighlight => ACCENT,
        Of::TextSelectedBg => faded(ACCENT, 0.25),
        Of::NavWindowingDimBg | Of::ModalWindowDimBg => SHADE,
        // FrameBg, Button, Tab, TabUnfocused, and what another version of imgui may add.
        _ => RAISED,
    }
}

/// Gives imgui this look.
pub(super) fn apply(style: &mut Style) {
    for of in StyleColor::VARIANTS {
        style[of] = color(of);
    }
    style.disabled_alpha = DISABLED;
    (style.window_rounding, style.popup_rounding) = (WINDOW_ROUNDING, ROUNDING);
    (style.frame_rounding, style.scrollbar_rounding) = (ROUNDING, ROUNDING);
    (style.grab_rounding, style.grab_min_size) = (0.5 * KNOB_SIZE, KNOB_SIZE);
    (style.window_border_size, style.popup_border_size) = (1.0, 1.0);
    style.window_padding = PANEL_PADDING;
    style.frame_padding = FRAME_PADDING;
    (style.item_spacing, style.item_inner_spacing) = (SPACING, SPACING);
    style.scrollbar_size = KNOB_SIZE;
}

/// Loads the letters for a display of this scale.
pub(super) fn load_letters(fonts: &mut FontAtlas, scale: f32) {
    fonts.clear();
    fonts.add_font(&[FontSource::TtfData {
        data: epaint_default_fonts::UBUNTU_LIGHT,
        size_pixels: LETTERS * scale,
        config: Some(FontConfig { rasterizer_multiply: STRENGTH, ..FontConfig::default() }),
    }]);
}

/// The opacity of what is drawn now: less than 1 for what cannot be used, and while a message fades.
pub(super) fn opacity(ui: &Ui) -> f32 {
    ui.clone_style().alpha
}

// Each of these holds until what it returns is dropped.

/// The next window is a part of the viewer's window, such as the panel.
pub(super) fn part(ui: &Ui) -> impl Sized {
    (
        ui.push_style_var(StyleVar::WindowRounding(0.0)),
        ui.push_style_var(StyleVar::WindowBorderSize(0.0)),
        ui.push_style_color(StyleColor::WindowBg, GROUND),
    )
}

/// The next window is seen by nobody, and only takes the pointer.
pub(super) fn unseen(ui: &Ui) -> impl Sized {
    (
        ui.push_style_var(StyleVar::WindowPadding([0.0; 2])),
        ui.push_style_var(StyleVar::WindowMinSize([1.0; 2])),
    )
}

/// The next window lies over the picture, and has this ground. It has an edge, even where it is opened from the panel.
pub(super) fn over(ui: &Ui, ground: Color) -> impl Sized {
    (
        ui.push_style_var(StyleVar::WindowRounding(WINDOW_ROUNDING)),
        ui.push_style_var(StyleVar::WindowBorderSize(1.0)),
        ui.push_style_var(StyleVar::WindowPadding([PADDING; 2])),
        ui.push_style_color(StyleColor::WindowBg, ground),
    )
}

/// Everything is drawn with this opacity.
pub(super) fn fading(ui: &Ui, opacity: f32) -> impl Sized {
    ui.push_style_var(StyleVar::Alpha(opacity))
}

/// The next buttons show that they are on.
pub(super) fn on(ui: &Ui) -> impl Sized {
    (
        ui.push_style_color(StyleColor::Button, ACCENT),
        ui.push_style_color(StyleColor::ButtonHovered, ACCENT_HOVERED),
        ui.push_style_color(StyleColor::ButtonActive, ACCENT_HOVERED),
        ui.push_style_color(StyleColor::Text, ON_ACCENT),
    )
}

/// The next buttons have no ground at rest.
pub(super) fn plain(ui: &Ui) -> impl Sized {
    ui.push_style_color(StyleColor::Button, NOTHING)
}

/// The next headers of sections are flat.
pub(super) fn flat(ui: &Ui) -> impl Sized {
    (
        ui.push_style_color(StyleColor::Header, NOTHING),
        ui.push_style_color(StyleColor::HeaderHovered, RAISED),
        ui.push_style_color(StyleColor::HeaderActive, HOVERED),
    )
}

/// The next field holds what was refused.
pub(super) fn refused(ui: &Ui) -> impl Sized {
    ui.push_style_color(StyleColor::FrameBg, FAILED)
}

/// The next lines belong together.
pub(super) fn close(ui: &Ui) -> impl Sized {
    ui.push_style_var(StyleVar::ItemSpacing([SPACING[0], CLOSE]))
}

/// The next buttons form a table whose cells have this space between them.
pub(super) fn table(ui: &Ui) -> impl Sized {
    (
        ui.push_style_var(StyleVar::ItemSpacing([ICON_GAP; 2])),
        ui.push_style_var(StyleVar::FramePadding([CLOSE, FRAME_PADDING[1]])),
    )
}

/// The next slider shows no number, and so it is low. This draws its track, with the knob at this share of it.
pub(super) fn slider(ui: &Ui, share: f32) -> impl Sized {
    let [x, y] = ui.cursor_screen_pos();
    let (width, height) = (ui.calc_item_width(), ui.text_line_height() - 2.0 * SLIDER_INSET);
    let is_hovered = ui.is_window_hovered() && ui.is_mouse_hovering_rect([x, y], [x + width, y + height]);
    let middle = y + 0.5 * height;
    let track = |from: f32, to: f32, color: Color| {
        let corners = ([from, middle - 0.5 * TRACK_HEIGHT], [to, middle + 0.5 * TRACK_HEIGHT]);
        let list = ui.get_window_draw_list();
        let rect = list.add_rect(corners.0, corners.1, faded(color, opacity(ui)));
        rect.filled(true).rounding(0.5 * TRACK_HEIGHT).build();
    };
    let [rest, filled] = if is_hovered { [PRESSED, QUIET] } else { [HOVERED, FILLED] };
    track(x + KNOB_MARGIN, x + width - KNOB_MARGIN, rest);
    track(x + KNOB_MARGIN, x + along_slider(width, share), filled);
    (
        ui.push_style_var(StyleVar::FramePadding([FRAME_PADDING[0], -SLIDER_INSET])),
        ui.push_style_color(StyleColor::FrameBg, NOTHING),
        ui.push_style_color(StyleColor::FrameBgHovered, NOTHING),
        ui.push_style_color(StyleColor::FrameBgActive, NOTHING),
    )
}

/// A slider is lower than a line of text by this much, above and below.
const SLIDER_INSET: f32 = 1.0;

/// How far from the left end of a slider of this width the middle of its knob stands, at this share of its length.
pub(super) fn along_slider(width: f32, share: f32) -> f32 {
    let margin = KNOB_MARGIN + 0.5 * KNOB_SIZE;
    margin + share * (width - 2.0 * margin)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a colour looks like on top of another one.
    fn on_top([red, green, blue, opacity]: Color, below: Color) -> Color {
        let mix = |above: f32, below: f32| opacity * above + (1.0 - opacity) * below;
        [mix(red, below[0]), mix(green, below[1]), mix(blue, below[2]), 1.0]
    }

    /// The contrast of two colours, from 1 to 21, by the Web Content Accessibility Guidelines.
    fn contrast(one: Color, other: Color) -> f32 {
        let luminance = |[red, green, blue, _]: Color| {
            let [red, green, blue] = [red, green, blue].map(|level| {
                if level <= 0.04045 { level / 12.92 } else { ((level + 0.055) / 1.055).powf(2.4) }
            });
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        };
        let (one, other) = (luminance(one), luminance(other));
        (one.max(other) + 0.05) / (one.min(other) + 0.05)
    }

    /// Catches text that is hard to read on what is behind it: 4.5 is the least contrast that the guidelines ask for.
    #[test]
    fn every_text_is_legible_on_its_ground() {
        let (white, black) = (grey(1.0), grey(0.0));
        let [bright, dark] = [white, black].map(|picture| on_top(OVER, picture));
        let selected = on_top(color(StyleColor::TextSelectedBg), RAISED);
        for (what, text, grounds) in [
            ("text", TEXT, vec![GROUND, bright, dark, RAISED, HOVERED, PRESSED, selected]),
            ("text of an error", TEXT, vec![on_top(FAILED, white), on_top(FAILED, black)]),
            ("label of a comparison", TEXT, vec![on_top(SHADE, grey(0.55))]),
            ("hint", QUIET, vec![GROUND, bright, dark]),
            ("what is on", ON_ACCENT, vec![ACCENT, ACCENT_HOVERED]),
            ("title", ACCENT, vec![GROUND, bright, dark]),
            ("reason", FAILED_TEXT, vec![bright, dark]),
        ] {
            for ground in grounds {
                let contrast = contrast(text, ground);
                assert!(contrast >= 4.5, "{what} on {ground:?}: {contrast:.2}");
            }
        }
        // imgui fades a control that cannot be used, with its ground.
        for ground in [GROUND, bright, dark] {
            let button = on_top(faded(RAISED, DISABLED), ground);
            for below in [ground, button] {
                let text = on_top(faded(TEXT, DISABLED), below);
                assert!(contrast(text, below) >= 4.5, "disabled text: {:.2}", contrast(text, below));
                assert!(contrast(TEXT, text) >= 1.5, "it looks as if it could be used");
            }
        }
    }

    /// Catches two states of a button that look alike.
    #[test]
    fn the_states_of_a_button_differ() {
        let states = [GROUND, RAISED, HOVERED, PRESSED];
        for pair in states.windows(2) {
            assert!(contrast(pair[0], pair[1]) > 1.15, "{pair:?}: {:.2}", contrast(pair[0], pair[1]));
        }
        // The guidelines ask for 3 between the states of a control.
        assert!(contrast(ACCENT, PRESSED) > 3.0);
    }

    /// Catches a tint around the picture, and colours of imgui's own: each is a grey, or the accent.
    #[test]
    fn the_surroundings_of_the_picture_are_neutral() {
        for of in StyleColor::VARIANTS {
            let [red, green, blue, _] = color(of);
            let is_grey = red == green && green == blue;
            assert!(is_grey || [red, green, blue] == ACCENT[..3], "{of:?} is {:?}", color(of));
        }
    }
}
