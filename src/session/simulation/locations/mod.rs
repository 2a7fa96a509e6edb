//! From location designators to descriptions of places, and the search for them.

mod bases;
mod constraints;
mod properties;
mod references;
mod things;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::{Rc, Weak};
use std::sync::Arc;

use super::Simulation;
use crate::interruption::interruption;
use crate::log_level::LogLevel;
use cram::designator::value::{Class, Designator, as_class, current, first, note_changed};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::cycles;
use lisp::value::foreign::{Foreign, PrintContext};
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use properties::{metres, one_of, raised};
use references::References;
use robotics::location::{
    Beside, Level, Orientation, OutOfReach, PlaceQuery, Position, Query, Scene, Stream, Support,
};
use robotics::motion::interruption::interruptible;
use robotics::world::{BodyName, WorldError};
use view::picture::LocationMap;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// About how many bytes a search has prepared: maps, and copies of parts of the world.
const BYTES_OF_A_SEARCH: usize = 64 << 10;

/// The poses of a location, as its designator keeps them.
pub(crate) struct LocationStream {
    pub stream: Rc<RefCell<Stream>>,
    class_symbol: Sym,
}

/// How many searches keep what they have prepared: those at which was worked last. An action works on a few
/// at a time; its designators may be kept for ever, as the tree of tasks keeps them.
const AT_HAND: usize = 8;

/// All searches that have been begun. With these, what they have prepared ends: copies of the world,
/// which a program's values may hold in circles that nobody can free.
#[derive(Default)]
pub(super) struct Searches {
    begun: Vec<Weak<RefCell<Stream>>>,
    /// Those that keep what they have prepared, the one at which was worked last at the end.
    at_hand: RefCell<VecDeque<Weak<RefCell<Stream>>>>,
}

impl Searches {
    /// Does nothing hold any of them any more?
    pub(super) fn are_over(&self) -> bool {
        self.begun.iter().all(|stream| stream.strong_count() == 0)
    }

    fn note(&mut self, stream: &Rc<RefCell<Stream>>) {
        self.begun.retain(|stream| stream.strong_count() > 0);
        self.begun.push(Rc::downgrade(stream));
    }

    /// One has been worked at. Sets aside the one at which nobody has worked for longest, if there are too many.
    fn note_work(&self, stream: &Rc<RefCell<Stream>>) {
        let mut at_hand = self.at_hand.borrow_mut();
        at_hand.retain(|other| {
            other.strong_count() > 0 && !std::ptr::eq(other.as_ptr(), Rc::as_ptr(stream))
        });
        at_hand.push_back(Rc::downgrade(stream));
        if at_hand.len() > AT_HAND
            && let Some(oldest) = at_hand.pop_front().and_then(|stream| stream.upgrade())
            && let Ok(mut oldest) = oldest.try_borrow_mut()
        {
            oldest.set_aside();
        }
    }
}

impl Drop for Searches {
    fn drop(&mut self) {
        for stream in self.begun.iter().filter_map(Weak::upgrade) {
            // One that is at work ends with whoever has it at work.
            if let Ok(mut stream) = stream.try_borrow_mut() {
                stream.forget();
            }
        }
    }
}

impl Foreign for LocationStream {
    fn type_symbol(&self) -> Sym {
        self.class_symbol
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<LOCATION-SEARCH>".to_owned()
    }

    fn describe(&self, _: &dyn PrintContext) -> String {
        self.stream.borrow().summary()
    }
}

impl Simulation {
    /// What searches look at.
    pub(crate) fn location_scene(&self) -> Scene<'_> {
        Scene {
            world: &self.world,
            grasps: &self.grasps,
            out_of_reach: &self.out_of_reach,
        }
    }

    /// Drops what has been found to be out of reach: there are other grasps.
    pub(crate) fn forget_what_is_out_of_reach(&mut self) {
        self.out_of_reach = OutOfReach::default();
    }

    /// The poses of a location as its chain of designators keeps them, begun if necessary; `None`
    /// if its properties do not describe a place. `references` are what Lisp has worked out: a list
    /// of `(key pose number…)`.
    pub(crate) fn location_stream(
        &mut self,
        image: &mut Image,
        location: &Value,
        references: &Value,
    ) -> Result<Option<Value>> {
        let oldest = first(location);
        let Some(designator) = as_class(&oldest, Class::Location) else {
            let shown = print::to_string(image, location, false);
            return Err(Raise::simple(format!("{shown} is no location.")));
        };
        if let Some(memory) = designator.memory.borrow().clone()
            && memory.as_foreign::<LocationStream>().is_some()
        {
            return Ok(Some(memory));
        }
        let references = References::read(self, image, references)?;
        let Some(query) = self.location_query(image, designator, &references)? else {
            return Ok(None);
        };
        self.searches += 1;
        // Any odd number tells apart the searches of sessions with different seeds.
        let seed = self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ self.searches;
        let stream = Rc::new(RefCell::new(Stream::new(query, seed)));
        self.begun_searches.note(&stream);
        let class_symbol = image.keyword("LOCATION-SEARCH");
        let memory = Value::foreign(LocationStream {
            stream,
            class_symbol,
        });
        *designator.memory.borrow_mut() = Some(memory.clone());
        note_changed(&oldest);
        cycles::press(BYTES_OF_A_SEARCH);
        Ok(Some(memory))
    }

    /// Works on the poses of a location; `None` if the user has interrupted it.
    pub(crate) fn with_stream<T>(
        &self,
        image: &mut Image,
        memory: &Value,
        work: impl FnOnce(&mut Stream, Scene<'_>) -> std::result::Result<T, WorldError>,
    ) -> Result<Option<T>> {
        let Some(stream) = memory.as_foreign::<LocationStream>() else {
            return Ok(None);
        };
        let done = interruptible(interruption(image), || {
            work(&mut stream.stream.borrow_mut(), self.location_scene())
        });
        self.begun_searches.note_work(&stream.stream);
        match done {
            Some(done) => done.map(Some).map_err(|error| raised(&error)),
            None => {
                image.polls().seen_since_last();
                Ok(None)
            }
        }
    }

    /// What can be shown of the search for a location, if there is anything.
    pub(crate) fn location_map_of(
        &self,
        image: &mut Image,
        memory: &Value,
    ) -> Result<Option<Arc<LocationMap>>> {
        let view = self.with_stream(image, memory, |stream, scene| stream.view(scene))?;
        Ok(view.flatten().map(|view| {
            Arc::new(LocationMap {
                resolution: view.map.resolution,
                cells: view.map.cells,
                height: view.height,
                offered: view.offered,
                arrow: if view.is_for_robot { 0.3 } else { 0.12 },
            })
        }))
    }

    /// What the properties describe; `None` if that is no place on something nor one for the robot.
    fn location_query(
        &self,
        image: &mut Image,
        location: &Designator,
        references: &References,
    ) -> Result<Option<Query>> {
        let given = |image: &Image, key: &str| {
            let value = location.property_named(image, key);
            value.filter(Value::is_true)
        };
        let reaches = given(image, "REACHABLE-FOR").is_some();
        let sees = given(image, "VISIBLE-FOR").is_some();
        if reaches || sees {
            let query = self.base_query(image, location, references, (reaches, sees))?;
            return Ok(Some(Query::Base(query)));
        }
        let places = ["ON", "ABOVE", "IN"].map(|key| given(image, key).map(|value| (key, value)));
        let mut places = places.into_iter().flatten();
        let constraints = self.constraints(image, location, references)?;
        let (key, support) = match (places.next(), places.next()) {
            (Some((one, _)), Some((other, _))) => {
                let [one, other] = [one, other].map(str::to_lowercase);
                return Err(Raise::simple(format!(
                    "A location is ({one} …) something or ({other} …) it, not both."
                )));
            }
            (Some((key, value)), None) => (key, self.location_support(image, key, &value)?),
            (None, _) => match self.support_of_neighbour(image, location)? {
                Some(support) => ("ON", support),
                None => return Ok(None),
            },
        };
        if let Some(value) = ["ATTACHMENT", "ATTACHMENTS"]
            .iter()
            .find_map(|k| given(image, k))
        {
            let shown = print::to_string(image, &value, false);
            return Err(Raise::simple(format!(
                "There is no attachment {shown}: none are known for this furniture."
            )));
        }
        let position = match key {
            "ON" => Position::On,
            "ABOVE" => {
                let offset = given(image, "Z-OFFSET");
                let offset = offset.map(|z| metres(image, "Z-OFFSET", &z)).transpose()?;
                Position::Above(offset.unwrap_or(0.0))
            }
            _ => Position::In(level(image, location)?),
        };
        Ok(Some(Query::Place(PlaceQuery {
            support,
            position,
            constraints,
            what: self.what_for(image, location)?,
            orientation: self.orientation(image, location),
        })))
    }

    /// What something stands on beside which the location is, if it does not say itself on what.
    fn support_of_neighbour(
        &self,
        image: &mut Image,
        location: &Designator,
    ) -> Result<Option<Support>> {
        let keys = Beside::ALL.map(Beside::key).into_iter();
        let mut keys = keys.chain(["NEAR", "FAR-FROM"]);
        let value = keys.find_map(|key| location.property_named(image, key));
        let Some(value) = value.map(|v| current(&v)) else {
            return Ok(None);
        };
        let Some(name) = self.named_object(image, &value) else {
            return Ok(None);
        };
        let pose = self.world.object_pose(&name).map_err(|e| raised(&e))?;
        let below = self.world.below(&name, &pose).map_err(|e| raised(&e))?;
        Ok(match below.map(|(_, body)| body) {
            Some(BodyName::Furniture(link)) => Some(Support::Furniture(link.id)),
            Some(BodyName::Object(name)) => Some(Support::Object(name)),
            _ => None,
        })
    }

    fn orientation(&self, image: &mut Image, location: &Designator) -> Orientation {
        let Some(value) = location.property_named(image, "ORIENTATION") else {
            return Orientation::default();
        };
        let wanted = ("ORIENTATION", &value);
        let found = one_of(image, wanted, &Orientation::ALL, Orientation::name);
        found.unwrap_or_else(|text| {
            self.log(image, LogLevel::Warn, "(COSTMAP ORIENTATION)", &text);
            Orientation::default()
        })
    }
}

/// Which board a location is on.
fn level(image: &Image, location: &Designator) -> Result<Level> {
    for (key, is_inverted) in [("LEVEL", false), ("LEVEL-INVERT", true)] {
        let Some(value) = location.property_named(image, key).filter(Value::is_true) else {
            continue;
        };
        if let Value::Int(n) = value
            && let Ok(n) = usize::try_from(n)
        {
            return Ok(match is_inverted {
                true => Level::FromAbove(n),
                false => Level::FromBelow(n),
            });
        }
        let name = |level: Level| match level {
            Level::Topmost => "topmost",
            Level::Middle => "middle",
            _ => "bottommost",
        };
        let choices = [Level::Topmost, Level::Middle, Level::FromBelow(1)];
        let found = one_of(image, (key, &value), &choices, name).map_err(Raise::simple)?;
        return Ok(match (found, is_inverted) {
            (Level::Topmost, true) => Level::FromBelow(1),
            (Level::FromBelow(_), true) => Level::Topmost,
            (found, _) => found,
        });
    }
    Ok(Level::Any)
}
