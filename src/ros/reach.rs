//! Who can hear a node: its domain, and how far it reaches, as the environment of ROS says.

use thiserror::Error;

/// Who can hear a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// Nodes of other domains hear nothing.
    pub domain: u16,
    /// Whether only this machine hears it.
    pub only_this_machine: bool,
}

/// What the environment says of the reach cannot be.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReachError {
    /// A domain that there is not.
    #[error("ROS_DOMAIN_ID is {0:?}: a number from 0 to {MAX_DOMAIN} was expected")]
    Domain(String),
    /// A range that is not known.
    #[error("ROS_AUTOMATIC_DISCOVERY_RANGE is {0:?}: known are LOCALHOST and SUBNET")]
    Range(String),
}

/// The greatest domain whose ports there are.
const MAX_DOMAIN: u16 = 232;

impl Reach {
    /// The domain where none is asked for: not the usual one of ROS, so that no robot hears it by accident.
    pub const DOMAIN: u16 = 77;

    /// The reach that variables of the environment ask for; by default, only this machine.
    pub fn of(variable: impl Fn(&str) -> Option<String>) -> Result<Self, ReachError> {
        let given = |name: &str| variable(name).filter(|value| !value.trim().is_empty());
        let domain = match given("ROS_DOMAIN_ID") {
            None => Self::DOMAIN,
            Some(text) => {
                let domain = text.trim().parse().ok();
                let domain = domain.filter(|domain| *domain <= MAX_DOMAIN);
                domain.ok_or(ReachError::Domain(text))?
            }
        };
        let is_local = given("ROS_LOCALHOST_ONLY").is_some_and(|value| value.trim() == "1");
        let only_this_machine = match given("ROS_AUTOMATIC_DISCOVERY_RANGE") {
            None => true,
            Some(range) => match range.trim() {
                "LOCALHOST" => true,
                "SUBNET" => is_local,
                _ => return Err(ReachError::Range(range)),
            },
        };
        Ok(Self {
            domain,
            only_this_machine,
        })
    }

    /// The reach that the environment of this process asks for.
    pub fn of_environment() -> Result<Self, ReachError> {
        Self::of(|name| std::env::var(name).ok())
    }
}

impl std::fmt::Display for Reach {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let reach = match self.only_this_machine {
            true => "this machine only",
            false => "all networks of this machine",
        };
        write!(f, "domain {}, {reach}", self.domain)
    }
}

#[cfg(test)]
mod tests {
    use crate::reach::*;

    fn reach(given: &[(&str, &str)]) -> Result<Reach, ReachError> {
        let value = |name: &str| given.iter().find(|(known, _)| *known == name);
        Reach::of(|name| value(name).map(|(_, value)| (*value).to_owned()))
    }

    fn local(domain: u16) -> Reach {
        Reach {
            domain,
            only_this_machine: true,
        }
    }

    #[test]
    fn only_this_machine_hears_a_domain_of_its_own_unless_the_environment_asks_for_more() {
        assert_eq!(reach(&[]), Ok(local(77)));
        assert_eq!(reach(&[("ROS_DOMAIN_ID", "")]), Ok(local(77)));
        assert_eq!(reach(&[("ROS_DOMAIN_ID", "0")]), Ok(local(0)));
        let range = "ROS_AUTOMATIC_DISCOVERY_RANGE";
        let far = reach(&[(range, "SUBNET")]);
        assert!(far.is_ok_and(|reach| !reach.only_this_machine));
        let near = [(range, "SUBNET"), ("ROS_LOCALHOST_ONLY", "1")];
        assert_eq!(reach(&near), Ok(local(77)));
    }

    #[test]
    fn what_the_environment_says_wrongly_is_named() {
        for text in ["-1", "233", "65536", "1e9", "home"] {
            let wrong = reach(&[("ROS_DOMAIN_ID", text)]);
            assert_eq!(wrong, Err(ReachError::Domain(text.to_owned())));
        }
        for text in ["OFF", "localhost", "EVERYWHERE"] {
            let wrong = reach(&[("ROS_AUTOMATIC_DISCOVERY_RANGE", text)]);
            assert_eq!(wrong, Err(ReachError::Range(text.to_owned())));
        }
    }
}
