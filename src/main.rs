//! The command line: parse, choose window or file, print the error.

use clap::Parser;
use std::process::ExitCode;
use thinlens::cli::{BenchArgs, Cli, Command, RenderArgs, ViewArgs};
use thinlens::error::{Error, Result};
use thinlens::{app, bench, output, verify};

fn main() -> ExitCode {
    let cli = Cli::parse();
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn")).init();
    if let Err(error) = run(cli.command.unwrap_or_else(|| Command::View(ViewArgs::default()))) {
        eprintln!("thinlens: {error}");
        return ExitCode::from(error.exit_code());
    }
    ExitCode::SUCCESS
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::View(args) => view(&args),
        Command::Render(RenderArgs { settings, autofocus, output, stats, device, quiet }) => {
            let settings = output::load(quiet, || settings.of_file())?;
            output::render(&output::Job {
                settings,
                autofocus,
                output,
                stats,
                device: device.choice(),
                quiet,
            })
        }
        Command::Verify(args) => {
            output::say(&verify::run(&args.settings.of_proof()?, &args.device.choice())?)
        }
        Command::Bench(args) => bench::run(&bench::Job {
            pictures: args.pictures()?,
            samplers: BenchArgs::samplers(),
            runs: args.runs,
            device: args.device.choice(),
            json: args.json,
        }),
        Command::Devices => output::list_devices(),
        Command::Scenes => output::list_scenes(),
    }
}

fn view(args: &ViewArgs) -> Result<()> {
    let (scene, device) = (args.settings.scene().to_owned(), args.device.choice());
    let settings = output::load(false, || args.settings.of_window())?;
    match app::run(app::Options {
        settings,
        size: args.settings.size,
        scene: scene.clone(),
        device: device.clone(),
    }) {
        Err(Error::NoDisplay(why)) => output::render_instead(args.settings.of_file()?, &scene, device, &why),
        outcome => outcome,
    }
}
