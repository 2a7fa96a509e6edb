//! Colours on a terminal.

use std::io::IsTerminal;

use clap::ValueEnum;
use lisp::visible::visible;

/// When to use colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum ColorWhen {
    /// If the output is a terminal
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// Colours text, or leaves it plain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Paint {
    on: bool,
}

impl Paint {
    /// For output to a stream, following the option and `NO_COLOR`.
    pub(crate) fn new(when: ColorWhen, stream: &impl IsTerminal) -> Self {
        let on = match when {
            ColorWhen::Always => true,
            ColorWhen::Never => false,
            ColorWhen::Auto => {
                stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty())
            }
        };
        Paint { on }
    }

    pub(crate) fn is_on(self) -> bool {
        self.on
    }

    /// Text about an error. What it quotes does not drive the terminal.
    pub(crate) fn bad(self, text: &str) -> String {
        self.paint("1;31", &visible(text))
    }

    /// A line of a diff, coloured by its mark. What it quotes does not drive the terminal.
    pub(crate) fn diff_line(self, line: &str) -> String {
        let line = &*visible(line);
        match line.as_bytes().first() {
            Some(b'-') => self.paint("31", line),
            Some(b'+') => self.paint("32", line),
            Some(b'@') => self.paint("36", line),
            _ => line.to_owned(),
        }
    }

    fn paint(self, code: &str, text: &str) -> String {
        if self.on {
            format!("\x1b[{code}m{text}\x1b[0m")
        } else {
            text.to_owned()
        }
    }
}
