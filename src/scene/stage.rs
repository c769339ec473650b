//! A scene around a lone mesh: on a ground, framed, lit, and focused on its nearest point.

use super::mesh::{Mesh, Placement};
use super::{
    Aperture, Background, Camera, CameraModel, Checker, DEFAULT_SHUTTER, DirectionalLight, Hole, Lens, Light,
    LightKind, Material, Matte, Plane, Scene, Sensor, Shaded, Triangle, View,
};
use crate::error::Result;
use glam::{DVec3, Vec3};
use std::ops::RangeInclusive;
use std::path::PathBuf;

const MAX_BOUNCES: u32 = 5;
const HORIZON: Vec3 = Vec3::new(0.92, 0.9, 0.87);
const ZENITH: Vec3 = Vec3::new(0.24, 0.44, 0.78);
const AMBIENT: Vec3 = Vec3::new(0.24, 0.27, 0.32);
/// A warm key light from the left, with shadows, and a cool fill light from the right, without: the direction of each, its
/// radiance, and whether it casts shadows.
const LIGHTS: [(DirectionalLight, Vec3, bool); 2] = [
    (DirectionalLight { direction: Vec3::new(-0.5, 1.0, 0.65) }, Vec3::new(2.5, 2.35, 2.1), true),
    (DirectionalLight { direction: Vec3::new(1.0, 0.35, 0.3) }, Vec3::new(0.4, 0.46, 0.55), false),
];
const EVEN_SQUARES: Vec3 = Vec3::new(0.62, 0.6, 0.56);
const ODD_SQUARES: Vec3 = Vec3::new(0.36, 0.37, 0.39);
/// Of the ground: ambient and diffuse reflection.
const GROUND_KA: f32 = 1.0;
const GROUND_KD: f32 = 1.0;
const SIZE: [u32; 2] = [1280, 720];
const VFOV_DEGREES: f64 = 34.0;
/// The direction from the mesh to the eye: a three-quarter view from a little above, which shows the horizon.
const TO_EYE: DVec3 = DVec3::new(0.52, 0.2, 0.8);
/// The box around the mesh fills this share of the picture's width or height, at most.
const FILL: f64 = 0.78;
/// The blur of the mesh's farthest point, as a share of the picture's height.
const FAR_BLUR: f64 = 0.025;
/// The widest lens, as a share of the focal distance. Without this limit, a mesh without depth would get a lens of any
/// width.
const WIDEST_LENS: f64 = 0.08;
/// The lens's f-number.
const F_NUMBER: f64 = 2.0;
/// Edge of the ground's squares, as a share of the box's diagonal.
const SQUARE: f64 = 0.2;
/// The gap between the mesh and the ground, as a share of the diagonal. Without it, a flat mesh would lie in the ground.
const GAP: f64 = 1e-3;
/// The diagonals of meshes that can be shown. The lengths of the scene around such a mesh are far from MIN_LENGTH and
/// MAX_LENGTH.
const DIAGONALS: RangeInclusive<f64> = 1e-4..=1e7;

/// The ground that a mesh stands on.
struct Ground {
    /// The edge of its squares.
    square: f64,
    height: f64,
    /// The position that the mesh is moved to.
    position: DVec3,
}

impl Ground {
    /// The ground below a mesh.
    fn new(mesh: &Mesh) -> Result<Self> {
        let [lower, upper] = mesh.bounds();
        let extent = upper - lower;
        let diagonal = extent.length();
        if !DIAGONALS.contains(&diagonal) {
            let (low, high) = (DIAGONALS.start(), DIAGONALS.end());
            let message = format!(
                "it is {diagonal:.1e} across, but must be from {low:e} to {high:e}; put it into a scene file with \
                 a scale"
            );
            return Err(mesh.error(message));
        }
        // The ground lies in the middle of a layer of its checker, so that rounding cannot change its colours.
        let square = SQUARE * diagonal;
        let height = 0.5 * square;
        let foot = DVec3::new(lower.x + 0.5 * extent.x, lower.y, lower.z + 0.5 * extent.z);
        Ok(Self { square, height, position: DVec3::Y * (height + GAP * diagonal) - foot })
    }

    fn material(&self) -> Material {
        let checker = Checker { even: EVEN_SQUARES, odd: ODD_SQUARES, size: self.square };
        Matte { color: checker.into(), ka: GROUND_KA, kd: GROUND_KD }.into()
    }
}

/// The scene, and the text of a scene file of it. Its lengths are those of the mesh's file; the mesh is moved onto the ground.
///
/// # Errors
/// Those of [`Mesh::add_to`]; `Error::Mesh` for a mesh so small or large that f32 cannot show it.
pub(super) fn around(mesh: &Mesh, name: &str) -> Result<(Scene, String)> {
    let ground = Ground::new(mesh)?;
    let placement = Placement::new(1.0, DVec3::ZERO, ground.position);
    let [lower, upper] = mesh.bounds();
    let camera = camera(ground.position + 0.5 * (lower + upper), 0.5 * (upper - lower));
    let mut scene = Scene {
        name: name.to_owned(),
        source: PathBuf::new(),
        files: Vec::new(),
        camera,
        model: CameraModel::default(),
        lens: Lens::new(0.0, 1.0),
        hole: Hole { diameter: 0.0, upright: false },
        aperture: Aperture::default(),
        size: SIZE,
        shutter: DEFAULT_SHUTTER,
        view: View::default(),
        max_bounces: MAX_BOUNCES,
        background: Background { horizon: HORIZON, zenith: ZENITH },
        ambient: AMBIENT,
        lights: LIGHTS.map(light).to_vec(),
        materials: vec![ground.material()],
        material_names: vec!["ground".into()],
        shapes: vec![Shaded::still(Plane { point: DVec3::Y * ground.height, normal: Vec3::Y }, 0)],
    };
    mesh.add_to(&mut scene, &placement, None, Vec3::ZERO)?;
    scene.lens = lens_for(&scene);
    // A mesh file does not say how large its units are. They are taken as large as gives the lens this f-number.
    let frame_metres = scene.camera.focal_length_mm() / 1000.0;
    scene.camera.metres_per_unit = frame_metres / F_NUMBER / f64::from(scene.lens.diameter);
    scene.hole.diameter = scene.camera.default_hole_diameter();
    let text = scene_file(&scene, &ground);
    Ok((scene, text))
}

/// The text of a scene file with this stage.
fn scene_file(scene: &Scene, ground: &Ground) -> String {
    let numbers = |vector: Vec3| format!("[{}, {}, {}]", vector.x, vector.y, vector.z);
    let place = |point: DVec3| format!("[{}, {}, {}]", point.x, point.y, point.z);
    let camera = &scene.camera;
    let mut text = format!(
        "size = [{}, {}]\nmax_bounces = {}\n\n[camera]\neye = {}\nlook_at = {}\nvfov_degrees = {:?}\n\
         metres_per_unit = {:?}\nlens_diameter = {:?}\nfocal_distance = {:?}\n\n\
         [background]\nhorizon = {}\nzenith = {}\n\n[ambient]\ncolor = {}\nradiance = 1\n",
        scene.size[0],
        scene.size[1],
        scene.max_bounces,
        place(camera.eye),
        place(camera.look_at),
        camera.vfov_degrees(),
        camera.metres_per_unit,
        scene.lens.diameter,
        scene.lens.focal_distance,
        numbers(scene.background.horizon),
        numbers(scene.background.zenith),
        numbers(scene.ambient),
    );
    for (DirectionalLight { direction }, radiance, shadows) in LIGHTS {
        text += &format!(
            "\n[[directional]]\ndirection = {}\ncolor = {}\nradiance = 1\nshadows = {}\n",
            numbers(direction),
            numbers(radiance),
            shadows
        );
    }
    text += &format!(
        "\n[matte.ground]\nka = {}\nkd = {}\ncolor = {{ even = {}, odd = {}, size = {:?} }}\n\
         \n[[plane]]\npoint = [0, {:?}, 0]\nnormal = [0, 1, 0]\nmaterial = \"ground\"\n\
         \n[[mesh]]\nfile = {}\nposition = {}\n",
        GROUND_KA,
        GROUND_KD,
        numbers(EVEN_SQUARES),
        numbers(ODD_SQUARES),
        ground.square,
        ground.height,
        toml_edit::value(&scene.name),
        place(ground.position),
    );
    text
}

/// A camera that looks at a box of this centre and half extent, from where all its corners are in the picture.
fn camera(center: DVec3, half: DVec3) -> Camera {
    let to_eye = TO_EYE.normalize();
    let toward = |distance: f64| {
        let camera = Camera {
            eye: center + distance * to_eye,
            look_at: center,
            up: DVec3::Y,
            vfov_radians: VFOV_DEGREES.to_radians(),
            metres_per_unit: 1.0,
            sensor: Sensor::FULL_FRAME,
            focus_breathing: false,
            lens_shift_mm: [0.0; 2],
        };
        camera.with_few_digits()
    };
    let diagonal = 2.0 * half.length();
    let frame = toward(diagonal).frame();
    // The slopes of the lines of sight to the edges of the part of the picture that the box may fill.
    let highest = FILL * (0.5 * VFOV_DEGREES.to_radians()).tan();
    let widest = highest * f64::from(SIZE[0]) / f64::from(SIZE[1]);
    let distance = (0..8).map(|corner| {
        let side = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let corner = half * DVec3::new(side(0), side(1), side(2));
        let aside = (corner.dot(frame.u()).abs() / widest).max(corner.dot(frame.v()).abs() / highest);
        corner.dot(frame.w()) + aside.max(0.1 * diagonal)
    });
    toward(distance.fold(0.0, f64::max))
}

/// A lens that is focused on the nearest vertex along the axis, and wide enough to blur the farthest one clearly.
fn lens_for(scene: &Scene) -> Lens {
    let frame = scene.camera.frame();
    let vertices = scene.of_kind::<Triangle>().flat_map(|(triangle, _)| triangle.vertices);
    let depths = vertices.map(|vertex| frame.axial_depth(scene.camera.eye, vertex));
    let (near, far) =
        depths.fold((f64::INFINITY, 0.0), |(near, far): (f64, f64), depth| (near.min(depth), far.max(depth)));
    // The circle of confusion D (far - near) / (far near) k, and k = height / 2 / tan(vfov / 2).
    let blur_of_one = (far - near) / far * 0.5 / (0.5 * scene.camera.vfov_radians).tan();
    let ratio = (FAR_BLUR / blur_of_one).min(WIDEST_LENS);
    Lens::new((ratio * near) as f32, near as f32)
}

fn light((light, radiance, shadows): (DirectionalLight, Vec3, bool)) -> Light {
    Light { kind: LightKind::Directional(light), radiance, shadows }
}
