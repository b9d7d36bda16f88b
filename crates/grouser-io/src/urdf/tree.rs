//! The links and joints of URDF as a tree.

use std::borrow::Cow;

use nalgebra::{Isometry3, Matrix3, Vector3};
use roxmltree::{Document, Node, ParsingOptions};

use super::error::UrdfError;
use super::options::Forward;
use super::shapes::LinkShape;
use super::xml::{attribute, child, number, origin, triple};

/// The most links and joints.
const MOST: usize = 10_000;
/// The most elements and attributes of the text.
const NODES: u32 = 1_000_000;

/// A robot: link 0 is the root, and parents come before their children.
#[derive(Debug)]
pub(super) struct Robot {
    pub(super) name: String,
    pub(super) links: Vec<Link>,
}

/// A link, with the joint that it hangs on.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) name: String,
    /// Place of its parent among the links; none of the root.
    pub(super) parent: Option<usize>,
    pub(super) joint: Option<Joint>,
    pub(super) inertial: Option<Inertial>,
    pub(super) shapes: Vec<Result<LinkShape, UrdfError>>,
    /// Its frame in the root's, where all joints are at zero.
    pub(super) frame: Isometry3<f64>,
}

#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) kind: String,
    parent: String,
    child: String,
    origin: Isometry3<f64>,
    /// In the joint's frame, a unit vector.
    axis: Vector3<f64>,
    /// How far it turns, down to and up to [rad]; none where neither is stated.
    pub(super) limits: Option<[f64; 2]>,
    /// The joint that it turns with, and how far it turns for a turn of that.
    pub(super) mimic: Option<(String, f64)>,
}

/// Mass, centre and inertia of a link, in its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertial {
    pub(super) mass: f64,
    pub(super) origin: Isometry3<f64>,
    /// About its centre, in the frame of `origin`; zero where it is not stated.
    pub(super) inertia: Matrix3<f64>,
}

impl Robot {
    /// * `forward`: which way of the root link is forward
    pub(super) fn read(text: &str, forward: Forward) -> Result<Self, UrdfError> {
        let text = with_prefixes(text)?;
        let document = parse(&text).map_err(|error| UrdfError::Xml(error.to_string()))?;
        let robot = document.root_element();
        if robot.tag_name().name() != "robot" {
            return Err(UrdfError::NoRobot(robot.tag_name().name().to_owned()));
        }
        if robot.descendants().any(|node| node.tag_name().namespace().is_some_and(is_xacro)) {
            return Err(UrdfError::Xacro);
        }
        let named = |tag: &'static str| robot.children().filter(move |node| node.has_tag_name(tag));
        if named("link").count() + named("joint").count() > MOST {
            return Err(UrdfError::TooMany(MOST));
        }
        let links = named("link").map(link).collect::<Result<Vec<_>, _>>()?;
        let joints = named("joint").map(joint).collect::<Result<Vec<_>, _>>()?;
        check_names("link", links.iter().map(|link| &link.name))?;
        check_names("joint", joints.iter().map(|joint| &joint.name))?;
        let name = robot.attribute("name").unwrap_or("rover").to_owned();
        Ok(Self { name, links: ordered(&links, joints, forward)? })
    }

    /// Whether each link is one of some links, or hangs on one of them.
    pub(super) fn hanging_on(&self, some: &[usize]) -> Vec<bool> {
        let mut hanging = vec![false; self.links.len()];
        for (place, link) in self.links.iter().enumerate() {
            hanging[place] = some.contains(&place) || link.parent.is_some_and(|it| hanging[it]);
        }
        hanging
    }

    /// A link, its parent, and so on to the root.
    pub(super) fn up_from(&self, link: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(link), |link| self.links[*link].parent)
    }
}

fn parse(text: &str) -> Result<Document<'_>, roxmltree::Error> {
    let options = ParsingOptions { nodes_limit: NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options)
}

/// A text whose prefixes are declared: what stands in `<gazebo>` and the like often has others, and
/// does not matter.
fn with_prefixes(text: &str) -> Result<Cow<'_, str>, UrdfError> {
    /// The most prefixes that are declared.
    const PREFIXES: usize = 20;
    let mut text = Cow::Borrowed(text);
    for _ in 0..PREFIXES {
        let Err(roxmltree::Error::UnknownNamespace(prefix, _)) = parse(&text) else { break };
        if is_xacro(&prefix) {
            return Err(UrdfError::Xacro);
        }
        let Some(at) = text.find("<robot") else { break };
        let at = at + "<robot".len();
        let declared = format!(" xmlns:{prefix}=\"urn:undeclared:{prefix}\"");
        text = Cow::Owned(format!("{}{declared}{}", &text[..at], &text[at..]));
    }
    Ok(text)
}

impl Link {
    /// Where its joint is, in the root's frame [m].
    pub(super) fn pivot(&self) -> Vector3<f64> {
        self.frame.translation.vector
    }

    /// The axis of its joint, in the root's frame.
    pub(super) fn axis(&self) -> Option<Vector3<f64>> {
        Some(self.frame.rotation * self.joint.as_ref()?.axis)
    }

    /// How far its joint turns [rad], where that is stated.
    pub(super) fn limits(&self) -> Option<[f64; 2]> {
        self.joint.as_ref()?.limits
    }
}

fn is_xacro(namespace: &str) -> bool {
    namespace.contains("xacro")
}

fn check_names<'a>(what: &str, names: impl Iterator<Item = &'a String>) -> Result<(), UrdfError> {
    let mut sorted: Vec<&String> = names.collect();
    sorted.sort();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(UrdfError::Twice(format!("{what} {}", pair[0]))),
        None => Ok(()),
    }
}

/// Links in an order in which parents come first, with their frames.
fn ordered(links: &[Link], joints: Vec<Joint>, forward: Forward) -> Result<Vec<Link>, UrdfError> {
    let place = |joint: &Joint, name: &String| {
        links
            .iter()
            .position(|link| link.name == *name)
            .ok_or_else(|| UrdfError::NoLink { joint: joint.name.clone(), link: name.clone() })
    };
    let mut hangs: Vec<Option<(usize, Joint)>> = vec![None; links.len()];
    for joint in joints {
        let (parent, child) = (place(&joint, &joint.parent)?, place(&joint, &joint.child)?);
        if hangs[child].is_some() {
            return Err(UrdfError::TwoParents(links[child].name.clone()));
        }
        hangs[child] = Some((parent, joint));
    }
    let mut roots = (0..links.len()).filter(|link| hangs[*link].is_none());
    let Some(root) = roots.next() else {
        return Err(match links.first() {
            Some(first) => UrdfError::Cycle(first.name.clone()),
            None => UrdfError::NoBody,
        });
    };
    if let Some(other) = roots.next() {
        return Err(UrdfError::TwoRoots(links[root].name.clone(), links[other].name.clone()));
    }
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); links.len()];
    for (child, joint) in hangs.iter().enumerate() {
        if let Some((parent, _)) = joint {
            children[*parent].push(child);
        }
    }
    // Breadth first: what is not reached hangs on itself.
    let mut order = vec![root];
    let mut next = 0;
    while let Some(&link) = order.get(next) {
        order.extend(&children[link]);
        next += 1;
    }
    if let Some(lost) = (0..links.len()).find(|link| !order.contains(link)) {
        return Err(UrdfError::Cycle(links[lost].name.clone()));
    }
    let mut sorted: Vec<Link> = Vec::with_capacity(links.len());
    for &old in &order {
        let mut link = links[old].clone();
        if let Some((parent, joint)) = hangs[old].take() {
            let parent = order.iter().position(|it| *it == parent).unwrap_or(0);
            link.frame = sorted[parent].frame * joint.origin;
            link.parent = Some(parent);
            link.joint = Some(joint);
        } else {
            link.frame = forward.turned();
        }
        sorted.push(link);
    }
    Ok(sorted)
}

fn link(node: Node<'_, '_>) -> Result<Link, UrdfError> {
    let name = attribute(node, "a link", "name")?.to_owned();
    let what = format!("link {name}");
    let inertial = child(node, "inertial").map(|node| inertial(node, &what)).transpose()?;
    let shapes = LinkShape::all(node, &what);
    let frame = Isometry3::identity();
    Ok(Link { name, parent: None, joint: None, inertial, shapes, frame })
}

fn inertial(node: Node<'_, '_>, what: &str) -> Result<Inertial, UrdfError> {
    let lacks = |lacks| UrdfError::Lacks { what: what.to_owned(), lacks };
    let mass = child(node, "mass").ok_or_else(|| lacks("mass in its <inertial>"))?;
    let mass = number(mass, what, "value", |mass| mass >= 0.0, "a mass in kg, not below 0")?;
    let origin = origin(node, what)?;
    let Some(tensor) = child(node, "inertia") else {
        return Ok(Inertial { mass, origin, inertia: Matrix3::zeros() });
    };
    let part = |name| number(tensor, what, name, |_| true, "a moment of inertia in kg m²");
    let or_zero = |name| if tensor.has_attribute(name) { part(name) } else { Ok(0.0) };
    let (xx, yy, zz) = (part("ixx")?, part("iyy")?, part("izz")?);
    let (xy, xz, yz) = (or_zero("ixy")?, or_zero("ixz")?, or_zero("iyz")?);
    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    Ok(Inertial { mass, origin, inertia })
}

fn joint(node: Node<'_, '_>) -> Result<Joint, UrdfError> {
    let name = attribute(node, "a joint", "name")?.to_owned();
    let what = format!("joint {name}");
    let end = |tag: &'static str| {
        let lacks = || UrdfError::Lacks { what: what.clone(), lacks: tag };
        let end = child(node, tag).ok_or_else(lacks)?;
        Ok(attribute(end, &what, "link")?.to_owned())
    };
    let kind = attribute(node, &what, "type")?.to_owned();
    let axis = match child(node, "axis") {
        // What does not move has no axis, whatever stands there.
        Some(axis) if kind != "fixed" => triple(axis, &what, "xyz")?,
        _ => Vector3::x(),
    };
    let axis = axis.try_normalize(1e-9).ok_or_else(|| UrdfError::Number {
        what: what.clone(),
        attribute: "xyz",
        written: "0 0 0".to_owned(),
        expected: "a direction",
    })?;
    let limits = match child(node, "limit") {
        Some(limit) if kind == "revolute" => limits(limit, &what)?,
        _ => None,
    };
    let mimic = child(node, "mimic").map(|mimic| {
        let with = attribute(mimic, &what, "joint")?.to_owned();
        let is_stated = mimic.has_attribute("multiplier");
        let turn = |_| true;
        let factor =
            if is_stated { number(mimic, &what, "multiplier", turn, "a number")? } else { 1.0 };
        Ok((with, factor))
    });
    let mimic = mimic.transpose()?;
    let (parent, child) = (end("parent")?, end("child")?);
    Ok(Joint { name, kind, parent, child, origin: origin(node, &what)?, axis, limits, mimic })
}

/// How far a joint turns [rad]; what has no end may be written as the largest of numbers.
fn limits(node: Node<'_, '_>, what: &str) -> Result<Option<[f64; 2]>, UrdfError> {
    /// More turns than a joint is led through [rad].
    const NO_END: f64 = 1e6;
    let endless = |name| {
        let end = node.attribute(name).and_then(|it| it.trim().parse::<f64>().ok());
        end.filter(|it| it.abs() >= NO_END).map(|it| NO_END.copysign(it))
    };
    let end = |name| match endless(name) {
        Some(end) => Ok(end),
        None if node.has_attribute(name) => number(node, what, name, |_| true, "an angle in rad"),
        None => Ok(0.0),
    };
    let is_stated = ["lower", "upper"].iter().any(|name| node.has_attribute(*name));
    Ok(if is_stated { Some([end("lower")?, end("upper")?]) } else { None })
}
