//! The one sentence that says each statement of a routine in full: the language reads it back as the same statement.

use super::activities::phrase;
use super::amounts::DAY_S;
use super::times::PLAIN_TIME_S;
use crate::routine::{
    Activity, Circumstance, DayEpisode, DaySelection, FallEnds, Falling, FallsFrom, Habit, HabitChance, HabitTime,
    PartOfDay, Phase, PhaseDay, ResidentKind, Response, RoutineChange, RoutinePerson, RoutineRule, RuleTrigger, When,
};
use effects::effect_words;
use homebody_core::fuzzy::Fuzzy;
use words::{amount, bare, clock, duration, join, number, part_words};

mod effects;
mod words;

pub fn person_sentences(person: &RoutinePerson) -> Vec<String> {
    let name = &person.name;
    let kind = match person.kind {
        ResidentKind::Person => None,
        ResidentKind::Cat => Some(format!("{name} is a cat.")),
        ResidentKind::Dog => Some(format!("{name} is a dog.")),
    };
    let age = person.age_years.map(|age| format!("{name} is {} years old.", number(age)));
    let pace = person.pace_mps.map(|pace| format!("{name} walks at {}.", amount(&pace, 1.0, "m/s", 0.0, 0.1)));
    let rests = person.rests.map(|rests| {
        format!("{name} rests after {} m for {}.", number(rests.after_m), duration(&rests.lasts).trim_end_matches(','))
    });
    [kind, age, pace, rests].into_iter().flatten().collect()
}

pub fn habit_sentence(habit: &Habit) -> String {
    let who = habit.visitor.as_ref().map_or_else(|| "she".to_owned(), |visitor| visitor_words(visitor));
    let does = match (&habit.falling, &habit.visitor) {
        (Some(falling), _) => fall_words(falling, habit.when.lasts.is_some()),
        (None, Some(_)) if habit.activity == Activity::Visit => "visits".to_owned(),
        (None, None) if habit.eats_out => "goes out for a meal".to_owned(),
        _ => phrase(&habit.activity),
    };
    let place = habit.place.as_ref().map(|place| place_words(&habit.activity, place));
    let When { time, lasts, until, nights, .. } = &habit.when;
    let lies = habit.falling.is_some_and(|falling| falling.ends == FallEnds::Rises);
    let lasting = lasts.as_ref().map(|lasts| match lies {
        true => format!("and lies there for {}", duration(lasts)),
        false => format!("for {}", duration(lasts)),
    });
    let mostly = habit.falling.and_then(|falling| falling.mostly).map(|part| format!("mostly {}", part_words(part)));
    let said = [
        Some(who),
        Some(does),
        place,
        times_words(&habit.when),
        mostly,
        time_words(time).filter(|_| times_words(&habit.when).is_none() || !is_span(time)),
        lasting,
        until.as_ref().map(|until| format!("until {}", clock(until, "until"))),
        (*nights > 0).then(|| format!("for {nights} {}", if *nights == 1 { "night" } else { "nights" })),
        habit.thing_on.as_ref().map(|thing| format!("with the {thing} on")),
        habit.key.then(|| "with a key".to_owned()),
        (!habit.does.is_empty()).then(|| {
            let does: Vec<String> = habit.does.iter().map(work_words).collect();
            format!("and {}", list(&does.iter().map(String::as_str).collect::<Vec<_>>()))
        }),
    ];
    let then = matches!(time, HabitTime::Then).then(|| "then".to_owned());
    sentence(front(&habit.when).into_iter().chain(then), &join(said, " "))
}

/// The words for the work of a visitor, alone or with the resident.
fn work_words(activity: &Activity) -> String {
    match activity.row().and_then(|row| row.help) {
        Some(_) => phrase(activity),
        None => format!("helps her {}", bare(&phrase(activity))),
    }
}

pub fn change_sentence(change: &RoutineChange) -> String {
    sentence(front(&change.when), &effect_words(change))
}

pub fn rule_sentence(rule: &RoutineRule) -> String {
    let lasts = (rule.lasts.high > 0.0).then(|| format!("for {}", duration(&rule.lasts)));
    let trigger = join([Some("whenever".to_owned()), Some(event(&rule.whenever, lasts.is_some())), lasts], " ");
    let only_if: String = rule.only_if.iter().map(circumstance).collect();
    let mut done = rule.answers().map(answer);
    let first = done.next().unwrap_or_default();
    let then: String = done.map(|step| format!(", then {step}")).collect();
    let lapse = rule.lapse.map(|lapse| {
        let later = lapse.later.map(|later| format!(" and does it {} later", duration(&later))).unwrap_or_default();
        format!(", but forgets it {}{later}", share_words(lapse.probability, "occasions"))
    });
    let chance = match rule.when.chance.probability {
        1.0 => String::new(),
        probability => format!(" {}", share_words(probability, "occasions")),
    };
    let phase = phase_words(&rule.when.phase);
    sentence(phase, &format!("{trigger}{only_if}, she {first}{chance}{then}{}", lapse.unwrap_or_default()))
}

/// Phase, days and chance, each with a comma of its own.
fn front(when: &When) -> Vec<String> {
    let mut words = phase_words(&when.phase);
    words.extend(days_words(&when.days));
    // A rate is of all days: on some days, it would be another share.
    let rate = Some(&when.chance).filter(|_| when.days == DaySelection::ALL).and_then(rate_words);
    words.extend(rate.or_else(|| chance_words(&when.chance)));
    words
}

/// "once a month", where a share would have many digits.
fn rate_words(chance: &HabitChance) -> Option<String> {
    let often = |days: f64| {
        let times = (chance.probability * days).round();
        ((1.0..=MOST_TIMES).contains(&times) && times / days == chance.probability).then_some(times as u32)
    };
    let is_plain = chance.days_a_week.is_none() && chance.becomes.is_none();
    let found = PERIODS.iter().find_map(|(name, days)| Some((name, often(*days)?))).filter(|_| is_plain);
    found.map(|(name, times)| format!("{} a {name}", count(times)))
}

/// The periods of rates, with their days on average, as the grammar has them.
const PERIODS: [(&str, f64); 2] = [("month", 30.4375), ("year", 365.25)];
/// Most times of a rate (our choice).
const MOST_TIMES: f64 = 20.0;

fn phase_words(phase: &Phase) -> Vec<String> {
    let days = |days: f64| format!("{} days", number(days));
    let from = phase.from.map(|from| format!("from {}", moment(from)));
    let over = (phase.over_days > 0.0).then(|| format!("over {}", days(phase.over_days)));
    let until = phase.until.map(|until| format!("until {}", moment(until)));
    let fading = (phase.fading_days > 0.0).then(|| format!("fading over {}", days(phase.fading_days)));
    [from, over, until, fading].into_iter().flatten().collect()
}

fn moment(moment: PhaseDay) -> String {
    moment.into()
}

pub const WEEKDAYS: [&str; 7] = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"];
pub const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];
const ORDINALS: [&str; 4] = ["first", "second", "third", "fourth"];

pub fn days_words(days: &DaySelection) -> Vec<String> {
    let names = |bits: u16, names: &[&str]| {
        let set = names.iter().enumerate().filter(|(i, _)| bits & 1 << i != 0).map(|(_, name)| *name);
        list(&set.collect::<Vec<_>>())
    };
    let weekdays = names(days.weekdays.into(), &WEEKDAYS);
    let is_one = days.weekdays.count_ones() == 1;
    let in_month = match days.months {
        0xfff => "the month".to_owned(),
        months => names(months, &MONTHS),
    };
    let of_month = match days.of_month {
        all if all == DaySelection::ALL.of_month => None,
        DaySelection::LAST_WEEK if is_one => Some(format!("on the last {weekdays} of {in_month}")),
        (first, last) if is_one && first % 7 == 1 && first <= 22 && last == first + 6 => {
            Some(format!("on the {} {weekdays} of {in_month}", ORDINALS[usize::from(first) / 7]))
        }
        (first, last) if first == last => Some(format!("on day {first} of {in_month}")),
        (first, last) => Some(format!("from day {first} to {last} of {in_month}")),
    };
    let mut words = Vec::new();
    let says_month = of_month.is_some();
    match (of_month, days.every) {
        (Some(of_month), _) => words.push(of_month),
        (None, 0 | 1) if days.weekdays == DaySelection::ALL.weekdays => {}
        (None, 0 | 1) if days.weekdays == 0b001_1111 => words.push("on weekdays".to_owned()),
        (None, 0 | 1) if days.weekdays == 0b110_0000 => words.push("at weekends".to_owned()),
        (None, 0 | 1) => words.push(format!("on {weekdays}")),
        (None, every) if days.weekdays == DaySelection::ALL.weekdays => words.push(format!("every {every} days")),
        (None, 2) if is_one => words.push(format!("every other {weekdays}")),
        (None, every) if is_one => words.push(format!("every {every} weeks on {weekdays}")),
        (None, every) => words.extend([format!("every {every} days"), format!("on {weekdays}")]),
    }
    if days.months != DaySelection::ALL.months && !says_month {
        words.push(format!("in {}", names(days.months, &MONTHS)));
    }
    words.extend(days.kind.map(|kind| format!("on {} days", kind.word())));
    words.extend(days.weather.map(|weather| format!("on {} days", weather.word())));
    words.extend(match days.poor_nights {
        0 => None,
        1 => Some("after a poor night".to_owned()),
        nights => Some(format!("after {nights} poor nights in a row")),
    });
    if let Some(DayEpisode { every_days, lasts_days }) = days.episode {
        let lasts = if lasts_days == 1 { "1 day".to_owned() } else { format!("{lasts_days} days") };
        words.extend([format!("about every {every_days} days"), format!("for {lasts}")]);
    }
    words
}

fn chance_words(chance: &HabitChance) -> Option<String> {
    match (chance.days_a_week, chance.becomes) {
        (Some(days), _) => Some(format!("{} a week", count(days.into()))),
        (None, Some((becomes, by))) => Some(format!(
            "{} at first, {} by {}",
            share_words(chance.probability, "days"),
            share_words(becomes, "days"),
            moment(by)
        )),
        (None, None) if chance.probability == 1.0 => None,
        (None, None) => Some(share_words(chance.probability, "days")),
    }
}

fn times_words(when: &When) -> Option<String> {
    let a = match when.time {
        HabitTime::Within(PartOfDay::Night) => " a night",
        HabitTime::Within(PartOfDay::Day) => " during the day",
        _ => "",
    };
    let in_all = if when.is_total { " in all" } else { "" };
    match when.times {
        (1, 1) if when.is_total => Some(format!("once{a}{in_all}")),
        (1, 1) => None,
        (least, most) if least == most => Some(format!("{}{a}{in_all}", count(least))),
        (least, most) => Some(format!("{least} to {most} times{a}{in_all}")),
    }
}

fn count(times: u32) -> String {
    match times {
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        times => format!("{times} times"),
    }
}

/// Whether the repetitions name the part of the day, as in "twice a night".
fn is_span(time: &HabitTime) -> bool {
    matches!(time, HabitTime::Within(PartOfDay::Night | PartOfDay::Day))
}

fn time_words(time: &HabitTime) -> Option<String> {
    let gap = |gap: &Option<Fuzzy>, word: &str, of: &Activity| {
        let gap = gap.as_ref().map(|gap| format!("{} ", duration(gap))).unwrap_or_default();
        format!("{gap}{word} she {}", phrase(of))
    };
    match time {
        HabitTime::AnyTime | HabitTime::Then => None,
        HabitTime::At(at) if at.from == at.to => Some(format!("at {}", clock(at, "at"))),
        HabitTime::At(at) => Some(format!("between {}", clock(at, "between"))),
        HabitTime::Within(part) => Some(part_words(*part)),
        HabitTime::After(of, by) => Some(gap(by, "after", of)),
        HabitTime::Before(of, by) => Some(gap(by, "before", of)),
        HabitTime::With(of) => Some(format!("while she {}", phrase(of))),
    }
}

/// Most days in "on 2 of 7 days" (our choice): a year.
const MOST_DAYS_OF_SHARE: u32 = 366;

/// "on 30 % of days"; "on 1 of 14 days", if a percentage would need many digits.
fn share_words(share: f64, of: &str) -> String {
    let percent = percent(share);
    let of_days = |days: u32| {
        let some = (share * f64::from(days)).round();
        (some >= 1.0 && some / f64::from(days) == share).then(|| format!("on {} of {days} {of}", number(some)))
    };
    let is_long = number(percent).len() > "12.25".len();
    let counted =
        Some(of).filter(|of| is_long && *of == "days").and_then(|_| (2..=MOST_DAYS_OF_SHARE).find_map(of_days));
    counted.unwrap_or_else(|| format!("on {} % of {of}", number(percent)))
}

/// The shortest percentage of a share: 0.07 is 7 %, although 0.07 × 100 is 7.000000000000001 in binary.
fn percent(share: f64) -> f64 {
    let exact = share * 100.0;
    let scales = std::iter::successors(Some(1.0), |scale| Some(scale * 10.0)).take(13);
    scales.map(|scale: f64| (exact * scale).round() / scale).find(|percent| percent / 100.0 == share).unwrap_or(exact)
}

/// The words of a visitor: a name, or the relation to the resident.
fn visitor_words(visitor: &str) -> String {
    match visitor.chars().next().is_some_and(char::is_uppercase) {
        true => visitor.to_owned(),
        false => format!("her {visitor}"),
    }
}

fn fall_words(falling: &Falling, lies: bool) -> String {
    let slowly = falling.slowly.then(|| "slowly".to_owned());
    let from = match falling.from {
        FallsFrom::Walking => None,
        FallsFrom::WayToToilet => Some("on the way to the bathroom"),
        FallsFrom::Rising => Some("while getting up from her chair"),
        FallsFrom::Seat => Some("out of her chair"),
        FallsFrom::Bed => Some("out of bed"),
    };
    let ends = match falling.ends {
        FallEnds::Rises => None,
        FallEnds::Found => Some("and lies there until somebody comes"),
        FallEnds::Phone => Some("and crawls to the phone"),
    };
    let ends = ends.filter(|_| !lies);
    join([Some("falls".to_owned()), slowly, from.map(str::to_owned), ends.map(str::to_owned)], " ")
}

fn event(trigger: &RuleTrigger, lasts: bool) -> String {
    match trigger {
        RuleTrigger::On(thing) => format!("the {thing} has been on"),
        RuleTrigger::At(place) => format!("she has been {} the {place}", preposition(place)),
        RuleTrigger::Away => "she has been away".to_owned(),
        RuleTrigger::InBed => "she has been in bed".to_owned(),
        RuleTrigger::Rings(thing) => format!("the {thing} is turned on"),
        RuleTrigger::Dark(room) => format!("it gets dark{}", in_room(room)),
        RuleTrigger::Company(who) if !lasts => format!("{} comes", somebody(who)),
        RuleTrigger::Alone => "nobody is there".to_owned(),
        RuleTrigger::Doing(activity) if !lasts => format!("she starts to {}", bare(&phrase(activity))),
        RuleTrigger::Done(activity) => format!("she has finished {}", gerund(&phrase(activity))),
        RuleTrigger::Between(from, _) if !lasts => {
            format!("it is {}", clock(&Fuzzy::around(*from, PLAIN_TIME_S), "at"))
        }
        RuleTrigger::Follows => "she does so".to_owned(),
        RuleTrigger::Wakes => "she wakes at night".to_owned(),
        state => so(state, true),
    }
}

fn circumstance(one: &Circumstance) -> String {
    format!(" and {}", so(&one.state, one.holds))
}

fn so(state: &RuleTrigger, holds: bool) -> String {
    let not = if holds { "" } else { "not " };
    match state {
        RuleTrigger::On(thing) | RuleTrigger::Rings(thing) => format!("the {thing} is {not}on"),
        RuleTrigger::At(place) => format!("she is {not}{} the {place}", preposition(place)),
        RuleTrigger::Away => format!("she is {not}away"),
        RuleTrigger::InBed => format!("she is {not}in bed"),
        RuleTrigger::Dark(room) => format!("it is {not}dark{}", in_room(room)),
        RuleTrigger::Company(who) => format!("{} is {not}there", somebody(who)),
        RuleTrigger::Alone => format!("she is {not}alone"),
        RuleTrigger::Sitting => format!("she is {not}sitting"),
        RuleTrigger::Doing(activity) | RuleTrigger::Done(activity) => {
            format!("she is {not}{}", gerund(&phrase(activity)))
        }
        RuleTrigger::Between(from, to) => {
            let at = |seconds: f64| clock(&Fuzzy::around(seconds, PLAIN_TIME_S), "until");
            match (*from, *to) {
                (from, DAY_S) => format!("it is {not}after {}", at(from)),
                (0.0, to) => format!("it is {not}before {}", at(to)),
                (from, to) => format!("it is {not}between {} and {}", at(from), at(to)),
            }
        }
        RuleTrigger::Follows => "she does so".to_owned(),
        RuleTrigger::Wakes => "she wakes at night".to_owned(),
    }
}

fn in_room(room: &Option<String>) -> String {
    room.as_ref().map(|room| format!(" in the {room}")).unwrap_or_default()
}

fn somebody(who: &Option<String>) -> String {
    who.as_ref().map_or_else(|| "somebody".to_owned(), |who| visitor_words(who))
}

/// "watches television" is "watching television".
fn gerund(phrase: &str) -> String {
    let verb = bare(phrase);
    let (verb, rest) = verb.split_once(' ').unwrap_or((&verb, ""));
    let verb = match verb {
        "get" | "nap" | "sit" | "put" | "knit" => format!("{verb}{}ing", &verb[verb.len() - 1..]),
        "lie" => "lying".to_owned(),
        verb if verb.ends_with('e') && !verb.ends_with("ee") => format!("{}ing", &verb[..verb.len() - 1]),
        verb => format!("{verb}ing"),
    };
    join([Some(verb), Some(rest.to_owned()).filter(|rest| !rest.is_empty())], " ")
}

fn answer(answer: &Response) -> String {
    match answer {
        Response::Turn { thing, on: true } => format!("turns on the {thing}"),
        Response::Turn { thing, on: false } => format!("turns off the {thing}"),
        Response::Do { activity, place, lasts } => {
            let place = place.as_ref().map(|place| place_words(activity, place));
            let lasts = lasts.as_ref().map(|lasts| format!("for {}", duration(lasts)));
            join([Some(phrase(activity)), place, lasts], " ")
        }
    }
}

fn place_words(activity: &Activity, place: &str) -> String {
    let word = match activity {
        Activity::Other(words) if words == "goes" => "to",
        Activity::Other(words) if ["checks", "looks at", "looks after"].contains(&words.as_str()) => {
            return format!("the {place}");
        }
        _ => preposition(place),
    };
    format!("{word} the {place}")
}

/// As people say it of the last word of a name; "at" is always understood.
fn preposition(place: &str) -> &'static str {
    match place.rsplit(' ').next().unwrap_or_default().to_lowercase().as_str() {
        "armchair" | "recliner" | "bed" | "bedroom" | "bathroom" | "kitchen" | "room" | "hall" | "hallway"
        | "study" | "garden" | "shower" | "bath" => "in",
        "sofa" | "couch" | "toilet" | "balcony" | "terrace" => "on",
        _ => "at",
    }
}

fn list(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

/// A sentence of front parts and a clause, with a capital letter and one full stop.
fn sentence(front: impl IntoIterator<Item = String>, clause: &str) -> String {
    let mut text: String = front.into_iter().map(|part| format!("{part}, ")).collect();
    text += clause.trim_end_matches(',');
    text = text.replace(",,", ",");
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).chain(['.']).collect())
}
