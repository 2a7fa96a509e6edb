//! The printer variables, read once per call.

use super::circle::SharedLabels;
use crate::image::Image;
use crate::reader::LetterCase;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

/// `*print-case*`
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Case {
    /// `:upcase`
    Up,
    /// `:downcase`
    Down,
    /// `:capitalize`
    Capitalize,
}

/// How values are printed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Settings {
    /// `*print-escape*`: so that it can be read back?
    pub escape: bool,
    /// `*print-readably*`: no abbreviations?
    pub(crate) readably: bool,
    /// `*print-pretty*`: with line breaks?
    pub pretty: bool,
    /// `*print-base*`: the radix of rational numbers, 2 to 36.
    pub base: u32,
    /// `*print-radix*`: with the radix?
    pub(crate) radix: bool,
    /// `*print-case*`
    pub case: Case,
    /// `*print-length*`: most elements of a list or vector.
    pub length: Option<usize>,
    /// `*print-level*`: deepest nesting.
    pub level: Option<usize>,
    /// The number of logical blocks around what is printed, which count for `*print-level*`.
    pub depth: usize,
    /// `*print-circle*`: shared parts as `#1#`?
    pub circle: bool,
    /// The labels of the logical block around what is printed, if it has some.
    pub shared: Option<SharedLabels>,
    /// `readtable-case`: what the reader does with letters.
    pub letters: LetterCase,
    /// `*print-gensym*`: uninterned symbols with `#:`?
    pub gensym: bool,
    /// `*print-array*`: arrays with their elements?
    pub array: bool,
    /// `*print-lines*`: most lines of a pretty-printed value.
    pub lines: Option<usize>,
    /// `*print-right-margin*`: columns of a line.
    pub(crate) right_margin: usize,
    /// `*print-miser-width*`
    pub(crate) miser_width: Option<usize>,
    /// `*read-default-float-format*`: the format whose exponent marker is `e`.
    pub(crate) float_format: Sym,
}

/// Columns of a line unless the program says otherwise.
const RIGHT_MARGIN: usize = 80;

fn count(image: &Image, variable: Sym) -> Option<usize> {
    match image.special(variable) {
        Value::Int(n) => usize::try_from(*n).ok(),
        _ => None,
    }
}

impl Settings {
    /// The current values of the printer variables.
    pub fn of(image: &Image) -> Settings {
        let flag = |variable| image.special(variable).is_true();
        let shared = image.special(known::V_PRINT_LABELS);
        let shared = shared.as_foreign::<SharedLabels>();
        Settings {
            escape: flag(known::V_PRINT_ESCAPE),
            readably: flag(known::V_PRINT_READABLY),
            pretty: flag(known::V_PRINT_PRETTY),
            base: match image.special(known::V_PRINT_BASE) {
                Value::Int(n @ 2..=36) => u32::try_from(*n).unwrap_or(10),
                _ => 10,
            },
            radix: flag(known::V_PRINT_RADIX),
            case: match image.special(known::V_PRINT_CASE).as_symbol() {
                Some(known::K_DOWNCASE) => Case::Down,
                Some(known::K_CAPITALIZE) => Case::Capitalize,
                _ => Case::Up,
            },
            letters: LetterCase::current(image),
            length: count(image, known::V_PRINT_LENGTH),
            level: count(image, known::V_PRINT_LEVEL),
            depth: count(image, known::V_PRINT_DEPTH).unwrap_or(0),
            circle: flag(known::V_PRINT_CIRCLE),
            shared: shared.cloned().filter(|_| flag(known::V_PRINT_CIRCLE)),
            gensym: flag(known::V_PRINT_GENSYM),
            array: flag(known::V_PRINT_ARRAY),
            lines: count(image, known::V_PRINT_LINES),
            right_margin: count(image, known::V_PRINT_RIGHT_MARGIN).unwrap_or(RIGHT_MARGIN),
            miser_width: count(image, known::V_PRINT_MISER_WIDTH),
            float_format: image
                .special(known::V_READ_DEFAULT_FLOAT_FORMAT)
                .as_symbol()
                .unwrap_or(known::SINGLE_FLOAT),
        }
    }

    /// As they count for a value: one that is to be readable is printed without what would leave
    /// something out that is needed to read it again.
    pub(super) fn effective(&self) -> Settings {
        let settings = self.clone();
        if !settings.readably {
            return settings;
        }
        Settings {
            escape: true,
            length: None,
            level: None,
            lines: None,
            gensym: true,
            array: true,
            // It is for the standard readtable.
            letters: LetterCase::Upcase,
            ..settings
        }
    }

    /// The printer variables whose values have to change for a call of Lisp code to print like
    /// this, so many levels deep.
    pub fn bindings(&self, image: &Image, depth: usize) -> Vec<(Sym, Value)> {
        let current = Settings::of(image);
        let count = |n: Option<usize>| match n {
            Some(n) => Value::from(n),
            None => Value::NIL,
        };
        let case = match self.case {
            Case::Up => known::K_UPCASE,
            Case::Down => known::K_DOWNCASE,
            Case::Capitalize => known::K_CAPITALIZE,
        };
        let flags = [
            (known::V_PRINT_ESCAPE, self.escape, current.escape),
            (known::V_PRINT_READABLY, self.readably, current.readably),
            (known::V_PRINT_PRETTY, self.pretty, current.pretty),
            (known::V_PRINT_RADIX, self.radix, current.radix),
            (known::V_PRINT_CIRCLE, self.circle, current.circle),
            (known::V_PRINT_GENSYM, self.gensym, current.gensym),
            (known::V_PRINT_ARRAY, self.array, current.array),
        ];
        let counts = [
            (known::V_PRINT_LENGTH, self.length, current.length),
            (known::V_PRINT_LEVEL, self.level, current.level),
            (known::V_PRINT_LINES, self.lines, current.lines),
            (
                known::V_PRINT_MISER_WIDTH,
                self.miser_width,
                current.miser_width,
            ),
        ];
        let mut bindings = Vec::new();
        for (variable, wanted, is) in flags {
            if wanted != is {
                bindings.push((variable, Value::bool(wanted)));
            }
        }
        for (variable, wanted, is) in counts {
            if wanted != is {
                bindings.push((variable, count(wanted)));
            }
        }
        if self.right_margin != current.right_margin {
            bindings.push((known::V_PRINT_RIGHT_MARGIN, self.right_margin.into()));
        }
        if self.base != current.base {
            bindings.push((known::V_PRINT_BASE, Value::Int(self.base.into())));
        }
        if self.case != current.case {
            bindings.push((known::V_PRINT_CASE, case.into()));
        }
        let depth = self.depth + depth;
        if depth != current.depth {
            bindings.push((known::V_PRINT_DEPTH, depth.into()));
        }
        bindings
    }

    /// The settings of `prin1` (true) or `princ`.
    pub(crate) fn with_escape(mut self, escape: bool) -> Settings {
        self.escape = escape;
        self.readably &= escape;
        self
    }
}
