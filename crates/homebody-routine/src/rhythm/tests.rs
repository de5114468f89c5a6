use super::*;
use crate::language::{KnownNames, routine};
use homebody_core::time::{DAY, SECOND};

fn noted(what: Activity, begin: WallTime, lasts: Span) -> DiaryEntry {
    DiaryEntry { what, begin, end: begin + lasts }
}

/// Ten equal days, each with rising two minutes later than the day before; lunch is cooked on every other.
fn diary() -> Vec<DiaryEntry> {
    let mut all = vec![noted(Activity::GoToBed, WallTime::EPOCH - 90 * MINUTE, 8 * HOUR + 30 * MINUTE)];
    for day in 0..10 {
        let midnight = WallTime::EPOCH + day * DAY;
        let up = midnight + 7 * HOUR + day * 2 * MINUTE;
        all.push(noted(Activity::UseBathroom, up + 2 * MINUTE, MINUTE));
        all.push(noted(Activity::Shower, up + 10 * MINUTE, 6 * MINUTE));
        if day % 2 == 0 {
            all.push(noted(Activity::Prepare(Meal::Lunch), midnight + 12 * HOUR, 20 * MINUTE));
            all.push(noted(Activity::Eat(Meal::Lunch), midnight + 12 * HOUR + 20 * MINUTE, 15 * MINUTE));
        }
        all.push(noted(Activity::Leave, midnight + 14 * HOUR, HOUR));
        all.push(noted(Activity::UseBathroom, midnight + 16 * HOUR, 30 * SECOND));
        all.push(noted(Activity::UseBathroom, midnight + 19 * HOUR, 90 * SECOND));
        if day < 9 {
            all.push(noted(
                Activity::GoToBed,
                midnight + 24 * HOUR + 30 * MINUTE,
                6 * HOUR + (30 + day * 2 + 2) * MINUTE,
            ));
        }
    }
    all
}

fn known() -> [Activity; 7] {
    [
        Activity::GoToBed,
        Activity::UseBathroom,
        Activity::Shower,
        Activity::Prepare(Meal::Lunch),
        Activity::Eat(Meal::Lunch),
        Activity::Leave,
        Activity::Nap,
    ]
}

#[test]
fn a_diary_becomes_sentences_of_its_numbers() {
    // The standard deviation of 0, 2, .. 18 minutes is 6.06, that of a triangle of 15 minutes to each side.
    let wanted = [
        "She gets up at about 07:09, give or take 15 minutes.",
        "She goes to bed at about 00:30, give or take 5 minutes.",
        "She goes to the bathroom 2 minutes after she gets up for 60 seconds.",
        "She goes to the bathroom 2 times a day for 30 to 90 seconds.",
        "She takes a shower 10 minutes after she gets up for 6 minutes.",
        "On 50 % of days she prepares lunch at about 12:00, give or take 5 minutes for 20 minutes, then eats for 15 minutes.",
        "She never naps.",
        "She leaves the apartment at about 14:00, give or take 5 minutes for 60 minutes.",
    ];
    assert_eq!(sentences(&diary(), &known()), wanted);
}

#[test]
fn the_sentences_are_understood() {
    let text = sentences(&diary(), &known()).join("\n");
    let (routine, problems) = routine("a.routine", &text, &KnownNames::default());
    assert!(problems.is_empty(), "{problems:?}\n{text}");
    assert!(routine.remarks.is_empty(), "{:?}", routine.remarks);
    assert_eq!(routine.habits.len(), 8, "{text}");
}

#[test]
fn visits_to_the_toilet_at_night_get_a_sentence() {
    let mut diary = diary();
    let night = diary.iter().filter(|one| one.what == Activity::GoToBed).nth(3).unwrap().begin;
    diary.extend([2, 5].map(|hour| noted(Activity::UseBathroom, night + hour * HOUR, MINUTE)));
    let told = sentences(&diary, &known());
    assert_eq!(told[2], "On 10 % of nights she goes to the bathroom 2 times.");
    let (routine, problems) = routine("a.routine", &told.join("\n"), &KnownNames::default());
    assert!(problems.is_empty() && routine.remarks.is_empty(), "{problems:?}");
    let every: Vec<WallTime> =
        diary.iter().filter(|one| one.what == Activity::GoToBed).map(|one| one.begin + HOUR).collect();
    diary.extend(every.into_iter().map(|at| noted(Activity::UseBathroom, at, MINUTE)));
    assert_eq!(sentences(&diary, &known())[2], "She goes to the bathroom once a night.");
}

#[test]
fn a_meal_that_is_noted_twice_a_day_has_one_time() {
    let mut diary = diary();
    for day in 0..10 {
        diary.push(noted(Activity::Prepare(Meal::Lunch), WallTime::EPOCH + day * DAY + 15 * HOUR, 10 * MINUTE));
    }
    diary.sort_by_key(|one| one.begin);
    let told = sentences(&diary, &known());
    assert_eq!(told.iter().filter(|said| said.contains("prepares lunch")).count(), 1, "{told:?}");
    let (_, problems) = routine("a.routine", &told.join("\n"), &KnownNames::default());
    assert!(problems.is_empty(), "{problems:?}");
}

#[test]
fn getting_up_at_night_does_not_end_the_night() {
    let whole = sentences(&diary(), &known());
    let mut diary = diary();
    let halves = diary.iter().filter(|one| one.what == Activity::GoToBed).flat_map(|night| {
        let middle = night.begin + (night.end - night.begin) / 2;
        let half = |begin, end| DiaryEntry { what: Activity::GoToBed, begin, end };
        [half(night.begin, middle), half(middle + 20 * MINUTE, night.end)]
    });
    let halves: Vec<DiaryEntry> = halves.collect();
    diary.retain(|one| one.what != Activity::GoToBed);
    diary.extend(halves);
    diary.sort_by_key(|one| one.begin);
    assert_eq!(sentences(&diary, &known()), whole);
}

#[test]
fn long_activities_get_their_own_sentence() {
    let mut diary = diary();
    for one in diary.iter_mut().filter(|one| one.what == Activity::UseBathroom && one.begin.time_of_day() == 19 * HOUR)
    {
        let is_long = one.begin.day_number() % 2 == 0;
        one.end = one.begin + if is_long { 20 * MINUTE } else { 30 * SECOND };
    }
    let told = sentences(&diary, &known());
    assert_eq!(told[3], "She goes to the bathroom 1 to 2 times a day for 30 seconds.");
    assert_eq!(told[4], "On 50 % of days she goes to the bathroom for 20 minutes.");
}

#[test]
fn a_diary_without_nights_says_nothing() {
    assert!(sentences(&[noted(Activity::Shower, WallTime::EPOCH, MINUTE)], &[]).is_empty());
    assert!(sentences(&[], &[]).is_empty());
}

#[test]
fn lengths_are_said_in_the_unit_that_fits() {
    assert_eq!(span([4.2, 170.0]), "for 4 to 170 seconds");
    assert_eq!(span([0.2, 0.3]), "for 1 second");
    assert_eq!(span([4.0, 600.0]), "for 0.1 to 10 minutes");
    assert_eq!(span([3600.0, 3600.0]), "for 60 minutes");
}
