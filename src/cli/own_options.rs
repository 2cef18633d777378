//! Options that only one format of instruments' files has: they come from its entry in the register,
//! so that a new format brings its own.

use std::collections::BTreeMap;

use clap::builder::{PossibleValuesParser, ValueParser};
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};

use crate::importers::{IMPORTERS, OwnOption};

/// What was given of them, by their names without dashes.
#[derive(Debug, Default)]
pub(crate) struct OwnOptions {
    pub(crate) values: BTreeMap<&'static str, String>,
}

/// Every such option once, with the formats that have it.
fn all() -> Vec<(&'static OwnOption, Vec<&'static str>)> {
    let mut all: Vec<(&'static OwnOption, Vec<&'static str>)> = Vec::new();
    for importer in IMPORTERS {
        for option in importer.options {
            match all.iter_mut().find(|(other, _)| other.name == option.name) {
                Some((_, formats)) => formats.push(importer.id),
                None => all.push((option, vec![importer.id])),
            }
        }
    }
    all
}

impl FromArgMatches for OwnOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut own = Self::default();
        own.update_from_arg_matches(matches)?;
        Ok(own)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        for (option, _) in all() {
            if let Some(value) = matches.get_one::<String>(option.name) {
                self.values.insert(option.name, value.clone());
            }
        }
        Ok(())
    }
}

impl Args for OwnOptions {
    fn augment_args(command: Command) -> Command {
        all()
            .into_iter()
            .fold(command, |command, (option, formats)| {
                let help = format!("With --as {}: {}", formats.join(" or "), option.help);
                let values: ValueParser = match option.values {
                    [] => ValueParser::string(),
                    values => PossibleValuesParser::new(values).into(),
                };
                let arg = Arg::new(option.name).long(option.name).help(help);
                command.arg(arg.value_name(option.value).value_parser(values))
            })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}
