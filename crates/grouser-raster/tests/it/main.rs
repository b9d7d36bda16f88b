//! What is read from files, and how files that are none are refused.

mod damage;
mod geotiff;
mod ground;
mod npy;
mod xyz;
mod zones;
