//! Answers questions about many runs, or writes what can be asked into a file for other tools.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use clap::Args;

use super::ask_sqlite;
use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::run::quoted;
use session::dialogue::{Outcome, Screen, evaluate_keeping_abort};

/// What to ask.
#[derive(Args, Debug)]
pub(crate) struct AskArguments {
    /// Records of a sweep (a file, or the folder of --into or --episodes), a recording (an MCAP file), or the
    /// folder of an exported episode
    #[arg(value_name = "SOURCE")]
    source: PathBuf,
    /// A goal of Prolog, such as '(fact run :outcome :failure :class ?class)'; without one, tells which
    /// facts there are
    #[arg(value_name = "GOAL")]
    goal: Option<String>,
    /// Print equal answers once, with how many there are, the most frequent first
    #[arg(long)]
    count: bool,
    /// The variables to show, in this order, such as '?class ?x' [default: all of the goal]
    #[arg(long, value_name = "VARIABLES")]
    show: Option<String>,
    /// Print an object of JSON for each answer
    #[arg(long)]
    json: bool,
    /// Write all facts into an SQLite file, which must not exist, instead of answering a goal
    #[arg(long, value_name = "FILE", conflicts_with_all = ["goal", "count", "show", "json"])]
    sqlite: Option<PathBuf>,
}

/// Reads the facts and prints the answers.
pub(crate) fn ask(options: &Options, wanted: &AskArguments) -> Result<Status, CommandError> {
    if let Some(file) = &wanted.sqlite {
        return ask_sqlite::write(&wanted.source, file);
    }
    let source = std::path::absolute(&wanted.source)?;
    let source = quoted(&source.to_string_lossy());
    // Rules of files that are loaded may ask for more than the goal shows.
    let goal = wanted.goal.as_ref().filter(|_| options.setup.is_empty());
    let read = match goal {
        Some(goal) => format!("(pw:read-facts {source} (coe::asked {}))", quoted(goal)),
        None => format!("(pw:read-facts {source})"),
    };
    let question = match &wanted.goal {
        None => "(coe::print-relations)".to_owned(),
        Some(goal) => {
            let show = wanted.show.as_ref().map(|show| format!("({show})"));
            let show = show.map(|show| format!(" :show (coe::asked {})", quoted(&show)));
            let is = |is| if is { "t" } else { "nil" };
            format!(
                "(pw:ask (coe::asked {}){} :count {} :json {})",
                quoted(goal),
                show.unwrap_or_default(),
                is(wanted.count),
                is(wanted.json)
            )
        }
    };
    let mut session = open_session(options)?;
    let mut screen = Screen::new(io::BufWriter::new(io::stdout()));
    screen.set_cautious(io::stdout().is_terminal());
    screen.set_echo(false);
    for text in [read, question] {
        let (outcome, abort) = evaluate_keeping_abort(&mut screen, &mut session, "ask", &text)?;
        if outcome != Outcome::Finished {
            screen.flush()?;
            let report = abort.map_or("interrupted".to_owned(), |abort| abort.report);
            return Err(CommandError::Ask(report.trim_end().to_owned()));
        }
    }
    screen.flush()?;
    session.end_with_process();
    Ok(Status::Good)
}
