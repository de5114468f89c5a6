//! What cameras of a home have before them, and what bodies in it rest on.

use super::scenery::Prism;
use crate::body::ground::Ground;
use crate::body::ground::HIGHEST_SUPPORT_M;
use crate::plan::{Origin, Plan};

/// What there is to see, and what hides it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outlook {
    /// What hides bodies.
    pub prisms: Vec<Prism>,
    /// What bodies stand, sit and lie on.
    pub ground: Ground,
}

impl Outlook {
    /// What cameras see of a home when nobody is there, and what bodies in it rest on.
    pub fn new(plan: &Plan) -> Outlook {
        let mut outlook = Outlook { prisms: Vec::new(), ground: Ground::floor() };
        for solid in &plan.solids {
            let outline = solid.outline.clone();
            let is_seat = matches!(solid.origin, Origin::Furniture(_)) && !solid.stops_bodies;
            let height_m = if is_seat { solid.height_m.min(HIGHEST_SUPPORT_M) } else { solid.height_m };
            outlook.prisms.push(Prism { outline: outline.clone(), height_m });
            outlook.ground = match is_seat {
                true => outlook.ground.and_support(outline, solid.height_m),
                false => outlook.ground.and_obstacle(outline),
            };
        }
        outlook
    }
}
