use super::*;

/// Days with these visits to the bathroom by night, and bedtimes.
fn days(visits: &[f64], bedtimes: &[f64]) -> Measures {
    let column = |values: &[f64]| values.iter().copied().map(Some).collect();
    crate::sample::days(&[("bathroom_night", column(visits)), ("bedtime", column(bedtimes))])
}

const ADA: SummarySubject = SummarySubject { subject: "Ada", last: 14 };

#[test]
fn sentences_are_true_and_say_most() {
    let summary = summarise(&days(&[2.0; 14], &[22.6; 14]), ADA);
    let told: Vec<&str> = summary.sentences.iter().map(|sentence| sentence.plain.as_str()).collect();
    assert!(told.contains(&"Ada got up for the bathroom twice on every night of the last two weeks."), "{told:?}");
    assert!(
        told.contains(&"Ada went to bed between 22:30 and 23:00 on every night of the last two weeks."),
        "{told:?}"
    );
    assert_eq!(summary.remarks.len(), 1, "nothing lies before: {:?}", summary.remarks);
    let mixed: Vec<f64> = (0..14).map(|night| if night % 5 == 0 { 0.0 } else { 2.0 + f64::from(night % 2) }).collect();
    let summary = summarise(&days(&mixed, &[22.6; 14]), ADA);
    let visits = summary.sentences.iter().find(|sentence| sentence.measure == "bathroom_night").unwrap();
    assert_eq!(visits.plain, "Ada got up for the bathroom at least twice on most nights of the last two weeks.");
    assert_eq!((visits.shown_by.len(), visits.focus), (11, 1.0));
    assert!(visits.expert.contains("on 11 of 14 nights"), "{}", visits.expert);
}

#[test]
fn changes_come_first() {
    let visits = [[1.0; 28].as_slice(), &[3.0; 14]].concat();
    let summary = summarise(&days(&visits, &[22.6; 42]), ADA);
    let first = &summary.sentences[0];
    let words = "More bathroom visits at night than before on every night of the last two weeks: 3 a night on average, previously 1.";
    assert_eq!((first.plain.as_str(), first.numbers.as_str()), (words, "On 14 of 14 nights."));
    assert_eq!((first.is_more, first.before), (Some(true), Some(1.0)));
    let changes = summary.sentences.iter().filter(|sentence| sentence.is_more.is_some());
    assert_eq!(changes.count(), 1, "her bedtime is what it was");
}

#[test]
fn too_few_days_say_nothing() {
    let summary = summarise(&days(&[2.0; 3], &[22.6; 3]), ADA);
    assert!(
        summary.sentences.is_empty() && summary.remarks[0].contains("Only 3 complete days so far"),
        "{:?}",
        summary.remarks
    );
}

#[test]
fn distance_is_a_metric() {
    let of = |visits: f64, bedtime: f64| summarise(&days(&[visits; 14], &[bedtime; 14]), ADA);
    let all = [of(1.0, 22.6), of(2.0, 22.6), of(2.0, 23.9), of(5.0, 21.0)];
    let sentences: Vec<&SummarySentence> = all.iter().flat_map(|summary| &summary.sentences).collect();
    for a in &sentences {
        assert_eq!(between(a, a), 0.0);
        for b in &sentences {
            assert_eq!(between(a, b), between(b, a));
            for c in &sentences {
                assert!(between(a, c) <= between(a, b) + between(b, c) + 1e-9);
            }
        }
    }
    assert_eq!(of_summaries(&all[0], &all[0]), 0.0);
    assert!(of_summaries(&all[0], &all[1]) < of_summaries(&all[0], &all[3]));
}
