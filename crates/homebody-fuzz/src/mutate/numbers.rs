//! Unusual numbers.

use super::word;
use crate::choices::Choices;
use homebody_core::scenario::schema::schemas;
use serde_json::Value;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// A hostile number, one at a bound of some schema, or one near `number`.
pub fn other(number: f64, choices: &mut Choices) -> String {
    match choices.below(6) {
        0 | 1 => word(choices, "numbers").to_owned(),
        2 => {
            let bound = *choices.one(bounds());
            text([bound, bound.next_up(), bound.next_down(), bound + 1.0, bound - 1.0, -bound][choices.below(6)])
        }
        3 => text(number * choices.one(&[-1.0, 0.5, 2.0, 10.0, 1e-3, 1e3, 1e9, 1e-9])),
        4 => text(if choices.is(0.5) { number.next_up() } else { number.next_down() }),
        _ => text(number + choices.one(&[-1.0, 1.0, 0.01, -0.01, 1e-7, 360.0])),
    }
}

fn text(number: f64) -> String {
    if number.is_finite() { number.to_string() } else { "1e309".to_owned() }
}

fn bounds() -> &'static [f64] {
    static BOUNDS: OnceLock<Vec<f64>> = OnceLock::new();
    BOUNDS.get_or_init(|| {
        let mut found = BTreeSet::new();
        schemas().iter().for_each(|(_, schema)| collect(schema, &mut found));
        found.iter().filter_map(|text| text.parse().ok()).collect()
    })
}

fn collect(schema: &Value, found: &mut BTreeSet<String>) {
    const BOUND: [&str; 4] = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"];
    match schema {
        Value::Object(keys) => {
            let bounds = keys.iter().filter(|(key, _)| BOUND.contains(&key.as_str()));
            found.extend(bounds.filter_map(|(_, value)| Some(value.as_number()?.to_string())));
            keys.values().for_each(|value| collect(value, found));
        }
        Value::Array(items) => items.iter().for_each(|item| collect(item, found)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices;

    #[test]
    fn the_bounds_of_the_schemas_are_known() {
        // Of probabilities, days, and metres.
        assert!(bounds().contains(&0.0) && bounds().contains(&1.0) && bounds().len() > 20, "{:?}", bounds());
    }

    #[test]
    fn nearly_all_are_numbers_of_json() {
        let bytes = choices::bytes(1);
        let mut choices = Choices::new(&bytes);
        let good = (0..1000).filter(|_| serde_json::from_str::<f64>(&other(3.5, &mut choices)).is_ok()).count();
        assert!((850..1000).contains(&good), "{good}");
    }
}
