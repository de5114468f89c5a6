//! The body in three dimensions, as cameras see it.
//!
//! [`figure`] is a body made of capsules, [`joints`] how it holds its limbs, and [`track`] follows a body from what the world
//! tells of it.

pub mod figure;
pub mod ground;
pub mod joints;
mod shares;
pub mod quadruped;
pub mod track;
