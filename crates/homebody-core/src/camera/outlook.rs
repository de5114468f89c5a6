//! The things in view of a home's cameras, and the surfaces that its bodies rest on.

use super::scenery::Prism;
use crate::body::ground::Ground;
use crate::body::ground::HIGHEST_SUPPORT_M;
use crate::plan::{Origin, Plan};

/// The surroundings of a camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outlook {
    /// The obstacles to the view of bodies.
    pub prisms: Vec<Prism>,
    /// The surfaces that bodies stand, sit and lie on.
    pub ground: Ground,
}

impl Outlook {
    /// The view of an empty home, and the surfaces that its bodies rest on.
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
