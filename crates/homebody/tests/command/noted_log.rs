//! A log with noted activities.

/// A home of a bed's sensor and a front door's contact for five days, with noted activities.
pub fn noted(leaves: &str) -> String {
    let mut log = String::new();
    for day in 1..=5 {
        for (clock, row) in [
            ("07:00:00", "bed_pressure OFF Sleep end"),
            ("09:00:00", &format!("FrontDoor OPEN {leaves} begin")),
            ("09:00:08", "FrontDoor CLOSE"),
            ("12:00:00", "FrontDoor OPEN"),
            ("12:00:09", &format!("FrontDoor CLOSE {leaves} end")),
            ("23:00:00", "bed_pressure ON Sleep begin"),
        ] {
            log += &format!("2024-03-0{day} {clock} {row}\n");
        }
    }
    log
}
