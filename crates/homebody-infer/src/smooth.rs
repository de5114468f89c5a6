//! From messages to where people were: forward through a stretch of the log, and back again.
//!
//! The log is taken in blocks, so that memory does not grow with it; each block is looked at together with what comes next.

use crate::belief::Belief;
use crate::learn::Senses;
use crate::pair::Pair;
use crate::said::Message;
use crate::spells::Spell;
use crate::states::State;
use crate::steps::{Heard, Steps};
use crate::visits::Visits;
use homebody_core::time::Micros;

/// Number of steps that are smoothed together, and number of later steps that are used for them (our choice).
const BLOCK: usize = 4_096;
const AHEAD: usize = 768;

/// Where people were at an instant, by all that was said before and after.
pub struct Instant<'a> {
    /// When, in microseconds since the start.
    pub at: Micros,
    /// What was said then; nothing inside of a long silence.
    pub said: Option<Heard>,
    pairs: Vec<(&'a Belief, [&'a Senses; 2])>,
}

/// Where somebody most likely was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess<'a> {
    /// The most likely state of the most likely room.
    pub state: &'a State,
    /// The chance of that room, from 0 to 1.
    pub chance: f64,
    /// How often the body would say in that state what was said then, in messages a second; 0 where nothing was.
    pub says: f32,
}

/// How likely it is that somebody is in each place of a home, from 0 to 1; all together it is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Chances {
    /// Not at home.
    pub out: f32,
    /// At home and in no room: in a doorway.
    pub between: f32,
    /// By room of the plan.
    pub rooms: Vec<f32>,
}

/// Asks of messages, in order of time and up to `end`, where each of these bodies was, and tells of each instant in turn.
/// What sensors say or do not say in their `spells` counts for nothing.
///
/// What is said may come of any of them. Of two after each other all is thought together; of more, only what each pair may
/// be expected to say.
pub fn translate(
    bodies: &[Senses],
    spells: &[Spell],
    messages: impl IntoIterator<Item = Message>,
    end: Micros,
    mut tell: impl FnMut(Instant),
) {
    let Some(first) = bodies.first() else { return };
    let nobody = first.nobody();
    let mut smoother = Smoother::new(bodies, &nobody, Steps::new(&first.timing, spells));
    messages.into_iter().for_each(|message| {
        smoother.hear(&message, &mut tell);
    });
    smoother.end(end, &mut tell);
}

/// Asks the same as time goes on, and tells at once, by what was said until then: of each instant, in order of time, with the
/// message that comes then, or none. Who is asked of seldom is told of late: silence tells as well. Of two who may be at home
/// it is thought as of any two.
pub fn follow(
    bodies: &[Senses],
    instants: impl IntoIterator<Item = (Micros, Option<Message>)>,
    mut tell: impl FnMut(Instant),
) {
    let Some(first) = bodies.first() else { return };
    let nobody = first.nobody();
    let mut follower = Follower::new(bodies, &nobody);
    for (at, message) in instants {
        match message {
            Some(message) => follower.hear(&message),
            None => follower.wait(at),
        }
        tell(follower.now());
    }
}

/// Where people are by what was said until now, for whoever has messages one by one.
pub struct Follower<'a> {
    pairs: Vec<Pair<'a>>,
    steps: Steps<'a>,
    said: Option<Heard>,
}

impl<'a> Follower<'a> {
    /// Of these bodies, at the start; `nobody` is [`Senses::nobody`] of the first.
    ///
    /// # Panics
    ///
    /// If there are no bodies.
    pub fn new(bodies: &'a [Senses], nobody: &'a Senses) -> Follower<'a> {
        Follower { pairs: in_pairs(bodies, nobody), steps: Steps::new(&bodies[0].timing, &[]), said: None }
    }

    /// Time goes on to a message; one that comes late counts as if it came now.
    pub fn hear(&mut self, message: &Message) {
        self.steps.hear(message);
        self.go_on();
    }

    /// Time goes on to an instant, and nothing is said.
    pub fn wait(&mut self, until: Micros) {
        self.steps.go_on(until, None);
        self.go_on();
    }

    fn go_on(&mut self) {
        let steps = self.steps.len();
        (0..steps).for_each(|number| go_on(&mut self.pairs, &self.steps, number));
        self.said = self.steps.get(steps - 1).said;
        for pair in &mut self.pairs {
            let last = pair.last().clone();
            pair.begin_after(steps, last);
        }
        self.steps.forget(steps);
    }

    /// What is thought now.
    pub fn now(&self) -> Instant<'_> {
        let pairs = self.pairs.iter().map(|pair| (pair.last(), pair.senses)).collect();
        Instant { at: self.steps.now(), said: self.said, pairs }
    }
}

/// Two after each other together, and one who is left with nobody.
fn in_pairs<'a>(bodies: &'a [Senses], nobody: &'a Senses) -> Vec<Pair<'a>> {
    bodies.chunks(2).map(|pair| Pair::new([&pair[0], pair.get(1).unwrap_or(nobody)])).collect()
}

/// All go on by a step; what is said at its end may come of any of them.
fn go_on(pairs: &mut [Pair], steps: &Steps, number: usize) {
    pairs.iter_mut().for_each(|pair| pair.go_on(steps, number));
    let Some(heard) = steps.get(number).said else { return };
    if let [pair] = pairs {
        return pair.hear(heard, 0.0);
    }
    let expected: Vec<f32> = pairs.iter().map(|pair| pair.expected(heard)).collect();
    let all: f32 = expected.iter().sum();
    pairs.iter_mut().zip(expected).for_each(|(pair, own)| pair.hear(heard, (all - own).max(0.0)));
}

/// Asks of messages, one by one, where people were.
pub(crate) struct Smoother<'a> {
    pairs: Vec<Pair<'a>>,
    /// Who may visit the first of the pairs, who lives alone.
    visits: Option<Visits<'a>>,
    steps: Steps<'a>,
    /// How many steps have been gone forward.
    gone: usize,
}

impl<'a> Smoother<'a> {
    /// Begins before the first message of these bodies. `nobody` is [`Senses::nobody`] of the first body.
    pub fn new(bodies: &'a [Senses], nobody: &'a Senses, steps: Steps<'a>) -> Smoother<'a> {
        let (residents, visits) = match bodies {
            [alone, guest] if guest.visits && !alone.visits => (&bodies[..1], Some(Visits::new([alone, guest]))),
            all => (all, None),
        };
        Smoother { pairs: in_pairs(residents, nobody), visits, steps, gone: 0 }
    }

    /// Takes the next message. Returns true if it gave `tell` a full block.
    pub fn hear(&mut self, message: &Message, tell: &mut impl FnMut(Instant)) -> bool {
        self.steps.hear(message);
        let mut is_told = false;
        while self.steps.len() >= BLOCK + AHEAD {
            self.smooth(BLOCK, tell);
            is_told = true;
        }
        is_told
    }

    /// Tells of all that is left until an instant.
    pub fn end(&mut self, end: Micros, tell: &mut impl FnMut(Instant)) {
        self.steps.go_on(end, None);
        self.smooth(usize::MAX, tell);
    }

    /// Tells of the first steps, and forgets them.
    fn smooth(&mut self, most: usize, tell: &mut impl FnMut(Instant)) {
        let (steps, told) = (&self.steps, most.min(self.steps.len()));
        for number in self.gone..steps.len() {
            go_on(&mut self.pairs, steps, number);
        }
        self.gone = steps.len() - told;
        if let (Some(visits), [alone, ..]) = (&mut self.visits, &self.pairs[..]) {
            visits.go_on(alone, steps, told);
        }
        let at_end = |pair: &Pair| told.checked_sub(1).map(|last| pair.beliefs[last].clone());
        let before: Vec<Option<Belief>> = self.pairs.iter().map(at_end).collect();
        for pair in &mut self.pairs {
            pair.go_back(steps, (0, told), pair.nothing_known(), |number, after| {
                self.visits.iter_mut().for_each(|visits| visits.go_back(steps, number, after));
            });
        }
        for number in 0..told {
            let visit = self.visits.as_ref().and_then(|visits| visits.told(number));
            let pairs = match visit {
                Some(visit) => vec![visit],
                None => self.pairs.iter().map(|pair| (&pair.beliefs[number], pair.senses)).collect(),
            };
            let step = steps.get(number);
            tell(Instant { at: step.end, said: step.said, pairs });
        }
        let all = self.pairs.iter_mut().zip(before);
        all.for_each(|(pair, before)| before.into_iter().for_each(|before| pair.begin_after(told, before)));
        self.steps.forget(told);
    }
}

impl<'a> Instant<'a> {
    /// How often each sensor would say ON now, in messages a second while it can: of all that are told of.
    pub(crate) fn expected(&self, sensors: usize) -> Vec<f32> {
        let mut expected = vec![0.0; sensors];
        for (belief, senses) in &self.pairs {
            for (body, senses) in senses.iter().enumerate().filter(|(_, senses)| senses.states().len() > 1) {
                let mut of_body = vec![0.0; sensors];
                for (chance, &state) in belief.alone(body).into_iter().zip(&belief.states[body]) {
                    let rates = senses.on_rates(state);
                    of_body.iter_mut().zip(rates).for_each(|(sum, rate)| *sum += chance * rate);
                }
                expected.iter_mut().zip(of_body).for_each(|(sum, own)| *sum += own);
            }
        }
        expected
    }

    /// Where each body most likely was, in the order of the bodies. Who of two that are alike was where cannot be told.
    pub fn guesses(&self) -> Vec<Guess<'a>> {
        let mut guesses = Vec::with_capacity(2 * self.pairs.len());
        self.tell(|guess, _| guesses.push(guess));
        guesses
    }

    /// How likely each body was in each place, in the order of the guesses. Of two that are alike, the first is whoever
    /// is where the first is guessed to be: the chances are of where the two are, not of who is who.
    pub fn chances(&self) -> Vec<Chances> {
        let mut all = Vec::with_capacity(2 * self.pairs.len());
        self.tell(|_, chances| all.push(Chances::of(chances)));
        all
    }

    /// Both for each body: what is guessed of it, and how likely it was out, between the rooms, and in each room.
    pub fn tell(&self, mut tell: impl FnMut(Guess<'a>, &[f32])) {
        for (belief, senses) in &self.pairs {
            if senses[1].states().len() == 1 {
                let (guess, chances) = alone(belief, senses[0], self.said);
                tell(guess, &chances);
                tell(Guess { state: &senses[1].states().all[0], chance: guess.chance, says: 0.0 }, &NOBODY);
                continue;
            }
            let together = Together::new(belief, senses);
            let ([first, second], [its, others]) = (together.guesses(self.said), together.chances());
            let turned = is_alone_second(senses, &first);
            let all = if turned { [(second, others), (first, its)] } else { [(first, its), (second, others)] };
            all.into_iter().for_each(|(guess, chances)| tell(guess, &chances));
        }
    }
}

/// The chances of nobody, who is out.
const NOBODY: [f32; 2] = [1.0, 0.0];

impl Chances {
    /// Of chances by the numbers of places, which are those of `States::place`.
    fn of(places: &[f32]) -> Chances {
        Chances { out: places[0], between: places[1], rooms: places[2..].to_vec() }
    }
}

/// What is thought of one who is alone: the most likely state of the most likely place, and how likely each place is.
fn alone<'a>(belief: &Belief, senses: &'a Senses, said: Option<Heard>) -> (Guess<'a>, Vec<f32>) {
    let states = senses.states();
    let mut chances = vec![0.0f32; states.places()];
    for (&state, chance) in belief.states[0].iter().zip(&belief.chances) {
        chances[states.place(state)] += chance;
    }
    let best = (0..chances.len()).max_by(|&a, &b| chances[a].total_cmp(&chances[b])).unwrap_or(0);
    let is_there = |(state, _): &(&u32, &f32)| states.place(**state) == best;
    let all = belief.states[0].iter().zip(&belief.chances);
    let state = all.filter(is_there).max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(&state, _)| state as usize);
    let says = said.map_or(0.0, |heard| senses.rate(heard.sensor, heard.said)[state]);
    (Guess { state: &states.all[state], chance: f64::from(chances[best]), says }, chances)
}

/// Whoever of a guest and the one who lives there is alone at home lives there.
fn is_alone_second(senses: &[&Senses; 2], first: &Guess) -> bool {
    senses[1].visits && first.state.at.is_none()
}

/// What is thought of two, by the places that they are in.
struct Together<'b, 'a> {
    belief: &'b Belief,
    senses: &'b [&'a Senses; 2],
    /// The place of each state that counts, of each of the two.
    places: [Vec<usize>; 2],
    columns: usize,
    /// How likely each pair of places is, row by row: a row for each place of the first.
    chances: Vec<f32>,
    /// The pair of places that is most likely, whoever is in which.
    best: usize,
}

impl<'b, 'a> Together<'b, 'a> {
    fn new(belief: &'b Belief, senses: &'b [&'a Senses; 2]) -> Together<'b, 'a> {
        let places = [0, 1].map(|body| {
            let states = belief.states[body].iter().map(|&state| senses[body].states().place(state));
            states.collect::<Vec<usize>>()
        });
        let columns = senses[0].states().places().max(senses[1].states().places());
        let mut chances = vec![0.0f32; columns * columns];
        for (row, &a) in belief.chances.chunks_exact(places[1].len().max(1)).zip(&places[0]) {
            for (chance, &b) in row.iter().zip(&places[1]) {
                chances[a * columns + b] += chance;
            }
        }
        let mut together = Together { belief, senses, places, columns, chances, best: 0 };
        let by_chance = |a: &usize, b: &usize| {
            let either = together.either(*a).total_cmp(&together.either(*b));
            either.then(together.chances[*a].total_cmp(&together.chances[*b]))
        };
        together.best = (0..together.chances.len()).max_by(by_chance).unwrap_or(0);
        together
    }

    /// How likely a pair of places is, whoever is in which.
    fn either(&self, pair: usize) -> f32 {
        let (a, b) = (pair / self.columns, pair % self.columns);
        self.chances[pair] + if a == b { 0.0 } else { self.chances[b * self.columns + a] }
    }

    /// The rooms of the two that are most likely together, and the most likely states in them.
    fn guesses(&self, said: Option<Heard>) -> [Guess<'a>; 2] {
        let Together { belief, senses, places, columns, best, .. } = self;
        let width = places[1].len();
        let is_there = |pair: &usize| places[0][pair / width] * columns + places[1][pair % width] == *best;
        let by_chance = |a: &usize, b: &usize| belief.chances[*a].total_cmp(&belief.chances[*b]);
        let pair = (0..belief.chances.len()).filter(is_there).max_by(by_chance).unwrap_or(0);
        let chance = f64::from(self.either(*best));
        let guess = |body: usize, place: usize| {
            let state = belief.states[body][place] as usize;
            let says = said.map_or(0.0, |heard| senses[body].rate(heard.sensor, heard.said)[state]);
            Guess { state: &senses[body].states().all[state], chance, says }
        };
        [guess(0, pair / width), guess(1, pair % width)]
    }

    /// How likely each is in each place: of a pair that is the best one the other way round, each is in the other's place.
    fn chances(&self) -> [Vec<f32>; 2] {
        let (first, second) = (self.best / self.columns, self.best % self.columns);
        let mut of = [vec![0.0; self.columns], vec![0.0; self.columns]];
        for (pair, chance) in self.chances.iter().enumerate() {
            let (a, b) = (pair / self.columns, pair % self.columns);
            let is_turned = a != first && b != second && (a == second || b == first);
            let (a, b) = if is_turned { (b, a) } else { (a, b) };
            of[0][a] += chance;
            of[1][b] += chance;
        }
        of
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::tests::{LENGTH_S, senses, walk};
    use homebody_core::time::SECOND;

    #[test]
    fn who_follows_a_log_thinks_what_going_forward_through_it_thinks() {
        let bodies = [senses()];
        let nobody = bodies[0].nobody();
        let mut follower = Follower::new(&bodies, &nobody);
        let (mut steps, mut pair) = (Steps::new(&bodies[0].timing, &[]), Pair::new([&bodies[0], &nobody]));
        let mut gone = 0;
        for message in walk() {
            follower.hear(&message);
            steps.hear(&message);
            for number in gone..steps.len() {
                go_on(std::slice::from_mut(&mut pair), &steps, number);
            }
            gone = steps.len();
            let now = follower.now();
            assert_eq!((now.at, now.pairs[0].0), (message.at, pair.last()));
        }
        // By all that was said later, something else is thought of some instant.
        let (mut live, mut all) = (Vec::new(), Vec::new());
        let instants = walk().into_iter().map(|message| (message.at, Some(message)));
        follow(&bodies, instants, |instant| live.push((instant.at, instant.guesses()[0].chance)));
        translate(&bodies, &[], walk(), LENGTH_S * SECOND, |instant| {
            all.push((instant.at, instant.guesses()[0].chance))
        });
        assert!(live.iter().any(|one| !all.contains(one)));
    }
}
