//! What cameras of a home have before them, and what bodies in it rest on.

use super::scenery::Prism;
use crate::body::ground::Ground;

/// What there is to see, and what hides it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outlook {
    /// What hides bodies.
    pub prisms: Vec<Prism>,
    /// What bodies stand, sit and lie on.
    pub ground: Ground,
}
