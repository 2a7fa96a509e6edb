//! Logical blocks: `~<...~:>`.

use super::arguments::Arguments;
use super::{Context, Flow, Interpreter, Result};
use crate::guard::Pace;
use crate::print::circle::SharedLabels;
use crate::print::format::directive::{Clause, Directive, Piece};
use crate::print::format::error::Problem;
use crate::value::Value;
use crate::value::document::Newline;

impl Arguments {
    /// The elements of a list that a logical block prints, which may be dotted or circular.
    fn of_block(list: &Value, labels: Option<&SharedLabels>) -> Arguments {
        let mut items = Vec::new();
        let mut rest = list.clone();
        let mut pace = Pace::default();
        while let Value::Cons(cons) = &rest {
            pace.step();
            // A rest that has a label is printed like the tail of a dotted list.
            if !items.is_empty() && labels.is_some_and(|labels| labels.is_marked(&rest)) {
                break;
            }
            items.push(cons.car());
            let next = cons.cdr();
            rest = next;
        }
        Arguments {
            of_block: true,
            tail: (!rest.is_nil()).then_some(rest),
            ..Arguments::new(items)
        }
    }
}

impl Interpreter<'_> {
    /// In a logical block whose list is dotted or longer than `*print-length*`, what stands in place of
    /// the next element; has the block ended with it?
    pub(super) fn ends_block(&mut self, d: &Directive, args: &Arguments) -> bool {
        let takes_one = match d.letter {
            'P' => !d.colon,
            '{' | '<' => !d.at,
            letter => "ASWDBOXRFEG$C[?/".contains(letter),
        };
        if !takes_one {
            return false;
        }
        let is_beyond = self.settings.length.is_some_and(|most| args.next >= most);
        if args.next >= args.items.len()
            && let Some(tail) = &args.tail
            && !(is_beyond && matches!(tail, Value::Cons(_)))
        {
            self.output.push(". ");
            let settings = self.settings.clone();
            self.write(tail, &settings);
            return true;
        }
        let is_cut = is_beyond && (args.next < args.items.len() || args.tail.is_some());
        if is_cut {
            self.output.push("...");
        }
        is_cut
    }

    pub(super) fn logical_block(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let fixed_text = |clause: Option<&Clause>| -> Result<String> {
            match clause.map(|clause| clause.pieces.as_slice()) {
                None | Some([]) => Ok(String::new()),
                Some([Piece::Text(text)]) => Ok(text.clone()),
                Some(_) => Err(c.error(
                    d,
                    Problem::Clauses("The prefix and suffix of a block hold no directives."),
                )),
            }
        };
        // The prefix before `~@;` begins every line.
        let is_per_line = d.clauses.len() > 1
            && d.clauses
                .first()
                .and_then(|clause| clause.separator.as_ref())
                .is_some_and(|(_, at, ..)| *at);
        let (prefix, body, suffix) = match d.clauses.as_slice() {
            [body] if d.colon => ("(".to_owned(), body, ")".to_owned()),
            [body] => (String::new(), body, String::new()),
            [prefix, body] => (
                fixed_text(Some(prefix))?,
                body,
                if d.colon {
                    ")".to_owned()
                } else {
                    String::new()
                },
            ),
            [prefix, body, suffix] => (fixed_text(Some(prefix))?, body, fixed_text(Some(suffix))?),
            _ => return Err(c.error(d, Problem::Clauses("Too many segments for ~<...~:>."))),
        };
        let begins = self.output.begin_document(self.settings.pretty);
        let result = self.block_contents(c, d, args, (&prefix, is_per_line), body, &suffix);
        if begins {
            self.output.end_document(&self.settings);
        }
        result
    }

    fn block_contents(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
        (prefix, is_per_line): (&str, bool),
        body: &Clause,
        suffix: &str,
    ) -> Result<Flow> {
        let outer = self.settings.shared.clone();
        let mut inner = if d.at {
            let rest = Arguments::new(args.rest());
            args.next = args.items.len();
            rest
        } else {
            let value = self.next(c, d, args)?;
            if !value.is_list() {
                // A value that is not a list prints as it is.
                let settings = self.settings.clone();
                self.write(&value, &settings);
                return Ok(Flow::Through);
            }
            if self
                .settings
                .level
                .is_some_and(|level| self.settings.depth >= level)
            {
                self.output.push("#");
                return Ok(Flow::Through);
            }
            if self.settings.circle && outer.is_none() {
                let labels = SharedLabels::of(self.image, &value, &self.settings);
                self.settings.shared = Some(labels.for_attempt());
            }
            let labels = self.settings.shared.clone();
            if let Some((label, is_all)) = labels.as_ref().and_then(|labels| labels.next(&value)) {
                self.output.push(&label);
                if is_all {
                    self.settings.shared = outer;
                    return Ok(Flow::Through);
                }
            }
            Arguments::of_block(&value, labels.as_ref())
        };
        self.output.push(prefix);
        if let Some(document) = self.output.document() {
            let line_prefix = if is_per_line {
                prefix.to_owned()
            } else {
                String::new()
            };
            document.start_lines(line_prefix.into(), suffix.to_owned().into());
        }
        self.settings.depth += 1;
        let fills = d.close.is_some_and(|close| close.at);
        let outer_fills = std::mem::replace(&mut self.fills, fills);
        let flow = self.pieces(c, &body.pieces, &mut inner);
        self.fills = outer_fills;
        flow?;
        self.settings.depth -= 1;
        self.settings.shared = outer;
        if let Some(document) = self.output.document() {
            document.end();
        }
        self.output.push(suffix);
        Ok(Flow::Through)
    }

    /// A text with a place where the line may break after each group of blanks.
    pub(super) fn filled(&mut self, text: &str) {
        let mut rest = text;
        while let Some(blank) = rest.find(' ') {
            let after = rest[blank..].trim_start_matches(' ');
            self.output.push(&rest[..rest.len() - after.len()]);
            if let Some(document) = self.output.document() {
                document.newline(Newline::Fill);
            }
            rest = after;
        }
        self.output.push(rest);
    }
}
