pub mod coverage;
pub mod picture;
