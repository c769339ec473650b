//! What is drawn of film, lens, objects and depth of field, and where.

use super::common::{Gpu, scene_of, small};
use super::*;
use glam::DVec3;
use std::collections::BTreeSet;
use thinlens::diagram::{self, Look, Outline, Point, Role, Shape, View};
use thinlens::renderer::Excerpt;
use thinlens::scene::{Aperture, CameraModel};

/// Catches a stretch that is said and not reached, most of all off the axis; light that is not drawn through one
/// place, which is where the drawing says that it meets; two sides of the lens that do not fit together; and a blur on
/// the film that is not where the drawn light falls.
#[test]
fn what_is_drawn_is_magnified_as_the_drawing_says() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    for (position, diameter, above) in [
        ([32.5, 24.5], 0.34, false),
        ([20.5, 38.5], 0.34, false),
        ([12.5, 44.5], 0.02, false),
        ([12.5, 40.5], 1.0, true),
    ] {
        settings.estimator.lens.diameter = diameter;
        let view = if above { View::Above } else { View::Side };
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let drawing = diagram::draw(&diagram, &Look { view, ..LOOK });
        let (depth, _) = diagram.focus.expect("a lens");
        let focal_plane = lines(&drawing, Role::Focus)[0][0][0];
        let film = lines(&drawing, Role::Film)[0][0][0];
        let glass = lines(&drawing, Role::Glass)[0];
        let of_glass = |axis: usize| glass.iter().map(move |point| point[axis]);
        let extent = |axis| of_glass(axis).fold(f32::MIN, f32::max) - of_glass(axis).fold(f32::MAX, f32::min);
        let lens = glass[0][0];
        let in_front = f64::from(focal_plane - lens) / depth;
        let behind = f64::from(lens - film) / diagram.image.film_distance;
        let [half_width, half_height] = diagram.half_aperture;
        let fan = f64::from(extent(1)) / (2.0 * if above { half_width } else { half_height });
        for (name, reached) in
            [("depths behind the lens", behind / in_front), ("heights from the centre ray", fan / in_front)]
        {
            let said = number(&drawing, name, "times");
            assert!((reached / said - 1.0).abs() < 0.06, "{position:?}: {name}: {said}, but {reached}");
        }
        // A thin cone is what the stretch is for.
        assert!(extent(1) > 120.0, "{position:?}: the lens is {} high", extent(1));

        let crossing = diagram.image.crossing.expect("light meets") / diagram.image.film_distance;
        let meets = lens - (lens - film) * crossing as f32;
        let light: Vec<[Point; 2]> =
            lines(&drawing, Role::Light).into_iter().map(|points| [points[0], points[1]]).collect();
        let (arriving, leaving): (Vec<_>, Vec<_>) =
            light.into_iter().partition(|line| line.iter().all(|point| point[0] >= lens - 0.01));
        assert!(arriving.len() == RAYS as usize && leaving.len() == RAYS as usize, "each ray on both sides");
        let heights: Vec<f32> = leaving.iter().map(|line| height(*line, meets)).collect();
        for (ray, at) in leaving.iter().zip(&heights) {
            assert!((at - heights[0]).abs() < 0.05, "light passes {} beside where it meets", at - heights[0]);
            let goes_on = arriving.iter().any(|from| (from[1][1] - ray[0][1]).abs() < 0.01);
            assert!(goes_on, "a ray begins at the lens, at {}", ray[0][1]);
        }
        let meeting = dots(&drawing, Role::Blur);
        let is_marked = meeting.iter().any(|dot| (dot[0] - meets).hypot(dot[1] - heights[0]) < 0.1);
        assert!(is_marked, "light meets at {meets} {}, but the dots are at {meeting:?}", heights[0]);
        let falls = range(leaving.iter().map(|line| height(*line, film)));
        let blurs = lines(&drawing, Role::Blur);
        let blur = blurs.iter().find(|line| line.iter().all(|point| point[0] == film)).expect("a blur");
        let drawn = range(blur.iter().map(|point| point[1]));
        assert!((0..2).all(|end| (drawn[end] - falls[end]).abs() < 0.1), "{drawn:?}, but light in {falls:?}");

        let drawing = diagram::draw(&diagram, &Look { view, to_scale: true, ..LOOK });
        let scale = drawing.scale.expect("a section");
        assert_eq!([scale.behind, scale.fan, scale.rise], [scale.in_front; 3]);
        assert!(texts(&drawing).contains(&"to scale"), "it says so");
    }
}

/// Catches a picture of the film with another size than it says, another shape than the aperture's, or turned: a
/// lens point, by the device, sees the point beside the pixel just where the picture has the light of this lens point.
#[test]
fn the_film_shows_the_shape_of_the_blur() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    settings.estimator.aperture.blades = 3;
    settings.estimator.aperture.rotation_degrees = 30.0;
    let k = settings.estimator.camera.view_distance_pixels(settings.estimator.size[1]);
    let mut directions = [0; 2];
    for focal_distance in [5.0, 18.0] {
        settings.estimator.lens.focal_distance = focal_distance;
        let diagram = drawn(&gpu, &settings, [32.5, 24.5]).expect("it is drawn");
        let (image, hit) = (&diagram.image, diagram.hit.expect("a surface"));
        assert!((2.0 * image.blur_radius.abs() / image.blur_pixels - 1.0).abs() < 1e-6);
        // Seen from the top of the lens, where the corner of the iris is, the point is so much higher in the picture.
        let top = diagram.half_aperture[1];
        let seen_from_top = (hit.y - top) / hit.z + top / f64::from(focal_distance);
        let higher = (seen_from_top - hit.y / hit.z) * k;
        let corners = &image.openings[0].corners;
        let corner = corners.iter().max_by(|a, b| a[1].total_cmp(&b[1])).expect("corners");
        assert!((corner[1] - 1.0).abs() < 1e-6 && corner[0].abs() < 1e-6, "the corner is at {corner:?}");
        assert!((corner[1] * image.blur_radius / higher - 1.0).abs() < 1e-4, "it is turned");
        directions[usize::from(higher > 0.0)] += 1;

        // A ray of the device from there, of the pixel where the film has this light, meets the point.
        let seen = drawn(&gpu, &settings, [32.5, (24.5 - higher) as f32]).expect("it is drawn");
        let meets = at(seen.fan_up[RAYS as usize - 1], hit.z);
        assert!(meets.distance(hit) < 1e-4 * hit.z, "the device sees {meets}, not {hit}");

        let drawing = diagram::draw(&diagram, &LOOK);
        let said = number(&drawing, "circle of confusion:", "pixels");
        assert!((image.blur_pixels / said - 1.0).abs() < 0.06, "{said} pixels, but {}", image.blur_pixels);
        let grid = lines(&drawing, Role::Grid);
        let upright: Vec<f32> =
            grid.iter().filter(|line| line[0][0] == line[1][0]).map(|line| line[0][0]).collect();
        let pixel = upright[1] - upright[0];
        let outline =
            lines(&drawing, Role::Blur).into_iter().max_by_key(|line| line.len()).expect("an outline");
        let [low, high] = range(outline.iter().map(|point| point[1]));
        // A triangle in a circle is three quarters as high as the circle.
        let shown = f64::from((high - low) / pixel);
        assert!((shown / (0.75 * image.blur_pixels) - 1.0).abs() < 0.01, "{shown} squares high");
        // The light of the middle of the lens falls into the middle of the pixel, which is a square of the grid.
        let square = areas(&drawing, Role::Pixel)[0];
        let [left, right] = range(square.iter().map(|corner| corner[0]));
        let is_line = |x: f32| upright.iter().any(|line| (line - x).abs() < 0.01);
        assert!(is_line(left) && is_line(right), "the pixel from {left} to {right} is no square");
        let middle = 0.5 * (left + right);
        let dots = dots(&drawing, Role::Blur);
        let dot = dots.iter().find(|dot| (dot[0] - middle).abs() < 0.01).expect("a dot in the middle");
        assert_eq!(dot[1] - low > high - dot[1], higher > 0.0, "the picture of the blur is turned");
    }
    assert_eq!(directions, [1, 1], "the blur is upside down in front of the focal plane");
}

/// Catches the outline of another aperture than the renderer's: its area is the one that the exposure is computed from,
/// and the oracle's points lie within and come near every part of its rim.
#[test]
fn outlines_are_those_of_the_apertures() {
    let plain = Aperture::default();
    let apertures = [
        plain.clone(),
        Aperture { anamorphic: 2.0, ..plain.clone() },
        Aperture { blades: 5, rotation_degrees: 20.0, ..plain.clone() },
        Aperture { blades: 6, roundness: 0.5, ..plain.clone() },
        Aperture { cats_eye: 0.6, ..plain.clone() },
    ];
    for (aperture, film) in apertures.iter().flat_map(|of| [(of, [0.0; 2]), (of, [0.6, -0.5])]) {
        let openings = aperture.openings(CameraModel::ThinLens, film);
        let corners = &openings[0].corners;
        let next = |number: usize| corners[(number + 1) % corners.len()];
        // Positive on the left of an edge of the polygon, which goes around anticlockwise.
        let inside = |number: usize, [x, y]: [f64; 2]| {
            let ([ax, ay], [bx, by]) = (corners[number], next(number));
            ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / (bx - ax).hypot(by - ay)
        };
        let area: f64 = (0..corners.len())
            .map(|number| 0.5 * (corners[number][0] * next(number)[1] - corners[number][1] * next(number)[0]))
            .sum();
        let mut nearest = vec![f64::MAX; corners.len()];
        let mut share = 0.0;
        let steps = 200_u32;
        for (x, y) in (0..steps).flat_map(|x| (0..steps).map(move |y| (x, y))) {
            let xi = [x, y].map(|step| (f64::from(step) + 0.5) / f64::from(steps));
            let (point, light) =
                thinlens::reference::aperture::point(aperture, CameraModel::ThinLens, film, xi);
            share += light / f64::from(steps * steps);
            for (number, nearest) in nearest.iter_mut().enumerate() {
                let depth = inside(number, point);
                // The rim between two corners is round, and the polygon is a little smaller.
                assert!(depth > -2e-3, "{aperture:?} at {film:?}: {point:?} is outside");
                let [cx, cy] = corners[number];
                *nearest = nearest.min((point[0] - cx).hypot(point[1] - cy));
            }
        }
        let worst = nearest.into_iter().fold(0.0, f64::max);
        assert!(worst < 0.05, "{aperture:?} at {film:?}: no light within {worst} of a part of the rim");
        let expected = aperture.relative_area() * share * std::f64::consts::PI;
        assert!((area / expected - 1.0).abs() < 3e-3, "{aperture:?} at {film:?}: {area}, not {expected}");
    }
}

/// The colours of the objects below.
const COLORS: [(&str, [f64; 3]); 7] = [
    ("floor", [0.4, 0.4, 0.2]),
    ("ball", [0.8, 0.1, 0.2]),
    ("crate", [0.1, 0.3, 0.6]),
    ("sail", [0.2, 0.7, 0.1]),
    ("pipe", [0.5, 0.1, 0.5]),
    ("board", [0.6, 0.5, 0.1]),
    ("plate", [0.1, 0.6, 0.6]),
];

/// Objects of every shape, each in a colour of its own.
const OBJECTS: &str = r#"
[camera]
eye = [0.3, 1.5, 4]
look_at = [0, 0.8, 0]
vfov_degrees = 55
lens_diameter = 0.4
focal_distance = 3.6
[matte.floor]
ka = 0.3
kd = 0.9
color = [0.4, 0.4, 0.2]
[matte.ball]
ka = 0.3
kd = 0.9
color = [0.8, 0.1, 0.2]
[matte.crate]
ka = 0.3
kd = 0.9
color = [0.1, 0.3, 0.6]
[matte.sail]
ka = 0.3
kd = 0.9
color = [0.2, 0.7, 0.1]
[matte.pipe]
ka = 0.3
kd = 0.9
color = [0.5, 0.1, 0.5]
[matte.board]
color = [0.6, 0.5, 0.1]
[matte.plate]
color = [0.1, 0.6, 0.6]
[[plane]]
point = [0, 0, 0]
normal = [0.1, 1, 0]
material = "floor"
[[sphere]]
center = [-0.9, 0.7, 0.2]
radius = 0.7
material = "ball"
[[box]]
lower = [0.4, 0, -0.6]
upper = [1.2, 1.1, 0.3]
material = "crate"
[[triangle]]
vertices = [[-0.3, 0.1, 1], [0.5, 0.1, 1.2], [0.1, 1.0, 0.7]]
material = "sail"
[[rectangle]]
corner = [-3.2, 0.1, -0.5]
edges = [[1.0, 0, 0.6], [0, 1.4, 0]]
material = "board"
[[disc]]
center = [-0.9, 1.9, 0.2]
normal = [0.2, 0.1, 1]
radius = 0.45
material = "plate"
[[cylinder]]
start = [1.5, 0.1, -0.5]
end = [1.9, 2.0, -1.5]
radius = 0.4
material = "pipe"
"#;

/// Catches outlines of other objects than those that the centre ray passes, in other colours, at other places, or of
/// the other section: the first one that it crosses is that of the object, where the device hits it.
#[test]
fn the_centre_ray_ends_at_the_outline_of_what_it_hits() {
    let gpu = Gpu::new();
    let settings = small("version-4").with_scene(scene_of(OBJECTS));
    let mut seen = BTreeSet::new();
    for (column, row) in (0..8_u8).flat_map(|column| (0..6_u8).map(move |row| (column, row))) {
        let position = [8.0 * f32::from(column) + 3.5, 8.0 * f32::from(row) + 4.5];
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let Some(hit) = diagram.hit else {
            continue;
        };
        let of_name = COLORS.into_iter().find(|(name, _)| *name == diagram.material);
        let expected = DVec3::from_array(of_name.expect("a material").1);
        for (outlines, slope) in
            [(&diagram.outlines_up, diagram.slope.y), (&diagram.outlines_across, diagram.slope.x)]
        {
            let (depth, outline) = first_crossing(outlines, slope);
            let what = format!("{position:?}: {}", diagram.material);
            assert!((depth / hit.z - 1.0).abs() < 3e-3, "{what} at {}, its outline at {depth}", hit.z);
            let linear = DVec3::from_array(outline.color.map(|level| f64::from(level).powf(2.2)));
            let off = linear / linear.max_element() - expected / expected.max_element();
            assert!(off.abs().max_element() < 0.03, "{what} is drawn in {:?}", outline.color);
        }
        seen.insert(diagram.material);
    }
    assert_eq!(seen.len(), 7, "only {seen:?} is seen");
}

/// Where the centre ray crosses an outline first, and which one.
fn first_crossing(outlines: &[Outline], slope: f64) -> (f64, &Outline) {
    let crossings = outlines.iter().flat_map(|outline| {
        let corners = &outline.corners;
        let edges = (0..corners.len()).map(|number| [corners[number], corners[(number + 1) % corners.len()]]);
        let crossing = edges.filter_map(|[a, b]| {
            let [from, to] = [a, b].map(|[depth, aside]| aside - slope * depth);
            ((from < 0.0) != (to < 0.0)).then(|| a[0] + (b[0] - a[0]) * from / (from - to))
        });
        crossing.map(move |depth| (depth, outline))
    });
    crossings.min_by(|a, b| a.0.total_cmp(&b.0)).expect("the ray crosses an outline")
}

/// Catches a depth of field that is drawn elsewhere than where everything is sharp, or that ends before infinity.
#[test]
fn the_depth_of_field_is_a_band() {
    let gpu = Gpu::new();
    let settings = small("version-4");
    let diagram = drawn(&gpu, &settings, [20.5, 38.5]).expect("it is drawn");
    let band = |sharp: [f64; 2]| {
        let drawing = diagram::draw(&diagram, &Look { sharp: Some(sharp), ..LOOK });
        let band = areas(&drawing, Role::Sharp)[0];
        let ends = range(band.iter().map(|corner| corner[0]));
        let words = texts(&drawing).into_iter().find(|text| text.starts_with("sharp from"));
        (ends, words.expect("words").to_owned(), drawing.scale.expect("a section"), drawing.panes[1].max[0])
    };
    let ([near, far], words, scale, _) = band([8.0, 12.0]);
    let off = [near, far].map(|end| scale.depth(end)).into_iter().zip([8.0, 12.0]);
    assert!(off.into_iter().all(|(drawn, depth)| (drawn - depth).abs() < 0.01), "{near} to {far}");
    assert_eq!(words, "sharp from 8.00 to 12.0");
    let ([_, far], words, _, end) = band([8.0, f64::INFINITY]);
    assert!(far == end && words == "sharp from 8.00 to infinity", "{words}, drawn to {far} of {end}");

    let mut settings = settings;
    let sharp = diagram::sharp_depths(&settings).expect("a lens has a depth of field");
    assert!(sharp[0] < 10.6 && sharp[1] > 10.6, "{sharp:?}");
    settings.estimator.model = CameraModel::Hole;
    assert!(diagram::sharp_depths(&settings).is_none(), "a hole has none");
}

/// Catches pixels of the picture at other places than in the picture of the film, beside the pixel, in other colours, or
/// outside of the picture.
#[test]
fn pixels_of_the_picture_stand_beside_the_circle_of_confusion() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    let size @ [width, height] = settings.estimator.size;
    // No two pixels have the same colour.
    let colors: Vec<[u8; 3]> =
        (0..height).flat_map(|y| (0..width).map(move |x| [x as u8, y as u8, 100])).collect();
    for (focal_distance, middle) in [(10.6, [32, 24]), (9.0, [3, 40]), (1.0, [32, 24])] {
        settings.estimator.lens.focal_distance = focal_distance;
        let position = middle.map(|at| at as f32 + 0.5);
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let reach = diagram::draw(&diagram, &LOOK).reach;
        let excerpt = Excerpt::of(&colors, size, middle, reach);
        let drawing = diagram::draw(&diagram, &Look { picture: Some(&excerpt), ..LOOK });
        let square = areas(&drawing, Role::Pixel)[0];
        let (left, top) = (range(square.iter().map(|at| at[0])), range(square.iter().map(|at| at[1])));
        let pixel = left[1] - left[0];
        let [min, max] = drawing.middle_pixel.expect("it is shown");
        assert!(
            (max[0] - min[0] - pixel).abs() < 0.01,
            "its pixels are {} wide, not {pixel}",
            max[0] - min[0]
        );
        assert!(
            (min[1] - top[0]).abs() < 0.01 && min[0] > left[1],
            "it stands at {min:?}, not beside {left:?}"
        );
        let film = drawing.panes[3].max[0];
        assert!(
            (min[0] - film - (left[0] - drawing.panes[3].min[0])).abs() < 0.6,
            "it is not beside the film"
        );

        let squares: Vec<_> = shapes(&drawing)
            .filter_map(|shape| match shape {
                Shape::Square { min, max, role: Role::Shown(color) } => Some((*min, *max, *color)),
                _ => None,
            })
            .collect();
        let shown = (diagram.image.blur_pixels / 0.72).max(5.0);
        let is_whole = shown < 48.0;
        let mut seen = BTreeSet::new();
        for ([l, t], [r, b], color) in squares {
            let offset = [(0.5 * (l + r) - min[0]) / pixel, (0.5 * (t + b) - min[1]) / pixel];
            // A square that is the mean of some pixels has the colour of its middle, unless it is cut off.
            let expected = [0, 1].map(|axis| middle[axis] as f32 + offset[axis] - 0.5);
            let slack = if is_whole { 0.01 } else { 0.51 };
            let is_cut = (r - l).min(b - t) < 0.99 * pixel * (shown / 48.0).ceil() as f32;
            let off = [0, 1].map(|axis| (f32::from(color[axis]) - expected[axis]).abs());
            assert!(is_cut || off[0].max(off[1]) <= slack, "{color:?} at {offset:?} from {middle:?}");
            seen.insert(color);
        }
        let reach = 0.5 * shown;
        let count = |axis: usize| {
            let within = |at: &u32| (f64::from(*at) - f64::from(middle[axis])).abs() - 0.5 < reach;
            (0..size[axis]).filter(within).count()
        };
        if is_whole {
            assert_eq!(seen.len(), count(0) * count(1), "{shown} pixels around {middle:?}");
        } else {
            assert!(seen.len() > 400, "{}", seen.len());
        }
    }
}
