pub mod compare;
pub mod coverage;
pub mod picture;
