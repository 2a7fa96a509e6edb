//! Replays transcripts and reports how they differ.

use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::PathBuf;

use super::arguments::Options;
use super::failure::{CommandError, Status, read};
use super::open::open_session;
use super::paint::Paint;
use crate::transcript::{Transcript, Verdict, blessed, replay_all};

/// Replays the files and prints the differences, or rewrites the expected output.
pub(crate) fn replay(
    options: &Options,
    files: &[PathBuf],
    bless: bool,
    jobs: Option<NonZeroUsize>,
) -> Result<Status, CommandError> {
    let transcripts: Vec<Transcript> = files
        .iter()
        .map(|path| Ok(Transcript::parse(&path.display().to_string(), &read(path)?)))
        .collect::<Result<_, CommandError>>()?;
    let jobs = jobs
        .or_else(|| std::thread::available_parallelism().ok())
        .unwrap_or(NonZeroUsize::MIN);
    let mut report = Report::new(options, bless);
    let mut files = files.iter();
    let mut told = Ok(());
    replay_all(
        &transcripts,
        jobs,
        || open_session(options),
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
                    writeln!(self.to, "{}: {failed} rewritten", transcript.name)?;
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
            writeln!(self.to, "{} {}", self.paint.bad(&place), difference.input)?;
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
