//! `homebody alerts`: changes of daily life.

use super::measures::MeasuresSource;
use super::result_output::JsonOutput;
use super::row_destinations::{RowDestinations, row};
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{print_json_text, print_text};
use homebody_analysis::alerts::{LogAlerts, Rules, alerts};
use homebody_analysis::episodes::{WatchOptions, WatchedDays, watch};
use homebody_analysis::measures::Measures;
use homebody_log::LogError;
use homebody_log::records::Records;
use jiff::civil::Date;
use serde::Serialize;
use serde_json::{Map, Value};
use std::fmt;
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

/// Report changes of daily life, with their beginning and end
///
/// Homebody compares each day with a reference: the first four weeks that count, or four weeks from a day that --reference names.
/// Measures that change together are the signs of one episode. It has a beginning, and an end once the days are as usual again.
/// Days away and incomplete days do not count, nor do measures that need a silent sensor. Conditions that make such signs in
/// simulated people are named with their likelihood ratios. This is for research. It is not a medical device and no diagnosis.
///
/// --rules adds the alerts of rules of your own.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody alerts runs/tigerplace-depression-1
  homebody alerts casas:tm000.txt --home my-home --json
  homebody alerts runs/tigerplace-1 --reference 2009-04-20
  homebody alerts runs/tigerplace-1 --rules rules.json
  homebody alerts runs/tigerplace-1 --out care.db
  homebody alerts casas:home.txt --follow --out jsonl:-

{EXIT_CODES}."))]
pub struct AlertsArguments {
    #[command(flatten)]
    measured: MeasuresSource,
    /// First day of a new reference, such as the return from a hospital; repeatable
    #[arg(long, value_name = "DATE")]
    reference: Vec<Date>,
    /// JSON file with alert rules of your own
    #[arg(long, value_name = "FILE")]
    rules: Option<PathBuf>,
    /// Follow the log as it grows, and print each new change until you stop the program
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

/// The episodes of a log, with the alerts of the user's own rules.
#[derive(Serialize)]
struct AlertsAnswer {
    #[serde(flatten)]
    watched: WatchedDays,
    /// With `--rules` only.
    #[serde(skip_serializing_if = "Option::is_none")]
    rules: Option<LogAlerts>,
}

impl AlertsArguments {
    pub fn run(self) -> Result<(), Failure> {
        let rules = self.rules.as_deref().map(rules).transpose()?;
        if self.follow {
            return self.follow(rules.as_ref());
        }
        let read = self.measured.read()?;
        let output = self.output.check(&read.sources)?.silent_if(self.programs.is_printed());
        self.programs.check(false, &read.sources, self.output.replaces())?;
        let answer = self.answer(&self.measured.measures(&read)?, rules.as_ref());
        let records = Records { kind: "alert", columns: COLUMNS, rows: answer.rows() };
        self.programs.store(&records, &Default::default, self.output.replaces())?;
        output.write(&answer, [])
    }

    fn answer(&self, measures: &Measures, rules: Option<&Rules>) -> AlertsAnswer {
        let options = WatchOptions { marked: &self.reference, ..WatchOptions::default() };
        AlertsAnswer { watched: watch(measures, options), rules: rules.map(|rules| alerts(measures, rules)) }
    }

    /// Prints all changes, and then each new one: one line each, as JSON if rows go to standard output.
    fn follow(&self, rules: Option<&Rules>) -> Result<(), Failure> {
        if !self.output.is_empty() || !self.programs.is_empty_or_printed() {
            return Err(Failure::asked(AlertsMessage::FilesWithFollow));
        }
        let mut printed: Vec<Map<String, Value>> = Vec::new();
        loop {
            // A log without a complete day, or one that is being written, is read again.
            let found = self.measured.read().and_then(|read| self.measured.measures(&read));
            match found {
                Err(failure) if printed.is_empty() && !self.measured.is_there() => return Err(failure),
                Err(_) => {}
                Ok(measures) => {
                    let mut rows = self.answer(&measures, rules).rows();
                    rows.retain(|row| !printed.contains(row));
                    match self.programs.is_printed() {
                        true => {
                            let records = Records { kind: "alert", columns: COLUMNS, rows: rows.clone() };
                            print_json_text(&records.lines())?;
                        }
                        false => rows.iter().try_for_each(|row| print_text(&line(row)))?,
                    }
                    printed.extend(rows);
                }
            }
            std::thread::sleep(Duration::from_secs(self.poll));
        }
    }
}

const COLUMNS: &[&str] =
    &["log", "date", "rule", "since", "measures", "is_more", "value", "usual", "sd", "shown_by", "words"];

impl AlertsAnswer {
    /// A row for each change that was found, and for each alert of a rule, by date.
    fn rows(&self) -> Vec<Map<String, Value>> {
        let news = self.watched.news.iter().map(|news| {
            let mut row = row(news);
            let kind = row.remove("kind").unwrap_or_default();
            row.insert("rule".into(), format!("episode {}", kind.as_str().unwrap_or_default()).into());
            row
        });
        let mut rows: Vec<Map<String, Value>> =
            news.chain(self.rules.iter().flat_map(|rules| rules.alerts.iter().map(row))).collect();
        rows.iter_mut().for_each(|row| _ = row.insert("log".into(), self.watched.name.as_str().into()));
        rows.sort_by_key(|row| row.get("date").and_then(Value::as_str).map(ToOwned::to_owned));
        rows
    }
}

fn line(row: &Map<String, Value>) -> String {
    let of = |key: &str| row.get(key).and_then(Value::as_str).unwrap_or_default();
    format!("{} {}\n", of("date"), of("words"))
}

impl fmt::Display for AlertsAnswer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.watched)?;
        match &self.rules {
            Some(rules) => write!(f, "\nBy your rules\n{rules}"),
            None => Ok(()),
        }
    }
}

fn rules(path: &Path) -> Result<Rules, Failure> {
    let text = fs::read_to_string(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::asked(AlertsMessage::NoRules { file: path.to_owned() }),
        _ => LogError::reading(path, error).into(),
    })?;
    Rules::read(&text).map_err(|problems| Failure::in_file(path, problems))
}
