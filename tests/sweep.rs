//! Sheets of pictures side by side.

mod common;

use common::{decode_png, render_png, run};
use std::path::Path;

const SMALL: [&str; 4] = ["--size", "96x64", "--samples", "8"];
/// The sheet's margins, in pixels.
const MARGIN: usize = 16;

struct Sheet {
    size: [usize; 2],
    rgb: Vec<[u8; 3]>,
}

impl Sheet {
    fn render(folder: &Path, options: &[&str]) -> Self {
        let outcome =
            run(folder, &[&["sweep", "-q", "-o", "sheet.png", "--validation"], &SMALL[..], options].concat());
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        let (size, rgb) = decode_png(&std::fs::read(folder.join("sheet.png")).expect("a sheet"));
        Self { size: size.map(|extent| extent as usize), rgb }
    }

    fn part(&self, [left, top]: [usize; 2], [width, height]: [usize; 2]) -> Vec<[u8; 3]> {
        let row = |y: usize| &self.rgb[y * self.size[0] + left..][..width];
        (top..top + height).flat_map(row).copied().collect()
    }

    /// The height of a row: a picture, and the text under it.
    fn row_height(&self, rows: usize) -> usize {
        (self.size[1] - MARGIN) / rows
    }

    /// The picture there.
    fn picture(&self, [column, row]: [usize; 2], rows: usize) -> Vec<[u8; 3]> {
        let at = [MARGIN + column * (96 + MARGIN), MARGIN + row * self.row_height(rows)];
        self.part(at, [96, 64])
    }

    /// The text under it.
    fn text(&self, [column, row]: [usize; 2], rows: usize) -> Vec<[u8; 3]> {
        let height = self.row_height(rows);
        let at = [MARGIN + column * (96 + MARGIN), MARGIN + row * height + 64];
        self.part(at, [96, height - 64])
    }
}

fn rendered(folder: &Path, options: &[&str]) -> Vec<[u8; 3]> {
    decode_png(&render_png(folder, &[&SMALL[..], options].concat())).1
}

fn brightness(picture: &[[u8; 3]]) -> f64 {
    picture.iter().flatten().map(|part| f64::from(*part)).sum::<f64>() / picture.len() as f64
}

/// Catches pictures in another order than the values, cut or shifted ones, samples of one that stay in the next,
/// another brightness for each, and text that is missing or the same everywhere.
#[test]
fn each_picture_is_what_render_gives() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let sheet = Sheet::render(folder, &[]);
    assert_eq!(sheet.size[0], 2 * 96 + 3 * MARGIN);
    let places = [[0, 0], [1, 0], [0, 1], [1, 1]];
    for (place, f_number) in places.into_iter().zip(["2.8", "5.6", "11", "32"]) {
        let picture = sheet.picture(place, 2);
        assert!(picture == rendered(folder, &["--f-number", f_number]), "f/{f_number}");
        let change = brightness(&picture) / brightness(&sheet.picture([0, 0], 2));
        assert!((change - 1.0).abs() < 0.02, "f/{f_number} is {change} times as bright as f/2.8");
    }
    let texts = places.map(|place| sheet.text(place, 2));
    for (index, text) in texts.iter().enumerate() {
        let lit = text.iter().filter(|pixel| pixel[0] > 128).count();
        assert!((20..600).contains(&lit), "{lit} pixels of letters");
        assert!(!texts[..index].contains(text), "a text twice");
    }

    let sheet = Sheet::render(folder, &["suffern-boxes", "--focal-distances", "50,74,98", "--columns", "1"]);
    assert_eq!(sheet.size[0], 96 + 2 * MARGIN);
    for (row, distance) in ["50", "74", "98"].into_iter().enumerate() {
        let expected = rendered(folder, &["suffern-boxes", "--focal-distance", distance]);
        assert!(sheet.picture([0, row], 3) == expected, "focused at {distance}");
    }

    let options = ["--lens-diameters", "0,0.5", "--exposure-lock=false"];
    let sheet = Sheet::render(folder, &options);
    for (column, diameter) in ["0", "0.5"].into_iter().enumerate() {
        let expected = rendered(folder, &["--lens-diameter", diameter, "--exposure-lock=false"]);
        assert!(sheet.picture([column, 0], 1) == expected, "a lens {diameter} wide");
    }
}

/// Catches a sheet that is begun though it cannot be made, and a message that does not say why.
#[test]
fn what_makes_no_sheet_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let many = vec!["4"; 65].join(",");
    for (code, options, part) in [
        (2, &["-o", "sheet.exr"][..], "is a .png"),
        (2, &["-o", "sheet.png", "--camera", "hole"], "--camera thin-lens"),
        (2, &["-o", "sheet.png", "--f-numbers", "2.8,0"], "f-number is 0"),
        (2, &["-o", "sheet.png", "--f-numbers", "wide"], "--f-numbers"),
        (2, &["-o", "sheet.png", "--f-numbers", "4", "--lens-diameters", "1"], "cannot be used with"),
        (2, &["-o", "sheet.png", "--f-numbers", &many], "not 65"),
        (2, &["-o", "sheet.png", "--columns", "5"], "from 1 to 4"),
        (2, &["-o", "sheet.png", "--columns", "0"], "from 1 to 4"),
        (2, &["-o", "sheet.png", "--size", "16000x9000"], "--size smaller"),
        (1, &["-o", "nowhere/sheet.png"], "nowhere"),
    ] {
        let outcome = run(folder.path(), &[&["sweep"], options].concat());
        assert_eq!(outcome.code, code, "{options:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(part), "{options:?}: {}", outcome.stderr);
        assert_eq!(
            std::fs::read_dir(folder.path()).expect("the folder").count(),
            0,
            "{options:?} leaves a file"
        );
    }
}
