use super::overview::{LogOverview, OfHome, SensorLook, SensorTrouble};
use crate::signs::Evidence;
use homebody_core::problem::counted;
use homebody_log::log::{Clock, ColumnRole, ColumnUse};
use std::fmt;

/// Largest number of silences, refused lines and unknown sensors in a report (our choice).
const TOLD: usize = 10;

/// Largest number of characters of a column's name in a table: a wider table cannot be printed.
const LONGEST_NAME: usize = 80;

impl fmt::Display for LogOverview {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let clock = if self.clock == Clock::Utc { "UTC" } else { "local time" };
        writeln!(f, "{}, in the form {}", self.name, self.form)?;
        let span = match (&self.first, &self.last) {
            (Some(first), Some(last)) => format!(", {first} to {last}, {clock}"),
            _ => String::new(),
        };
        let count = |number: u64, one, many| counted(number as usize, one, many);
        writeln!(
            f,
            "{} of {}{span}",
            count(self.rows, "row", "rows"),
            counted(self.sensors.len(), "sensor", "sensors")
        )?;
        if !self.days.is_empty() {
            let silent = (0..self.days.len()).filter(|&day| self.is_silent(day)).count();
            writeln!(f, "{}, {silent} of them without a row", counted(self.days.len(), "date", "dates"))?;
        }
        writeln!(
            f,
            "repeated {}, missing {}, doubled {}, clock set back {} (by {:.1} s at most)",
            self.repeated,
            self.missing,
            self.doubled,
            count(self.set_back, "time", "times"),
            self.set_back_most_s
        )?;
        listed(f, "silences of 12 h or more", self.silences_in_all, &self.silences, |silence| {
            format!("{} to {}: {:.1} h", silence.from, silence.to, silence.hours)
        })?;
        listed(f, "gaps in which nothing was recorded", self.gaps_in_all, &self.gaps, |gap| {
            format!("{} to {}: {}", gap.from, gap.to, lasted(gap.hours))
        })?;
        listed(f, "lines that were not understood", self.refused_in_all, &self.why_refused, |refused| match &refused
            .beside
        {
            Some(file) => format!("{file}:{}: {}", refused.line, refused.why),
            None => format!("line {}: {}", refused.line, refused.why),
        })?;
        self.remarks.iter().try_for_each(|remark| writeln!(f, "{remark}"))?;
        self.columns(f)?;
        self.sensors(f)?;
        if !self.activities.is_empty() {
            let width = self.activities.iter().map(|of| of.label.chars().count()).max().unwrap_or(0).max(8);
            writeln!(f, "\n{:width$}  {:>7}  {:>9}", "activity", "times", "hours")?;
            for of in &self.activities {
                writeln!(f, "{:width$}  {:>7}  {:>9.1}", of.label, of.times, of.hours)?;
            }
        }
        self.home.as_ref().map_or(Ok(()), |home| write!(f, "\n{home}"))
    }
}

impl LogOverview {
    pub fn is_silent(&self, day: usize) -> bool {
        self.sensors.iter().all(|sensor| sensor.by_day.get(day).is_none_or(|&count| count == 0))
    }

    fn columns(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.columns.is_empty() {
            return Ok(());
        }
        let name = |of: &ColumnUse| match of.column.as_str() {
            "" => "(none)".to_owned(),
            name => name.chars().take(LONGEST_NAME).collect(),
        };
        let (of_sensors, others): (Vec<&ColumnUse>, Vec<&ColumnUse>) =
            self.columns.iter().partition(|of| of.used_as == ColumnRole::OneSensor);
        let told: Vec<&ColumnUse> = others.into_iter().chain(of_sensors.iter().copied().take(TOLD)).collect();
        let width = told.iter().map(|of| name(of).chars().count()).max().unwrap_or(0).max(6);
        writeln!(f, "\n{:width$}  {:10}  why", "column", "is")?;
        for of in told {
            writeln!(f, "{:width$}  {:10}  {}", name(of), role(of.used_as), of.because)?;
        }
        let more = of_sensors.len().saturating_sub(TOLD);
        if more > 0 { writeln!(f, "and {more} more columns that are sensors") } else { Ok(()) }
    }

    fn sensors(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.sensors.is_empty() {
            return Ok(());
        }
        let named = |sensor: &SensorLook| {
            sensor.name.as_ref().map_or(sensor.id.clone(), |name| format!("{} ({name})", sensor.id))
        };
        let widest = |cell: &dyn Fn(&SensorLook) -> usize| self.sensors.iter().map(cell).max().unwrap_or(0);
        let width = widest(&|sensor| named(sensor).chars().count()).max(6);
        let wide = widest(&|sensor| sensor.evidence().chars().count()).max(15);
        writeln!(
            f,
            "\n{:width$}  {:7}  {:>9}  {:>5}  {:wide$}  what it says",
            "sensor", "kind", "rows", "dates", "taken for it by"
        )?;
        for sensor in &self.sensors {
            writeln!(
                f,
                "{:width$}  {:7}  {:>9}  {:>5}  {:wide$}  {}",
                named(sensor),
                sensor.kind.word(),
                sensor.rows,
                sensor.days,
                sensor.evidence(),
                sensor.in_words()
            )?;
        }
        Ok(())
    }
}

fn lasted(hours: f64) -> String {
    match hours {
        1.0.. => format!("{hours:.1} h"),
        _ => format!("{:.1} min", hours * 60.0),
    }
}

fn role(role: ColumnRole) -> &'static str {
    match role {
        ColumnRole::Time => "time",
        ColumnRole::End => "end",
        ColumnRole::Duration => "duration",
        ColumnRole::Sensor => "sensor",
        ColumnRole::Value => "value",
        ColumnRole::Label => "activity",
        ColumnRole::Home => "home",
        ColumnRole::Kind => "kind",
        ColumnRole::Room => "room",
        ColumnRole::Unit => "unit",
        ColumnRole::OneSensor => "one sensor",
        ColumnRole::Unused => "unused",
    }
}

impl SensorLook {
    pub fn evidence(&self) -> String {
        match self.by {
            Evidence::Guess => format!("a guess: {}", self.because),
            _ => self.because.clone(),
        }
    }

    pub fn in_words(&self) -> String {
        let mut parts: Vec<String> = self.values.iter().map(|(value, times)| format!("{value} {times}")).collect();
        parts.extend(self.range.map(|[least, most]| format!("{least} to {most}")));
        let counts = [
            (self.repeated, "repeated"),
            (self.missing, "missing"),
            (self.doubled, "doubled"),
            (self.unknown, "not known"),
            (self.restored, "restored"),
        ];
        parts.extend(counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")));
        parts.extend(self.trouble.as_ref().map(SensorTrouble::to_string));
        parts.join(", ")
    }
}

impl fmt::Display for SensorTrouble {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            SensorTrouble::Dead { since } => write!(f, "dead since {since}"),
            SensorTrouble::StuckOn { since, hours } => write!(f, "stuck: on for {hours:.1} h since {since}"),
            SensorTrouble::StuckAt { value } => write!(f, "stuck at {value}"),
        }
    }
}

impl fmt::Display for OfHome {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let share = self.known_share.map_or("-".into(), |share| format!("{:.1} %", share * 100.0));
        let known = counted(self.known, "sensor", "sensors");
        writeln!(f, "{}: it has {known} of the log, which have {share} of the rows", self.name)?;
        let unknown = self.unknown.len() as u64;
        listed(f, "sensors that it does not have", unknown, &self.unknown, |of| {
            format!("{}: {} rows, {:.1} %", of.id, of.rows, of.share * 100.0)
        })?;
        listed(f, "sensors that are another kind there", self.misfits.len() as u64, &self.misfits, |of| {
            format!("{} is taken for {}, {} is {}", of.id, of.is.word(), of.name, of.of_home.word())
        })?;
        listed(f, "sensors of it that say nothing", self.unheard.len() as u64, &self.unheard, Clone::clone)
    }
}

fn listed<T>(f: &mut fmt::Formatter, what: &str, in_all: u64, all: &[T], told: impl Fn(&T) -> String) -> fmt::Result {
    if in_all == 0 {
        return Ok(());
    }
    writeln!(f, "{what}: {in_all}")?;
    all.iter().take(TOLD).try_for_each(|one| writeln!(f, "  {}", told(one)))?;
    if in_all > TOLD as u64 { writeln!(f, "  and {} more", in_all - TOLD as u64) } else { Ok(()) }
}
