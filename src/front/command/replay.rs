//! Replays transcripts and reports how they differ.

use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use lisp::visible::visible;

use super::failure::{CommandError, Status, read};
use super::open::open_session;
use super::options::{Options, seconds};
use super::paint::Paint;
use super::stop_at::stop_at;
use crate::transcript::{Transcript, Verdict, blessed, replay_all};

/// What to replay.
#[derive(Args, Debug)]
pub(crate) struct ReplayArguments {
    /// Transcripts, or Markdown files with blocks marked `session`
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Rewrite the expected output where it differs, keeping wildcards that still match
    #[arg(long)]
    bless: bool,
    /// Stop after the N-th input of the transcript and open the prompt there
    #[arg(long, value_name = "N", conflicts_with_all = ["bless", "jobs"])]
    stop_at: Option<usize>,
    /// Number of files to run in parallel [default: the number of processors]
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Real time that each file may take; then its inputs are interrupted
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<f64>,
}

/// Replays the files and prints the differences, or rewrites the expected output; or opens the
/// prompt in the middle of a file.
pub(crate) fn replay(options: &Options, wanted: &ReplayArguments) -> Result<Status, CommandError> {
    let files = &wanted.files;
    if let Some(entry) = wanted.stop_at {
        return stop_at(options, files, entry);
    }
    let transcripts: Vec<Transcript> = files
        .iter()
        .map(|path| Ok(Transcript::parse(&path.display().to_string(), &read(path)?)))
        .collect::<Result<_, CommandError>>()?;
    if let Some(empty) = transcripts.iter().find(|t| t.entries.is_empty()) {
        return Err(CommandError::Open(format!(
            "{} has nothing to replay: a transcript has inputs behind prompts, and a Markdown file \
             blocks marked `session`",
            empty.name
        )));
    }
    let jobs = wanted
        .jobs
        .or_else(|| std::thread::available_parallelism().ok())
        .unwrap_or(NonZeroUsize::MIN);
    let mut report = Report::new(options, wanted.bless);
    let mut files = files.iter();
    let mut told = Ok(());
    replay_all(
        &transcripts,
        jobs,
        || {
            let mut session = open_session(options)?;
            session.set_time_limit(wanted.time_limit.map(Duration::from_secs_f64));
            Ok(session)
        },
        |transcript, verdicts| {
            let path = files.next();
            if told.is_ok() {
                told = verdicts.and_then(|verdicts| report.file(path, transcript, &verdicts));
            }
            told.is_ok()
        },
    );
    told?;
    report.end()
}

/// Prints how a transcript differs from outputs that come from elsewhere.
pub(super) fn report(
    options: &Options,
    transcript: &Transcript,
    verdicts: &[Verdict],
) -> Result<Status, CommandError> {
    let mut report = Report::new(options, false);
    report.file(None, transcript, verdicts)?;
    report.end()
}

struct Report<W> {
    to: W,
    paint: Paint,
    bless: bool,
    passed: usize,
    failed: usize,
}

impl Report<io::BufWriter<io::Stdout>> {
    fn new(options: &Options, bless: bool) -> Self {
        Report {
            to: io::BufWriter::new(io::stdout()),
            paint: Paint::new(options.color, &io::stdout()),
            bless,
            passed: 0,
            failed: 0,
        }
    }
}

impl<W: Write> Report<W> {
    fn file(
        &mut self,
        path: Option<&PathBuf>,
        transcript: &Transcript,
        verdicts: &[Verdict],
    ) -> Result<(), CommandError> {
        let failed = verdicts.iter().filter(|verdict| !verdict.passed()).count();
        self.failed += failed;
        self.passed += verdicts.len() - failed;
        match path {
            Some(path) if self.bless => {
                if failed > 0 {
                    rewrite(path, &blessed(transcript, verdicts))?;
                    let name = visible(&transcript.name);
                    writeln!(self.to, "{name}: {failed} rewritten")?;
                }
            }
            _ => self.differences(transcript, verdicts)?,
        }
        self.to.flush()?;
        Ok(())
    }

    fn differences(
        &mut self,
        transcript: &Transcript,
        verdicts: &[Verdict],
    ) -> Result<(), CommandError> {
        for verdict in verdicts {
            let Verdict::Failed(difference) = verdict else {
                continue;
            };
            let place = format!("{}:{}:", transcript.name, difference.line);
            let input = visible(&difference.input);
            writeln!(self.to, "{} {input}", self.paint.bad(&place))?;
            for line in ["--- expected", "+++ printed"] {
                writeln!(self.to, "{}", self.paint.diff_line(line))?;
            }
            for line in difference.unified() {
                writeln!(self.to, "{}", self.paint.diff_line(&line))?;
            }
            writeln!(self.to)?;
        }
        Ok(())
    }

    fn end(mut self) -> Result<Status, CommandError> {
        let (passed, failed) = (self.passed, self.failed);
        let what = if self.bless { "rewritten" } else { "failed" };
        writeln!(self.to, "{passed} passed, {failed} {what}")?;
        self.to.flush()?;
        Ok(if failed == 0 || self.bless {
            Status::Good
        } else {
            Status::Bad
        })
    }
}

fn rewrite(path: &PathBuf, text: &str) -> Result<(), CommandError> {
    std::fs::write(path, text).map_err(|error| CommandError::Rewrite {
        path: path.clone(),
        error,
    })
}
