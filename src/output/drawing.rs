//! Draws the optics of a pixel to a file.

use super::file::write_png;
use super::headless::position;
use super::say;
use crate::diagram::{self, Diagram, KEPT, Look, View, sharp_depths};
use crate::error::{Error, Result};
use crate::input_file;
use crate::pending_file::{PendingFile, keep_apart};
use crate::renderer::{Excerpt, Question, Renderer};
use crate::scene::{FOCAL_DISTANCES, in_range};
use crate::settings::{DeviceChoice, Place, Settings};
use crate::vulkan::{Device, Instance};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The smallest and the largest width and height of a drawing.
const EXTENTS: [u32; 2] = [200, 16384];
/// The largest width and height of a drawing that becomes a PNG.
const MAX_PNG: u32 = 4096;
/// A PNG has so many pixels for each unit of a drawing, so that its letters can be read well.
const PNG_SCALE: u32 = 2;
/// The smallest and the largest number of rays through the lens.
const RAYS: [u32; 2] = [3, 65];

/// A drawing of the optics of one pixel.
#[derive(Debug, Clone)]
pub struct DrawingJob {
    /// What is rendered.
    pub settings: Settings,
    /// The pixel.
    pub pixel: Place,
    /// Width and height of the drawing.
    pub size: [u32; 2],
    /// The number of rays through the lens.
    pub rays: u32,
    /// What is drawn.
    pub view: View,
    /// The depths of further points on the same ray whose light is drawn too.
    pub kept: Vec<f64>,
    /// The rendered picture whose pixels are drawn beside the circle of confusion: a PNG.
    pub picture: Option<PathBuf>,
    /// Whether depths and heights have the same scale everywhere.
    pub to_scale: bool,
    /// The SVG or PNG file.
    pub output: PathBuf,
    /// The device that traces the rays.
    pub device: DeviceChoice,
    /// Whether to say nothing unless it fails.
    pub quiet: bool,
}

/// Draws the optics, writes the file, and says what happens with the light of the pixel.
///
/// # Errors
/// [`Error::OutOfRange`], those of rendering and of writing, and [`Error::Validation`] if the layer had something to
/// say.
pub fn draw_optics(job: &DrawingJob) -> Result<()> {
    let [least, most] = EXTENTS;
    let extents = match Format::of(&job.output)? {
        Format::Svg => [least, most],
        Format::Png => [least, MAX_PNG],
    };
    for (what, value, range) in [
        ("the width of the drawing", job.size[0], extents),
        ("the height of the drawing", job.size[1], extents),
        ("rays", job.rays, RAYS),
    ] {
        in_range(value, range).map_err(|wrong| Error::OutOfRange(format!("{what} {wrong}")))?;
    }
    if job.kept.len() > KEPT {
        return Err(Error::OutOfRange(format!(
            "--also-at has {} depths, but can have {KEPT}",
            job.kept.len()
        )));
    }
    for depth in &job.kept {
        in_range(*depth as f32, FOCAL_DISTANCES)
            .map_err(|wrong| Error::OutOfRange(format!("--also-at {wrong}")))?;
    }
    let mut read = job.settings.files();
    read.extend(job.picture.as_deref().map(|picture| ("the picture", picture)));
    keep_apart(&[("the drawing", &job.output)], &read)?;
    let instance = Instance::new(job.device.validation, None)?;
    draw_on(&instance, job)?;
    instance.check_validation()
}

/// Writes a drawing to an SVG file or to a PNG file.
///
/// # Errors
/// [`Error::OutOfRange`] for a name that ends neither in `.svg` nor in `.png`, or for a drawing that is too large for a PNG;
/// or [`Error::Write`].
pub fn save_drawing(drawing: &diagram::Drawing, path: &Path) -> Result<()> {
    let (format, text) = (Format::of(path)?, diagram::svg(drawing));
    match format {
        Format::Svg => PendingFile::create(path)?.write(text.as_bytes()),
        Format::Png => {
            let size = drawing.size.map(|extent| PNG_SCALE * extent.round() as u32);
            let pixels = painted(&text, size)?;
            write_png(PendingFile::create(path)?, size, &pixels, None)
        }
    }
}

/// The format of a saved drawing.
enum Format {
    Svg,
    Png,
}

impl Format {
    fn of(path: &Path) -> Result<Self> {
        let is = |name: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(name));
        match () {
            () if is("svg") => Ok(Self::Svg),
            () if is("png") => Ok(Self::Png),
            () => Err(Error::OutOfRange(format!(
                "a drawing is a .svg or a .png; {} is neither",
                path.display()
            ))),
        }
    }
}

/// Paints a drawing, which is given as SVG, in the font of the viewer. Gives red, green, blue and alpha of each pixel.
fn painted(svg: &str, size @ [width, height]: [u32; 2]) -> Result<Vec<u8>> {
    let most = PNG_SCALE * MAX_PNG;
    let pixels = size.iter().all(|extent| (1..=most).contains(extent));
    let pixmap = pixels.then(|| Pixmap::new(width, height)).flatten();
    let mut pixmap = pixmap.ok_or_else(|| {
        Error::OutOfRange(format!(
            "a PNG of the drawing would have {width}x{height} pixels; it has at most {most} each way"
        ))
    })?;
    let mut options = Options { font_family: "Ubuntu".into(), ..Options::default() };
    options.fontdb_mut().load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    let tree = Tree::from_str(svg, &options).expect("the program writes valid SVG");
    let scale = PNG_SCALE as f32;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap.take())
}

fn draw_on(instance: &Arc<Instance>, job: &DrawingJob) -> Result<()> {
    let position = position("pixel", &job.settings, job.pixel)?;
    // As in the viewer, the optics are those of the middle of the pixel.
    let position = position.map(|place| place.floor() + 0.5);
    let device = Device::open(instance, job.device.device.as_deref(), None)?;
    device.keep_pipelines();
    let mut renderer = Renderer::new(&device, &job.settings)?;
    let question = Question { position, fan: job.rays, samples: job.rays };
    let picked = renderer.pick(question)?.expect("a renderer without a window answers at once");
    let diagram = Diagram::new(&job.settings.estimator, &picked);
    let mut look = Look {
        size: job.size.map(|extent| extent as f32),
        view: job.view,
        to_scale: job.to_scale,
        sharp: sharp_depths(&job.settings),
        kept: [0, 1].map(|number| job.kept.get(number).copied()),
        picture: None,
        scale: None,
    };
    let picture =
        job.picture.as_deref().map(|file| read_picture(file, job.settings.estimator.size)).transpose()?;
    let excerpt = picture.map(|pixels| {
        let reach = diagram::draw(&diagram, &look).reach;
        Excerpt::of(&pixels, job.settings.estimator.size, position.map(|at| at as u32), reach)
    });
    look.picture = excerpt.as_ref();
    save_drawing(&diagram::draw(&diagram, &look), &job.output)?;
    if !job.quiet {
        say(&format!("{}: {}", job.output.display(), diagram::sentence(&diagram)))?;
    }
    Ok(())
}

/// Reads the pixels of a PNG, which must have this size.
fn read_picture(path: &Path, size: [u32; 2]) -> Result<Vec<[u8; 3]>> {
    let wrong = |why: String| {
        Error::OutOfRange(format!(
            "--picture {}: {why}; it must be a PNG that thinlens has saved",
            path.display()
        ))
    };
    let file = input_file::open(path)?;
    let decoded = input_file::guarded(|| decode(file, size));
    decoded.unwrap_or_else(|| Err("it is damaged".into())).map_err(wrong)
}

fn decode(file: File, [width, height]: [u32; 2]) -> std::result::Result<Vec<[u8; 3]>, String> {
    let unreadable = |error: png::DecodingError| format!("it cannot be read ({error})");
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(unreadable)?;
    let info = reader.info();
    if [info.width, info.height] != [width, height] {
        return Err(format!(
            "it has {}x{} pixels, but the drawing is of a picture with {width}x{height} pixels",
            info.width, info.height
        ));
    }
    if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
        return Err("its pixels are not red, green and blue in 8 bits each".into());
    }
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    while let Some(row) = reader.next_row().map_err(unreadable)? {
        pixels.extend(row.data().chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]));
    }
    Ok(pixels)
}
