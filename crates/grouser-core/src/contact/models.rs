//! The list of wheel–soil models, and what takes any other.

use std::fmt;
use std::sync::Arc;

use super::bekker::Bekker;
use super::ishigami::Ishigami;
use super::model::WheelSoilModel;
use super::rft::Rft;
use super::small_wheel::SmallWheel;
use crate::soil::Domain;

/// A wheel–soil model that this crate does not know, shared by all that ask it.
#[derive(Clone)]
pub struct OwnModel(Arc<dyn WheelSoilModel>);

impl fmt::Debug for OwnModel {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("OwnModel")
    }
}

/// Equal are those that are one.
impl PartialEq for OwnModel {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl OwnModel {
    /// Shares a model.
    #[must_use]
    pub fn new(model: impl WheelSoilModel + 'static) -> Self {
        Self(Arc::new(model))
    }
}

/// Makes the list of models from their rows: the variant, its name, and what computes it.
macro_rules! models {
    ($($(#[$doc:meta])* $model:ident = $name:literal, $computes:expr;)+) => {
        /// The wheel–soil model of a run, a wheel test or a heading: one of the list, or
        /// [your own](Self::own).
        ///
        /// ```
        /// use grouser_core::contact::Model;
        ///
        /// let names = Model::ALL.map(|model| model.name());
        /// assert_eq!(names, ["ishigami", "bekker", "small-wheel", "rft"]);
        /// ```
        #[derive(Clone, Debug, Default, PartialEq)]
        pub enum Model {
            $($(#[$doc])* $model,)+
            /// Any other. Documents and commands have no name for it.
            Own(OwnModel),
        }

        impl Model {
            /// How many are on the list.
            pub const COUNT: usize = [$($name),+].len();

            /// The list: all that documents and commands have a name for.
            pub const ALL: [Self; Self::COUNT] = [$(Self::$model),+];

            /// Its name in documents and commands; `own` for one that they do not know.
            #[must_use]
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$model => $name,)+
                    Self::Own(_) => "own",
                }
            }
        }

        impl AsRef<dyn WheelSoilModel> for Model {
            fn as_ref(&self) -> &(dyn WheelSoilModel + 'static) {
                match self {
                    $(Self::$model => const { &$computes },)+
                    Self::Own(OwnModel(model)) => model.as_ref(),
                }
            }
        }
    };
}

models! {
    /// The source paper's: stresses along the arc.
    #[default]
    Ishigami = "ishigami", Ishigami::DEFAULT;
    /// Bekker's closed form, as a cross-check.
    Bekker = "bekker", Bekker;
    /// The source paper's with the terms that small wheels need.
    SmallWheel = "small-wheel", SmallWheel::DEFAULT;
    /// Resistive force theory on the wheel's facets, independent of the others.
    Rft = "rft", Rft::DEFAULT;
}

impl Model {
    /// A model of your own.
    #[must_use]
    pub fn own(model: impl WheelSoilModel + 'static) -> Self {
        Self::Own(OwnModel::new(model))
    }

    /// The range in which [the model](WheelSoilModel::domain) holds.
    #[must_use]
    pub fn domain(&self) -> Domain {
        self.as_ref().domain()
    }
}
