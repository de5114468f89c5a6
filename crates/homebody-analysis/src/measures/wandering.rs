//! Aimless ways, after Martino-Saltzman et al. 1991: pacing, which goes back and forth between two places, and lapping, which
//! goes round by three and more.

use super::timeline::RoomStay;
use homebody_core::time::{MINUTE, Span, WallTime};

/// Stay after which a person does not wander (our choice).
const PASSING: Span = MINUTE;

/// Smallest number of returns to the start of a way that is pacing or lapping (our choice).
const ROUNDS: usize = 3;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct WanderingStarts {
    /// The beginnings of ways back and forth.
    pub pacing: Vec<WallTime>,
    /// The beginnings of ways round.
    pub lapping: Vec<WallTime>,
}

pub fn wandering(stays: &[RoomStay]) -> WanderingStarts {
    let mut found = WanderingStarts::default();
    for way in stays.split(|stay| stay.length() > PASSING) {
        let rooms: Vec<usize> = way.iter().map(|stay| stay.label).collect();
        let mut at = 0;
        while at < rooms.len() {
            let Some((round, length)) = round_at(&rooms[at..]) else {
                at += 1;
                continue;
            };
            let kind = if round == 2 { &mut found.pacing } else { &mut found.lapping };
            kind.push(way[at].begin());
            at += length;
        }
    }
    found
}

/// The number of rooms of a round that begins here and is walked often enough, and the number of stays in all its rounds.
fn round_at(rooms: &[usize]) -> Option<(usize, usize)> {
    const LARGEST: usize = 6;
    (2..=LARGEST).find_map(|round| {
        let first = rooms.get(..round)?;
        // A way there and back by a third room is not a round.
        let is_round = (0..round).all(|one| !first[..one].contains(&first[one]));
        let again = rooms.iter().enumerate().take_while(|(index, room)| **room == first[index % round]).count();
        (is_round && again > ROUNDS * round).then_some((round, again))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::Interval;
    use homebody_timeline::Episode;

    fn stays(rooms: &[usize], each: Span) -> Vec<RoomStay> {
        let stay = |(index, &room): (i64, &usize)| {
            Episode::new(room, Interval::starting(WallTime::EPOCH + index * each, each))
        };
        (0..).zip(rooms).map(stay).collect()
    }

    #[test]
    fn separates_pacing_from_lapping() {
        let told = |rooms: &[usize]| {
            let found = wandering(&stays(rooms, MINUTE / 6));
            (found.pacing.len(), found.lapping.len())
        };
        assert_eq!(told(&[0, 1, 0, 1, 0, 1, 0]), (1, 0));
        assert_eq!(told(&[0, 1, 2, 0, 1, 2, 0, 1, 2, 0]), (0, 1));
        assert_eq!(told(&[0, 1, 0, 1, 0, 2, 3, 4]), (0, 0));
        // A person who sits down in between had somewhere to go.
        let mut slow = stays(&[0, 1, 0, 1, 0, 1, 0], MINUTE / 6);
        slow[3].time.end += 10 * MINUTE;
        assert_eq!(wandering(&slow), WanderingStarts::default());
    }
}
