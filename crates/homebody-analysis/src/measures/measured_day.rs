//! A day of a timeline, and what each measure comes to on it.

use super::rooms::Purpose;
use super::timeline::{MeasureTimeline, within_h};
use super::wandering::WanderingStarts;
use crate::density::{CellSum, DensityCell, distance};
use homebody_core::time::{DAY, Interval, MINUTE, SECOND, Span, WallTime, without};

/// Time in the bathroom below which a person only passes through (our choice).
pub const VISIT: Span = SECOND.times(20);
/// Time within which a person who comes back has not left (our choice).
const VISITS_APART: Span = MINUTE;
/// Shortest outing.
const LEAST_OUTING: Span = MINUTE.times(30);
/// Time in a room after which a person sits there.
const SITS: Span = MINUTE.times(30);
/// Largest number of unknown hours of a day or a night with measures (our choice).
pub const UNKNOWN_H: f64 = 1.0;
/// Smallest number of ways, and of walks of a known length, for a distribution (our choice).
const LEAST_WAYS: usize = 10;
const LEAST_WALKS: usize = 5;
/// Number of days of a weekly measure.
const WEEK: usize = 7;

pub struct DayContext<'a> {
    pub timeline: &'a MeasureTimeline,
    pub bathroom: Vec<Interval<WallTime>>,
    pub sitting: Vec<Interval<WallTime>>,
    pub wandering: WanderingStarts,
    /// The height of a level of density, in firings an hour, once enough days tell it.
    pub step_per_h: Option<f64>,
}

impl<'a> DayContext<'a> {
    pub fn new(timeline: &'a MeasureTimeline, step_per_h: Option<f64>) -> DayContext<'a> {
        let long = timeline.stays.iter().map(|stay| stay.time).filter(|stay| stay.length() >= SITS);
        DayContext {
            timeline,
            bathroom: visits_to(&timeline.visits(Purpose::Bathroom, Span::ZERO)),
            sitting: long.collect(),
            wandering: super::wandering::wandering(&timeline.stays),
            step_per_h,
        }
    }
}

/// Visits to a room: times that are close are one, with so much time in the room in all that the person has not just passed its door.
fn visits_to(times: &[Interval<WallTime>]) -> Vec<Interval<WallTime>> {
    let visits = times.chunk_by(|a, b| b.begin - a.end <= VISITS_APART);
    let there = |visit: &[Interval<WallTime>]| visit.iter().map(|time| time.length()).sum::<Span>();
    let whole = |visit: &[Interval<WallTime>]| Interval::new(visit[0].begin, visit[visit.len() - 1].end);
    visits.filter(|visit| there(visit) >= VISIT).map(whole).collect()
}

/// A day, with the night that ends on it.
pub struct MeasuredDay<'a> {
    common: &'a DayContext<'a>,
    number: usize,
    day: Interval<WallTime>,
    /// From lying down to getting up, and from lying down again until the day ends.
    night: Option<Interval<WallTime>>,
    evening: Option<Interval<WallTime>>,
    is_known: bool,
    is_night_known: bool,
}

impl<'a> MeasuredDay<'a> {
    /// A day by its number. A day that is not over is not known yet, though the night that ended on it may be.
    pub fn new(common: &'a DayContext<'a>, number: usize, is_over: bool) -> MeasuredDay<'a> {
        let timeline = common.timeline;
        let day = timeline.day(number);
        let known = |span: Interval<WallTime>| timeline.known_h(span) > span.length().seconds() / 3600.0 - UNKNOWN_H;
        MeasuredDay {
            common,
            number,
            day,
            night: timeline.night(number),
            evening: timeline.evening(number),
            is_known: is_over && known(day),
            is_night_known: known(Interval::new(day.begin - DAY / 4, day.begin + DAY * 3 / 8)),
        }
    }

    /// So little of the day is unknown that it has measures.
    pub fn is_known(&self) -> bool {
        self.is_known
    }

    /// The night, if it is known, with its begin and end.
    fn by_night(&self) -> Option<Interval<WallTime>> {
        let are_near = |one: WallTime, other: WallTime| (one - other).abs() <= VISITS_APART;
        let is_cut = |night: &Interval<WallTime>| {
            let unknown = &self.common.timeline.unknown;
            unknown.iter().any(|gap| are_near(gap.begin, night.end) || are_near(night.begin, gap.end))
        };
        self.night.filter(|night| self.is_night_known && !is_cut(night))
    }

    fn nights(&self) -> impl Iterator<Item = Interval<WallTime>> {
        self.night.into_iter().chain(self.evening)
    }

    fn count(&self, instants: Option<&[WallTime]>) -> Option<f64> {
        let instants = instants.filter(|_| self.is_known)?;
        Some(instants.iter().filter(|&&at| self.day.contains(at)).count() as f64)
    }

    /// The timeline, if it comes from movements.
    fn watched(&self) -> Option<&MeasureTimeline> {
        Some(self.common.timeline).filter(|timeline| !timeline.is_unwatched)
    }

    /// The same, if the sensors are in so many known rooms.
    fn among_rooms(&self, least: usize) -> Option<&MeasureTimeline> {
        self.watched().filter(|timeline| timeline.rooms.rooms.len() >= least)
    }

    pub(super) fn time_in_bed(&self) -> Option<f64> {
        Some(within_h(self.common.timeline.in_bed.as_ref()?, self.by_night()?))
    }

    pub(super) fn bedtime(&self) -> Option<f64> {
        Some((self.by_night()?.begin - self.day.begin + DAY).seconds() / 3600.0)
    }

    pub(super) fn rising(&self) -> Option<f64> {
        Some((self.by_night()?.end - self.day.begin).seconds() / 3600.0)
    }

    pub(super) fn sleep(&self) -> Option<f64> {
        Some(within_h(self.common.timeline.asleep.as_ref()?, self.by_night()?))
    }

    pub(super) fn restlessness(&self) -> Option<f64> {
        let night = self.by_night()?;
        let stirs = self.common.timeline.stirs.as_ref()?.iter().filter(|&&at| night.contains(at));
        Some(stirs.count() as f64 / self.time_in_bed().filter(|&hours| hours > 0.0)?)
    }

    fn has_bathroom(&self) -> Option<()> {
        self.common.timeline.rooms.has(Purpose::Bathroom).then_some(())
    }

    pub(super) fn bathroom_night(&self) -> Option<f64> {
        self.has_bathroom()?;
        let night = self.by_night()?;
        let visits = self.common.bathroom.iter();
        Some(visits.filter(|visit| visit.begin > night.begin && visit.end <= night.end).count() as f64)
    }

    pub(super) fn bathroom_day(&self) -> Option<f64> {
        self.has_bathroom()?;
        let is_by_night = |at: WallTime| self.nights().any(|night| night.contains(at));
        let by_day: Vec<WallTime> =
            self.common.bathroom.iter().map(|visit| visit.begin).filter(|&at| !is_by_night(at)).collect();
        self.count(Some(&by_day))
    }

    pub(super) fn showers(&self) -> Option<f64> {
        self.count(self.common.timeline.showers.as_deref())
    }

    pub(super) fn meals(&self) -> Option<f64> {
        self.count(self.common.timeline.meals.as_deref())
    }

    pub(super) fn time_out(&self) -> Option<f64> {
        let away = self.common.timeline.away.as_ref().filter(|_| self.is_known)?;
        Some(within_h(away, self.day))
    }

    pub(super) fn outings(&self) -> Option<f64> {
        let away = self.common.timeline.away.as_ref()?;
        // An absence counts on the day on which it has lasted for so long: before that it is not known.
        let long = away.iter().filter(|span| span.length() >= LEAST_OUTING);
        self.count(Some(&long.map(|span| span.begin + LEAST_OUTING).collect::<Vec<_>>()))
    }

    pub(super) fn room_changes(&self) -> Option<f64> {
        let stays = &self.among_rooms(2)?.stays;
        let changes = stays.windows(2).filter(|pair| pair[0].label != pair[1].label).map(|pair| pair[1].begin());
        self.count(Some(&changes.collect::<Vec<_>>()))
    }

    /// The paces of the ways of the day, the slowest first.
    fn paces(&self) -> Option<Vec<f64>> {
        let passages = self.common.timeline.passages.as_ref().filter(|_| self.is_known)?;
        let from = passages.partition_point(|passage| passage.at < self.day.begin);
        let to = passages.partition_point(|passage| passage.at < self.day.end);
        let mut paces: Vec<f64> = passages[from..to].iter().map(|passage| passage.of_usual).collect();
        paces.sort_by(f64::total_cmp);
        (paces.len() >= LEAST_WAYS).then_some(paces)
    }

    pub(super) fn pace(&self) -> Option<f64> {
        let paces = self.paces()?;
        Some(paces[paces.len() / 2])
    }

    pub(super) fn pace_slow(&self) -> Option<f64> {
        let paces = self.paces()?;
        Some(paces[paces.len() / 10])
    }

    /// The speed of the walks of the day at a share of them, the slowest first.
    pub(super) fn speed(&self, share: f64) -> Option<f64> {
        let walks = self.common.timeline.walks.as_ref().filter(|_| self.is_known)?;
        let from = walks.partition_point(|walk| walk.at < self.day.begin);
        let to = walks.partition_point(|walk| walk.at < self.day.end);
        let mut speeds: Vec<f64> = walks[from..to].iter().map(|walk| walk.speed_m_s).collect();
        speeds.sort_by(f64::total_cmp);
        (speeds.len() >= LEAST_WALKS).then(|| speeds[((speeds.len() - 1) as f64 * share).round() as usize])
    }

    pub(super) fn company(&self) -> Option<f64> {
        let company = self.common.timeline.company.as_ref().filter(|_| self.is_known)?;
        Some(within_h(company, self.day))
    }

    pub(super) fn visits(&self) -> Option<f64> {
        let company = self.common.timeline.company.as_ref()?;
        self.count(Some(&company.iter().map(|visit| visit.begin).collect::<Vec<_>>()))
    }

    pub(super) fn pacing(&self) -> Option<f64> {
        self.among_rooms(2)?;
        self.count(Some(&self.common.wandering.pacing))
    }

    pub(super) fn lapping(&self) -> Option<f64> {
        self.among_rooms(3)?;
        self.count(Some(&self.common.wandering.lapping))
    }

    pub(super) fn sedentary(&self) -> Option<f64> {
        self.watched()?.in_bed.as_ref().filter(|_| self.is_known)?;
        let nights: Vec<Interval<WallTime>> = self.nights().collect();
        let has_lasted = |span: &&Interval<WallTime>| span.end.min(self.day.end) - span.begin >= SITS;
        let sitting: Vec<Interval<WallTime>> = self.common.sitting.iter().filter(has_lasted).copied().collect();
        let by_day = without(&sitting, &nights);
        Some(within_h(&by_day, self.day))
    }

    /// The hours of so many days up to this one, which must all be known.
    fn week(&self, back: usize) -> Option<&'a [[DensityCell; 24]]> {
        let timeline = self.common.timeline;
        let end = (self.number + 1).checked_sub(back)?;
        let from = end.checked_sub(WEEK)?;
        let are_known = timeline.recorded_h[from..end].iter().all(|day| day.iter().sum::<f64>() > 24.0 - UNKNOWN_H);
        timeline.cells.as_ref()?.get(from..end).filter(|_| are_known)
    }

    pub(super) fn density(&self, hours: std::ops::Range<usize>) -> Option<f64> {
        let cells = self.common.timeline.cells.as_ref().filter(|_| self.is_known)?;
        CellSum::from_cells(&cells[self.number][hours]).density_per_h
    }

    pub(super) fn density_distance(&self) -> Option<f64> {
        distance::distance(self.week(0)?, self.week(WEEK)?, self.common.step_per_h?)
    }

    /// Firings by hour of a week, with the sum of their squared differences from their mean.
    fn hours(&self) -> Option<(Vec<f64>, f64, f64)> {
        let hours: Vec<f64> = self.week(0)?.iter().flatten().map(|cell| cell.events as f64).collect();
        let mean = hours.iter().sum::<f64>() / hours.len() as f64;
        let squares = hours.iter().map(|hour| (hour - mean) * (hour - mean)).sum::<f64>();
        (squares > 0.0).then_some((hours, mean, squares))
    }

    pub(super) fn interdaily_stability(&self) -> Option<f64> {
        let (hours, mean, squares) = self.hours()?;
        let of_hour = |hour: usize| {
            let of_days = hours.iter().skip(hour).step_by(24);
            let difference = of_days.sum::<f64>() / WEEK as f64 - mean;
            difference * difference
        };
        Some(WEEK as f64 * (0..24).map(of_hour).sum::<f64>() / squares)
    }

    pub(super) fn intradaily_variability(&self) -> Option<f64> {
        let (hours, _, squares) = self.hours()?;
        let steps = hours.windows(2).map(|pair| (pair[1] - pair[0]) * (pair[1] - pair[0])).sum::<f64>();
        Some(hours.len() as f64 * steps / ((hours.len() - 1) as f64 * squares))
    }
}
