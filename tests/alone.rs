//! Tests that need a process of their own, because they measure its memory or what becomes of its threads.

use std::process::Command;

/// Set in a process that runs one test.
const ALONE: &str = "HOMEBODY_TEST_ALONE";

/// Whether this process runs only this test. In another process it starts the test again alone, in this environment, and the test has to
/// pass there.
pub fn is_alone(test: &str, environment: &[(&str, &str)]) -> bool {
    if std::env::var_os(ALONE).is_some() {
        return true;
    }
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args([test, "--exact", "--test-threads=1", "--nocapture"]).env(ALONE, "1");
    let output = command.envs(environment.iter().copied()).output().unwrap();
    let printed = String::from_utf8_lossy(&output.stdout);
    println!("{printed}");
    assert!(output.status.success() && printed.contains("1 passed"), "{}", String::from_utf8_lossy(&output.stderr));
    false
}
