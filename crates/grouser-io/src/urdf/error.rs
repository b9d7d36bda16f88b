//! Why URDF is no rover of ours.

/// What is wrong with a text that should be URDF, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UrdfError {
    /// Bytes that are no text.
    #[error("is not a text")]
    NoText,
    /// No XML.
    #[error("is no XML: {0}")]
    Xml(String),
    /// Macros that are to be expanded first.
    #[error("is xacro, not URDF\nhint: xacro FILE.xacro > FILE.urdf writes URDF")]
    Xacro,
    /// Another document.
    #[error("has no <robot>: its root is <{0}>")]
    NoRobot(String),
    /// More links than a rover has.
    #[error("has more than {0} links and joints, the most that are read")]
    TooMany(usize),
    /// A link or a joint without something that it needs.
    #[error("{what} has no {lacks}")]
    Lacks {
        /// Which, as `link wheel`.
        what: String,
        /// What it has not.
        lacks: &'static str,
    },
    /// An invalid or impossible number.
    #[error("{what}: {attribute} is \"{written}\", it must be {expected}")]
    Number {
        /// Whose.
        what: String,
        /// Its name.
        attribute: &'static str,
        /// What stands there.
        written: String,
        /// What could.
        expected: &'static str,
    },
    /// Two of one name.
    #[error("{0} stands there twice: names must differ")]
    Twice(String),
    /// A joint to a link that is not there.
    #[error("joint {joint} leads to link {link}, which is not there")]
    NoLink {
        /// The joint.
        joint: String,
        /// The link.
        link: String,
    },
    /// A link with two parents.
    #[error("link {0} hangs on two joints: links of URDF are a tree")]
    TwoParents(String),
    /// Links that hang on each other.
    #[error("link {0} hangs on itself, by way of others: links of URDF are a tree")]
    Cycle(String),
    /// Several links that hang on nothing.
    #[error("links {0} and {1} hang on nothing: one link is the root")]
    TwoRoots(String, String),
    /// No wheels.
    #[error(
        "no wheels were found: nothing with a shape rolls without end (type continuous) about an \
         axis across the rover, with a partner on the other side{}; the links are {links}{}",
        about_others(askew),
        forward(*along)
    )]
    NoWheels {
        /// The links there are.
        links: String,
        /// How many roll about axes along the rover.
        along: usize,
        /// Links that roll about axes neither along nor across the rover.
        askew: Vec<String>,
    },
    /// Sprockets and rollers of tracks.
    #[error(
        "looks like a tracked vehicle, or one with legs: beside what is on the ground ({wheels}), \
         {rollers} roll without end in pairs; tracks and legs are not known here, wheels are"
    )]
    Tracks {
        /// Names of the links that roll on the ground.
        wheels: String,
        /// Names of the links that roll above them, in pairs.
        rollers: String,
    },
    /// Fewer wheels than a rover stands on.
    #[error(
        "has {count} wheels ({wheels}){beside}: a rover stands on three wheels at least, casters \
         and skids not counted"
    )]
    TooFewWheels {
        /// The wheels.
        wheels: String,
        /// How many they are.
        count: usize,
        /// What else is there that may touch the ground, each after an "and".
        beside: String,
    },
    /// More wheels than a rover has.
    #[error("has {count} wheels, and a rover has at most {most}: name those that are wheels")]
    TooManyWheels {
        /// How many were found.
        count: usize,
        /// The most.
        most: usize,
    },
    /// A pattern that no link has.
    #[error("no link is called {pattern}{}\nhint: the links are {links}", of_joints(joints))]
    NoSuchWheel {
        /// The pattern, as it was given.
        pattern: String,
        /// The links there are.
        links: String,
        /// Joints that are called so, each with the link that it leads to.
        joints: Vec<[String; 2]>,
    },
    /// A wheel without radius and width.
    #[error(
        "link {link} is a wheel, but {found}\nhint: its <collision> needs a <cylinder radius=\"…\" length=\"…\"/>, radius and width of its rim, whose axis (z) an origin with rpy=\"1.5708 0 0\" lays across; or the wheels' radius and width are given beside the URDF"
    )]
    NoRim {
        /// The link.
        link: String,
        /// What it has instead.
        found: String,
    },
    /// Two links of one wheel.
    #[error(
        "links {0} and {1} turn about the same axle and are one wheel\nhint: name the one that has the rim"
    )]
    OneWheelTwice(String, String),
    /// A joint of a type that a rover's joints do not have.
    #[error(
        "joint {joint} has the type {kind}, which a rover's joints do not have\nhint: they are fixed, continuous, revolute or prismatic"
    )]
    JointType {
        /// The joint.
        joint: String,
        /// Its type, as it is written.
        kind: String,
    },
    /// A wheel whose joints do not roll.
    #[error("link {0} is a wheel, but no joint above it turns about an axis across the rover")]
    DoesNotRoll(String),
    /// A joint about an axis that is neither across nor upright.
    #[error(
        "joint {0} turns about an axis that is neither across the rover, as rockers and bogies do, nor upright, as steering does\nhint: fix it (type=\"fixed\") if it stands still on the way"
    )]
    Askew(String),
    /// More joints than rockers and bogies have.
    #[error("between the body and wheel {0} are more than two joints about axes across the rover")]
    TooManyJoints(String),
    /// A differential that nobody spoke of.
    #[error(
        "joint {0} is a rocker, and URDF cannot say what holds the body between the rockers of both sides\nhint: a differential has to be asked for; other mechanisms are not known here, and a rigid rover has fixed joints (type=\"fixed\")"
    )]
    Differential(String),
    /// Rockers that turn the same way.
    #[error(
        "joints {0} and {1} turn the same way, by their <mimic>: that is no differential, and holds \
         no body between them\nhint: a differential's <mimic> has the other sign"
    )]
    TurnTogether(String, String),
    /// Rockers that turn against each other, and one farther than the other.
    #[error(
        "joint {right} turns {ratio:.3} times as far as joint {left}, and against it, by their \
         <mimic>: a differential turns both equally far\nhint: a differential's <mimic> has the \
         multiplier -1"
    )]
    TurnUnequally {
        /// The joint of the left side.
        left: String,
        /// The joint of the right side.
        right: String,
        /// How far the right one turns for a turn of the left one [-].
        ratio: f64,
    },
    /// Lengths in another unit than masses.
    #[error(
        "wheel {link} has a radius of {radius} m, a width of {width} m and a mass of {mass} kg, and \
         so is lighter than air: its lengths look like millimetres\nhint: URDF has metres: divide \
         all xyz, radius, length and size by 1000 and moments of inertia by 10⁶, or give a mesh in \
         millimetres its scale=\"0.001 0.001 0.001\""
    )]
    Millimetres {
        /// Its link.
        link: String,
        /// [m]
        radius: f64,
        /// [m]
        width: f64,
        /// [kg]
        mass: f64,
    },
    /// Masses in another unit than lengths.
    #[error(
        "wheel {link} has a radius of {radius} m, a width of {width} m and a mass of {mass} kg, and \
         so is heavier than any metal: its mass looks like grams\nhint: URDF has kilograms: divide all \
         masses and moments of inertia by 1000"
    )]
    Grams {
        /// Its link.
        link: String,
        /// [m]
        radius: f64,
        /// [m]
        width: f64,
        /// [kg]
        mass: f64,
    },
    /// Sides that differ.
    #[error(
        "{0} are not alike on both sides: joints {1} and {2} turn about axes at different places"
    )]
    Sides(&'static str, String, String),
    /// Bogies on the way, but not of all.
    #[error(
        "wheels of one side hang on rockers and bogies in a way that is not known here: on each \
         side one wheel is on the rocker, and two on its bogie"
    )]
    OtherSuspension,
    /// Nothing to carry.
    #[error(
        "all links are wheels, or none of the others has a mass\nhint: give the body's link an <inertial>"
    )]
    NoBody,
}

/// Joints that are called as a link was thought to be.
fn of_joints(joints: &[[String; 2]]) -> String {
    let Some([joint, link]) = joints.first() else { return String::new() };
    let more = if joints.len() > 1 { ", and so are others" } else { "" };
    format!(
        ": joint {joint}, which leads to link {link}, is called so{more}, and links are named here"
    )
}

/// What rolls about axes that no wheels have.
fn about_others(askew: &[String]) -> String {
    let Some(first) = askew.first() else { return String::new() };
    let more = if askew.len() > 1 { " and others roll" } else { " rolls" };
    format!(" ({first}{more} about an axis neither across nor along it)")
}

/// What helps where wheels roll along x.
fn forward(along: usize) -> String {
    if along < 2 {
        return String::new();
    }
    format!("\nhint: {along} links roll about axes along x: is y the rover's way forward?")
}
