//! Sentences about arrivals of visitors.

use super::reader::SentenceReader;

pub const VISITS: [&str; 27] = [
    "is|are there|present|here",
    "is|are with her|him|them",
    "arrives|arrive",
    "turns|turn up",
    "stays|stay over|overnight",
    "stays|stay the night|weekend",
    "calls|call to see her|him|them",
    "attends|attend",
    "comes|come to stay with her|him|them",
    "comes|come to stay",
    "comes|come to the house|home|flat|apartment",
    "pops|pop in|by|round|over",
    "stops|stop by|in",
    "looks|look in on her|him|them",
    "looks|look in",
    "calls|call round|over",
    "stays|stay with|at her|him|them",
    "stays|stay",
    "visits|visit her|him|them|it",
    "visits|visit",
    "comes|come to visit|help",
    "comes|come to see|visit her|him|them",
    "comes|come to help her|him|them",
    "comes|come by|over|round|in|around",
    "comes|come",
    "drops|drop by|in",
    "calls|call in|by|round",
];

pub fn visits(reader: &mut SentenceReader) -> bool {
    VISITS.iter().any(|phrase| reader.eat(phrase)) || calls(reader)
}

fn calls(reader: &mut SentenceReader) -> bool {
    let before = reader.at.checked_sub(1).map(|before| &reader.words[before].text);
    let is_on_duty = before.is_some_and(|before| reader.names.lexicon.has_last("PEOPLE", before) && !is_friend(before));
    let calls_somebody = ["her", "him", "them", "mum", "dad", "me", "us"].contains(&reader.peek(1));
    is_on_duty && !calls_somebody && reader.eat("calls|call")
}

fn is_friend(who: &str) -> bool {
    const FRIENDS: &str = "friend neighbour neighbor grandchildren child children family relative visitor";
    FRIENDS.split(' ').any(|friend| friend == who.trim_end_matches('s') || friend == who)
}
