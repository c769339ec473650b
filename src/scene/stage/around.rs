//! A scene around a lone mesh: on a ground, framed, lit, and focused on its nearest point.

use super::{Stage, Staged};
use crate::error::Result;
use crate::scene::mesh::{Mesh, Placement};
use crate::scene::{
    Aperture, Background, Camera, CameraModel, Checker, DEFAULT_SHUTTER, DirectionalLight, Gradient, Hole,
    Integrator, Lens, Light, LightKind, Material, Matte, Plane, Scene, Sensor, Shaded, Triangle, View,
};
use glam::{DVec3, Vec3};
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;

const MAX_BOUNCES: u32 = 5;
pub(super) const AMBIENT: Vec3 = Vec3::new(0.24, 0.27, 0.32);
/// The radiance of the key light, which is warm and casts shadows.
const KEY: Vec3 = Vec3::new(2.5, 2.35, 2.1);
/// The fill light, which is cool and casts no shadows: its direction and its radiance.
const FILL: (Vec3, Vec3) = (Vec3::new(1.0, 0.35, 0.3), Vec3::new(0.4, 0.46, 0.55));
pub(super) const EVEN_SQUARES: Vec3 = Vec3::new(0.62, 0.6, 0.56);
pub(super) const ODD_SQUARES: Vec3 = Vec3::new(0.36, 0.37, 0.39);
/// Of the ground: ambient and diffuse reflection.
pub(super) const GROUND_KA: f32 = 1.0;
pub(super) const GROUND_KD: f32 = 1.0;
const SIZE: [u32; 2] = [1280, 720];
const VFOV_DEGREES: f64 = 34.0;
/// The direction from the mesh to the eye: a three-quarter view from a little above, which shows the horizon.
const TO_EYE: DVec3 = DVec3::new(0.52, 0.2, 0.8);
/// The box around the mesh fills this share of the picture's width or height, at most.
const FILLED: f64 = 0.78;
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

/// Where a mesh stands, and the ground below it.
pub(super) struct Ground {
    /// The edge of its squares.
    pub(super) square: f64,
    pub(super) height: f64,
    /// By which angles about x, y and z the mesh is turned.
    pub(super) rotate_degrees: DVec3,
    /// The position that the mesh is moved to.
    pub(super) position: DVec3,
    /// The box around the turned mesh, before it is moved.
    bounds: [DVec3; 2],
}

impl Ground {
    /// The ground below a mesh. The mesh turns about the vertical through the middle of its foot.
    pub(super) fn new(mesh: &Mesh, stage: &Stage) -> Result<Self> {
        let turned = |rotate_degrees: DVec3| {
            let placement = Placement::new(1.0, rotate_degrees, DVec3::ZERO);
            (placement.rotation, mesh.bounds(placement.rotation))
        };
        let (upright, [lower, upper]) = turned(stage.up.rotate_degrees(0.0));
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
        let rotate_degrees = stage.up.rotate_degrees(stage.turn_degrees.into());
        let (rotation, bounds) = turned(rotate_degrees);
        let foot = if rotation == upright { foot } else { rotation * (upright.inverse() * foot) };
        let position = DVec3::Y * (height + GAP * diagonal) - foot;
        Ok(Self { square, height, rotate_degrees, position, bounds })
    }

    fn material(&self) -> Material {
        let checker = Checker { even: EVEN_SQUARES, odd: ODD_SQUARES, size: self.square };
        Matte { color: checker.into(), ka: GROUND_KA, kd: GROUND_KD }.into()
    }
}

/// The scene around a mesh. Its lengths are those of the mesh's file; the mesh is moved onto the ground.
///
/// # Errors
/// Those of [`Mesh::add_to`]; `Error::Mesh` for a mesh so small or large that f32 cannot show it.
pub(in crate::scene) fn around(mesh: Arc<Mesh>, stage: &Stage, name: &str) -> Result<Scene> {
    let ground = Ground::new(&mesh, stage)?;
    let placement = Placement::new(1.0, ground.rotate_degrees, ground.position);
    let [lower, upper] = ground.bounds;
    let mut scene = Scene {
        name: name.to_owned(),
        source: PathBuf::new(),
        files: Vec::new(),
        camera: camera(ground.position + 0.5 * (lower + upper), 0.5 * (upper - lower)),
        model: CameraModel::default(),
        lens: Lens::new(0.0, 1.0),
        hole: Hole { diameter: 0.0, upright: false },
        aperture: Aperture::default(),
        size: SIZE,
        shutter: DEFAULT_SHUTTER,
        view: View::default(),
        integrator: Integrator::Whitted,
        max_bounces: MAX_BOUNCES,
        background: background(stage),
        ambient: AMBIENT,
        lights: lights(stage),
        materials: Vec::new(),
        material_names: Vec::new(),
        shapes: Arc::default(),
        staged: None,
    };
    if stage.ground {
        let material = scene.add_material("ground", ground.material());
        let plane = Plane { point: DVec3::Y * ground.height, normal: Vec3::Y };
        scene.shapes = Arc::new(vec![Shaded::still(plane, material)]);
    }
    let material = stage.material(&mesh).map(|(name, material)| scene.add_material(name, material));
    mesh.add_to(&mut scene, &placement, material, Vec3::ZERO)?;
    scene.lens = lens_for(&scene);
    // A mesh file does not say how large its units are. They are taken as large as gives the lens this f-number.
    let frame_metres = scene.camera.focal_length_mm() / 1000.0;
    scene.camera.metres_per_unit = frame_metres / F_NUMBER / f64::from(scene.lens.diameter);
    scene.hole.diameter = scene.camera.default_hole_diameter();
    scene.staged = Some(Staged { mesh, stage: *stage });
    Ok(scene)
}

/// The scene with its mesh shown in another way. A scene whose shapes stay shares them.
///
/// # Errors
/// As [`around`].
pub(super) fn again(scene: &Scene, staged: &Staged, stage: &Stage) -> Result<Scene> {
    let Staged { mesh, stage: before } = staged;
    if !stage.has_shapes_of(before, mesh) {
        let new = around(Arc::clone(mesh), stage, &scene.name)?;
        return Ok(Scene { source: scene.source.clone(), ..new });
    }
    let mut new = scene.clone();
    (new.background, new.lights) = (background(stage), lights(stage));
    if let Some((name, material)) = stage.material(mesh) {
        // The ground comes first, if there is one.
        let index = usize::from(stage.ground);
        (new.materials[index], new.material_names[index]) = (material, name.to_owned());
    }
    new.staged = Some(Staged { mesh: Arc::clone(mesh), stage: *stage });
    Ok(new)
}

fn background(stage: &Stage) -> Background {
    Gradient { horizon: stage.horizon.as_vec3(), zenith: stage.sky.as_vec3() }.into()
}

/// The key light and the fill light.
pub(super) fn lights(stage: &Stage) -> Vec<Light> {
    let directional = |direction, radiance, shadows| Light {
        kind: LightKind::Directional(DirectionalLight { direction }),
        radiance,
        shadows,
    };
    let key = directional(stage.light_direction.as_vec3(), KEY * stage.light_strength, true);
    vec![key, directional(FILL.0, FILL.1, false)]
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
    let highest = FILLED * (0.5 * VFOV_DEGREES.to_radians()).tan();
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
