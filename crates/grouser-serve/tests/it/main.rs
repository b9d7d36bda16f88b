//! The server, over real sockets.

mod access;
mod answers;
mod campaign;
mod card;
mod design;
mod drive_kinds;
mod drive_step;
mod fit;
mod folder;
mod limits;
mod load;
mod map;
mod mission;
mod scene;
mod served;
