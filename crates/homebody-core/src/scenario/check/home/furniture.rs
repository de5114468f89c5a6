//! Furniture: one form each, convex, in the home.

use super::ProblemReport;
use super::areas::{check_convex, keeps_within};
use super::messages::HomeMessage;
use crate::home::form::HomeFile;
use crate::plan::{Plan, furniture_outline};
use crate::posture::Posture;

/// Checks each piece by itself; says whether all have an outline.
pub fn check_shapes(report: &mut ProblemReport, home: &HomeFile) -> bool {
    let before = report.count();
    for (index, piece) in home.furniture.iter().enumerate() {
        let (place, name) = (format!("/furniture/{index}"), &piece.name);
        let without = |missing| HomeMessage::IncompleteForm { name: name.clone(), missing };
        match (piece.at.is_some(), piece.size_m.is_some(), piece.outline.is_some()) {
            (true, true, false) => {}
            (false, false, true) => {
                check_convex(report, &format!("{place}/outline"), &furniture_outline(piece), &format!("{name:?}"));
            }
            (true, false, false) => report.add(&place, without("size")),
            (false, true, false) => report.add(&place, without("place")),
            (false, false, false) => report.add(&place, without("place and no outline")),
            (_, _, true) => {
                report.add(&format!("{place}/outline"), HomeMessage::TwoForms { name: name.clone() });
            }
        }
    }
    report.count() == before
}

/// Furniture to lie in has to be enterable.
pub fn check_roles(report: &mut ProblemReport, home: &HomeFile) {
    for (index, piece) in home.furniture.iter().enumerate() {
        let is_lain_in = piece.role.is_some_and(|role| role.row().posture == Some(Posture::Lying));
        if is_lain_in && !piece.enterable {
            report.add(&format!("/furniture/{index}/role"), HomeMessage::CannotLie { name: piece.name.clone() });
        }
    }
}

pub fn check_within(report: &mut ProblemReport, home: &HomeFile, plan: &Plan) {
    for (index, piece) in home.furniture.iter().enumerate() {
        if !keeps_within(plan, &furniture_outline(piece)) {
            let form = if piece.outline.is_some() { "outline" } else { "at" };
            let what = format!("{:?}", piece.name);
            report.add(&format!("/furniture/{index}/{form}"), HomeMessage::ReachesOut { what });
        }
    }
}
