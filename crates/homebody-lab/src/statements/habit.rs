//! Drawn habits: of the resident, of visitors, outings, sleep and falls.

use super::days::{DrawnChance, DrawnDays, DrawnPhase, DrawnWhen};
use super::deeds::{
    ANCHORS, Background, Deed, FALL, MEALS, NEEDS, NIGHTS, OUT, PASTIMES, SPARE_TIME, STUMBLE, UP, USUAL, VISIT,
};
use super::homes::LifeContext;
use super::homes::{DrawnHome, clock};
use super::numbers::Draw;
use homebody_core::activity::{
    DOING_PUZZLES, FALLEN, HANDICRAFT, HOUSEWORK, LYING_AWAKE, SHOWERING, USING_BATHROOM, WASHING,
};
use homebody_core::fuzzy::{Fuzzy, Quantifier};
use homebody_routine::routine::PartOfDay;

/// Of a day; minutes, and above 1440 after midnight.
#[derive(Clone, Debug, PartialEq)]
pub enum DrawnTime {
    Any,
    At {
        words: String,
        at: Fuzzy,
    },
    Within(PartOfDay),
    /// The gap in minutes; at once if `None`. The index is of [`ANCHORS`].
    After(usize, Option<f64>),
    Before(usize, Option<f64>),
    With(usize),
}

#[derive(Clone, Debug, PartialEq)]
pub struct DrawnLength {
    words: String,
    /// In minutes.
    pub lasts: Fuzzy,
}

#[derive(Clone, Debug, PartialEq)]
pub enum DrawnPlace {
    /// The words, and the name of the furniture.
    Seat(&'static str, &'static str),
    Room(&'static str),
}

/// The further parts of a statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnDetail {
    Nothing,
    /// A visitor with a key.
    Key,
    /// A visitor who stays for a night.
    Overnight,
    /// The work of a visitor: its words, and its label.
    Work(&'static str, &'static str),
    /// Help of a visitor: its words, and the label of the host's activity.
    Help(&'static str, &'static str),
    /// A thing that is on meanwhile: its words, and its name.
    Meanwhile(&'static str, &'static str),
}

#[derive(Clone, Debug, PartialEq)]
pub struct DrawnHabit {
    pub kind: &'static str,
    pub visitor: Option<&'static str>,
    pub deed: Deed,
    /// Words after those of the deed.
    pub detail: &'static str,
    pub place: Option<DrawnPlace>,
    pub when: DrawnWhen,
    pub time: DrawnTime,
    pub length: Option<DrawnLength>,
    /// The end, in minutes of the day.
    pub until: Option<Fuzzy>,
    /// Times a day or a night.
    pub times: Option<(u32, u32)>,
    /// Most falls happen in this part of the day.
    pub mostly: Option<PartOfDay>,
    pub besides: DrawnDetail,
    /// Days of a stay or an absence.
    pub stays_days: Option<i32>,
}

/// Spread of "at 10:00" and "at about 10:00", in minutes, as the documentation states.
const EXACT_MIN: f64 = 5.0;
const ABOUT_MIN: f64 = 20.0;

impl DrawnTime {
    fn at(draw: &mut Draw, minute: f64) -> DrawnTime {
        let time = clock(minute);
        let (words, at) = match draw.below(6) {
            0 => (format!(" at about {time}"), Fuzzy::around(minute, ABOUT_MIN)),
            1 => {
                let spread = 10.0 * f64::from(1 + draw.below(5));
                (format!(" at {time}, give or take {spread} minutes"), Fuzzy::around(minute, spread))
            }
            2 => {
                let to = minute + 15.0 * f64::from(2 + draw.below(7));
                (format!(" between {time} and {}", clock(to)), Fuzzy::between(minute, to))
            }
            _ => (format!(" at {time}"), Fuzzy::around(minute, EXACT_MIN)),
        };
        DrawnTime::At { words, at }
    }

    fn words(&self) -> String {
        let gap = |gap: &Option<f64>| gap.map_or(String::new(), |gap| format!("{gap} minutes "));
        match self {
            DrawnTime::Any => String::new(),
            DrawnTime::At { words, .. } => words.clone(),
            DrawnTime::Within(PartOfDay::Night) => " at night".to_owned(),
            DrawnTime::Within(PartOfDay::Day) => " during the day".to_owned(),
            DrawnTime::Within(PartOfDay::Noon) => " at noon".to_owned(),
            DrawnTime::Within(part) => format!(" in the {}", part.word()),
            DrawnTime::After(anchor, by) => format!(" {}after {}", gap(by), ANCHORS[*anchor].0),
            DrawnTime::Before(anchor, by) => format!(" {}before {}", gap(by), ANCHORS[*anchor].0),
            DrawnTime::With(anchor) => format!(" with {}", ANCHORS[*anchor].0),
        }
    }

    pub fn field(&self) -> &'static str {
        match self {
            DrawnTime::Any => "any time",
            DrawnTime::At { .. } => "at",
            DrawnTime::Within(_) => "part of the day",
            DrawnTime::After(_, None) => "after",
            DrawnTime::After(_, Some(_)) => "after, with a gap",
            DrawnTime::Before(_, None) => "before",
            DrawnTime::Before(_, Some(_)) => "before, with a gap",
            DrawnTime::With(_) => "with",
        }
    }
}

impl DrawnLength {
    fn exactly(minutes: f64) -> DrawnLength {
        DrawnLength { words: format!(" for {minutes} minutes"), lasts: Fuzzy::around(minutes, 0.1 * minutes) }
    }

    fn draw(draw: &mut Draw, usual_min: f64) -> DrawnLength {
        let minutes = (usual_min * draw.between(0.5, 2.0) / 5.0).round().max(1.0) * 5.0;
        match draw.below(5) {
            0 => DrawnLength {
                words: format!(" for about {minutes} minutes"),
                lasts: Fuzzy::around(minutes, 0.25 * minutes),
            },
            1 => {
                let most = minutes + 5.0 * f64::from(1 + draw.below(4));
                DrawnLength { words: format!(" for {minutes} to {most} minutes"), lasts: Fuzzy::between(minutes, most) }
            }
            _ => DrawnLength::exactly(minutes),
        }
    }
}

impl DrawnHabit {
    pub fn new(kind: &'static str, deed: Deed) -> DrawnHabit {
        DrawnHabit {
            kind,
            visitor: None,
            deed,
            detail: "",
            place: None,
            when: DrawnWhen::ALWAYS,
            time: DrawnTime::Any,
            length: None,
            until: None,
            times: None,
            mostly: None,
            besides: DrawnDetail::Nothing,
            stays_days: None,
        }
    }

    pub fn draw_one(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        match draw.below(20) {
            0..=6 => DrawnHabit::pastime(draw, context),
            7 => DrawnHabit::of(draw, context, "usual activity", &USUAL),
            8 => DrawnHabit::of(draw, context, "pastime of spare time", &SPARE_TIME),
            9 => DrawnHabit::meal(draw, context),
            10 => DrawnHabit::need(draw),
            11 => DrawnHabit::night(draw),
            12 | 13 => DrawnHabit::outing(draw, context),
            14..=16 => DrawnHabit::visit(draw, context),
            17 => DrawnHabit::sleep(draw, context),
            18 if draw.one_in(2) => DrawnHabit::several_days(draw, context),
            _ => DrawnHabit::fall(draw, context.home),
        }
    }

    fn when(draw: &mut Draw, context: &LifeContext) -> DrawnWhen {
        DrawnWhen::draw(draw, &context.calendar(), context.days)
    }

    /// A time while the person is up, or now and then at any hour.
    fn awake(draw: &mut Draw, context: &LifeContext) -> f64 {
        let (up, bed) = (context.base.up_min + 75.0, context.base.bed_min - 75.0);
        5.0 * (draw.between(up, bed) / 5.0).round()
    }

    fn time(draw: &mut Draw, context: &LifeContext, deed: &Deed) -> DrawnTime {
        let gap = |draw: &mut Draw| draw.one_in(2).then(|| 10.0 * f64::from(1 + draw.below(6)));
        // A shower is not on every day.
        let anchors = if deed.label == SHOWERING { 5 } else { 6 };
        match draw.below(12) {
            0..=4 => {
                let minute = DrawnHabit::awake(draw, context);
                DrawnTime::at(draw, minute)
            }
            5 | 6 => DrawnTime::Within(
                [PartOfDay::Morning, PartOfDay::Noon, PartOfDay::Afternoon, PartOfDay::Evening, PartOfDay::Day]
                    [draw.below(5) as usize],
            ),
            // Nothing follows bedtime here.
            7 | 8 => DrawnTime::After([0, 1, 2, 3, 5][draw.below(anchors - 1) as usize], gap(draw)),
            9 => DrawnTime::Before([1, 2, 4][draw.below(3) as usize], gap(draw)),
            10 => DrawnTime::With(draw.below(3) as usize),
            _ => DrawnTime::Any,
        }
    }

    fn pastime(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        let deed = PASTIMES[draw.below(PASTIMES.len() as u32) as usize];
        let mut habit = DrawnHabit::of(draw, context, "pastime", &[deed]);
        if [DOING_PUZZLES, HANDICRAFT].contains(&deed.label) && habit.times.is_none() && draw.one_in(2) {
            habit.besides = DrawnDetail::Meanwhile(" with the television on", "tv bench");
            return habit;
        }
        if deed.goes_anywhere && draw.one_in(2) {
            let seats = context.home.seats.len() as u32;
            let which = draw.below(seats + context.home.rooms.len() as u32);
            habit.place = Some(match context.home.seats.get(which as usize) {
                Some((words, name)) => DrawnPlace::Seat(words, name),
                None => DrawnPlace::Room(context.home.rooms[(which - seats) as usize]),
            });
        }
        habit
    }

    fn of(draw: &mut Draw, context: &LifeContext, kind: &'static str, deeds: &[Deed]) -> DrawnHabit {
        let deed = deeds[draw.below(deeds.len() as u32) as usize];
        let mut habit = DrawnHabit::new(kind, deed);
        habit.when = DrawnHabit::when(draw, context);
        habit.time = DrawnHabit::time(draw, context, &deed);
        if draw.one_in(2) {
            habit.length = Some(DrawnLength::draw(draw, deed.usual_min));
        }
        let is_timed = matches!(habit.time, DrawnTime::At { .. });
        if is_timed && habit.length.is_none() && draw.one_in(2) && deed.usual_min > 10.0 {
            habit.until_of(draw);
        }
        if habit.time == DrawnTime::Any && deed.background == Background::Nothing && draw.one_in(2) {
            let least = 2 + draw.below(3);
            habit.times = Some((least, least + draw.below(2)));
            habit.length = None;
        }
        habit
    }

    /// From a time until another.
    fn until_of(&mut self, draw: &mut Draw) {
        let DrawnTime::At { at, .. } = &self.time else { return };
        let from = at.mean().floor();
        let to = from + 15.0 * f64::from(2 + draw.below(6));
        let (about, spread) = if draw.one_in(2) { ("about ", ABOUT_MIN) } else { ("", EXACT_MIN) };
        let words = format!(" from {about}{} until {about}{}", clock(from), clock(to));
        self.time = DrawnTime::At { words, at: Fuzzy::around(from, spread) };
        self.until = Some(Fuzzy::around(to, spread));
    }

    fn meal(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        let meal = draw.below(3) as usize;
        let mut habit = DrawnHabit::new("meal", MEALS[meal]);
        let usual = [context.base.up_min + 75.0, 750.0_f64.max(context.base.up_min + 180.0), 1080.0][meal];
        let minute = usual + 5.0 * f64::from(draw.below(12));
        habit.time = DrawnTime::at(draw, minute);
        habit.length = draw.one_in(2).then(|| DrawnLength::draw(draw, 25.0));
        if draw.one_in(3) {
            habit.when.days = DrawnDays::Weekdays(1 << draw.below(7));
        }
        habit
    }

    fn need(draw: &mut Draw) -> DrawnHabit {
        let mut habit = DrawnHabit::new("need by day", NEEDS[draw.below(3) as usize]);
        let least = if habit.deed.label == USING_BATHROOM { 4 + draw.below(5) } else { 2 + draw.below(5) };
        habit.times = Some((least, least + draw.below(2)));
        habit
    }

    fn night(draw: &mut Draw) -> DrawnHabit {
        let mut habit = DrawnHabit::new("at night", NIGHTS[draw.below(4) as usize]);
        habit.time = DrawnTime::Within(PartOfDay::Night);
        match draw.below(4) {
            0 => habit.when.chance = DrawnChance::Word(Quantifier::Often),
            1 if habit.deed.label != LYING_AWAKE => habit.times = Some((1, 2)),
            2 => habit.when.chance = DrawnChance::Becomes(Quantifier::Rarely, Quantifier::Often, 25),
            _ => {}
        }
        if habit.when.chance == DrawnChance::Becomes(Quantifier::Rarely, Quantifier::Often, 25) {
            habit.when.phase = DrawnPhase { from: Some(4), ..DrawnPhase::default() };
        }
        if habit.deed.label == LYING_AWAKE {
            habit.length = Some(DrawnLength::exactly(30.0));
        }
        habit
    }

    fn outing(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        let mut habit = DrawnHabit::new("outing", OUT);
        habit.when = DrawnHabit::when(draw, context);
        let minute = DrawnHabit::awake(draw, context).min(1140.0);
        habit.time = match draw.below(4) {
            0 => DrawnTime::Within(if draw.one_in(2) { PartOfDay::Morning } else { PartOfDay::Afternoon }),
            1 => DrawnTime::After(draw.below(3) as usize, None),
            _ => DrawnTime::at(draw, minute),
        };
        match draw.below(3) {
            0 if matches!(habit.time, DrawnTime::At { .. }) => habit.until_of(draw),
            1 => {}
            _ => habit.length = Some(DrawnLength::draw(draw, 90.0)),
        }
        habit
    }

    fn visit(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        let mut habit = DrawnHabit::new("guest", VISIT);
        habit.visitor = Some(["daughter", "son", "friend", "nurse"][draw.below(4) as usize]);
        habit.when = DrawnHabit::when(draw, context);
        let minute = DrawnHabit::awake(draw, context).clamp(480.0, 1200.0);
        habit.time = match draw.below(4) {
            0 => DrawnTime::Within(
                [PartOfDay::Morning, PartOfDay::Afternoon, PartOfDay::Evening][draw.below(3) as usize],
            ),
            _ => DrawnTime::at(draw, minute),
        };
        match draw.below(4) {
            0 if matches!(habit.time, DrawnTime::At { .. }) => habit.until_of(draw),
            1 => {}
            _ => habit.length = Some(DrawnLength::draw(draw, 60.0)),
        }
        habit.visit_besides(draw);
        habit
    }

    /// A key, a night or work.
    fn visit_besides(&mut self, draw: &mut Draw) {
        let DrawnTime::At { at, .. } = &self.time else { return };
        let (is_late, is_short) = (at.low >= 960.0, self.length.is_some());
        self.besides = match draw.below(8) {
            0 => DrawnDetail::Key,
            // A stay of a night needs days on which it begins.
            1 if is_late && self.until.is_none() && self.when.days != DrawnDays::All => DrawnDetail::Overnight,
            2 if is_short => DrawnDetail::Work(" and does the housework", HOUSEWORK),
            3 if is_short => DrawnDetail::Help(" and helps her wash", WASHING),
            _ => DrawnDetail::Nothing,
        };
        if self.besides == DrawnDetail::Overnight {
            self.length = None;
        }
    }

    fn sleep(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        let is_up = draw.one_in(2);
        let mut habit = DrawnHabit::new("sleep", if is_up { UP } else { super::deeds::BED });
        let usual = if is_up { context.base.up_min } else { context.base.bed_min };
        let minute = usual + 15.0 * f64::from(draw.below(5));
        habit.time = match draw.below(4) {
            0 if !is_up => DrawnTime::After(2, Some(30.0 * f64::from(4 + draw.below(4)))),
            _ => DrawnTime::at(draw, minute),
        };
        if draw.one_in(4) {
            habit.when.days = DrawnDays::Weekdays(0x1f);
        }
        habit
    }

    fn several_days(draw: &mut Draw, context: &LifeContext) -> DrawnHabit {
        let days = 2 + draw.below(7) as i32;
        let from = 3 + draw.below((context.days - days - 6).max(1) as u32) as i32;
        let (kind, visitor, deed) = match draw.one_in(2) {
            true => ("absence of days", None, OUT),
            false => ("stay of days", Some("sister"), VISIT),
        };
        let mut habit = DrawnHabit::new(kind, deed);
        habit.visitor = visitor;
        habit.stays_days = Some(days);
        habit.when.phase = DrawnPhase { from: Some(from), ..DrawnPhase::default() };
        habit
    }

    fn fall(draw: &mut Draw, home: &DrawnHome) -> DrawnHabit {
        let mut habit = DrawnHabit::new("fall", if draw.one_in(4) { STUMBLE } else { FALL });
        habit.when.chance = match draw.below(3) {
            0 => DrawnChance::Percent(10 * (1 + draw.below(4))),
            1 => DrawnChance::DaysAWeek(2 + draw.below(2) as u8),
            _ => DrawnChance::Word(Quantifier::Sometimes),
        };
        if habit.deed == FALL {
            match draw.below(5) {
                0 => habit.mostly = Some(PartOfDay::Night),
                1 => habit.mostly = Some(PartOfDay::Morning),
                2 => (habit.detail, habit.place) = (" in the bathroom", Some(DrawnPlace::Room("bathroom"))),
                3 => {
                    let bedroom = home.rooms.iter().find(|room| **room == "bedroom");
                    (habit.detail, habit.place) = (" out of bed", bedroom.map(|room| DrawnPlace::Room(room)));
                }
                _ => {}
            }
            if draw.one_in(2) {
                habit.length = Some(DrawnLength::exactly(5.0 * f64::from(2 + draw.below(6))));
            }
        }
        habit
    }

    /// The sentence.
    pub fn words(&self, home: &DrawnHome) -> String {
        let DrawnHabit { deed, when, time, visitor, stays_days, .. } = self;
        let phase = when.phase.words();
        let text = match (stays_days, visitor) {
            (Some(days), None) => format!("{}for {days} days, she is out", phase),
            (Some(days), Some(visitor)) => format!("{phase}her {visitor} stays for {days} days"),
            _ => {
                let who = visitor.map_or("she".to_owned(), |visitor| format!("her {visitor}"));
                let place = match &self.place {
                    _ if !self.detail.is_empty() => self.detail.to_owned(),
                    Some(DrawnPlace::Seat(words, _)) => format!(" in the {words}"),
                    Some(DrawnPlace::Room(name)) => format!(" in the {name}"),
                    None => String::new(),
                };
                let length = match (&self.length, deed.label) {
                    (Some(length), FALLEN) => format!(" and lies there{}", length.words),
                    (Some(length), _) => length.words.clone(),
                    (None, _) => String::new(),
                };
                let span = if *time == DrawnTime::Within(PartOfDay::Night) { "night" } else { "day" };
                let times = match self.times {
                    None => String::new(),
                    Some((1, 2)) => format!(" once or twice a {span}"),
                    Some((least, most)) if least == most => format!(" {least} times a {span}"),
                    Some((least, most)) => format!(" {least} to {most} times a {span}"),
                };
                let time = if span == "night" && self.times.is_some() { String::new() } else { time.words() };
                let mostly = match self.mostly {
                    Some(PartOfDay::Night) => ", mostly at night,",
                    Some(_) => ", mostly in the morning,",
                    None => "",
                };
                let (days, after) = (when.days.words(), when.chance.words_after());
                let chance = when.chance.words();
                let words = deed.words;
                let besides = match self.besides {
                    DrawnDetail::Nothing => "",
                    DrawnDetail::Key => " with a key",
                    DrawnDetail::Overnight => " for 1 night",
                    DrawnDetail::Work(words, _) | DrawnDetail::Help(words, _) | DrawnDetail::Meanwhile(words, _) => {
                        words
                    }
                };
                format!("{phase}{chance}{who} {words}{place}{time}{times}{days}{after}{mostly}{length}{besides}")
            }
        };
        let text = home.of_person(text.replace(",,", ",").trim_end_matches(','));
        let mut text = text;
        text[..1].make_ascii_uppercase();
        format!("{text}.")
    }
}
