//! Drawn rules, measured by their occasions in the truth.

use super::bounds::count_bounds;
use super::deeds::Deed;
use super::field::{FieldResult, LifeView, MINUTE, containing, minutes};
use super::homes::LifeContext;
use super::homes::{DrawnHome, clock};
use super::numbers::Draw;
use crate::claims::{Occurrence, Subject};
use homebody_core::activity::{
    AWAY, CARING_FOR_PLANTS, CHECKING_HEALTH, DRINKING, EATING_BREAKFAST, EATING_LUNCH, EXERCISING, GETTING_UP,
    GOING_TO_BED, HAVING_A_SNACK, MAKING_MUSIC, PACING, PRAYING, USING_BATHROOM, WRITING,
};
use homebody_core::time::{HOUR, Interval, RunTime, Span};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnTrigger {
    /// For minutes.
    Doing(&'static str, f64),
    Done(&'static str),
    /// Minute of the day.
    Clock(f64),
    Company(&'static str),
    /// For minutes, after a visit.
    AloneAfter(&'static str, f64),
    Sitting(f64),
    /// For minutes, in a room.
    In(&'static str, f64),
    Out(f64),
    InBed(f64),
    On(&'static str, f64),
    Dark,
    /// The rule before has been answered with this.
    Follows(&'static str),
}

#[derive(Clone, Debug, PartialEq)]
pub struct DrawnRule {
    pub kind: &'static str,
    words: String,
    pub carriers: Vec<String>,
    pub about: Vec<&'static str>,
    pub trigger: DrawnTrigger,
    /// Of the answer, if it is an activity.
    answer: Option<Deed>,
    length_min: f64,
    chance: f64,
    /// No answer after this minute of the day.
    until_min: Option<f64>,
    /// The first day with it.
    from: i32,
}

const fn answer(words: &'static str, label: &'static str) -> Deed {
    Deed { words, label, background: super::deeds::Background::Nothing, goes_anywhere: false, usual_min: 10.0 }
}

const ANSWERS: [Deed; 5] = [
    answer("prays", PRAYING),
    answer("plays the piano", MAKING_MUSIC),
    answer("waters her plants", CARING_FOR_PLANTS),
    answer("checks her blood pressure", CHECKING_HEALTH),
    answer("writes letters", WRITING),
];

/// Largest delay of an answer in minutes (our choice): the walk, and the end of what cannot be interrupted.
const ANSWERED_MIN: f64 = 10.0;

/// Longest pause of one occurrence (our choice).
const PAUSE: Span = HOUR.times(2);

/// A tenth of six hours, and time to finish what cannot be interrupted (our choice).
const IN_BED_SPREAD: Span = MINUTE.times(56);

/// Time that needs take in the middle of an answer, in minutes (our choice).
const NEEDS_MIN: f64 = 20.0;

impl DrawnRule {
    pub fn draw(draw: &mut Draw, context: &LifeContext) -> DrawnRule {
        use DrawnTrigger as Trigger;
        let deed = ANSWERS[draw.below(ANSWERS.len() as u32) as usize];
        let length_min = 5.0 * f64::from(1 + draw.below(4));
        let wait = 10.0 * f64::from(1 + draw.below(3));
        let (kind, state, carriers, about, trigger): (_, String, Vec<&str>, Vec<&'static str>, Trigger) = match draw
            .below(13)
        {
            0 => (
                "doing",
                format!("she has been exercising for {wait} minutes"),
                vec!["she exercises at 10:00 for 40 minutes."],
                vec![EXERCISING],
                Trigger::Doing(EXERCISING, wait),
            ),
            1 => (
                "doing",
                "she is exercising".into(),
                vec!["she exercises at 10:00 for 20 minutes."],
                vec![EXERCISING],
                Trigger::Doing(EXERCISING, 0.0),
            ),
            2 => ("done", "she has eaten lunch".into(), vec![], vec![EATING_LUNCH], Trigger::Done(EATING_LUNCH)),
            3 => (
                "done",
                "she has eaten breakfast".into(),
                vec![],
                vec![EATING_BREAKFAST],
                Trigger::Done(EATING_BREAKFAST),
            ),
            4 => {
                let minute = 5.0
                    * (draw.between(context.base.up_min + 60.0, context.base.bed_min - 60.0).min(1400.0) / 5.0).round();
                ("a time", format!("it is {}", clock(minute)), vec![], vec![], Trigger::Clock(minute))
            }
            5 => (
                "company",
                "her cousin comes".into(),
                vec!["her cousin visits on Wednesday and Saturday at 15:00 for 1 hour."],
                vec!["cousin"],
                Trigger::Company("cousin"),
            ),
            6 if !context.home.has_two() && !context.base.about.contains(&"neighbour") => (
                "being alone",
                format!("she has been alone for {wait} minutes"),
                vec!["her cousin visits on Wednesday and Saturday at 15:00 for 1 hour."],
                vec!["cousin"],
                Trigger::AloneAfter("cousin", wait),
            ),
            7 => ("sitting", "she has been sitting for an hour".into(), vec![], vec![], Trigger::Sitting(60.0)),
            8 => (
                "a place",
                "she has been in the bathroom for 20 minutes".into(),
                vec![],
                vec!["bathroom"],
                Trigger::In("bathroom", 20.0),
            ),
            9 => (
                "being out",
                "she has been out for 1 hour".into(),
                vec!["she goes out at 14:00 for 3 hours."],
                vec![AWAY],
                Trigger::Out(60.0),
            ),
            10 => (
                "being in bed",
                "she has been in bed for 6 hours".into(),
                vec![],
                vec![GETTING_UP, GOING_TO_BED],
                Trigger::InBed(360.0),
            ),
            11 if !context.home.has_two() => (
                "a thing",
                "the stove has been on for 30 minutes".into(),
                vec!["she forgets the stove on 100 % of occasions."],
                vec!["stove"],
                Trigger::On("stove", 30.0),
            ),
            _ => ("darkness", "it gets dark".into(), vec![], vec![], Trigger::Dark),
        };
        let (mut chance, mut until_min, mut from) = (1.0, None, 0);
        let mut rule = match trigger {
            Trigger::InBed(_) => "she gets up".to_owned(),
            Trigger::On(..) => "she turns it off".to_owned(),
            Trigger::Out(_) | Trigger::In(..) => "she rests in the armchair for 30 minutes".to_owned(),
            _ => match draw.below(4) {
                0 => {
                    chance = 0.7;
                    format!("she often {} for {length_min} minutes", deed.words)
                }
                1 => {
                    until_min = Some(1200.0);
                    format!("she {} for {length_min} minutes, unless it is after 20:00", deed.words)
                }
                2 => {
                    chance = 0.3;
                    format!("she {} for {length_min} minutes, but she often forgets it", deed.words)
                }
                _ => format!("she {} for {length_min} minutes", deed.words),
            },
        };
        let is_activity = !matches!(trigger, Trigger::InBed(_) | Trigger::On(..) | Trigger::Out(_) | Trigger::In(..));
        let (mut about, mut kind, mut trigger) = (about, kind, trigger);
        let mut of = deed;
        if is_activity && chance == 1.0 && until_min.is_none() && draw.one_in(4) {
            rule = format!("{rule}. Whenever she has done so, she paces for 5 minutes");
            about.push(deed.label);
            (kind, trigger) = ("the answer of another", Trigger::Follows(deed.label));
            of = answer("paces", PACING);
        }
        let start = if draw.one_in(4) {
            from = context.days / 3;
            format!("From day {}, whenever", from + 1)
        } else {
            "Whenever".to_owned()
        };
        if is_activity {
            about.push(of.label);
        }
        let length_min = if kind == "the answer of another" { 5.0 } else { length_min };
        DrawnRule {
            kind,
            words: format!("{start} {state}, {rule}."),
            carriers: carriers.into_iter().map(|carrier| context.base.in_its_morning(carrier)).collect(),
            about,
            trigger,
            answer: is_activity.then_some(of),
            length_min,
            chance,
            until_min,
            from,
        }
    }

    pub fn words(&self, home: &DrawnHome) -> String {
        home.of_person(&self.words)
    }

    /// When the rule is due.
    fn occasions(&self, view: &LifeView) -> Vec<RunTime> {
        use DrawnTrigger as Trigger;
        let wait = |minutes: f64| Span::from_seconds(minutes * 60.0);
        let lasting = |all: Vec<Occurrence>, least: f64| {
            all.into_iter()
                // "For an hour" is give or take a tenth.
                .filter(|one| minutes(one.time.length()) > 1.1 * least + 1.0)
                .map(|one| one.time.begin + wait(least))
                .collect()
        };
        match self.trigger {
            Trigger::Doing(label, least) => {
                // An activity that the answer or a meal interrupts stays the same activity.
                let mut all: Vec<Occurrence> = Vec::new();
                for one in view.labelled(label) {
                    match all.last_mut().filter(|last| one.time.begin - last.time.end < PAUSE) {
                        Some(last) => last.time.end = one.time.end,
                        None => all.push(one),
                    }
                }
                lasting(all, least)
            }
            Trigger::Done(label) | Trigger::Follows(label) => {
                view.labelled(label).iter().map(|one| one.time.end).collect()
            }
            Trigger::Clock(minute) => (0..view.days - 1).map(|day| view.at(day, minute)).collect(),
            Trigger::Company(who) => view.stays(who).unwrap_or_default().iter().map(|one| one.time.begin).collect(),
            Trigger::AloneAfter(who, least) => {
                view.stays(who).unwrap_or_default().iter().map(|one| one.time.end + wait(least)).collect()
            }
            Trigger::Sitting(least) => lasting(view.life.sitting(view.who), least),
            Trigger::In(room, least) => lasting(view.life.spans(view.who, &Subject::Room(room.to_owned())), least),
            Trigger::Out(least) => lasting(view.labelled(AWAY), least),
            Trigger::InBed(least) => {
                view.labelled(GOING_TO_BED).iter().map(|one| one.time.begin + wait(least)).collect()
            }
            Trigger::On(..) | Trigger::Dark => Vec::new(),
        }
    }

    pub fn judge(&self, view: &LifeView) -> Vec<FieldResult> {
        use DrawnTrigger as Trigger;
        let end = view.at(view.days - 1, 0.0);
        let is_counted = |at: &RunTime| {
            let day = view.life.day_of(*at);
            day >= self.from + i32::from(self.from > 0) && *at < end && !view.is_excused(view.day_of(*at))
        };
        let out = view.labelled(AWAY);
        // Nobody answers while out.
        let is_home = |at: &RunTime| containing(&out, *at).is_none();
        let occasions: Vec<RunTime> = self.occasions(view).into_iter().filter(is_counted).filter(is_home).collect();
        let mut fields = Vec::new();
        match self.trigger {
            Trigger::On(_, least) | Trigger::Out(least) | Trigger::In(_, least) => {
                let (all, over) = match self.trigger {
                    Trigger::On(thing, _) => (view.life.spans(view.who, &Subject::Thing(thing.to_owned())), "off"),
                    Trigger::In(room, _) => (view.life.spans(view.who, &Subject::Room(room.to_owned())), "over"),
                    _ => (view.labelled(AWAY), "over"),
                };
                let case = |one: &Occurrence| {
                    let lasted = minutes(one.time.length());
                    let words = format!("{} min from {}", lasted.round(), view.clock(one.time.begin));
                    (lasted <= least + ANSWERED_MIN, words)
                };
                let cases: Vec<_> = all.iter().filter(|one| is_counted(&one.time.begin)).map(case).collect();
                fields.extend(FieldResult::most("answer", &format!("{over} within {least} min"), &cases));
                return fields;
            }
            Trigger::InBed(_) => {
                let up = view.labelled(GETTING_UP);
                let cases: Vec<_> = occasions
                    .iter()
                    .map(|due| {
                        let first = up.iter().find(|one| one.time.begin > *due - 5 * HOUR);
                        let is_up = first.is_some_and(|one| one.time.begin <= *due + IN_BED_SPREAD);
                        (is_up, format!("in bed since {}", view.clock(*due - 6 * HOUR)))
                    })
                    .collect();
                fields.extend(FieldResult::most("answer", "up six hours after bedtime", &cases));
                return fields;
            }
            _ => {}
        }
        let Some(deed) = &self.answer else { return fields };
        let answers = view.deeds(deed);
        if self.trigger == Trigger::Dark {
            let first = self.from + i32::from(self.from > 0);
            let days = (first..view.days - 1).filter(|day| !view.is_excused(*day));
            let (low, high) = count_bounds(&days.map(|_| self.chance).collect::<Vec<_>>());
            let count = answers.iter().filter(|one| is_counted(&one.time.begin)).count();
            if self.until_min.is_none() {
                fields.push(FieldResult::range("answer", low as f64, high as f64, count as f64, "times, one a day"));
            }
            return fields;
        }
        let may_be = |at: &RunTime| self.until_min.is_none_or(|until| view.life.clock_min(*at) < until - 1.0);
        let must_not = |at: &RunTime| self.until_min.is_some_and(|until| view.life.clock_min(*at) > until + 1.0);
        // "For 20 minutes" is give or take a tenth. An answer at once comes before the label of its cause.
        let (early, late) = match self.trigger {
            Trigger::Doing(_, 0.0) => (self.length_min + NEEDS_MIN, ANSWERED_MIN),
            Trigger::Doing(_, wait) | Trigger::AloneAfter(_, wait) | Trigger::Sitting(wait) => {
                (0.1 * wait + 1.0, 0.1 * wait + ANSWERED_MIN)
            }
            _ => (1.0, ANSWERED_MIN),
        };
        // Needs come first.
        let needs: Vec<Occurrence> =
            [USING_BATHROOM, DRINKING, HAVING_A_SNACK].into_iter().flat_map(|label| view.labelled(label)).collect();
        let delay = |due: RunTime, begin: RunTime| {
            let between = Interval::new(due.min(begin), begin);
            let spent: Span =
                needs.iter().map(|one| Interval::new(one.time.begin, one.time.end).overlap(between)).sum();
            minutes(begin - due - spent)
        };
        let answered =
            |due: &RunTime| answers.iter().find(|one| (-early..=late).contains(&delay(*due, one.time.begin)));
        let valid: Vec<&RunTime> = occasions.iter().filter(|due| may_be(due)).collect();
        let (low, high) = count_bounds(&vec![self.chance; valid.len()]);
        let count = valid.iter().filter(|due| answered(due).is_some()).count();
        let missed = valid
            .iter()
            .find(|due| answered(due).is_none())
            .map_or(String::new(), |due| format!("; not at {}", view.clock(**due)));
        if !valid.is_empty() {
            let mut field = FieldResult::range(
                "answer",
                low as f64,
                high as f64,
                count as f64,
                &format!("of {} occasions", valid.len()),
            );
            if !field.holds {
                field.measured += &missed;
            }
            fields.push(field);
        }
        if self.until_min.is_some() {
            let wrong = occasions.iter().filter(|due| must_not(due) && answered(due).is_some()).count();
            fields.push(FieldResult::range("unless", 0.0, 0.0, wrong as f64, "answers after 20:00"));
        }
        // A visitor may interrupt an answer. The resident continues it afterwards.
        let whole = |first: &Occurrence| {
            let pieces =
                answers.iter().filter(|one| (Span::ZERO..PAUSE).contains(&(one.time.begin - first.time.begin)));
            minutes(pieces.map(|one| one.lasted).sum())
        };
        let lengths: Vec<_> = valid
            .iter()
            .filter_map(|due| answered(due))
            .map(|one| {
                let is_right =
                    |lasted: &f64| (0.9 * self.length_min - 1.0..=1.1 * self.length_min + 1.5).contains(lasted);
                let lasted = minutes(one.lasted);
                (is_right(&lasted) || is_right(&whole(one)), format!("{lasted:.1} min"))
            })
            .collect();
        fields.extend(FieldResult::most("length", &format!("{} min", self.length_min), &lengths));
        if self.from > 0 {
            let early = answers.iter().filter(|one| view.life.day_of(one.time.begin) < self.from).count();
            fields.push(FieldResult::range("from", 0.0, 0.0, early as f64, "answers before"));
        }
        fields
    }
}
