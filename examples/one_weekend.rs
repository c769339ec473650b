//! Prints `src/scene/builtin/one-weekend.toml`, the scene by which many ray tracers are compared:
//! `cargo run --release --example one_weekend > src/scene/builtin/one-weekend.toml`.
//!
//! The scene is that of the last chapter of P. Shirley, T. D. Black and S. Hollasch, "Ray Tracing in One Weekend". Its
//! small spheres are random, so no two programs have the same ones.

use fastrand::Rng;
use glam::DVec3;

const SEED: u64 = 20;
const HEAD: &str = r#"# The last scene of "Ray Tracing in One Weekend" (P. Shirley, T. D. Black, S. Hollasch), by which many ray tracers are
# compared: three large spheres among some 480 small ones. The lens is focused on the front of the metal sphere.
# Made by examples/one_weekend.rs.

size = [1200, 675]
integrator = "path"
max_bounces = 50

[camera]
eye = [13, 2, 3]
look_at = [0, 0, 0]
vfov_degrees = 20
metres_per_unit = 0.1
lens_diameter = 0.10472     # 0.6 degrees wide, as seen from the focal plane
focal_distance = 10

[background]
horizon = [0.85, 0.9, 1]
zenith = [0.5, 0.7, 1]

[matte.ground]
color = [0.5, 0.5, 0.5]

[glass.clear]
index = 1.5

[matte.brown]
color = [0.4, 0.2, 0.1]

[metal.polished]
color = [0.7, 0.6, 0.5]

[[sphere]]
center = [0, -1000, 0]
radius = 1000
material = "ground"

[[sphere]]
center = [0, 1, 0]
radius = 1
material = "clear"

[[sphere]]
center = [-4, 1, 0]
radius = 1
material = "brown"

[[sphere]]
center = [4, 1, 0]
radius = 1
material = "polished"
"#;

fn main() {
    let mut random = Rng::with_seed(SEED);
    print!("{HEAD}");
    let large = [-4.0, 0.0, 4.0].map(|x| DVec3::new(x, 1.0, 0.0));
    let cells = (-11..11).flat_map(|x| (-11..11).map(move |z| [x, z]));
    for (number, [x, z]) in (1..).zip(cells) {
        let [x, z] = [x, z].map(|cell| f64::from(cell) + 0.9 * random.f64());
        let material = Material::random(&mut random);
        // The ground is a sphere too.
        let y = (1000.2_f64.powi(2) - x * x - z * z).sqrt() - 1000.0;
        let center = DVec3::new(x, y, z);
        if large.iter().any(|other| other.distance(center) < 1.2) {
            continue;
        }
        let name = match material {
            Material::Glass => "clear".to_owned(),
            _ => format!("small-{number}"),
        };
        match material {
            Material::Matte(color) => print!("\n[matte.{name}]\ncolor = {}\n", numbers(color)),
            Material::Metal(color, roughness) => {
                print!("\n[metal.{name}]\ncolor = {}\nroughness = {roughness:.2}\n", numbers(color));
            }
            Material::Glass => {}
        }
        print!("\n[[sphere]]\ncenter = [{x:.3}, {y:.4}, {z:.3}]\nradius = 0.2\nmaterial = \"{name}\"\n");
    }
}

enum Material {
    Matte(DVec3),
    Metal(DVec3, f64),
    Glass,
}

impl Material {
    /// Of 100 spheres, about 80 are matte, 15 of metal and 5 of glass.
    fn random(random: &mut Rng) -> Self {
        let choice = random.f64();
        let mut color = || DVec3::new(random.f64(), random.f64(), random.f64());
        if choice < 0.8 {
            Self::Matte(color() * color())
        } else if choice < 0.95 {
            Self::Metal(0.5 + 0.5 * color(), (0.5 * random.f64()).sqrt())
        } else {
            Self::Glass
        }
    }
}

fn numbers(color: DVec3) -> String {
    format!("[{:.3}, {:.3}, {:.3}]", color.x, color.y, color.z)
}
