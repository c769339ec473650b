//! Scenes, and points, that several tests look at.

use std::f64::consts::FRAC_1_SQRT_2;

/// Points of the unit square, and where Shirley and Chiu's map takes them: centre, axes and corners.
pub const FIXED_POINTS: [([f64; 2], [f64; 2]); 10] = [
    ([0.5, 0.5], [0.0, 0.0]),
    ([1.0, 0.5], [1.0, 0.0]),
    ([0.0, 0.5], [-1.0, 0.0]),
    ([0.5, 1.0], [0.0, 1.0]),
    ([0.5, 0.0], [0.0, -1.0]),
    ([1.0, 1.0], [FRAC_1_SQRT_2, FRAC_1_SQRT_2]),
    ([0.0, 1.0], [-FRAC_1_SQRT_2, FRAC_1_SQRT_2]),
    ([0.0, 0.0], [-FRAC_1_SQRT_2, -FRAC_1_SQRT_2]),
    ([1.0, 0.0], [FRAC_1_SQRT_2, -FRAC_1_SQRT_2]),
    ([0.75, 0.5], [0.5, 0.0]),
];

/// A scene with every kind of shape, material and light, seen from close by.
pub const EVERYTHING: &str = r#"
[camera]
eye = [0.3, 1.5, 4]
look_at = [0, 0.8, 0]
vfov_degrees = 55
lens_diameter = 0.4
focal_distance = 3.6
[background]
horizon = [0.9, 0.6, 0.4]
zenith = [0.1, 0.2, 0.6]
[ambient]
radiance = 0.4
[[directional]]
direction = [0.5, 1, 0.7]
radiance = 2
[[point]]
position = [-2, 3, 2]
color = [1, 0.7, 0.5]
radiance = 1.5
[matte.floor]
ka = 0.5
kd = 0.8
color = { even = [0.8, 0.8, 0.7], odd = [0.2, 0.3, 0.3], size = 0.7 }
[phong.shiny]
ka = 0.3
kd = 0.6
ks = 0.4
exponent = 25
color = [0.3, 0.1, 0.6]
[mirror.glass]
kr = 0.8
color = [0.9, 1, 0.8]
ks = 0.3
exponent = 80
[emissive.lamp]
radiance = 3
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
[[sphere]]
center = [-0.9, 0.7, 0.2]
radius = 0.7
material = "glass"
[[sphere]]
center = [1.6, 1.8, -1]
radius = 0.2
material = "lamp"
[[box]]
lower = [0.4, 0, -0.6]
upper = [1.2, 1.1, 0.3]
material = "shiny"
[[triangle]]
vertices = [[-0.2, 0, 1], [0.5, 0, 1.2], [0.1, 0.9, 0.7]]
material = "glass"
"#;

/// A scene for the integrator "path", with every kind of shape and material that it renders, and bodies in bodies.
pub const PATHS: &str = r#"
integrator = "path"
max_bounces = 8
[camera]
eye = [0.3, 1.5, 4]
look_at = [0, 0.7, 0]
vfov_degrees = 50
lens_diameter = 0.2
focal_distance = 3.6
[background]
horizon = [0.9, 0.8, 0.7]
zenith = [0.2, 0.4, 0.8]
[matte.floor]
color = { even = [0.8, 0.8, 0.7], odd = [0.2, 0.3, 0.3], size = 0.7 }
[mirror.silver]
kr = 0.9
color = [0.9, 1, 0.9]
[metal.gold]
color = [1, 0.77, 0.34]
roughness = 0.45
[metal.polished]
color = [0.7, 0.6, 0.5]
[glass.clear]
[glass.green]
index = 1.4
color = [0.3, 0.9, 0.5]
color_distance = 0.4
[glass.air]
index = 1
[glass.frosted]
index = 1.6
roughness = 0.35
[emissive.lamp]
radiance = 4
[plastic.red]
color = [0.8, 0.2, 0.1]
roughness = 0.3
[plastic.billiard]
color = [0.9, 0.9, 0.7]
index = 1.7
[standard.painted]
color = [0.3, 0.5, 0.9]
metallic = 0.4
roughness = 0.5
[emissive.tube]
color = [1, 0.3, 0.2]
radiance = 6
[[sphere]]
center = [0.7, 1.6, 1]
radius = 0.1
material = "tube"
velocity = [9, 0, 0]
[[box]]
lower = [-2.4, 1.9, -0.3]
upper = [-2, 2, 0.6]
material = "lamp"
[[cylinder]]
start = [0, 2.2, 0.2]
end = [0.9, 2.3, 0.5]
radius = 0.06
material = "tube"
[[triangle]]
vertices = [[-1, 2.4, 1], [-0.2, 2.4, 1.2], [-0.6, 2.5, 0.4]]
material = "lamp"
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
[[sphere]]
center = [-0.5, 0.25, 1.5]
radius = 0.25
material = "red"
[[sphere]]
center = [-1.6, 0.25, 1.2]
radius = 0.25
material = "billiard"
[[sphere]]
center = [0.7, 0.2, 1.8]
radius = 0.2
material = "painted"
[[sphere]]
center = [-1.1, 0.6, 0.2]
radius = 0.6
material = "green"
[[sphere]]
center = [-1.1, 0.6, 0.2]
radius = 0.35
material = "air"
[[sphere]]
center = [-1.1, 1.06, 0.2]
radius = 0.05
material = "lamp"
[[sphere]]
center = [-0.75, 0.7, 0.5]
radius = 0.06
material = "floor"
[[sphere]]
center = [0.1, 0.4, 1.1]
radius = 0.4
material = "clear"
[[sphere]]
center = [1.1, 0.5, 0.8]
radius = 0.5
material = "frosted"
[[sphere]]
center = [1.6, 1.8, -1]
radius = 0.4
material = "lamp"
[[sphere]]
center = [-0.4, 0.5, -1.2]
radius = 0.5
material = "gold"
[[box]]
lower = [0.6, 0, -1.4]
upper = [1.4, 1.1, -0.6]
material = "silver"
[[cylinder]]
start = [-1.9, 0, -1]
end = [-1.9, 1.6, -1]
radius = 0.3
material = "polished"
[[triangle]]
vertices = [[-2.5, 0, -2], [2.5, 0, -2], [0, 2.5, -2.2]]
material = "gold"
[[rectangle]]
corner = [-0.5, 2.2, -0.3]
edges = [[0.6, 0, 0.3], [-0.1, 0.3, 0.2]]
material = "lamp"
velocity = [-6, 0, 3]
[[disc]]
center = [-1.2, 1.9, 0.6]
normal = [0.3, -1, 0.2]
radius = 0.25
material = "lamp"
velocity = [0, 5, 6]
"#;

/// A room seen from inside, and a ball beyond its lamp that must not shadow anything.
pub const ROOM: &str = r#"
[camera]
eye = [0.2, 0.1, 1.8]
look_at = [0, 0, 0]
vfov_degrees = 80
lens_diameter = 0.1
focal_distance = 2
[[point]]
position = [0.3, 0.6, 0.4]
radiance = 3
[matte.wall]
ka = 0
kd = 0.8
color = { even = [0.9, 0.8, 0.7], odd = [0.3, 0.4, 0.5], size = 0.37 }
[[box]]
lower = [-1.5, -1, -2]
upper = [1.5, 1.2, 2]
material = "wall"
[[sphere]]
center = [0.5, 0.95, 0.6]
radius = 0.15
material = "wall"
"#;

/// Two mirrors whose reflections of each other overflow.
pub const BURNING: &str = r#"
[camera]
eye = [0, 0, 0]
look_at = [0, 0, -1]
vfov_degrees = 60
lens_diameter = 0
focal_distance = 1
[background]
color = [1e9, 1e9, 1e9]
[mirror.burning]
color = [1e9, 1e9, 1e9]
kr = 1e9
[[sphere]]
center = [-0.6, 0, -3]
radius = 0.5
material = "burning"
[[sphere]]
center = [0.6, 0, -3]
radius = 0.5
material = "burning"
"#;

/// Triangles, each larger than all before it, and a wall behind them: a deep tree. Rays that pass the
/// triangles by in the other halves of their boxes leave something behind at every node, and find the
/// wall last of all.
pub fn one_behind_the_other() -> String {
    let mut toml = String::from("[emissive.m]\nradiance = 1\n");
    let mut at = 1.0;
    for _ in 0..160 {
        let beside = 0.8 * at;
        toml += &format!(
            "[[triangle]]\nvertices = [[{at}, -{at}, -{at}], [{at}, {beside}, -{at}], [{at}, -{at}, {beside}]]\nmaterial = \"m\"\n"
        );
        at *= 1.13;
    }
    toml += &format!(
        "[[box]]\nlower = [{at}, -{at}, -{at}]\nupper = [{}, {at}, {at}]\nmaterial = \"m\"\n",
        1.1 * at
    );
    toml
}

/// The diameter of the lens and its focal distance, and how deep a lamp stands, for [`a_lamp_at_night`].
pub struct Night {
    pub lens: f64,
    pub focal_distance: f64,
    pub depth: f64,
}

impl Night {
    /// A night whose lamps blur over `across` pixels of a picture of this height, by `D (1/F - 1/z) k`.
    pub fn new(height: u32, across: f64) -> Self {
        let (lens, depth) = (6.0, 100.0);
        let k = f64::from(height) / 2.0 / 20f64.to_radians().tan();
        Self { lens, focal_distance: 1.0 / (across / (lens * k) + 1.0 / depth), depth }
    }

    /// How wide the cone of rays of a film point is at the lamp.
    pub fn cone(&self) -> f64 {
        self.lens * (self.depth - self.focal_distance) / self.focal_distance
    }

    /// The camera, and a dark sky.
    pub fn toml(&self) -> String {
        format!(
            "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = {}\n\
             focal_distance = {}\n[background]\ncolor = [0.02, 0.02, 0.02]\n",
            self.lens, self.focal_distance
        )
    }
}

/// A lamp in the middle of the night, so far out of focus that its disc is `across` pixels wide in a picture of
/// this height. So large a share of the rays of the disc's pixels meets it.
pub fn a_lamp_at_night(height: u32, across: f64, share: f64, radiance: f64) -> String {
    let night = Night::new(height, across);
    let radius = 0.5 * night.cone() * share.sqrt();
    format!(
        "{}[emissive.lamp]\nradiance = {radiance}\n[[sphere]]\ncenter = [0, 0, -{}]\nradius = {radius}\n\
         material = \"lamp\"\n",
        night.toml(),
        night.depth
    )
}
