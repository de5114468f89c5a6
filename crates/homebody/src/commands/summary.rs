//! `homebody summary`: days in words.

use super::log_input::{LogOptions, read_log};
use super::measures::MeasuresSource;
use super::messages::not_measurable;
use super::result_output::JsonOutput;
use super::row_destinations::{RowDestinations, row};
use crate::failure::{EXIT_CODES, Failure};
use homebody_analysis::summaries::{SummarySentence, SummarySubject, VerbalSummary, of_summaries, summarise};
use homebody_log::records::Records;
use serde::Serialize;
use std::fmt;

/// Summarise recent days in sentences, changes first
///
/// Each sentence is about one measure of homebody measures, on the last days of the log. Of all true sentences, Homebody picks the
/// most informative. Days away and incomplete days do not count.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody summary runs/tigerplace-depression-1
  homebody summary casas:tm000.txt --audience experts --last 28
  homebody summary runs/tigerplace-1 --compare runs/tigerplace-depression-1 --json

{EXIT_CODES}."))]
pub struct SummaryArguments {
    #[command(flatten)]
    measured: MeasuresSource,
    /// Number of days, counted back from the end of the log
    #[arg(long, value_name = "DAYS", default_value_t = 14, value_parser = clap::value_parser!(u16).range(5..=366))]
    last: u16,
    /// Audience of the sentences
    #[arg(long, value_enum, value_name = "READER", default_value_t = Reader::Carers)]
    audience: Reader,
    /// Report the distance, from 0 to 1, to the summary of this log (after Wilbik and Keller)
    #[arg(long, value_name = "LOG")]
    compare: Option<String>,
    #[command(flatten)]
    programs: RowDestinations,
    #[command(flatten)]
    output: JsonOutput,
}

/// The reader of a summary.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Reader {
    /// Plain sentences
    Carers,
    /// Sentences with figures
    Experts,
}

impl SummaryArguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = self.measured.read()?;
        let output = self.output.check(&read.sources)?.silent_if(self.programs.is_printed());
        self.programs.check(false, &read.sources, self.output.replaces())?;
        let measures = self.measured.measures(&read)?;
        let subject = self.measured.subject(&read);
        let about = SummarySubject { subject: &subject, last: self.last.into() };
        let summary = summarise(&measures, about);
        let distance = match &self.compare {
            None => None,
            Some(other) => {
                let read = read_log(other, None, &LogOptions::default())?;
                let measures = read.measures().map_err(|why| not_measurable(other, &why))?;
                Some(of_summaries(&summary, &summarise(&measures, about)))
            }
        };
        self.programs.store(&records(&summary), &Default::default, self.output.replaces())?;
        output.write(&SummaryAnswer { summary, distance, reader: self.audience }, [])
    }
}

fn records(summary: &VerbalSummary) -> Records {
    let of = |sentence: &SummarySentence| {
        let mut row = row(sentence);
        row.insert("log".into(), summary.name.clone().into());
        row
    };
    let columns = &[
        "log",
        "plain",
        "expert",
        "measure",
        "is_more",
        "quantifier",
        "set",
        "truth",
        "focus",
        "says",
        "share",
        "mean",
        "before",
        "shown_by",
    ];
    Records { kind: "sentence", columns, rows: summary.sentences.iter().map(of).collect() }
}

#[derive(Serialize)]
struct SummaryAnswer {
    #[serde(flatten)]
    summary: VerbalSummary,
    /// The distance to the summary of the other log.
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    #[serde(skip)]
    reader: Reader,
}

impl fmt::Display for SummaryAnswer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.summary.write(f, matches!(self.reader, Reader::Experts))?;
        match self.distance {
            Some(distance) => writeln!(f, "\nDistance to the other summary: {distance:.2} (0 to 1)"),
            None => Ok(()),
        }
    }
}
