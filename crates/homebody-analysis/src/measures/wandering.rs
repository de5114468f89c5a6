//! Aimless ways, after Martino-Saltzman et al. 1991: pacing, which goes back and forth between two places, and lapping, which
//! goes round by three and more.

use super::timeline::RoomStay;
use homebody_core::time::{MINUTE, Span, WallTime};

/// Stay after which a person does not wander (our choice).
const PASSING: Span = MINUTE;

/// Smallest number of returns to the start of a way that is pacing or lapping (our choice).
const ROUNDS: usize = 3;

/// When somebody paces, and when they lap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WanderingStarts {
    /// The beginnings of ways back and forth.
    pub pacing: Vec<WallTime>,
    /// The beginnings of ways round.
    pub lapping: Vec<WallTime>,
}

/// The aimless ways among stays in rooms.
pub fn wandering(stays: &[RoomStay]) -> WanderingStarts {
    let mut found = WanderingStarts::default();
    for way in stays.split(|stay| stay.interval().length() > PASSING) {
        let rooms: Vec<usize> = way.iter().map(|stay| stay.room).collect();
        let mut at = 0;
        while at < rooms.len() {
            let Some((round, length)) = round_at(&rooms[at..]) else {
                at += 1;
                continue;
            };
            let kind = if round == 2 { &mut found.pacing } else { &mut found.lapping };
            kind.push(way[at].begin);
            at += length;
        }
    }
    found
}

/// How many rooms a round has that begins here and is gone often enough, and how many stays it takes in all.
fn round_at(rooms: &[usize]) -> Option<(usize, usize)> {
    const LARGEST: usize = 6;
    (2..=LARGEST).find_map(|round| {
        let first = rooms.get(..round)?;
        // A way there and back by a third room is no round.
        let is_round = (0..round).all(|one| !first[..one].contains(&first[one]));
        let again = rooms.iter().enumerate().take_while(|(index, room)| **room == first[index % round]).count();
        (is_round && again > ROUNDS * round).then_some((round, again))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stays(rooms: &[usize], each: Span) -> Vec<RoomStay> {
        let stay = |(index, &room): (i64, &usize)| {
            let begin = WallTime::EPOCH + index * each;
            RoomStay { room, begin, end: begin + each }
        };
        (0..).zip(rooms).map(stay).collect()
    }

    #[test]
    fn ways_back_and_forth_and_round_are_told_apart() {
        let told = |rooms: &[usize]| {
            let found = wandering(&stays(rooms, MINUTE / 6));
            (found.pacing.len(), found.lapping.len())
        };
        assert_eq!(told(&[0, 1, 0, 1, 0, 1, 0]), (1, 0));
        assert_eq!(told(&[0, 1, 2, 0, 1, 2, 0, 1, 2, 0]), (0, 1));
        assert_eq!(told(&[0, 1, 0, 1, 0, 2, 3, 4]), (0, 0));
        // Who sits down in between had somewhere to go.
        let mut slow = stays(&[0, 1, 0, 1, 0, 1, 0], MINUTE / 6);
        slow[3].end += 10 * MINUTE;
        assert_eq!(wandering(&slow), WanderingStarts::default());
    }
}
