//! The numbers of a kitchen, each by its name: a parameter that is drawn or set otherwise changes no other.

use std::cell::RefCell;

use sweep::Draws;

use crate::settings::{Setting, Settings, is_parameter, parameter_of};

/// The numbers of one attempt to make a kitchen.
#[derive(Clone, Debug)]
pub(crate) struct Numbers<'a> {
    seed: u64,
    attempt: u64,
    settings: &'a Settings,
    /// The parameters that have been asked for, and what they are.
    used: RefCell<Vec<(String, Setting)>>,
}

impl<'a> Numbers<'a> {
    /// Those of an attempt for a seed; what is set is not drawn.
    pub(crate) fn new(seed: u64, attempt: u64, settings: &'a Settings) -> Self {
        Self {
            seed,
            attempt,
            settings,
            used: RefCell::default(),
        }
    }

    /// What is set.
    pub(crate) fn settings(&self) -> &'a Settings {
        self.settings
    }

    /// The parameters that have been asked for, in order, and what they are.
    pub(crate) fn used(&self) -> Vec<(String, Setting)> {
        self.used.borrow().clone()
    }

    /// Notes what a parameter is.
    pub(crate) fn note(&self, stream: &str, setting: Setting) {
        let name = parameter_of(stream);
        if !is_parameter(&name) {
            return;
        }
        let mut used = self.used.borrow_mut();
        match used.iter_mut().find(|(known, _)| *known == name) {
            Some((_, known)) => *known = setting,
            None => used.push((name, setting)),
        }
    }

    /// A parameter has turned out not to matter.
    pub(crate) fn forget(&self, stream: &str) {
        let name = parameter_of(stream);
        self.used.borrow_mut().retain(|(known, _)| *known != name);
    }

    /// A number from 0 to 1.
    fn unit(&self, name: &str) -> f64 {
        Draws::new(self.seed, self.attempt, name).unit()
    }

    /// A number between two others, to the millimetre; the one that is set may be another one.
    pub(crate) fn between(&self, name: &str, low: f64, high: f64) -> f64 {
        self.between_after(name, 0.0, low, high)
    }

    /// The same beyond a length (m); what is set is the sum.
    pub(crate) fn between_after(&self, name: &str, from: f64, low: f64, high: f64) -> f64 {
        let drawn = || rounded(low + (high - low) * self.unit(name));
        let drawn = || match from == 0.0 {
            true => drawn(),
            false => rounded(from + drawn()),
        };
        let value = self.settings.number(name).unwrap_or_else(drawn);
        self.note(name, Setting::Number(value));
        value
    }

    /// One of some lengths (m), each as likely as any other.
    pub(crate) fn one_of(&self, name: &str, lengths: &[f64]) -> f64 {
        let drawn = || lengths.get(self.index(name, lengths.len())).copied();
        let value = self.settings.number(name).or_else(drawn).unwrap_or(0.0);
        self.note(name, Setting::Number(value));
        value
    }

    /// One of some values, each as likely as its weight says.
    pub(crate) fn choice<T: Copy>(&self, name: &str, options: &[(f64, T)]) -> Option<T> {
        let all: f64 = options.iter().map(|(weight, _)| weight).sum();
        let mut left = self.unit(name) * all;
        for (weight, value) in options {
            left -= weight;
            if left < 0.0 {
                return Some(*value);
            }
        }
        options.last().map(|(_, value)| *value)
    }

    /// True with a probability.
    pub(crate) fn flag(&self, name: &str, probability: f64) -> bool {
        let set = self.settings.flag(name);
        let value = set.unwrap_or_else(|| self.unit(name) < probability);
        self.note(name, Setting::Flag(value));
        value
    }

    /// A whole number below another one.
    pub(crate) fn below(&self, name: &str, count: usize) -> usize {
        let set = self.settings.number(name);
        // What is set is a small whole number.
        let value = set.map_or_else(|| self.index(name, count), |set| set as usize);
        self.note(name, Setting::Number(value as f64));
        value
    }

    fn index(&self, name: &str, count: usize) -> usize {
        // The cast rounds down.
        ((self.unit(name) * count as f64) as usize).min(count.saturating_sub(1))
    }
}

/// A length to the millimetre.
pub(crate) fn rounded(length: f64) -> f64 {
    (length * 1e3).round() / 1e3
}
