//! Numbers that are written with a unit, such as `21.38 °C`, and lists of one number, such as `[72]`.

/// Units as they stand behind numbers, in lower case.
const UNITS: [&str; 65] = [
    "°c", "°f", "° c", "° f", "degc", "degf", "deg c", "deg f", "c", "f", "k", "w", "kw", "mw", "wh", "kwh", "mwh",
    "va", "var", "v", "mv", "a", "ma", "hz", "%", "%rh", "% rh", "ppm", "ppb", "lx", "lux", "hpa", "mbar", "bar", "pa",
    "kpa", "psi", "db", "dbm", "m", "cm", "mm", "m/s", "km/h", "mph", "s", "sec", "ms", "min", "bpm", "rpm", "l", "m³",
    "m3", "l/min", "l/h", "kg", "g", "µg/m³", "ug/m3", "mmol/l", "mg/dl", "mmhg", "bq/m³", "pci/l",
];

/// Signs of money.
const MONEY: [char; 3] = ['$', '€', '£'];

pub(crate) fn is_unit(text: &str) -> bool {
    text.len() > 1 && UNITS.contains(&text.to_lowercase().as_str()) || matches!(text, "W" | "V" | "A" | "%")
}

pub(crate) fn is_money(text: &str) -> bool {
    let rest = text.trim_start_matches('-').trim_start_matches(MONEY).trim_end_matches(MONEY).trim();
    rest.len() < text.trim_start_matches('-').len() && !rest.is_empty() && digits(rest) == rest.len()
}

/// The number of a cell in its original form, and the unit behind it; `[72]` has no unit.
pub(crate) fn measured(cell: &str) -> Option<(&str, &str)> {
    if let Some(inner) = cell.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
        let inner = inner.trim();
        return (!inner.is_empty() && digits(inner) == inner.len() && !inner.contains(',')).then_some((inner, ""));
    }
    let (number, behind) = cell.split_at(digits(cell));
    let unit = behind.trim_start();
    let is_apart = unit.len() < behind.len();
    // `12A` and `3F` are doors and floors.
    let is_letter = unit.len() == 1 && unit.bytes().all(|byte| byte.is_ascii_alphabetic());
    let fits = !is_letter || is_apart || number.contains(['.', ',']);
    let has_digit = number.bytes().any(|byte| byte.is_ascii_digit());
    (has_digit && fits && UNITS.contains(&unit.to_lowercase().as_str())).then_some((number, unit))
}

/// The number of bytes at the beginning that are a sign, digits or marks.
fn digits(text: &str) -> usize {
    let sign = usize::from(text.starts_with(['-', '+']));
    let length = text[sign..].bytes().take_while(|byte| byte.is_ascii_digit() || b".,".contains(byte)).count();
    if length == 0 { 0 } else { sign + length }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separates_a_number_from_its_unit() {
        for (cell, found) in [
            ("21.38 °C", Some(("21.38", "°C"))),
            ("69.0°F", Some(("69.0", "°F"))),
            ("443ppm", Some(("443", "ppm"))),
            ("-0,5 kW", Some(("-0,5", "kW"))),
            ("27%", Some(("27", "%"))),
            ("0 W", Some(("0", "W"))),
            ("[72]", Some(("72", ""))),
            ("[72,73]", None),
            ("21.38", None),
            ("12A", None),
            ("3F", None),
            ("M001", None),
            ("W", None),
            ("é5 W", None),
            ("-", None),
        ] {
            assert_eq!(measured(cell), found, "{cell}");
        }
        assert!(is_unit("kWh") && is_unit("KWH") && is_unit("°C") && !is_unit("m") && !is_unit("hall"));
        assert!(is_money("$0.13") && is_money("-12,50 €") && !is_money("0.13") && !is_money("$") && !is_money("-"));
    }
}
