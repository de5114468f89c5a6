//! The tables of the truth: one schema for writers and readers.

use super::{Column, ColumnKind, Table};

/// A table of the truth, by its place among [`tables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Why a sensor fired.
    Cause,
    /// A row of the log that ends a hold.
    Off,
    /// The movements of bodies, as intervals.
    Movement,
    /// The room of a resident from an instant on.
    Room,
    /// The activities of residents, as intervals.
    Activity,
    /// A use of a thing.
    Act,
    /// The strength of a need when it was met.
    Need,
    /// The severity of a condition from an instant on.
    Condition,
    /// A message that never reached the logger.
    Lost,
    /// The residents and visitors of the home.
    Resident,
    /// The interventions.
    Outside,
    /// The simulated home.
    Home,
}

/// Tables that truths do not have which earlier versions of the program wrote.
const LATER: [&str; 2] = ["outside", "home"];

/// The part of a truth that is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TruthKept {
    /// All tables.
    #[default]
    All,
    /// The tables with few rows: not those with a row for each firing or movement, which are most of a truth. A replay of the recording
    /// writes them.
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

    pub(crate) fn of(is_there: impl Fn(&str) -> bool) -> TruthKept {
        let has_frequent = tables().iter().any(|table| table.is_frequent && is_there(&table.name));
        if has_frequent { TruthKept::All } else { TruthKept::Brief }
    }
}

/// The expected tables of a truth with these: without those that an earlier version did not know, and without those that a brief one
/// leaves out.
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
    const WHO: (&str, ColumnKind, &str, &str) = ("resident", Text, "", "name of the resident or visitor");
    const WHOSE: (&str, ColumnKind, &str, &str) =
        ("resident", Text, "", "name of the resident who caused it; empty if no resident did");
    const WHY: (&str, ColumnKind, &str, &str) =
        ("why", Text, "", "kind of cause: movement, act, reading, duplicate or false");
    const USED: (&str, ColumnKind, &str, &str) = ("thing", Text, "", "thing that was used, if the cause is an act");
    const FROM: (&str, ColumnKind, &str, &str) = ("at", Instant, "", "time from which the row holds");
    vec![
        table(
            "cause",
            "the cause of each firing that reached the logger, one row a firing",
            true,
            &[
                ("firing", Integer, "", "number of the firing in its run, from 0"),
                ("row", Integer, "", "row of the log with the firing: its own, or that of the ON that it prolonged"),
                WHOSE,
                ("seen_at", Instant, "", "time at which the cause was first detected"),
                ("fired_at", Instant, "", "time of the firing in the log"),
                ("sensor", Text, "", "id of the sensor in the log"),
                WHY,
                USED,
            ],
        ),
        table(
            "off",
            "the last firing before each OFF: one row for each row of the log that ends a hold",
            true,
            &[("row", Integer, "", "row of the log"), ("firing", Integer, "", "number of the last firing in the hold")],
        ),
        table(
            "movement",
            "the movement of a body over a span; the spans of a resident follow each other without gaps",
            true,
            &[
                WHO,
                ("begin_at", Instant, "", "start of the span"),
                ("end_at", Instant, "", "end of the span"),
                ("kind", Text, "", "kind of movement: stride, in_place, rest or away"),
                (
                    "from_x",
                    Real,
                    "m",
                    "position at the start, to the east; this and the next four are empty while away",
                ),
                ("from_y", Real, "m", "position at the start, to the north"),
                ("to_x", Real, "m", "position at the end, to the east"),
                ("to_y", Real, "m", "position at the end, to the north"),
                ("amplitude_m", Real, "m", "distance that the moving part of the body covers, for in_place"),
                ("posture", Text, "", "posture of the body: standing, sitting or lying"),
            ],
        ),
        table(
            "room",
            "the room that a resident is in, one row for each change",
            false,
            &[WHO, FROM, ("room", Text, "", "name of the room; empty between rooms and while away")],
        ),
        table(
            "activity",
            "an activity of a resident over a span",
            false,
            &[
                WHO,
                ("begin_at", Instant, "", "start of the span"),
                ("end_at", Instant, "", "end of the span"),
                ("name", Text, "", "label of the activity, such as sleeping"),
            ],
        ),
        table(
            "act",
            "a use of a thing",
            false,
            &[
                WHOSE,
                ("at", Instant, "", "time of the use"),
                ("thing", Text, "", "name of the thing"),
                ("is_on", Integer, "", "1 if the thing is on or open afterwards, else 0"),
            ],
        ),
        table(
            "need",
            "the level of a need when it is met, followed by a row with 0",
            false,
            &[
                WHO,
                ("at", Instant, "", "time at which the need is met"),
                ("need", Text, "", "need: toilet, thirst, hunger or tiredness"),
                ("level", Real, "", "level from 0 (met) to 1 (pressing)"),
            ],
        ),
        table(
            "condition",
            "the severity of a condition, one row for each change",
            false,
            &[
                WHO,
                FROM,
                ("name", Text, "", "name of the condition"),
                ("severity", Real, "", "severity: 0 is absent, 1 a moderate case"),
            ],
        ),
        table(
            "lost",
            "an event that never reached the logger, or that its sensor missed",
            true,
            &[
                ("sensor", Text, "", "the sensor's id in the log"),
                ("value", Text, "", "value of the event"),
                ("sent_at", Instant, "", "time at which the event was sent"),
                ("seen_at", Instant, "", "time at which the cause was first detected"),
                (
                    "loss",
                    Text,
                    "",
                    "reason of the loss: radio, collision, miss, battery, place, stuck, garbled or outage",
                ),
                WHOSE,
                WHY,
                USED,
            ],
        ),
        table(
            "resident",
            "the residents and visitors of the home, one row each",
            false,
            &[
                WHO,
                (
                    "person",
                    Text,
                    "",
                    "id of the person across all runs: the home's name, a slash and the resident's name",
                ),
            ],
        ),
        table(
            "outside",
            "an action from outside during the run, by a person or program with access to it",
            false,
            &[
                ("at", Instant, "", "time of the action"),
                ("until_at", Instant, "", "end of its effect; empty if the effect has no end or is immediate"),
                (
                    "what",
                    Text,
                    "",
                    "action: on or off of a thing; battery, stuck, falls_off or bad_link of a sensor; fall of a resident",
                ),
                ("name", Text, "", "name of the thing, the sensor or the resident"),
            ],
        ),
        table(
            "home",
            "the home of the run, in one row; members of a cohort may have different homes",
            false,
            &[
                ("file", Text, "", "file of the home in the scenario, such as home.json"),
                ("name", Text, "", "name of the home in that file"),
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
