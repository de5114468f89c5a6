//! The messages about new scenarios.

homebody_core::messages! {
    /// Problems with what a new scenario is made of.
    pub enum NewMessage in "new" {
        /// `--sensors` names a CSV file with a row for each sensor of the log. Its first line names the columns:
        ///
        /// ```text
        /// id,room,place,x,y
        /// M001,bedroom,bed,120,340
        /// ```
        NoIdColumn { near: Option<String> } error "no-id-column" ("the table has no column \"id\"")
            advice (Some(match near {
                Some(near) => format!("rename the column {near:?} to \"id\""),
                None => "name the columns in the first line: id, room, place, x, y".into(),
            }));
        /// The id connects a row of the table with the sensor of the log.
        NoId error "no-id" ("the row has no id")
            hint ("write the id that the log has for the sensor");
        /// A home is drawn from sensors of motion and of doors. Other sensors can be in the log, and the table leaves their kind out.
        Kind { kind: String, known: Vec<String> } error "kind" ("Homebody cannot draw a home from sensors of the kind {kind:?}")
            hint ("write one of {known}, or leave the cell empty", known = known.join(", "));
        /// Coordinates are numbers: pixels where a picture of the plan is given, and metres otherwise.
        Coordinate { text: String } error "coordinate" ("{text:?} is not a number")
            hint ("write a number with a decimal point, such as 3.5");
        /// A place needs both coordinates.
        HalfPlace { sensor: String } error "half-place" ("the sensor {sensor:?} has only one of x and y")
            hint ("write both, or leave both empty");
        /// Each sensor has one row, because it is in one place.
        SameSensor { sensor: String, first_line: u64 } error "same-sensor" ("the sensor {sensor:?} is already in line {first_line}")
            hint ("delete one of the two rows");
        /// Homebody reads the size of an image from its first bytes, which PNG and JPEG have in a known form.
        NotAPicture error "not-a-picture" ("the file is not an image in PNG or JPEG")
            hint ("save the plan as PNG");
        /// Two points with known positions decide the scale and the direction of the image. Fewer leave them open, and more could
        /// contradict each other.
        KnownPoints { points: usize } error "known-points" ("two known points are needed, not {points}")
            hint ("pass the pixels and metres of two points: --known 120,340=0,0 --known 900,340=8.5,0");
        /// The two points have the same pixel or the same position, so that they have no distance to scale the image by.
        SamePoint error "same-point" ("the two known points are the same point")
            hint ("choose two points that are far apart");
        /// A known point is a pixel of the image and its position in the home, in metres.
        KnownPoint { text: String } error "known-point" ("{text:?} does not give a pixel and a position")
            hint ("write the pixel and the position in metres, such as 120,340=0,0");
        /// The coordinates in the table count pixels from the upper left corner of the image.
        OffPicture { sensor: String, x_px: f64, y_px: f64 } error "off-picture" ("the sensor {sensor:?} is outside the image: x is {x_px} and y is {y_px} pixels")
            hint ("correct x and y, in pixels from the upper left corner");
        /// An image of a plan helps only if at least one sensor has coordinates on it.
        NothingOnPicture error "nothing-on-picture" ("no sensor has a place on the image")
            hint ("write x and y of each sensor, in pixels, into a table, and pass --sensors FILE");
        /// The ids in the table and the ids in the log have nothing in common. Probably they belong to different homes.
        OtherLog { ids: Vec<String> } error "other-log" ("no sensor of the table is in the log")
            hint ("write the ids that the log has: {ids}", ids = ids.join(", "));
    }
}
