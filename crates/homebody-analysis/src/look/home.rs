use super::overview::{HomeSensor, Misfit, OfHome, SensorLook, UnlistedSensor};

/// Compares the sensors of a log, with its number of rows, with those of a home.
pub(super) fn of_home(name: &str, home: &[HomeSensor], sensors: &[SensorLook], rows: u64) -> OfHome {
    let find = |sensor: &SensorLook| {
        let is_it = |of: &&HomeSensor| {
            of.ids.contains(&sensor.id) || of.name == sensor.id || sensor.name.as_ref() == Some(&of.name)
        };
        home.iter().find(is_it)
    };
    let mut of_home = OfHome { name: name.to_owned(), ..OfHome::default() };
    let mut heard: Vec<&str> = Vec::new();
    let mut known_rows = 0;
    for sensor in sensors {
        let Some(found) = find(sensor) else {
            let (id, share) = (sensor.id.clone(), sensor.rows as f64 / rows.max(1) as f64);
            of_home.unknown.push(UnlistedSensor { id, rows: sensor.rows, share });
            continue;
        };
        heard.push(&found.name);
        of_home.known += 1;
        known_rows += sensor.rows;
        if found.kind != sensor.kind {
            let (id, name) = (sensor.id.clone(), found.name.clone());
            of_home.misfits.push(Misfit { id, name, is: sensor.kind, of_home: found.kind });
        }
    }
    of_home.unknown.sort_by_key(|unknown| std::cmp::Reverse(unknown.rows));
    of_home.unheard = home.iter().map(|of| of.name.clone()).filter(|name| !heard.contains(&name.as_str())).collect();
    of_home.known_share = (rows > 0).then(|| known_rows as f64 / rows as f64);
    of_home
}
