//! `homebody new`: a scenario of one's own, from one that works.

use crate::beginning::begin;
use crate::failure::Failure;
use crate::print::{tell, write_file};
use homebody_kit::Template;
use serde_json::json;
use std::path::PathBuf;

/// Begins a scenario of your own in a new folder, from a template that works.
#[derive(clap::Args)]
#[command(after_help = format!("Templates:
{}
Example:
  homebody new my-home --template tigerplace && homebody run my-home", templates()))]
pub struct Arguments {
    /// The folder to create
    folder: PathBuf,
    /// The scenario to start from
    #[arg(long, default_value = "tigerplace", value_parser = template)]
    template: Template,
}

/// A template by its name.
fn template(name: &str) -> Result<Template, String> {
    Template::named(name).map_err(|_| {
        let names: Vec<_> = Template::all().map(Template::name).collect();
        format!("there is none of that name; there are: {}", names.join(", "))
    })
}

/// A line for each template, of what its scenario says about itself.
fn templates() -> String {
    let width = Template::all().map(|template| template.name().len()).max().unwrap_or(0);
    let line = |template: Template| {
        let text = template.files().find(|(name, _)| name == "scenario.json").map(|(_, text)| text);
        let scenario: serde_json::Value = text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
        format!("  {:width$}  {}\n", template.name(), first_words(scenario["about"].as_str().unwrap_or_default()))
    };
    Template::all().map(line).collect()
}

/// As much of the first sentence as fits in a line.
fn first_words(about: &str) -> &str {
    const WIDTH: usize = 110;
    let ends = |(at, mark): (usize, &str)| {
        let rest = about[at + mark.len()..].strip_prefix(' ');
        // "et al. 2016" goes on.
        rest.is_some_and(|rest| mark != "." || rest.starts_with(char::is_uppercase)).then_some(at)
    };
    let end = about.match_indices([':', ';', '.']).find_map(ends).unwrap_or(about.len());
    let sentence = about[..end].trim_end_matches('.');
    let fits = |&at: &usize| sentence[..at].chars().count() <= WIDTH;
    let commas = sentence.match_indices(", ").map(|(at, _)| at);
    let end = commas.chain([sentence.len()]).filter(fits).max().unwrap_or(sentence.len());
    &sentence[..end]
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let folder = &self.folder;
        begin(folder, |name| self.write(name))?;
        tell(format_args!("{} is ready.\n  homebody check {0}\n  homebody run {0}", folder.display()));
        Ok(())
    }

    fn write(&self, name: &str) -> Result<(), Failure> {
        let (name, template) = (json!(name), json!(self.template.name()));
        for (file, text) in self.template.files() {
            // The schemas of the repository are two folders up, ours are right here; and it has a name of its own.
            let text = text
                .replace("\"../../schemas/", "\"./schemas/")
                .replace(&format!("\"name\": {template}"), &format!("\"name\": {name}"));
            write_file(&self.folder.join(file), text.as_bytes(), false)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_is_told_in_a_line() {
        let long = "A house (Twomey et al. 2016), with one motion sensor in each room that had one, of which there were nine or ten, \
            and a walk through all of them. Its date is ours.";
        let short = "A house (Twomey et al. 2016), with one motion sensor in each room that had one";
        assert_eq!(first_words(long), short);
        assert_eq!(first_words("A couple: Henry, and Ruth."), "A couple");
        assert_eq!(first_words("A life. Another."), "A life");
        assert_eq!(first_words("A life."), "A life");
        assert_eq!(first_words(""), "");
        for line in templates().lines() {
            let words = line.split_whitespace().count();
            assert!(words > 4 && line.chars().count() < 140, "{line}");
        }
        assert_eq!(templates().lines().count(), Template::all().count());
    }
}
