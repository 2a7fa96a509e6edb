//! Names of the world: what values of keys and of arguments are compared with before a program runs.

use std::cell::RefCell;
use std::rc::Rc;

use closest_name::closest_name;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::copy::Copier;

/// What a name is the name of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Domain {
    /// An arm, or its hand.
    Arm,
    /// A way to grasp something.
    Grasp,
    /// A type of objects.
    ObjectType,
    /// A piece of the kitchen.
    Furniture,
    /// A joint of the kitchen.
    KitchenJoint,
    /// A frame of reference.
    Frame,
    /// A direction to look into.
    Direction,
    /// A side of furniture.
    Side,
    /// A board of a shelf.
    Level,
    /// A way to turn what is put down.
    Orientation,
}

/// Reads names.
type ReadNames = fn() -> Vec<String>;

/// The names in a world, as they are written there.
#[derive(Clone, Default)]
pub struct Vocabulary {
    names: RefCell<Vec<(Domain, Vec<String>)>>,
    /// Names that are read when they are first asked for.
    unread: RefCell<Vec<(Domain, ReadNames)>>,
}

impl Extension for Vocabulary {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        Rc::new(Vocabulary::clone(&self))
    }
}

/// A name as it is compared; frames may begin with a slash.
fn plain(name: &str) -> String {
    name.trim_start_matches('/')
        .to_uppercase()
        .replace('_', "-")
}

impl Vocabulary {
    /// That of an image.
    pub fn of(image: &mut Image) -> Rc<Vocabulary> {
        let known = image.extension::<Vocabulary>();
        known.unwrap_or_else(|| image.extend(Vocabulary::default()))
    }

    /// Adds names.
    pub fn add(&self, domain: Domain, names: impl IntoIterator<Item = impl AsRef<str>>) {
        let names = names.into_iter().map(|name| name.as_ref().to_owned());
        let mut all = self.names.borrow_mut();
        match all.iter_mut().find(|(known, _)| *known == domain) {
            Some((_, known)) => known.extend(names),
            None => all.push((domain, names.collect())),
        }
    }

    /// Forgets all names of a kind.
    pub fn forget(&self, domain: Domain) {
        self.names
            .borrow_mut()
            .retain(|(known, _)| *known != domain);
        self.unread
            .borrow_mut()
            .retain(|(known, _)| *known != domain);
    }

    /// Adds names that are read when they are first asked for.
    pub fn add_later(&self, domain: Domain, read: ReadNames) {
        self.unread.borrow_mut().push((domain, read));
    }

    /// Reads what is needed now.
    fn read(&self, domain: Domain) {
        let needed: Vec<_> = {
            let mut unread = self.unread.borrow_mut();
            unread.extract_if(.., |(of, _)| *of == domain).collect()
        };
        for (domain, read) in needed {
            self.add(domain, read());
        }
    }

    /// Is it a name of that kind? Where no names are known, any may be one.
    pub fn has(&self, domain: Domain, name: &str) -> bool {
        self.read(domain);
        let all = self.names.borrow();
        let known = all.iter().find(|(known, _)| *known == domain);
        let wanted = plain(name);
        known.is_none_or(|(_, names)| names.iter().any(|known| plain(known) == wanted))
    }

    /// Is it named like an object, `TYPE-1`?
    pub(super) fn is_like_object(&self, name: &str) -> bool {
        let name = plain(name);
        let kind = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let kind = kind.strip_suffix('-');
        kind.is_some_and(|kind| self.has(Domain::ObjectType, kind))
    }

    /// The name that was probably meant.
    fn nearest(&self, domain: Domain, name: &str) -> Option<String> {
        let all = self.names.borrow();
        let (_, names) = all.iter().find(|(known, _)| *known == domain)?;
        let names: Vec<String> = names.iter().map(|name| domain.shown(name)).collect();
        closest_name(&domain.shown(name), names.iter().map(String::as_str)).map(str::to_owned)
    }

    /// All names, if they are few.
    fn few(&self, domain: Domain) -> Option<String> {
        const FEW: usize = 8;
        let all = self.names.borrow();
        let (_, names) = all.iter().find(|(known, _)| *known == domain)?;
        let shown: Vec<String> = names.iter().map(|name| domain.shown(name)).collect();
        (names.len() <= FEW).then(|| shown.join(", "))
    }
}

impl Domain {
    /// What a name is, in messages.
    pub(super) fn noun(self) -> &'static str {
        match self {
            Domain::Arm => "arm",
            Domain::Grasp => "grasp",
            Domain::ObjectType => "type of objects",
            Domain::Furniture => "furniture",
            Domain::KitchenJoint => "joint of the kitchen",
            Domain::Frame => "frame",
            Domain::Direction => "direction",
            Domain::Side => "side",
            Domain::Level => "board",
            Domain::Orientation => "orientation",
        }
    }

    /// A name as programs write it: symbols in upper case, strings as they are.
    fn shown(self, name: &str) -> String {
        match self {
            Domain::Frame | Domain::KitchenJoint => format!("{name:?}"),
            _ => plain(name),
        }
    }

    /// Can there be others than those that are known, such as objects, which are frames, too?
    fn is_open(self) -> bool {
        matches!(self, Domain::ObjectType | Domain::Frame | Domain::Grasp)
    }

    /// What is wrong with a name; nothing where it may be right.
    pub fn mistake(self, image: &Image, name: &str) -> Option<String> {
        let vocabulary = image.extension::<Vocabulary>()?;
        if vocabulary.has(self, name) {
            return None;
        }
        let near = vocabulary.nearest(self, name);
        if near.is_none() && self.is_open() {
            return None;
        }
        let text = format!("There is no {} {}", self.noun(), self.shown(name));
        Some(match (near, vocabulary.few(self)) {
            (Some(near), _) => format!("{text}; did you mean {near}?"),
            (None, Some(names)) => format!("{text}; there are {names}."),
            (None, None) => format!("{text}."),
        })
    }
}
