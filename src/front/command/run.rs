//! Loads plan files and evaluates forms.

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use super::check::described;
use super::failure::{CommandError, Status, read};
use super::open::open_session;
use super::options::{Options, seconds};
use super::outputs::Outputs;
use super::paint::Paint;
use super::watching::{self, WatchArguments, Watching, Writing};
use lisp::visible::visible;
use session::Session;
use session::dialogue::{Abort, Evaluate, Outcome, Screen, Severity, evaluate_keeping_abort};

/// What to run.
#[derive(Args, Debug)]
pub(crate) struct RunArguments {
    /// Files to load, in order; the values of their forms are not shown
    #[arg(value_name = "FILE", required_unless_present = "eval")]
    pub(super) files: Vec<PathBuf>,
    /// Form to evaluate after loading the files; its values are shown
    #[arg(long, value_name = "FORM")]
    pub(super) eval: Vec<String>,
    /// Real time that all of it may take; then it is interrupted
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(super) time_limit: Option<f64>,
    /// Write what was performed, by the last ten plans at most, into a folder as JSON Lines, for `planwright ask`
    #[arg(long, value_name = "FOLDER")]
    pub(super) episode: Option<PathBuf>,
    #[command(flatten)]
    pub(super) watch: WatchArguments,
}

/// Loads the files, then evaluates the forms, up to the first unhandled condition. Output goes
/// to standard output, the condition to standard error.
pub(crate) fn run(options: &Options, wanted: &RunArguments) -> Result<Status, CommandError> {
    let RunArguments {
        files,
        eval,
        time_limit,
        episode,
        watch,
    } = wanted;
    Outputs::reading(files.iter().chain(options.files()))
        .file("--record", watch.record.as_ref())
        .file("--html", watch.html.as_ref())
        .check()?;
    let mut watched = Watching::default();
    let mut writing = Writing::default();
    let begin = |session: &mut Session| {
        watched = watching::begin(session, watch)?;
        writing = watching::finish_at_interrupt(session, watch, &watched);
        session.set_time_limit(time_limit.map(Duration::from_secs_f64));
        Ok(())
    };
    let (status, mut session) = run_in(options, files, eval, begin)?;
    if let Some(folder) = episode {
        write_episode(&mut session, folder)?;
    }
    let recorded = session.end_recording();
    session.write_kept_run()?;
    recorded?;
    writing.end();
    watching::linger(&session, watched);
    session.end_with_process();
    Ok(status)
}

/// Writes what was performed into the folder.
fn write_episode(session: &mut Session, folder: &Path) -> Result<(), CommandError> {
    let folder = std::path::absolute(folder)?;
    let form = format!("(pw:export-episode {})", quoted(&folder.to_string_lossy()));
    let mut screen = Screen::new(io::sink());
    let (_, abort) = evaluate_keeping_abort(&mut screen, session, "--episode", &form)?;
    match abort {
        None => Ok(()),
        Some(abort) => Err(CommandError::Episode {
            path: folder,
            report: abort.report,
        }),
    }
}

/// A text as a string of the plan language.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Like [`run`], in a session that `begin` prepares, and that is returned.
pub(crate) fn run_in(
    options: &Options,
    files: &[PathBuf],
    forms: &[String],
    begin: impl FnOnce(&mut Session) -> Result<(), CommandError>,
) -> Result<(Status, Session), CommandError> {
    // Report a file that cannot be read before the robot moves.
    let files: Vec<Text> = files
        .iter()
        .map(|path| Text::of_file(path))
        .collect::<Result<_, _>>()?;
    let forms = forms
        .iter()
        .enumerate()
        .map(|(at, form)| Text::of_form(at, form));
    let paint = Paint::new(options.color, &io::stderr());
    let mut session = open_session(options)?;
    warn(&session, &files, paint)?;
    begin(&mut session)?;
    let mut screen = Screen::new(io::BufWriter::new(io::stdout()));
    screen.set_cautious(io::stdout().is_terminal());
    for text in files.into_iter().chain(forms) {
        match text.evaluate(&mut session, &mut screen)? {
            Ended::Finished => {}
            Ended::Quit(code) => return Ok((Status::Left(code), session)),
            Ended::Aborted(abort) => {
                screen.fresh_line()?;
                screen.flush()?;
                // If standard error is closed, the exit status must do.
                let _ = io::stderr().write_all(text.describe(abort.as_deref(), paint).as_bytes());
                return Ok((Status::Bad, session));
            }
        }
    }
    Ok((Status::Good, session))
}

/// Prints warnings about the files to standard error before any of them is evaluated. Whatever
/// cannot be read or compiled is reported when its turn comes.
///
/// The files are checked in a copy of the session, because their definitions take effect.
fn warn(session: &Session, files: &[Text], paint: Paint) -> Result<(), CommandError> {
    if files.iter().all(|file| file.text.trim().is_empty()) {
        return Ok(());
    }
    let mut session = session
        .copied()
        .map_err(|cause| CommandError::Open(format!("a session cannot be copied: {cause}")))?;
    for file in files {
        for finding in session.check(&file.name, &file.text) {
            if finding.severity == Severity::Warning {
                let text = format!("warning: {}", described(&file.name, &finding, paint));
                // If standard error is closed, the warning is lost.
                let _ = io::stderr().write_all(text.as_bytes());
            }
        }
    }
    Ok(())
}

/// A text to evaluate.
struct Text {
    name: String,
    text: String,
    /// Whether to show the values of forms.
    echo: bool,
}

enum Ended {
    Finished,
    Quit(u8),
    Aborted(Option<Box<Abort>>),
}

impl Text {
    fn of_file(path: &Path) -> Result<Self, CommandError> {
        Ok(Text {
            name: path.display().to_string(),
            text: read(path)?,
            echo: false,
        })
    }

    fn of_form(at: usize, form: &str) -> Self {
        Text {
            name: format!("--eval[{}]", at + 1),
            text: form.to_owned(),
            echo: true,
        }
    }

    fn evaluate(
        &self,
        session: &mut impl Evaluate,
        screen: &mut Screen<impl Write>,
    ) -> Result<Ended, CommandError> {
        screen.set_echo(self.echo);
        let (outcome, abort) = evaluate_keeping_abort(screen, session, &self.name, &self.text)?;
        Ok(match outcome {
            Outcome::Finished => Ended::Finished,
            Outcome::Quit(code) => Ended::Quit(code),
            Outcome::Aborted | Outcome::Stopped => Ended::Aborted(abort.map(Box::new)),
        })
    }

    /// The condition with its place, and the form underlined.
    fn describe(&self, abort: Option<&Abort>, paint: Paint) -> String {
        let Some(abort) = abort else {
            return format!("{}: {}\n", visible(&self.name), paint.bad("aborted"));
        };
        let place = abort.main_place();
        let at = place.map_or_else(|| visible(&self.name).into_owned(), ToString::to_string);
        let mut text = format!("{at}: {}\n", paint.bad(abort.report.trim_end()));
        if let Some(place) = place {
            text.push_str(&place.underlined());
            text.push('\n');
        }
        for line in abort.context() {
            text.push_str(&visible(&line));
            text.push('\n');
        }
        let condition = visible(&abort.condition);
        text.push_str(&format!("; Evaluation aborted on {condition}.\n"));
        text
    }
}

#[cfg(test)]
mod tests {
    use crate::command::paint::ColorWhen;
    use crate::command::run::*;
    use lisp::source::Location;

    fn abort(place: Option<Location>) -> Abort {
        Abort {
            report: "The variable B is unbound.".to_owned(),
            condition: "#<UNBOUND-VARIABLE B>".to_owned(),
            place,
            ..Abort::default()
        }
    }

    fn described(place: Option<Location>) -> String {
        let paint = Paint::new(ColorWhen::Never, &io::stderr());
        Text::of_form(0, "(print b)").describe(Some(&abort(place)), paint)
    }

    #[test]
    fn a_condition_is_reported_with_its_place_and_form() {
        let place = Location {
            name: "a.plan".into(),
            line: 3,
            column: 8,
            line_text: "(print b)".to_owned(),
            width: 1,
        };
        assert_eq!(
            described(Some(place)),
            "a.plan:3:8: The variable B is unbound.\n\
             (print b)\n\
             \x20      ^\n\
             ; Evaluation aborted on #<UNBOUND-VARIABLE B>.\n"
        );
    }

    #[test]
    fn the_users_own_place_comes_before_that_in_a_built_in_plan() {
        let place = |name: &str| Location {
            name: name.into(),
            line: 3,
            column: 8,
            line_text: "(print b)".to_owned(),
            width: 1,
        };
        let mut abort = abort(Some(place("plans/lib/going.plan")));
        abort.user_place = Some(place("a.plan"));
        let paint = Paint::new(ColorWhen::Never, &io::stderr());
        assert_eq!(
            Text::of_form(0, "").describe(Some(&abort), paint),
            "a.plan:3:8: The variable B is unbound.\n\
             (print b)\n\
             \x20      ^\n\
             signalled at plans/lib/going.plan:3:8\n\
             ; Evaluation aborted on #<UNBOUND-VARIABLE B>.\n"
        );
    }

    #[test]
    fn without_a_place_the_text_is_named() {
        assert_eq!(
            described(None),
            "--eval[1]: The variable B is unbound.\n\
             ; Evaluation aborted on #<UNBOUND-VARIABLE B>.\n"
        );
    }
}
