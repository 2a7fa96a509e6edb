//! What is known when no grasp of an object works: everything that was tried, with its cause.

use std::fmt;

use indexmap::IndexMap;
use serde::Serialize;

use super::grasp_obstacle::GraspObstacle;
use crate::robot::{Side, Unreachable};

/// How many causes the sentence lists.
const MAX_CAUSES: usize = 3;

/// An object that no hand can grasp as wanted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NoGrasp {
    /// Name of the object.
    pub object: String,
    /// Name of its type.
    pub kind: String,
    /// Extent of the object (m) along its x, y and z axes.
    pub size: [f64; 3],
    /// How far (m) a hand opens.
    pub widest: f64,
    /// What was tried, the nearest first; empty if no grasp is defined.
    pub tried: Vec<TriedGrasp>,
    /// What the arm lacks for the nearest of the grasps that are out of reach.
    pub missing: Option<Unreachable>,
    /// Why no hand can grasp objects of the type, if nothing was tried for that reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refusal: Option<String>,
}

/// A grasp that does not work.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TriedGrasp {
    /// The hand.
    pub side: Side,
    /// Name of the grasp.
    pub grasp: String,
    /// By how much (rad) it was turned about the object's vertical axis.
    pub turn: f64,
    /// Why it does not work.
    pub obstacle: GraspObstacle,
}

impl NoGrasp {
    /// The causes, the most frequent first, each with the grasps that it rules out.
    fn by_cause(&self) -> Vec<(String, Vec<&TriedGrasp>)> {
        let mut causes: IndexMap<String, Vec<&TriedGrasp>> = IndexMap::new();
        for tried in &self.tried {
            let cause = tried.obstacle.to_string();
            causes.entry(cause).or_default().push(tried);
        }
        let mut causes: Vec<_> = causes.into_iter().collect();
        causes.sort_by_key(|(_, tried)| std::cmp::Reverse(tried.len()));
        causes
    }

    /// The table of what was tried: one line for each cause and arm.
    pub fn table(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for (cause, tried) in self.by_cause() {
            for side in Side::BOTH {
                let with_arm = tried.iter().filter(|t| t.side == side);
                let mut turns: IndexMap<&str, usize> = IndexMap::new();
                for tried in with_arm {
                    *turns.entry(&tried.grasp).or_default() += 1;
                }
                if turns.is_empty() {
                    continue;
                }
                let names: Vec<String> = turns
                    .iter()
                    .map(|(name, count)| match count {
                        1 => (*name).to_owned(),
                        count => format!("{name} from {count} angles"),
                    })
                    .collect();
                lines.push(format!("{side} arm, {}: {cause}", names.join(", ")));
            }
        }
        if let Some(missing) = &self.missing {
            lines.push(format!("nearest to within reach: {missing}"));
        }
        lines
    }
}

impl fmt::Display for NoGrasp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            object,
            kind,
            size: [x, y, z],
            widest,
            tried,
            refusal,
            ..
        } = self;
        if let Some(refusal) = refusal.as_ref().filter(|_| tried.is_empty()) {
            return write!(f, "no hand can grasp {object}, a {kind}: it is {refusal}");
        }
        if tried.is_empty() {
            return write!(
                f,
                "no grasp of a {kind} is defined: {object} is {x:.3} m long, {y:.3} m wide and \
                 {z:.3} m high, and a hand opens to {widest:.3} m"
            );
        }
        write!(f, "no grasp of {object} works from here: ")?;
        let causes = self.by_cause();
        for (i, (cause, tried)) in causes.iter().take(MAX_CAUSES).enumerate() {
            let separator = if i > 0 { "; " } else { "" };
            write!(
                f,
                "{separator}{} of {}: {cause}",
                tried.len(),
                self.tried.len()
            )?;
        }
        if causes.len() > MAX_CAUSES {
            f.write_str("; …")?;
        }
        Ok(())
    }
}
