//! The settings as options of the command line, and the values that were given there.

use super::setting::file;
use super::{Access, Called, Role, Setting, Settings, Unit, Value, list};
use crate::error::Result;
use clap::builder::{PathBufValueParser, PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::{Arg, ArgMatches, Command, FromArgMatches};

/// New values for some settings, in the order of the list.
#[derive(Clone, Default)]
pub struct Changes(Vec<(&'static Setting, Value)>);

impl Changes {
    /// The values that were given.
    pub fn of_matches(matches: &ArgMatches) -> Self {
        let given = |setting: &'static Setting| {
            matches.get_one::<Value>(setting.flag).map(|value| (setting, value.clone()))
        };
        Self(list::all().filter_map(given).collect())
    }

    /// A new value for the setting with this flag.
    pub fn of(flag: &str, value: Value) -> Self {
        Self(vec![(list::setting(flag), value)])
    }

    /// Whether nothing was given.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The new value of the setting with this flag, if there is one.
    pub fn get(&self, flag: &str) -> Option<&Value> {
        self.0.iter().find(|(setting, _)| setting.flag == flag).map(|(_, value)| value)
    }

    /// Changes the settings that have a new value.
    ///
    /// # Errors
    /// [`crate::error::Error::OutOfRange`], or the errors of reading an image.
    pub fn apply(&self, settings: &mut Settings) -> Result<()> {
        for (setting, value) in &self.0 {
            // The scene's own camera and lens depend on how its model stands.
            if !setting.is_of_model() {
                settings.restage()?;
            }
            // The check of all settings looks at own values alone, and an alias has none.
            if setting.is_alias() {
                setting.check(value, Called::Flag)?;
            }
            setting.set(settings, value)?;
        }
        settings.restage()?;
        settings.check()
    }
}

impl std::fmt::Debug for Changes {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_map().entries(self.0.iter().map(|(setting, value)| (setting.flag, value))).finish()
    }
}

impl clap::Args for Changes {
    fn augment_args(command: Command) -> Command {
        let options = list::GROUPS
            .iter()
            .flat_map(|group| group.settings.iter().map(|setting| option(setting).help_heading(group.title)));
        command.args(options)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Changes {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        Ok(Self::of_matches(matches))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> std::result::Result<(), clap::Error> {
        *self = Self::of_matches(matches);
        Ok(())
    }
}

/// The option of a setting.
fn option(setting: &'static Setting) -> Arg {
    let default = match setting.default {
        "" => String::new(),
        default => format!(" [default: {default}]"),
    };
    let mut option = Arg::new(setting.flag).long(setting.flag).help(format!("{}{default}", setting.help));
    if let Some(letter) = setting.letter {
        option = option.short(letter);
    }
    if let Role::Alias([other]) = setting.role {
        option = option.conflicts_with(other);
    }
    let text = ValueParser::new(|text: &str| setting.parse(text));
    match &setting.access {
        // clap takes -1/3 and -12,5 for options.
        Access::Vector(..)
        | Access::Color(..)
        | Access::Single(_, _, Unit::Stops | Unit::Degrees | Unit::Millimetres) => {
            option.allow_hyphen_values(true).value_name(setting.value_name).value_parser(text)
        }
        Access::Switch(_) => {
            let option = option.num_args(0..=1).require_equals(true).default_missing_value("true");
            option.value_name(setting.value_name).value_parser(text)
        }
        Access::Image(_) => option
            .value_name(setting.value_name)
            .value_parser(PathBufValueParser::new().map(|path| file(&path))),
        Access::Choice(_, choices) => {
            let choices = choices();
            let names: Vec<&str> = choices.iter().map(|choice| choice.name).collect();
            let explained = choices.iter().any(|choice| !choice.help.is_empty());
            let listed = setting.value_name.is_empty() && !explained;
            let name = match setting.value_name {
                "" => names.join("|"),
                name => name.into(),
            };
            let values = choices.iter().map(|choice| PossibleValue::new(choice.name).help(choice.help));
            let one = PossibleValuesParser::new(values).try_map(|name| setting.parse(&name));
            option.value_name(name).hide_possible_values(listed).value_parser(one)
        }
        _ => option.allow_negative_numbers(true).value_name(setting.value_name).value_parser(text),
    }
}
