//! The timing of sensors and the link of a log, put into a scenario.

use homebody_analysis::timing::{HoldStyle, MotionTiming, SensorTiming};
use homebody_core::link::form::{LinkFile, SensorLinkFile};
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::logger::{LoggerFile, LumpFile, MessagesFile, OnOffFile};
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::preset::{MotionSettings, Preset};

/// Share of messages that arrive twice or not at all below which it is chance (our choice).
const CHANCE: f64 = 0.0005;
/// Ratio of the first quarter to the first twentieth of the ONs' durations above which they are not those of one
/// movement (our choice).
const ONE_LUMP: f64 = 1.2;

/// The scenario with the timing and the link of a log. Other parts stay.
pub fn fitted(edit: ScenarioEdit, timing: &MotionTiming, logger: &LoggerFile, link: Option<&LinkFile>) -> ScenarioEdit {
    let hold = timing.all.hold();
    let mut edit = edit.home(|home| {
        for sensor in &mut home.sensors {
            let name = sensor.name().to_owned();
            let id = logger.ids.get(&name).unwrap_or(&name).clone();
            let told = timing.sensors.iter().find(|one| one.sensor == id || one.sensor == name);
            fit(sensor, hold, told);
        }
    });
    if let Some(messages) = messages(hold, &timing.all) {
        edit = edit.logger(&LoggerFile { messages, ..logger.clone() });
    }
    // With OFFs, a repeated message only prolongs an ON, and repeated rows are the logger's.
    let repeated = if hold == HoldStyle::None { timing.repeated } else { 0.0 };
    let [repeated, missing] = [repeated, timing.missing].map(|share| (share > CHANCE).then_some(rounded(share)));
    if repeated.is_some() || missing.is_some() {
        let link = link.cloned().unwrap_or_default();
        let (duplicates, loss) = (repeated.or(link.rates.duplicates), missing.or(link.rates.loss));
        let link = LinkFile { rates: SensorLinkFile { duplicates, loss, ..link.rates }, ..link };
        edit = edit.link(&link);
    }
    edit
}

/// Fits the device that holds its ONs so, and the time after which it fires again.
fn fit(sensor: &mut SensorFile, hold: HoldStyle, told: Option<&SensorTiming>) {
    // While an ON is prolonged no row says when a unit that follows fires.
    let shortest = told.and_then(|told| told.refire_s).map(|[shortest, ..]| rounded(shortest));
    sensor.change_settings(|MotionSettings { preset, refire_s, .. }| {
        match hold {
            HoldStyle::Follow(_) => *preset = Preset::CasasFollow,
            HoldStyle::Pulse(_) if *preset == Preset::CasasFollow => *preset = Preset::CasasPulse,
            _ => {}
        }
        if let Some(shortest) = shortest.filter(|_| !matches!(hold, HoldStyle::Follow(_))) {
            let [least, most] = refire_s.unwrap_or(preset.timing().refire_s);
            *refire_s = Some([shortest, rounded(shortest + most - least)]);
        }
    });
}

/// The messages of a log with such ONs; `None` without OFFs.
fn messages(hold: HoldStyle, all: &SensorTiming) -> Option<MessagesFile> {
    let quantiles @ [shortest, first, ..] = all.on_s?;
    let (hold_s, ends) = match hold {
        HoldStyle::None => return None,
        // A quarter of all lies between two quartiles, and as many at both ends.
        HoldStyle::Pulse(median) => (median, quantiles.windows(2).map(|ends| [ends[0], ends[1]]).collect()),
        // The shortest are of one movement.
        HoldStyle::Follow(_) if first <= shortest * ONE_LUMP => ((shortest + first) / 2.0, vec![[shortest, first]]),
        HoldStyle::Follow(shortest) => (shortest, vec![[shortest, shortest]]),
    };
    let lump = |ends: &[f64; 2]| LumpFile { share: 1.0, parts: ends.map(|end| rounded(end / hold_s)) };
    Some(MessagesFile::OnOff(OnOffFile { hold_s: rounded(hold_s), lumps: ends.iter().map(lump).collect() }))
}

fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_analysis::timing::Quantiles;
    use homebody_core::home::form::HomeFile;
    use homebody_core::scenario::ScenarioFile;
    use homebody_core::sensors::ceiling_motion::CeilingMotionFile;

    const ON: Quantiles = [2.9, 2.95, 3.0, 3.1, 3.4];

    fn timing(on_s: Option<Quantiles>, repeated: f64, missing: f64) -> MotionTiming {
        let of = |sensor: &str| SensorTiming {
            sensor: sensor.into(),
            firings: 100,
            on_s,
            refire_s: Some([5.0, 6.0, 7.0, 20.0, 50.0]),
        };
        MotionTiming { all: of(""), sensors: vec![of("hall")], repeated, missing }
    }

    /// The hall's sensor, the logger and the link after they were fitted.
    fn after(timing: &MotionTiming) -> (SensorFile, LoggerFile, Option<LinkFile>) {
        let mut home = HomeFile::new("one room");
        let area = vec![[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]];
        let mut hall = hall(area);
        hall.settings.preset = Preset::CasasFollow;
        home.sensors.push(SensorFile::CeilingMotion(hall));
        let corners = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]];
        home.rooms.push(homebody_core::plan::form::RoomFile::new("hall", corners));
        let edit = ScenarioEdit::new(ScenarioFile::new("made", "2009-03-02T00:00:00", 1.0), home);
        let texts = fitted(edit, timing, &LoggerFile::default(), None).into_texts();
        let read = |name: &str| texts.get(name).cloned();
        let home: HomeFile = serde_json::from_str(&read("home.json").unwrap()).unwrap();
        let logger = read("logger.json").map(|text| serde_json::from_str(&text).unwrap()).unwrap_or_default();
        let link = read("link.json").map(|text| serde_json::from_str(&text).unwrap());
        (home.sensors[0].clone(), logger, link)
    }

    fn hall(area: Vec<[f64; 2]>) -> CeilingMotionFile {
        let text = serde_json::json!({ "name": "hall", "area": area });
        serde_json::from_value(text).unwrap()
    }

    #[test]
    fn pulses_are_held_as_they_were_and_fire_again_as_soon() {
        let (sensor, logger, link) = after(&timing(Some(ON), 0.02, 0.01));
        let sensor = sensor.settings().expect("a sensor that looks for movement");
        assert_eq!(sensor.preset, Preset::CasasPulse);
        // As wide as the preset's 5.4 to 5.6 s.
        assert_eq!(sensor.refire_s, Some([5.0, 5.2]));
        let MessagesFile::OnOff(OnOffFile { hold_s, lumps }) = logger.messages else { panic!("ON and OFF") };
        assert_eq!((hold_s, lumps.len(), lumps[0].parts), (3.0, 4, [0.967, 0.983]));
        let link = link.unwrap();
        assert_eq!((link.rates.duplicates, link.rates.loss), (None, Some(0.01)));
    }

    #[test]
    fn a_log_without_offs_tells_of_repeated_messages_alone() {
        let (sensor, logger, link) = after(&timing(None, 0.02, 0.0));
        let sensor = sensor.settings().expect("a sensor that looks for movement");
        assert_eq!((sensor.preset, sensor.refire_s), (Preset::CasasFollow, Some([5.0, 5.1])));
        assert_eq!(logger, LoggerFile::default());
        assert_eq!(link.unwrap().rates.duplicates, Some(0.02));
        assert_eq!(after(&timing(None, 0.0, 0.0)).2, None);
    }
}
