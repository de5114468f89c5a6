use std::fmt;

use super::{Coverage, LEAST_DEAD_ZONE_M2, SeenFloor};

impl fmt::Display for Coverage {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names = self.floors().map(|floor| &floor.name).chain(self.sensors.iter().map(|sensor| &sensor.name));
        let zone_rooms = self.dead_zones.iter().filter_map(|zone| zone.room.as_ref());
        let width = names.chain(zone_rooms).map(|name| name.chars().count()).max().unwrap_or(0).max(12);

        writeln!(f, "{:width$}  {:>9}  {:>27}", "walkable", "", "seen by so many sensors")?;
        writeln!(f, "{:width$}  {:>9}  {:>6}  {:>6}  {:>6}  {:>6}", "floor", "m2", "0", "1", "2", "3+")?;
        for floor in self.floors() {
            let seen = &floor.seen_by;
            let shares = [seen.none, seen.one, seen.two, seen.three_or_more];
            write!(f, "{:width$}  {:>9.2}", floor.name, floor.floor_m2)?;
            for share in shares {
                write!(f, "  {:>5.1}%", 100.0 * share)?;
            }
            writeln!(f)?;
        }
        writeln!(
            f,
            "\nThe floor measures {:.2} m2 ± {:.2} m2: cells of {} m, a body of {} m radius.",
            self.whole.floor_m2, self.whole.floor_error_m2, self.step_m, self.body_radius_m
        )?;

        if !self.sensors.is_empty() {
            writeln!(f, "\n{:width$}  {:>9}  {:>9}", "sensor", "sees m2", "alone m2")?;
        }
        for sensor in &self.sensors {
            writeln!(f, "{:width$}  {:>9.2}  {:>9.2}", sensor.name, sensor.seen_m2, sensor.alone_m2)?;
        }

        if self.dead_zones.is_empty() {
            return writeln!(f, "\nNo dead zone of {LEAST_DEAD_ZONE_M2} m2 or more.");
        }
        writeln!(f, "\n{:width$}  {:>9}  {:>9}  around x, y in m", "dead zone", "m2", "+/-")?;
        for zone in &self.dead_zones {
            let name = format!("{} {}", zone.number, zone.room.as_deref().unwrap_or("doorway"));
            let [x, y] = zone.middle;
            writeln!(f, "{name:width$}  {:>9.2}  {:>9.2}  {x:.2}, {y:.2}", zone.area_m2, zone.area_error_m2)?;
        }
        Ok(())
    }
}

impl Coverage {
    /// Every row of the table of floors: the rooms, the doorways if they count apart, and all.
    pub fn floors(&self) -> impl Iterator<Item = &SeenFloor> {
        self.rooms.iter().chain(&self.doorways).chain([&self.whole])
    }
}
