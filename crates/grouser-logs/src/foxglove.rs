//! The messages of Foxglove that a log has, complete, since readers ask for every field. Source:
//! the schemas of the Foxglove SDK, version 0.30; a test compares names, numbers and types of all
//! fields with the SDK's own.

use grouser_core::units::Vec3;

use crate::protobuf::message::{Fixed32, Keyword, messages};

/// What a message of a log is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// Something that was to be expected, such as the start of a leg.
    #[default]
    Info,
    /// Something to look at, such as a limit at which the rover stopped.
    Warning,
    /// What ended a run before its time.
    Error,
}

impl Keyword for Level {
    const NAME: &'static str = "foxglove.Log.Level";
    const WORDS: &'static [&'static str] =
        &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"];
    const ALL: &'static [(i32, Self)] = &[(2, Self::Info), (3, Self::Warning), (4, Self::Error)];
}

/// What the points of a line stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum LineType {
    /// A line through all of them.
    #[default]
    Strip,
    /// A line for every two.
    List,
}

impl Keyword for LineType {
    const NAME: &'static str = "foxglove.LinePrimitive.Type";
    const WORDS: &'static [&'static str] = &["LINE_STRIP", "LINE_LOOP", "LINE_LIST"];
    const ALL: &'static [(i32, Self)] = &[(0, Self::Strip), (2, Self::List)];
}

/// Which entities go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DeletionType;

impl Keyword for DeletionType {
    const NAME: &'static str = "foxglove.SceneEntityDeletion.Type";
    const WORDS: &'static [&'static str] = &["MATCHING_ID", "ALL"];
    const ALL: &'static [(i32, Self)] = &[(0, Self)];
}

messages! {
    /// A time.
    Timestamp = "google.protobuf.Timestamp" {
        1 seconds: i64,
        2 nanos: i32,
    }

    /// A time between two others.
    Duration = "google.protobuf.Duration" {
        1 seconds: i64,
        2 nanos: i32,
    }

    /// A vector, or a place [m].
    Vector3 = "foxglove.Vector3" {
        1 x: f64,
        2 y: f64,
        3 z: f64,
    }

    /// A place of a line [m].
    Point3 = "foxglove.Point3" {
        1 x: f64,
        2 y: f64,
        3 z: f64,
    }

    /// A rotation.
    Quaternion = "foxglove.Quaternion" {
        1 x: f64,
        2 y: f64,
        3 z: f64,
        4 w: f64,
    }

    /// Where something is, and how it is turned.
    Pose = "foxglove.Pose" {
        1 position: Vector3,
        2 orientation: Quaternion,
    }

    /// Where a frame is in another.
    FrameTransform = "foxglove.FrameTransform" {
        1 timestamp: Timestamp,
        2 parent_frame_id: String,
        3 child_frame_id: String,
        4 translation: Vector3,
        5 rotation: Quaternion,
    }

    /// Where several frames are.
    FrameTransforms = "foxglove.FrameTransforms" {
        1 transforms: Vec<FrameTransform>,
    }

    /// A message of a log.
    Log = "foxglove.Log" {
        1 timestamp: Timestamp,
        2 level: Level,
        3 message: String,
        4 name: String,
        5 file: String,
        6 line: Fixed32,
    }

    /// A colour; each part is between 0 and 1.
    Color = "foxglove.Color" {
        1 r: f64,
        2 g: f64,
        3 b: f64,
        4 a: f64,
    }

    /// What is known of an entity.
    KeyValuePair = "foxglove.KeyValuePair" {
        1 key: String,
        2 value: String,
    }

    /// An arrow along x.
    ArrowPrimitive = "foxglove.ArrowPrimitive" {
        1 pose: Pose,
        2 shaft_length: f64,
        3 shaft_diameter: f64,
        4 head_length: f64,
        5 head_diameter: f64,
        6 color: Color,
    }

    /// A block.
    CubePrimitive = "foxglove.CubePrimitive" {
        1 pose: Pose,
        2 size: Vector3,
        3 color: Color,
    }

    /// An ellipsoid.
    SpherePrimitive = "foxglove.SpherePrimitive" {
        1 pose: Pose,
        2 size: Vector3,
        3 color: Color,
    }

    /// A cylinder about z.
    CylinderPrimitive = "foxglove.CylinderPrimitive" {
        1 pose: Pose,
        2 size: Vector3,
        3 bottom_scale: f64,
        4 top_scale: f64,
        5 color: Color,
    }

    /// Lines.
    LinePrimitive = "foxglove.LinePrimitive" {
        1 r#type: LineType,
        2 pose: Pose,
        3 thickness: f64,
        4 scale_invariant: bool,
        5 points: Vec<Point3>,
        6 color: Color,
        7 colors: Vec<Color>,
        8 indices: Vec<Fixed32>,
    }

    /// Triangles.
    TriangleListPrimitive = "foxglove.TriangleListPrimitive" {
        1 pose: Pose,
        2 points: Vec<Point3>,
        3 color: Color,
        4 colors: Vec<Color>,
        5 indices: Vec<Fixed32>,
    }

    /// A text.
    TextPrimitive = "foxglove.TextPrimitive" {
        1 pose: Pose,
        2 billboard: bool,
        3 font_size: f64,
        4 scale_invariant: bool,
        5 color: Color,
        6 text: String,
    }

    /// A model of a file.
    ModelPrimitive = "foxglove.ModelPrimitive" {
        1 pose: Pose,
        2 scale: Vector3,
        3 color: Color,
        4 override_color: bool,
        5 url: String,
        6 media_type: String,
        7 data: Vec<u8>,
    }

    /// Something in a scene.
    SceneEntity = "foxglove.SceneEntity" {
        1 timestamp: Timestamp,
        2 frame_id: String,
        3 id: String,
        4 lifetime: Duration,
        5 frame_locked: bool,
        6 metadata: Vec<KeyValuePair>,
        7 arrows: Vec<ArrowPrimitive>,
        8 cubes: Vec<CubePrimitive>,
        9 spheres: Vec<SpherePrimitive>,
        10 cylinders: Vec<CylinderPrimitive>,
        11 lines: Vec<LinePrimitive>,
        12 triangles: Vec<TriangleListPrimitive>,
        13 texts: Vec<TextPrimitive>,
        14 models: Vec<ModelPrimitive>,
    }

    /// Removal of an entity from a scene.
    SceneEntityDeletion = "foxglove.SceneEntityDeletion" {
        1 timestamp: Timestamp,
        2 r#type: DeletionType,
        3 id: String,
    }

    /// What comes into a scene and what goes.
    SceneUpdate = "foxglove.SceneUpdate" {
        1 deletions: Vec<SceneEntityDeletion>,
        2 entities: Vec<SceneEntity>,
    }
}

impl Timestamp {
    /// * `nanoseconds`: since the start of the run
    pub(crate) fn of(nanoseconds: u64) -> Self {
        let whole = |count: u64| i64::try_from(count).unwrap_or(i64::MAX);
        let nanos = i32::try_from(nanoseconds % NANO).unwrap_or(0);
        Self { seconds: whole(nanoseconds / NANO), nanos }
    }
}

/// Nanoseconds in a second.
pub(crate) const NANO: u64 = 1_000_000_000;

impl From<Vec3> for Vector3 {
    fn from(vector: Vec3) -> Self {
        Self { x: vector.x, y: vector.y, z: vector.z }
    }
}

impl From<Vec3> for Point3 {
    fn from(vector: Vec3) -> Self {
        Self { x: vector.x, y: vector.y, z: vector.z }
    }
}
