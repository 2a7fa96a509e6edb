//! Shows a session to nodes of ROS 2, if the program was built so.

use super::failure::CommandError;
use session::Session;

#[cfg(feature = "ros2")]
pub(crate) use node::{Publishing, open_node, publish, say, warn};

#[cfg(not(feature = "ros2"))]
pub(crate) use without::{Publishing, missing, publish};

/// With the feature.
#[cfg(feature = "ros2")]
mod node {
    use std::io::{self, Write};

    use super::{CommandError, Session};
    use descriptions::PR2_URDF;
    use ros::wire::{Broadcast, Node};
    use ros::{Distribution, Layouts, Reach};

    /// What a session sends; it ends with this.
    pub(crate) struct Publishing {
        // In this order they end: who speaks before what it speaks by.
        pub(crate) broadcast: Broadcast,
        pub(crate) node: Node,
    }

    /// Shows the session from now on, with the messages of a distribution, or of the environment's if the name
    /// is empty. Prints on standard error who can hear it.
    pub(crate) fn publish(
        session: &mut Session,
        distribution: &str,
    ) -> Result<Publishing, CommandError> {
        let wrong = |error: &dyn ToString| CommandError::Open(error.to_string());
        let (mut node, name) = open_node("planwright", distribution)?;
        let reach = node.reach();
        let robot = session.options().robot.as_ref();
        let robot = robot.map_or(PR2_URDF, |(_, urdf)| urdf.as_str());
        let remark = |remark: String| warn(&remark);
        let started = Broadcast::start(&mut node, session.models(), robot, remark);
        let (broadcast, follow) = started.map_err(|error| wrong(&error))?;
        session.show_to(Box::new(follow));
        say(&format!(
            "The session is a node of ROS 2 ({name}) in {reach}"
        ));
        Ok(Publishing { broadcast, node })
    }

    /// A node of a name that nobody asks for anything yet, and the name of its distribution: the one of that name, or
    /// that of the environment if the name is empty.
    pub(crate) fn open_node(
        node: &str,
        distribution: &str,
    ) -> Result<(Node, &'static str), CommandError> {
        let wrong = |error: &dyn ToString| CommandError::Open(error.to_string());
        let distribution = wanted(distribution).map_err(|error| wrong(&error))?;
        let reach = Reach::of_environment().map_err(|error| wrong(&error))?;
        let layouts = Layouts::of(distribution).map_err(|error| wrong(&error))?;
        let node = Node::open(node, reach, layouts).map_err(|error| wrong(&error))?;
        Ok((node, distribution.name()))
    }

    /// Tells a person something.
    pub(crate) fn say(text: &str) {
        // If standard error is closed, nobody is there to be told.
        let _ = writeln!(io::stderr(), "{text}");
    }

    /// Tells a person what is wrong.
    pub(crate) fn warn(text: &str) {
        say(&format!("; Warning: {text}"));
    }

    /// The distribution of a name; that of the environment, if it is one whose messages are known, for an empty
    /// one.
    fn wanted(name: &str) -> Result<Distribution, ros::UnknownDistribution> {
        if !name.is_empty() {
            return Distribution::named(name);
        }
        let of_environment = std::env::var("ROS_DISTRO").ok();
        match of_environment.filter(|name| !name.is_empty()) {
            Some(name) => Distribution::named(&name),
            None => Ok(Distribution::DEFAULT),
        }
    }
}

/// Without the feature.
#[cfg(not(feature = "ros2"))]
mod without {
    use super::{CommandError, Session};

    /// Nothing can be sent.
    pub(crate) enum Publishing {}

    /// Refuses.
    pub(crate) fn publish(_: &mut Session, _: &str) -> Result<Publishing, CommandError> {
        Err(missing())
    }

    /// What is said of whatever needs the feature.
    pub(crate) fn missing() -> CommandError {
        CommandError::Open(
            "this planwright was built without ROS 2: build it by \
             cargo build --release --features ros2"
                .to_owned(),
        )
    }
}
