//! Prints the manual page of the program.

use std::io::{self, Write};

use clap::Command;
use clap_mangen::Man;

use super::failure::{CommandError, Status};

/// Prints the page of the command line as the program `man` reads it.
pub(crate) fn print(command: Command) -> Result<Status, CommandError> {
    let mut page = Vec::new();
    write_page(command, &mut page)?;
    io::stdout().write_all(&page)?;
    Ok(Status::Good)
}

/// Writes one page for all commands, since they share their options and are installed together.
fn write_page(command: Command, page: &mut Vec<u8>) -> io::Result<()> {
    let mut command = command.disable_help_subcommand(true);
    command.build();
    let man = Man::new(command.clone());
    man.render_title(page)?;
    man.render_name_section(page)?;
    man.render_synopsis_section(page)?;
    man.render_description_section(page)?;
    man.render_options_section(page)?;
    writeln!(page, ".SH COMMANDS")?;
    for subcommand in command.get_subcommands().filter(|c| !c.is_hide_set()) {
        write_command(page, subcommand)?;
    }
    writeln!(page, ".SH \"EXIT STATUS\"")?;
    let status = command.get_after_help().map(ToString::to_string);
    let status = status.unwrap_or_default();
    let status = status.strip_prefix("Exit status: ").unwrap_or(&status);
    writeln!(page, "{status}")?;
    man.render_version_section(page)
}

/// Writes what one command does, and its own options.
fn write_command(page: &mut Vec<u8>, command: &Command) -> io::Result<()> {
    let own = command.clone().mut_args(|argument| {
        let is_shared = argument.is_global_set() || argument.get_id() == "help";
        argument.hide(is_shared)
    });
    let own = own.disable_help_flag(true);
    let man = Man::new(own);
    let mut text = Vec::new();
    man.render_synopsis_section(&mut text)?;
    man.render_description_section(&mut text)?;
    man.render_options_section(&mut text)?;
    writeln!(page, ".SS {}", command.get_name())?;
    for line in String::from_utf8_lossy(&text).lines() {
        // One heading stands for the whole command: its own headings become paragraph breaks.
        if line.starts_with(".SH ") {
            writeln!(page, ".PP")?;
        } else if !line.starts_with(".ie ") && !line.starts_with(".el ") {
            writeln!(page, "{line}")?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::arguments::Arguments;
    use clap::CommandFactory;

    #[test]
    fn the_page_lists_every_command_and_its_options_once() {
        let mut page = Vec::new();
        write_page(Arguments::command(), &mut page).unwrap();
        let page = String::from_utf8(page).unwrap();
        for command in Arguments::command().get_subcommands() {
            let heading = format!("\n.SS {}\n", command.get_name());
            assert_eq!(page.matches(&heading).count(), 1, "{heading}");
        }
        for option in ["seed", "realtime", "bless", "record", "journal"] {
            let option = format!("\n\\fB\\-\\-{option}\\fR");
            assert_eq!(page.matches(&option).count(), 1, "{option}");
        }
    }
}
