//! The contacts of a body, with the forces of the last step.

use nalgebra::Vector3;
use rapier3d_f64::geometry::{ColliderHandle, ContactPair};
use rapier3d_f64::math::{Pose as EnginePose, Vector};

use super::{BodyHandle, Physics, STEP_SECONDS};
use crate::world::solid::from_parry_vector;

/// A contact of a body that carries load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RawContact {
    /// Key of the other body's part.
    pub other: u64,
    /// Normal force (N), averaged over the last step.
    pub force: f64,
    /// The force on the body (N), as a vector.
    pub push: Vector3<f64>,
    /// Where it acts (m, map frame): the mean of the points that carry load.
    pub at: Vector3<f64>,
}

/// Gap (m) up to which a point counts as touching.
const TOUCHING: f64 = 0.0005;
/// The least vertical part of the normal of a level contact.
const LEVEL: f64 = 0.98;

/// A point at which a body touches another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TouchPoint {
    /// Key of the other body's part.
    pub other: u64,
    /// Where it is (m, map frame).
    pub at: Vector3<f64>,
    /// The normal force on the body (N), averaged over the last step.
    pub push: Vector3<f64>,
    /// Whether the other body is below it there, and level.
    pub is_level: bool,
}

impl Physics {
    /// Calls `visit` for every point at which the body touched another one in the last step, in the order of
    /// the body's parts.
    pub(crate) fn visit_touch_points(&self, body: BodyHandle, mut visit: impl FnMut(TouchPoint)) {
        let Some(body) = self.sets.bodies.get(body.0) else {
            return;
        };
        for &own in body.colliders() {
            for pair in self.sets.narrow_phase.contact_pairs_with(own) {
                let (other, sign) = if pair.collider1 == own {
                    (pair.collider2, -1.0)
                } else {
                    (pair.collider1, 1.0)
                };
                let other = self.sets.colliders.get(other);
                let place = self.sets.colliders.get(pair.collider1);
                let (Some(other), Some(place)) = (other, place) else {
                    continue;
                };
                let (Ok(other), place) = (u64::try_from(other.user_data), place.position()) else {
                    continue;
                };
                for manifold in pair.solver_manifolds() {
                    let normal = from_parry_vector(manifold.data.normal) * sign;
                    for contact in &manifold.data.solver_contacts {
                        for index in contact.contact_indices() {
                            let index = usize::try_from(index).ok();
                            let Some(point) = index.and_then(|i| manifold.points.get(i)) else {
                                continue;
                            };
                            let impulse = point.data.impulse;
                            if impulse > 0.0 || point.dist < TOUCHING {
                                visit(TouchPoint {
                                    other,
                                    at: from_parry_vector(place * point.local_p1),
                                    push: normal * (impulse / STEP_SECONDS),
                                    is_level: normal.z > LEVEL,
                                });
                            }
                        }
                    }
                }
            }
        }
    }

    /// Calls `visit` for every contact of the body that carried load in the last step, in the
    /// order of the body's parts: those for whose two keys, the body's own first, `counts` is true.
    /// Finding out the force takes long, that is for no other contacts.
    pub(crate) fn visit_contacts(
        &self,
        body: BodyHandle,
        counts: impl Fn(u64, u64) -> bool,
        mut visit: impl FnMut(RawContact),
    ) {
        let Some(body) = self.sets.bodies.get(body.0) else {
            return;
        };
        for &collider in body.colliders() {
            for pair in self.sets.narrow_phase.contact_pairs_with(collider) {
                if let Some(contact) = self.raw_contact(collider, pair, &counts) {
                    visit(contact);
                }
            }
        }
    }

    fn raw_contact(
        &self,
        own: ColliderHandle,
        pair: &ContactPair,
        counts: impl Fn(u64, u64) -> bool,
    ) -> Option<RawContact> {
        let (other, sign) = if pair.collider1 == own {
            (pair.collider2, -1.0)
        } else {
            (pair.collider1, 1.0)
        };
        let key = |c: ColliderHandle| {
            let data = self.sets.colliders.get(c)?.user_data;
            u64::try_from(data).ok()
        };
        let (own, other) = (key(own)?, key(other)?);
        // Pairs exist before bodies touch; only active ones do.
        if !counts(own, other) || !pair.has_any_active_contact() {
            return None;
        }
        let place = self.sets.colliders.get(pair.collider1)?.position();
        let NormalImpulse { sum, vector, point } = normal_impulse(pair, place);
        let force = sum / STEP_SECONDS;
        (force > 0.0).then_some(RawContact {
            other,
            force,
            push: from_parry_vector(vector) * (sign / STEP_SECONDS),
            at: from_parry_vector(point),
        })
    }
}

/// The normal impulses of a pair in the last step.
struct NormalImpulse {
    /// Their sum (N s).
    sum: f64,
    /// The same as a vector, on the second body.
    vector: Vector,
    /// The mean of the points (m, map frame) at which they act, weighted by them.
    point: Vector,
}

/// The normal impulses of the last step; `place` is the pose of the first collider.
///
/// The engine's own sum includes every point of a manifold, but points that the solver did
/// not use keep the impulse of an earlier step; a bottle of 2 N would weigh 3 N.
fn normal_impulse(pair: &ContactPair, place: &EnginePose) -> NormalImpulse {
    let (mut sum, mut vector, mut point) = (0.0, Vector::ZERO, Vector::ZERO);
    for manifold in pair.solver_manifolds() {
        for contact in &manifold.data.solver_contacts {
            for index in contact.contact_indices() {
                let index = usize::try_from(index).ok();
                let Some(contact) = index.and_then(|i| manifold.points.get(i)) else {
                    continue;
                };
                let impulse = contact.data.impulse;
                sum += impulse;
                vector += manifold.data.normal * impulse;
                point += (place * contact.local_p1) * impulse;
            }
        }
    }
    let point = if sum > 0.0 { point / sum } else { point };
    NormalImpulse { sum, vector, point }
}
