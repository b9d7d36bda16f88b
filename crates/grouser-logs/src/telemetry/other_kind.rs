//! Files of kinds that are not read here, by how they begin.

/// A kind of log, or of table, that is known and not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OtherKind {
    /// A bag of ROS 1.
    Ros1Bag,
    /// A bag of ROS 2 in SQLite.
    Ros2Bag,
    /// A file of Arrow, which is version 2 of Feather.
    Arrow,
    /// A stream of Arrow, in a file.
    ArrowStream,
    /// Version 1 of Feather.
    Feather1,
}

impl OtherKind {
    /// What a file is that begins so, if it is one of these.
    pub(super) fn of(start: &[u8]) -> Option<Self> {
        /// What each message of a stream of Arrow begins with, before its length. Source: Arrow,
        /// *Serialization and Interprocess Communication*.
        const CONTINUATION: [u8; 4] = [0xff; 4];
        let magics: [(&[u8], Self); 5] = [
            (b"#ROSBAG V", Self::Ros1Bag),
            (b"SQLite format 3", Self::Ros2Bag),
            (b"ARROW1", Self::Arrow),
            (&CONTINUATION, Self::ArrowStream),
            (b"FEA1", Self::Feather1),
        ];
        magics.into_iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, kind)| kind)
    }

    /// What it is, with its article.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ros1Bag => "a bag of ROS 1",
            Self::Ros2Bag => "a bag of ROS 2 in SQLite",
            Self::Arrow => "a file of Arrow (Feather)",
            Self::ArrowStream => "a stream of Arrow",
            Self::Feather1 => "a file of Feather, version 1",
        }
    }

    /// A line of Python that makes Parquet of a table `LOG`; none for what is no table.
    #[must_use]
    pub const fn to_parquet(self) -> Option<&'static str> {
        match self {
            Self::Ros1Bag | Self::Ros2Bag => None,
            Self::Arrow | Self::Feather1 => {
                Some("import pandas; pandas.read_feather('LOG').to_parquet('drive.parquet')")
            }
            Self::ArrowStream => Some(
                "import pyarrow; pyarrow.ipc.open_stream(open('LOG', \
                 'rb')).read_pandas().to_parquet('drive.parquet')",
            ),
        }
    }
}
