//! Pathnames: names of files, taken apart. Directories are separated by slashes; there are neither
//! hosts nor devices.

use super::Value;
use super::copy::Copier;
use super::foreign::{Foreign, ForeignCopy, PrintContext};
use super::known;
use super::symbol::Sym;

/// The name of a file.
pub(crate) struct Pathname {
    /// `NIL`, or a list that begins with `:ABSOLUTE` or `:RELATIVE`, of strings, `:UP`, `:WILD` and
    /// `:WILD-INFERIORS`.
    pub(crate) directory: Value,
    /// A string, `:WILD` or `NIL`.
    pub(crate) name: Value,
    /// What stands after the last dot: a string, `:WILD` or `NIL`.
    pub(crate) kind: Value,
    /// Kept as it is given; it is no part of a file's name.
    pub(crate) version: Value,
}

impl Pathname {
    /// Takes a file's name apart.
    pub(crate) fn parse(text: &str) -> Pathname {
        let (folder, file) = match text.rfind('/') {
            Some(slash) => text.split_at(slash + 1),
            None => ("", text),
        };
        let (name, kind) = match file.rfind('.') {
            // A name may begin with a dot.
            Some(dot) if dot > 0 => (file.get(..dot), file.get(dot + 1..)),
            _ => (Some(file), None),
        };
        let part = |text: Option<&str>| match text {
            None => Value::NIL,
            Some("*") => known::K_WILD.into(),
            Some(text) => Value::string(text),
        };
        Pathname {
            directory: directory(folder),
            name: part(name.filter(|name| !name.is_empty())),
            kind: part(kind),
            version: Value::NIL,
        }
    }

    /// The name of the file, put together.
    pub(crate) fn namestring(&self) -> String {
        let mut text = String::new();
        for (index, part) in self.directory.iter_list().enumerate() {
            match (index, part) {
                (0, Value::Symbol(known::K_ABSOLUTE, ..)) => text.push('/'),
                (0, _) => {}
                (_, part) => {
                    text.push_str(&shown(&part));
                    text.push('/');
                }
            }
        }
        text.push_str(&shown(&self.name));
        if self.kind.is_true() {
            text.push('.');
            text.push_str(&shown(&self.kind));
        }
        text
    }
}

fn directory(folder: &str) -> Value {
    if folder.is_empty() {
        return Value::NIL;
    }
    let start = if folder.starts_with('/') {
        known::K_ABSOLUTE
    } else {
        known::K_RELATIVE
    };
    let parts = folder.split('/').filter(|part| !matches!(*part, "" | "."));
    let parts = parts.map(|part| match part {
        ".." => known::K_UP.into(),
        "*" => known::K_WILD.into(),
        "**" => known::K_WILD_INFERIORS.into(),
        name => Value::string(name),
    });
    let all: Vec<Value> = std::iter::once(start.into()).chain(parts).collect();
    // "./" is no directory at all.
    match all.as_slice() {
        [Value::Symbol(known::K_RELATIVE, ..)] => Value::NIL,
        _ => Value::list(all),
    }
}

/// A part as it stands in a name.
fn shown(part: &Value) -> String {
    match part {
        Value::Str(text) => text.text(),
        Value::Symbol(known::K_WILD, ..) => "*".to_owned(),
        Value::Symbol(known::K_WILD_INFERIORS, ..) => "**".to_owned(),
        Value::Symbol(known::K_UP | known::K_BACK, ..) => "..".to_owned(),
        _ => String::new(),
    }
}

impl Foreign for Pathname {
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        ForeignCopy::New(Box::new(Pathname {
            directory: copier.value(&self.directory),
            name: copier.value(&self.name),
            kind: copier.value(&self.kind),
            version: copier.value(&self.version),
        }))
    }

    fn type_symbol(&self) -> Sym {
        known::PATHNAME
    }

    fn print(&self, context: &dyn PrintContext, escape: bool) -> String {
        let name = self.namestring();
        if escape {
            format!("#P{}", context.text(&name.as_str().into(), true))
        } else {
            name
        }
    }

    fn is_equal(&self, other: &Value) -> bool {
        let equal = super::equality::equal;
        other.as_foreign::<Pathname>().is_some_and(|other| {
            equal(&self.directory, &other.directory)
                && equal(&self.name, &other.name)
                && equal(&self.kind, &other.kind)
                && equal(&self.version, &other.version)
        })
    }
}

/// The name of a file that a value gives: a string, or a pathname.
pub(crate) fn file_name(value: &Value) -> Option<String> {
    match value.as_foreign::<Pathname>() {
        Some(pathname) => Some(pathname.namestring()),
        None => value.as_text(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_put_together_as_they_were() {
        for name in [
            "",
            "a",
            "a.lisp",
            ".profile",
            "plans/a.tar.gz",
            "/home/me/",
            "../*/x.*",
            "/**/a",
            "a.",
        ] {
            assert_eq!(Pathname::parse(name).namestring(), name);
        }
        assert_eq!(Pathname::parse("./a//b").namestring(), "a/b");
    }
}
