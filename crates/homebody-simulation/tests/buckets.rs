//! A cohort in an object store, here a folder; the tests of the command use a server that speaks S3.

use homebody_simulation::{CohortLayout, IncompleteCohort, SimulationError, bring_member, list_of_cohort};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// All files below a folder, with their contents.
fn held(folder: &Path, whole: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        match entry.path() {
            path if path.is_dir() => held(&path, whole, files),
            path => _ = files.insert(path.strip_prefix(whole).unwrap().into(), fs::read(&path).unwrap()),
        }
    }
}

fn all_in(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    held(folder, folder, &mut files);
    files
}

#[test]
fn a_cohort_in_a_store_has_the_bytes_of_one_in_a_folder_and_resumes() {
    let scratch = tempfile::tempdir().unwrap();
    let [here, there] = ["here", "there"].map(|name| scratch.path().join(name));
    fs::create_dir(&there).unwrap();
    let url = PathBuf::from(format!("file://{}", there.display()));
    let setup = homebody_simulation::open("../../scenarios/studio").unwrap().cohort(3).seed(7).days(0.3);
    let cohort = setup.layout(CohortLayout::of(&"csv:cohort".parse().unwrap()).unwrap()).start().unwrap();
    let lived = cohort.store_in(&here, |_| ()).unwrap();
    assert_eq!(cohort.store_in(&url, |_| ()).unwrap().list, lived.list);
    let whole = all_in(&here);
    assert!(whole.len() > 3 * 10 && all_in(&there) == whole);
    // Nothing is replaced.
    let again = cohort.store_in(&url, |_| ());
    assert!(matches!(again, Err(SimulationError::NotEmpty { is_cohort: true, .. })));
    assert!(matches!(IncompleteCohort::open(&url), Err(SimulationError::Complete { .. })));
    // Members without a recording or another file are simulated again; others stay.
    fs::remove_file(there.join("members/0002/recording.json")).unwrap();
    fs::remove_file(there.join("log/member=0003/log.csv")).unwrap();
    let gone_on = IncompleteCohort::open(&url).unwrap().resume(|_| ()).unwrap();
    assert_eq!((gone_on.found, gone_on.list == lived.list), (1, true));
    assert!(all_in(&there) == whole);
    assert_eq!(list_of_cohort(&url).unwrap(), list_of_cohort(&here).unwrap());
    let copy = scratch.path().join("copy");
    bring_member(&url, "csv", "0001", &copy).unwrap();
    let copied = all_in(&copy);
    assert!(copied.len() > 10 && copied.iter().all(|(name, bytes)| whole.get(name) == Some(bytes)));
    // The control: another cohort is refused.
    fs::copy(there.join("members/0001/recording.json"), there.join("members/0002/recording.json")).unwrap();
    let why = IncompleteCohort::open(&url).err().unwrap().to_string();
    assert!(why.contains("there/members/0002/recording.json: it is of another cohort"), "{why}");
}
