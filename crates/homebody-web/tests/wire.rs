//! The page's types are the server's.

use homebody_web::wire;
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
    if std::env::var_os("HOMEBODY_REWRITE").is_some() {
        fs::write(&path, &text).unwrap();
    }
    assert_eq!(fs::read_to_string(&path).unwrap_or_default(), text, "HOMEBODY_REWRITE=1 writes it anew");
}
