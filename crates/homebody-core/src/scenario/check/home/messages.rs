//! Messages for the building of `home.json`: its rooms, walls, doors, furniture, places and names.

use crate::geometry::Point;
use crate::scenario::check::at as written;

crate::messages! {
    /// Problems with the building of a home.
    pub enum HomeMessage in "home" {
        /// The time to look for overlaps grows with the square of the number of corners.
        TooManyCorners { most: usize } error "too-many-corners" ("the rooms have more than {most} corners together")
            hint ("draw round walls with fewer corners; ten are enough for a bay");
        /// The outline of a room lists each corner once. Its last corner is joined to the first.
        RepeatedCorner { room: String } error "repeated-corner" ("a corner of {room:?} is given twice")
            hint ("remove one of them; the last corner is joined to the first");
        /// All corners of the outline are on one line, or there are too few.
        NoArea {
            /// The room, the piece of furniture or the area.
            what: String,
        } error "no-area" ("{what} has no area")
            hint ("give at least three corners that are not on one line");
        /// The corners of an outline follow each other along its border. Two sides that cross show that the order is wrong.
        CrossesItself { what: String } error "crosses-itself" ("{what} crosses itself")
            hint ("list its corners in their order along the border");
        /// Furniture and the areas of sensors are convex, which makes shadows and visibility fast to compute. Several pieces can have the form
        /// of an L.
        NotConvex { what: String } error "not-convex" ("{what} must be convex")
            hint ("divide it into several convex pieces");
        /// Each point of the floor is in one room. Rooms may touch, and measurements from both sides of a wall may differ by a little.
        Overlap { a: String, b: String, area_m2: f64 }
            error "rooms-overlap" ("the rooms {a:?} and {b:?} overlap by {area_m2:.2} m²")
            hint ("correct the corners of one of them");
        /// Lengths in a home are in metres. A home of this size is often one in centimetres or in feet.
        TooLarge { most_m: f64 } error "too-large" ("this is more than {most_m} m from the first room")
            hint ("give lengths in metres, not in centimetres");
        /// A wall runs from one point to another.
        ShortWall error "wall-without-length" ("this wall has no length: it ends at its start")
            hint ("correct one of its ends, or remove the wall");
        /// A door is the part of a wall between its two jambs.
        NarrowDoor { door: String, width_m: f64 }
            error "door-without-width" ("the door {door:?} has no width: its jambs are {width_m} m apart")
            hint ("correct one of its jambs");
        /// Both jambs of a door are on the middle line of a wall. Move them to a wall, or draw the wall first.
        OffWall {
            door: String,
            wall: Option<String>,
            /// The distance of the jamb from the middle line of that wall.
            distance_m: Option<f64>,
        } error "door-off-wall" ("the door {door:?} is not on a wall")
            advice (Some(match wall.as_ref().zip(*distance_m) {
                Some((wall, distance_m)) => format!("move this jamb by {distance_m:.3} m to {wall}, the nearest wall"),
                None => "draw a wall first".into(),
            }));
        /// Two doors take the same part of a wall.
        DoorsOverlap { a: String, b: String } error "doors-overlap" ("the doors {a:?} and {b:?} overlap")
            hint ("move or remove one of them");
        /// The time to find ways through a home grows with the number of places where walls meet. Walls that are drawn several times
        /// meet very often.
        WallMeetings { most: usize } error "wall-meetings" ("the walls meet or cross each other more than {most} times")
            hint ("draw each wall once, from corner to corner");
        /// A door can be in several walls where these lie on each other. In a home that draws its walls once, this is rare.
        DoorsInWalls { most: usize }
            error "doors-in-walls" ("the doors lie in more than {most} walls in total, because walls lie on each other")
            hint ("draw each wall once, from corner to corner");
        /// A piece of furniture has a middle and a size, or an outline.
        IncompleteForm { name: String, missing: &'static str } error "incomplete-form" ("{name:?} has no {missing}")
            hint ("give \"at\" and \"size_m\", or an \"outline\"");
        /// A piece of furniture has either a middle and a size, or an outline.
        TwoForms { name: String } error "two-forms" ("{name:?} has an outline and also a place or a size")
            hint ("give either \"at\" and \"size_m\", or an \"outline\"");
        /// Residents lie down in furniture with this role, so they must be able to enter it.
        CannotLie { name: String }
            error "not-enterable" ("a resident cannot lie in {name:?}, because it is not enterable")
            hint ("write \"enterable\": true, or give its role to another piece of furniture");
        /// Furniture and the areas of sensors are inside the rooms, up to the thickness of the walls.
        ReachesOut { what: String } error "reaches-out" ("{what} reaches out of the home")
            hint ("move it inside the rooms");
        /// Files and logs refer to parts of the home by their names.
        SameName {
            /// The kind of part, such as `room`.
            noun: &'static str,
            name: String,
        } error "duplicate-name" ("another {noun} is also named {name:?}")
            hint ("rename one of them");
        /// Names that differ only in upper and lower case or in blanks around them are easily confused, so they count as the same.
        SimilarName {
            /// The kind of part, such as `room`.
            noun: &'static str,
            name: String,
            other: String,
        } error "similar-name" ("another {noun} is named {other:?}, which is too similar to {name:?}")
            hint ("rename one of them; case and blanks around a name make no difference");
        /// A path goes to places, rooms and enterable furniture by name, so these names differ from each other.
        SharedName {
            /// The kind of the other part, such as `room`.
            noun: &'static str,
            name: String,
        } error "shared-name" ("a {noun} is also named {name:?}")
            hint ("rename one of them, because a path finds its destination by name");
        /// Residents walk to places, so places are inside the rooms.
        PlaceOutside { place: String, at: Point }
            error "place-outside" ("the place {place:?} at {at} is outside the home", at = written(*at))
            hint ("move it into a room");
        /// Residents walk to places, so a person can stand at each of them.
        PlaceBlocked {
            place: String,
            /// The wall, door or piece of furniture.
            by: String,
        } error "place-blocked" ("the place {place:?} is inside {by}")
            hint ("move it to a point where a person can stand");
    }
}
