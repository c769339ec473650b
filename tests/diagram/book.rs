//! The figures of the book.

use super::common::{Gpu, small};
use super::*;
use thinlens::diagram::{self, Drawing, Look, Point, Role, View};

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
