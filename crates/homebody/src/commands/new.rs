//! `homebody new`: a scenario of one's own, from one that works.

use crate::beginning::begin;
use crate::failure::Failure;
use crate::folder::OWN;
use crate::print::{tell, write_file};
use include_dir::Dir;
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
    template: &'static Dir<'static>,
}

/// A template by its name.
fn template(name: &str) -> Result<&'static Dir<'static>, String> {
    OWN.get_dir(name).ok_or_else(|| {
        let names: Vec<_> = OWN.dirs().map(|dir| dir.path().display().to_string()).collect();
        format!("there is none of that name; there are: {}", names.join(", "))
    })
}

/// A line for each template, of what its scenario says about itself.
fn templates() -> String {
    let name = |template: &Dir| template.path().display().to_string();
    let width = OWN.dirs().map(|template| name(template).len()).max().unwrap_or(0);
    let line = |template: &Dir| {
        let text = template.get_file(template.path().join("scenario.json")).and_then(|file| file.contents_utf8());
        let scenario: serde_json::Value = text.and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default();
        format!("  {:width$}  {}\n", name(template), first_words(scenario["about"].as_str().unwrap_or_default()))
    };
    OWN.dirs().map(line).collect()
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
        let (name, template) = (json!(name), json!(self.template.path().display().to_string()));
        for file in self.template.files() {
            // The schemas of the repository are two folders up, ours are right here; and it has a name of its own.
            let text = String::from_utf8_lossy(file.contents())
                .replace("\"../../schemas/", "\"./schemas/")
                .replace(&format!("\"name\": {template}"), &format!("\"name\": {name}"));
            let name = file.path().file_name().unwrap_or_default();
            write_file(&self.folder.join(name), text.as_bytes(), false)?;
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
        assert_eq!(templates().lines().count(), OWN.dirs().count());
    }
}
