use super::*;

pub fn home() -> Known {
    let list = |names: &str| names.split(", ").map(str::to_owned).collect();
    Known {
        person: Some("Margaret".into()),
        places: list(
            "armchair, sofa, bed, dining chair, toilet, shower, stove, fridge, living room window, front door",
        ),
        things: list("stove, fridge, front door, bedroom door, television, lamp, washing machine, armchair, bed"),
        rooms: list("bedroom, bathroom, kitchen, living room, hall"),
        conditions: list("depression, heart-failure, urinary-tract-infection, cognitive-decline"),
        first_date: Some((2009, 3, 2)),
    }
}

const EXAMPLE: &str = "\
Margaret is 82. She walks at about 0.65 m/s.

Every day
  she gets up at about 06:45, give or take 30 minutes
  she takes her medicine with breakfast
  she prepares breakfast at about 07:40 for 15 minutes, then eats for 20 minutes
  she watches television in the evening for about 2 hours
  she goes to bed at about 22:30

Most nights she goes to the bathroom once or twice.
Often she reads in the afternoon for about 40 minutes.
On Tuesday and Friday she leaves the apartment at about 10:00 for 2 to 3 hours.
Sometimes her daughter visits on Sunday afternoon for 2 hours.

From week 6, over 4 weeks, she shows moderate depression.
From day 100 she wanders at night, rarely at first, often by day 160.
";

#[test]
fn the_example_of_the_design_is_understood() {
    let (routine, problems) = routine("margaret.routine", EXAMPLE, &home());
    assert_eq!(problems, [], "{}", homebody_core::problem::Problems(problems.clone()).render());
    assert_eq!(routine.habits.len(), 11);
    assert_eq!(routine.changes.len(), 1);
}
