use crate::{Episode, PersonTimeline, Timeline};
use homebody_core::event::Fact;
use homebody_core::run::Run;
use homebody_core::time::{Interval, RunTime};

/// Builds the timelines of people from the facts of a run.
#[derive(Clone, Debug, Default)]
pub struct TimelineBuilder {
    rooms: Vec<String>,
    people: Vec<Building>,
}

#[derive(Clone, Debug, Default)]
struct Building {
    done: PersonTimeline<RunTime>,
    activity: Option<(RunTime, String)>,
    room: Option<(RunTime, String)>,
}

impl TimelineBuilder {
    /// A builder for all people of a run, its guests included.
    pub fn for_run(run: &Run) -> TimelineBuilder {
        TimelineBuilder::new(run.names(), run.home().plan.rooms.iter().map(|room| room.name.clone()).collect())
    }

    /// A builder for people with these names in a home with these rooms, both in the order of their ids in facts.
    pub fn new(people: Vec<String>, rooms: Vec<String>) -> TimelineBuilder {
        let person = |name| Building { done: PersonTimeline::new(name), ..Building::default() };
        TimelineBuilder { rooms, people: people.into_iter().map(person).collect() }
    }

    /// Takes facts in the order in which a run reports them. It ignores people without a name in the builder, such as visitors.
    pub fn take<'f>(&mut self, facts: impl IntoIterator<Item = &'f Fact>) {
        for fact in facts {
            match fact {
                Fact::Activity { resident, at, name } => {
                    let Some(person) = self.people.get_mut(resident.index()) else { continue };
                    turn(&mut person.activity, &mut person.done.activities, *at, name.clone());
                }
                Fact::Room { resident, at, room } => {
                    let Some(person) = self.people.get_mut(resident.index()) else { continue };
                    let name = room.and_then(|room| self.rooms.get(room.index()).cloned());
                    turn(&mut person.room, &mut person.done.rooms, *at, name);
                }
                _ => {}
            }
        }
    }

    /// Hands over the episodes that have ended since the last call.
    pub fn take_ended(&mut self) -> Timeline<RunTime> {
        let ended = |person: &mut Building| {
            let next = PersonTimeline::new(person.done.name.clone());
            std::mem::replace(&mut person.done, next)
        };
        Timeline { people: self.people.iter_mut().map(ended).collect() }
    }

    /// Ends the open episodes, and hands over all that it has not yet handed over.
    pub fn finish(mut self, end: RunTime) -> Timeline<RunTime> {
        for person in &mut self.people {
            turn(&mut person.activity, &mut person.done.activities, end, None);
            turn(&mut person.room, &mut person.done.rooms, end, None);
        }
        self.take_ended()
    }
}

/// Ends the open episode, and opens the next. A run reports a stride as it begins, so a room may be entered after the end of the run; that
/// episode is left out.
fn turn(open: &mut Option<(RunTime, String)>, ended: &mut Vec<Episode>, at: RunTime, next: Option<String>) {
    let next = next.map(|label| (at, label));
    if let Some((begin, label)) = std::mem::replace(open, next)
        && begin <= at
    {
        ended.push(Episode::new(label, Interval::new(begin, at)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::ids::{ResidentId, RoomId};
    use homebody_core::time::{HOUR, Span};

    fn hour(hours: i64) -> RunTime {
        RunTime::START + hours * HOUR
    }

    #[test]
    fn builds_episodes_of_each_person() {
        let mut builder = TimelineBuilder::new(vec!["ann".into(), "bob".into()], vec!["hall".into(), "kitchen".into()]);
        let activity = |resident, at, name: Option<&str>| Fact::Activity {
            resident: ResidentId(resident),
            at: hour(at),
            name: name.map(str::to_owned),
        };
        let room = |resident, at, room: Option<u32>| Fact::Room {
            resident: ResidentId(resident),
            at: hour(at),
            room: room.map(RoomId),
        };
        builder.take(&[activity(0, 0, Some("sleeping")), room(0, 0, Some(0)), activity(1, 1, Some("reading"))]);
        builder.take(&[activity(0, 2, None), room(0, 3, Some(1)), activity(2, 3, Some("visiting"))]);
        let ended = builder.take_ended();
        assert_eq!(ended.people[0].activities, [Episode::new("sleeping".to_owned(), Interval::new(hour(0), hour(2)))]);
        assert_eq!(ended.people[0].room_at(hour(1)), Some("hall"));
        builder.take(&[room(0, 9, None)]);
        let rest = builder.finish(hour(8));
        let [ann, bob] = &rest.people[..] else { panic!("two people") };
        assert_eq!((ann.activities.len(), ann.room_at(hour(3)), ann.room_at(hour(9))), (0, Some("kitchen"), None));
        assert_eq!((bob.activity_at(hour(0)), bob.activity_at(hour(7))), (None, Some("reading")));
        assert_eq!(bob.activities[0].length(), 7 * HOUR);
        assert_eq!(rest.map(|at| at + Span::MICROSECOND).people[1].activities[0].begin().micros(), HOUR.micros() + 1);
    }
}
