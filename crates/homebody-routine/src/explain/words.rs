use homebody_core::fuzzy::Fuzzy;

pub fn lasts_words(lasts: &Fuzzy) -> String {
    span_words(lasts.low, lasts.high)
}

pub fn span_words(low: f64, high: f64) -> String {
    let (low, high) = (span(low), span(high));
    if low == high { low } else { format!("{low} to {high}") }
}

pub fn span(seconds: f64) -> String {
    let whole = seconds.clamp(0.0, 1e9).round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, 0) => format!("{minutes} min"),
        (0, minutes, seconds) => format!("{minutes} min {seconds} s"),
        (hours, 0, _) => format!("{hours} h"),
        (hours, minutes, _) => format!("{hours} h {minutes} min"),
    }
}

pub fn clock(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as i64;
    let of_day = minutes.rem_euclid(24 * 60);
    let next = if minutes > 24 * 60 { " the next day" } else { "" };
    let hours = if minutes == 24 * 60 { 24 } else { of_day / 60 };
    format!("{hours:02}:{:02}{next}", of_day % 60)
}

pub fn numbers(low: f64, high: f64) -> String {
    let (low, high) = (number(low), number(high));
    if low == high { low } else { format!("{low} to {high}") }
}

/// With at most three decimals.
pub fn number(value: f64) -> String {
    let rounded = (value * 1000.0).round() / 1000.0 + 0.0;
    rounded.to_string()
}

pub fn join(parts: impl Iterator<Item = String>, between: &str) -> String {
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join(between)
}
