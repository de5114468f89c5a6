//! The kinds of places that this build has in crates of their own, by its features.

use homebody_log::elsewhere::{Elsewhere, install};

/// Makes them known, for the whole program: to be called before all else. A second call changes nothing.
pub fn install_all() {
    let all: Vec<Elsewhere> = vec![];
    install(all);
}
