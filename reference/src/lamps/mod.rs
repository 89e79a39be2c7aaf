//! Direct light of lamps that have a closed form, without any reflection.

pub mod ball;
pub mod disc;
pub mod patch;
pub mod point;
pub mod strip;
pub mod table;
pub mod tube;
