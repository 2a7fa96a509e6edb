//! Engines that run shards on many machines, by their own command lines.

use std::env;
use std::fmt::Write;
use std::process::Command;

use clap::ValueEnum;

use super::job::Job;
use crate::command::failure::CommandError;

/// An engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    /// Slurm: job arrays
    Slurm,
    /// HyperQueue: task arrays
    Hq,
}

/// Longest array if Slurm does not tell: what its documentation says.
const MAX_ARRAY_SIZE: u64 = 1001;

impl Engine {
    /// Submits the missing shards; returns what the engine said.
    pub(super) fn submit(
        self,
        job: &Job,
        threads: usize,
        more: &[String],
    ) -> Result<String, CommandError> {
        let missing = job.missing();
        let size = match self {
            Self::Slurm => max_array_size().max(1),
            Self::Hq => u64::MAX,
        };
        let mut said = String::new();
        let mut rest = missing.as_slice();
        while let Some(first) = rest.first() {
            // Indexes of an array are below the size; the worker adds the offset.
            let offset = first / size * size;
            let count = rest.partition_point(|shard| *shard - offset < size);
            let (now, later) = rest.split_at(count);
            let indexes: Vec<u64> = now.iter().map(|shard| shard - offset).collect();
            said.push_str(&run(&self.command(job, &indexes, offset, threads, more)?)?);
            rest = later;
        }
        Ok(said)
    }

    /// The command line that submits the shards with those indexes.
    fn command(
        self,
        job: &Job,
        indexes: &[u64],
        offset: u64,
        threads: usize,
        more: &[String],
    ) -> Result<Vec<String>, CommandError> {
        let program = env::current_exe().map_err(CommandError::Write)?;
        let (program, folder) = (program.display().to_string(), job.folder.display());
        let array = ranges(indexes);
        let offset = offset.to_string();
        let folder = folder.to_string();
        let worker = [
            &program,
            "sweep",
            "--into",
            &folder,
            "--shard-offset",
            &offset,
        ];
        let mut command: Vec<String> = Vec::new();
        match self {
            Self::Slurm => {
                command.extend(["sbatch", "--parsable", "--requeue"].map(str::to_owned));
                command.push(format!("--array={array}"));
                command.push(format!("--cpus-per-task={threads}"));
                command.push(format!("--output={folder}/log/%a.txt"));
                command.extend_from_slice(more);
                let quoted: Vec<String> = worker.iter().map(|word| quoted(word)).collect();
                command.push("--wrap".to_owned());
                command.push(quoted.join(" "));
            }
            Self::Hq => {
                command.extend(["hq", "submit", "--crash-limit", "5"].map(str::to_owned));
                command.extend(["--array".to_owned(), array]);
                command.extend(["--cpus".to_owned(), threads.to_string()]);
                for stream in ["--stdout", "--stderr"] {
                    command.extend([stream.to_owned(), format!("{folder}/log/%{{TASK_ID}}.txt")]);
                }
                command.extend_from_slice(more);
                command.push("--".to_owned());
                command.extend(worker.map(str::to_owned));
            }
        }
        Ok(command)
    }
}

/// Numbers in order as ranges: `0-3,7`.
pub(super) fn ranges(numbers: &[u64]) -> String {
    let mut text = String::new();
    let mut rest = numbers;
    while let Some(first) = rest.first() {
        let count = rest
            .iter()
            .zip(*first..)
            .take_while(|(number, expected)| **number == *expected)
            .count();
        let separator = if text.is_empty() { "" } else { "," };
        // Writing to a string does not fail.
        let _ = match count {
            1 => write!(text, "{separator}{first}"),
            _ => write!(text, "{separator}{first}-{}", first + count as u64 - 1),
        };
        rest = &rest[count..];
    }
    text
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=+,:@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

fn max_array_size() -> u64 {
    let output = Command::new("scontrol").args(["show", "config"]).output();
    let text = output.map_or_else(
        |_| String::new(),
        |output| String::from_utf8_lossy(&output.stdout).into_owned(),
    );
    let line = text.lines().find(|line| line.starts_with("MaxArraySize"));
    let size = line.and_then(|line| line.split('=').nth(1));
    size.and_then(|size| size.trim().parse().ok())
        .unwrap_or(MAX_ARRAY_SIZE)
}

fn run(command: &[String]) -> Result<String, CommandError> {
    let Some((program, arguments)) = command.split_first() else {
        return Ok(String::new());
    };
    let failed = |what: String| CommandError::Sweep(format!("{program}: {what}"));
    let output = Command::new(program)
        .args(arguments)
        .output()
        .map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(
            String::from_utf8_lossy(&output.stderr).trim().to_owned(),
        ));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_shards_are_named_in_ranges() {
        assert_eq!(ranges(&[]), "");
        assert_eq!(ranges(&[5]), "5");
        assert_eq!(ranges(&[0, 1, 2, 3, 7, 9, 10]), "0-3,7,9-10");
    }

    #[test]
    fn words_reach_the_worker_as_they_are() {
        assert_eq!(quoted("/a/b-c.plan"), "/a/b-c.plan");
        assert_eq!(quoted("/my plans/it's"), r"'/my plans/it'\''s'");
    }
}
