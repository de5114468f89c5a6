//! Classification of travel into the four patterns of Martino-Saltzman et al. (1991).

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pattern {
    /// No place repeats.
    Direct,
    /// Places repeat in no order.
    Random,
    /// Circles over three or more places.
    Lapping,
    /// Between two places.
    Pacing,
}

/// Number of places after which a return is not a lap (our choice).
pub(super) const LAP_PLACES: usize = 6;

/// Classifies a sequence of places or rooms.
///
/// Without a repetition it is direct. Otherwise it is cut into cycles, each from the last time in a place to the return
/// there: of two places (A-B-A) they are pacing, of three to six lapping. The remainder is direct if nothing in it
/// repeats, else random. The result is the most frequent of random, lapping and pacing, the first in this order if
/// equal. Staying in a place does not count as a repetition.
pub fn travel_pattern(rooms_or_places: &[usize]) -> Pattern {
    let mut places = rooms_or_places.to_vec();
    places.dedup();
    if !repeats(&places) {
        return Pattern::Direct;
    }
    let (mut random, mut lapping, mut pacing) = (0, 0, 0);
    let (mut open_from, mut remaining_from) = (0, 0);
    for at in 0..places.len() {
        let last = places[open_from..at].iter().rposition(|place| *place == places[at]).map(|index| open_from + index);
        let Some(first) = last.filter(|first| at - first <= LAP_PLACES) else { continue };
        random += usize::from(places.get(remaining_from..first).is_some_and(repeats));
        if at - first == 2 {
            pacing += 1
        } else {
            lapping += 1
        }
        // The place that closes a cycle may open the next one, but does not belong to the remainder.
        (open_from, remaining_from) = (at, at + 1);
    }
    random += usize::from(places.get(remaining_from..).is_some_and(repeats));
    let most = random.max(lapping).max(pacing);
    match () {
        () if random == most => Pattern::Random,
        () if lapping == most => Pattern::Lapping,
        () => Pattern::Pacing,
    }
}

fn repeats(places: &[usize]) -> bool {
    places.iter().enumerate().any(|(index, place)| places[..index].contains(place))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(places: &str) -> Pattern {
        travel_pattern(&places.bytes().map(usize::from).collect::<Vec<_>>())
    }

    #[test]
    fn no_repetition_is_direct() {
        assert_eq!([of(""), of("A"), of("AAA"), of("ABCD"), of("AABBC")], [Pattern::Direct; 5]);
    }

    #[test]
    fn to_and_fro_is_pacing() {
        assert_eq!([of("ABA"), of("ABABAB"), of("AABBAA"), of("CDABABAB")], [Pattern::Pacing; 4]);
        // Two rooms on one hall.
        assert_eq!(of("AHBHAHBHA"), Pattern::Pacing);
    }

    #[test]
    fn circles_are_lapping() {
        assert_eq!([of("ABCA"), of("ABCABCABC"), of("ABCDEFABCDEF"), of("XABCABCAY")], [Pattern::Lapping; 4]);
    }

    #[test]
    fn returns_without_order_are_random() {
        assert_eq!([of("ABCDEFGA"), of("ABCDEFGHBIJKLMDA")], [Pattern::Random; 2]);
    }

    #[test]
    fn the_most_frequent_counts() {
        // Two laps and one pacing; the reverse; one of each.
        assert_eq!(
            [of("ABCABCADED"), of("ABABAXYZX"), of("ABCADED")],
            [Pattern::Lapping, Pattern::Pacing, Pattern::Lapping]
        );
    }
}
