//! Objects of JSON whose members are the columns of a table: a list of instants, and lists of as many readings, as Open-Meteo answers and
//! pandas writes them; or objects that have the cells under the same keys.

use super::said::{Object, instant};
use crate::log::ColumnRole;
use crate::source::columns::role_of;
use crate::source::instant::InstantReader;
use serde_json::Value;

/// The rows of a table whose columns are the members of an object; `None` of any other object.
pub(crate) fn rows(object: &Object, instants: &mut InstantReader) -> Option<Vec<Object>> {
    let columns: Vec<(&String, Vec<&Value>)> =
        object.iter().filter_map(|(name, said)| Some((name, cells(said)?))).collect();
    let is_time = |(name, _): &&(&String, Vec<&Value>)| role_of(name).is_some_and(|(role, _)| role == ColumnRole::Time);
    let (_, times) = columns.iter().find(is_time)?;
    if times.len() < 2 || !times.iter().all(|time| instant(time, instants).is_some()) {
        return None;
    }
    let together: Vec<_> = columns.iter().filter(|(_, cells)| cells.len() == times.len()).collect();
    if together.len() < 2 {
        return None;
    }
    let row = |at: usize| together.iter().map(|(name, cells)| ((*name).clone(), cells[at].clone())).collect();
    Some((0..times.len()).map(row).collect())
}

/// The cells of a column: a list of them, or an object with a cell under each key.
fn cells(said: &Value) -> Option<Vec<&Value>> {
    let cells: Vec<&Value> = match said {
        Value::Array(cells) => cells.iter().collect(),
        Value::Object(cells) => cells.values().collect(),
        _ => return None,
    };
    cells.iter().all(|cell| !cell.is_array() && !cell.is_object()).then_some(cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn lists_of_one_length_with_instants_are_columns() {
        let rows = |object: Value| super::rows(object.as_object().unwrap(), &mut InstantReader::default());
        let table =
            json!({"time": ["2026-02-02T06:00", "2026-02-02T07:00"], "hall": [1, null], "unit": "C", "other": [1]});
        let wanted =
            [json!({"time": "2026-02-02T06:00", "hall": 1}), json!({"time": "2026-02-02T07:00", "hall": null})];
        let told: Vec<Value> = rows(table).unwrap().into_iter().map(Value::Object).collect();
        assert_eq!(told, wanted);
        let keyed = json!({"time": {"0": 1770012000, "1": 1770012060}, "hall": {"0": 1, "1": 2}});
        assert_eq!(rows(keyed).map(|rows| rows.len()), Some(2));
        for other in [
            json!({"time": ["a", "b"], "hall": [1, 2]}),
            json!({"time": ["2026-02-02T06:00"], "hall": [1]}),
            json!({"when it was": 1, "hall": [1, 2]}),
            json!({"time": ["2026-02-02T06:00", "2026-02-02T07:00"], "hall": 1}),
        ] {
            assert_eq!(rows(other.clone()), None, "{other}");
        }
    }
}
