//! A topic of a log of messages.

/// A topic of a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topic {
    /// Its name.
    pub name: String,
    /// The type of its messages, such as `sensor_msgs/msg/Imu`.
    pub message: String,
    /// How they are encoded, such as `json` or `cdr with a schema in ros2idl`; `None` where they
    /// come decoded.
    pub encoding: Option<String>,
}

impl Topic {
    /// Whether its messages can be decoded here.
    pub(crate) fn is_readable(&self) -> bool {
        self.encoding.as_deref().is_none_or(|it| matches!(it, "json" | "protobuf" | "cdr" | "ros1"))
    }
}
