//! Parses the command line into values. Nothing is rendered here.

mod settings;

use crate::diagram::{VIEWS, View};
use crate::error::Result;
use crate::scene::{self, BUILTINS, SceneRef};
use crate::settings::{DEFAULT_SAMPLES, DeviceChoice, Focusing, Place, Settings, Sweep, Value, list, size};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgAction, Args, CommandFactory, Parser, Subcommand};
pub use settings::SettingsArgs;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The default f-numbers of a sweep, from clearly blurred to sharp.
const SWEPT_F_NUMBERS: [f64; 4] = [2.8, 5.6, 11.0, 32.0];

/// The options that give the lens in another way than by places of the picture.
const LENS: [&str; 4] = ["autofocus", "focal-distance", "lens-diameter", "f-number"];

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "thinlens",
    version,
    about = "Renders scenes through a thin lens, so that what lies off the focal plane is blurred",
    // A command that was copied, or that an alias stands for, can be changed by options at its end.
    args_override_self = true,
    after_help = "Try:\n  \
        thinlens                                       opens the viewer, with sliders for the lens\n  \
        thinlens bunny.obj                             opens a scene, a mesh or a saved picture in the viewer\n  \
        thinlens render -o picture.png                 renders the default scene to a file\n  \
        thinlens render -o sharp.png --lens-diameter 0 renders it through a pinhole\n  \
        thinlens render suffern-boxes -o boxes.exr     saves linear values and sample counts\n  \
        thinlens sweep -o sheet.png                    shows four f-numbers side by side\n  \
        thinlens render bunny.obj -o bunny.png         shows a mesh on a ground, in focus\n\n\
        If an option is given twice, the last one counts."
)]
pub struct Cli {
    /// The command. Without one, the viewer opens.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// A command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Open the viewer, which is the default; without a display, render to thinlens.png instead
    View(ViewArgs),
    /// Render a scene without a window, and save the picture as a PNG or EXR file
    Render(RenderArgs),
    /// Render a scene with several f-numbers, lens diameters or focal distances, and save the pictures side by
    /// side in one PNG file
    Sweep(SweepArgs),
    /// Draw what the lens does with the light of one pixel: film, lens, focal plane and object with the rays between
    /// them, and the circle of confusion. Saves an SVG file
    Diagram(DiagramArgs),
    /// Save a scene as a .toml file, with the camera, lens and view that the options choose
    Save(SaveArgs),
    /// Check a device: render small pictures on it, compare every sample with the same computation in f64 on the
    /// CPU, and print how many differ
    Verify(VerifyArgs),
    /// Measure a device: print how many samples it renders per second, how long the first picture takes, and how
    /// the error decreases, for every sampler
    Bench(BenchArgs),
    /// Print the names of the built-in scenes, and what each shows
    Scenes,
    /// Print the Vulkan devices, with the indices and names that --device takes
    Devices,
}

/// `thinlens view`.
#[derive(Debug, Args, Default)]
pub struct ViewArgs {
    /// What to render.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// The device to render on.
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// `thinlens render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Render a picture again that thinlens saved, with the settings that the file contains; other options
    /// change them
    #[arg(long, value_name = "PICTURE.png|PICTURE.exr", conflicts_with = "scene")]
    pub from: Option<PathBuf>,
    /// What to render.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// Focus on what the picture shows at this pixel, counted from the upper left corner; without a pixel, focus
    /// on what it shows in the middle
    #[arg(
        long,
        value_name = "X,Y",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "centre",
        value_parser = parse_place,
        conflicts_with = "focal-distance"
    )]
    autofocus: Option<Place>,
    /// Choose the lens that is focused on what the picture shows at this pixel; --blur-at gives its width
    #[arg(long, value_name = "X,Y", value_parser = parse_place, requires = "blur_at", conflicts_with_all = LENS)]
    sharp_at: Option<Place>,
    /// With --sharp-at: what the picture shows at this pixel is blurred over so many pixels
    #[arg(long, value_name = "X,Y,PIXELS", value_parser = parse_blur, requires = "sharp_at")]
    blur_at: Option<(Place, f32)>,
    /// Choose the lens with which everything between what the picture shows here and at --sharp-to is blurred over the
    /// tolerance at most
    #[arg(long, value_name = "X,Y", value_parser = parse_place, requires = "sharp_to", conflicts_with_all = LENS,
        conflicts_with_all = ["sharp_at", "blur_at"])]
    sharp_from: Option<Place>,
    /// With --sharp-from: where the sharp range ends
    #[arg(long, value_name = "X,Y", value_parser = parse_place, requires = "sharp_from")]
    sharp_to: Option<Place>,
    /// The file to save the picture to: .png (8-bit sRGB) or .exr (linear f32: R, G, B, and the samples per
    /// pixel as count)
    #[arg(short, long, value_name = "OUT.png|OUT.exr")]
    pub output: PathBuf,
    /// Also write samples, rays, times and the device to a JSON file
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// The device to render on.
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Print only warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// `thinlens sweep`.
#[derive(Debug, Args)]
#[command(
    mut_arg("size", |size| size.help("The size of each picture in pixels [default: the scene's]")),
)]
pub struct SweepArgs {
    /// What the pictures have in common. All are equally bright, unless the exposure lock is off.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// Render one picture for each of these f-numbers [default: 2.8,5.6,11,32]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',', value_parser = typed("f-number"), action = ArgAction::Set, group = "swept")]
    f_numbers: Vec<Value>,
    /// Render one picture for each of these lens diameters, in scene units or like 17mm; 0 is a pinhole
    #[arg(long, value_name = "L,L,...", value_delimiter = ',', value_parser = typed("lens-diameter"), action = ArgAction::Set, group = "swept")]
    lens_diameters: Vec<Value>,
    /// Render one picture for each of these distances of the focal plane, in scene units or like 1.2m
    #[arg(long, value_name = "L,L,...", value_delimiter = ',', value_parser = typed("focal-distance"), action = ArgAction::Set, group = "swept")]
    focal_distances: Vec<Value>,
    /// The number of pictures in a row [default: about the number of rows]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub columns: Option<u32>,
    /// The file to save the sheet to, in 8-bit sRGB
    #[arg(short, long, value_name = "OUT.png")]
    pub output: PathBuf,
    /// The device to render on.
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Print only warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// `thinlens diagram`.
#[derive(Debug, Args)]
#[command(
    mut_arg("size", |size| size.help("The size in pixels of the picture that the pixel is in [default: the scene's]")),
    mut_args(settings::without_sampling)
)]
pub struct DiagramArgs {
    /// What the camera and the scene are. How the picture is sampled does not matter.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// The pixel whose optics are drawn, counted from the upper left corner of the picture [default: the middle]
    #[arg(long, value_name = "X,Y", value_parser = parse_place)]
    pub pixel: Option<Place>,
    /// What is drawn
    #[arg(long, value_name = "NAME", value_parser = view(), default_value = View::Side.entry().name)]
    pub view: View,
    /// From the side and from above, give depths and heights the same scale everywhere. Otherwise the side of the film
    /// and the heights are magnified, and the drawing says how much
    #[arg(long)]
    pub to_scale: bool,
    /// Also draw the light of points at these depths on the same ray, in scene units: blue in front of the focal plane,
    /// white in focus, orange behind it. At most two
    #[arg(long, value_name = "L,L", value_delimiter = ',', allow_negative_numbers = true)]
    pub also_at: Vec<f64>,
    /// A rendered picture of the same size, as PNG, whose pixels are drawn beside the circle of confusion
    #[arg(long, value_name = "FILE.png")]
    pub picture: Option<PathBuf>,
    /// The number of rays through the lens
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 9)]
    pub rays: u32,
    /// The size of the drawing
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "1100x420")]
    pub drawing_size: [u32; 2],
    /// The file to save the drawing to: .svg, or .png with two pixels for each unit of the size
    #[arg(short, long, value_name = "OUT.svg")]
    pub output: PathBuf,
    /// The device that traces the rays.
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Print only warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// `thinlens save`.
#[derive(Debug, Args)]
#[command(mut_args(settings::without_sampling))]
pub struct SaveArgs {
    /// What to save. How it is sampled is not part of a scene.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// The file to save the scene to
    #[arg(short, long, value_name = "OUT.toml")]
    pub output: PathBuf,
}

/// `thinlens verify`.
#[derive(Debug, Args)]
#[command(mut_args(settings::for_verifying))]
pub struct VerifyArgs {
    /// What to render.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// The device to render on.
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// `thinlens bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Built-in scenes (see thinlens scenes), .toml or .obj files [default: every built-in scene]
    scenes: Vec<PathBuf>,
    /// The size of the pictures in pixels; the error is measured with at most 320x240
    #[arg(short, long, value_name = "WxH", value_parser = parse_size, default_value = "640x480")]
    size: [u32; 2],
    /// The number of antialiasing points per pixel, with which samples per second are measured
    #[arg(short = 'n', long, value_name = "N", allow_negative_numbers = true, default_value_t = DEFAULT_SAMPLES)]
    samples: u32,
    /// How many times everything is measured, after a warm-up
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 5)]
    pub runs: u32,
    /// Write all figures with their spreads as JSON, to FILE; without FILE, print them instead of the table
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = "-")]
    pub json: Option<PathBuf>,
    /// The device to render on.
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// The device to render on.
#[derive(Debug, Args, Default)]
pub struct DeviceArgs {
    /// The Vulkan device, by its index or a part of its name (see thinlens devices) [default: the best]
    #[arg(long, value_name = "INDEX|NAME")]
    pub device: Option<String>,
    /// Check every Vulkan call with the Khronos validation layer, and fail if it reports anything
    #[arg(long)]
    pub validation: bool,
}

/// The arguments that the program was started with. Ends the program if they are wrong or ask for help.
pub fn parse() -> Cli {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    Cli::try_parse_from(with_command(&arguments)).unwrap_or_else(|error| {
        // clap takes a file name that begins with a dash for an option.
        let is_file = |word: &OsString| {
            let name = Path::new(word).extension().and_then(|extension| extension.to_str());
            let dash = word.as_encoded_bytes().starts_with(b"-");
            dash && name.is_some_and(|name| ["png", "exr", "toml", "obj", "json", "svg"].contains(&name))
        };
        let file = std::env::args_os().skip(1).find(is_file).filter(|_| error.use_stderr());
        let _ = error.print();
        if let Some(file) = file {
            let file = file.to_string_lossy();
            eprintln!("\n  tip: a file whose name begins with a dash is written ./{file}");
        }
        std::process::exit(error.exit_code());
    })
}

/// The arguments, with the command `view` put in if they start with a scene or a file and no command: this is how a file
/// manager opens a file.
fn with_command(arguments: &[OsString]) -> Vec<OsString> {
    let is_command = |name: &OsString| {
        name == "help" || Cli::command().get_subcommands().any(|known| *name == *known.get_name())
    };
    let mut arguments = arguments.to_vec();
    let names_scene = arguments.get(1).is_some_and(|first| {
        let path = Path::new(first);
        let is_file = path.extension().is_some_and(|ending| {
            ["toml", "obj", "png", "exr"].iter().any(|known| ending.eq_ignore_ascii_case(known))
        });
        let is_builtin = || BUILTINS.iter().any(|builtin| *first == *builtin.name);
        let is_option = first.as_encoded_bytes().starts_with(b"-");
        !is_option && !is_command(first) && (is_file || is_builtin() || path.exists())
    });
    if names_scene {
        arguments.insert(1, "view".into());
    }
    arguments
}

impl DeviceArgs {
    /// The choice as a plain value.
    pub fn choice(&self) -> DeviceChoice {
        DeviceChoice { device: self.device.clone(), validation: self.validation }
    }
}

impl RenderArgs {
    /// What the lens follows from, if it follows from what the picture shows.
    pub fn focusing(&self) -> Option<Focusing> {
        let blur = self.sharp_at.zip(self.blur_at);
        let blur = blur.map(|(sharp, (blurred, pixels))| Focusing::Blur { sharp, blurred, pixels });
        let range = self.sharp_from.zip(self.sharp_to).map(|(from, to)| Focusing::Range { from, to });
        blur.or(range).or(self.autofocus.map(Focusing::On))
    }
}

impl SweepArgs {
    /// The value that changes from picture to picture.
    pub fn sweep(&self) -> Sweep {
        if !self.lens_diameters.is_empty() {
            Sweep::LensDiameters(self.lens_diameters.clone())
        } else if !self.focal_distances.is_empty() {
            Sweep::FocalDistances(self.focal_distances.clone())
        } else if !self.f_numbers.is_empty() {
            Sweep::FNumbers(self.f_numbers.clone())
        } else {
            Sweep::FNumbers(SWEPT_F_NUMBERS.map(Value::Double).to_vec())
        }
    }
}

impl BenchArgs {
    /// The settings of a picture of each scene that was named, or of each built-in scene.
    ///
    /// # Errors
    /// Those of loading a scene, or [`crate::error::Error::OutOfRange`].
    pub fn pictures(&self) -> Result<Vec<Settings>> {
        let picture = |name: &Path| {
            let mut settings = Settings::of_scene(SceneRef::new(scene::load(name)?));
            settings.estimator.size = self.size;
            settings.samples = self.samples;
            settings.check()?;
            Ok(settings)
        };
        if self.scenes.is_empty() {
            return BUILTINS.iter().map(|builtin| picture(builtin.name.as_ref())).collect();
        }
        self.scenes.iter().map(|name| picture(name)).collect()
    }
}

/// Reads the values of a sweep as the option of this setting reads its value.
fn typed(flag: &str) -> impl Fn(&str) -> Result<Value, String> + Clone + use<> {
    let setting = list::setting(flag);
    move |text| setting.parse(text)
}

fn parse_place(text: &str) -> Result<Place, String> {
    if text == "centre" {
        return Ok(Place::Centre);
    }
    let parse = || {
        let (x, y) = text.split_once(',')?;
        Some(Place::At([x.trim().parse().ok()?, y.trim().parse().ok()?]))
    };
    parse().ok_or_else(|| "a place is X,Y in pixels from the upper left corner, such as 320,240".into())
}

fn parse_blur(text: &str) -> Result<(Place, f32), String> {
    let parse = || {
        let (place, pixels) = text.rsplit_once(',')?;
        let pixels = pixels.trim().parse().ok().filter(|pixels| *pixels > 0.0 && *pixels < 1e6)?;
        Some((parse_place(place).ok()?, pixels))
    };
    parse().ok_or_else(|| {
        "it is X,Y,PIXELS: a place and a blur of more than 0 pixels, such as 320,240,20".into()
    })
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    size(text).ok_or_else(|| "a size is WIDTHxHEIGHT in pixels, such as 1280x720".into())
}

/// Reads the name of a view of the optics.
fn view() -> impl TypedValueParser<Value = View> {
    let names = VIEWS.iter().map(|entry| PossibleValue::new(entry.name).help(entry.help));
    PossibleValuesParser::new(names)
        .map(|name| VIEWS.iter().find(|entry| entry.name == name).map_or(View::Side, |entry| entry.view))
}
