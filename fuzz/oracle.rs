//! What has to hold of everything that is accepted.

use std::path::Path;
use thinlens::gpu_types::SceneData;
use thinlens::scene::{self, SceneRef};
use thinlens::settings::{Settings, list};

/// Settings that can be rendered come back from their own arguments.
pub fn arguments(settings: &Settings) {
    let arguments = settings.arguments();
    let again = Settings::of_arguments(&arguments)
        .unwrap_or_else(|error| panic!("arguments that are made are refused: {error} ({arguments:?})"));
    let again = of_one_loading(again, settings);
    assert_eq!(again, *settings, "other settings come of their own arguments {arguments:?}");
}

/// A scene that is saved can be read, and has the same shapes and camera.
pub fn saved(settings: &Settings) {
    // What cannot be said in a scene file is refused.
    let Ok(text) = settings.scene_file(Path::new(".")) else { return };
    std::fs::write("saved.toml", text).expect("a writable folder");
    let scene = scene::load("saved.toml").unwrap_or_else(|error| panic!("a saved scene is refused: {error}"));
    let shapes = |scene: &scene::Scene| {
        [scene.shapes.len(), scene.of_kind::<scene::Triangle>().count(), scene.lights.len()]
    };
    assert_eq!(shapes(&scene), shapes(&settings.estimator.scene), "a saved scene has other shapes");
    let again = Settings::of_scene(SceneRef::new(scene));
    again.check().unwrap_or_else(|error| panic!("a saved scene cannot be rendered: {error}"));
    let mut again = of_one_loading(again, settings);
    for setting in list::own().filter(|setting| setting.is_of_sampling()) {
        setting.set(&mut again, &setting.get(settings)).expect("no image says how a scene is sampled");
    }
    assert_eq!(again.estimator, settings.estimator, "a saved scene has other settings");
}

/// Scenes and images are equal where they are the same loading: takes over those of the other settings, if an image
/// has the same light.
fn of_one_loading(mut settings: Settings, other: &Settings) -> Settings {
    settings.estimator.scene = other.estimator.scene.clone();
    if let (Some(image), Some(of_other)) =
        (&settings.estimator.aperture.image, &other.estimator.aperture.image)
    {
        assert_eq!((image.size, &image.cells), (of_other.size, &of_other.cells), "another image is read");
        settings.estimator.aperture.image = Some(of_other.clone());
    }
    settings
}

/// What a device gets of a scene, in lists and in a tree. Gives how deep the tree is.
pub fn on_device(settings: &Settings) -> u32 {
    let (scene, shutter) = (&settings.estimator.scene, settings.estimator.shutter);
    let data = SceneData::new(scene, shutter);
    assert!(
        data.colors.environment.bounding_radius.is_finite(),
        "the scene reaches {}",
        data.colors.environment.bounding_radius
    );
    let depth = if data.tree_depth > 0 {
        data.tree_depth
    } else {
        SceneData::with_tree(scene, shutter, true).tree_depth
    };
    let bounded = scene.shapes.iter().filter(|of| of.shape.is_bounded()).count();
    assert_eq!(depth > 0, bounded > 0, "a tree of {bounded} shapes");
    depth
}
