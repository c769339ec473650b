//! The inputs that all others are made from, and the files beside them.

use super::bytes::Part;
use super::{exr, png};
use fastrand::Rng;
use thinlens::scene::BUILTINS;

/// Files that inputs name. They lie in the folder that the program works in.
pub fn write_companions() {
    let write = |name: &str, bytes: &[u8]| std::fs::write(name, bytes).expect("a writable folder");
    write("iris.png", &images()[0]);
    write("part.obj", COLORED_MESH.as_bytes());
    write("input.mtl", MTL.as_bytes());
    write("small.toml", SMALL.as_bytes());
    write("picture.png", &png_pictures()[0]);
    write("picture.exr", &exr_pictures()[0]);
}

const SMALL: &str = "\
[camera]
eye = [0, 1, 9]
look_at = [0, 1, 0]
preset = \"50mm-f1.8\"
focal_distance = 9

[emissive.lamp]
radiance = 2

[[sphere]]
center = [0, 1, 0]
radius = 1
material = \"lamp\"
";

const EVERYTHING: &str = "\
# Every table that there is.
size = [64, 48]
max_bounces = 7

[camera]
eye = [0.5, 1.5, 8.25]
look_at = [0, 1, 0]
up = [0.1, 1, 0]
view_distance = \"4 m\"
pixel_size = 0.5
metres_per_unit = 0.01
model = \"thin-lens\"
f_number = \"f/1.8\"
focal_distance = 8.5
hole_diameter = 0.25
upright = true
blades = 6
blade_rotation_degrees = 15
roundness = 0.25
anamorphic = 1.5
shutter = \"1/50 s\"
iso = 200

[view]
exposure = \"-1/2 EV\"
exposure_lock = false
overlay = \"focus-peaking\"
tolerance = 2.5

[background]
horizon = [0.8, 0.9, 1]
zenith = [0.2, 0.4, 0.8]

[ambient]
color = [1, 0.9, 0.8]
radiance = 0.5

[[point]]
position = [3, 9, 4]
color = [1, 1, 0.5]
radiance = 30
shadows = false

[[directional]]
direction = [1, 2, 3]
radiance = 1.5

[matte.floor]
ka = 0.5
kd = 0.8
color = { even = [1, 1, 1], odd = [0, 0, 0], size = 0.75 }

[phong.ball]
ka = 0.5
kd = 0.5
ks = 0.3
exponent = 20
color = [0.9, 0.1, 0.1]

[mirror.glass]
kr = 0.9
ks = 0.1
exponent = 100
color = [1, 1, 1]

[emissive.\"a lamp\"]
color = [1, 0.5, 0]
radiance = 12

[[sphere]]
center = [0, 1, 0]
radius = 1
material = \"glass\"
velocity = [0, 0.5, 0]

[[sphere]]
center = [-2, 0.5, 1]
radius = 0.5
material = \"a lamp\"

[[box]]
lower = [1, 0, -1]
upper = [2, 2, 1]
material = \"ball\"

[[triangle]]
vertices = [[-3, 0, -1], [-2, 0, -1], [-3, 2, -1.5]]
material = \"ball\"
velocity = [1, 0, 0]

[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = \"floor\"

[[mesh]]
file = \"part.obj\"
material = \"ball\"
scale = 0.5
rotate_degrees = [0, 45, 10]
position = [2, 0, 2]
velocity = [0, 0, 1]
";

const WITH_IMAGE: &str = "\
size = [9, 7]
sphere = [{ center = [0, 0, 0], radius = 1e-3, material = \"m\" }, { center = [1e6, 0, 0], radius = 5e5, material = \"m\" }]
mesh = [{ file = \"part.obj\", position = [500000.3, 4500000.7, 120.1] }]
point = [{ position = [0, 1e5, 0], radiance = 1e9 }]

[camera]
eye = [0, 0, 5]
look_at = [0, 0, 0]
vfov_degrees = 40.5
model = \"pinhole\"
focal_distance = 5
aperture_image = \"iris.png\"

[background]
color = [0, 0, 0]

[matte]
m = { ka = 1, kd = 1, color = [0.5, 0.5, 0.5] }
";

pub const AROUND_MESH: &str = "\
[camera]
eye = [0, 0, 9]
look_at = [0, 0, 0]
vfov_degrees = 40
lens_diameter = 0.1
focal_distance = 9

[[mesh]]
file = \"input.obj\"
scale = 0.01
rotate_degrees = [10, 20, 30]
position = [0, 1, 1000]
velocity = [1, 0, 0]
";

pub const SCENE_WORDS: [&str; 80] = [
    "[sphere]",
    "[[sphere]]",
    "[[box]]",
    "[box]",
    "[[camera]]",
    "[camera]",
    "[view]",
    "[[mesh]]",
    "[mesh]",
    "[matte]",
    "[[matte.floor]]",
    "[phong.floor]",
    "[a.b.c]",
    "size",
    "max_bounces",
    "eye",
    "look_at",
    "up",
    "vfov_degrees",
    "view_distance",
    "pixel_size",
    "metres_per_unit",
    "model",
    "sensor",
    "full-frame",
    "30x20",
    "focal_length",
    "focus_breathing",
    "lens_diameter",
    "f_number",
    "focal_distance",
    "hole_diameter",
    "upright",
    "blades",
    "blade_rotation_degrees",
    "roundness",
    "anamorphic",
    "cats_eye",
    "aperture_image",
    "shutter",
    "iso",
    "preset",
    "exposure",
    "overlay",
    "tolerance",
    "0.03 mm",
    "\"1/250\"",
    "\"2,8\"",
    "\"f/2.8\"",
    "\"85 mm\"",
    "\"1e9 km\"",
    "\"30°\"",
    "\"+2 EV\"",
    "\"ISO 400\"",
    "center",
    "radius",
    "material",
    "velocity",
    "file",
    "scale",
    "pinhole",
    "hole",
    "thin-lens",
    "depth",
    "error",
    "none",
    "eye-8mm",
    "50mm-f1.2",
    "true",
    "false",
    "1979-05-27",
    "input.toml",
    "iris.png",
    "part.obj",
    "\"\"\"",
    "'",
    "[",
    "{",
    "}",
    "=",
];

pub fn scenes() -> Vec<Vec<u8>> {
    let built_in = BUILTINS.iter().map(|builtin| builtin.toml);
    // Enough spheres for a tree.
    let many = |count: usize| {
        let sphere = |i: usize| {
            format!(
                "\n[[sphere]]\ncenter = [{}, {i}, {}]\nradius = 0.{}\nmaterial = \"lamp\"\n",
                i % 7,
                i % 5,
                i + 1
            )
        };
        SMALL.to_owned() + &(0..count).map(sphere).collect::<String>()
    };
    let own = [SMALL.to_owned(), EVERYTHING.to_owned(), WITH_IMAGE.to_owned(), many(80)];
    own.into_iter().chain(built_in.map(str::to_owned)).map(String::into_bytes).collect()
}

pub const COLORED_MESH: &str = "\
mtllib input.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 1 1 0.5
usemtl red
f 1 2 3
usemtl blue metal
f 2 4 3
usemtl grey
f 1 2 4
usemtl pictured
f 1 4 3
usemtl unknown
f 3 2 1
";

const EVERY_STATEMENT: &str = "\
# Every statement that is read, and some that are passed over.
mtllib input.mtl
mtllib input.obj missing.mtl
o thing
g one two
s 1
v 0 0 0
v 2 0 0 1.0
v 2 2 0 0.5 0.5 0.5
v 0 2 0
v 1 3 \\
 0.5
v -1 1 0.25
vt 0 0
vt 1 0 0
vn 0 0 1
vn 0.6 0 0.8
usemtl red
f 1 2 3
f 1/1 2/2 3/1
f 1//1 2//2 3//1
f 1/1/1 3/1/1 4/1/2
usemtl blue metal # a comment
f -6 -5 -4 -3 -2 -1
fo 1 2 3 4
f 1 2 3 4 5 6
l 1 2 3
p 1
curv 0 1 1 2
";

const FAN: &str = "\
v 0 0 0
v 1 0 0
v 1 1 0
v 0.5 0.5 0
v 0 1 0
v 0.5 0.7 0
f 1 2 3 4 5 6
f 1 2 3 1 2 3
f 3 3 3
f 1 2
v 1e7 1e7 1e7
v 10000000.5 1e7 1e7
v 1e7 10000001 1e7
f -1 -2 -3
";

pub const OBJ_WORDS: [&str; 34] = [
    "v",
    "vn",
    "vt",
    "vp",
    "f",
    "fo",
    "l",
    "p",
    "g",
    "o",
    "s",
    "usemtl",
    "mtllib",
    "curv2",
    "surf",
    "cstype",
    "end",
    "red",
    "blue metal",
    "input.mtl",
    "input.obj",
    ".",
    "..",
    "/",
    "//",
    "1/2/3",
    "1//2",
    "-1//-1",
    "\\\n",
    "#",
    "\t",
    "\r",
    "\0",
    "\u{feff}",
];

pub fn meshes() -> Vec<Vec<u8>> {
    let polygon = |corners: usize| {
        let place = |i: usize| {
            let angle = i as f64;
            format!("v {} {} 0\n", angle * angle.cos(), angle * angle.sin())
        };
        let list = (1..=corners).map(|i| format!(" {i}")).collect::<String>();
        (0..corners).map(place).collect::<String>() + "f" + &list + "\n"
    };
    let circle = (0..500).map(|i| f64::from(i) / 80.0).map(|a| format!("v {} {} 0\n", a.cos(), a.sin()));
    let fan =
        circle.collect::<String>() + &(2..500).map(|i| format!("f 1 {i} {}\n", i + 1)).collect::<String>();
    let texts = [EVERY_STATEMENT.into(), FAN.into(), COLORED_MESH.into(), polygon(12), polygon(200), fan];
    texts.into_iter().map(String::into_bytes).collect()
}

const MTL: &str = "\
# Colours.
newmtl red
Ka 0.1 0 0
Kd 1 0 0
Ns 10
illum 2
newmtl blue metal
kd 0.1 0.2 0.9
newmtl grey
Kd 0.5
newmtl pictured
Kd 0 0 0
map_Kd -s 2 2 2 picture.png
";

const OTHER_MTL: &str = "\
newmtl red # comment
Kd xyz 0.4 0.2 0.1
newmtl grey
Kd spectral file.rfl 1
d 0.5
Tr 0.5
newmtl unknown
Kd -1 2 nan
map_Ka
newmtl red
newmtl
Kd 1e-3 1e-3 1e-3
";

pub const MTL_WORDS: [&str; 24] = [
    "newmtl",
    "Kd",
    "kd",
    "KD",
    "Ka",
    "Ks",
    "map_Kd",
    "map_Ka",
    "map_kd",
    "xyz",
    "spectral",
    "red",
    "blue",
    "metal",
    "grey",
    "pictured",
    "unknown",
    "#",
    "\\\n",
    "\t",
    "\r",
    "\0",
    "\u{feff}",
    "input.mtl",
];

pub fn libraries() -> Vec<Vec<u8>> {
    [MTL, OTHER_MTL].map(|text| text.as_bytes().to_vec()).into()
}

/// An image of every colour type and depth that there is, plain and interlaced.
pub fn images() -> Vec<Vec<u8>> {
    const KINDS: [[u8; 2]; 15] = [
        [0, 8],
        [0, 1],
        [0, 2],
        [0, 4],
        [0, 16],
        [2, 8],
        [2, 16],
        [3, 1],
        [3, 2],
        [3, 4],
        [3, 8],
        [4, 8],
        [4, 16],
        [6, 8],
        [6, 16],
    ];
    let mut random = Rng::with_seed(3);
    let forms = KINDS.into_iter().flat_map(|kind| [(kind, false), (kind, true)]);
    forms.map(|(kind, interlaced)| png::image(&mut random, kind, interlaced, Vec::new())).collect()
}

/// What pictures say of how they were made.
const PICTURED: [&[&str]; 4] = [
    &[
        "version-4",
        "--size=64x48",
        "--samples=5",
        "--eye=1,2,3",
        "--vfov=43.5",
        "--overlay=depth",
        "--seed=7",
    ],
    &[
        "small.toml",
        "--size=9x9",
        "--aperture-image=iris.png",
        "--shutter=0.01",
        "--iso=400",
        "--exposure=-1.5",
    ],
    &[
        "part.obj",
        "--camera=hole",
        "--hole-diameter=0.01",
        "--upright=true",
        "--exposure-lock=false",
        "-n",
        "3",
    ],
    &["passing", "--preset=eye-8mm", "--blades=5", "--roundness=0.5", "--noise-threshold=0.05", "--jitter=2"],
];

fn json(arguments: &[&str]) -> String {
    let words: Vec<String> = arguments.iter().map(|word| format!("\"{word}\"")).collect();
    let last = "{\"Unix\":[45,45,117,112,61,48,44,49,44,48]}";
    format!("{{\"version\":\"0.1.0\",\"arguments\":[{},{last}]}}", words.join(","))
}

pub fn png_pictures() -> Vec<Vec<u8>> {
    let mut random = Rng::with_seed(4);
    let mut of = |others: Vec<Part>| png::image(&mut random, [2, 8], false, others);
    let mut pictures = Vec::new();
    for arguments in PICTURED {
        let texts = png::texts("thinlens", &json(arguments));
        let title = png::texts("Title", "a picture");
        for (text, title) in texts.into_iter().zip(title) {
            pictures.push(of(vec![title, text]));
        }
    }
    pictures
}

pub fn exr_pictures() -> Vec<Vec<u8>> {
    PICTURED.map(exr::picture).into()
}

pub const OPTIONS: [&str; 79] = [
    "view",
    "render",
    "sweep",
    "save",
    "verify",
    "bench",
    "scenes",
    "devices",
    "help",
    "version-4",
    "suffern-boxes",
    "suffern-mirror",
    "passing",
    "small.toml",
    "part.obj",
    "missing.toml",
    "iris.png",
    "picture.png",
    "picture.exr",
    "--from=picture.png",
    "--from=picture.exr",
    "--from=iris.png",
    "-o",
    "a.png",
    "-q",
    "-n",
    "-s",
    "--",
    "-",
    "--samples=",
    "--size=",
    "--eye=",
    "--look-at=",
    "--up=",
    "--vfov=",
    "--metres-per-unit=",
    "--lens-diameter=",
    "--f-number=",
    "--preset=",
    "--camera=",
    "--hole-diameter=",
    "--upright",
    "--blades=",
    "--blade-rotation=",
    "--roundness=",
    "--anamorphic=",
    "--aperture-image=",
    "--cats-eye=",
    "--focal-distance=",
    "--focal-length=",
    "--sensor=",
    "--focus-breathing",
    "--jitter=",
    "--max-bounces=",
    "--sampler=",
    "--noise-threshold=",
    "--seed=",
    "--shutter=",
    "--iso=",
    "--exposure-lock=",
    "--exposure=",
    "--overlay=",
    "--tolerance=",
    "--autofocus",
    "--autofocus=",
    "--f-numbers=",
    "--lens-diameters=",
    "--focal-distances=",
    "--columns=",
    "--stats=",
    "--device=",
    "--runs=",
    "--json",
    "pinhole",
    "hole",
    "50mm-f1.4",
    "none",
    "1/100",
    "64x48",
];

pub fn command_lines() -> Vec<Vec<u8>> {
    let more: [&[&str]; 9] = [
        &[],
        &["view", "passing"],
        &["render", "--from=picture.png", "-o", "a.png", "-n", "9", "--f-number=8"],
        &["render", "-o", "a.exr", "--autofocus=3,4", "--stats", "a.json", "--eye", "-1,2,3.5", "-q"],
        &["sweep", "-o", "a.png", "--f-numbers=1.4,2.8,22", "--columns", "2", "small.toml", "--cats-eye=0.5"],
        &["sweep", "-o", "a.png", "--focal-distances=1,2", "--exposure-lock"],
        &["save", "small.toml", "-o", "a.toml", "--lens-diameter=0.5", "--iso", "800", "--vfov=60"],
        &["verify", "-n", "2", "-s", "8x8", "--device", "0", "--validation"],
        &["bench", "passing", "--runs=1", "--json=a.json", "-s", "8x8"],
    ];
    let renders = PICTURED.iter().map(|arguments| [&["render", "-o", "a.png"], *arguments].concat());
    let saves = PICTURED.iter().map(|arguments| [&["save", "-o", "a.toml"], *arguments].concat());
    let lines = more.iter().map(|words| words.to_vec()).chain(renders).chain(saves);
    lines.map(|words| words.join("\n").into_bytes()).collect()
}
