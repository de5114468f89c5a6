//! As much of Markdown as the rules need: which lines are prose and which are code, and what prose points at.

/// A document, taken apart into numbered lines.
pub struct Document {
    pub prose: Vec<(usize, String)>,
    pub code: Vec<(usize, String)>,
}

impl Document {
    /// Code is what is fenced, and what is indented by four outside a list.
    pub fn new(text: &str) -> Document {
        let mut document = Document { prose: Vec::new(), code: Vec::new() };
        let (mut fence, mut in_list, mut may_indent) = (None::<&str>, false, true);
        for (number, line) in super::numbered(text) {
            let trimmed = line.trim_start();
            let mark = ["```", "~~~"].into_iter().find(|mark| trimmed.starts_with(mark));
            match (fence, mark) {
                (None, Some(_)) => fence = mark,
                (Some(open), Some(close)) if open == close => fence = None,
                (Some(_), _) => document.code.push((number, line.into())),
                (None, None) if may_indent && !in_list && line.starts_with("    ") => {
                    document.code.push((number, trimmed.into()));
                }
                (None, None) => {
                    document.prose.push((number, line.into()));
                    may_indent = trimmed.is_empty();
                    if !line.starts_with(' ') && !trimmed.is_empty() {
                        in_list = is_item(line);
                    }
                }
            }
        }
        document
    }

    /// Text between backticks, with its line.
    pub fn spans(&self) -> Vec<(usize, String)> {
        let spans = |line: &str| line.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
        self.prose.iter().flat_map(|(number, line)| spans(line).into_iter().map(move |span| (*number, span))).collect()
    }

    /// Targets of links and pictures, with their line: `[text](where)`, and `[text]: where` at the start of a line.
    pub fn links(&self) -> Vec<(usize, String)> {
        let mut links = Vec::new();
        for (number, line) in &self.prose {
            // Code has no links.
            let line: String = line.split('`').step_by(2).collect::<Vec<_>>().join("code");
            let inline = line.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next());
            let listed = line.trim().starts_with('[').then(|| line.split_once("]: ")).flatten().map(|(_, rest)| rest);
            links.extend(inline.chain(listed).map(|link| (*number, link.trim().to_owned())));
        }
        links
    }

    pub fn anchors(&self) -> Vec<String> {
        let titles = self.prose.iter().filter(|(_, line)| line.starts_with('#'));
        titles.map(|(_, line)| anchor(line.trim_start_matches('#').trim())).collect()
    }
}

/// A title as forges make an anchor of it.
fn anchor(title: &str) -> String {
    let kept = title.to_lowercase().replace(' ', "-");
    kept.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
}

fn is_item(line: &str) -> bool {
    let number = line.trim_start_matches(|c: char| c.is_ascii_digit());
    ["- ", "* ", "+ "].iter().any(|bullet| line.starts_with(bullet))
        || number.len() < line.len() && number.starts_with(". ")
}

#[test]
fn a_document_is_taken_apart() {
    let text = "# A title, 1\n\nSee `a/b.rs` and [c](d.md#e).\n\n    run it\n\n- item\n\n    still `f`\n\n```sh\nls `x`\n```\n[g]: h\n";
    let document = Document::new(text);
    assert_eq!(document.code, [(5, "run it".into()), (12, "ls `x`".into())]);
    assert_eq!(document.spans(), [(3, "a/b.rs".into()), (9, "f".into())]);
    assert_eq!(document.links(), [(3, "d.md#e".into()), (14, "h".into())]);
    assert_eq!(document.anchors(), ["a-title-1"]);
}
