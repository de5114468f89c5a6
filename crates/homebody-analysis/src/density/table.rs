use std::fmt;

use super::{CellSum, Density, EntranceSource, HomeAbsence, LEVELS, Map, MapDay, Texture, TexturedMap};
use crate::dates::clock;
use homebody_core::problem::counted;
use homebody_core::time::WallTime;

/// Largest numbers of days, and of absences, in a list. For more, weeks are listed.
const MOST_DAYS: usize = 31;
const MOST_ABSENCES: usize = 40;
/// Largest number of omitted sensors with their names.
const MOST_LEFT_OUT: usize = 12;

impl fmt::Display for Density {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let maps: Vec<&TexturedMap> =
            [&self.of].into_iter().chain(self.against.iter().map(|against| &against.of)).collect();
        for (index, measured) in maps.iter().enumerate() {
            if index > 0 {
                writeln!(f, "\n")?;
            }
            tell(f, &measured.map)?;
            by_hour(f, &measured.map)?;
        }
        writeln!(
            f,
            "\nTexture: how alike neighbouring hours are, in {LEVELS} levels of {} firings/h",
            self.step_per_h
        )?;
        let width = maps.iter().map(|measured| measured.map.name.chars().count()).max().unwrap_or(0).max(3);
        writeln!(f, "{:width$}  {:>11}  {:>8}  {:>7}", "log", "homogeneity", "contrast", "entropy")?;
        for TexturedMap { map, texture } in maps {
            let features = texture.as_ref().map(|of: &Texture| [of.homogeneity, of.contrast, of.entropy]);
            let features = features.map(|features| features.map(|feature| format!("{feature:.3}")));
            let [homogeneity, contrast, entropy] = features.unwrap_or_else(|| ["-"; 3].map(String::from));
            writeln!(f, "{:width$}  {homogeneity:>11}  {contrast:>8}  {entropy:>7}", map.name)?;
        }
        let Some(against) = &self.against else { return Ok(()) };
        match against.distance {
            None => writeln!(f, "\nThere is too little at home in one of the logs to say how far apart they are.")?,
            Some(distance) => {
                writeln!(f, "\nThe two maps are {distance:.3} apart: 0 is alike, 2.24 the most there can be.")?
            }
        }
        match against.weeks_apart {
            Some([median, most]) => writeln!(
                f,
                "To judge it: the weeks of {} are {median:.3} apart from each other, {most:.3} at most.",
                against.of.map.name
            ),
            None => Ok(()),
        }
    }
}

fn tell(f: &mut fmt::Formatter, map: &Map) -> fmt::Result {
    let last = map.days.last().map_or(map.from, |day| day.date);
    let days = counted(map.days.len(), "day", "days");
    let sensors = counted(map.motion_sensors, "motion sensor", "motion sensors");
    writeln!(f, "{}: {days}, {} to {last}; {} firings of {sensors}", map.name, map.from, map.events)?;
    if !map.left_out.is_empty() {
        let count = map.left_out.len();
        let shown = map.left_out.iter().take(MOST_LEFT_OUT).map(String::as_str).collect::<Vec<_>>().join(", ");
        let more = if count > MOST_LEFT_OUT { " and more" } else { "" };
        writeln!(f, "Left out: {count} that tell of no movement: {shown}{more}")?;
    }
    match map.density_per_h {
        Some(density) => writeln!(f, "At home:  {density:.1} firings an hour")?,
        None => writeln!(f, "At home:  not long enough to say how many firings an hour")?,
    }
    writeln!(f, "Away:     {} a day; {:.1} h in all", hours_and_minutes(map.away_h_per_day), map.away_h)?;
    let names = map.entrance.sensors.join(", ");
    match map.entrance.chosen {
        EntranceSource::Asked => writeln!(f, "Entrance: {names}, as asked")?,
        EntranceSource::Known => writeln!(f, "Entrance: {names}, by name or as a door's contact")?,
        EntranceSource::Guessed => writeln!(f, "Entrance: {names}, a guess by name")?,
        EntranceSource::None => {
            writeln!(f, "Entrance: no sensor's name speaks of one, so nobody is ever away")?;
        }
    }
    absences(f, &map.absences)?;

    let is_long = map.days.len() > MOST_DAYS;
    let what = if is_long { "week from" } else { "day" };
    writeln!(f, "\n{what:10}  {:>8}  {:>10}  {:>6}  {:>18}", "firings", "recorded h", "away h", "firings/h at home")?;
    for (days, cells) in map.days.chunks(if is_long { 7 } else { 1 }).zip(map.cells.chunks(if is_long { 7 } else { 1 }))
    {
        let Some(MapDay { date, .. }) = days.first() else { continue };
        row(f, &date.to_string(), &CellSum::from_cells(cells.iter().flatten()), 0)?;
    }
    Ok(())
}

fn absences(f: &mut fmt::Formatter, absences: &[HomeAbsence]) -> fmt::Result {
    if absences.is_empty() {
        return Ok(());
    }
    writeln!(f, "\n{:16}  {:16}  {:>6}  {:>14}", "away from", "to", "h", "stray firings")?;
    let told = |at: WallTime| format!("{} {}", at.date(), clock(at.time_of_day()));
    for absence in absences.iter().take(MOST_ABSENCES) {
        let (begin, end) = (told(absence.begin), told(absence.end));
        let guess = if absence.is_guess { "  estimated" } else { "" };
        writeln!(f, "{begin:16}  {end:16}  {:>6.1}  {:>14}{guess}", absence.hours(), absence.stray)?;
    }
    if absences.iter().any(|absence| absence.is_guess) {
        writeln!(
            f,
            "Estimated: movement at the entrance, then no movement at home. No door contact reports this absence."
        )?;
    }
    match absences.len().saturating_sub(MOST_ABSENCES) {
        0 => Ok(()),
        more => writeln!(f, "and {more} more"),
    }
}

fn by_hour(f: &mut fmt::Formatter, map: &Map) -> fmt::Result {
    writeln!(
        f,
        "\n{:10}  {:>8}  {:>10}  {:>6}  {:>18}",
        "hour", "firings", "recorded h", "away h", "firings/h at home"
    )?;
    let densities = || map.hours.iter().filter_map(|hour| hour.sum.density_per_h);
    let most = densities().fold(0.0, f64::max);
    for hour in &map.hours {
        let bar =
            hour.sum.density_per_h.filter(|_| most > 0.0).map_or(0, |density| (density / most * 24.0).ceil() as usize);
        let name = format!("{:02}-{:02}", hour.hour, hour.hour + 1);
        row(f, &name, &hour.sum, bar)?;
    }
    Ok(())
}

fn row(f: &mut fmt::Formatter, name: &str, sum: &CellSum, bar: usize) -> fmt::Result {
    let density = sum.density_per_h.map_or("-".into(), |density| format!("{density:.1}"));
    let CellSum { events, recorded_h, away_h, .. } = sum;
    let line = format!("{name:10}  {events:>8}  {recorded_h:>10.1}  {away_h:>6.1}  {density:>18}  {}", "█".repeat(bar));
    writeln!(f, "{}", line.trim_end())
}

fn hours_and_minutes(hours: f64) -> String {
    let minutes = (hours * 60.0).round() as u64;
    format!("{} h {:02} min", minutes / 60, minutes % 60)
}
