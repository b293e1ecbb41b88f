//! The commands of the documents and of the help texts are commands that the program takes.

use clap::FromArgMatches;
use clap::error::ErrorKind;

use super::{Cli, program, with_negative_numbers};

#[path = "../tests/commands/mod.rs"]
mod commands;

/// Why the program would not take these arguments. A map that is not in this repository is nothing against them.
fn refusal(arguments: &[String]) -> Option<clap::Error> {
    let all = ["tautline"].into_iter().chain(arguments.iter().map(String::as_str));
    let taken = with_negative_numbers(program()).try_get_matches_from(all);
    let error = taken.and_then(|matches| Cli::from_arg_matches(&matches)).err()?;
    let is_map_elsewhere = error.kind() == ErrorKind::ValueValidation
        && error.to_string().contains(".map: there is no such file");
    (error.kind() != ErrorKind::DisplayHelp && !is_map_elsewhere).then_some(error)
}

#[test]
fn every_command_of_the_documents_is_one_that_the_program_takes() {
    let mut count = 0;
    for block in commands::blocks() {
        for arguments in block.commands {
            let refused = refusal(&arguments);
            assert!(
                refused.is_none(),
                "{}: tautline {arguments:?}\n{}",
                block.place,
                refused.expect("an error")
            );
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

#[test]
fn a_command_within_a_sentence_has_no_option_that_there_is_not() {
    let spans = commands::spans();
    assert!(spans.len() > 100, "{}", spans.len());
    // That is the first line of a layout.
    for (place, arguments) in spans.into_iter().filter(|(_, arguments)| *arguments != ["layout", "1"]) {
        if let Some(error) = refusal(&arguments) {
            // A sentence may name a command without all that it needs.
            let is_part = matches!(
                error.kind(),
                ErrorKind::MissingRequiredArgument | ErrorKind::MissingSubcommand | ErrorKind::DisplayVersion
            );
            assert!(is_part, "{place}: tautline {arguments:?}\n{error}");
        }
    }
}

/// The help of a command and of those within it.
fn helps(command: &clap::Command) -> Vec<String> {
    let own = command.get_after_help().map(ToString::to_string);
    own.into_iter().chain(command.get_subcommands().flat_map(helps)).collect()
}

#[test]
fn every_example_of_a_help_text_is_a_command_that_the_program_takes() {
    let mut count = 0;
    for help in helps(&program()) {
        for arguments in help.lines().filter_map(commands::arguments) {
            let refused = refusal(&arguments);
            assert!(refused.is_none(), "tautline {arguments:?}\n{}", refused.expect("an error"));
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}
