<<<<<<< HEAD
pub mod compare;
pub mod coverage;
pub mod picture;
pub mod godsey2009;
=======
pub mod sphere;
>>>>>>> scenes
