//! `homebody explain`: the long form of a message.

use super::catalogue;
use super::messages::ExplainMessage;
use crate::failure::Failure;
use crate::print::print_text;
use homebody_core::messages::CatalogueEntry;
use homebody_core::nearest::nearest;

/// Explain a message by its code
///
/// Messages have codes such as `log::exists`, in brackets after the word error or warning.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody explain log::exists    explain one message
  homebody explain log            list the messages about logs
  homebody explain                list all messages")]
pub struct ExplainArguments {
    /// The code of a message, or the part before `::` (default: list all messages)
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

impl ExplainArguments {
    pub fn run(self) -> Result<(), Failure> {
        if let Some(code) = self.code.as_deref().map(bare).filter(|code| EXPERIMENTS.contains(&area(code))) {
            return Err(Failure::asked(ExplainMessage::OfExperiments { code: code.to_owned() }));
        }
        explain(self.code, catalogue::all())
    }
}

/// The areas of messages that only the program `homebody-lab` has.
const EXPERIMENTS: [&str; 4] = ["experiment", "located", "recogniser", "sphere"];

/// A code without the brackets around it.
fn bare(code: &str) -> &str {
    code.trim_matches(['[', ']'])
}

/// The part of a code before `::`.
fn area(code: &str) -> &str {
    code.split("::").next().unwrap_or_default()
}

/// Prints the long form of a message, or a list of the messages of an area or of all areas.
pub fn explain(
    code: Option<String>,
    all: impl Iterator<Item = &'static CatalogueEntry> + Clone,
) -> Result<(), Failure> {
    let Some(code) = code else {
        return print_text(&list(all));
    };
    let code = bare(&code);
    if let Some(entry) = all.clone().find(|entry| entry.code == code) {
        return print_text(&in_full(entry));
    }
    let of_area = all.clone().filter(|entry| area(entry.code) == code);
    if of_area.clone().next().is_some() {
        return print_text(&list(of_area));
    }
    let nearest = nearest(code, all.map(|entry| entry.code)).map(str::to_owned);
    Err(Failure::asked(ExplainMessage::UnknownCode { code: code.to_owned(), nearest }))
}

fn list<'a>(entries: impl Iterator<Item = &'a CatalogueEntry> + Clone) -> String {
    let width = entries.clone().map(|entry| entry.code.len()).max().unwrap_or_default();
    entries.map(|entry| format!("{:width$}  {}\n", entry.code, entry.text)).collect()
}

fn in_full(entry: &CatalogueEntry) -> String {
    let mut text = format!("{}[{}]: {}\n", entry.severity.word(), entry.code, entry.text);
    if let Some(hint) = entry.hint {
        text += &format!("  hint: {hint}\n");
    }
    text += "\n";
    text.extend(entry.about.lines().map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line))));
    if !entry.data.is_empty() {
        text += &format!("\nData, under \"data\" in JSON: {}\n", entry.data.join(", "));
    }
    text
}
