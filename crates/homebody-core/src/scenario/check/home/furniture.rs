//! Furniture: one form each, convex, in the home.

use super::Report;
use super::areas::{check_convex, keeps_within};
use crate::home::plan::{Plan, furniture_outline};
use crate::scenario::home::HomeFile;
use crate::scenario::path::Posture;

/// Checks each piece by itself; says whether all have an outline.
pub fn check_shapes(report: &mut Report, home: &HomeFile) -> bool {
    let before = report.count();
    for (index, piece) in home.furniture.iter().enumerate() {
        let (place, name) = (format!("/furniture/{index}"), &piece.name);
        let hint = "give either \"at\" and \"size_m\", or an \"outline\"";
        match (piece.at.is_some(), piece.size_m.is_some(), piece.outline.is_some()) {
            (true, true, false) => {}
            (false, false, true) => {
                check_convex(report, &format!("{place}/outline"), &furniture_outline(piece), &format!("{name:?}"));
            }
            (true, false, false) => report.hinted(&place, format!("{name:?} has a place but no size"), hint),
            (false, true, false) => report.hinted(&place, format!("{name:?} has a size but no place"), hint),
            (false, false, false) => report.hinted(&place, format!("{name:?} has neither place nor outline"), hint),
            (_, _, true) => report.hinted(&format!("{place}/outline"), format!("{name:?} is given in two forms"), hint),
        }
    }
    report.count() == before
}

/// What somebody lies in has to be enterable.
pub fn check_roles(report: &mut Report, home: &HomeFile) {
    for (index, piece) in home.furniture.iter().enumerate() {
        let is_lain_in = piece.role.is_some_and(|role| role.row().posture == Some(Posture::Lying));
        if is_lain_in && !piece.enterable {
            let hint = "say of it \"enterable\": true, or give the role to another piece";
            report.hinted(&format!("/furniture/{index}/role"), format!("nobody can lie in {:?}", piece.name), hint);
        }
    }
}

pub fn check_within(report: &mut Report, home: &HomeFile, plan: &Plan) {
    for (index, piece) in home.furniture.iter().enumerate() {
        if !keeps_within(plan, &furniture_outline(piece)) {
            let form = if piece.outline.is_some() { "outline" } else { "at" };
            report.add(&format!("/furniture/{index}/{form}"), format!("{:?} reaches out of the home", piece.name));
        }
    }
}
