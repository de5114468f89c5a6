//! The tables of the truth: one schema, for whoever writes it and whoever reads it.

use crate::table::{Column, ColumnKind, Table};

/// A table of the truth, by its place among [`tables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Why a sensor fired.
    Cause,
    /// A row of the log that ends a hold.
    Off,
    /// What a body did over a span.
    Movement,
    /// Where a resident is from an instant on.
    Room,
    /// What a resident did over a span.
    Activity,
    /// A use of a thing.
    Act,
    /// How strong a need was as it was met.
    Need,
    /// How severe a condition is from an instant on.
    Condition,
    /// A message that never reached the logger.
    Lost,
    /// Who lives in the home or visits it.
    Resident,
    /// What was done from outside.
    Outside,
    /// The home that it was lived in.
    Home,
}

/// Tables that truths do not have which earlier versions of the program wrote.
const LATER: [&str; 2] = ["outside", "home"];

/// How much of a truth is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TruthKept {
    /// All tables.
    #[default]
    All,
    /// Those that have few rows: not the ones with a row for each firing or movement, which are most of a truth. Whoever lives the
    /// recording again has them.
    Brief,
}

impl TruthKept {
    /// Whether a table is kept.
    pub fn has(self, table: &Table) -> bool {
        self == TruthKept::All || !table.is_frequent
    }

    /// The tables that are kept, in the order of [`tables`].
    pub fn tables(self) -> Vec<Table> {
        tables().into_iter().filter(|table| self.has(table)).collect()
    }

    /// How much of a truth was kept of which these tables are there.
    pub(crate) fn of(is_there: impl Fn(&str) -> bool) -> TruthKept {
        let has_frequent = tables().iter().any(|table| table.is_frequent && is_there(&table.name));
        if has_frequent { TruthKept::All } else { TruthKept::Brief }
    }
}

/// The tables that are to be in a truth of which these are there: not those that an earlier version did not know, and of a brief one,
/// none that it leaves out.
pub(crate) fn tables_of(is_there: impl Fn(&str) -> bool) -> Vec<Table> {
    let kept = TruthKept::of(&is_there);
    let is_wanted = |table: &Table| !LATER.contains(&table.name.as_str()) || is_there(&table.name);
    kept.tables().into_iter().filter(is_wanted).collect()
}

impl Truth {
    /// All of them, in the order of [`tables`].
    pub const ALL: [Truth; 12] = [
        Truth::Cause,
        Truth::Off,
        Truth::Movement,
        Truth::Room,
        Truth::Activity,
        Truth::Act,
        Truth::Need,
        Truth::Condition,
        Truth::Lost,
        Truth::Resident,
        Truth::Outside,
        Truth::Home,
    ];
}

/// All tables of the truth, in the order of [`Truth`].
pub fn tables() -> Vec<Table> {
    use ColumnKind::{Instant, Integer, Real, Text};
    const WHO: (&str, ColumnKind, &str, &str) = ("resident", Text, "", "whose: the name of a resident or a visitor");
    const WHOSE: (&str, ColumnKind, &str, &str) =
        ("resident", Text, "", "whose doing it was; empty where it was nobody's");
    const WHY: (&str, ColumnKind, &str, &str) =
        ("why", Text, "", "movement, act, reading, duplicate or false: what kind of cause it was");
    const USED: (&str, ColumnKind, &str, &str) = ("thing", Text, "", "what was used, of an act");
    const FROM: (&str, ColumnKind, &str, &str) = ("at", Instant, "", "from when on");
    vec![
        table(
            "cause",
            "why a sensor fired, a row for each firing",
            true,
            &[
                ("firing", Integer, "", "the number of the firing in its run, from 0"),
                ("row", Integer, "", "the row of the log that tells of it: its own, or the ON that it prolonged"),
                WHOSE,
                ("seen_at", Instant, "", "when what it was began to be noticed"),
                ("fired_at", Instant, "", "when the logger says that it fired"),
                ("sensor", Text, "", "the sensor's id in the log"),
                WHY,
                USED,
            ],
        ),
        table(
            "off",
            "a row of the log that says that a hold is over",
            true,
            &[("row", Integer, "", "the row of the log"), ("firing", Integer, "", "the last firing that was held")],
        ),
        table(
            "movement",
            "what a body did over a span; the spans of a resident follow each other without gaps",
            true,
            &[
                WHO,
                ("begin_at", Instant, "", "from when"),
                ("end_at", Instant, "", "until when"),
                ("kind", Text, "", "stride, in_place, rest or away"),
                ("from_x", Real, "m", "where it began, to the east; empty while away, as the next four"),
                ("from_y", Real, "m", "to the north"),
                ("to_x", Real, "m", "where it ended, to the east"),
                ("to_y", Real, "m", "to the north"),
                ("amplitude_m", Real, "m", "of in-place motion: how far what moves moves"),
                ("posture", Text, "", "standing, sitting or lying"),
            ],
        ),
        table(
            "room",
            "the room that a resident is in from an instant on",
            false,
            &[WHO, FROM, ("room", Text, "", "the room's name; empty between rooms and away")],
        ),
        table(
            "activity",
            "what a resident did over a span",
            false,
            &[
                WHO,
                ("begin_at", Instant, "", "from when"),
                ("end_at", Instant, "", "until when"),
                ("name", Text, "", "what it was, such as sleeping"),
            ],
        ),
        table(
            "act",
            "a thing that was used",
            false,
            &[
                WHOSE,
                ("at", Instant, "", "when"),
                ("thing", Text, "", "what was used"),
                ("is_on", Integer, "", "1 where it is on or open afterwards, else 0"),
            ],
        ),
        table(
            "need",
            "how strong a need was as it was met, and then that it is 0",
            false,
            &[
                WHO,
                ("at", Instant, "", "when"),
                ("need", Text, "", "toilet, thirst, hunger or tiredness"),
                ("level", Real, "", "from 0, met, to 1, pressing"),
            ],
        ),
        table(
            "condition",
            "how severe a condition is from an instant on",
            false,
            &[WHO, FROM, ("name", Text, "", "the condition"), ("severity", Real, "", "1 is a moderate case, 0 none")],
        ),
        table(
            "lost",
            "what a sensor said, or should have said, that never reached the logger",
            true,
            &[
                ("sensor", Text, "", "the sensor's id in the log"),
                ("value", Text, "", "what it said"),
                ("sent_at", Instant, "", "when it was said"),
                ("seen_at", Instant, "", "when what it was began to be noticed"),
                ("loss", Text, "", "radio, collision, miss, battery, place, stuck, garbled or outage"),
                WHOSE,
                WHY,
                USED,
            ],
        ),
        table(
            "resident",
            "who lives in the home or comes to visit",
            false,
            &[WHO, ("person", Text, "", "which person of all runs: the home's name, a stroke and the resident's")],
        ),
        table(
            "outside",
            "what was done from outside while the run was lived, by whoever may give it orders",
            false,
            &[
                ("at", Instant, "", "when"),
                ("until_at", Instant, "", "until when; empty for ever, and of what is over at once"),
                (
                    "what",
                    Text,
                    "",
                    "on or off of a thing; battery, stuck, falls_off or bad_link of a sensor; fall of a resident",
                ),
                ("name", Text, "", "of what: the name of the thing, the sensor or the resident"),
            ],
        ),
        table(
            "home",
            "the home that it was lived in, in one row: the homes of a cohort may be mixed",
            false,
            &[
                ("file", Text, "", "its file in the scenario, such as home.json"),
                ("name", Text, "", "what that file calls it"),
            ],
        ),
    ]
}

fn table(
    name: &str,
    about: &'static str,
    is_frequent: bool,
    columns: &[(&str, ColumnKind, &'static str, &'static str)],
) -> Table {
    let column = |&(name, kind, unit, about): &(&str, ColumnKind, &'static str, &'static str)| Column {
        name: name.to_owned(),
        kind,
        unit,
        about,
    };
    Table {
        name: name.to_owned(),
        about,
        columns: columns.iter().map(column).collect(),
        is_numbered: false,
        is_frequent,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_table_is_in_its_place() {
        let tables = tables();
        for (table, name) in [
            (Truth::Cause, "cause"),
            (Truth::Off, "off"),
            (Truth::Movement, "movement"),
            (Truth::Room, "room"),
            (Truth::Activity, "activity"),
            (Truth::Act, "act"),
            (Truth::Need, "need"),
            (Truth::Condition, "condition"),
            (Truth::Lost, "lost"),
            (Truth::Resident, "resident"),
            (Truth::Outside, "outside"),
            (Truth::Home, "home"),
        ] {
            assert_eq!(tables[table as usize].name, name);
        }
    }
}
