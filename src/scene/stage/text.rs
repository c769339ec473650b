//! The scene file of a scene around a lone mesh.

use super::Staged;
use super::around::{AMBIENT, EVEN_SQUARES, GROUND_KA, GROUND_KD, Ground, ODD_SQUARES};
use crate::error::Result;
use crate::scene::{Constant, Light, LightKind, Material, Scene, Texture};
use glam::{DVec3, Vec3};

/// The text of a scene file of this scene, beside the file of its mesh.
///
/// # Errors
/// As [`super::around`].
pub(in crate::scene) fn text(scene: &Scene, staged: &Staged) -> Result<String> {
    let Staged { mesh, stage } = staged;
    let ground = Ground::new(mesh, stage)?;
    let camera = &scene.camera;
    let sky = scene.background.gradient();
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
        numbers(sky.horizon),
        numbers(sky.zenith),
        numbers(AMBIENT),
    );
    for Light { kind, radiance, shadows } in &scene.lights {
        if let LightKind::Directional(light) = kind {
            text += &format!(
                "\n[[directional]]\ndirection = {}\ncolor = {}\nradiance = 1\nshadows = {shadows}\n",
                numbers(light.direction),
                numbers(*radiance),
            );
        }
    }
    if stage.ground {
        text += &format!(
            "\n[matte.ground]\nka = {GROUND_KA}\nkd = {GROUND_KD}\ncolor = {{ even = {}, odd = {}, size = {:?} }}\n\
             \n[[plane]]\npoint = [0, {:?}, 0]\nnormal = [0, 1, 0]\nmaterial = \"ground\"\n",
            numbers(EVEN_SQUARES),
            numbers(ODD_SQUARES),
            ground.square,
            ground.height,
        );
    }
    let chosen = stage.material(mesh);
    if let Some((name, material)) = &chosen {
        text += &table(name, material);
    }
    text += &format!("\n[[mesh]]\nfile = {}\n", toml_edit::value(&scene.name));
    if let Some((name, _)) = &chosen {
        text += &format!("material = \"{name}\"\n");
    }
    if ground.rotate_degrees != DVec3::ZERO {
        text += &format!("rotate_degrees = {}\n", place(ground.rotate_degrees));
    }
    text += &format!("position = {}\n", place(ground.position));
    Ok(text)
}

/// The table of the material of a model, which has one colour.
fn table(name: &str, material: &Material) -> String {
    let color = |texture: &Texture| match texture {
        Texture::Constant(Constant { color }) => numbers(*color),
        Texture::Checker(checker) => numbers(checker.even),
    };
    match material {
        Material::Matte(of) => {
            format!("\n[matte.{name}]\ncolor = {}\nka = {}\nkd = {}\n", color(&of.color), of.ka, of.kd)
        }
        Material::Phong(of) => format!(
            "\n[phong.{name}]\ncolor = {}\nka = {}\nkd = {}\nks = {}\nexponent = {}\n",
            color(&of.color),
            of.ka,
            of.kd,
            of.ks,
            of.exponent
        ),
        Material::Mirror(of) => format!(
            "\n[mirror.{name}]\ncolor = {}\nkr = 1\nks = {}\nexponent = {}\n",
            numbers(of.reflectance),
            of.ks,
            of.exponent
        ),
        Material::Emissive(of) => {
            format!("\n[emissive.{name}]\ncolor = {}\nradiance = 1\n", numbers(of.radiance))
        }
        Material::Metal(of) => {
            format!("\n[metal.{name}]\ncolor = {}\nroughness = {}\n", color(&of.color), of.roughness)
        }
        Material::Plastic(of) => format!(
            "\n[plastic.{name}]\ncolor = {}\nindex = {}\nroughness = {}\n",
            color(&of.color),
            of.index,
            of.roughness
        ),
        Material::Standard(of) => format!(
            "\n[standard.{name}]\ncolor = {}\nmetallic = {}\nroughness = {}\n",
            color(&of.color),
            of.metallic,
            of.roughness
        ),
        Material::Glass(of) => format!(
            "\n[glass.{name}]\nindex = {}\nroughness = {}\ncolor = {}\ncolor_distance = {}\n",
            of.index,
            of.roughness,
            numbers(of.color),
            of.color_distance
        ),
    }
}

fn numbers(vector: Vec3) -> String {
    format!("[{}, {}, {}]", vector.x, vector.y, vector.z)
}

fn place(point: DVec3) -> String {
    format!("[{}, {}, {}]", point.x, point.y, point.z)
}
