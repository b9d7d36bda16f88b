//! What is read from files, and how invalid files are refused.

mod damage;
mod geotiff;
mod ground;
mod meaning;
mod npy;
mod xyz;
mod zones;
