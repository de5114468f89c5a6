//! A home as cameras have it before them.

use super::plan::{Origin, Plan};
use crate::body::ground::{Ground, HIGHEST_SUPPORT_M};
use crate::camera::outlook::Outlook;
use crate::camera::scenery::Prism;

/// What cameras see of a home when nobody is there, and what bodies in it rest on.
pub fn outlook(plan: &Plan) -> Outlook {
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
