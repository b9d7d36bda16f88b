//! The server, over real sockets.

mod access;
mod answers;
mod folder;
mod limits;
mod load;
mod map;
mod served;
