//! The command line: parse, choose window or file, print the error.

use std::process::ExitCode;
use thinlens::cli::{self, Command, RenderArgs, SettingsArgs, ViewArgs};
use thinlens::error::{Error, Result};
use thinlens::settings::{Place, Settings};
use thinlens::{app, bench, interrupt, output, verify};

fn main() -> ExitCode {
    let cli = cli::parse();
    listen();
    interrupt::install();
    if let Err(error) = run(cli.command.unwrap_or_else(|| Command::View(ViewArgs::default()))) {
        eprintln!("thinlens: {error}");
        return ExitCode::from(error.exit_code());
    }
    ExitCode::SUCCESS
}

/// Writes the log to standard error, as far as `RUST_LOG` asks for it.
fn listen() {
    let log = env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn")).build();
    // Errors of dialogs are heard in any case.
    log::set_max_level(log.filter().max(log::LevelFilter::Error));
    log::set_boxed_logger(Box::new(app::DialogLog(log))).expect("there is no other log");
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::View(args) => view(&args),
        Command::Render(args) => {
            let focusing = args.focusing();
            let RenderArgs { from, settings, output, stats, device, quiet, .. } = args;
            let settings = output::load(quiet, || match &from {
                Some(picture) => settings.of_picture(&output::Origin::read(picture)?.arguments),
                None => settings.for_render(),
            })?;
            output::render(&output::Job {
                settings,
                from,
                focusing,
                output,
                stats,
                device: device.choice(),
                quiet,
            })
        }
        Command::Sweep(args) => output::sweep(&output::SweepJob {
            settings: output::load(args.quiet, || args.settings.for_render())?,
            sweep: args.sweep(),
            columns: args.columns,
            output: args.output,
            device: args.device.choice(),
            quiet: args.quiet,
        }),
        Command::Diagram(args) => output::draw_optics(&output::DrawingJob {
            settings: output::load(args.quiet, || args.settings.for_render())?,
            pixel: args.pixel.unwrap_or(Place::Centre),
            size: args.drawing_size,
            rays: args.rays,
            view: args.view,
            kept: args.also_at,
            picture: args.picture,
            to_scale: args.to_scale,
            output: args.output,
            device: args.device.choice(),
            quiet: args.quiet,
        }),
        Command::Save(args) => output::save_scene(&args.settings.for_render()?, &args.output),
        Command::Verify(args) => {
            output::say(&verify::run(&args.settings.for_verify()?, &args.device.choice())?)
        }
        Command::Bench(args) => bench::run(&bench::Job {
            pictures: args.pictures()?,
            runs: args.runs,
            device: args.device.choice(),
            json: args.json,
        }),
        Command::Devices => output::list_devices(),
        Command::Scenes => output::list_scenes(),
    }
}

fn view(args: &ViewArgs) -> Result<()> {
    let (memory, device) = (app::Memory::load(), args.device.choice());
    let scene = args.settings.scene();
    let picture = output::PictureFormat::of(scene);
    // A saved picture has settings of its own.
    let chosen = |of_scene: fn(&SettingsArgs) -> Result<Settings>| match picture {
        Some(_) => args.settings.of_picture(&output::Origin::read(scene)?.arguments),
        None => of_scene(&args.settings),
    };
    let named = || output::load(false, || chosen(SettingsArgs::for_viewer));
    let again = args.settings.is_plain() && !memory.arguments.is_empty();
    // What was there the last time may be gone by now.
    let (settings, initial, message) = match again.then(|| Settings::of_arguments(&memory.arguments)) {
        Some(Ok(settings)) => (settings.clone(), settings.of_scene_alone(), None),
        Some(Err(error)) => (named()?, named()?, Some(error.to_string())),
        None => {
            let settings = named()?;
            let initial = if picture.is_some() { settings.of_scene_alone() } else { settings.clone() };
            (settings, initial, None)
        }
    };
    let size = args.settings.size();
    match app::run(app::Options { settings, initial, size, memory, message, device: device.clone() }) {
        Err(Error::NoDisplay(why)) => output::render_instead(chosen(SettingsArgs::for_render)?, device, &why),
        outcome => outcome,
    }
}
