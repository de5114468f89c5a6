use super::*;
use crate::sample::days;
use jiff::civil::date;

/// Sleep and getting up as usual for some days, then as given.
fn log(usual: usize, later: &[(f64, f64)]) -> Measures {
    let around = |day: usize| [-0.3, 0.1, 0.2, -0.1, 0.1][day % 5];
    let column = |of: fn((f64, f64)) -> f64| {
        let before = (0..usual).map(|day| Some(of((7.0, 7.5)) + around(day)));
        before.chain(later.iter().enumerate().map(|(day, values)| Some(of(*values) + around(day)))).collect()
    };
    days(&[("time_in_bed", column(|(bed, _)| bed)), ("rising", column(|(_, rising)| rising))])
}

#[test]
fn finds_a_slow_change_and_says_when_it_began() {
    let slow: Vec<(f64, f64)> = (0..40).map(|day| (7.0 + f64::from(day) / 20.0, 7.5 + f64::from(day) / 30.0)).collect();
    let watched = watch(&log(40, &slow), WatchOptions::default());
    let [episode] = &watched.episodes[..] else { panic!("{:?}", watched.episodes) };
    assert!(episode.since >= date(2024, 2, 9) && episode.found < date(2024, 3, 9), "{episode:?}");
    assert_eq!((episode.over, watched.headline.state), (None, HeadlineState::Changed));
    assert!(episode.words.contains("more time in bed") && episode.words.contains("later"), "{}", episode.words);
}

#[test]
fn says_nothing_of_usual_days() {
    let watched = watch(&log(90, &[]), WatchOptions::default());
    assert!(watched.episodes.is_empty(), "{:?}", watched.episodes);
    assert_eq!((watched.headline.state, &watched.headline.words[..]), (HeadlineState::AsUsual, "As usual"));
    let reference = watched.reference.unwrap();
    assert_eq!((reference.from, reference.to, reference.days), (date(2024, 1, 1), date(2024, 1, 28), 28));
}

#[test]
fn an_episode_ends_when_the_days_are_as_usual_again() {
    let ill = [[(9.5, 9.0); 10].as_slice(), &[(7.0, 7.5); 20]].concat();
    let watched = watch(&log(40, &ill), WatchOptions::default());
    let [episode] = &watched.episodes[..] else { panic!("{:?}", watched.episodes) };
    assert_eq!(episode.course, Course::Over);
    assert!(episode.over.is_some_and(|over| over >= date(2024, 2, 19) && over < date(2024, 2, 22)), "{episode:?}");
    let kinds: Vec<NewsKind> = watched.news.iter().map(|news| news.kind).collect();
    assert_eq!((kinds.first(), kinds.last()), (Some(&NewsKind::Found), Some(&NewsKind::Over)));
}

#[test]
fn news_of_a_day_does_not_depend_on_later_days() {
    let ill = [[(9.0, 8.5); 12].as_slice(), &[(7.0, 7.5); 9], &[(9.5, 9.0); 14]].concat();
    let whole = log(40, &ill);
    let at_the_end = watch(&whole, WatchOptions::default()).news;
    assert!(at_the_end.len() >= 3, "{at_the_end:?}");
    let mut day_by_day: Vec<EpisodeNews> = Vec::new();
    for known in 1..=whole.days.len() {
        let until = Measures { days: whole.days[..known].to_vec(), ..whole.clone() };
        let news = watch(&until, WatchOptions::default()).news;
        day_by_day.extend(news.into_iter().filter(|one| one.date == whole.days[known - 1].date));
    }
    assert_eq!(day_by_day, at_the_end);
}

#[test]
fn a_marked_day_begins_a_new_reference() {
    let moved = log(40, &[(9.5, 9.0); 40]);
    let marked = [date(2024, 2, 14)];
    let watched = watch(&moved, WatchOptions { marked: &marked, ..WatchOptions::default() });
    assert!(watched.episodes.iter().all(|episode| episode.over.is_some()), "{:?}", watched.episodes);
    let reference = watched.reference.unwrap();
    assert_eq!((reference.from, reference.is_marked), (date(2024, 2, 14), true));
    assert_eq!(watched.headline.state, HeadlineState::AsUsual);
}

#[test]
fn few_days_are_not_called_usual() {
    let watched = watch(&log(5, &[]), WatchOptions::default());
    assert_eq!(watched.headline.state, HeadlineState::NotKnown);
    assert!(watched.headline.words.contains("5 complete days of 7"), "{}", watched.headline.words);
    let watched = watch(&log(12, &[]), WatchOptions::default());
    assert!(watched.headline.words.contains("only large changes"), "{}", watched.headline.words);
    assert_eq!(watch(&log(0, &[]), WatchOptions::default()).headline.words, "No complete day is known yet");
}

#[test]
fn days_away_are_absences_and_no_change() {
    let mut measures = log(60, &[]);
    let out = MEASURES.iter().position(|measure| measure.name == "time_out").unwrap();
    for day in &mut measures.days[45..49] {
        day.values = vec![None; MEASURES.len()];
        day.values[out] = Some(24.0);
    }
    let watched = watch(&measures, WatchOptions::default());
    assert_eq!(watched.absences, [DaysAway { from: date(2024, 2, 15), to: date(2024, 2, 18) }]);
    assert!(
        watched.episodes.is_empty() && watched.to_string().contains("Away from 15 February 2024 to 18 February 2024.")
    );
}

#[test]
fn the_fitted_patterns_name_known_measures_and_conditions() {
    let patterns = Patterns::fitted();
    assert_eq!(patterns.conditions.len(), 8);
    assert!(patterns.conditions.iter().all(|pattern| pattern.measures.len() > 3 && pattern.likelihood_ratio > 0.0));
    assert!(
        Patterns::read(
            r#"{ "fitted_by": "", "threshold": 1, "conditions": [{ "name": "a", "likelihood_ratio": 1,
        "measures": [{ "measure": "meels", "shift_sd": 1, "weight": 1 }] }], "harmless": [] }"#
        )
        .is_err()
    );
}

#[test]
fn reports_say_that_this_is_no_device() {
    assert!(watch(&log(40, &[]), WatchOptions::default()).to_string().ends_with(&format!("{NOT_A_DEVICE}\n")));
}
