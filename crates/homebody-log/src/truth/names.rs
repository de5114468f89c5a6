//! What the truth calls postures, losses and needs.

use homebody_core::event::{Loss, Need};
use homebody_core::scenario::path::Posture;

pub(super) fn posture_name(posture: Posture) -> &'static str {
    match posture {
        Posture::Standing => "standing",
        Posture::Sitting => "sitting",
        Posture::Lying => "lying",
    }
}

pub(super) fn loss_name(loss: Loss) -> &'static str {
    match loss {
        Loss::Radio => "radio",
        Loss::Collision => "collision",
        Loss::Miss => "miss",
        Loss::Battery => "battery",
        Loss::Place => "place",
        Loss::Stuck => "stuck",
        Loss::Garbled => "garbled",
        Loss::Outage => "outage",
    }
}

pub(super) fn need_name(need: Need) -> &'static str {
    match need {
        Need::Toilet => "toilet",
        Need::Thirst => "thirst",
        Need::Hunger => "hunger",
        Need::Tiredness => "tiredness",
    }
}
