//! `homebody parameters`: the parameters of the models.

use crate::failure::Failure;
use crate::print::{print_json, print_text};
use homebody_core::nearest::nearest;
use homebody_core::numbers::Number;
use homebody_simulation::numbers;
use serde_json::json;
use std::collections::BTreeSet;

homebody_core::messages! {
    /// Problems with the parameters of the models.
    pub enum ParametersMessage in "parameters" {
        /// Names of parameters have parts with dots between them, such as `gait.slowest`. The command lists those that begin with the
        /// given parts.
        NoGroup { group: String, similar: String } error "no-group" ("no parameter begins with {group:?}")
            hint ("{similar}");
    }
}

/// List the parameters of the models, with units and ranges
///
/// The models are those of people, sensors and the link. `homebody run --set` changes a parameter for one run. The key "numbers" in
/// scenario.json changes it for all runs of the scenario.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody parameters
  homebody parameters gait
  homebody parameters activity.reading --json
  homebody run scenarios/tigerplace --set gait.slowest=0.25")]
pub struct ParametersArguments {
    /// List only parameters whose names begin with this, such as gait
    group: Option<String>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl ParametersArguments {
    pub fn run(self) -> Result<(), Failure> {
        let (all, group) = (numbers(), self.group.unwrap_or_default());
        let found: Vec<&Number> = all.iter().filter(|number| is_in(&number.name, &group)).collect();
        if found.is_empty() {
            let similar = hint(&group, &all);
            return Err(Failure::asked(ParametersMessage::NoGroup { group, similar }));
        }
        if self.json {
            return print_json(&json!({ "numbers": found.into_iter().map(row).collect::<Vec<_>>() }));
        }
        let wide = |width: fn(&Number) -> usize| found.iter().map(|number| width(number)).max().unwrap_or(0);
        let (names, values) = (wide(|number| number.name.len()), wide(|number| number.value.to_string().len()));
        let (units, ranges) = (wide(|number| number.unit.chars().count()), wide(|number| range(number).len()));
        let mut text = String::new();
        for number in found {
            let Number { name, value, unit, .. } = number;
            let (range, meaning) = (range(number), number.meaning());
            text += &format!("{name:names$}  {value:>values$} {unit:units$}  {range:ranges$}  {meaning}\n");
        }
        print_text(&text)
    }
}

/// The most similar name, or the names with this part, or all groups.
fn hint(asked: &str, all: &[Number]) -> String {
    let names = || all.iter().map(|number| &*number.name);
    let groups: BTreeSet<&str> = names().map(|name| name.split('.').next().unwrap_or(name)).collect();
    if let Some(near) = nearest(asked, groups.iter().copied().chain(names())) {
        return format!("did you mean {near:?}?");
    }
    let part = asked.trim_matches('.').to_lowercase();
    let has_it: Vec<&str> = names().filter(|name| !part.is_empty() && name.contains(&part)).take(FEW).collect();
    match has_it.is_empty() {
        false => format!("there are {}", has_it.join(", ")),
        true => format!("names begin with {}", groups.into_iter().collect::<Vec<_>>().join(", ")),
    }
}

/// Most names in a hint (our choice).
const FEW: usize = 5;

/// True if the name is the group, or starts with it up to a dot.
fn is_in(name: &str, group: &str) -> bool {
    let group = group.trim_end_matches('.');
    group.is_empty() || name.strip_prefix(group).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn range(number: &Number) -> String {
    format!("{} to {}", number.least, number.most)
}

fn row(number: &Number) -> serde_json::Value {
    let (of_crate, file) = number.place();
    json!({
        "name": number.name, "value": number.value, "unit": number.unit, "least": number.least, "most": number.most,
        "what": number.meaning(), "crate": of_crate, "file": file,
    })
}
