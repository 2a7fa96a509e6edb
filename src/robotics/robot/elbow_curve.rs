//! All ways to hold the wrist at a given pose: the curve of possible elbow positions.
//!
//! With the wrist fixed, seven joints leave one freedom. The elbow lies on a sphere about
//! the wrist (radius: forearm) and on a torus about the pan axis (upper arm turned about
//! the lift axis, which the pan axis carries around): their intersection is a curve with
//! the shoulder lift angle as its natural parameter. For each lift angle the pan angle is
//! one of two (`bend` +1 or -1); all other joints follow.
//!
//! Where along the curve a joint meets a limit is known in closed form: for pan, lift,
//! roll and elbow from `A cos + B sin = C`, for the wrist flex from a quartic in the
//! tangent of half the lift angle. Between two such points every limit is either kept or
//! violated throughout, so the search is complete: nothing is sampled.

use nalgebra::{Matrix3, Vector3};

use super::ArmPositions;
use super::arm_chain::{ArmChain, ELBOW, FLEX, LIFT, PAN, ROLL};
use super::polynomial::quartic_roots;
use spatial::{Pose, trig};

/// How often the curve meets limits at most, but for that of the wrist flex, with the ends of the lift's range: two
/// lift angles each for the wrist on either side of the pan axis, and for the limits of pan and elbow, and four for a
/// limit of the roll.
const MAX_CUTS: usize = 2 + 2 * (2 + 2 + 2) + 2 * 4;
/// Positions up to this far (rad) outside a limit count as on the limit.
const SLACK: f64 = 1e-9;

/// A stretch of the curve, given by lift angles (rad), on which all limits are kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(crate) bend: f64,
    pub from: f64,
    pub to: f64,
}

impl Stretch {
    /// The lift angle (rad) at a fraction 0..1 of the stretch.
    ///
    /// Equal steps yield denser lift angles towards the ends, where the pan angle changes fastest.
    pub(crate) fn lift_at(&self, share: f64) -> f64 {
        let inset = 1e-9 * (self.to - self.from);
        let (from, to) = (self.from + inset, self.to - inset);
        let middle = 0.5 * (from + to);
        middle - 0.5 * (to - from) * trig::cos(std::f64::consts::PI * share)
    }
}

/// A point of the curve. Shoulder and elbow angles are computed only where they are needed.
#[derive(Clone, Copy, Debug)]
struct ArmPoint {
    lift: f64,
    /// The elbow, seen from above (m): along the direction of the wrist, and beside it.
    ahead: f64,
    beside: f64,
    /// The wrist in the frame that pan and lift move (m): beside and above the upper arm, how far from its axis that is, and
    /// along it from the elbow.
    side: f64,
    above: f64,
    bent: f64,
    along: f64,
    /// Axes of the forearm (columns) in the frame of the arm's base.
    forearm: Matrix3<f64>,
}

/// The angles (rad) of forearm roll, wrist flex and wrist roll that turn a hand into an orientation, given the
/// axes of the forearm before it is rolled, both in the frame of the arm's base.
pub(super) fn wrist_angles(forearm: &Matrix3<f64>, hand: &Matrix3<f64>) -> [f64; 3] {
    let inward = forearm.tr_mul(&hand.column(0));
    let first = hand.tr_mul(&forearm.column(0));
    [
        trig::atan2(-inward.y, inward.z),
        -trig::atan2(libm::hypot(inward.y, inward.z), inward.x),
        trig::atan2(-first.y, -first.z),
    ]
}

/// The curve for one pose of the wrist.
pub(super) struct ElbowCurve<'a> {
    chain: &'a ArmChain,
    /// Orientation of the wrist in the frame of the arm's base.
    rotation: Matrix3<f64>,
    /// The wrist relative to the shoulder: distance from the pan axis, direction and height.
    reach: f64,
    direction: f64,
    toward: (f64, f64),
    height: f64,
    /// (d² + L₁² + |W|² - L₂²) / 2.
    constant: f64,
}

impl<'a> ElbowCurve<'a> {
    /// The curve for a pose of the wrist in the frame of the arm's base.
    pub(super) fn new(chain: &'a ArmChain, wrist: &Pose) -> Self {
        let w: Vector3<f64> = wrist.translation.vector - chain.shoulder;
        let (d, l1, l2) = (chain.shoulder_offset, chain.upper_arm, chain.forearm);
        // On the pan axis itself the direction is arbitrary; a reach of half a nanometre
        // stands for zero, so that one formula covers all positions.
        let horizontal = libm::hypot(w.x, w.y);
        let (reach, toward) = if horizontal > 5e-10 {
            (horizontal, (w.x / horizontal, w.y / horizontal))
        } else {
            (5e-10, (1.0, 0.0))
        };
        Self {
            chain,
            rotation: wrist.rotation.to_rotation_matrix().into_inner(),
            reach,
            direction: trig::atan2(toward.1, toward.0),
            toward,
            height: w.z,
            constant: 0.5 * (d * d + l1 * l1 - l2 * l2 + reach * reach + w.z * w.z),
        }
    }

    /// The stretches on which every joint is within its limits.
    pub(super) fn stretches(&self) -> Vec<Stretch> {
        let lift = self.chain.limits(LIFT);
        let mut cuts = Vec::with_capacity(MAX_CUTS);
        cuts.extend([lift.lower, lift.upper]);
        for along in [self.reach, -self.reach] {
            self.cut_where_wrist_is_along(along, &mut cuts);
        }
        let pan = self.chain.limits(PAN);
        for limit in [pan.lower, pan.upper] {
            let along = self.reach * trig::cos(self.direction - limit);
            self.cut_where_wrist_is_along(along, &mut cuts);
        }
        let elbow = self.chain.limits(ELBOW);
        for limit in [elbow.lower, elbow.upper] {
            let along = self.chain.shoulder_offset + self.forward(trig::cos(limit));
            self.cut_where_wrist_is_along(along, &mut cuts);
        }
        let roll = self.chain.limits(ROLL);
        for limit in [roll.lower, roll.upper] {
            for elbow_cos in self.elbow_cosines(trig::sin(limit)).into_iter().flatten() {
                let along = self.chain.shoulder_offset + self.forward(elbow_cos);
                self.cut_where_wrist_is_along(along, &mut cuts);
            }
        }
        cuts.retain(|cut| lift.contains(*cut));
        cuts.sort_unstable_by(f64::total_cmp);
        let mut stretches = Vec::new();
        for bend in [1.0, -1.0] {
            for pair in cuts.windows(2) {
                let (from, to) = (pair[0], pair[1]);
                if to > from && self.shoulder_allows(0.5 * (from + to), bend) {
                    self.split_by_wrist_flex(Stretch { bend, from, to }, &mut stretches);
                }
            }
        }
        stretches
    }

    /// The joint positions at a lift angle (rad), or `None` where the curve has no point.
    /// Limits are ignored; continuous joints are within -π..π.
    pub(super) fn positions(&self, lift: f64, bend: f64) -> Option<ArmPositions> {
        self.point(lift, bend).map(|point| self.with_wrist(&point))
    }

    /// The joint positions with the upper arm rolled to `roll` (rad): at most two.
    /// Limits are ignored.
    pub(crate) fn positions_at_roll(&self, roll: f64) -> [Option<ArmPositions>; 2] {
        let (sin, cos) = trig::sin_cos(roll);
        self.elbow_cosines(sin).map(|elbow_cos| {
            let elbow_cos = elbow_cos.filter(|c| c.abs() <= 1.0)?;
            let x = self.forward(elbow_cos);
            let bent = self.chain.forearm * (1.0 - elbow_cos * elbow_cos).sqrt();
            let y = -bent * sin;
            let along = self.chain.upper_arm + self.chain.forearm * elbow_cos;
            let lift = trig::atan2(bent * cos, along) - trig::atan2(self.height, x);
            let lift = trig::wrap(lift);
            self.positions(lift, if y < 0.0 { -1.0 } else { 1.0 })
        })
    }

    /// How far (m) the forearm is too short or too long at the lift angle (rad).
    pub(super) fn miss(&self, lift: f64) -> f64 {
        let (s, c) = trig::sin_cos(lift);
        let around = self.chain.shoulder_offset + self.chain.upper_arm * c;
        let below = self.height + self.chain.upper_arm * s;
        let nearest = libm::hypot(self.reach - around, below);
        let farthest = libm::hypot(self.reach + around, below);
        (nearest - self.chain.forearm)
            .max(self.chain.forearm - farthest)
            .max(0.0)
    }

    /// How far in front of the lift axis the wrist is when the elbow's cosine is `elbow_cos`.
    fn forward(&self, elbow_cos: f64) -> f64 {
        let (d, l1, l2) = (
            self.chain.shoulder_offset,
            self.chain.upper_arm,
            self.chain.forearm,
        );
        let squares = self.reach * self.reach + self.height * self.height - d * d;
        (squares - l1 * l1 - l2 * l2 - 2.0 * l1 * l2 * elbow_cos) / (2.0 * d)
    }

    /// The cosines of the elbow angle that match the sine of the upper arm roll.
    fn elbow_cosines(&self, roll_sin: f64) -> [Option<f64>; 2] {
        let d = self.chain.shoulder_offset;
        let ahead = d + self.forward(0.0);
        let per_cos = self.chain.upper_arm * self.chain.forearm / d;
        let side = self.chain.forearm * roll_sin;
        // (per_cos² - side²) c² - 2 per_cos ahead c + ahead² + side² - reach² = 0
        let a = per_cos * per_cos - side * side;
        let half_b = per_cos * ahead;
        let c = ahead * ahead + side * side - self.reach * self.reach;
        let discriminant = half_b * half_b - a * c;
        if discriminant < 0.0 || a.abs() < 1e-12 {
            return [None, None];
        }
        // To avoid cancellation, compute the larger root first and the other one from the product.
        let q = half_b + discriminant.sqrt().copysign(half_b);
        let other = if q == 0.0 { 0.0 } else { c / q };
        [Some(q / a), Some(other)]
    }

    /// Adds the lift angles where the wrist is `along` (m) ahead of the pan axis, in the
    /// vertical plane of the upper arm.
    fn cut_where_wrist_is_along(&self, along: f64, cuts: &mut Vec<f64>) {
        let (d, l1) = (self.chain.shoulder_offset, self.chain.upper_arm);
        let (a, b) = (l1 * (d - along), l1 * self.height);
        let size = libm::hypot(a, b);
        let cos = (along * d - self.constant) / size;
        if cos.abs() <= 1.0 {
            let (middle, half) = (trig::atan2(b, a), trig::acos(cos));
            cuts.extend([trig::wrap(middle - half), trig::wrap(middle + half)]);
        }
    }

    fn point(&self, lift: f64, bend: f64) -> Option<ArmPoint> {
        let (d, l1) = (self.chain.shoulder_offset, self.chain.upper_arm);
        let (s2, c2) = trig::sin_cos(lift);
        let around = d + l1 * c2;
        // The elbow, seen from above, relative to the direction of the wrist.
        let ahead = (self.constant + d * l1 * c2 + l1 * self.height * s2) / self.reach;
        let beside_squared = (around - ahead) * (around + ahead);
        if beside_squared < -1e-12 || around <= 0.0 {
            return None;
        }
        let beside = bend * beside_squared.max(0.0).sqrt();
        let (cos, sin) = (ahead / around, beside / around);
        // The wrist in the frame that pan and lift move.
        let (x, y) = (self.reach * cos - d, self.reach * sin);
        let along = c2 * x - s2 * self.height;
        let above = s2 * x + c2 * self.height;
        let bent = libm::hypot(y, above);
        let (s3, c3) = match bent > 0.0 {
            true => (-y / bent, above / bent),
            false => (0.0, 1.0),
        };
        let length = libm::hypot(bent, along - l1);
        let (s4, c4) = (-bent / length, (along - l1) / length);
        let c1 = self.toward.0 * cos + self.toward.1 * sin;
        let s1 = self.toward.1 * cos - self.toward.0 * sin;
        let upper_x = Vector3::new(c1 * c2, s1 * c2, -s2);
        let lifted_y = Vector3::new(-s1, c1, 0.0);
        let lifted_z = Vector3::new(c1 * s2, s1 * s2, c2);
        let rolled_y = lifted_y * c3 + lifted_z * s3;
        let rolled_z = lifted_z * c3 - lifted_y * s3;
        let forearm_x = upper_x * c4 - rolled_z * s4;
        let forearm_z = upper_x * s4 + rolled_z * c4;
        Some(ArmPoint {
            lift,
            ahead,
            beside,
            side: y,
            above,
            bent,
            along: along - l1,
            forearm: Matrix3::from_columns(&[forearm_x, rolled_y, forearm_z]),
        })
    }

    /// The shoulder pan (rad) that leads to a point.
    fn pan(&self, point: &ArmPoint) -> f64 {
        let beside = trig::atan2(point.beside, point.ahead);
        self.turned_into(PAN, self.direction - beside)
    }

    /// The roll (rad) of the upper arm that leads to a point.
    fn roll(&self, point: &ArmPoint) -> f64 {
        self.turned_into(ROLL, trig::atan2(-point.side, point.above))
    }

    /// The elbow angle (rad) that leads to a point.
    fn elbow(&self, point: &ArmPoint) -> f64 {
        -trig::atan2(point.bent, point.along)
    }

    /// The angle, moved by full turns into the limits of the joint, or as near to them as possible.
    fn turned_into(&self, joint: usize, angle: f64) -> f64 {
        let limits = self.chain.limits(joint);
        let middle = 0.5 * (limits.lower + limits.upper);
        middle + trig::wrap(angle - middle)
    }

    fn with_wrist(&self, point: &ArmPoint) -> ArmPositions {
        let [forearm, flex, wrist] = wrist_angles(&point.forearm, &self.rotation);
        let (pan, roll, elbow) = (self.pan(point), self.roll(point), self.elbow(point));
        [pan, point.lift, roll, elbow, forearm, flex, wrist].into()
    }

    /// Whether pan, roll and elbow are within their limits at the lift angle.
    fn shoulder_allows(&self, lift: f64, bend: f64) -> bool {
        let allows =
            |joint: usize, position: f64| self.chain.limits(joint).excess(position) <= SLACK;
        self.point(lift, bend).is_some_and(|point| {
            allows(PAN, self.pan(&point))
                && allows(ROLL, self.roll(&point))
                && allows(ELBOW, self.elbow(&point))
        })
    }

    /// Keeps the parts of a stretch on which the wrist flex is within its limits.
    fn split_by_wrist_flex(&self, whole: Stretch, kept: &mut Vec<Stretch>) {
        let flex = self.chain.limits(FLEX);
        // The flex goes from 0 (cosine 1) to -π (cosine -1).
        let cosines = [trig::cos(flex.lower), trig::cos(flex.upper)];
        let half_tangent = |lift: f64| {
            let (s, c) = trig::sin_cos(0.5 * lift);
            s / c
        };
        let (from, to) = (half_tangent(whole.from), half_tangent(whole.to));
        let mut cuts = vec![whole.from, whole.to];
        for cosine in cosines {
            let quartic = self.wrist_flex_quartic(cosine);
            let roots = quartic_roots(&quartic, from, to);
            cuts.extend(roots.as_slice().iter().map(|t| 2.0 * trig::atan2(*t, 1.0)));
        }
        cuts.sort_unstable_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let (from, to) = (pair[0].max(whole.from), pair[1].min(whole.to));
            let middle = self.point(0.5 * (from + to), whole.bend);
            let cosine = middle.map(|p| p.forearm.column(0).dot(&self.rotation.column(0)));
            let keeps = |c: f64| c >= cosines[0] - SLACK && c <= cosines[1] + SLACK;
            if to > from && cosine.is_some_and(keeps) {
                match kept.last_mut() {
                    // The bound was not crossed here after all.
                    Some(last) if last.bend == whole.bend && last.to == from => last.to = to,
                    _ => kept.push(Stretch { from, to, ..whole }),
                }
            }
        }
    }

    /// Polynomial in t = tan(lift / 2) that vanishes where the cosine of the wrist flex is
    /// `cosine`, for either bend.
    ///
    /// The cosine is that between forearm and hand: (W - E)·r / L₂ with the elbow E at
    /// `ahead` and `beside` of the wrist's direction. Isolating `beside`, the only square
    /// root, and squaring leaves a polynomial of degree two in the lift's cosine and sine.
    fn wrist_flex_quartic(&self, cosine: f64) -> [f64; 5] {
        let (d, l1) = (self.chain.shoulder_offset, self.chain.upper_arm);
        let (cos, sin) = self.toward;
        let r: Vector3<f64> = self.rotation.column(0).into_owned();
        // Parts of r along, beside (to the right of) and above the wrist's direction.
        let (along, beside) = (r.x * cos + r.y * sin, r.x * sin - r.y * cos);
        let reach = self.reach;
        // Constant, cosine and sine parts of ahead * reach, of around, and of what
        // `beside * reach` times the elbow's offset must be.
        let ahead = [self.constant, d * l1, l1 * self.height];
        let around = [d, l1, 0.0];
        let wrist = along * reach + r.z * self.height - self.chain.forearm * cosine;
        let must = [
            reach * wrist - along * ahead[0],
            -along * ahead[1],
            reach * l1 * r.z - along * ahead[2],
        ];
        let b2 = beside * beside;
        let product = |i: usize, j: usize| {
            must[i] * must[j] + b2 * (ahead[i] * ahead[j] - reach * reach * around[i] * around[j])
        };
        let (one, c, s) = (product(0, 0), 2.0 * product(0, 1), 2.0 * product(0, 2));
        let (cc, cs, ss) = (product(1, 1), 2.0 * product(1, 2), product(2, 2));
        [
            one + c + cc,
            2.0 * (s + cs),
            2.0 * (one - cc) + 4.0 * ss,
            2.0 * (s - cs),
            one - c + cc,
        ]
    }
}
