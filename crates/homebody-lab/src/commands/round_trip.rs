use super::locate::{each_home, single_home, with_link};
use crate::round_trip::{CheckedSentence, DAYS, drawn_routine, round_trip};
use homebody::shared::{Failure, JsonOutput, TextTable};
use homebody_core::link::form::LinkFile;
use homebody_core::names::capitalised;
use homebody_simulation::{OpenScenario, ScenarioSource};
use serde::Serialize;
use std::fmt;

/// Compare summaries of logs with the routines behind them
///
/// The homes cycle through the templates that have one resident. Each has a random routine: times of getting up and going to bed,
/// bathroom visits at night, showers, meals, outings, and a change after four weeks. Homebody simulates eight weeks, summarises the
/// last four from the log, and checks each sentence.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab round-trip
  homebody-lab round-trip --homes 40 --json round-trip.json

JSON has the numbers of \"checkable\" sentences and of those that \"agree\", and all \"sentences\".")]
pub struct RoundTripLabArguments {
    /// Number of homes and routines
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// Seed of the first routine
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    output: JsonOutput,
}

#[derive(Serialize)]
struct RoundTripExperiment {
    homes: u32,
    days: u32,
    checkable: usize,
    /// Checkable sentences that are true by the routine, to 0.8 or more.
    agree: usize,
    /// Checkable sentences that are true by the ground truth, to 0.8 or more.
    true_by_life: usize,
    sentences: Vec<CheckedSentence>,
}

impl RoundTripLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let homes: Vec<usize> = (0..self.homes as usize).collect();
        let cases = each_home(
            &homes,
            |&home| single_home(home),
            |opened, &home| {
                let seed = self.seed + home as u64;
                let opened = with_routine(opened, seed)?;
                let life = opened.household().life(0, seed);
                let Some(life) = life else { return Ok(Vec::new()) };
                with_link(&opened, &LinkFile::default(), |home| round_trip(home, &life, seed))
            },
        )?;
        let sentences = cases.concat();
        let checkable: Vec<&CheckedSentence> = sentences.iter().filter(|held| held.by_routine.is_some()).collect();
        let found = RoundTripExperiment {
            homes: self.homes,
            days: DAYS,
            checkable: checkable.len(),
            agree: checkable.iter().filter(|held| held.agrees() == Some(true)).count(),
            true_by_life: checkable.iter().filter(|held| held.is_lived()).count(),
            sentences: sentences.clone(),
        };
        output.write(&found, [])
    }
}

fn with_routine(opened: &OpenScenario, seed: u64) -> Result<OpenScenario, Failure> {
    let scenario = opened.scenario();
    let name = scenario.residents.first().map_or("", |resident| resident.file.name.as_str());
    let edit = scenario.edit().routine(0, "drawn.routine", drawn_routine(&capitalised(name), seed));
    let entry = edit.entry().to_owned();
    Ok(ScenarioSource::from_texts(edit.into_texts(), entry).open()?)
}

impl fmt::Display for RoundTripExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let RoundTripExperiment { homes, days, checkable, agree, true_by_life, sentences } = self;
        let share = 100.0 * *agree as f64 / (*checkable).max(1) as f64;
        writeln!(
            f,
            "{homes} routines of {days} days: {} sentences from the logs, {checkable} of them checkable",
            sentences.len()
        )?;
        writeln!(f, "{agree} agree with the routine ({share:.0} %); {true_by_life} agree with the ground truth\n")?;
        let mut measures: Vec<&str> = sentences.iter().map(|held| held.measure).collect();
        measures.sort_unstable();
        measures.dedup();
        let table = TextTable::new("-18 measure|10 sentences|10 checkable|7 agree|12 by truth");
        f.write_str(&table.heading())?;
        for measure in measures {
            let of: Vec<&CheckedSentence> = sentences.iter().filter(|held| held.measure == measure).collect();
            let checkable = of.iter().filter(|held| held.by_routine.is_some()).count();
            let agree = of.iter().filter(|held| held.agrees() == Some(true)).count();
            let lived = of.iter().filter(|held| held.is_lived()).count();
            f.write_str(&table.row(&[&measure, &of.len(), &checkable, &agree, &lived]))?;
        }
        let others: Vec<&CheckedSentence> = sentences.iter().filter(|held| held.agrees() == Some(false)).collect();
        if !others.is_empty() {
            writeln!(f, "\nSentences that do not agree:")?;
        }
        for held in others {
            writeln!(f, "  {}\n    {}", held.sentence, held.why.as_deref().unwrap_or_default())?;
        }
        Ok(())
    }
}
