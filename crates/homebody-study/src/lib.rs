pub mod compare;
pub mod coverage;
pub mod godsey2009;
pub mod picture;
pub mod sphere;
