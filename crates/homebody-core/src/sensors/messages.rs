//! Messages for the sensors of a home.
//!
//! The check of `home.json` reports them: for a sensor on a part that the home does not have, for one that sees nothing, and for limits
//! that contradict each other.
//!
//! We assume that a reader of a message has the file open at its place, so a message names the sensor only where that is not clear.
//!
//! Each message is a variant of one enum. The forms of devices report those that they know without the home, the check of the scenario
//! the others.
//!
//! Left out: names that are used twice, which are messages of the home.

use crate::geometry::Point;
use crate::nearest::suggestion;
use crate::problem::Fix;

crate::messages! {
    /// Problems with sensors.
    pub enum SensorMessage in "sensor" {
        /// The home has no sensor with this name. Upper and lower case count.
        Unknown { sensor: String, nearest: Option<String>, known: Vec<String> }
            error "unknown" ("the home has no sensor {sensor:?}")
            advice (suggestion(nearest, known));
        /// The sensor is on or in a part of the home that does not exist. `home.json` names its doors, furniture and rooms.
        UnknownPart {
            /// The kind of part that the sensor needs.
            noun: String,
            name: String,
            nearest: Option<String>,
            known: Vec<String>,
        } error "unknown-part" ("the home has no {noun} {name:?}")
            advice (suggestion(nearest, known));
        /// The sensor feels people in its piece of furniture, and no resident can enter this piece.
        NotEnterable { furniture: String }
            error "not-enterable" ("this sensor never feels a person: no resident can enter {furniture:?}")
            hint ("write \"enterable\": true for {furniture:?}")
            fix (Some(Fix::LetEnter { furniture: furniture.clone() }.into()));
        /// The time of a run grows with the number of beams. A sensor without `beams` has 32 of them.
        TooManyBeams { most: u32 }
            error "too-many-beams" ("this sensor and those before it have more than {most} beams in total")
            hint ("give the sensors fewer \"beams\"");
        /// A sensor decides after the wait `refire_s` whether it fires again. It remembers a movement for `persist_s` within that wait.
        PersistTooLong { persist_s: f64, least_refire_s: f64 } error "persist-too-long"
            ("\"persist_s\", {persist_s} s, is longer than the shortest \"refire_s\", {least_refire_s} s")
            hint ("set \"persist_s\" to at most {least_refire_s}");
        /// A field of view of more than 180 degrees would see behind the wall that the sensor is on.
        VerticalField { field_deg: f64 }
            error "vertical-field" ("the vertical angle of view must be at most 180 degrees, but is {field_deg} degrees")
            hint ("give a smaller angle");
        /// A sensor at level `zones` counts the zones that a body enters. Each row may have 0 zones, but not all rows.
        NoZones error "no-zones" ("a sensor needs at least one zone")
            hint ("give one of the \"rows\" a number above 0");
        /// A sensor on a ceiling does not see through walls and closed doors, so its area ends at them.
        ReachesThrough { sensor: String, by: String }
            error "reaches-through" ("the area of {sensor:?} reaches through {by}")
            hint ("let the area end at {by}");
        /// A sensor inside a wall or a piece of furniture sees nothing.
        Inside { sensor: String, by: String } error "inside-solid" ("the sensor {sensor:?} is inside {by}")
            hint ("move it to the surface of {by}, on the side to which the sensor looks");
        /// A sensor is on the inner surface of a wall, inside the rooms.
        Outside { sensor: String, at: Point }
            error "outside-home" ("the sensor {sensor:?} at {at} is outside the home", at = written(*at))
            hint ("move it to the inner surface of a wall");
        /// The lens looks at the wall behind the sensor, or at a piece of furniture directly before it.
        FacesSolid { sensor: String, by: String } error "faces-solid" ("the sensor {sensor:?} faces into {by}")
            hint ("turn \"facing_deg\" into the room: 0 is east, 90 north, 180 west, 270 south");
        /// A camera is in a room, so that a lamp can light what it sees.
        CameraOutside { camera: String, at: Point }
            error "camera-outside" ("the camera {camera:?} at {at} is not in a room", at = written(*at))
            hint ("move it into a room");
        /// A camera is below the ceiling of its room.
        AboveCeiling { camera: String, room: String, ceiling_m: f64 }
            error "camera-above-ceiling" ("the camera {camera:?} is above the ceiling of {room:?}")
            hint ("set its \"height_m\" below {ceiling_m}");
        /// A camera inside a wall or a piece of furniture sees nothing.
        CameraInside { camera: String, by: String } error "camera-inside-solid" ("the camera {camera:?} is inside {by}")
            hint ("move it into the room, for example some centimetres in front of the wall");
        /// Nearly all of the picture is wall or ceiling, so no resident would appear in it.
        SeesNothing { camera: String }
            error "camera-sees-nothing" ("the camera {camera:?} sees hardly any floor, bed or seat")
            hint ("turn \"facing_deg\" into the room, or look down with a larger \"tilt_deg\"");
        /// A camera sleeps until a sensor of its room wakes it, unless it is always on.
        NeverWakes { camera: String } error "camera-never-wakes" ("no sensor wakes the camera {camera:?}")
            hint ("name sensors of its room in \"woken_by\", or write \"always\": true");
        /// A camera that is always on needs no sensor to wake it.
        NeverSleeps { camera: String }
            error "camera-never-sleeps" ("the camera {camera:?} is always on, so \"woken_by\" has no effect")
            hint ("remove \"woken_by\" or \"always\"");
        /// A power sensor reports readings where its file gives the power of the device. Otherwise it reports on and off only.
        WithoutWatts { key: &'static str } error "without-watts" ("{key:?} has no effect without \"watts\"")
            hint ("give the power of the device while it is on as \"watts\"");
        /// A device draws less power in standby than while it is on.
        StandbyTooLarge { standby_watts: f64, watts: f64 }
            error "standby-too-large" ("\"standby_watts\", {standby_watts} W, is greater than \"watts\", {watts} W")
            hint ("set \"standby_watts\" to at most {watts}");
        /// The levels of restlessness follow each other: a longer movement has a higher level.
        LevelsOrder { level_s: f64, before_s: f64 }
            error "levels-order" ("each of \"levels_s\" must be greater than the one before, but {level_s} follows {before_s}")
            hint ("put the levels in ascending order");
        /// The key gives two limits: values below the first are low, and values above the second are high.
        VitalLimits { key: &'static str, low: f64, high: f64 }
            error "vital-limits" ("the high limit of {key:?}, {high}, must be greater than its low limit, {low}")
            hint ("give the lower limit first");
        /// A stove cools down to the temperature of its room, so a limit below that would never be reached.
        BelowRoom { room_c: f64 }
            error "off-below-room" ("\"off_below_c\" must be above the temperature of the room, {room_c} °C")
            hint ("give a higher temperature");
        /// A stove that heats up reaches `off_below_c`, then `on_above_c`, then `hot_c`.
        LimitOrder { lower: &'static str, low_c: f64, upper: &'static str, high_c: f64 }
            error "limit-order" ("{upper:?}, {high_c} °C, must be greater than {lower:?}, {low_c} °C")
            hint ("set {upper:?} above {low_c}");
        /// A pressure sensor is in a piece of furniture or on an area of the floor.
        TwoPlaces error "two-places" ("this sensor has both \"on\" and \"area\"")
            hint ("remove \"on\" or \"area\"");
        /// A pressure sensor is in a piece of furniture or on an area of the floor. A low piece of furniture is a mat.
        NoPlace { sensor: String, mat_height_m: f64 }
            error "no-place" ("the sensor {sensor:?} has neither \"on\" nor \"area\"")
            hint ("name furniture in \"on\" (a piece of at most {mat_height_m} m is a mat), or give an \"area\" of the floor");
        /// The sensor is on a part of the home that does not exist, so the home cannot be used. The check of the scenario reports the
        /// same with its place in the file.
        Unresolved { sensor: String }
            error "unresolved" ("the sensor {sensor:?} names a part that the home does not have")
            hint ("correct the door, room or piece of furniture that the sensor names");
    }
}

/// A point to the millimetre.
fn written(at: Point) -> String {
    let short = |value: f64| (value * 1000.0).round() / 1000.0 + 0.0;
    format!("({}, {})", short(at.x), short(at.y))
}
