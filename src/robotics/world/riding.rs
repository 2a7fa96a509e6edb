//! What stands on an object that two hands carry.
//!
//! Static friction keeps it in its place. The engine has none on a body that hangs on soft welds: there, things creep
//! by a centimetre in a second. So it is a rule: a thing keeps its pose on its carrier as long as the carrier's
//! acceleration and tilt demand no more of it than friction transmits, it would not tip over, and nothing else pushes
//! it. Otherwise it is the engine's again.

use nalgebra::Vector3;

use super::body_name::BodyName;
use super::hash::Hasher;
use super::object::Object;
use super::part_key::PartKey;
use super::physics::GRAVITY;
use super::physics::STEP_SECONDS;
use super::scene::World;
use super::tilt::tilt_at;
use crate::robot::LinkId;
use spatial::Pose;

/// The share of a new acceleration in the mean: accelerations of single steps are noise of the solver.
const NEWEST: f64 = 0.1;
/// How far (rad) a thing may be tilted on its carrier to stand on its own bottom.
const STANDS: f64 = 0.1;

/// A thing that stands on what two hands hold together.
pub(super) struct Rider {
    pub(super) name: String,
    /// What it stands on, itself or with what stands between.
    pub(super) carrier: String,
    pub(super) load: PartKey,
    /// The link to which the carrier is attached, and the thing's pose in its frame.
    pub(super) link: LinkId,
    pub(super) at: Pose,
}

/// Things that ride, and how their carrier moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Riding {
    carrier: String,
    /// The velocity (m/s) of the carrier, and its mean acceleration (m/s²).
    velocity: Vector3<f64>,
    acceleration: Vector3<f64>,
    /// Where each is on its carrier.
    places: Vec<(String, Pose)>,
}

impl Riding {
    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.text(&self.carrier);
        for number in self.velocity.iter().chain(self.acceleration.iter()) {
            hasher.number(*number);
        }
        for (name, place) in &self.places {
            hasher.text(name);
            hasher.pose(place);
        }
    }
}

impl World {
    /// What stands on something that two hands hold together, and so moves with them.
    pub(super) fn riders_of_two_hands(&self) -> Vec<Rider> {
        let carried: Vec<&Object> = self.objects().filter(|o| o.is_held_by_two()).collect();
        if carried.is_empty() {
            return Vec::new();
        }
        let mut riding = Vec::new();
        for object in self.objects().filter(|o| o.attachment().is_none()) {
            let below = self.carriers(object.name()).unwrap_or_default();
            let is_below = |carrier: &&&Object| {
                let mut names = below.iter().filter_map(BodyName::object);
                names.any(|name| name == carrier.name())
            };
            let Some(carrier) = carried.iter().find(is_below) else {
                continue;
            };
            let Some(held) = carrier.attachment() else {
                continue;
            };
            let [at, pose] = [carrier, &object].map(|one| self.physics.pose(one.body));
            riding.push(Rider {
                name: object.name().to_owned(),
                carrier: carrier.name().to_owned(),
                load: carrier.key(),
                link: held.link,
                at: held.at * at.inverse() * pose,
            });
        }
        riding
    }

    /// The mass (kg) of an object that two hands hold, with all that stands on it.
    pub(crate) fn load_of(&self, object: &Object) -> f64 {
        let riders = self.riders_of_two_hands();
        let own = riders.iter().filter(|rider| rider.load == object.key());
        let riding = own.filter_map(|rider| self.state.objects.get(&rider.name));
        object.mass() + riding.map(Object::mass).sum::<f64>()
    }

    /// Where (m) the weight acts of an object that two hands hold, with all that stands on it.
    pub(crate) fn balance_of_load(&self, object: &Object) -> Vector3<f64> {
        let balance = |object: &Object| object.balance_at(&self.physics.pose(object.body));
        let riders = self.riders_of_two_hands();
        let own = riders.iter().filter(|rider| rider.load == object.key());
        let riding = own.filter_map(|rider| self.state.objects.get(&rider.name));
        let (mass, moment) = riding.fold(
            (object.mass(), balance(object) * object.mass()),
            |(mass, moment), one| (mass + one.mass(), moment + balance(one) * one.mass()),
        );
        moment / mass
    }

    /// Keeps what rides in its place, where friction would. Call after a step of the engine.
    pub(super) fn keep_riders(&mut self) {
        let riders = self.riders_of_two_hands();
        let Some(carrier) = riders.first().map(|rider| rider.carrier.clone()) else {
            if self.state.riding != Riding::default() {
                self.state.riding = Riding::default();
            }
            return;
        };
        let Some(body) = self.state.objects.get(&carrier).map(|object| object.body) else {
            return;
        };
        let at = self.physics.pose(body);
        let (linear, angular) = self.physics.velocity(body);
        let before = std::mem::take(&mut self.state.riding);
        let is_new = before.carrier != carrier;
        let acceleration = match is_new {
            true => Vector3::zeros(),
            false => {
                let newest = (linear - before.velocity) / STEP_SECONDS;
                before.acceleration * (1.0 - NEWEST) + newest * NEWEST
            }
        };
        let mut places = Vec::new();
        for rider in riders.iter().filter(|rider| rider.carrier == carrier) {
            let Some(object) = self.state.objects.get(&rider.name) else {
                continue;
            };
            let known = before.places.iter().find(|(name, _)| *name == rider.name);
            let now = at.inverse() * self.physics.pose(object.body);
            let place = known.map_or(now, |(_, place)| *place);
            if known.is_none() || !self.is_kept(object, &carrier, &at, &place, &acceleration) {
                places.push((rider.name.clone(), now));
                continue;
            }
            let pose = at * place;
            let arm = pose.translation.vector - at.translation.vector;
            let velocity = linear + angular.cross(&arm);
            let rider_body = object.body;
            self.physics.carry(rider_body, &pose, &velocity, &angular);
            places.push((rider.name.clone(), place));
        }
        self.state.riding = Riding {
            carrier,
            velocity: linear,
            acceleration,
            places,
        };
    }

    /// Whether static friction keeps an object at a place on its carrier, which is at a pose and is accelerated (m/s²).
    fn is_kept(
        &self,
        object: &Object,
        carrier: &str,
        at: &Pose,
        place: &Pose,
        acceleration: &Vector3<f64>,
    ) -> bool {
        if tilt_at(place) > STANDS {
            return false;
        }
        let contacts = self.object_contacts(object.name()).unwrap_or_default();
        let mut others = contacts.iter().map(|contact| &contact.body);
        if others.any(|body| body.object().is_none()) {
            // The robot or furniture pushes it.
            return false;
        }
        let Some(below) = self.state.objects.get(carrier) else {
            return false;
        };
        let up = at.rotation * Vector3::z();
        let demanded = acceleration + Vector3::new(0.0, 0.0, GRAVITY);
        let pressed = demanded.dot(&up);
        let aside = (demanded - up * pressed).norm();
        let half = object.bounds.half_extents();
        let slides_at = (object.friction + below.friction) / 2.0;
        let tips_at = half.x.min(half.y) / half.z.max(1e-3);
        pressed > 0.0 && aside < pressed * slides_at.min(tips_at)
    }
}
