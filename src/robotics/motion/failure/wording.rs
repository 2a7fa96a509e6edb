//! The phrases of which the reports of failures are made.

use super::base_place::BasePlace;
use super::stopped_part::StoppedPart;
use crate::perception::Visibility;
use crate::world::{BodyName, CollisionHit, HandleSlip};

/// Why a hand has lost a handle.
pub(super) fn why_slipped(slip: &HandleSlip) -> String {
    match &slip.against {
        Some(hit) => format!(", stopped by {}", hit.other),
        None => format!(", and the hand went {:.1} mm from the bar", slip.gap * 1e3),
    }
}

pub(super) fn stopped(part: &StoppedPart) -> String {
    let StoppedPart {
        joint,
        position,
        ahead,
        hit,
    } = part;
    let (moving, other) = (&hit.moving, &hit.other);
    match ahead {
        Some(ahead) => format!(
            "{joint} is at {position:.3} and cannot be moved past {ahead:.3}: {moving} would run into \
             {other}"
        ),
        None => format!("{joint} was stopped at {position:.3}: {moving} has run into {other}"),
    }
}

pub(super) fn next_below(below: &Option<(f64, BodyName)>) -> String {
    match below {
        Some((gap, body)) => format!("{body} is {:.1} cm below", gap * 100.0),
        None => "there is nothing below".to_owned(),
    }
}

pub(super) fn onto(support: Option<&BodyName>) -> String {
    support.map_or_else(|| "and fall".to_owned(), |body| format!("onto {body}"))
}

pub(super) fn place(&[x, y, yaw]: &BasePlace) -> String {
    format!(
        "x {x:.3}, y {y:.3}, heading {:.1} degrees",
        yaw.to_degrees()
    )
}

/// "a touches b" or, for a gap that is too narrow, "a is 3 mm from b".
pub(super) fn touch(hit: &CollisionHit) -> String {
    let CollisionHit {
        moving,
        other,
        depth,
        point,
    } = hit;
    let at = format!("at ({:.2} {:.2} {:.2})", point.x, point.y, point.z);
    if *depth > 0.0 {
        format!(
            "{moving} would overlap {other} by {:.1} mm {at}",
            depth * 1e3
        )
    } else {
        format!(
            "{moving} would be only {:.1} mm from {other} {at}",
            -depth * 1e3
        )
    }
}

pub(super) fn nearest(place: &Option<BasePlace>) -> String {
    match place {
        Some([x, y, _]) => {
            format!("\nthe nearest free place with this heading is x {x:.3}, y {y:.3}")
        }
        None => String::new(),
    }
}

pub(super) fn list<'a>(lead: &str, bodies: impl IntoIterator<Item = &'a BodyName>) -> String {
    let names: Vec<String> = bodies.into_iter().map(ToString::to_string).collect();
    if names.is_empty() {
        String::new()
    } else {
        format!("{lead}{}", names.join(", "))
    }
}

pub(super) fn heights(range: &Option<[f64; 2]>) -> String {
    match range {
        Some([least, greatest]) => format!("{least:.2} to {greatest:.2} m"),
        None => "no height".to_owned(),
    }
}

pub(super) fn sights(
    candidates: &[Visibility],
    wanted: &str,
    meant: Option<&str>,
    may_err: bool,
) -> String {
    if candidates.is_empty() {
        let meant = meant.map_or_else(String::new, |name| format!("; did you mean {name}?"));
        let nowhere = if may_err {
            "the robot recognises"
        } else {
            "the world holds"
        };
        return format!("\n{nowhere} no object like {wanted}{meant}");
    }
    let lines: Vec<String> = candidates.iter().map(ToString::to_string).collect();
    format!("\n{}", lines.join("; "))
}
