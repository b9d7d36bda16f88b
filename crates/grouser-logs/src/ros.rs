//! Messages of ROS: their types as logs describe them, `ros1msg` and `ros2msg`, and their bytes,
//! `ros1` and `cdr`. Sources: "ROS 2 Interface definition", docs.ros.org; "MCAP Format
//! Specification: well-known encodings", mcap.dev/spec; "DDS Interoperability Wire Protocol" 2.5,
//! section 10 (the header before a message) with "CORBA" 3.0, section 15.3 (Common Data
//! Representation), and "DDS-XTYPES" 1.3, section 7.4, for its second version.
//!
//! Written here: the published `re_ros_msg` (0.30) sets memory aside for as many elements as are
//! stated, by the type or by the message, before they are there, and has no limit of depth.

pub(crate) mod decode;
pub(crate) mod types;

#[cfg(test)]
mod tests;
