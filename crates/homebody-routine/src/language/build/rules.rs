//! Rules and their responses.

use crate::language::builder::Builder;
use crate::language::messages::RuleSentenceMessage;
use crate::language::parts::{Parts, SlotKind};
use crate::language::value::RuleSaid;
use crate::language::words::TextSpan;
use crate::routine::{Circumstance, HabitChance, Response, RoutineRule, RuleTrigger, When};
use homebody_core::fuzzy::Fuzzy;

impl Builder<'_> {
    pub(super) fn rule(&mut self, front: &Parts, rule: &RuleSaid, span: TextSpan) {
        const WHY: &str = "a rule starts each time its first part comes true";
        self.only(front, &[SlotKind::Phase], WHY);
        if rule.trigger == RuleTrigger::Follows && !self.context.has_rules {
            self.fault(rule.trigger_span, RuleSentenceMessage::NoRuleBefore);
        }
        let mut thing = match &rule.trigger {
            RuleTrigger::On(thing) | RuleTrigger::Rings(thing) => Some(thing.clone()),
            _ => None,
        };
        let (mut responses, mut parts) = (Vec::new(), Parts::default());
        for (at, answer) in rule.answers.iter().enumerate() {
            let allowed: &[SlotKind] = match at {
                0 => &[SlotKind::Chance, SlotKind::Lasts, SlotKind::Phase, SlotKind::Place],
                _ => &[SlotKind::Lasts, SlotKind::Place],
            };
            if let Some(measure) = &answer.parts.measure {
                let text = self.said(measure.span);
                self.fault(measure.span, RuleSentenceMessage::ChangeInRule { text });
            }
            self.only(&Parts { measure: None, ..answer.parts.clone() }, allowed, WHY);
            if at == 0 {
                parts = answer.parts.clone();
            }
            let Some(response) = self.response(&answer.response, &answer.parts, &mut thing, answer.span) else {
                return;
            };
            responses.push(response);
        }
        let parts = parts.with_rest_of(front);
        let phase = self.phase(&parts, span);
        let chance = parts.chance.as_ref().map_or(HabitChance::ALWAYS, |slot| slot.value.chance);
        let lasts = rule.lasts.unwrap_or(Fuzzy::exactly(0.0));
        let mut responses = responses.into_iter();
        let Some(response) = responses.next() else { return };
        let only_if: Vec<Circumstance> = rule.only_if.clone();
        let built = RoutineRule {
            said: self.quote(span),
            whenever: rule.trigger.clone(),
            lasts,
            only_if,
            when: When { phase, chance, ..When::default() },
            response,
            then: responses.collect(),
            lapse: rule.lapse,
        };
        self.built.rules.push((built, rule.trigger_span, rule.trigger_span));
    }

    fn response(
        &mut self,
        response: &Response,
        parts: &Parts,
        thing: &mut Option<String>,
        span: TextSpan,
    ) -> Option<Response> {
        let mut named = |name: &str| match name {
            "" => thing.clone(),
            name => {
                *thing = Some(name.to_owned());
                Some(name.to_owned())
            }
        };
        let found = match response {
            Response::Turn { thing, on } => named(thing).map(|thing| Response::Turn { thing, on: *on }),
            Response::Do { activity, place, .. } => {
                let place = match place.as_deref() {
                    Some(place) => Some(named(place)?),
                    None => parts.place.as_ref().map(|slot| slot.value.clone()),
                };
                let lasts = parts.lasts.as_ref().map(|slot| slot.value);
                Some(Response::Do { activity: activity.clone(), place, lasts })
            }
        };
        if found.is_none() {
            self.fault(span, RuleSentenceMessage::WhichThing);
        }
        found
    }
}
