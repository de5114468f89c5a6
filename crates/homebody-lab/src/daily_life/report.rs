//! The report: a line for each figure, and reasons for the figures outside.

use super::figures::number;
use super::{DailyLifeExperiment, FigureLine};
use std::fmt;

impl FigureLine {
    fn ours_in_words(&self) -> String {
        self.ours.map_or("too little to tell".into(), |ours| number(ours, self.unit))
    }

    /// The spread between people; that of a time of day is a duration.
    fn between_in_words(&self) -> String {
        let between = self.between.map(|between| match self.unit {
            "clock" => number(between * 60.0, "min"),
            unit => number(between, unit),
        });
        between.unwrap_or_default()
    }

    fn verdict(&self) -> &'static str {
        match self.inside {
            Some(true) => "inside",
            Some(false) => "OUTSIDE",
            None => "",
        }
    }
}

impl fmt::Display for DailyLifeExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let DailyLifeExperiment { people, days, seed, .. } = self;
        writeln!(f, "{people} generated older adults at home, {days} days each after the first (seed {seed})")?;
        writeln!(f, "A mean may be off by half the published spread, a number without one by 15 %, a spread by half.")?;
        for group in self.lines.chunk_by(|a, b| a.of == b.of) {
            let title = group.first().map_or("", |line| line.of);
            writeln!(f, "\n  {title:<25} {:>12} {:>10}  {:<9} {:<27} source", "ours", "people SD", "", "published")?;
            for line in group {
                let (what, ours, between) = (line.what, line.ours_in_words(), line.between_in_words());
                let FigureLine { published, source, .. } = line;
                writeln!(f, "  {what:<25} {ours:>12} {between:>10}  {:<9} {published:<27} {source}", line.verdict())?;
            }
        }
        let inside = self.lines.iter().filter(|line| line.inside == Some(true)).count();
        let judged = self.lines.iter().filter(|line| line.inside.is_some()).count();
        writeln!(f, "\n{inside} of {judged} figures that have a norm lie inside.")?;
        if self.outside().next().is_some() {
            writeln!(f, "Outside, and why that may be:\n")?;
        }
        for line in self.outside() {
            let FigureLine { what, published, guess, .. } = line;
            writeln!(f, "  {what}: {} beside {published}; {guess}", line.ours_in_words())?;
        }
        Ok(())
    }
}
