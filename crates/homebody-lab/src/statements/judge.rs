//! The measures of habits: each field of a statement has its own.

use super::bounds::{self, count_bounds, mean, mean_error};
use super::days::DrawnChance;
use super::deeds::{ANCHORS, Background};
use super::field::{EARLY_MIN, FieldResult, GRACE_MIN, LifeView, containing, minutes};
use super::habit::{DrawnHabit, DrawnPlace, DrawnTime};
use crate::claims::Occurrence;
use homebody_core::activity::{AWAY, FALLEN, GETTING_UP, GOING_TO_BED, LYING_AWAKE, STUMBLING, USING_BATHROOM};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, Span};
use homebody_routine::routine::{Habit, HabitTime, PartOfDay};

/// Time within which an occurrence is the one of the statement, before and after its time (our choice).
const NEAR_MIN: (f64, f64) = (120.0, 300.0);

/// Largest mean delay of the activities that are in time, in minutes (our choice).
const MEAN_LATE_MIN: f64 = 8.0;

/// Least share of the time of an activity of spare time that is spent on it (our choice): needs interrupt it.
const COVERED: f64 = 0.6;

/// Longest pause of one occurrence (our choice): a meal with its preparation.
const PAUSE: Span = HOUR.times(2);

/// A day on which the statement may hold.
pub struct Occasion {
    day: i32,
    pub chance: f64,
    /// Earliest and latest begin, where the statement gives one.
    begin: Option<(RunTime, RunTime)>,
    /// The activity before or after it.
    anchor: Option<Interval<RunTime>>,
    found: Vec<Occurrence>,
}

impl DrawnHabit {
    pub fn judge(&self, view: &LifeView) -> Vec<FieldResult> {
        if let Some(days) = self.stays_days {
            return self.judge_days(view, days);
        }
        let all = match self.visitor {
            Some(visitor) => view.stays(visitor).unwrap_or_default(),
            None if self.times.is_some() || self.deed.background == Background::Need => {
                let mut all = view.deeds(&self.deed);
                // By day: between rising and bedtime. At night: the rest.
                let at_night = self.time == DrawnTime::Within(PartOfDay::Night);
                let (up, bed) = (view.labelled(GETTING_UP), view.labelled(GOING_TO_BED));
                let last =
                    |of: &[Occurrence], at: RunTime| of.iter().map(|one| one.time.begin).rfind(|begin| *begin <= at);
                all.retain(|one| (last(&up, one.time.begin) < last(&bed, one.time.begin)) == at_night);
                all
            }
            None => view.deeds(&self.deed),
        };
        self.fields(view, &all)
    }

    /// Compares the numbers of the parsed statement with the drawn ones.
    pub fn explained(&self, read: &Habit) -> Option<FieldResult> {
        let seconds = |minutes: &Fuzzy| minutes.map(|minutes| minutes * MINUTE.seconds());
        let time = match (&self.time, &read.when.time) {
            (DrawnTime::At { at, .. }, HabitTime::At(time)) => Some((seconds(at), *time)),
            (DrawnTime::At { at, .. }, _) => Some((seconds(at), Fuzzy::exactly(f64::NAN))),
            _ => None,
        };
        let length = self.length.as_ref().zip(read.when.lasts).map(|(drawn, read)| (seconds(&drawn.lasts), read));
        let until = self.until.as_ref().zip(read.when.until).map(|(drawn, read)| (seconds(drawn), read));
        let numbers: Vec<(Fuzzy, Fuzzy)> = [time, length, until].into_iter().flatten().collect();
        let parts = |of: &Fuzzy| [of.low, of.from, of.to, of.high];
        let is_near = |(drawn, read): &(Fuzzy, Fuzzy)| {
            parts(drawn).into_iter().zip(parts(read)).all(|(drawn, read)| (drawn - read).abs() <= 1.0)
        };
        let times = self.times.is_none_or(|times| times == read.when.times);
        let in_words =
            |of: &dyn Fn(&(Fuzzy, Fuzzy)) -> Fuzzy| format!("{:?}", numbers.iter().map(of).collect::<Vec<_>>());
        (!numbers.is_empty() || self.times.is_some()).then(|| FieldResult {
            field: "explained numbers".to_owned(),
            expected: in_words(&|(drawn, _)| *drawn),
            measured: in_words(&|(_, read)| *read),
            holds: times && numbers.iter().all(is_near),
        })
    }

    /// Whether it is the only source of its activity.
    fn is_only(&self) -> bool {
        let is_always = self.when.phase == Default::default();
        match self.deed.background {
            Background::Nothing => true,
            Background::Usual => is_always,
            Background::Meal | Background::SpareTime => false,
            Background::Need => self.times.is_some(),
        }
    }

    fn fields(&self, view: &LifeView, all: &[Occurrence]) -> Vec<FieldResult> {
        let occasions = self.occasions(view, all);
        let mut fields = Vec::new();
        if self.time == DrawnTime::Within(PartOfDay::Night) && self.deed.label == USING_BATHROOM && self.times.is_none()
        {
            // The need continues on other nights.
        } else if self.deed.background == Background::SpareTime {
            fields.extend(self.coverage(&occasions, all, view));
        } else {
            self.days(view, &occasions, &mut fields);
            fields.extend(self.begins(view, &occasions));
            fields.extend(self.lengths(&occasions));
        }
        fields.extend(self.ends(view, &occasions));
        fields.extend(self.places(view, &occasions));
        if self.visitor.is_some() {
            self.host(view, all, &mut fields);
        }
        fields.extend(self.besides(view, &occasions));
        if let Some(part) = self.mostly {
            let hours = match part {
                PartOfDay::Night => (view.bed_min, view.up_min + 1440.0),
                part => (part.hours().0 / 60.0, part.hours().1 / 60.0),
            };
            let within = all.iter().filter(|one| is_between(one.clock_min, hours)).count();
            let (low, high) = count_bounds(&vec![homebody_routine::routine::USUAL_SHARE; all.len()]);
            fields.push(FieldResult::range(
                "mostly",
                low as f64,
                high as f64,
                within as f64,
                &format!("of {} falls", all.len()),
            ));
        }
        fields
    }

    fn occasions(&self, view: &LifeView, all: &[Occurrence]) -> Vec<Occasion> {
        let anchors = match self.time {
            DrawnTime::After(anchor, _) | DrawnTime::Before(anchor, _) | DrawnTime::With(anchor) => {
                view.labelled(ANCHORS[anchor].1)
            }
            _ => Vec::new(),
        };
        let is_small = matches!(&self.time, DrawnTime::At { at, .. } if at.high < 300.0);
        let is_night = self.time == DrawnTime::Within(PartOfDay::Night);
        let is_fall = self.deed.label == FALLEN || self.deed.label == STUMBLING;
        let day_of = |at: RunTime| match (is_small, is_night) {
            // From rising to rising.
            _ if is_fall => view.life.day_of(at - Span::from_seconds(60.0 * view.up_min)),
            (true, _) => view.life.day_of(at),
            (_, true) => view.life.day_of(at - 12 * HOUR),
            _ => view.day_of(at),
        };
        // The last day may be cut off, and the first night.
        let last = view.days - 1;
        let mut occasions = Vec::new();
        for day in 0..last {
            let mut chance = self.when.chance(view.calendar, day);
            let (mut begin, mut anchor) = (None, None);
            match &self.time {
                DrawnTime::At { at, .. } => begin = Some((view.at(day, at.low), view.at(day, at.high))),
                DrawnTime::Within(part) if *part != PartOfDay::Night => {
                    let (from, to) = part.hours();
                    begin = Some((view.at(day, from / 60.0), view.at(day, to / 60.0)));
                }
                DrawnTime::After(..) | DrawnTime::Before(..) | DrawnTime::With(_) => {
                    let of_day = anchors.iter().filter(|one| view.day_of(one.time.begin) == day);
                    anchor = of_day.map(|one| Interval::new(one.time.begin, one.time.end)).next();
                    // An occasion needs the other activity.
                    chance = if anchor.is_some() { chance } else { -1.0 };
                }
                _ => {}
            }
            let is_near = |one: &&Occurrence| match (begin, anchor) {
                _ if self.is_only() => true,
                (Some((from, to)), _) => {
                    minutes(one.time.begin - from) >= -NEAR_MIN.0 && minutes(one.time.begin - to) <= NEAR_MIN.1
                }
                (None, Some(anchor)) => {
                    minutes(one.time.begin - anchor.begin) >= -NEAR_MIN.0
                        && minutes(one.time.begin - anchor.end) <= NEAR_MIN.1
                }
                (None, None) => true,
            };
            let found = all.iter().filter(|one| day_of(one.time.begin) == day).filter(is_near).cloned().collect();
            if chance >= 0.0 && !view.is_excused(day) {
                occasions.push(Occasion { day, chance, begin, anchor, found });
            }
        }
        occasions
    }

    fn days(&self, view: &LifeView, occasions: &[Occasion], fields: &mut Vec<FieldResult>) {
        let when = &self.when;
        let name = match (&when.chance, when.days.field()) {
            (DrawnChance::Every, Some(field)) => field,
            (DrawnChance::Every, None) => "every day",
            (DrawnChance::DaysAWeek(_), _) => "days a week",
            (DrawnChance::Becomes(..), _) => "chance that changes",
            _ => "chance",
        };
        if self.is_only() {
            let wrong: Vec<&Occasion> =
                occasions.iter().filter(|of| of.chance == 0.0 && !of.found.is_empty()).collect();
            if occasions.iter().any(|of| of.chance == 0.0) {
                let excluded = when
                    .days
                    .field()
                    .into_iter()
                    .chain(when.phase.fields().into_iter().filter(|field| *field != "over"));
                let field = format!("not on other days ({})", excluded.collect::<Vec<_>>().join(", "));
                let mut result = FieldResult::range(&field, 0.0, 0.0, wrong.len() as f64, "days");
                if let Some(first) = wrong.first() {
                    result.measured += &format!(", such as day {}", first.day + 1);
                }
                fields.push(result);
            }
        }
        let meant: Vec<&Occasion> = occasions.iter().filter(|of| of.chance > 0.0).collect();
        let on = meant.iter().filter(|of| !of.found.is_empty()).count();
        if let DrawnChance::DaysAWeek(each) = when.chance {
            let weeks: Vec<(bool, String)> = view
                .life
                .whole_weeks()
                .into_iter()
                .filter(|monday| {
                    (*monday..monday + 7)
                        .all(|day| meant.iter().any(|of| of.day == day && when.phase.strength(day) == 1.0))
                })
                .map(|monday| {
                    let of_week = meant.iter().filter(|of| (monday..monday + 7).contains(&of.day));
                    let count = of_week.filter(|of| !of.found.is_empty()).count();
                    (count == usize::from(each), format!("{count} in the week from day {}", monday + 1))
                })
                .collect();
            fields.extend(FieldResult::most(name, &format!("{each} days a week"), &weeks));
        } else if !meant.is_empty() {
            let (low, high) = count_bounds(&meant.iter().map(|of| of.chance.min(1.0)).collect::<Vec<_>>());
            let high = if self.is_only() || self.visitor.is_some() { high } else { meant.len() };
            let mut result =
                FieldResult::range(name, low as f64, high as f64, on as f64, &format!("of {} days", meant.len()));
            if let Some(first) = meant.iter().find(|of| of.chance >= 1.0 && of.found.is_empty())
                && !result.holds
            {
                result.measured += &format!(", not on day {}", first.day + 1);
            }
            fields.push(result);
        }
        if let Some((least, most)) = self.times {
            let counts: Vec<f64> = meant
                .iter()
                .filter(|of| of.chance >= 1.0 || !of.found.is_empty())
                .map(|of| of.found.len() as f64)
                .collect();
            if !counts.is_empty() {
                let middle = f64::from(least + most) / 2.0;
                let error = mean_error(
                    bounds::deviation(&Fuzzy::between(f64::from(least), f64::from(most) + 0.2)),
                    counts.len(),
                );
                let low = middle - error - (bounds::LEFT_OUT * middle).max(1.0 / counts.len() as f64);
                fields.push(FieldResult::range(
                    "times a day",
                    low,
                    middle + error + 0.02 * middle,
                    mean(&counts),
                    "times on average",
                ));
            }
        } else if self.is_only() && ![FALLEN, USING_BATHROOM, LYING_AWAKE].contains(&self.deed.label) {
            let twice: Vec<_> = meant
                .iter()
                .filter(|of| !of.found.is_empty())
                .map(|of| {
                    // An activity that a meal interrupts is continued.
                    let pauses = of.found.windows(2).filter(|pair| pair[1].time.begin - pair[0].time.end > PAUSE);
                    let times = 1 + pauses.count();
                    (times == 1, format!("{times} times on day {}", of.day + 1))
                })
                .collect();
            fields.extend(FieldResult::most("once on such a day", "once", &twice));
        }
    }

    /// The occurrence that the statement means.
    pub fn meant<'a>(&self, of: &'a Occasion) -> Option<&'a Occurrence> {
        let wanted = match (of.begin, of.anchor, &self.time) {
            (Some((from, to)), ..) => from + (to - from) / 2,
            (None, Some(anchor), DrawnTime::After(..)) => anchor.end,
            (None, Some(anchor), _) => anchor.begin,
            _ => return of.found.first(),
        };
        of.found.iter().min_by_key(|one| (one.time.begin - wanted).abs())
    }

    fn begins(&self, view: &LifeView, occasions: &[Occasion]) -> Vec<FieldResult> {
        let held: Vec<(&Occasion, &Occurrence)> =
            occasions.iter().filter(|of| of.chance > 0.0).filter_map(|of| Some((of, self.meant(of)?))).collect();
        let mut fields = Vec::new();
        let late = |gap: f64, least: f64, most: f64| (least - EARLY_MIN..=most + GRACE_MIN).contains(&gap);
        let said = |one: &Occurrence| view.clock(one.time.begin);
        let cooking = match self.time {
            DrawnTime::Before(anchor, _) => view.labelled(&ANCHORS[anchor].1.replace("eating", "preparing")),
            _ => Vec::new(),
        };
        let cases: Vec<(bool, String)> = held
            .iter()
            .filter_map(|(of, one)| {
                let (begin, end) = (one.time.begin, one.time.end);
                let is_right = match (&self.time, of.begin, of.anchor) {
                    (DrawnTime::Within(PartOfDay::Night), ..) => {
                        is_between(one.clock_min, (view.bed_min - 30.0, view.up_min + 1440.0 + 60.0))
                    }
                    (_, Some((from, to)), _) => late(minutes(begin - from), 0.0, minutes(to - from)),
                    (DrawnTime::After(_, gap), _, Some(anchor)) => {
                        let (low, high) = gap.map_or((0.0, 5.0), |gap| (0.9 * gap, 1.1 * gap));
                        late(minutes(begin - anchor.end), low, high)
                    }
                    (DrawnTime::Before(_, gap), _, Some(anchor)) => {
                        // Before its end, or before its beginning.
                        let (low, high) = gap.map_or((0.0, 5.0), |gap| (0.9 * gap, 1.1 * gap));
                        let lasted = minutes(end - begin);
                        // A meal begins with its preparation.
                        let cooked = cooking
                            .iter()
                            .rfind(|one| one.time.begin < anchor.begin && one.time.end > anchor.begin - HOUR);
                        let begins = [Some(anchor.begin), cooked.map(|one| one.time.begin)];
                        begins.into_iter().flatten().any(|anchor| {
                            let gap = minutes(anchor - begin);
                            (low - GRACE_MIN..=high + lasted + GRACE_MIN).contains(&gap) && gap >= -EARLY_MIN
                        })
                    }
                    // One after the other, since one body does both.
                    (DrawnTime::With(_), _, Some(anchor)) => {
                        minutes((begin - anchor.begin).abs()) <= GRACE_MIN + minutes(end - begin)
                    }
                    _ => return None,
                };
                let anchor = of.anchor.map_or(String::new(), |anchor| {
                    format!(", and {} to {}", view.clock(anchor.begin), view.clock(anchor.end))
                });
                Some((is_right, format!("{}{anchor}", said(one))))
            })
            .collect();
        let what = match &self.time {
            DrawnTime::At { at, .. } => format!("{} to {}", super::homes::clock(at.low), super::homes::clock(at.high)),
            DrawnTime::After(anchor, gap) | DrawnTime::Before(anchor, gap) => {
                format!("{} min from {}", gap.unwrap_or(0.0), ANCHORS[*anchor].0)
            }
            _ => "as stated".to_owned(),
        };
        fields.extend(FieldResult::most(self.time.field(), &what, &cases));
        if let DrawnTime::At { at, .. } = &self.time
            && held.len() >= 10
        {
            let in_time = held.iter().map(|(of, one)| minutes(one.time.begin - view.at(of.day, at.mean())));
            let in_time: Vec<f64> = in_time
                .filter(|by| (at.low - at.mean() - EARLY_MIN..=at.high - at.mean() + GRACE_MIN).contains(by))
                .collect();
            let error = mean_error(bounds::deviation(at), in_time.len());
            fields.push(FieldResult::range(
                "mean time",
                -error - EARLY_MIN,
                error + MEAN_LATE_MIN,
                mean(&in_time),
                "min after the middle",
            ));
        }
        fields
    }

    fn lengths(&self, occasions: &[Occasion]) -> Vec<FieldResult> {
        let Some(length) = &self.length else { return Vec::new() };
        let held = occasions.iter().filter(|of| of.chance > 0.0);
        let lengths: Vec<f64> = match self.deed.label {
            // The toilet in the middle of the night interrupts it.
            LYING_AWAKE => {
                let nights = held.filter(|of| !of.found.is_empty());
                nights.map(|of| of.found.iter().map(|one| minutes(one.lasted)).sum()).collect()
            }
            _ => held.filter_map(|of| self.meant(of)).map(|one| minutes(one.lasted)).collect(),
        };
        if lengths.is_empty() {
            return Vec::new();
        }
        let (expected, error) = (length.lasts.mean(), mean_error(bounds::deviation(&length.lasts), lengths.len()));
        // The way to the place, and getting up from the floor.
        let more = if self.deed.label == FALLEN { 5.0 } else { 2.0 };
        let (low, high) = (0.9 * expected - error, 1.1 * expected + error + more);
        vec![FieldResult::range("length", low, high, mean(&lengths), "min on average")]
    }

    fn ends(&self, view: &LifeView, occasions: &[Occasion]) -> Option<FieldResult> {
        let until = self.until.as_ref()?;
        // After a meal in the middle, the rest counts.
        let last = |of: &Occasion| {
            let begun = |one: &&Occurrence| one.time.begin < view.at(of.day, until.high);
            of.found.iter().rfind(begun).map(|one| one.time.end)
        };
        let held = occasions.iter().filter(|of| of.chance > 0.0).filter_map(|of| Some((of, last(of)?)));
        let cases: Vec<(bool, String)> = held
            .map(|(of, end)| {
                // Nobody goes back to an activity for a few minutes. Coming home or seeing a visitor out takes some.
                let (earliest, latest) = (view.at(of.day, until.low - GRACE_MIN), view.at(of.day, until.high + 5.0));
                ((earliest..=latest).contains(&end), view.clock(end))
            })
            .collect();
        FieldResult::most("end", &format!("until {}", super::homes::clock(until.mean())), &cases)
    }

    /// The share of the time of an activity that also fills spare time.
    fn coverage(&self, occasions: &[Occasion], all: &[Occurrence], view: &LifeView) -> Option<FieldResult> {
        let DrawnTime::At { at, .. } = &self.time else { return None };
        let length = self.length.as_ref().map(|length| length.lasts.low);
        let cases: Vec<(bool, String)> = occasions
            .iter()
            .filter(|of| of.chance >= 1.0)
            .map(|of| {
                // With a length, it is under way from the latest begin to the earliest end; else it begins in time.
                let (from, to) = match length {
                    Some(length) => (at.high + 5.0, at.low + GRACE_MIN + length),
                    None => (at.low - EARLY_MIN, at.high + GRACE_MIN),
                };
                let time = Interval::new(view.at(of.day, from), view.at(of.day, to));
                let spent: f64 =
                    all.iter().map(|one| minutes(Interval::new(one.time.begin, one.time.end).overlap(time))).sum();
                let expected = length.map_or(0.5, |length| COVERED * length.min(minutes(time.length())) - 5.0);
                (spent >= expected, format!("{spent:.0} min on day {}", of.day + 1))
            })
            .collect();
        FieldResult::most("at", &format!("under way after {}", super::homes::clock(at.mean())), &cases)
    }

    fn places(&self, view: &LifeView, occasions: &[Occasion]) -> Option<FieldResult> {
        let place = self.place.as_ref()?;
        let held = occasions.iter().filter(|of| of.chance > 0.0).filter_map(|of| self.meant(of));
        let cases: Vec<(bool, String)> = held
            .map(|one| {
                let time = Interval::new(one.time.begin, one.time.end);
                let spent = match place {
                    DrawnPlace::Seat(_, name) => view.life.time_at(view.who, name, time),
                    DrawnPlace::Room(name) => view.life.time_in(view.who, name, time),
                };
                let share = minutes(spent) / minutes(one.lasted).max(0.1);
                (share >= 0.8, format!("{:.0} % of {}", 100.0 * share, view.clock(one.time.begin)))
            })
            .collect();
        let (field, name) = match place {
            DrawnPlace::Seat(_, name) => ("place", name),
            DrawnPlace::Room(name) => ("room", name),
        };
        FieldResult::most(field, &format!("four fifths of the time: {name}"), &cases)
    }

    /// The host is at home, and the front door opens.
    fn host(&self, view: &LifeView, all: &[Occurrence], fields: &mut Vec<FieldResult>) {
        let out = view.labelled(AWAY);
        let home = |one: &Occurrence| {
            let middle = one.time.begin + one.time.length() / 2;
            (containing(&out, middle).is_none(), view.clock(one.time.begin))
        };
        fields.extend(FieldResult::most("host", "the host is at home", &all.iter().map(home).collect::<Vec<_>>()));
        let opens = |at: RunTime| view.life.is_used("front door", Interval::new(at - 3 * MINUTE, at + 3 * MINUTE));
        let ended = all.iter().filter(|one| one.time.end < view.at(view.days, 0.0) - MINUTE);
        let door = |one: &Occurrence| (opens(one.time.begin) && opens(one.time.end), view.clock(one.time.begin));
        fields.extend(FieldResult::most(
            "door",
            "it opens as the visitor comes and goes",
            &ended.map(door).collect::<Vec<_>>(),
        ));
    }

    /// An absence, or a stay of a visitor, of whole days.
    fn judge_days(&self, view: &LifeView, days: i32) -> Vec<FieldResult> {
        let from = self.when.phase.from.unwrap_or(0);
        let all = match self.visitor {
            Some(visitor) => view.stays(visitor).unwrap_or_default(),
            None => view.deeds(&self.deed),
        };
        let (begin, end) = (view.at(from + 1, 0.0), view.at(from + days - 1, 0.0));
        let inner = Interval::new(begin, end);
        let within: f64 =
            all.iter().map(|one| minutes(Interval::new(one.time.begin, one.time.end).overlap(inner))).sum();
        let whole = minutes(inner.length());
        let mut fields = Vec::new();
        if whole > 0.0 {
            // A guest stays in the home.
            fields.push(FieldResult::range("whole days", 98.0, 100.1, 100.0 * within / whole, "% of the days between"));
        }
        let longest = all.iter().map(|one| minutes(one.time.length())).fold(0.0, f64::max) / 1440.0;
        let days_f = f64::from(days);
        fields.push(FieldResult::range("length", days_f - 0.75, days_f + 0.75, longest, "days"));
        if self.visitor.is_some() {
            let other =
                all.iter().filter(|one| one.time.end < begin - 24 * HOUR || one.time.begin > end + 48 * HOUR).count();
            fields.push(FieldResult::range("not on other days (from)", 0.0, 0.0, other as f64, "stays"));
        }
        fields
    }

    /// Whether it takes the resident away for these days.
    pub fn takes(&self, day: i32) -> bool {
        let from = self.when.phase.from.unwrap_or(0);
        self.stays_days.is_some_and(|days| (from..=from + days).contains(&day)) && self.visitor.is_none()
    }
}

fn is_between(minute: f64, (from, to): (f64, f64)) -> bool {
    (from..=to).contains(&minute) || (from..=to).contains(&(minute + 1440.0))
}
