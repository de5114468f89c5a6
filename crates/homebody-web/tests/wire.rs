//! The page's types are the server's.

use homebody_core::activity::{ACTIVITIES, ActivityKind, KIND_WORDS};
use homebody_web::wire;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use ts_rs::{Config, TS};

/// Every type that crosses the wire, in reading order.
fn declarations() -> Vec<String> {
    macro_rules! declare {
        ($($name:ident),* $(,)?) => {
            vec![$(format!("export {}", wire::$name::decl(&Config::default()))),*]
        };
    }
    declare!(
        HomeView,
        RoomView,
        SolidView,
        SolidKind,
        DoorView,
        ThingView,
        ThingKind,
        SensorView,
        RunView,
        ResidentView,
        Frame,
        State,
        BodyView,
        Posture,
        FiringView,
        StoredView,
        PlaybackView,
        DateView,
        DayView,
        LifeView,
        MotionState,
        Say,
        Key,
        Tell,
        FilesView,
        LivesView,
        FileView,
        Draft,
        Save,
        SaveFile,
        SavedView,
        CheckView,
        ProblemView,
        PlanView,
        CoverageView,
        FloorView,
        SeenView,
        DeadZoneView,
        ImportView,
        Explain,
        ExplainView,
        SentenceView,
        ConditionView,
        WordView,
        WordKind,
        Month,
        MonthView,
        RowsView,
        PlaceRowsView,
        Connect,
        ConnectView,
        GrowthView,
    )
}

/// `HOMEBODY_REWRITE=1` writes the file anew.
#[test]
fn the_page_knows_our_types() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/src/wire.ts");
    let text = format!(
        "// Made from crates/homebody-web/src/wire.rs and what is below it, which say what each means.\n\n{}\n",
        declarations().join("\n\n")
    );
    assert_is_in(&path, &text);
}

/// A kind as the page writes it: `"sleep"`.
fn quoted(kind: ActivityKind) -> String {
    serde_json::to_string(&kind).unwrap()
}

/// `HOMEBODY_REWRITE=1` writes the file anew.
#[test]
fn the_page_knows_our_activities() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/src/activities.ts");
    let kinds = ActivityKind::ALL;
    let all: Vec<String> = kinds.map(quoted).into();
    let mut text =
        "// Made from the table in crates/homebody-core/src/activity.rs, which says what each means.\n\n".to_owned();
    writeln!(text, "export type ActivityKindId = {};\n", all.join(" | ")).unwrap();
    text += "export const KIND_NAMES: Readonly<Record<ActivityKindId, string>> = {\n";
    for kind in kinds {
        writeln!(text, "  {}: {:?},", quoted(kind), kind.in_words()).unwrap();
    }
    text += "};\n\n/** What lives tell of, by the label of the truth. */\n";
    text += "export const KNOWN_KINDS: ReadonlyMap<string, ActivityKindId> = new Map([\n";
    for known in ACTIVITIES {
        writeln!(text, "  [{:?}, {}],", known.label, quoted(known.kind)).unwrap();
    }
    text += "]);\n\n/** How the words of other names begin, by kind; the first that fits counts. */\n";
    text += "export const KIND_WORDS: readonly (readonly [ActivityKindId, readonly string[]])[] = [\n";
    for (kind, words) in KIND_WORDS {
        writeln!(text, "  [{}, {words:?}],", quoted(kind)).unwrap();
    }
    text += "];\n";
    assert_is_in(&path, &text);
}

#[track_caller]
fn assert_is_in(path: &Path, text: &str) {
    if std::env::var_os("HOMEBODY_REWRITE").is_some() {
        fs::write(path, text).unwrap();
    }
    assert_eq!(fs::read_to_string(path).unwrap_or_default(), text, "HOMEBODY_REWRITE=1 writes it anew");
}
