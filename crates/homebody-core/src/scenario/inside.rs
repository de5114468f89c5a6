//! Places stay inside: what a file names is read and written below one folder, whoever wrote the file.

/// What to do about a link that leads out of the folder.
pub const WHERE: &str = "name a file relative to the scenario's folder, with / between folders";

/// Why a name is refused that is to be a file inside `folder`, which is given in words; `None` if it is one. It is the
/// spelling that is looked at, so that a name means the same on each system: links on a disk are for who reads them.
pub fn outside_folder(name: &str, folder: &str) -> Option<String> {
    if name.trim().is_empty() {
        return Some("a file name must not be empty".into());
    }
    let leaves = name.split(['/', '\\']).any(|part| part == "..");
    let is_absolute = name.starts_with(['/', '\\']) || name.contains(':');
    let is_odd = name.contains('\\') || name.chars().any(char::is_control);
    (leaves || is_absolute || is_odd).then(|| format!("{name:?} is no file name inside {folder}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_out_are_refused() {
        for name in ["log.db", "logs/log.db", "a b/ö.csv", "..log", "log..db", "./log.db", "~/log.db"] {
            assert_eq!(outside_folder(name, "it"), None, "{name}");
        }
        for name in [
            "",
            " ",
            "/etc/passwd",
            "..",
            "../log.db",
            "a/../../b",
            "a/..",
            "C:log",
            "\\\\host\\log",
            "a\\..\\b",
            "a\nb",
        ] {
            assert!(outside_folder(name, "it").is_some(), "{name}");
        }
    }
}
