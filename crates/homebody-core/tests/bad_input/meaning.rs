//! Files of the right shape that say what cannot be.

use crate::*;

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn the_scenario_file() {
    check(&[
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2 March 2009""#,
            r#"scenario.json:3:12: "2 March 2009" is no date and time; write it as "2009-03-02T00:00:00""#),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2009-02-30T00:00:00""#,
            r#"scenario.json:3:12: "2009-02-30T00:00:00" is no date and time; write it as "2009-03-02T00:00:00""#),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2009-03-02T00:00:00-06:00""#,
            r#"scenario.json:3:12: "2009-03-02T00:00:00-06:00" must not name a time zone; write local time, and the zone as "time_zone""#),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""0009-03-02T00:00:00""#,
            "scenario.json:3:12: the year 9 must be from 1900 to 2199"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""-009999-01-01T00:00:00""#,
            "scenario.json:3:12: the year -9999 must be from 1900 to 2199"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2009-03-08T02:30:00""#,
            "scenario.json:3:12: there is no 2009-03-08T02:30:00 in America/Chicago: clocks skip it as daylight saving time begins"),
        ("scenario.json", r#""America/Chicago""#, r#""America/Chicgo""#,
            r#"scenario.json:4:16: there is no time zone "America/Chicgo"; did you mean "America/Chicago"?"#),
        ("scenario.json", r#""America/Chicago""#, r#""here""#,
            r#"scenario.json:4:16: there is no time zone "here"; write an IANA name such as "America/Chicago""#),
        ("scenario.json", "\"2009-03-02T00:00:00\",\n  \"time_zone\": \"America/Chicago\"",
            "\"noon\",\n  \"time_zone\": \"Chicago\"",
            "scenario.json:3:12: \"noon\" is no date and time; write it as \"2009-03-02T00:00:00\"\nscenario.json:4:16: there is no time zone \"Chicago\"; did you mean \"America/Chicago\"?"),
        ("scenario.json", r#""home.json""#, r#""hom.json""#,
            r#"scenario.json:6:11: "hom.json" cannot be read: there is no such file; did you mean "home.json"?"#),
        ("scenario.json", r#""home.json""#, r#""../home.json""#,
            r#"scenario.json:6:11: "../home.json" is no file name inside the scenario's folder; name a file relative to the scenario's folder, with / between folders"#),
        ("scenario.json", r#""home.json""#, r#""/etc/passwd""#,
            r#"scenario.json:6:11: "/etc/passwd" is no file name inside the scenario's folder; name a file relative to the scenario's folder, with / between folders"#),
        ("scenario.json", r#""home.json""#, r#""C:home.json""#,
            r#"scenario.json:6:11: "C:home.json" is no file name inside the scenario's folder; name a file relative to the scenario's folder, with / between folders"#),
        ("scenario.json", r#""home.json""#, r#""""#,
            "scenario.json:6:11: a file name must not be empty; name a file relative to the scenario's folder, with / between folders"),
        ("scenario.json", r#""home.json""#, r#""ann.json""#,
            r#"scenario.json:6:11: "ann.json" is a resident, but a home is needed here"#),
        ("scenario.json", r#""home.json""#, r#""scenario.json""#,
            r#"scenario.json:6:11: "scenario.json" is already used as a scenario; it cannot be a home too"#),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#"["ann.json", "ann.json"]"#,
            r#"scenario.json:8:29: "ann.json" is linked twice; give every resident a file of their own"#),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#"["ann.json", "ann.path.json"]"#,
            r#"scenario.json:8:29: "ann.path.json" is already used as a path; it cannot be a resident too"#),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#"["ann.json", "bob.keys.json"]"#,
            r#"scenario.json:8:29: "bob.keys.json" is a file of live input, but a resident is needed here"#),
        ("scenario.json", r#""name": "two rooms""#, r#""name": " ""#,
            "scenario.json:2:11: a name must not be blank"),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn the_building() {
    check(&[
        ("home.json", r#""to": [8, 0] }"#, r#""to": [0, 0] }"#,
            "home.json:8:29: this wall has no length: it ends where it begins"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[2, 0], [4, 0]]",
            r#"home.json:4:37: the room "kitchen" has no area"#),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 3], [4, 0], [0, 3]]",
            r#"home.json:4:37: the outline of "kitchen" crosses itself; give its corners in order"#),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0], [4, 3], [0, 3], [0, 0]]",
            r#"home.json:4:70: a corner of "kitchen" is given twice; the last corner is joined to the first without being repeated"#),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0], [4, 0], [4, 3], [0, 3]]",
            r#"home.json:4:54: a corner of "kitchen" is given twice; the last corner is joined to the first without being repeated"#),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0], [4, 3], [4, 5], [4, 3], [0, 3]]",
            r#"home.json:4:37: the outline of "kitchen" crosses itself; give its corners in order"#),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4.5, 0], [4.5, 3], [0, 3]]",
            r#"home.json:5:37: the rooms "kitchen" and "bedroom" overlap by 1.50 m²"#),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0]]",
            r#"home.json:4:37: "outline" must have 3 to 500 items, but has 2; Corners in order"#),
        ("home.json", r#""to": [8, 3] }"#, r#""to": [8, 3000] }"#,
            "home.json:9:29: this is more than 100 m from the first room; lengths are in metres, not in centimetres"),
        ("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4.5, 1], "to": [4.2, 2]"#,
            r#"home.json:15:39: the door "bedroom door" is on no wall; the wall from (4, 0) to (4, 3) comes nearest; this jamb is 0.500 m off its middle line"#),
        ("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4, 1], "to": [4, 1]"#,
            r#"home.json:15:53: the door "bedroom door" has no width: its jambs are 0 m apart"#),
        ("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4, 1], "to": [5, 0]"#,
            r#"home.json:15:39: the door "bedroom door" is on no wall; the wall from (0, 0) to (8, 0) comes nearest; this jamb is 1.000 m off its middle line"#),
        ("home.json", r#""name": "front door", "from": [1, 0], "to": [2, 0]"#,
            r#""name": "front door", "from": [4, 1.9], "to": [4, 2.5]"#,
            r#"home.json:16:37: the doors "bedroom door" and "front door" overlap"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn furniture() {
    check(&[
        ("home.json", r#""height_m": 0.7 }"#, r#""height_m": 0.7, "role": "bed" }"#,
            r#"home.json:19:87: nobody can lie in "table"; say of it "enterable": true, or give the role to another piece"#),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""at": [2, 2.2]"#,
            r#"home.json:19:5: "table" has a place but no size; give either "at" and "size_m", or an "outline""#),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8], "h"#, r#""size_m": [1.2, 0.8], "h"#,
            r#"home.json:19:5: "table" has a size but no place; give either "at" and "size_m", or an "outline""#),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8], "h"#, r#""h"#,
            r#"home.json:19:5: "table" has neither place nor outline; give either "at" and "size_m", or an "outline""#),
        ("home.json", r#""size_m": [1.2, 0.8]"#, r#""size_m": [1.2, 0.8], "outline": [[1, 1], [2, 1], [2, 2]]"#,
            r#"home.json:19:73: "table" is given in two forms; give either "at" and "size_m", or an "outline""#),
        ("home.json", r#""size_m": [1.2, 0.8]"#, r#""size_m": [1.2, 0]"#,
            r#"home.json:19:56: item 2 of "size_m" must be from 0.001 to 1000, but is 0"#),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""outline": [[1, 1], [2, 1], [2, 2], [1.8, 1.2]]"#,
            r#"home.json:19:35: "table" must be convex; make it of several convex pieces"#),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""outline": [[1, 1], [2, 2], [2, 1], [1, 2]]"#,
            r#"home.json:19:35: "table" crosses itself"#),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""outline": [[1, 1], [2, 2], [3, 3]]"#,
            r#"home.json:19:35: "table" has no area"#),
        ("home.json", r#""at": [2, 2.2]"#, r#""at": [2, 3.2]"#,
            r#"home.json:19:30: "table" reaches out of the home"#),
        ("home.json", r#""at": [2, 2.2]"#, r#""at": [20, 2.2]"#,
            r#"home.json:19:30: "table" reaches out of the home"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn names_that_are_taken() {
    check(&[
        ("home.json", r#""name": "bedroom","#, r#""name": "kitchen","#,
            r#"home.json:5:15: another room is named "kitchen" too"#),
        ("home.json", r#""name": "bedroom","#, r#""name": " Kitchen","#,
            r#"home.json:5:15: another room is named "kitchen", too like " Kitchen"; upper and lower case and surrounding blanks make no difference"#),
        ("home.json", r#""name": "front door""#, r#""name": "bedroom door""#,
            r#"home.json:16:15: another door is named "bedroom door" too"#),
        ("home.json", r#""name": "table""#, r#""name": "bed""#,
            r#"home.json:20:15: another piece of furniture is named "bed" too"#),
        ("home.json", r#""name": "window""#, r#""name": "SINK""#,
            r#"home.json:24:15: another place is named "sink", too like "SINK"; upper and lower case and surrounding blanks make no difference"#),
        ("home.json", r#""name": "window""#, r#""name": "bed""#,
            r#"home.json:24:15: a piece of furniture is named "bed" too; paths go to either by name: give one of them another"#),
        ("home.json", r#""name": "window""#, r#""name": "kitchen""#,
            r#"home.json:24:15: a room is named "kitchen" too; paths go to either by name: give one of them another"#),
        ("home.json", r#""name": "bed", "outline""#, r#""name": "bedroom", "outline""#,
            "home.json:20:15: a room is named \"bedroom\" too; paths go to either by name: give one of them another\nann.path.json:2:12: the home has no place \"bed\"; there are \"sink\", \"window\", \"bedroom\", \"kitchen\"\nann.path.json:10:34: the home has no place \"bed\"; there are \"sink\", \"window\", \"bedroom\", \"kitchen\""),
        ("home.json", r#""name": "bedroom motion""#, r#""name": "kitchen motion""#,
            "home.json:28:15: another sensor is named \"kitchen motion\" too\nlogger.json:5:36: the home has no sensor \"bedroom motion\"; there are \"kitchen motion\", \"bed\""),
        ("home.json", r#""name": "window""#, r#""name": "  ""#,
            "home.json:24:15: a name must not be blank"),
        ("home.json", r#""name": "kitchen", "outline""#, r#""floor": " ", "name": "kitchen", "outline""#,
            "home.json:4:16: a name must not be blank"),
        ("home.json", r#""name": "window""#, r#""name": "a\tb""#,
            r#"home.json:24:15: the name "a\tb" must not hold control characters"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn places_and_sensors() {
    check(&[
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [-0.5, 1.5]"#,
            r#"home.json:23:29: the place "sink" at (-0.5, 1.5) is outside the home"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [2, 2.2]"#,
            r#"home.json:23:29: the place "sink" is inside "table"; put it beside, where a person can stand"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.02, 1.5]"#,
            r#"home.json:23:29: the place "sink" is inside the west wall of "kitchen"; put it beside, where a person can stand"#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [0, 1.5]"#,
            r#"home.json:27:57: the sensor "kitchen motion" is inside the west wall of "kitchen"; mount it on the surface, on the side from which it should see"#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [-0.05, 1.5]"#,
            r#"home.json:27:57: the sensor "kitchen motion" at (-0.05, 1.5) is outside the home; mount it on the surface, on the side from which it should see"#),
        ("home.json", r#""at": [0.05, 1.5], "facing_deg": 0"#, r#""at": [0.05, 1.5], "facing_deg": 180"#,
            r#"home.json:27:84: the sensor "kitchen motion" faces into the west wall of "kitchen"; 0 is east, 90 north, 180 west, 270 south"#),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[6, 1.5], [7.9, 1.5], [6.5, 1.8], [6, 2.9]]"#,
            r#"home.json:30:56: the area of "bed" must be convex; make it of several convex pieces"#),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[6, 1.5], [7, 1.5], [7.9, 1.5]]"#,
            r#"home.json:30:56: the area of "bed" has no area"#),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[6, 1.5], [9, 1.5], [9, 2.9], [6, 2.9]]"#,
            r#"home.json:30:56: the area of "bed" reaches out of the home"#),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#, r#""area": [[6, 1.5], [7.9, 1.5]]"#,
            r#"home.json:30:56: "area" must have 3 to 64 items, but has 2; Convex area of the floor that the sensor sees: its corners in order"#),
        ("home.json", r#""refire_s": [6, 8]"#, r#""refire_s": [8, 6]"#,
            r#"home.json:31:19: the least of "refire_s", 8, is more than its most, 6; write [6, 8]"#),
        ("home.json", r#""refire_s": [6, 8]"#, r#""refire_s": [0.5, 8]"#,
            r#"home.json:31:42: "persist_s", 1, is more than the least of "refire_s", 0.5; a movement counts only within the wait: set "persist_s" to at most 0.5"#),
        ("home.json", r#""persist_s": 1"#, r#""persist_s": 7"#,
            r#"home.json:31:40: "persist_s", 7, is more than the least of "refire_s", 6; a movement counts only within the wait: set "persist_s" to at most 6"#),
        ("home.json", r#""refire_s": [6, 8], "persist_s": 1"#, r#""refire_s": [0.5, 8]"#,
            r#"home.json:31:19: "persist_s", 1, is more than the least of "refire_s", 0.5; a movement counts only within the wait: set "persist_s" to at most 0.5"#),
        ("home.json", r#""refire_s": [6, 8]"#, r#""first_fire_s": [2, 1]"#,
            r#"home.json:31:23: the least of "first_fire_s", 2, is more than its most, 1; write [1, 2]"#),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "field_deg": [100, 200]"#,
            "home.json:28:124: the vertical angle of view must be at most 180, but is 200"),
        ("home.json", r#"{ "sensitivity": { "threshold_deg": 2 } }"#, r#"{ "zones": { "rows": [0, 0, 0] } }"#,
            "home.json:29:54: a sensor needs at least one zone"),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn the_logger() {
    check(&[
        ("logger.json", r#""hold_s": 4"#, r#""hold_s": 4, "lumps": [{ "share": 1, "parts": [1.2, 1] }]"#,
            r#"logger.json:6:75: the least of "parts", 1.2, is more than its most, 1; write [1, 1.2]"#),
        ("logger.json", r#""hold_s": 4"#, r#""hold_s": 4, "lumps": [{ "share": 0, "parts": [1, 1] }]"#,
            r#"logger.json:6:51: no lump has a share; give one lump a share above 0, or write [] for holds of exactly "hold_s""#),
        ("logger.json", r#""sqlite:log.db""#, r#""sqlit:log.db""#,
            r#"logger.json:2:10: "sqlit:log.db" is nowhere a log can go; did you mean "sqlite:log.db"?"#),
        ("logger.json", r#""sqlite:log.db""#, r#""log.txt""#,
            r#"logger.json:2:10: "log.txt" is nowhere a log can go; did you mean "casas:log.txt", or "csv:log.txt"?"#),
        ("logger.json", r#""sqlite:log.db""#, r#""sqlite:""#,
            r#"logger.json:2:10: "sqlite:" names no file; write sqlite:FILE"#),
        ("logger.json", r#""sqlite:log.db""#, r#""csv:/srv/start.sh""#,
            r#"logger.json:2:10: "/srv/start.sh" is no file name inside the run's folder; name a file in there, such as "sqlite:log.db""#),
        ("logger.json", r#""sqlite:log.db""#, r#""csv:logs/../../log.csv""#,
            r#"logger.json:2:10: "logs/../../log.csv" is no file name inside the run's folder; name a file in there, such as "sqlite:log.db""#),
        ("logger.json", r#""sqlite:log.db""#, r#""csv:log.txt""#,
            r#"logger.json:2:25: two logs cannot go to the one file "log.txt"; name a file that nothing else has, such as "csv:logs/week.csv""#),
        ("logger.json", r#""table": "event""#, r#""table": "Event""#,
            r#"logger.json:3:12: "Event" cannot be the name of a table or a column; use a to z, 0 to 9 and _, not a digit first, at most 63 characters"#),
        ("logger.json", r#""table": "event""#, r#""table": "e; drop table x""#,
            r#"logger.json:3:12: "e; drop table x" cannot be the name of a table or a column; use a to z, 0 to 9 and _, not a digit first, at most 63 characters"#),
        ("logger.json", r#""table": "event""#, r#""table": "sqlite_x""#,
            r#"logger.json:3:12: SQLite keeps table names that begin with "sqlite_" for itself"#),
        ("logger.json", r#""time": "at""#, r#""time": "9at""#,
            r#"logger.json:4:24: "9at" cannot be the name of a table or a column; use a to z, 0 to 9 and _, not a digit first, at most 63 characters"#),
        ("logger.json", r#""time": "at""#, r#""time": "device""#,
            r#"logger.json:4:44: the columns "time" and "sensor" cannot both be named "device""#),
        ("logger.json", r#""time": "at""#, r#""time": "seq""#,
            r#"logger.json:4:24: the columns "seq" and "time" cannot both be named "seq""#),
        ("logger.json", r#""kitchen motion": "A1""#, r#""kitchn motion": "A1""#,
            r#"logger.json:5:12: the home has no sensor "kitchn motion"; did you mean "kitchen motion"?"#),
        ("logger.json", r#""kitchen motion": "A1""#, r#""a/b~c": "A1""#,
            r#"logger.json:5:12: the home has no sensor "a/b~c"; there are "kitchen motion", "bedroom motion", "bed""#),
        ("logger.json", r#""bedroom motion": "A2""#, r#""bedroom motion": "a1""#,
            r#"logger.json:5:30: "bedroom motion" and "kitchen motion" would both be logged as "A1""#),
        ("logger.json", r#""bedroom motion": "A2""#, r#""bedroom motion": "bed""#,
            r#"logger.json:5:54: "bed" and "bedroom motion" would both be logged as "bed""#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn residents() {
    check(&[
        ("bob.json", r#""name": "Bob""#, r#""name": "ann ""#,
            r#"bob.json:2:11: the resident of "ann.json" is also named "ann ""#),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [9, 1]"#,
            "bob.json:3:59: Bob starts at (9, 1), outside the home"),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [2, 2.2]"#,
            r#"bob.json:3:59: Bob starts inside "table""#),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [4.2, 0.5]"#,
            "bob.json:3:59: Bob has no room to stand so near to the wall between \"bedroom\" and \"kitchen\"; the body's radius is 0.22 m: move the start away"),
        ("bob.json", r#""bob.keys.json""#, r#""bob.json""#,
            r#"bob.json:3:33: "bob.json" is already used as a resident; it cannot be a file of live input too"#),
        ("bob.json", r#""bob.keys.json""#, r#""ann.path.json""#,
            r#"bob.json:3:33: "ann.path.json" is already used as a path; it cannot be a file of live input too"#),
        ("bob.json", r#""bob.keys.json""#, r#""nothing.json""#,
            r#"bob.json:3:33: "nothing.json" cannot be read: there is no such file"#),
        ("bob.keys.json", r#""at_s": 2.5"#, r#""at_s": 0.5"#,
            "bob.keys.json:4:15: time runs backward, from 1 s to 0.5 s; put the changes in order of time"),
        ("bob.keys.json", r#""up", "fast""#, r#""up", "fast", "up""#,
            "bob.keys.json:3:41: this key is held twice"),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn paths() {
    check(&[
        ("ann.path.json", r#""start": "bed""#, r#""start": "bad""#,
            r#"ann.path.json:2:12: the home has no place "bad"; did you mean "bed"?"#),
        ("ann.path.json", r#""start": "bed""#, r#""start": "table""#,
            r#"ann.path.json:2:12: the home has no place "table"; nobody can be where it stands: add a place beside it"#),
        ("ann.path.json", r#""start": "bed""#, r#""start": [2, 2.2]"#,
            r#"ann.path.json:2:12: Ann starts inside "table""#),
        ("ann.path.json", r#""start": "bed""#, r#""start": [2, -1]"#,
            "ann.path.json:2:12: Ann starts at (2, -1), outside the home"),
        ("ann.path.json", r#""start": "bed""#, r#""start": [4, 0.5]"#,
            "ann.path.json:2:12: Ann starts inside the wall between \"bedroom\" and \"kitchen\""),
        ("ann.path.json", r#""start": "bed""#, r#""start": [1.5, 0]"#,
            r#"ann.path.json:2:12: Ann starts inside the closed door "front door""#),
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, r#"["sink", [2, 7]]"#,
            "ann.path.json:7:32: this waypoint is at (2, 7), outside the home"),
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, r#"["window", "sink"]"#,
            r#"ann.path.json:7:34: the way from (5, 0.5) to "sink" runs through the wall between "bedroom" and "kitchen"; add waypoints around it, such as one in a door"#),
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, r#"[[5, 1.5], [3, 1.5], [2.8, 2.8], [1, 2.3], "sink"]"#,
            r#"ann.path.json:7:56: the way from (2.8, 2.8) to (1, 2.3) runs through "table"; add waypoints around it, such as one in a door"#),
        ("ann.path.json", r#"[[5, 1.5], "bed"]"#, "[[1.5, 1], [1.5, -0.5]]",
            "ann.path.json:10:34: this waypoint is at (1.5, -0.5), outside the home"),
        ("ann.path.json", r#"{ "go": { "to": [[5, 1.5], "bed"], "in_s": 30 } }"#,
            r#"{ "go": { "to": [[2.5, 0.2]] } }"#,
            "ann.path.json:7:24: the way from (2.5, 0.2) to (5, 1.5) runs through the wall between \"bedroom\" and \"kitchen\" when it is repeated; add waypoints around it, such as one in a door"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 1000000, "steps": [{ "wait": { "for_s": 1e-6 } }] } }"#,
            "ann.path.json:8:19: 1 move in 0.000001 s, again and again: nobody makes more than 100 a second; let them take longer, or repeat them less often"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 2, "steps": [{ "go": { "to": ["sink"] } }, { "activity": "idle" }] } }"#,
            "ann.path.json:8:19: the steps that are repeated take no time; let it wait, or walk somewhere else and back"),
        ("ann.path.json", r#""sink"], "pace_mps": 0.5"#, r#""sink"], "pace_mps": 0.5, "in_s": 10"#,
            r#"ann.path.json:7:68: a walk cannot have both "pace_mps" and "in_s"; keep the one that is meant"#),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": 30, "arrive_at": "07:40""#,
            r#"ann.path.json:10:67: a walk cannot have both "in_s" and "arrive_at"; keep the one that is meant"#),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": 0.5"#,
            "ann.path.json:10:50: 6.6 m in 0.5 s would be faster than 10 m/s; at 0.6 m/s it takes 11 s"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "wait": { "until": "09:00" } }, { "wait": { "for_s": 60 } }, { "go": { "to": [[0.5, 0.5]], "arrive_at": "09:00:30" } }"#,
            r#"ann.path.json:8:113: 1.0 m would take 24.0 hours, until that time of day; at 0.6 m/s it takes 2 s"#),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "wait": { "until": "09:00" } }, { "go": { "to": [[0.5, 0.5], "sink"], "arrive_at": "09:00:00.1" } }"#,
            r#"ann.path.json:8:92: 2.0 m in 0.1 s would be faster than 10 m/s; at 0.6 m/s it takes 3 s"#),
        ("ann.path.json", r#""in_s": 30"#, r#""arrive_at": "7:40""#,
            r#"ann.path.json:10:55: "7:40" is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#),
        ("ann.path.json", r#""08:00:00.5""#, r#""24:00""#,
            r#"ann.path.json:12:28: "24:00" is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#),
        ("ann.path.json", r#""08:00:00.5""#, r#""08:00:00.""#,
            r#"ann.path.json:12:28: "08:00:00." is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#),
        ("ann.path.json", r#"{ "for_s": 60 }"#, r#"{ "for_s": 60, "until": "08:00" }"#,
            r#"ann.path.json:11:41: "for_s" and "until" cannot both be given; keep the one that is meant"#),
        ("ann.path.json", r#"{ "for_s": 60 }"#, "{}",
            r#"ann.path.json:11:17: how long? give "for_s" or "until""#),
        ("ann.path.json", r#""until": "07:30", "posture""#, r#""posture""#,
            r#"ann.path.json:5:15: how long? give "for_s" or "until""#),
        ("ann.path.json", r#""every_s": 20, "for_s": 2"#, r#""every_s": 20, "for_s": 21"#,
            r#"ann.path.json:9:67: a stir of 21 s cannot come every 20 s; "for_s" is at most "every_s""#),
        ("ann.path.json", "    ] } }\n  ]", "    ] } },\n    { \"activity\": \"never\" }\n  ]",
            r#"ann.path.json:14:5: this step is never reached; the steps before it are repeated for ever: say how many "times""#),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "steps": [{ "activity": "breakfast" }] } }"#,
            "ann.path.json:8:19: the steps that are repeated take no time; let it wait, or walk somewhere else and back\nann.path.json:9:7: this step is never reached; the steps before it are repeated for ever: say how many \"times\""),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 4, "steps": [{ "go": { "to": ["sink", "sink"] } }] } }"#,
            "ann.path.json:8:19: the steps that are repeated take no time; let it wait, or walk somewhere else and back"),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn nothing_wrong() {
    check(&[
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 4, "steps": [{ "go": { "to": [[1, 1.5], "sink"] } }] } }"#,
            ""),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 1.35e2, "beams": 32.0, "first_fire_s": null"#,
            ""),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [1.5, 0.05], "height_m": 0.6"#,
            ""),
        ("home.json", r#""name": "table""#, r#""name": "kitchen""#,
            ""),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 2, "steps": [{ "go": { "to": [[1, 1.5]] } }, { "repeat": { "times": 1, "steps": [{ "go": { "to": ["sink"] } }] } }] } }"#,
            ""),
    ]);
}

#[test]
fn a_home_has_at_most_1024_sensors_and_32768_beams() {
    let sensor = |index: usize, beams: usize| {
        format!(r#"{{ "name": "s{index}", "kind": "motion", "at": [1, 1], "facing_deg": 0, "beams": {beams} }}"#)
    };
    let with = |count: usize, beams: usize| {
        let sensors: Vec<String> = (0..count).map(|index| sensor(index, beams)).collect();
        let mut files = good();
        let home = &files["home.json"];
        let start = home.find(r#""sensors": ["#).unwrap() + r#""sensors": ["#.len();
        let home = format!("{}\n{}\n  ]\n}}\n", &home[..start], sensors.join(",\n"));
        files.insert("home.json".into(), home);
        files.insert("logger.json".into(), "{}".into());
        said(&files)
    };
    assert_eq!(with(1024, 32), "");
    assert_eq!(with(1025, 1), r#"home.json:26:14: "sensors" must have at most 1024 items, but has 1025; Sensors"#);
    assert_eq!(with(129, 256), "home.json:155:1: the sensors up to this one have more than 32768 beams together");
}

#[test]
fn a_wrong_home_does_not_blame_the_paths_through_it() {
    let files = broken(&[("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4.5, 1], "to": [4.5, 2]"#)]);
    assert_eq!(said(&files).lines().count(), 1);
}

#[test]
fn the_table_of_runs_is_taken() {
    let files = broken(&[("logger.json", r#""event""#, r#""run""#)]);
    let expected = "logger.json:3:12: the table \"run\" says which runs the log holds: the firings need another";
    assert_eq!(said(&files), expected);
}

#[test]
fn held_keys_do_not_begin_in_a_door_that_leads_out() {
    let files = broken(&[
        ("home.json", r#""open": false, "outside": true"#, r#""outside": true"#),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [1.5, 0]"#),
    ]);
    let expected = "bob.json:3:59: Bob starts in a door that leads out, where held keys do not go; \
        the body's radius is 0.22 m: move the start inside";
    assert_eq!(said(&files), expected);
}

#[test]
fn an_area_does_not_reach_through_a_wall() {
    let over =
        |area: &str| said(&broken(&[("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#, area)]));
    assert_eq!(
        over(r#""area": [[3.5, 0.2], [4.5, 0.2], [4.5, 0.8], [3.5, 0.8]]"#),
        "home.json:30:56: the area of \"bed\" \
        reaches through the wall between \"bedroom\" and \"kitchen\"; a sensor on the ceiling sees one side of a wall: let its area end there"
    );
    // Into the wall and up to its middle is no harm; nor is through a door that stands open.
    assert_eq!(over(r#""area": [[4, 0], [5, 0], [5, 0.8], [4, 0.8]]"#), "");
    assert_eq!(over(r#""area": [[3.5, 1.0], [4.5, 1.0], [4.5, 2.0], [3.5, 2.0]]"#), "");
}

#[test]
fn walls_are_not_drawn_over_and_over() {
    let with = |home: &str, list: &str, more: &[String]| {
        let begin = format!(r#""{list}": ["#);
        home.replacen(&begin, &format!("{begin}{},", more.join(",")), 1)
    };
    let said = |home: String| {
        let mut files = good();
        files.insert("home.json".into(), home);
        said(&files)
    };
    let home = &good()["home.json"];
    let walls = |count: usize| with(home, "walls", &vec![r#"{ "from": [0, 0], "to": [8, 0] }"#.to_owned(); count]);
    assert_eq!(said(walls(150)), "");
    let many = said(walls(300));
    assert!(many.contains("the walls meet or cross each other more than 20000 times"), "{many}");
    let door = |index: usize| {
        let from = 0.5 + 0.2 * index as f64;
        format!(r#"{{ "name": "door {index}", "from": [{from}, 0], "to": [{}, 0] }}"#, from + 0.1)
    };
    let many = said(with(&walls(100), "doors", &(0..21).map(door).collect::<Vec<_>>()));
    assert!(many.contains("the doors are in more than 2000 walls together"), "{many}");
}
