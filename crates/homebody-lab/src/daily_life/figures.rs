/// A number with its unit, as people read it.
pub fn number(value: f64, unit: &str) -> String {
    match unit {
        "clock" => {
            let minutes = (value * 60.0).round() as i64;
            format!("{:02}:{:02}", minutes.div_euclid(60).rem_euclid(24), minutes.rem_euclid(60))
        }
        "h" | "m/s" => format!("{value:.2} {unit}"),
        "%" | "min" | "s" => format!("{} {unit}", plain(value)),
        _ => plain(value),
    }
}

fn plain(value: f64) -> String {
    match value.abs() {
        size if size >= 99.95 => format!("{value:.0}"),
        size if size >= 9.995 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}
