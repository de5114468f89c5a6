//! The details of falls.

use crate::language::builder::Builder;
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::{Chance, Parts, Slot};
use crate::language::productions::arguments::said;
use crate::language::value::{Clause, Verb};
use crate::routine::{Activity, FallEnds, Falling, FallsFrom};

impl Builder<'_> {
    /// The details of a fall.
    pub(super) fn falling(&mut self, clause: &Clause, activity: &Activity, parts: &mut Parts) -> Option<Falling> {
        if *activity != Activity::Fall {
            return None;
        }
        let mut falling = match clause.verb {
            Verb::Falls(falling) => falling,
            _ => Falling::default(),
        };
        if let Some(slot) = &parts.fall_from {
            falling.from = slot.value;
        }
        falling.slowly |= parts.slowly.is_some();
        if let Some(Slot { value: (ends, finder), span, .. }) = &parts.fall_ends {
            falling.ends = *ends;
            if let (FallEnds::Found, Some(name)) = (ends, finder) {
                self.built.finders.push((name.clone(), *span));
            }
        }
        falling.mostly = parts.mostly.as_ref().map(|slot| slot.value);
        // "She usually falls at night" is when it mostly is, and not how often.
        let text = self.context.text;
        let is_mostly = |slot: &Slot<Chance>| {
            ["mostly", "usually", "normally"].contains(&said(text, slot.span).to_lowercase().as_str())
        };
        if falling.mostly.is_none()
            && parts.chance.as_ref().is_some_and(is_mostly)
            && let Some(part) = parts.part.as_ref().filter(|slot| slot.own).map(|slot| slot.value[0])
        {
            falling.mostly = Some(part);
            (parts.chance, parts.part) = (None, None);
        }
        let time = parts.when.as_ref().map(|slot| slot.span).or(parts.part.as_ref().map(|slot| slot.span));
        if let (Some(_), Some(span)) = (falling.mostly, time) {
            let text = self.said(span);
            self.fault(span, TimeSentenceMessage::TwoTimesOfFall { text });
        }
        // "She falls in bed": out of it.
        let in_bed = parts.place.as_ref().is_some_and(|slot| {
            slot.value.eq_ignore_ascii_case("bed") && self.said(slot.span).to_lowercase().starts_with("in ")
        });
        if in_bed {
            falling.from = FallsFrom::Bed;
            parts.place = None;
        }
        Some(falling)
    }
}
