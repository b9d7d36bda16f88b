//! Files of kinds that are not read here, by how they begin.

/// A kind of log, or of table, that is known and not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct OtherKind {
    /// What it is, with its article.
    pub name: &'static str,
    /// A line of Python that makes Parquet of a table `LOG`; none for what is no table.
    pub to_parquet: Option<&'static str>,
}

const FEATHER: &str = "import pandas; pandas.read_feather('LOG').to_parquet('drive.parquet')";

impl OtherKind {
    /// A bag of ROS 2.
    pub(super) const ROS_2: Self = Self::of("a bag of ROS 2 in SQLite", None);

    const fn of(name: &'static str, to_parquet: Option<&'static str>) -> Self {
        Self { name, to_parquet }
    }

    /// What a file is that begins so, if it is one of these.
    pub(super) fn beginning_with(start: &[u8]) -> Option<Self> {
        let all: [(&[u8], Self); 3] = [
            (b"#ROSBAG V", Self::of("a bag of ROS 1", None)),
            (b"SQLite format 3", Self::ROS_2),
            (b"FEA1", Self::of("a file of Feather, version 1", Some(FEATHER))),
        ];
        all.into_iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, kind)| kind)
    }
}
