//! The rays of the drawing, and where they meet.

use super::common::{Gpu, prove, small};
use super::*;
use anyhow::{Result, ensure};
use glam::DVec3;
use thinlens::diagram::{self, Look, Point, Role, Side, View};
use thinlens::scene::{CameraModel, Hole};

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
