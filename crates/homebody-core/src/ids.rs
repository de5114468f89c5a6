//! Which sensor, resident, room or thing: a type for each, so that none is taken for another.
//!
//! Each is an index into a list that stays the same for a whole run: [`SensorId`] into [`Run::sensors`](crate::run::Run::sensors),
//! [`ResidentId`] into [`Run::names`](crate::run::Run::names), [`RoomId`] and [`ThingId`] into the rooms and things of the
//! [`Plan`](crate::plan::Plan).

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The id of what has this index.
            pub fn new(index: usize) -> $name {
                $name(index as u32)
            }

            /// The index into the list that the id is of.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id! {
    /// A sensor that the logger knows.
    SensorId
}
id! {
    /// A body: the scenario's residents first, then visitors.
    ResidentId
}
id! {
    /// A room of the plan.
    RoomId
}
id! {
    /// A thing that can be used: a door, a stove, a tap, a lamp.
    ThingId
}
