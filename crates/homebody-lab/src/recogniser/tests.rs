use super::*;
use homebody_core::time::HOUR;
use std::path::PathBuf;

const ROUTINE: &str = "She gets up at 8:00. She goes to bed at 23:00.
She goes to the bathroom 5 minutes after she gets up for 5 minutes. She takes a shower 15 minutes after she gets up for 10 minutes.
She prepares breakfast 40 minutes after she gets up for 10 minutes, then eats for 10 minutes.
She prepares lunch at 13:00 for 20 minutes, then eats for 20 minutes. She leaves home at 15:00 for 2 hours.";

fn day(number: i64) -> WallTime {
    WallTime::EPOCH + number * DAY
}

/// Days of the flat that stand for real ones, with annotations in the words of the data set.
fn annotated(days: u32) -> Log {
    let mut log = Flat::new(ROUTINE).unwrap().simulate(77, days, day(15_000)).unwrap();
    for activity in &mut log.activities {
        activity.label = classes::class_of(&activity.label).map_or("", |class| CLASSES[class]).into();
    }
    // Going out begins at the coats and ends there: to the data set it is one.
    log.activities.dedup_by(|next, last| {
        let is_same = next.label == last.label;
        last.time.end = if is_same { next.end() } else { last.end() };
        is_same
    });
    log.activities.retain(|activity| !activity.label.is_empty());
    log
}

#[test]
fn training_on_similar_days_recognises_activities() {
    let log = annotated(8);
    let prepared = Prepared::new(&log).unwrap();
    assert!(prepared.routine.contains("She gets up at about 08:0"), "{}", prepared.routine);
    let cases = vec![prepared.case(1, 4).unwrap(), prepared.case(2, 4).unwrap()];
    let experiment = prepared.experiment(cases, 4);
    assert_eq!(experiment.real_days, [4, 4]);
    for class in ["Sleeping", "Showering", "Breakfast", "Lunch", "Spare_Time/TV", "Leaving"] {
        assert!(experiment.classes.contains(&class), "{class} {:?}", experiment.classes);
    }
    let [simulated, real, ..] = &experiment.scores[..] else { panic!("four scores") };
    assert!(simulated.macro_f1 > 0.6 && real.macro_f1 > 0.7, "{experiment}");
    assert_eq!(real.of_real, 1.0);
    // The negative control: where the annotations of the second half are ten hours off, they are not recognised.
    let mut shifted = log.clone();
    for activity in shifted.activities.iter_mut().filter(|activity| activity.begin() >= day(15_004)) {
        activity.time = activity.time.map(|at| at + 10 * HOUR);
    }
    let prepared = Prepared::new(&shifted).unwrap();
    let control = prepared.experiment(vec![prepared.case(1, 4).unwrap()], 4);
    assert!(control.scores[0].macro_f1 < simulated.macro_f1 - 0.2, "{control}");
}

#[test]
fn rejects_unsuitable_logs() {
    let log = annotated(5);
    assert!(matches!(Prepared::new(&log), Err(RecogniserError::TooFewDays(5))));
    let silent = Log { activities: Vec::new(), ..log.clone() };
    assert!(matches!(Prepared::new(&silent), Err(RecogniserError::NoActivities)));
    let mut other = annotated(6);
    other.sensors[0] = "somewhere".into();
    assert!(matches!(Prepared::new(&other), Err(RecogniserError::NoSensor(name)) if name == "Bed Pressure Bedroom"));
}

/// The data set, where HOMEBODY_DATA names the folder that holds it.
#[test]
fn simulated_days_teach_nearly_as_much_as_real_ones() {
    const NAME: &str = "uci_adl_ordonez/OrdonezA_Sensors.txt";
    let path =
        std::env::var_os("HOMEBODY_DATA").map(|data| PathBuf::from(data).join(NAME)).filter(|path| path.is_file());
    let Some(path) = path else {
        eprintln!("skipped: HOMEBODY_DATA does not name a folder that holds {NAME}");
        return;
    };
    let log = homebody_log::read(homebody_log::LogSource::recognise(&path).unwrap(), &Default::default()).unwrap();
    let prepared = Prepared::new(&log).unwrap();
    let experiment = prepared.experiment(vec![prepared.case(1, 14).unwrap(), prepared.case(2, 14).unwrap()], 14);
    assert_eq!(experiment.classes.len(), 8, "{:?}", experiment.classes);
    assert!(experiment.scores[1].macro_f1 > 0.9 && experiment.scores[0].of_real > 0.8, "{experiment}");
}
