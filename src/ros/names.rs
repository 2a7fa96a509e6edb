//! What topics, services, actions and their types are called on the wire.

/// The DDS type of a message: of `std_msgs/msg/String`, `std_msgs::msg::dds_::String_`.
pub fn topic_type(message: &str) -> String {
    match message.rsplit_once('/') {
        Some((package, name)) => {
            format!("{}::dds_::{name}_", package.replace('/', "::"))
        }
        None => format!("dds_::{message}_"),
    }
}

/// The DDS topic of a topic of ROS.
pub fn topic(name: &str) -> String {
    format!("rt/{}", name.trim_start_matches('/'))
}

/// The DDS topics of a service: that of requests and that of replies.
pub fn service(name: &str) -> [String; 2] {
    let name = name.trim_start_matches('/');
    [format!("rq/{name}Request"), format!("rr/{name}Reply")]
}

/// The messages of a service `PACKAGE/srv/NAME`: request and response.
pub fn service_type(service: &str) -> [String; 2] {
    ["Request", "Response"].map(|part| format!("{service}_{part}"))
}

/// A message of an action `PACKAGE/action/NAME`, such as `SendGoal_Request` or `FeedbackMessage`.
pub fn action_type(action: &str, part: &str) -> String {
    format!("{action}_{part}")
}
