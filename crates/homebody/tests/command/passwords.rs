//! Every argument of the command refuses a password in a URL, and no message repeats it.

use crate::flat::flat;

const CANARY: &str = "s3cr3t-canary";

#[test]
fn a_password_in_a_url_is_refused_and_never_told_again() {
    let folder = flat();
    folder.write("log.csv", "seq,fired_at,sensor,value\n0,2009-03-02 07:12:03.250000,hall,ON\n");
    let urls = [
        format!("postgresql://ann:{CANARY}@127.0.0.1:1/homes"),
        format!("postgres://ann:{CANARY}@127.0.0.1:1/homes?schema=a"),
        format!("postgresql://ann@127.0.0.1:1/homes?password={CANARY}"),
        format!("postgresq://ann:{CANARY}@127.0.0.1:1/homes"),
        format!("mqtt://ann:{CANARY}@127.0.0.1:1/homes"),
    ];
    // A destination and a log are read in two ways, which all arguments share.
    let of_all_kinds = ["run flat --for 1m --out URL", "inspect URL"];
    let others = [
        "run flat --for 1m --out csv:a.csv --truth URL",
        "compare URL log.csv",
        "density URL",
        "convert URL --out csv:b.csv",
        "convert log.csv --out URL",
        "anonymise log.csv --out URL",
        "label log.csv --truth URL --out csv:c.csv",
    ];
    let all = urls.iter().flat_map(|url| of_all_kinds.map(|words| (words, url)));
    for (words, url) in all.chain(others.map(|words| (words, &urls[0]))) {
        let done = folder.run(&words.replace("URL", url));
        let told = format!("{}{}", done.out, done.err);
        assert_ne!(done.code, Some(0), "{words} {url}: {told}");
        assert!(!told.contains(CANARY), "{words} {url}: {told}");
    }
    let logger = format!(r#"{{ "to": ["postgresql://ann:{CANARY}@127.0.0.1:1/homes"] }}"#);
    folder.write("flat/logger.json", logger);
    for words in ["check flat", "run flat --for 1m"] {
        let done = folder.run(words);
        assert!(done.code == Some(2) && !format!("{}{}", done.out, done.err).contains(CANARY), "{words}: {}", done.err);
    }
    for file in folder.files().iter().filter(|file| !file.ends_with("logger.json")) {
        assert!(!folder.read(file).contains(CANARY), "{file}");
    }
}
