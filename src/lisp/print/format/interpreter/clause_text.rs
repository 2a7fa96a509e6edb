//! Directives that change the text of their clauses: conversion of case, and justification.

use super::arguments::{Arguments, char_of, width_of};
use super::{Context, Flow, Interpreter, Result};
use crate::print::format::directive::{Directive, Piece};
use crate::print::format::justify::Justification;
use crate::print::format::output::Output;

impl Interpreter<'_> {
    /// Runs pieces into a text of their own.
    fn captured(
        &mut self,
        c: Context<'_>,
        pieces: &[Piece],
        args: &mut Arguments,
    ) -> Result<(String, Flow)> {
        let column = self.output.column();
        let outer = std::mem::replace(&mut self.output, Output::new(column));
        let flow = self.pieces(c, pieces, args);
        let inner = std::mem::replace(&mut self.output, outer);
        Ok((inner.into_text(), flow?))
    }

    pub(super) fn convert_case(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let pieces = d.clauses.first().map_or(&[][..], |clause| &clause.pieces);
        let (text, flow) = self.captured(c, pieces, args)?;
        let converted = match (d.colon, d.at) {
            (false, false) => text.to_lowercase(),
            (true, true) => text.to_uppercase(),
            (true, false) => capitalized(&text, true),
            (false, true) => capitalized(&text, false),
        };
        self.output.push(&converted);
        Ok(flow)
    }

    pub(super) fn justify(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<Flow> {
        let given = self.parameters(c, d, args)?;
        let mut texts = Vec::new();
        let mut overflow = None;
        for (i, clause) in d.clauses.iter().enumerate() {
            let (text, flow) = self.captured(c, &clause.pieces, args)?;
            // A segment that `~^` cuts off is left out, and so are those after it.
            if flow != Flow::Through {
                break;
            }
            match &clause.separator {
                // `~<prefix~n:;…~>`: the prefix is written if the rest does not fit.
                Some((true, _, parameters)) if i == 0 => {
                    let limits = self.given(c, d, parameters, args)?;
                    let spare = width_of(&limits, 0)?.unwrap_or(0);
                    let line = width_of(&limits, 1)?.unwrap_or(self.settings.right_margin);
                    overflow = Some((text, spare, line));
                }
                _ => texts.push(text),
            }
        }
        let justification = Justification {
            width: width_of(&given, 0)?.unwrap_or(0),
            step: width_of(&given, 1)?.unwrap_or(1),
            least: width_of(&given, 2)?.unwrap_or(0),
            pad: char_of(&given, 3)?.unwrap_or(' '),
            before: d.colon,
            after: d.at,
        };
        let text = justification.spread(&texts);
        if let Some((prefix, spare, line)) = overflow
            && self.output.column() + text.chars().count() + spare > line
        {
            self.output.push(&prefix);
        }
        self.output.push(&text);
        Ok(Flow::Through)
    }
}

/// The first letter of every word, or of the first word only, as a capital; others in lower case.
fn capitalized(text: &str, every_word: bool) -> String {
    let mut in_word = false;
    let mut is_first = true;
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_alphanumeric() {
            if !in_word && (every_word || is_first) {
                result.extend(c.to_uppercase());
            } else {
                result.extend(c.to_lowercase());
            }
            is_first = false;
            in_word = true;
        } else {
            result.push(c);
            in_word = false;
        }
    }
    result
}
