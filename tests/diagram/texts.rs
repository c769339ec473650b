//! What the drawing says, and that it can be read.

use super::common::{Gpu, small};
use super::*;
use thinlens::diagram::{self, Drawing, KEPT, LETTERS, Look, Point, Role, Shape, Side, VIEWS, View};
use thinlens::renderer::Excerpt;
use thinlens::scene::CameraModel;
use thinlens::settings::{Settings, to_linear};

/// Catches a sentence that says the wrong side, or blur where it is sharp; and a drawing without its numbers.
#[test]
fn a_sentence_says_what_happens() {
    let gpu = Gpu::new();
    let settings = small("version-4");
    let said = |change: &dyn Fn(&mut Settings), position: [f32; 2]| {
        let mut changed = settings.clone();
        change(&mut changed);
        let diagram = drawn(&gpu, &changed, position).expect("it is drawn");
        (diagram::sentence(&diagram), diagram)
    };
    let (near, diagram) = said(&|settings| settings.estimator.lens.focal_distance = 30.0, [20.5, 38.5]);
    assert!(near.contains("behind the film") && near.contains("would only meet"), "{near}");
    let off = (diagram.image.crossing.expect("light meets") - diagram.image.film_distance) * 50.0;
    assert!(near.contains(&format!("meet {off:.1} mm behind")), "{near}: it is {off} mm");
    let (far, _) = said(&|settings| settings.estimator.lens.focal_distance = 3.0, [20.5, 38.5]);
    assert!(far.contains("in front of the film"), "{far}");
    let depth = diagram.hit.expect("a surface").z as f32;
    let (sharp, _) = said(&|settings| settings.estimator.lens.focal_distance = depth, [20.5, 38.5]);
    assert!(sharp.contains("it is sharp there") && !sharp.contains("in front"), "{sharp}");
    let (pinhole, _) = said(&|settings| settings.estimator.model = CameraModel::Pinhole, [20.5, 38.5]);
    assert!(pinhole.contains("sharp at every depth"), "{pinhole}");
    let (hole, _) = said(&|settings| settings.estimator.model = CameraModel::Hole, [20.5, 10.5]);
    assert!(hole.contains("straight through the hole"), "{hole}");
    let (background, diagram) = said(&|_| (), [32.5, 0.5]);
    assert!(background.contains("background") && diagram.hit.is_none(), "{background}");
}

/// Catches an SVG that is not XML, whose parts are not those of the drawing, or that has a number that is none.
#[test]
fn a_saved_drawing_has_every_part() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    settings.estimator.aperture.blades = 6;
    let models = [CameraModel::ThinLens, CameraModel::Pinhole, CameraModel::Hole];
    let [width, height] = settings.estimator.size;
    let picture = Excerpt::of(
        &vec![[255, 128, 0]; (width * height) as usize],
        [width, height],
        [20, 38],
        Excerpt::MAX_REACH,
    );
    for (model, size) in models.into_iter().flat_map(|model| [(model, [1100.0, 420.0]), (model, [1.0, 1.0])])
    {
        settings.estimator.model = model;
        let mut diagram = drawn(&gpu, &settings, [20.5, 38.5]).expect("it is drawn");
        diagram.material = "<silver> & \"gold\"\u{1}".into();
        let drawing = diagram::draw(&diagram, &Look { size, picture: Some(&picture), ..LOOK });
        let text = diagram::svg(&drawing);
        let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
        let count = |names: &[&str]| {
            document.descendants().filter(|node| names.contains(&node.tag_name().name())).count()
        };
        assert_eq!(count(&["svg"]), 1 + drawing.panes.len());
        // One rectangle is the background.
        assert_eq!(count(&["polyline", "polygon", "circle", "text", "rect"]), 1 + shapes(&drawing).count());
        let is_colored = size[0] < 2.0 || text.contains("fill=\"#ff8000\"");
        assert!(is_colored, "the colour of the picture: {text}");
        let written: Vec<String> = document
            .descendants()
            .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
            .map(|node| node.text().unwrap_or_default().replace('\u{fffd}', "\u{1}"))
            .collect();
        assert_eq!(written, texts(&drawing));
        assert!(!text.contains("NaN") && !text.contains("inf,") && !text.contains("inf\""), "{text}");
    }
}

/// Where the text of a drawing stands: left, top, right, bottom.
fn boxes(drawing: &Drawing) -> Vec<(&str, [f32; 4])> {
    let boxes = shapes(drawing).filter_map(|shape| match shape {
        Shape::Text { at: [x, y], anchor, text, .. } => {
            let width = diagram::text_width(text);
            let left = anchor.left(*x, width);
            // The letters of a line reach from the top of an l to the bottom of a p.
            Some((text.as_str(), [left, y - 0.45 * LETTERS, left + width, y + 0.45 * LETTERS]))
        }
        _ => None,
    });
    boxes.collect()
}

/// How bright a part of the drawing looks on the paper, from 0 to 1.
fn luminance(role: Role) -> f64 {
    let [paper, [red, green, blue, opacity]] = [Role::Paper, role].map(Role::color);
    let level = |above: f32, below: f32| to_linear((opacity * above + (1.0 - opacity) * below).into());
    0.2126 * level(red, paper[0]) + 0.7152 * level(green, paper[1]) + 0.0722 * level(blue, paper[2])
}

/// Catches text that is hard to read on the paper: 4.5 is the least contrast that the Web Content Accessibility Guidelines
/// ask for.
#[test]
fn every_text_is_legible() {
    let gpu = Gpu::new();
    let diagram = drawn(&gpu, &small("version-4"), [20.5, 38.5]).expect("it is drawn");
    let (focus, _) = diagram.focus.expect("a lens");
    let mut roles: Vec<Role> = Vec::new();
    for kept in [[None; KEPT], [Some(0.5 * focus), Some(focus)], [Some(2.0 * focus), None]] {
        for entry in &VIEWS {
            let look =
                Look { view: entry.view, size: [1580.0, 400.0], sharp: Some([9.0, 12.0]), kept, ..LOOK };
            for shape in shapes(&diagram::draw(&diagram, &look)) {
                if let Shape::Text { role, text, .. } = shape {
                    let contrast = (luminance(*role) + 0.05) / (luminance(Role::Paper) + 0.05);
                    assert!(contrast >= 4.5, "'{text}' has the contrast {contrast:.2}");
                    roles.push(*role);
                }
            }
        }
    }
    for side in [Side::InFront, Side::InFocus, Side::Behind] {
        assert!(roles.contains(&Role::LightOf(side)), "no name has the colour of {side:?}");
    }
}

/// Catches text over other text, and text that is cut off at the edge of the drawing.
#[test]
fn no_text_covers_another() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    let none = [None; KEPT];
    for (model, focal_distance, position, kept) in [
        (CameraModel::ThinLens, 10.6, [32.5, 24.5], none),
        (CameraModel::ThinLens, 10.6, [32.5, 24.5], [Some(9.0), Some(11.0)]),
        (CameraModel::ThinLens, 10.6, [20.5, 38.5], none),
        (CameraModel::ThinLens, 40.0, [10.5, 44.5], [Some(5.0), Some(38.5)]),
        (CameraModel::ThinLens, 3.0, [32.5, 0.5], none),
        (CameraModel::Hole, 10.6, [40.5, 30.5], none),
        (CameraModel::Pinhole, 10.6, [20.5, 38.5], [Some(3.0), None]),
    ] {
        settings.estimator.model = model;
        settings.estimator.lens.focal_distance = focal_distance;
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        for (entry, size) in VIEWS
            .iter()
            .flat_map(|entry| [[640.0, 280.0], [936.0, 270.0], [1580.0, 400.0]].map(|size| (entry, size)))
        {
            let drawing = diagram::draw(&diagram, &Look { view: entry.view, size, kept, ..LOOK });
            let what = format!("{} of {model:?} at {position:?} with {kept:?} in {size:?}", entry.name);
            let boxes = boxes(&drawing);
            if entry.view.is_section() {
                for depth in kept.into_iter().flatten() {
                    let number = if depth < 10.0 { format!("{depth:.2}") } else { format!("{depth:.1}") };
                    let is_named =
                        |text: &str| text.trim_start_matches("kept: ").split(',').next() == Some(&number);
                    assert!(boxes.iter().any(|(text, _)| is_named(text)), "{what}: no {number} in {boxes:?}");
                }
                for names in [&["film"][..], &["lens", "hole", "ideal pinhole"]] {
                    let is_named = |text: &str| names.iter().any(|name| text.split(',').next() == Some(name));
                    assert!(
                        boxes.iter().any(|(text, _)| is_named(text)),
                        "{what}: no {names:?} in {boxes:?}"
                    );
                }
            }
            for (number, (text, [left, top, right, bottom])) in boxes.iter().enumerate() {
                assert!(*left >= 0.0 && *right <= size[0], "{what}: '{text}' from {left} to {right}");
                assert!(*top >= 0.0 && *bottom <= size[1], "{what}: '{text}' at {top} to {bottom}");
                for (other, [l, t, r, b]) in &boxes[..number] {
                    let apart = right <= l || r <= left || bottom <= t || b <= top;
                    assert!(apart, "{what}: '{text}' covers '{other}'");
                }
            }
        }
    }
}

/// Each letter is near the dot of its colour and, where there is room, nearer to it than to any other dot.
fn letters_stand_at_their_dots(drawing: &Drawing, what: &str) {
    let dots: Vec<(Point, Role)> = shapes(drawing)
        .filter_map(|shape| match shape {
            Shape::Dot { at, role, .. } => Some((*at, *role)),
            _ => None,
        })
        .collect();
    let roles = shapes(drawing).filter_map(|shape| match shape {
        Shape::Text { role, .. } => Some(*role),
        _ => None,
    });
    for ((letter, [left, top, right, bottom]), role) in boxes(drawing).into_iter().zip(roles) {
        if letter.len() > 1 {
            continue;
        }
        let away =
            |[x, y]: Point| (left - x).max(x - right).max(0.0).hypot((top - y).max(y - bottom).max(0.0));
        let nearest = |of: &dyn Fn(Role) -> bool| {
            dots.iter().filter(|(_, role)| of(*role)).map(|(at, _)| away(*at)).fold(f32::MAX, f32::min)
        };
        let (own, other) = (nearest(&|of| of == role), nearest(&|of| of != role));
        let has_room = drawing.size[1] >= 300.0;
        assert!(own < 25.0, "{what}: '{letter}' is {own} from its dot");
        assert!(
            !has_room || own < other + 1.0,
            "{what}: '{letter}' is {own} from its dot, {other} from another"
        );
    }
}

/// Catches a dot over a letter, a letter far from its dot or nearer to another one, most of all in a low strip, where the
/// points of a figure lie near one another.
#[test]
fn no_dot_covers_a_letter() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    let mut names = 0;
    for (tilt, focal_distance, position) in [
        (0.0, 10.6, [32.5, 24.5]),
        (0.0, 10.6, [20.5, 38.5]),
        (0.0, 3.0, [60.5, 4.5]),
        (0.0, 40.0, [10.5, 44.5]),
        (6.0, 10.6, [25.5, 33.5]),
    ] {
        let lens = &mut settings.estimator.lens;
        (lens.tilt_degrees, lens.focal_distance) = (tilt, focal_distance);
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let heights = (0..12_u8).map(|step| 90.0 + 30.0 * f32::from(step));
        let sizes = heights.flat_map(|height| [640.0, 936.0, 1580.0].map(|width| [width, height]));
        for (entry, size) in sizes.flat_map(|size| VIEWS.iter().map(move |entry| (entry, size))) {
            let drawing = diagram::draw(&diagram, &Look { view: entry.view, size, ..LOOK });
            let what = format!("{} at {position:?} in {size:?}", entry.name);
            for pane in &drawing.panes {
                let drawing = Drawing { panes: vec![pane.clone()], ..drawing.clone() };
                for (text, [left, top, right, bottom]) in boxes(&drawing) {
                    names += usize::from(text.len() == 1);
                    for shape in &pane.shapes {
                        let Shape::Dot { at: [x, y], radius, .. } = shape else { continue };
                        let beside = (left - x).max(x - right).max(0.0);
                        let apart = (top - y).max(y - bottom).max(0.0);
                        assert!(beside.hypot(apart) >= *radius, "{what}: a dot at {x} {y} covers '{text}'");
                    }
                }
            }
            if matches!(entry.view, View::Layout | View::TwoRays) {
                letters_stand_at_their_dots(&drawing, &what);
            }
            // Where there is room, no letter of a point is left out that the figure shows.
            let points = [diagram.hit.map(|hit| hit.z), diagram.focus.map(|(depth, _)| depth)];
            let all_shown = points.iter().all(|depth| depth.is_some_and(|depth| depth < diagram.reach));
            let letters: &[&str] = match entry.view {
                View::Layout => &["l", "q", "r", "p"],
                View::TwoRays => &["l", "q", "r", "viewX", "viewY"],
                View::CrossSection if all_shown => &["q", "p", "h"],
                _ => &[],
            };
            let texts = texts(&drawing);
            let missing = letters.iter().find(|letter| !texts.contains(letter));
            assert!(size[1] < 240.0 || missing.is_none(), "{what}: no {missing:?}");
        }
    }
    assert!(names > 500, "only {names} letters were seen");
}
