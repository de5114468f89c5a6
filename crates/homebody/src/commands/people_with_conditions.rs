//! People who differ as those of a cohort do, each with a condition or without one, for experiments on alerts.

use crate::failure::Failure;
use homebody_core::random::Stream;
use homebody_core::scenario::link::LinkFile;
use homebody_core::scenario::resident::DriverFile;
use homebody_experiment::alerting::Person;
use homebody_experiment::measures::LoggedLife;
use homebody_experiment::walk_back::Home;
use homebody_kit::{OpenScenario, Source};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

/// The day on which conditions begin, counted from 0.
pub const ONSET: usize = 60;

/// The conditions that come with the program, with the days in which they grow (ours): infections take 2 to 5 days, heart failure 1
/// to 3 weeks, depression 3 to 6 and frailty 3 to 8, of which this is the middle; grief and the weeks after a hospital begin at
/// once.
pub const CONDITIONS: [(&str, usize); 8] = [
    ("cognitive-decline", 42),
    ("depression", 28),
    ("frailty", 42),
    ("grief", 0),
    ("heart-failure", 14),
    ("insomnia", 14),
    ("recovery", 0),
    ("urinary-tract-infection", 4),
];
const SEVERITIES: [&str; 3] = ["mild", "moderate", "severe"];

/// Everybody who is to live: the first resident of a scenario, once for each of those who differ.
pub struct People {
    /// Nobody's condition first, then those that were asked for; of each the severities.
    kinds: Vec<(Person, OpenScenario)>,
    count: u32,
    days: u32,
    seed: u64,
}

impl People {
    /// So many people in the home of a scenario, each with one of the conditions or none, in turn.
    pub fn of(
        scenario: &OpenScenario,
        conditions: &[(&'static str, usize)],
        count: u32,
        (days, seed): (u32, u64),
    ) -> Result<People, Failure> {
        let none = Person { condition: None, onset: ONSET, height: 0 };
        let mut kinds =
            vec![none; SEVERITIES.len()].into_iter().map(|person| (person, scenario.clone())).collect::<Vec<_>>();
        for &(condition, height) in conditions {
            for severity in SEVERITIES {
                let person = Person { condition: Some(condition), onset: ONSET, height };
                kinds.push((person, with(scenario, person, severity)?));
            }
        }
        Ok(People { kinds, count, days, seed })
    }

    /// Everybody lives, on all processors, and something is asked of each: who it is, their number, and the home they live in.
    pub fn each<T: Send>(
        &self,
        ask: impl Fn(&Lives) -> Result<T, Failure> + Sync,
    ) -> Result<Vec<(Person, T)>, Failure> {
        let progress = ProgressBar::new(u64::from(self.count));
        let style = ProgressStyle::with_template("{bar:40} {pos} of {len} people  {eta} left");
        progress.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let conditions = self.kinds.len() / SEVERITIES.len();
        let live = |number: u32| {
            let (condition, severity) = (number as usize % conditions, number as usize / conditions % SEVERITIES.len());
            let (person, opened) = &self.kinds[condition * SEVERITIES.len() + severity];
            let unit = Stream::named(self.seed, &format!("experiment/person/{number}")).unit();
            let lives =
                Lives { opened, days: self.days, seed: (unit * (1_u64 << 53) as f64) as u64, number: number as usize };
            let answer = ask(&lives);
            progress.inc(1);
            Ok((*person, answer?))
        };
        let answers = (0..self.count).into_par_iter().map(live).collect();
        progress.finish_and_clear();
        answers
    }
}

/// Somebody who is to live.
pub struct Lives<'a> {
    /// Their home, and what they show.
    pub opened: &'a OpenScenario,
    /// The number of the person.
    pub number: usize,
    days: u32,
    seed: u64,
}

impl Lives<'_> {
    /// Their days, by a link that loses nothing or another.
    pub fn live(&self, link: &LinkFile) -> Result<LoggedLife, Failure> {
        let household = self.opened.household().one_of_many();
        let scenario = self.opened.scenario().edit().link(link).load()?;
        let home = Home { scenario: &scenario, drivers: &household, people: vec![0] };
        LoggedLife::live(&home, self.seed, self.days).map_err(|error| Failure::Io(error.to_string()))
    }
}

/// The life of somebody with a condition.
fn with(scenario: &OpenScenario, person: Person, severity: &str) -> Result<OpenScenario, Failure> {
    let Some(condition) = person.condition else { return Ok(scenario.clone()) };
    let grows = if person.height > 0 { format!(", over {} days", person.height) } else { String::new() };
    let sentence = format!("\nFrom day {}{grows}, she shows {severity} {condition}.\n", person.onset + 1);
    let routine = scenario.scenario().residents.first().map(|resident| resident.file.driver.clone());
    let edit = scenario.scenario().edit();
    let entry = edit.entry().to_owned();
    let mut texts = edit.into_texts();
    match routine {
        Some(DriverFile::Routine(name)) if texts.contains_key(&name) => {
            texts.entry(name).or_default().push_str(&sentence);
        }
        _ => {
            return Err(Failure::Usage(
                "the first resident lives by no routine, so nobody can show a condition".into(),
            ));
        }
    }
    Ok(Source::of_texts(texts, entry).open()?)
}
