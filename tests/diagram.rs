//! The drawing of the optics: its points and lines against the equations, on the device's own rays.

mod common;

use anyhow::{Result, ensure};
use common::{Gpu, prove, scene_of, small};
use glam::DVec3;
use std::collections::BTreeSet;
use thinlens::diagram::{
    self, Diagram, Drawing, KEPT, LETTERS, Line, Look, Outline, Point, Role, Shape, Side, VIEWS, View,
};
use thinlens::renderer::{Excerpt, Question};
use thinlens::scene::{Aperture, CameraModel, Hole};
use thinlens::settings::Settings;

const RAYS: u32 = 9;

fn drawn(gpu: &Gpu, settings: &Settings, position: [f32; 2]) -> Result<Diagram> {
    let picked =
        gpu.renderer(settings).pick(Question { position, fan: RAYS, samples: RAYS })?.expect("an answer");
    Ok(Diagram::new(&settings.estimator, &picked))
}

/// Where a line is at a depth.
fn at([from, to]: Line, depth: f64) -> DVec3 {
    from + (to - from) * ((depth - from.z) / (to - from).z)
}

/// A film position on the view plane at depth one, by the picture's edges: right, up, forward.
fn slope(settings: &Settings, [x, y]: [f32; 2]) -> DVec3 {
    let [width, height] = settings.estimator.size.map(f64::from);
    let half = (0.5 * settings.estimator.camera.vfov_radians).tan();
    let up = half * (1.0 - 2.0 * f64::from(y) / height);
    DVec3::new(half * (2.0 * f64::from(x) - width) / height, up, 1.0)
}

/// Catches a drawing that is turned, mirrored, beside the pixel or of another lens: p must be where the device
/// looks, q on the way to it, every ray must start on the lens and pass p, and the fan must end at its rim.
#[test]
fn p_lies_where_the_device_focuses() {
    let mut oval = small("version-4");
    oval.estimator.aperture.anamorphic = 2.0;
    let check = |gpu: &Gpu| -> Result<String> {
        let plain = small("version-4");
        let mut worst = 0.0_f64;
        for (settings, position) in
            [(&plain, [32.5, 24.5]), (&plain, [5.5, 40.5]), (&plain, [60.5, 30.5]), (&oval, [10.5, 38.5])]
        {
            let lens = settings.estimator.lens;
            let (radius, focal_distance) = (f64::from(lens.diameter) / 2.0, f64::from(lens.focal_distance));
            let half_width = radius / f64::from(settings.estimator.aperture.anamorphic);
            let diagram = drawn(gpu, settings, position)?;
            let (depth, p) = diagram.focus.expect("a lens has a focal plane");
            let expected = focal_distance * slope(settings, position);
            ensure!((depth - focal_distance).abs() < 1e-6, "the focal plane is drawn at {depth}");
            let mut near = |what: &str, point: DVec3, expected: DVec3| -> Result<()> {
                let off = point.distance(expected) / focal_distance;
                worst = worst.max(off);
                ensure!(off < 1e-4, "{position:?}: {what} is at {point}, not {expected}");
                Ok(())
            };
            near("p", p, expected)?;
            near("q", diagram.q, expected * (diagram.view_plane / focal_distance))?;
            for ray in diagram.fan_up.iter().chain(&diagram.fan_across).chain([&diagram.centre]) {
                near("a ray", at(*ray, focal_distance), expected)?;
            }
            // Samples are of anywhere in the pixel.
            ensure!(diagram.samples.len() == RAYS as usize, "{} samples", diagram.samples.len());
            for ray in &diagram.samples {
                ensure!(ray[0].z.abs() < 1e-6 && ray[0].length() < radius * 1.0001, "{} is no lens", ray[0]);
            }
            let rims = [(&diagram.fan_up, radius * DVec3::Y), (&diagram.fan_across, half_width * DVec3::X)];
            for (fan, rim) in rims {
                near("a rim", fan[0][0], -rim)?;
                near("a rim", fan[fan.len() - 1][0], rim)?;
            }
            let [width, height] = diagram.half_aperture;
            near("the opening", DVec3::new(width, height, 0.0), DVec3::new(half_width, radius, 0.0))?;
            near("the centre", diagram.centre[0], DVec3::ZERO)?;
            let hit = diagram.hit.expect("a surface");
            near("the hit", hit, at(diagram.centre, hit.z))?;
        }
        Ok(format!("within {worst:.1e} F"))
    };
    prove(check, &["pick", "fan", "focal_sphere"]);
}

/// Catches an image side that is not the lens's: light must cross where `1 / i = 1 / f - 1 / z` says, spread on
/// the film over the circle of confusion around p', and turn the picture upside down; and a hole must bend
/// nothing.
#[test]
fn light_spreads_on_the_film_over_the_circle_of_confusion() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    for focal_distance in [3.0, 10.6, 40.0] {
        settings.estimator.lens.focal_distance = focal_distance;
        let (focal_distance, position) = (f64::from(focal_distance), [20.5, 38.5]);
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let (image, hit) = (&diagram.image, diagram.hit.expect("a surface"));
        let (v, z) = (0.012 / (0.5 * settings.estimator.camera.vfov_radians).tan() / 0.05, hit.z);
        assert!((image.film_distance / v - 1.0).abs() < 1e-9, "the film stands {} away", image.film_distance);
        let p = -v * slope(&settings, position);
        assert!(image.p.distance(p) < 1e-5 * v, "p' is at {}, not {p}", image.p);

        let diameter = f64::from(settings.estimator.lens.diameter);
        let spread = diameter * v * (z.recip() - focal_distance.recip()).abs();
        assert!((image.blur / spread - 1.0).abs() < 1e-4, "{} wide, not {spread}", image.blur);
        let pixels = spread * 24.0 / v / (0.5 * settings.estimator.camera.vfov_radians).tan();
        assert!((image.blur_pixels / pixels - 1.0).abs() < 1e-4, "{} px, not {pixels}", image.blur_pixels);

        let crossing = (v.recip() + focal_distance.recip() - z.recip()).recip();
        assert!((image.crossing.expect("it is real") / crossing - 1.0).abs() < 1e-6);
        let meets = -hit * (crossing / z);
        for line in image.light_up.iter().chain(&image.light_across) {
            let off = at(*line, -crossing).distance(meets);
            assert!(off < 1e-5 * v, "light passes {off} beside the picture of what is seen");
            let on_film = at(*line, -v).distance(p);
            assert!(on_film < 0.5 * spread * 1.0001 + 1e-5 * v, "light falls {on_film} beside p'");
        }
        let rims = [0, image.light_up.len() - 1].map(|i| at(image.light_up[i], -v));
        assert!(
            (rims[0].distance(rims[1]) / spread - 1.0).abs() < 1e-3,
            "the fan is not as wide as its blur"
        );
    }

    settings.estimator.model = CameraModel::Hole;
    settings.estimator.hole = Hole { diameter: 0.1, upright: false };
    let diagram = drawn(&gpu, &settings, [20.5, 10.5]).expect("it is drawn");
    let (image, hit) = (&diagram.image, diagram.hit.expect("a surface"));
    assert!(diagram.focus.is_none() && image.crossing.is_none(), "a hole does not focus");
    let width = 0.1_f32 as f64 * (1.0 + image.film_distance / hit.z);
    assert!((image.blur / width - 1.0).abs() < 1e-4, "{} wide, not {width}", image.blur);
    for line in &image.light_up {
        let straight = (line[0] - hit).normalize().cross((line[1] - line[0]).normalize()).length();
        assert!(straight < 1e-5, "a hole bends light by {straight}");
    }
    settings.estimator.model = CameraModel::Pinhole;
    let diagram = drawn(&gpu, &settings, [20.5, 38.5]).expect("it is drawn");
    assert!(diagram.half_aperture == [0.0; 2] && diagram.image.blur < 1e-12, "a pinhole blurs nothing");
}

const LOOK: Look<'_> = Look {
    size: [1100.0, 420.0],
    view: View::Side,
    to_scale: false,
    sharp: Some([8.0, 12.0]),
    kept: [None; KEPT],
    picture: None,
    scale: None,
};

fn shapes(drawing: &Drawing) -> impl Iterator<Item = &Shape> {
    drawing.panes.iter().flat_map(|pane| &pane.shapes)
}

/// The drawn lines that stand for something.
fn lines(drawing: &Drawing, of: Role) -> Vec<&[Point]> {
    let points = shapes(drawing).filter_map(|shape| match shape {
        Shape::Line { points, role, .. } if *role == of => Some(&points[..]),
        _ => None,
    });
    points.collect()
}

/// The drawn areas that stand for something.
fn areas(drawing: &Drawing, of: Role) -> Vec<&[Point]> {
    let corners = shapes(drawing).filter_map(|shape| match shape {
        Shape::Area { corners, role } if *role == of => Some(&corners[..]),
        _ => None,
    });
    corners.collect()
}

/// The drawn dots that stand for something.
fn dots(drawing: &Drawing, of: Role) -> Vec<Point> {
    let places = shapes(drawing).filter_map(|shape| match shape {
        Shape::Dot { at, role, .. } if *role == of => Some(*at),
        _ => None,
    });
    places.collect()
}

/// The smallest and the largest value.
fn range(values: impl Iterator<Item = f32>) -> [f32; 2] {
    values.fold([f32::MAX, f32::MIN], |[low, high], value| [low.min(value), high.max(value)])
}

fn texts(drawing: &Drawing) -> Vec<&str> {
    let text = shapes(drawing).filter_map(|shape| match shape {
        Shape::Text { text, .. } => Some(text.as_str()),
        _ => None,
    });
    text.collect()
}

/// The number before `unit` in the one text of the drawing that contains `start`.
fn number(drawing: &Drawing, start: &str, unit: &str) -> f64 {
    let text =
        texts(drawing).into_iter().find(|text| text.contains(start)).unwrap_or_else(|| panic!("no {start}"));
    let rest = text.split_once(start).expect("it is there").1;
    let number = rest.split_once(unit).unwrap_or_else(|| panic!("no {unit} in {text}")).0;
    number.trim().parse().unwrap_or_else(|_| panic!("no number in {text}"))
}

/// Where a drawn line, or its extension, is at a horizontal place.
fn height([from, to]: [Point; 2], x: f32) -> f32 {
    from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0])
}

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
const COLORS: [(&str, [f64; 3]); 5] = [
    ("floor", [0.4, 0.4, 0.2]),
    ("ball", [0.8, 0.1, 0.2]),
    ("crate", [0.1, 0.3, 0.6]),
    ("sail", [0.2, 0.7, 0.1]),
    ("pipe", [0.5, 0.1, 0.5]),
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
    assert_eq!(seen.len(), 5, "only {seen:?} is seen");
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

/// Catches a side that is told from the depths alone, or from the focal plane on the axis: a tilted lens can be in focus
/// behind itself in some directions, and there everything is too near. Light of a point that is too near meets behind the
/// film, or nowhere.
#[test]
fn the_side_of_a_point_says_where_its_light_meets() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    let mut seen = [0; 3];
    for (degrees, position) in
        [(0.0, [32.5, 24.5]), (8.0, [32.5, 2.5]), (8.0, [32.5, 45.5]), (40.0, [32.5, 4.5])]
            .into_iter()
            .flat_map(|(degrees, position)| [(degrees, position), (-degrees, position)])
    {
        settings.estimator.lens.tilt_degrees = degrees;
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let (depth, _) = diagram.focus.expect("a lens");
        for at in [0.3, 0.8, 1.25, 3.0].map(|share| share * depth.abs()).into_iter().chain([4.0, 10.6, 30.0])
        {
            let moved = diagram.with_point_at(at);
            let meets_before = moved.image.crossing.is_some_and(|way| way < moved.image.film_distance);
            let side = if meets_before { Side::Behind } else { Side::InFront };
            if moved.side() != Some(Side::InFocus) {
                assert_eq!(
                    moved.side(),
                    Some(side),
                    "{at} at {position:?}, {degrees} degrees, focus at {depth}"
                );
            }
            let kind = if depth < 0.0 { 0 } else { 1 + usize::from(side == Side::Behind) };
            seen[kind] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 3), "{seen:?}");
}

/// Catches a dot over a letter, most of all in a low strip, where the points of a figure lie near one another.
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

/// Catches a figure of the book in which the two rays do not meet at p, in which a letter stands at another point, or
/// whose distances are not those of the camera.
#[test]
fn the_figures_of_the_book_agree_with_their_equations() {
    let gpu = Gpu::new();
    let settings = small("version-4");
    for position in [[20.5, 38.5], [40.5, 30.5]] {
        let diagram = drawn(&gpu, &settings, position).expect("it is drawn");
        let (d, (f, _)) = (diagram.view_plane as f32, diagram.focus.expect("a lens"));
        let share = d / f as f32;
        let draw = |view| diagram::draw(&diagram, &Look { view, ..LOOK });
        let dot = |drawing: &Drawing, role| dots(drawing, role)[0];
        let near = |what: &str, point: Point, expected: Point| {
            let off = (point[0] - expected[0]).hypot(point[1] - expected[1]);
            assert!(off < 0.2, "{what} of {position:?} is at {point:?}, not {expected:?}");
        };
        let between = |from: Point, to: Point, share: f32| {
            [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))
        };

        let drawing = draw(View::CrossSection);
        let glass = lines(&drawing, Role::Glass)[0];
        let lens = between(glass[0], glass[1], 0.5);
        let (q, p) = (dot(&drawing, Role::Text), dot(&drawing, Role::Focus));
        near("q", q, between(lens, p, share));
        for ray in lines(&drawing, Role::Ray) {
            near("where a ray meets the focal plane", [p[0], height([ray[0], ray[1]], p[0])], p);
        }

        // The picture on the view plane is not magnified.
        let [low, high] = range(lines(&drawing, Role::Faint)[0].iter().map(|point| point[1]));
        let drawn = f64::from((glass[1][1] - glass[0][1]).abs() / (high - low)) * diagram.half_picture[1];
        let said = number(&drawing, "lens is drawn", "times as wide");
        let reached = drawn / diagram.half_aperture[1];
        assert!((reached / said - 1.0).abs() < 0.06, "the lens is {reached} times as wide, not {said}");

        // The first dot is l.
        let drawing = draw(View::Layout);
        let (l, r) = (dot(&drawing, Role::Glass), dot(&drawing, Role::Primary));
        let (q, p) = (dot(&drawing, Role::Text), dot(&drawing, Role::Focus));
        near("r", r, between(l, p, share));
        let centre = lines(&drawing, Role::Centre)[0];
        near("the end of the centre ray", centre[1], p);
        near("q", q, between(centre[0], p, share));

        let drawing = draw(View::TwoRays);
        let (l, r) = (dot(&drawing, Role::Glass), dot(&drawing, Role::Primary));
        let (q, centre) = (dot(&drawing, Role::Text), lines(&drawing, Role::Centre)[0][0]);
        let width = |[left, right]: [f32; 2]| f64::from(right - left);
        let [rim, picture] = [Role::Glass, Role::Faint].map(|role| {
            let outline = lines(&drawing, role).into_iter().find(|line| line.len() > 3).expect("an outline");
            width(range(outline.iter().map(|point| point[1])))
        });
        let reached = rim / picture * diagram.half_picture[1] / diagram.half_aperture[1];
        let said = number(&drawing, "lens is drawn", "times as wide");
        assert!((reached / said - 1.0).abs() < 0.06, "the lens is {reached} times as wide, not {said}");
        // Both rays come together as they go on, and are at the same place at p.
        let offset = [0, 1].map(|axis| q[axis] + (1.0 - share) * (l[axis] - centre[axis]));
        near("r", r, offset);

        let drawing = draw(View::CircleOfConfusion);
        let film = lines(&drawing, Role::Film)[0][0][0];
        let light = lines(&drawing, Role::Light);
        let falls = range(light.iter().map(|line| height([line[0], line[1]], film)));
        let blurs = lines(&drawing, Role::Blur);
        let c = blurs.iter().find(|line| line.iter().all(|point| point[0] == film)).expect("c");
        let c = range(c.iter().map(|point| point[1]));
        assert!((0..2).all(|end| (c[end] - falls[end]).abs() < 0.2), "c is {c:?}, but light in {falls:?}");
    }
}

/// Catches kept light in the colour of the other side, light of another depth than was asked for, and light that does not
/// meet where it should.
#[test]
fn light_of_three_points_meets_before_on_and_behind_the_film() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    let depth = drawn(&gpu, &settings, [20.5, 38.5]).expect("it is drawn").hit.expect("a surface").z;
    settings.estimator.lens.focal_distance = depth as f32;
    let diagram = drawn(&gpu, &settings, [20.5, 38.5]).expect("it is drawn");
    let look = Look { kept: [Some(0.5 * depth), Some(2.0 * depth)], ..LOOK };
    let drawing = diagram::draw(&diagram, &look);
    let scale = drawing.scale.expect("a section");
    let film = scale.x(-diagram.image.film_distance);
    let meets = |side: Side, at: f64| {
        let light = lines(&drawing, Role::LightOf(side));
        // Half of the lines are in front of the lens. One more may be a mark or an outline.
        let leaving: Vec<_> =
            light.iter().filter(|line| line.len() == 2 && line[1][0] < film - 1.0).collect();
        assert_eq!(leaving.len(), RAYS as usize, "{side:?}");
        let dot = dots(&drawing, Role::LightOf(side))[0];
        assert!((scale.depth(dot[0]) / at - 1.0).abs() < 1e-3, "{side:?} at {}", scale.depth(dot[0]));
        let crossing = diagram.with_point_at(at).image.crossing.expect("it is real");
        let x = scale.x(-crossing);
        let heights = range(leaving.iter().map(|line| height([line[0], line[1]], x)));
        assert!(heights[1] - heights[0] < 0.1, "{side:?}: light passes {heights:?}");
        x
    };
    let [in_front, in_focus, behind] =
        [meets(Side::InFront, 0.5 * depth), meets(Side::InFocus, depth), meets(Side::Behind, 2.0 * depth)];
    assert!(in_front < film - 5.0 && (in_focus - film).abs() < 0.5 && behind > film + 5.0);
    assert!(lines(&drawing, Role::Light).is_empty(), "there is other light");
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

/// How far a place is from the line through two others.
fn beside(place: Point, [from, to]: [Point; 2]) -> f32 {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    ((place[0] - from[0]) * y - (place[1] - from[1]) * x).abs() / x.hypot(y)
}

/// Catches a focal plane of a tilted lens that stands upright, leans to the other side, or belongs to another section than
/// the one that is drawn: the device focuses other pixels of this section in the plane that is drawn. And light that does not
/// meet in one place, blur that is not where light falls, and a depth of field that is not tilted with the plane.
#[test]
fn the_focal_plane_is_tilted_as_the_device_focuses() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    for (degrees, direction, view, to_scale) in [
        (8.0, 0.0, View::Side, false),
        (-5.0, 30.0, View::Side, true),
        (12.0, 70.0, View::Above, false),
        (3.0, 200.0, View::Above, true),
    ] {
        let lens = &mut settings.estimator.lens;
        (lens.tilt_degrees, lens.tilt_direction_degrees) = (degrees, direction);
        let focal_distance = f64::from(lens.focal_distance);
        let pixel = [25.5, 33.5];
        let diagram = drawn(&gpu, &settings, pixel).expect("it is drawn");
        let sharp = [8.0, 12.0];
        let look = Look { view, to_scale, sharp: Some(sharp), ..LOOK };
        let drawing = diagram::draw(&diagram, &look);
        let scale = drawing.scale.expect("a section");
        let line = lines(&drawing, Role::Focus)[0];
        let line = [line[0], line[1]];
        let what = format!("{degrees} degrees to {direction}, {view:?}");
        let leans = (line[1][0] - line[0][0]).abs();
        assert!(leans > 3.0, "{what}: it stands upright");
        let section = &drawing.panes[1];
        for end in line {
            assert!(end[0] >= scale.lens[0] && end[1] >= section.min[1] && end[1] <= section.max[1]);
        }
        let band = areas(&drawing, Role::Sharp)[0];
        let mut seen = 0;
        for step in 0..8_u8 {
            let along = 6.0 * f32::from(step) + 0.5;
            let position = if view == View::Above { [along, pixel[1]] } else { [pixel[0], along] };
            let (depth, p) = drawn(&gpu, &settings, position).expect("it is drawn").focus.expect("a lens");
            if !(0.0..=40.0).contains(&depth) {
                continue;
            }
            let off = beside(scale.place(p), line);
            assert!(off < 0.3, "{what}: {position:?} is focused {off} beside the focal plane");
            // The limits are planes too, whose inverse depth differs by the same amount everywhere.
            for limit in sharp {
                let at = p * (depth * (depth.recip() + limit.recip() - focal_distance.recip())).recip();
                let place = scale.place(at);
                let edges = (0..band.len()).map(|number| [band[number], band[(number + 1) % band.len()]]);
                let off = edges.map(|edge| beside(place, edge)).fold(f32::MAX, f32::min);
                let is_shown = place[1] > section.min[1] && place[1] < section.max[1];
                assert!(off < 0.3 || !is_shown || at.z < 0.0, "{what}: the limit {limit} is {off} beside it");
            }
            seen += 1;
        }
        assert!(seen > 2, "{what}: only {seen} pixels");

        let film = scale.x(-diagram.image.film_distance);
        let crossing = scale.x(-diagram.image.crossing.expect("light meets"));
        let leaving: Vec<[Point; 2]> = (lines(&drawing, Role::Light).into_iter())
            .map(|line| [line[line.len() - 2], line[line.len() - 1]])
            .filter(|[_, to]| to[0] < film)
            .collect();
        assert_eq!(leaving.len(), RAYS as usize, "{what}");
        let heights = range(leaving.iter().map(|line| height(*line, crossing)));
        assert!(heights[1] - heights[0] < 0.05, "{what}: light meets between {heights:?}");
        let falls = range(leaving.iter().map(|line| height(*line, film)));
        let blurs = lines(&drawing, Role::Blur);
        let blur =
            blurs.iter().find(|line| line.iter().all(|at| (at[0] - film).abs() < 0.01)).expect("a blur");
        let blur = range(blur.iter().map(|at| at[1]));
        assert!((0..2).all(|end| (blur[end] - falls[end]).abs() < 0.1), "{what}: {blur:?}, not {falls:?}");
    }

    // By the hinge rule, the plane turns around a line that lies f / sin(tilt) below the lens.
    let estimator = &mut settings.estimator;
    (estimator.lens.tilt_degrees, estimator.lens.tilt_direction_degrees) = (40.0, 0.0);
    let diagram = drawn(&gpu, &settings, [32.5, 20.5]).expect("it is drawn");
    let drawing = diagram::draw(&diagram, &Look { size: [900.0, 900.0], to_scale: true, ..LOOK });
    let scale = drawing.scale.expect("a section");
    let (sine, cosine) = 40.0_f64.to_radians().sin_cos();
    let f = cosine / (diagram.image.film_distance.recip() + f64::from(10.6_f32).recip());
    let below = scale.lens[1] + (f / sine * scale.fan) as f32;
    let hinge = dots(&drawing, Role::Focus).into_iter().find(|dot| dot[0] == scale.lens[0]).expect("a hinge");
    assert!((hinge[1] - below).abs() < 0.1, "the hinge line is at {hinge:?}, not {below}");
    assert!(texts(&drawing).contains(&"hinge line"), "it has a name");
    let line = lines(&drawing, Role::Focus)[0];
    assert!(beside(hinge, [line[0], line[1]]) < 0.1, "the focal plane does not go through the hinge line");

    // The figures of the book.
    let lens = &mut settings.estimator.lens;
    (lens.tilt_degrees, lens.tilt_direction_degrees) = (6.0, 0.0);
    let diagram = drawn(&gpu, &settings, [25.5, 33.5]).expect("it is drawn");
    let draw = |view| diagram::draw(&diagram, &Look { view, ..LOOK });
    let drawing = draw(View::CrossSection);
    let p = dots(&drawing, Role::Focus)[0];
    let glass = lines(&drawing, Role::Glass)[0];
    let plane = lines(&drawing, Role::Focus)[0];
    assert!((plane[1][0] - plane[0][0]).abs() > 20.0 && beside(p, [plane[0], plane[1]]) < 0.2, "{plane:?}");
    for ray in lines(&drawing, Role::Ray) {
        let off = [beside(p, [ray[0], ray[1]]), beside(ray[0], [glass[0], glass[1]])];
        assert!(
            off[0].max(off[1]) < 0.2,
            "a ray passes {} beside p, and starts {} beside the lens",
            off[0],
            off[1]
        );
    }
    let drawing = draw(View::Layout);
    let far = lines(&drawing, Role::Focus)[0];
    let across = |from: usize, to: usize| (far[to][1] - far[from][1]) / (far[to][0] - far[from][0]);
    assert!(far.len() == 4 && across(1, 2).abs() < 3.0, "the focal plane stands upright: {far:?}");
    // The rays start on the rim, which is tilted with the lens.
    let rim = lines(&drawing, Role::Glass)[0];
    let l = dots(&drawing, Role::Glass)[0];
    let off = rim.iter().map(|at| (at[0] - l[0]).hypot(at[1] - l[1])).fold(f32::MAX, f32::min);
    assert!(off < 0.2, "l is {off} beside the rim of the lens");
    let primary = lines(&drawing, Role::Primary)[0];
    let p = *dots(&drawing, Role::Focus).last().expect("p");
    assert!((primary[1][0] - p[0]).hypot(primary[1][1] - p[1]) < 0.2, "the primary ray ends beside p");
}
