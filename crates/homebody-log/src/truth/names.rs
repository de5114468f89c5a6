//! What the truth calls losses and needs.

use homebody_core::event::{Loss, Need};

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
