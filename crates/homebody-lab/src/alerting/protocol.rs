//! The quality of news about people, judged as a device would be: day by day, without the future.
//!
//! News before a condition begins is false, and so is any news of a person without one. Everything that is judged comes from the log of
//! the sensors.

use super::people::{StoredPerson, WatchedPerson};
use super::wilson;
use homebody_analysis::measures::Measures;
use homebody_core::statistics::quantile;
use homebody_placement::adequacy::{FIRST, FalseEpisodes, Z};
use serde::Serialize;

/// Numbers of days after the onset until people count as found.
pub const WITHIN: [usize; 3] = [7, 14, 28];
/// Share of people whose condition begins in a month, for the precision.
const MONTHLY: f64 = 0.05;
/// Days of a month.
const MONTH: f64 = 30.4;

/// A person with the measures of the log.
pub struct Judged {
    pub person: WatchedPerson,
    pub measures: Measures,
}

impl Judged {
    pub fn stored(stored: &StoredPerson) -> Judged {
        Judged { person: stored.person(), measures: stored.measures() }
    }
}

/// The numbers of the days with news.
pub type NewsDays = Vec<usize>;

/// A way to find changes.
pub struct JudgedMethod {
    pub name: &'static str,
    /// The thresholds for precision and recall, the lowest first.
    pub thresholds: Vec<f64>,
    /// The threshold that was fitted on other people.
    pub fitted: f64,
    #[expect(clippy::type_complexity, reason = "a name for it would say less")]
    pub news: Box<dyn Fn(&Judged, f64) -> NewsDays + Sync>,
}

/// The quality of a method.
#[derive(Clone, Debug, Serialize)]
pub struct MethodResult {
    pub method: &'static str,
    pub threshold: f64,
    /// False news per home and week, with the interval of 95 %.
    pub false_per_week: f64,
    pub false_95: [f64; 2],
    /// The share of true news among all, if conditions begin in 5 % of the people each month.
    pub precision: f64,
    /// The area under the curve of precision and recall within 28 days.
    pub area: f64,
    /// By severity for all conditions together, then by condition and severity.
    pub rows: Vec<FoundRow>,
}

#[derive(Clone, Debug, Serialize)]
pub struct FoundRow {
    pub condition: String,
    pub severity: String,
    pub people: usize,
    /// The share found within 7, 14 and 28 days, each with its interval of 95 %.
    pub within: Vec<(usize, f64, [f64; 2])>,
    /// Days from the onset: quartile, median, quartile of those who are found.
    pub days: Option<[f64; 3]>,
}

/// The rate of false news.
pub fn rate<'a>(people: impl Iterator<Item = (&'a Judged, NewsDays)>) -> FalseEpisodes {
    let mut all = FalseEpisodes::default();
    for (one, news) in people {
        let until = one.person.healthy_until(one.measures.days.len());
        all.weeks += until.saturating_sub(FIRST) as f64 / 7.0;
        all.count += news.iter().filter(|day| (FIRST..until).contains(day)).count() as f64;
    }
    all
}

pub fn judge(people: &[Judged], method: &JudgedMethod) -> MethodResult {
    let news = |threshold: f64| -> Vec<NewsDays> { people.iter().map(|one| (method.news)(one, threshold)).collect() };
    let of_fitted = news(method.fitted);
    let false_news = rate(people.iter().zip(of_fitted.iter().cloned()));
    let apart = Z * false_news.count.max(1.0).sqrt() / false_news.weeks.max(1e-9);
    let per_week = false_news.per_week();
    let delays = delays(people, &of_fitted);
    let curve: Vec<(f64, f64)> = method.thresholds.iter().map(|threshold| point(people, &news(*threshold))).collect();
    MethodResult {
        method: method.name,
        threshold: method.fitted,
        false_per_week: per_week,
        false_95: [(per_week - apart).max(0.0), per_week + apart],
        precision: precision(share_within(&delays, 28), per_week),
        area: area(&curve),
        rows: rows(people, &delays),
    }
}

/// Days from the onset to the first news, by person with a condition.
fn delays(people: &[Judged], news: &[NewsDays]) -> Vec<(usize, Option<usize>)> {
    let of = |(number, (one, news)): (usize, (&Judged, &NewsDays))| {
        let onset = one.person.condition.as_ref()?.onset;
        Some((number, news.iter().filter(|day| **day >= onset).map(|day| day - onset).min()))
    };
    people.iter().zip(news).enumerate().filter_map(of).collect()
}

fn share_within(delays: &[(usize, Option<usize>)], days: usize) -> f64 {
    let found = delays.iter().filter(|(_, delay)| delay.is_some_and(|delay| delay < days)).count();
    found as f64 / delays.len().max(1) as f64
}

/// The precision at the usual frequency of conditions: the share of the true news among all of a month.
fn precision(found: f64, false_per_week: f64) -> f64 {
    let by_mistake = 1.0 - (-false_per_week * MONTH / 7.0).exp();
    let (right, wrong) = (MONTHLY * found, (1.0 - MONTHLY) * by_mistake);
    if right + wrong > 0.0 { right / (right + wrong) } else { 1.0 }
}

/// Recall and precision.
fn point(people: &[Judged], news: &[NewsDays]) -> (f64, f64) {
    let recall = share_within(&delays(people, news), 28);
    (recall, precision(recall, rate(people.iter().zip(news.iter().cloned())).per_week()))
}

/// The area under a curve of recall and precision, by trapezoids, from a recall of 0 on.
fn area(curve: &[(f64, f64)]) -> f64 {
    let mut sorted = curve.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
    let first = sorted.first().map_or(0.0, |(recall, precision)| recall * precision);
    let between = |pair: &[(f64, f64)]| (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1) / 2.0;
    first + sorted.windows(2).map(between).sum::<f64>()
}

fn rows(people: &[Judged], delays: &[(usize, Option<usize>)]) -> Vec<FoundRow> {
    let of = |number: usize| people[number].person.condition.as_ref().map(|of| (of.name, of.severity));
    let mut kinds: Vec<(&str, &str)> = delays.iter().filter_map(|(number, _)| of(*number)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let all = ["mild", "moderate", "severe"].map(|severity| (ALL, severity));
    let row = |(condition, severity): (&str, &str)| {
        let is_of = |kind: Option<(&str, &str)>| {
            kind.is_some_and(|(name, other)| (condition == ALL || name == condition) && other == severity)
        };
        let own: Vec<(usize, Option<usize>)> =
            delays.iter().filter(|(number, _)| is_of(of(*number))).copied().collect();
        let found: Vec<f64> = own.iter().filter_map(|(_, delay)| Some((*delay)? as f64)).collect();
        let within = WITHIN.map(|days| {
            let share = share_within(&own, days);
            (days, share, wilson((share * own.len() as f64).round() as usize, own.len()))
        });
        let at = |share: f64| quantile(&found, share);
        let days = at(0.25).zip(at(0.5)).zip(at(0.75)).map(|((low, middle), high)| [low, middle, high]);
        FoundRow {
            condition: condition.to_owned(),
            severity: severity.to_owned(),
            people: own.len(),
            within: within.into(),
            days,
        }
    };
    all.into_iter().chain(kinds).map(row).filter(|row| row.people > 0).collect()
}

/// The condition of rows about all conditions.
pub const ALL: &str = "all";

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_analysis::measures::{DayMeasures, MEASURES};
    use jiff::civil::date;

    const YEAR: u32 = 365;

    /// The result of a method with news of each person at a distance from the onset, or from day 200 of a healthy person.
    fn result(of: fn(&WatchedPerson, usize) -> NewsDays) -> MethodResult {
        let day = DayMeasures { date: date(2024, 1, 1), is_whole: true, values: vec![None; MEASURES.len()] };
        let measures = Measures { days: vec![day; YEAR as usize], ..Measures::default() };
        let person = |number| Judged { person: WatchedPerson::draw(number, (YEAR, 1)), measures: measures.clone() };
        let people: Vec<Judged> = (0..96).map(person).collect();
        let onset = |person: &WatchedPerson| person.condition.as_ref().map_or(200, |condition| condition.onset);
        let news = move |one: &Judged, _: f64| of(&one.person, onset(&one.person));
        judge(&people, &JudgedMethod { name: "test", thresholds: vec![1.0], fitted: 1.0, news: Box::new(news) })
    }

    #[test]
    fn news_before_the_onset_and_of_healthy_people_is_false() {
        let early = result(|person, onset| if person.condition.is_some() { vec![onset - 1] } else { Vec::new() });
        assert!(early.false_per_week > 0.0 && early.rows[0].within[2].1 == 0.0, "{early:?}");
        let healthy = result(|person, onset| if person.condition.is_none() { vec![onset] } else { Vec::new() });
        assert!(healthy.false_per_week > 0.0 && healthy.precision == 0.0, "{healthy:?}");
        let first = result(|_, _| vec![FIRST - 1]);
        assert_eq!(first.false_per_week, 0.0, "no reference lies before");
    }

    #[test]
    fn people_are_found_on_the_day_of_the_first_true_news() {
        let tenth =
            result(|person, onset| if person.condition.is_some() { vec![onset + 10, onset + 30] } else { Vec::new() });
        let shares: Vec<f64> = tenth.rows[1].within.iter().map(|(_, share, _)| *share).collect();
        assert_eq!((shares, tenth.rows[1].days), (vec![0.0, 1.0, 1.0], Some([10.0; 3])));
        assert_eq!((tenth.false_per_week, tenth.precision, tenth.area), (0.0, 1.0, 1.0));
        assert_eq!(tenth.rows.len(), 3 + 8 * 3, "each condition in each severity");
    }

    #[test]
    fn half_of_the_people_have_a_condition_and_one_home_has_two_residents() {
        let people: Vec<WatchedPerson> = (0..160).map(|number| WatchedPerson::draw(number, (YEAR, 3))).collect();
        let share = |holds: fn(&WatchedPerson) -> bool| people.iter().filter(|one| holds(one)).count() as f64 / 160.0;
        assert_eq!(share(|one| one.condition.is_some()), 0.5);
        assert_eq!((share(WatchedPerson::has_company), share(|one| one.has_faults)), (0.2, 0.5));
        assert!(people.iter().all(|one| one.healthy_until(365) >= 60 && !one.events.is_empty()));
    }
}
