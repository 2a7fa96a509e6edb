//! Parameters of a kitchen that are set instead of drawn: what there are, and which values they may have.

use std::collections::BTreeMap;
use std::fmt;

use closest_name::closest_name;

use crate::arrangement::Arrangement;

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    /// Whether something is there.
    Flag(bool),
    /// A length (m) or a count.
    Number(f64),
    /// The name of an arrangement.
    Name(String),
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Flag(true) => f.write_str("t"),
            Self::Flag(false) => f.write_str("nil"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// The values that a parameter may have.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Values {
    /// The name of an arrangement.
    Arrangement,
    /// Whether something is there.
    Flag,
    /// A length (m) between two others.
    Length(f64, f64),
    /// A whole number up to another one.
    Count(u8),
}

impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Arrangement => {
                let names: Vec<&str> = Arrangement::all().map(Arrangement::name).collect();
                write!(f, "one of {}", names.join(", "))
            }
            Self::Flag => f.write_str("t or nil"),
            Self::Length(low, high) => write!(f, "a length from {low} to {high} m"),
            Self::Count(most) => write!(f, "a whole number from 0 to {most}"),
        }
    }
}

/// What a parameter may be, and what it is in the simplest kitchen, if one value is simpler than others.
struct Parameter {
    name: &'static str,
    values: Values,
    simplest: Option<f64>,
}

const fn length(name: &'static str, low: f64, high: f64, simplest: f64) -> Parameter {
    Parameter {
        name,
        values: Values::Length(low, high),
        simplest: Some(simplest),
    }
}

const fn flag(name: &'static str) -> Parameter {
    Parameter {
        name,
        values: Values::Flag,
        simplest: Some(0.0),
    }
}

const fn count(name: &'static str, most: u8) -> Parameter {
    Parameter {
        name,
        values: Values::Count(most),
        simplest: Some(0.0),
    }
}

/// All parameters, those first whose simplest value makes a kitchen simpler by most.
const PARAMETERS: [Parameter; 37] = [
    Parameter {
        name: "arrangement",
        values: Values::Arrangement,
        simplest: None,
    },
    flag("island"),
    flag("table"),
    count("stools", 2),
    flag("wall-cabinets"),
    flag("dishwasher"),
    flag("fridge-board"),
    length("aisle", 0.9, 2.0, 1.2),
    length("room-width", 2.4, 7.0, 4.0),
    length("room-depth", 2.4, 6.0, 4.0),
    length("left-length", 1.0, 3.0, 2.0),
    length("right-length", 1.0, 3.0, 2.0),
    length("island-width", 0.9, 3.0, 1.6),
    length("doorway-width", 0.81, 1.2, 1.0),
    length("counter-height", 0.7, 1.1, 0.9),
    length("counter-depth", 0.5, 0.8, 0.6),
    length("counter-thickness", 0.015, 0.06, 0.03),
    length("plinth", 0.05, 0.2, 0.1),
    length("front-thickness", 0.012, 0.03, 0.018),
    length("handle-thickness", 0.008, 0.02, 0.012),
    length("handle-ahead", 0.02, 0.06, 0.035),
    length("handle-length", 0.1, 0.7, 0.3),
    flag("handle-middle"),
    length("drawer-travel", 0.3, 0.5, 0.45),
    length("hanging-bottom", 0.4, 0.8, 0.5),
    length("hanging-height", 0.4, 1.0, 0.6),
    length("hanging-depth", 0.25, 0.45, 0.35),
    length("fridge-height", 1.2, 2.2, 1.8),
    length("fridge-width", 0.55, 0.95, 0.6),
    length("fridge-bottom", 0.3, 0.7, 0.5),
    length("fridge-board-height", 0.3, 0.5, 0.4),
    length("sink-width", 0.5, 0.9, 0.6),
    length("sink-depth", 0.1, 0.25, 0.16),
    length("table-length", 0.6, 1.8, 1.2),
    length("table-width", 0.6, 1.0, 0.8),
    length("table-height", 0.65, 0.8, 0.72),
    length("ceiling", 2.4, 3.0, 2.5),
];

/// Rows whose modules can be closed by name, as `back-3`.
pub(crate) const ROWS: [&str; 4] = ["back", "left", "right", "island"];
/// Maximum number of a module in its row.
const MODULES: u8 = 20;

/// Why a parameter cannot be set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingError(String);

impl fmt::Display for SettingError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for SettingError {}

/// The values that a parameter of that name may have.
fn values_of(name: &str) -> Option<Values> {
    let mut all = PARAMETERS.iter();
    let known = all.find(|parameter| parameter.name == name);
    known.map(|known| known.values).or_else(|| {
        let (row, number) = name.split_once('-')?;
        let number: u8 = number.parse().ok()?;
        (ROWS.contains(&row) && (1..=MODULES).contains(&number)).then_some(Values::Flag)
    })
}

/// Whether a parameter is a length.
pub(crate) fn is_length(name: &str) -> bool {
    matches!(values_of(name), Some(Values::Length(..)))
}

/// Whether a kitchen has a parameter of that name.
pub fn is_parameter(name: &str) -> bool {
    values_of(name).is_some()
}

/// Parameters that are set, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings(BTreeMap<String, Setting>);

impl Settings {
    /// Sets a parameter. The names of parameters are in small letters, as `counter-height`; those of
    /// modules, as `back-3`, say with `nil` that a panel closes the module.
    ///
    /// # Errors
    ///
    /// There is no such parameter, or it cannot have that value.
    pub fn set(&mut self, name: &str, setting: Setting) -> Result<(), SettingError> {
        let Some(values) = values_of(name) else {
            let names = PARAMETERS.iter().map(|parameter| parameter.name);
            let names: Vec<&str> = names.collect();
            let near = closest_name(name, names.iter().copied());
            let near = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
            return Err(SettingError(format!(
                "A kitchen has no parameter {name}{near}{} There are {}, and modules by row and number, such as \
                 back-3.",
                if near.is_empty() { "." } else { "" },
                names.join(", ")
            )));
        };
        let fits = match (&setting, values) {
            (Setting::Flag(_), Values::Flag) => true,
            (Setting::Number(number), Values::Length(low, high)) => (low..=high).contains(number),
            (Setting::Number(number), Values::Count(most)) => {
                number.fract() == 0.0 && (0.0..=f64::from(most)).contains(number)
            }
            (Setting::Name(name), Values::Arrangement) => Arrangement::named(name).is_some(),
            _ => false,
        };
        if !fits {
            return Err(SettingError(format!(
                "The {name} of a kitchen cannot be {setting}: {values} was expected."
            )));
        }
        self.0.insert(name.to_owned(), setting);
        Ok(())
    }

    /// Sets a parameter to a value as `--world generated:7,table=nil` has it.
    ///
    /// # Errors
    ///
    /// There is no such parameter, or it cannot have that value.
    pub fn set_text(&mut self, name: &str, text: &str) -> Result<(), SettingError> {
        let setting = match text {
            "t" | "true" | "yes" => Setting::Flag(true),
            "nil" | "false" | "no" => Setting::Flag(false),
            _ => match text.parse() {
                Ok(number) => Setting::Number(number),
                Err(_) => Setting::Name(text.to_owned()),
            },
        };
        self.set(name, setting)
    }

    /// The same without one of them.
    #[must_use]
    pub(crate) fn without(&self, name: &str) -> Self {
        let mut fewer = self.clone();
        fewer.0.remove(name);
        fewer
    }

    /// Whether none is set.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All of them, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Setting)> {
        self.0
            .iter()
            .map(|(name, setting)| (name.as_str(), setting))
    }

    /// The value of the parameter that a stream of numbers such as `counter.height` draws.
    fn of_stream(&self, stream: &str) -> Option<&Setting> {
        match self.0.is_empty() {
            true => None,
            false => self.0.get(&parameter_of(stream)),
        }
    }

    /// A number that is set.
    pub(crate) fn number(&self, stream: &str) -> Option<f64> {
        match self.of_stream(stream)? {
            Setting::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// A flag that is set.
    pub(crate) fn flag(&self, stream: &str) -> Option<bool> {
        match self.of_stream(stream)? {
            Setting::Flag(flag) => Some(*flag),
            _ => None,
        }
    }

    /// The arrangement that is set.
    pub(crate) fn arrangement(&self) -> Option<Arrangement> {
        match self.0.get("arrangement")? {
            Setting::Name(name) => Arrangement::named(name),
            _ => None,
        }
    }

    /// Whether a module, by its number from 1, is closed.
    pub(crate) fn is_closed(&self, row: &str, number: usize) -> bool {
        !self.is_empty() && self.flag(&format!("{row}-{number}")) == Some(false)
    }
}

/// The name of the parameter that a stream draws.
pub(crate) fn parameter_of(stream: &str) -> String {
    stream.replace('.', "-")
}

/// The simplest values of parameters that were drawn otherwise; those that change most come first.
pub(crate) fn simpler(drawn: &[(String, Setting)]) -> Vec<(String, Setting)> {
    let mut all = Vec::new();
    for Parameter {
        name,
        values,
        simplest,
    } in &PARAMETERS
    {
        let Some((_, now)) = drawn.iter().find(|(known, _)| known == name) else {
            continue;
        };
        let simplest = simplest.map(|simplest| match values {
            Values::Flag => Setting::Flag(false),
            _ => Setting::Number(simplest),
        });
        if let Some(simplest) = simplest.filter(|simplest| simplest != now) {
            all.push(((*name).to_owned(), simplest));
        }
    }
    all
}
