//! How a body gets from place to place.
