//! `homebody alerts`: changes of daily life.

use super::measures::MeasuresSource;
use super::result_output::JsonOutput;
use super::row_destinations::{RowDestinations, row};
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{print_json_text, print_text};
use homebody_analysis::alerts::{Alert, Rules, USUAL, alerts};
use homebody_log::LogError;
use homebody_log::records::Records;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Duration;

homebody_core::messages! {
    /// Problems with alerts and their rules.
    pub enum AlertsMessage in "alerts" {
        /// With `--follow`, the command runs until you stop it and prints each alert as it comes. It has no end at which it could
        /// write a file.
        FilesWithFollow error "files-with-follow" ("with --follow, Homebody prints alerts and cannot write them to a file")
            hint ("pass --out jsonl:- to print the alerts as lines of JSON");
        /// `--rules` names a file with rules of your own. Without it, Homebody uses the default rules.
        NoRules { file: PathBuf } error "no-rules" ("the file of rules {file} does not exist", file = file.display())
            hint ("correct the path; docs/reference/measures.md lists the default rules");
    }
}

/// Report changes from the resident's own baseline, day by day
///
/// Homebody compares each measure of a day with the resident's last two weeks. Days away and incomplete days do not count, nor do
/// measures that need a silent sensor; a silent sensor has its own alert. --rules replaces the default rules by those of a JSON
/// file; docs/reference/measures.md lists the default rules.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody alerts runs/tigerplace-depression-1
  homebody alerts casas:tm000.txt --home my-home --json
  homebody alerts runs/tigerplace-1 --rules rules.json
  homebody alerts runs/tigerplace-1 --out care.db
  homebody alerts casas:home.txt --follow --out jsonl:-

{EXIT_CODES}."))]
pub struct AlertsArguments {
    #[command(flatten)]
    measured: MeasuresSource,
    /// JSON file with alert rules, instead of the default rules
    #[arg(long, value_name = "FILE")]
    rules: Option<PathBuf>,
    /// Follow the log as it grows, and print each new alert until you stop the program
    #[arg(long)]
    follow: bool,
    /// Seconds between two reads of the log with --follow
    #[arg(long, value_name = "SECONDS", default_value_t = 60, requires = "follow",
          value_parser = clap::value_parser!(u64).range(1..=86_400))]
    poll: u64,
    #[command(flatten)]
    programs: RowDestinations,
    #[command(flatten)]
    output: JsonOutput,
}

impl AlertsArguments {
    pub fn run(self) -> Result<(), Failure> {
        let rules = rules(self.rules.as_deref())?;
        if self.follow {
            return self.follow(&rules);
        }
        let read = self.measured.read()?;
        let output = self.output.check(&read.sources)?.silent_if(self.programs.is_printed());
        self.programs.check(false, &read.sources, self.output.replaces())?;
        let measures = self.measured.measures(&read)?;
        let alerts = alerts(&measures, &rules);
        self.programs.store(&records(&alerts.name, &alerts.alerts), &Default::default, self.output.replaces())?;
        output.write(&alerts, [])
    }

    /// Prints all alerts, and then each new one: one line each, as JSON if rows go to standard output.
    fn follow(&self, rules: &Rules) -> Result<(), Failure> {
        if !self.output.is_empty() || !self.programs.is_empty_or_printed() {
            return Err(Failure::asked(AlertsMessage::FilesWithFollow));
        }
        let mut printed: Vec<Alert> = Vec::new();
        loop {
            // A log without a complete day, or one that is being written, is read again.
            let found = self.measured.read().and_then(|read| self.measured.measures(&read));
            match found {
                Err(failure) if printed.is_empty() && !self.measured.is_there() => return Err(failure),
                Err(_) => {}
                Ok(measures) => {
                    let all = alerts(&measures, rules);
                    let is_printed = |new: &Alert| {
                        printed.iter().any(|printed| (printed.date, &printed.rule) == (new.date, &new.rule))
                    };
                    let new: Vec<Alert> = all.alerts.into_iter().filter(|alert| !is_printed(alert)).collect();
                    match self.programs.is_printed() {
                        true => print_json_text(&records(&all.name, &new).lines())?,
                        false => {
                            new.iter().try_for_each(|alert| print_text(&format!("{} {}\n", alert.date, alert.words)))?
                        }
                    }
                    printed.extend(new);
                }
            }
            std::thread::sleep(Duration::from_secs(self.poll));
        }
    }
}

fn records(log: &str, alerts: &[Alert]) -> Records {
    let of = |alert: &Alert| {
        let mut row = row(alert);
        row.insert("log".into(), log.into());
        row
    };
    let columns = &["log", "date", "rule", "measures", "is_more", "value", "usual", "sd", "shown_by", "words"];
    Records { kind: "alert", columns, rows: alerts.iter().map(of).collect() }
}

pub fn rules(path: Option<&Path>) -> Result<Rules, Failure> {
    let Some(path) = path else {
        return Ok(Rules::read(USUAL)?);
    };
    let text = fs::read_to_string(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::asked(AlertsMessage::NoRules { file: path.to_owned() }),
        _ => LogError::reading(path, error).into(),
    })?;
    Rules::read(&text).map_err(|problems| Failure::in_file(path, problems))
}
