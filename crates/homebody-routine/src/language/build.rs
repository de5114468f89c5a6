//! The meaning of a statement: habits, changes, rules, facts about the person.

use super::amounts::{ABOUT_SHARE, DAY_S};
use super::builder::{Builder, Built, Context, PersonFact};
use super::changes;
use super::messages::{SentenceMessage, TimeSentenceMessage, WordMessage};
use super::parts::{Parts, Said, Slot, SlotKind};
use super::productions::arguments::said;
use super::sharing::shared;
use super::stays::{Stay, staying};
use super::value::{Act, Clause, SentenceSubject, SpokenStatement, Verb};
use super::words::TextSpan;
use super::{calendar, productions};
use crate::routine::{
    Activity, DaySelection, Falling, FallsFrom, Habit, HabitChance, HabitTime, PartOfDay, Quote, WalkRests, When,
};
use homebody_core::activity::Help;
use homebody_core::fuzzy::{Fuzzy, Quantifier};
use times::spread;

mod falls;
mod rules;
mod times;

pub fn build(context: Context, statement: &SpokenStatement, span: TextSpan) -> Built {
    let mut builder = Builder { context, built: Built::default() };
    match statement {
        SpokenStatement::Heading(_) => {}
        SpokenStatement::Rule(front, rule) => builder.rule(front, rule, span),
        SpokenStatement::Clauses(front, clauses) => match shared(front, clauses) {
            Ok(clauses) => clauses.into_iter().for_each(|clause| builder.clause(clause)),
            Err((span, mut fault)) => {
                if fault.code.ends_with("shared-part") {
                    fault = SentenceMessage::SharedPart { text: said(context.text, span) }.into();
                }
                builder.built.faults.push((span, fault));
            }
        },
    }
    builder.built
}

/// Words of outings with a meal if they last over its time, and names of such places (our choice): at clubs, and with family
/// and friends.
const WORDS_OF_MEALS: [&str; 36] = [
    "meal",
    "lunch",
    "luncheon",
    "dinner",
    "supper",
    "breakfast",
    "restaurant",
    "cafe",
    "café",
    "pub",
    "club",
    "dine",
    "dines",
    "daycare",
    "family",
    "daughter",
    "son",
    "sister",
    "brother",
    "niece",
    "nephew",
    "cousin",
    "grandson",
    "granddaughter",
    "granddaughters",
    "friend",
    "friends",
    "neighbour",
    "neighbor",
    "neighbours",
    "neighbors",
    "verein",
    "gasthaus",
    "mittagessen",
    "abendessen",
    "tagespflege",
];
const PLACES_TO_EAT: [&str; 6] =
    ["day centre", "day center", "day care", "senior centre", "senior center", "seniors' c"];

impl Builder<'_> {
    fn clause(&mut self, mut clause: Clause) {
        if let Some(heading) = self.context.heading {
            clause.parts = std::mem::take(&mut clause.parts).under(heading);
        }
        let is_stay =
            matches!(&clause.verb, Verb::Does(act) if act.activity == Activity::Leave) || clause.verb == Verb::Visits;
        if !is_stay {
            clause.parts = std::mem::take(&mut clause.parts).with_episode();
        }
        if let Some(slot) = &clause.parts.follows {
            let (span, text) = (slot.span, self.said(slot.span));
            let help = "write from which day, such as \"from day 30\"".to_owned();
            self.fault(span, TimeSentenceMessage::OpenTime { text, help });
        }
        if let SentenceSubject::Stranger(name) = &clause.subject
            && !self.introduces(name, &clause)
        {
            return;
        }
        match clause.verb.clone() {
            Verb::Age(age) => self.fact(&clause, PersonFact::Age(age)),
            Verb::Kind(kind) => self.fact(&clause, PersonFact::Kind(kind)),
            Verb::Pace(pace) => self.fact(&clause, PersonFact::Pace(pace)),
            Verb::Rests(after_m) => self.rests(clause, after_m),
            Verb::Sleeps if clause.parts.measure.is_none() && clause.parts.place.is_some() => self.sleeps(clause),
            Verb::Stays(activity) if clause.parts.measure.is_none() => self.stays(clause, activity),
            Verb::Goes => self.only_goes(&clause),
            Verb::Helps(act, help) => self.helps(clause, &act, help),
            Verb::VisitedBy(who) => {
                self.habit(Clause { subject: SentenceSubject::Visitor(who), verb: Verb::Visits, ..clause })
            }
            Verb::Visits | Verb::Own(_) | Verb::Falls(_) => self.habit(clause),
            Verb::Does(_) if clause.parts.measure.is_none() => self.habit(clause),
            _ => changes::change(self, &clause),
        }
    }

    /// Whether the sentence may be about this name.
    fn introduces(&mut self, name: &str, clause: &Clause) -> bool {
        let span = TextSpan { start: clause.span.start, end: clause.verb_span.start };
        let at = self.context.text.get(span.start..span.end).and_then(|text| text.find(name)).unwrap_or(0);
        let span = TextSpan { start: span.start + at, end: span.start + at + name.len() };
        let is_fact = matches!(clause.verb, Verb::Age(_) | Verb::Kind(_) | Verb::Pace(_) | Verb::Rests(_));
        let name = name.to_owned();
        if clause.verb == Verb::Visits {
            self.fault(span, WordMessage::UnknownVisitor { name });
        } else if self.context.is_condition {
            self.fault(span, WordMessage::ConditionName { name });
        } else if let Some(person) = self.context.person {
            let person = person.to_owned();
            let near = homebody_core::nearest::nearest(&name, [person.as_str()]).is_some();
            let help = match near {
                true => homebody_core::problem::Advice::meant(&person),
                false => "each resident has a routine of its own".into(),
            };
            self.fault(span, WordMessage::OtherPerson { person, name, help });
        } else if is_fact {
            self.built.name = Some(name);
            return true;
        } else {
            self.fault(span, WordMessage::UnknownPerson { name });
        }
        false
    }

    fn fact(&mut self, clause: &Clause, fact: PersonFact) {
        let span = clause.verb_span;
        if self.context.is_condition {
            let text = self.said(span);
            return self.fault(span, WordMessage::ConditionFact { text });
        }
        self.only(&clause.parts, &[], "a fact about the person holds at all times");
        self.built.facts.push((fact, span, clause.span));
    }

    fn rests(&mut self, mut clause: Clause, after_m: f64) {
        /// Length of a rest on the way, in seconds (our choice).
        const REST_S: (f64, f64) = (20.0, 40.0);
        let lasts = clause.parts.lasts.take().map_or(Fuzzy::between(REST_S.0, REST_S.1), |slot| slot.value);
        self.fact(&clause, PersonFact::Rests(WalkRests { after_m, lasts }));
    }

    /// "She sleeps in the recliner": by day a nap, by night where her bed is.
    fn sleeps(&mut self, clause: Clause) {
        let is_nap = clause.parts.part.as_ref().is_some_and(|part| part.value != [PartOfDay::Night]);
        let act = |activity| Verb::Does(productions::act_of(activity, clause.verb_span));
        if is_nap {
            return self.habit(Clause { verb: act(Activity::Nap), ..clause });
        }
        let is_every =
            clause.parts.chance.as_ref().is_some_and(|slot| slot.value.chance.quantifier == Some(Quantifier::Every));
        let allowed: &[SlotKind] = if is_every {
            &[SlotKind::Chance, SlotKind::Part, SlotKind::Place]
        } else {
            &[SlotKind::Part, SlotKind::Place]
        };
        let why = "a sleeping place holds for all nights; for some nights, write the bedtime with them, \
                   \"until day 52 she goes to bed in the armchair at 22:30\", and for sleep by day \"naps\"";
        self.only(&clause.parts, allowed, why);
        let parts = Parts { place: clause.parts.place.clone(), ..Parts::default() };
        self.habit(Clause { verb: act(Activity::GoToBed), parts, ..clause });
    }

    /// "She stays in bed until 9:00", "stays up until midnight": until then.
    fn stays(&mut self, mut clause: Clause, activity: Activity) {
        let is_up = activity == Activity::GoToBed;
        let fits = |part: PartOfDay| (part == PartOfDay::Morning) != is_up && part != PartOfDay::Afternoon;
        let part_fits = clause.parts.part.as_ref().is_none_or(|part| part.value.iter().all(|part| fits(*part)));
        let until = clause
            .parts
            .until
            .take()
            .filter(|_| clause.parts.when.is_none() && clause.parts.lasts.is_none() && part_fits);
        let Some(until) = until else {
            if clause.parts.place.is_some() && !is_up {
                return self.sleeps(clause);
            }
            let span = clause.verb_span;
            if self.said(span).ends_with("in bed") && !clause.parts.says_time() {
                // All day.
                let verb = Verb::Not(productions::act_of(activity, span));
                return changes::change(self, &Clause { verb, ..clause });
            }
            return self.fault(span, SentenceMessage::Unfinished);
        };
        clause.parts.when = Some(Slot { value: vec![until.value], span: until.span, own: true });
        self.habit(Clause { verb: Verb::Does(productions::act_of(activity, clause.verb_span)), ..clause });
    }

    fn only_goes(&mut self, clause: &Clause) {
        let text = self.said(clause.verb_span);
        let place = text.rsplit(" the ").next().unwrap_or_default().to_owned();
        let at = if self.context.rooms.iter().any(|room| room.eq_ignore_ascii_case(&place)) { "in" } else { "at" };
        self.fault(clause.verb_span, SentenceMessage::OnlyGoes { text, at, place });
    }

    /// A visitor works during the visit. Getting up and going to bed are habits of their own, at the time of the visit.
    fn helps(&mut self, clause: Clause, act: &Act, help: Help) {
        let before = self.built.habits.len();
        self.habit(Clause { verb: Verb::Visits, ..clause.clone() });
        let is_of_day = matches!(act.activity, Activity::GetUp | Activity::GoToBed) && help == Help::Together;
        for (mut visit, span) in self.built.habits.split_off(before) {
            let nothing_done = |habit: &Habit| Habit { said: Quote::default(), does: Vec::new(), ..habit.clone() };
            // "Does the floors and the bathroom" is one visit.
            let same = self.built.habits.iter().position(|(habit, _)| nothing_done(habit) == nothing_done(&visit));
            if let (false, Some(at)) = (is_of_day, same) {
                let does = &mut self.built.habits[at].0.does;
                does.extend(Some(act.activity.clone()).filter(|activity| !does.contains(activity)));
            } else if !is_of_day {
                visit.does.push(act.activity.clone());
            }
            let helped =
                Habit { activity: act.activity.clone(), visitor: None, key: false, place: None, ..visit.clone() };
            if same.is_none() {
                self.built.habits.push((visit, span));
            }
            if is_of_day && !matches!(helped.when.time, HabitTime::At(_)) {
                self.fault(clause.verb_span, SentenceMessage::WhenHelped);
            } else if is_of_day {
                let when = When { lasts: None, until: None, nights: 0, ..helped.when.clone() };
                self.built.habits.push((Habit { when, ..helped }, clause.verb_span));
            }
        }
    }

    fn habit(&mut self, clause: Clause) {
        let (activity, is_own) = match &clause.verb {
            Verb::Visits => (Activity::Visit, false),
            Verb::Does(act)
                if matches!(act.activity, Activity::Everyday(_))
                    && clause.parts.place.is_some()
                    && clause.parts.lasts.is_some() =>
            {
                let words = self.said(act.span).to_lowercase();
                let words = if words.is_empty() { super::activities::phrase(&act.activity) } else { words };
                (Activity::Other(words), false)
            }
            Verb::Does(act) => (act.activity.clone(), false),
            Verb::Falls(_) => (Activity::Fall, false),
            Verb::Own(words) => (Activity::Other(words.clone()), true),
            _ => return,
        };
        let mut parts = clause.parts.clone();
        let own = match &activity {
            Activity::Other(label) => self.context.lexicon.own.get(label).cloned(),
            _ => None,
        };
        let (is_own, own) = (is_own || own.is_some(), own.unwrap_or_default());
        let place = parts.place.as_ref().map(|slot| slot.value.clone()).or(own.place);
        let says_end = parts.until.is_some()
            || parts.when.as_ref().is_some_and(|slot| slot.value.iter().any(|when| matches!(when, Said::FromTo(..))));
        let usual_lasts = own.minutes.map(|minutes| Fuzzy::around(minutes * 60.0, minutes * 60.0 * ABOUT_SHARE));
        let lasts = parts.lasts.as_ref().map(|slot| slot.value).or(usual_lasts.filter(|_| !says_end));
        if is_own && (place.is_none() || lasts.is_none() && !says_end) {
            return self.lacks_place_or_time(&clause);
        }
        if matches!(activity, Activity::GetUp | Activity::GoToBed) {
            self.once_a_day(&clause);
        }
        self.days_of_a_stay(&activity, &parts);
        if let Some(measure) = &parts.measure {
            let (text, reason) =
                (self.said(measure.span), "the sentence adds an activity, and changes none".to_owned());
            self.fault(measure.span, SentenceMessage::NotAChange { text, reason });
        }
        if activity != Activity::Fall {
            let falls: Vec<TextSpan> =
                parts.slots().into_iter().filter(|(kind, _)| *kind == SlotKind::Fall).map(|(_, span)| span).collect();
            for span in falls {
                let text = self.said(span);
                self.fault(
                    span,
                    SentenceMessage::DoesNotFit { text, reason: "these words describe a fall".to_owned() },
                );
            }
        }
        let is_visit = matches!(clause.subject, SentenceSubject::Visitor(_));
        let eats_out =
            activity == Activity::Leave && matches!(&clause.verb, Verb::Does(act) if self.names_a_meal(act.span));
        if let Some(key) = parts.key.as_ref().filter(|_| !is_visit) {
            let text = self.said(key.span);
            let reason = "only a visitor comes with a key".to_owned();
            self.fault(key.span, SentenceMessage::DoesNotFit { text, reason });
        }
        self.place_without_effect(&activity, &parts);
        self.thing_meanwhile(&activity, is_visit, &parts);
        if let Some(slot) =
            parts.poor_nights.as_ref().filter(|_| matches!(activity, Activity::GetUp | Activity::GoToBed))
        {
            let text = self.said(slot.span);
            let reason = "the times of rising and going to bed do not depend on the night before".to_owned();
            self.fault(slot.span, SentenceMessage::DoesNotFit { text, reason });
        }
        let nights = self.nights(&activity, &mut parts);
        let is_fall = activity == Activity::Fall;
        let falling = self.falling(&clause, &activity, &mut parts);
        let phase = self.phase(&parts, clause.span);
        let stay = staying(self, &clause, &activity, &parts, &phase);
        let times = parts.times.as_ref().map_or((1, 1), |slot| slot.value);
        let whens: Vec<(Option<Said>, Parts)> = spread(&parts);
        let count = whens.len() as u32;
        // "Twice: in the morning and in the evening" is once in each.
        let times = if count > 1 && times == (count, count) { (1, 1) } else { times };
        let chance = self.chance(&parts);
        for (when, parts) in whens {
            let (when, until) = self.time(when.as_ref(), &parts, &activity);
            self.check_times(&parts, &when);
            if when == HabitTime::Then && !self.context.has_habits && self.built.habits.is_empty() {
                let span = parts.when.as_ref().map_or(clause.span, |slot| slot.span);
                self.fault(span, SentenceMessage::NothingBeforeThen);
            }
            if let (Some(lasts), false) = (&parts.lasts, matches!(activity, Activity::Leave | Activity::Visit))
                && lasts.own
                && lasts.value.from > DAY_S
            {
                let text = self.said(lasts.span);
                self.fault(lasts.span, TimeSentenceMessage::LongerThanADay { text });
            }
            let inherited_then = when == HabitTime::Then && parts.chance.as_ref().is_some_and(|chance| !chance.own);
            let (when, phase, stays) = match &stay {
                Some(Stay { when, phase, lasts }) => (when.clone(), *phase, Some(*lasts)),
                None => (when, phase, None),
            };
            let when = match falling {
                Some(Falling { mostly: Some(_), .. }) => HabitTime::AnyTime,
                Some(Falling { from: FallsFrom::Bed, .. }) if when == HabitTime::AnyTime => {
                    HabitTime::Within(PartOfDay::Night)
                }
                _ => when,
            };
            let habit = Habit {
                said: self.quote(clause.span),
                visitor: match &clause.subject {
                    SentenceSubject::Visitor(name) => Some(name.clone()),
                    _ => None,
                },
                activity: activity.clone(),
                place: place.clone().filter(|_| parts.place.is_some() || !is_fall),
                when: When {
                    chance: if inherited_then { HabitChance::ALWAYS } else { chance },
                    days: parts.days(),
                    phase,
                    time: when,
                    lasts: stays.or(lasts),
                    until,
                    times,
                    nights,
                    is_total: parts.total.is_some(),
                },
                eats_out: !is_visit && eats_out,
                thing_on: parts.thing_on.as_ref().map(|slot| slot.value.clone()),
                key: parts.key.is_some(),
                does: Vec::new(),
                falling,
            };
            self.built.habits.push((habit, clause.verb_span));
        }
    }

    /// Whether the words of an outing name a meal, or a place where people eat.
    fn names_a_meal(&self, span: TextSpan) -> bool {
        let said = self.said(span).to_lowercase();
        let mut words = said.split(|c: char| !c.is_alphanumeric());
        PLACES_TO_EAT.iter().any(|place| said.contains(place)) || words.any(|word| WORDS_OF_MEALS.contains(&word))
    }

    /// A visit, an outing, rising, lying awake and wandering keep to no stated place.
    fn place_without_effect(&mut self, activity: &Activity, parts: &Parts) {
        use Activity::{ComeHome, GetUp, Lap, Leave, LieAwake, Pace, Visit, Wander};
        let Some(slot) = &parts.place else { return };
        if matches!(activity, ComeHome | GetUp | Lap | Leave | LieAwake | Pace | Visit | Wander) {
            let text = self.said(slot.span);
            let reason = "this activity keeps to no stated place; leave out these words".to_owned();
            self.fault(slot.span, SentenceMessage::DoesNotFit { text, reason });
        }
    }

    /// Something can be on during what the person does at home.
    fn thing_meanwhile(&mut self, activity: &Activity, is_visit: bool, parts: &Parts) {
        use Activity::{ComeHome, Fall, GetUp, GoToBed, Leave, Stumble};
        let Some(slot) = &parts.thing_on else { return };
        if is_visit || matches!(activity, ComeHome | Fall | GetUp | GoToBed | Leave | Stumble) {
            let text = self.said(slot.span);
            let reason =
                "a thing is on during what she does at home; write \"leaves the television on from 20:00 until 22:00\"";
            self.fault(slot.span, SentenceMessage::DoesNotFit { text, reason: reason.to_owned() });
        }
    }

    /// The nights of a visit or an absence. Other activities happen on so many days. With a first day alone, it happens once.
    fn nights(&mut self, activity: &Activity, parts: &mut Parts) -> u32 {
        let Some(slot) = parts.nights.take() else { return 0 };
        if !matches!(activity, Activity::Leave | Activity::Visit) {
            parts.for_days = Some(Slot { value: slot.value.into(), span: slot.span, own: slot.own });
            return 0;
        }
        let is_often = parts.chance.is_some() || parts.days() != DaySelection::ALL;
        match &parts.from {
            Some(from) if !is_often && parts.until_day.is_none() => {
                parts.until_day = Some(Slot { value: calendar::later(from.value, 1), span: slot.span, own: slot.own });
            }
            None if !is_often => {
                let (text, stays) =
                    (self.said(slot.span), if *activity == Activity::Visit { "visits" } else { "is away" });
                let help = format!("write \"from day 30, she {stays} {text}\", or on which days");
                self.fault(slot.span, TimeSentenceMessage::NoBeginning { help });
            }
            _ => {}
        }
        slot.value
    }

    /// "Visits her sister from Friday to Sunday" may be one stay, or a visit on each of these days.
    fn days_of_a_stay(&mut self, activity: &Activity, parts: &Parts) {
        let Some(days) = parts.weekdays.as_ref().filter(|slot| slot.own) else { return };
        let is_open = parts.when.is_none() && parts.lasts.is_none() && parts.until.is_none() && parts.chance.is_none();
        if matches!(activity, Activity::Leave | Activity::Visit)
            && is_open
            && self.said(days.span).to_lowercase().starts_with("from ")
        {
            let (text, span) = (self.said(days.span), days.span);
            let reason = "it can be one stay or one on each day; name the days, \"on Friday, Saturday and Sunday\", or the length, \"on Friday for 2 days\"";
            self.fault(span, SentenceMessage::DoesNotFit { text, reason: reason.to_owned() });
        }
    }

    /// The probability; a rate, such as once a month, is shared by the days that the sentence names.
    fn chance(&mut self, parts: &Parts) -> HabitChance {
        let Some(slot) = &parts.chance else { return HabitChance::ALWAYS };
        let mut chance = slot.value.chance;
        if slot.value.is_rate && parts.weekdays.is_some() {
            let days = f64::from(parts.days().weekdays.count_ones().max(1));
            chance.probability *= 7.0 / days;
            chance.days_a_week = chance.days_a_week.filter(|count| f64::from(*count) < days);
            // A float may be a little above one.
            if chance.probability > 1.0 + 1e-9 {
                let text = self.said(slot.span);
                self.fault(slot.span, TimeSentenceMessage::OftenerThanDaily { text });
            }
            chance.probability = chance.probability.min(1.0);
            if chance.probability >= 1.0 {
                chance = HabitChance { becomes: chance.becomes, ..HabitChance::ALWAYS };
            }
        }
        chance
    }

    fn lacks_place_or_time(&mut self, clause: &Clause) {
        let span = clause.verb_span;
        let words = self.said(span).to_lowercase();
        let place =
            clause.parts.place.as_ref().map_or_else(|| "in the armchair".to_owned(), |slot| self.said(slot.span));
        let lasts =
            clause.parts.lasts.as_ref().map_or_else(|| "for 20 minutes".to_owned(), |slot| self.said(slot.span));
        let help = format!("a new activity needs a place and a duration: \"she {words} {place} {lasts}\"");
        self.fault(span, WordMessage::UnknownVerb { text: words, help: Some(help.into()) });
    }

    fn once_a_day(&mut self, clause: &Clause) {
        let at_night = clause.parts.part.as_ref().filter(|part| part.value == [PartOfDay::Night]);
        let gets_up = matches!(&clause.verb, Verb::Does(act) if act.activity == Activity::GetUp);
        let span = clause.parts.times.as_ref().filter(|times| times.value != (1, 1)).map(|times| times.span);
        if let Some(span) = span.or(at_night.filter(|_| gets_up).map(|part| part.span)) {
            let text = self.said(span);
            self.fault(span, SentenceMessage::OnceADay { text });
        }
    }
}
