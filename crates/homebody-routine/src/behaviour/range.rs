//! The rooms that a person keeps to, or never enters.

use super::driver::RoutineDriver;
use super::item::Item;
use super::places::HomePlaces;
use std::sync::Arc;

impl RoutineDriver {
    /// Leaves out of the day the rooms outside of the person's range, and what is only done there.
    pub(super) fn keep_to_range(&mut self) {
        let day = self.agenda.day;
        let holds = |place: &str, inside: bool, chance: f64| {
            let mut stream = self.life.stream_of_day(day, &format!("range/{place}/{inside}"));
            stream.chance(chance)
        };
        let ranges = self.parameters.ranges.iter();
        let ranges: Vec<(String, bool)> = ranges
            .filter(|(place, inside, chance)| holds(place, *inside, *chance))
            .map(|(place, inside, _)| (place.clone(), *inside))
            .collect();
        if ranges.is_empty() || self.visitor.is_some() {
            return;
        }
        self.places = Arc::new(HomePlaces::clone(&self.places).within(&ranges));
        let (places, usual) = (&self.places, &self.usual_places);
        let is_there = |item: &Item| {
            let main = item.activity.roles().iter().find(|role| usual.for_role(**role).is_some());
            item.visitor.is_some() || main.is_none_or(|role| places.for_role(*role).is_some())
        };
        self.agenda.items.retain(is_there);
        self.agenda.breaks.retain(is_there);
    }
}
