//! The viewer under Xvfb: the list of scenes, with their pictures.

mod common;

use common::mesh::sphere;
use common::viewer::Viewer;
use common::{decode_png, render_png};
use std::time::{Duration, Instant};
use thinlens::scene::BUILTINS;

/// How many levels a pixel of a thumbnail may differ by from a fresh picture. Devices round differently, and a ray beside
/// an edge may then hit something else.
const LEVELS: u8 = 8;

/// The largest difference of two pictures of one size.
fn worst(a: &[[u8; 3]], b: &[[u8; 3]]) -> u8 {
    assert_eq!(a.len(), b.len());
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| a.abs_diff(*b)).max().expect("pixels")
}

/// Catches a thumbnail of another scene, and one that is older than its scene or than the renderer. After a wanted change,
/// `THINLENS_BLESS=1 cargo test --release --test viewer_scenes` writes them anew.
#[test]
fn thumbnails_are_what_the_program_renders() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut bytes = 0;
    for builtin in BUILTINS {
        let rendered = render_png(folder.path(), &[builtin.name, "--size", "160x100", "-n", "256"]);
        let (extent, fresh) = decode_png(&rendered);
        if std::env::var_os("THINLENS_BLESS").is_some() {
            let path = format!("{}/src/scene/builtin/{}.png", env!("CARGO_MANIFEST_DIR"), builtin.name);
            let file = std::fs::File::create(path).expect("a writable file");
            let mut encoder = png::Encoder::new(file, extent[0], extent[1]);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_compression(png::Compression::High);
            let mut writer = encoder.write_header().expect("a header");
            writer.write_image_data(fresh.as_flattened()).expect("pixels");
            continue;
        }
        let (kept_extent, kept) = decode_png(builtin.thumbnail);
        assert_eq!(kept_extent, extent, "{}", builtin.name);
        let off = worst(&kept, &fresh);
        assert!(off <= LEVELS, "{}: the thumbnail is off by {off} levels", builtin.name);
        for other in BUILTINS.iter().filter(|other| other.name != builtin.name) {
            let off = worst(&decode_png(other.thumbnail).1, &fresh);
            assert!(off > 10 * LEVELS, "{} would pass for {}", other.name, builtin.name);
        }
        bytes += builtin.thumbnail.len();
    }
    // A lens that is wider by a tenth must be seen.
    let wider = ["version-4", "--lens-diameter", "0.374", "--size", "160x100", "-n", "256"];
    let fresh = decode_png(&render_png(folder.path(), &wider)).1;
    assert!(worst(&decode_png(BUILTINS[0].thumbnail).1, &fresh) > LEVELS);
    assert!(bytes < 100_000, "the thumbnails take {bytes} bytes");
}

/// A thumbnail in another size, as the screen shows it: each pixel is a mean of the two by two nearest.
fn scaled(pixels: &[[u8; 3]], [width, height]: [usize; 2], to: [usize; 2]) -> Vec<[f64; 3]> {
    let sample = |x: f64, y: f64, channel: usize| {
        let (x, y) = (x.clamp(0.0, width as f64 - 1.0), y.clamp(0.0, height as f64 - 1.0));
        let (left, top) = (x.floor() as usize, y.floor() as usize);
        let (right, bottom) = ((left + 1).min(width - 1), (top + 1).min(height - 1));
        let (across, down) = (x.fract(), y.fract());
        let at = |x: usize, y: usize| f64::from(pixels[y * width + x][channel]);
        (at(left, top) * (1.0 - across) + at(right, top) * across) * (1.0 - down)
            + (at(left, bottom) * (1.0 - across) + at(right, bottom) * across) * down
    };
    let places = (0..to[1]).flat_map(|y| (0..to[0]).map(move |x| [x, y]));
    let place = |at: usize, from: usize, to: usize| (at as f64 + 0.5) * from as f64 / to as f64 - 0.5;
    places
        .map(|[x, y]| {
            [0, 1, 2].map(|channel| sample(place(x, width, to[0]), place(y, height, to[1]), channel))
        })
        .collect()
}

/// Catches a list without pictures, pictures that stand beside other names than theirs, and a row that opens another scene.
#[test]
fn a_scene_is_chosen_by_its_picture() {
    let viewer = Viewer::start([800, 640], &["-n", "2"]);
    viewer.wait_until_done();
    let is_open = |viewer: &Viewer| BUILTINS.iter().all(|of| viewer.controls.borrow().contains_key(of.name));
    viewer.click("Scene", is_open);
    viewer.rest();
    for builtin in BUILTINS {
        let [x, y, width, height] = viewer.controls.borrow()[builtin.name];
        let (extent, kept) = decode_png(builtin.thumbnail);
        let size = [width, height].map(|extent| usize::try_from(extent).expect("a size"));
        let expected = scaled(&kept, extent.map(|extent| extent as usize), size);
        let deadline = Instant::now() + Duration::from_secs(30);
        loop {
            let corner = [x, y].map(|at| i16::try_from(at).expect("on the screen"));
            let shown = viewer.screen(corner, size.map(|extent| u16::try_from(extent).expect("a size")));
            let error = shown.as_flattened().iter().zip(expected.as_flattened());
            let mean = error.map(|(is, wanted)| (f64::from(*is) - wanted).abs()).sum::<f64>()
                / (3 * expected.len()) as f64;
            if mean < 2.0 {
                break;
            }
            assert!(Instant::now() < deadline, "{}: the picture is off by {mean} levels", builtin.name);
            viewer.listen(Duration::from_millis(50));
        }
    }
    viewer.click("suffern-mirror", |viewer| viewer.opened.borrow().ends_with("suffern-mirror"));
    viewer.wait_until_done();
    viewer.expect_picture("the mirror", 0, &["suffern-mirror", "-n", "2"]);
    viewer.close();
}

/// Where bright pixels are in a rectangle of the screen, counted from the leftmost and the uppermost of them.
fn text_in(viewer: &Viewer, [x, y, width, height]: [i32; 4]) -> Vec<[i32; 2]> {
    let corner = [x, y].map(|at| i16::try_from(at).expect("on the screen"));
    let pixels = viewer.screen(corner, [width, height].map(|extent| u16::try_from(extent).expect("a size")));
    let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).zip(pixels);
    let bright: Vec<_> = places.filter(|(_, [red, ..])| *red > 200).map(|(place, _)| place).collect();
    let first = [0, 1].map(|axis| bright.iter().map(|place| place[axis]).min().unwrap_or(0));
    bright.into_iter().map(|place| [0, 1].map(|axis| place[axis] - first[axis])).collect()
}

/// Catches an opened file that has no row or two, a row with another name, a mark at another row than that of the shown
/// scene, and a row that opens something else.
#[test]
fn an_opened_file_is_in_the_list() {
    let viewer = Viewer::start([800, 640], &["-n", "2"]);
    viewer.wait_until_done();
    let file = viewer.folder.join("one-ball-alone.obj");
    std::fs::write(&file, sphere(6, false, false)).expect("a mesh");
    let open_list = || {
        viewer.controls.borrow_mut().remove("version-4");
        viewer.click("Scene", |viewer| viewer.controls.borrow().contains_key("version-4"));
        viewer.rest();
    };
    // The rows are as wide as that of the file, which is the last one.
    let ground = |name: &str| {
        let controls = viewer.controls.borrow();
        let ([x, _, width, _], [_, y, _, height]) = (controls["Opened file"], controls[name]);
        viewer.screen([(x + width - 6) as i16, (y + height / 2) as i16], [1, 1])[0]
    };
    open_list();
    assert!(!viewer.controls.borrow().contains_key("Opened file"), "no file was opened yet");
    viewer.press("Escape");
    viewer.drop_file(&file);
    viewer.wait_for("the mesh", |viewer| viewer.opened.borrow().ends_with("one-ball-alone.obj"));
    viewer.wait_until_done();
    let [x, y, width, height] = viewer.controls.borrow()["Scene"];
    // The arrow at its right is as wide as it is high.
    let shown_name = text_in(&viewer, [x, y, width - height, height]);
    for round in 0..2 {
        open_list();
        let row = viewer.controls.borrow()["Opened file"];
        let name = text_in(&viewer, row);
        let differ = name.iter().filter(|at| !shown_name.contains(at)).count()
            + shown_name.iter().filter(|at| !name.contains(at)).count();
        // Letters on another ground have other edges.
        assert!(5 * differ < shown_name.len() && !name.is_empty(), "{differ} pixels of the name differ");
        assert!(ground("Opened file")[0] > ground("version-4")[0] + 30, "the mesh is not marked");
        viewer.click("version-4", |viewer| viewer.opened.borrow().ends_with("version-4"));
        viewer.wait_until_done();
        viewer.expect_picture("the built-in scene", 0, &["version-4", "-n", "2"]);
        open_list();
        assert!(ground("version-4")[0] > ground("Opened file")[0] + 30, "the built-in scene is not marked");
        viewer.click("Opened file", |viewer| viewer.opened.borrow().ends_with("one-ball-alone.obj"));
        viewer.wait_until_done();
        viewer.expect_picture("the mesh", 0, &[&file.display().to_string(), "-n", "2"]);
        assert!(round == 0 || viewer.controls.borrow()["Opened file"] == row, "there is another row");
    }
    viewer.close();
}
