//! The classes of the data set, and the simulated activities of each.

use homebody_core::activity::{
    AWAY, COMING_HOME, DRINKING, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, FRESHENING_UP, GOING_TO_BED, GROOMING,
    HAVING_A_SNACK, LEAVING_HOME, LYING_AWAKE, PREPARING_BREAKFAST, PREPARING_DINNER, PREPARING_LUNCH, SHOWERING,
    SLEEPING, TimeUse, USING_BATHROOM, WASHING,
};

pub const CLASSES: [&str; 10] = [
    "Sleeping",
    "Toileting",
    "Showering",
    "Grooming",
    "Breakfast",
    "Lunch",
    "Dinner",
    "Snack",
    "Spare_Time/TV",
    "Leaving",
];

pub const COUNT: usize = CLASSES.len();

/// The labels of each class in a simulation, in the same order. Spare time is what people do for pleasure.
const LIVED: [&[&str]; COUNT] = [
    &[SLEEPING, GOING_TO_BED, LYING_AWAKE],
    &[USING_BATHROOM],
    &[SHOWERING],
    &[WASHING, GROOMING, FRESHENING_UP],
    &[PREPARING_BREAKFAST, EATING_BREAKFAST],
    &[PREPARING_LUNCH, EATING_LUNCH],
    &[PREPARING_DINNER, EATING_DINNER],
    &[HAVING_A_SNACK, DRINKING],
    &[],
    &[AWAY, LEAVING_HOME, COMING_HOME],
];

/// The class with this name in the annotations or in a simulation; `None` for other activities.
pub fn class_of(name: &str) -> Option<usize> {
    let said = CLASSES.iter().position(|class| *class == name);
    let lived = || LIVED.iter().position(|labels| labels.contains(&name));
    said.or_else(lived).or_else(|| is_spare_time(name).then(spare_time))
}

fn is_spare_time(label: &str) -> bool {
    matches!(
        TimeUse::from_label(label),
        TimeUse::Television | TimeUse::Reading | TimeUse::Relaxing | TimeUse::Company | TimeUse::Computer
    )
}

fn spare_time() -> usize {
    CLASSES.iter().position(|class| class.contains("TV")).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::activity::{NAPPING, READING, TIDYING, WATCHING_TELEVISION};

    #[test]
    fn annotations_and_lives_have_the_same_classes() {
        for (one, other) in [
            ("Sleeping", SLEEPING),
            ("Lunch", PREPARING_LUNCH),
            ("Spare_Time/TV", WATCHING_TELEVISION),
            ("Spare_Time/TV", READING),
            ("Leaving", AWAY),
        ] {
            assert!(class_of(one).is_some() && class_of(one) == class_of(other), "{one} {other}");
        }
        assert_eq!([TIDYING, NAPPING, "", "Dancing"].map(class_of), [None; 4]);
    }
}
