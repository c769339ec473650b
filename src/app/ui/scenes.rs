//! The list of scenes: built-in ones with a picture and a description, and files that were opened.

use super::widgets::{Layout, from_end, note, note_item, tooltip, wrapped};
use crate::app::panel::{Panel, builtin, file_name};
use crate::app::theme::{ABOUT_WIDTH, PATH_WIDTH, SPACING, THUMBNAIL, TOOLTIP_WIDTH};
use crate::scene::{BUILTINS, Builtin};
use imgui::{ComboBoxFlags, StyleColor, TextureId, Ui};
use std::path::Path;

impl Panel {
    /// Draws the list of scenes in this width. `thumbnails` has the pictures of the built-in ones, one below the other.
    pub(super) fn scene_chooser(
        &mut self,
        ui: &Ui,
        width: f32,
        thumbnails: Option<TextureId>,
        layout: &mut Layout,
    ) {
        let shown = self.settings.estimator.scene.source.clone();
        let mut chosen = None;
        ui.set_next_item_width(width);
        let flags = ComboBoxFlags::HEIGHT_LARGE;
        if let Some(_open) = ui.begin_combo_with_flags("##Scene", file_name(&shown), flags) {
            for (number, scene) in self.scenes.iter().enumerate() {
                // imgui needs an id, because two scenes may be shown by the same name.
                let _id = ui.push_id_usize(number);
                let is_shown = *scene == shown;
                let pressed = match builtin(scene) {
                    Some(builtin) => row(ui, builtin, is_shown, thumbnails, layout),
                    None => file_row(ui, scene, is_shown, layout),
                };
                if pressed {
                    chosen = Some(scene.clone());
                }
            }
        } else {
            // While the list is open, the last item is an entry of it and not the list.
            note_item(ui, "Scene", layout);
            let help = "The scene: a built-in one, or one that you have opened.";
            match builtin(&shown) {
                Some(builtin) => tooltip(ui, &format!("{help} This one: {}.", builtin.about)),
                None => {
                    tooltip(ui, &format!("{help} {}", from_end(ui, &shown.to_string_lossy(), TOOLTIP_WIDTH)))
                }
            }
        }
        if let Some(name) = chosen {
            self.open(&name);
        }
    }
}

/// Draws the row of a built-in scene. Returns whether it is pressed.
fn row(
    ui: &Ui,
    scene: &'static Builtin,
    is_shown: bool,
    thumbnails: Option<TextureId>,
    layout: &mut Layout,
) -> bool {
    let corner @ [x, y] = ui.cursor_screen_pos();
    let [width, height] = THUMBNAIL;
    let pressed = ui
        .selectable_config("##row")
        .selected(is_shown)
        .size([width + SPACING[0] + ABOUT_WIDTH, height])
        .build();
    note(ui, scene.name, corner, THUMBNAIL, layout);
    let list = ui.get_window_draw_list();
    let number = BUILTINS.iter().position(|of| of.name == scene.name).unwrap_or(0) as f32;
    let share = (BUILTINS.len() as f32).recip();
    if let Some(texture) = thumbnails {
        list.add_image(texture, corner, [x + width, y + height])
            .uv_min([0.0, number * share])
            .uv_max([1.0, (number + 1.0) * share])
            .build();
    }
    let mut line = [x + width + SPACING[0], y];
    list.add_text(line, ui.style_color(StyleColor::Text), scene.name);
    for text in wrapped(scene.about, |line| ui.calc_text_size(line)[0] <= ABOUT_WIDTH) {
        line[1] += ui.text_line_height();
        list.add_text(line, ui.style_color(StyleColor::TextDisabled), text);
    }
    pressed
}

/// Draws the row of a file, with its folder if that is known. Returns whether it is pressed.
fn file_row(ui: &Ui, file: &Path, is_shown: bool, layout: &mut Layout) -> bool {
    let pressed = ui.selectable_config(file_name(file)).selected(is_shown).build();
    note_item(ui, "Opened file", layout);
    tooltip(ui, &from_end(ui, &file.to_string_lossy(), PATH_WIDTH));
    pressed
}
