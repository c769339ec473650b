//! The command line: parse, choose window or file, print the error.

use clap::Parser;
use std::process::ExitCode;
use thinlens::cli::{Cli, Command, RenderArgs};
use thinlens::error::Result;
use thinlens::{output, scene};

fn main() -> ExitCode {
    let cli = Cli::parse();
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn")).init();
    match run(cli.command.unwrap_or(Command::Devices)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("thinlens: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::Render(args) => render(args),
        Command::Scenes => {
            for scene in scene::BUILTINS {
                println!("{:16} {}", scene.name, scene.about);
            }
            Ok(())
        }
        _ => output::list_devices(),
    }
}

fn render(args: RenderArgs) -> Result<()> {
    output::render(&output::Job {
        settings: args.settings()?,
        output: args.output,
        stats: args.stats,
        device: args.device.device,
        validation: args.device.validation,
        quiet: args.quiet,
    })
}
