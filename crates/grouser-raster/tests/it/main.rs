//! What is read from files, and how files that are none are refused.

mod damage;
mod geotiff;
mod ground;
mod npy;
mod xyz;
mod zones;

#[path = "../../../grouser-core/examples/by_hand/hakuto.rs"]
#[allow(dead_code, unused_imports, reason = "of the rover only its sand is needed here")]
mod hakuto;
