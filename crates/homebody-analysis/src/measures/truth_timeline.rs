use super::rooms::{SensorRooms, purpose};
use super::timeline::{MeasureTimeline, RoomStay, TimedWalk};
use homebody_core::activity::{
    AWAY, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, GOING_TO_BED, LYING_AWAKE, SHOWERING, SLEEPING,
};
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, SECOND, Span, WallTime, joined};
use homebody_timeline::{Episode, PersonTimeline};

/// Longest gap within one activity (our choice): a walk to the toilet does not make a second meal.
const APART: Span = MINUTE.times(5);

#[derive(Clone, Debug, Default)]
pub struct TruthDetails {
    /// Walks of the resident, in order of time.
    pub walks: Option<Vec<TimedWalk>>,
    pub company: Option<Vec<Interval<WallTime>>>,
}

impl MeasureTimeline {
    /// For the days that touch `recorded`.
    pub fn from_truth(person: &PersonTimeline<WallTime>, recorded: Interval<WallTime>) -> MeasureTimeline {
        MeasureTimeline::from_detailed_truth(person, &TruthDetails::default(), recorded)
    }

    /// The same, with details.
    pub fn from_detailed_truth(
        person: &PersonTimeline<WallTime>,
        details: &TruthDetails,
        recorded: Interval<WallTime>,
    ) -> MeasureTimeline {
        let first = recorded.begin.date();
        let begin = WallTime::midnight(first);
        let lasts = recorded.end - begin;
        let days = lasts.max(Span::ZERO).div_euclid(DAY) + i64::from(lasts.rem_euclid(DAY) > Span::ZERO);
        let known = |at: WallTime| Interval::starting(at, HOUR).overlap(recorded).ratio(HOUR);
        let hours = |day: i64| std::array::from_fn(|number| known(begin + day * DAY + number as i64 * HOUR));
        let mut rooms = SensorRooms::default();
        let mut stays: Vec<RoomStay> = Vec::new();
        for one in person.rooms.iter().filter(|one| one.label != AWAY) {
            let room = rooms.number((one.label.clone(), purpose(&one.label)));
            match stays.last_mut().filter(|stay| stay.label == room && stay.end() >= one.begin()) {
                Some(stay) => stay.time.end = one.end(),
                None => stays.push(Episode::new(room, one.time)),
            }
        }
        let of = |labels: &[&str]| -> Vec<Interval<WallTime>> {
            let done = person.activities.iter().filter(|one| labels.contains(&one.label.as_str()));
            done.map(|one| one.time).collect()
        };
        let begins = |labels: &[&str]| -> Option<Vec<WallTime>> {
            Some(joined(of(labels), APART).into_iter().map(|span| span.begin).collect())
        };
        MeasureTimeline {
            first,
            begin,
            recorded_h: (0..days).map(hours).collect(),
            rooms,
            stays,
            away: Some(joined(of(&[AWAY]), Span::ZERO)),
            in_bed: Some(joined(of(&[GOING_TO_BED, SLEEPING, LYING_AWAKE]), SECOND)),
            asleep: Some(of(&[SLEEPING])),
            showers: begins(&[SHOWERING]),
            meals: begins(&[EATING_BREAKFAST, EATING_LUNCH, EATING_DINNER]),
            walks: details.walks.clone(),
            company: details.company.as_ref().map(|company| {
                let mut company = company.clone();
                company.sort_unstable();
                joined(company, APART)
            }),
            ..MeasureTimeline::default()
        }
    }
}
