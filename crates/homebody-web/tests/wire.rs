//! The types of the page agree with the server's, and its kinds of sensors and activities with the core's.

use crate::generated::is_generated;
use homebody_analysis::care::{BesideUsual, CareDay, ChartPoint, DayKnowledge, MeasureChart, MeasureWords};
use homebody_analysis::coverage::SensorCoverage;
use homebody_analysis::episodes::{
    ChangeEpisode, Course, DaysAway, Headline, HeadlineState, ReferenceDays, SeenWith, Sign,
};
use homebody_analysis::measures::{MEASURES, MeasureGroup, ValueForm};
use homebody_analysis::parts::SensorDifference;
use homebody_core::activity::{ACTIVITIES, AWAY, ActivityKind, KIND_WORDS};
use homebody_core::sensors::form::{Colour, KindRow, Mount};
use homebody_core::sensors::kinds::KINDS;
use homebody_core::sensors::products::Product;
use homebody_life::{LOCAL_SERVERS, MOST_CHARACTERS, MOST_ROUNDS};
use homebody_log::MovementKind;
use homebody_placement::search::Reached;
use homebody_query::search::SearchSubject;
use homebody_routine::completion::{Completion, CompletionKind};
use homebody_routine::language::activities::phrase;
use homebody_routine::routine::Activity;
use homebody_simulation::RunOptions;
use homebody_web::wire::*;
use serde_json::json;
use ts_rs::{Config, TS};

/// All types of the wire, in reading order.
fn declarations() -> Vec<String> {
    macro_rules! declare {
        ($($name:ident),* $(,)?) => {
            vec![$(format!("export {}", $name::decl(&Config::default()))),*]
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
        CameraView,
        RunView,
        ResidentView,
        RunFrame,
        RunState,
        BodyView,
        MapPosture,
        FiringView,
        CameraStateView,
        StoredView,
        RunAbout,
        DeletedKey,
        LibraryView,
        HomeEntryView,
        DeletedHome,
        TemplateView,
        CardView,
        NewHome,
        MadeView,
        CallHome,
        PlaybackView,
        LanesView,
        ReadingView,
        SilhouettesView,
        MomentView,
        PictureView,
        PersonView,
        CareView,
        PlaybackContent,
        CareDay,
        DayKnowledge,
        MeasureWords,
        CareSentenceView,
        BesideUsual,
        MeasureGroup,
        Headline,
        HeadlineState,
        ReferenceDays,
        DaysAway,
        ChangeEpisode,
        Course,
        Sign,
        SeenWith,
        MeasureChart,
        ValueForm,
        ChartPoint,
        NoteView,
        NoteSubject,
        NoteChange,
        KeptLogView,
        LocatedView,
        DateView,
        DayView,
        PersonDay,
        Find,
        SearchSubject,
        FoundView,
        HitView,
        LocatingView,
        LocatingState,
        MovementKind,
        PageCommand,
        RunOptions,
        Key,
        RunNotice,
        RefusedView,
        FilesView,
        UnderlayView,
        ResidentRoutineView,
        FileView,
        Draft,
        Save,
        SaveFile,
        SavedView,
        CheckView,
        Named,
        Rename,
        Forget,
        NamesView,
        MentionView,
        MendView,
        ProblemView,
        FixView,
        PlanView,
        CoverageView,
        FloorView,
        SensorCoverage,
        DeadZoneView,
        ImportView,
        Explain,
        ExplainView,
        SentenceView,
        ConditionView,
        StatementsView,
        StatementView,
        SentencePlace,
        WriteStatement,
        ReplacedStatement,
        WrittenStatementView,
        FieldFaultView,
        TextEditView,
        FreeTextRequest,
        Answerer,
        FreeTextView,
        FreeTextState,
        RoundView,
        DraftLineView,
        DraftStatementView,
        AcceptLines,
        AcceptedView,
        Completion,
        CompletionKind,
        Month,
        MonthView,
        RowsView,
        PlaceRowsView,
        Connect,
        ConnectView,
        LiveCountsView,
        PartView,
        PartsView,
        Layouts,
        NamedLayout,
        LayoutsView,
        LayoutView,
        SensorDifference,
        Suggest,
        SuggestionView,
        StepView,
        Reached,
    )
}

#[test]
fn the_page_has_all_types() {
    is_generated(
        "web/src/wire.ts",
        &format!(
            "// Made from crates/homebody-web/src/wire.rs and what is below it, which say what each means.\n\n{}\n",
            declarations().join("\n\n")
        ),
    );
}

#[test]
fn the_page_has_all_kinds_of_sensors() {
    let row = |kind: &&KindRow| {
        let word = |variant: &dyn std::fmt::Debug| format!("{variant:?}").to_lowercase();
        let list = |texts: Vec<String>| serde_json::to_string(&texts).unwrap().replace(',', ", ");
        let (mount, bearers) = match kind.mount {
            Mount::Thing(bearers) => ("thing".to_owned(), bearers),
            other => (word(&other), &[][..]),
        };
        format!(
            "  {}: {{ label: {:?}, mount: {mount:?}, bearers: {}, unit: {}, values: {}, shape: {:?}, colour: {:?}, casas: {:?} }},\n",
            kind.key,
            kind.label,
            list(bearers.iter().map(|bearer| word(bearer)).collect()),
            kind.unit.map_or("null".into(), |unit| format!("{:?}", unit.symbol)),
            list(kind.values.iter().map(ToString::to_string).collect()),
            word(&kind.shape),
            word(&kind.colour),
            kind.casas,
        )
    };
    let rows: String = KINDS.iter().map(row).collect();
    is_generated(
        "web/src/sensors.ts",
        &format!(
            "// Made from crates/homebody-core/src/sensors/kinds.rs and the rows that it lists; form.rs says what each means.\n\n\
         export const SENSOR_KINDS = {{\n{rows}}} as const;\n"
        ),
    );
}

#[test]
fn the_page_has_all_devices() {
    let row = |device: Product| {
        let [across, down] = device.field_deg.value;
        let timing = device.preset.timing();
        format!(
            "  {{ key: {:?}, name: {:?}, network: {:?}, height_m: {}, field_deg: [{across}, {down}], reach_m: {}, refire_s: {:?}, sources: {} }},\n",
            device.key(),
            device.name(),
            device.network,
            device.height_m.value,
            device.reach_m.value,
            timing.refire_s,
            json!({
                "height": device.height_m.source, "field": device.field_deg.source, "reach": device.reach_m.source,
                "timing": device.timing,
            }),
        )
    };
    let rows: String = Product::all().map(row).collect();
    is_generated(
        "web/src/devices.ts",
        &format!(
            "// Made from crates/homebody-core/src/sensors/products.rs, which says what each means.\n\n\
         export type Product = {{\n  /** The key of `preset`. */\n  key: string;\n  name: string;\n  network: string;\n  \
         height_m: number;\n  field_deg: [number, number];\n  reach_m: number;\n  refire_s: [number, number];\n  \
         /** The sources of the numbers. */\n  sources: {{ height: string; field: string; reach: string; timing: string }};\n}};\n\n\
         export const DEVICES: readonly Product[] = [\n{rows}];\n"
        ),
    );
}

#[test]
fn the_page_has_all_activities() {
    let key = |kind: ActivityKind| serde_json::to_value(kind).unwrap().as_str().unwrap().to_owned();
    let colour = |colour: Colour| format!("'{}'", format!("{colour:?}").to_lowercase());
    let mut text =
        "// Made from the table in crates/homebody-core/src/activity.rs, which says what each means.\n\n".to_owned();
    text += "/** In the order of legends; no colour is that of text. */\nexport const KINDS = {\n";
    for kind in ActivityKind::ALL {
        let colour = kind.colour().map_or("null".into(), colour);
        text += &format!("  {}: {{ name: '{}', colour: {colour} }},\n", key(kind), kind.in_words());
    }
    text += "} as const;\n\n/** Kinds of the activities of residents, by their label in the truth. */\n";
    text += "export const KNOWN: ReadonlyMap<string, keyof typeof KINDS> = new Map([\n";
    for known in ACTIVITIES {
        text += &format!("  ['{}', '{}'],\n", known.label, key(known.kind));
    }
    text += "]);\n\n/** Beginnings of words in other names, by kind; the first match counts. */\n";
    text += "export const KIND_WORDS: readonly (readonly [keyof typeof KINDS, readonly string[]])[] = [\n";
    for (kind, words) in KIND_WORDS {
        text += &format!("  ['{}', {}],\n", key(kind), format!("{words:?}").replace('"', "'"));
    }
    text += "];\n\n/** The usual words for the activities that a routine can name, by their label. */\n";
    text += "export const SAID: ReadonlyMap<string, string> = new Map([\n";
    for activity in Activity::all_of_table() {
        text += &format!("  ['{}', '{}'],\n", activity.label(), phrase(&activity));
    }
    text += &format!("]);\n\n/** The activity of a person who is out of the home. */\nexport const AWAY = '{AWAY}';\n");
    is_generated("web/src/activities.ts", &text);
}

#[test]
fn the_page_has_all_measures() {
    let mut text = "// Made from the table in crates/homebody-analysis/src/measures/registry.rs, which has the definitions.\n\n\
         /** Measures of the night before the day, but for parts of the day. */\nexport const OF_NIGHT: ReadonlySet<string> = new Set(["
        .to_owned();
    let of_night = MEASURES.iter().filter(|measure| measure.occasion == "night" && measure.first_hour.is_none());
    text += &of_night.map(|measure| format!("'{}'", measure.name)).collect::<Vec<_>>().join(", ");
    text += "]);\n\n/** Measures of a part of the day, with its first hour. */\nexport const FIRST_HOURS: Readonly<Record<string, number>> = {";
    let parts = MEASURES.iter().filter_map(|measure| Some(format!(" {}: {}", measure.name, measure.first_hour?)));
    text += &parts.collect::<Vec<_>>().join(",");
    text +=
        " };\n\n/** Measures that the page offers as goals of suggested sensors. */\nexport const MEASURE_GOALS = [\n";
    for (name, goal) in MEASURES.iter().filter_map(|measure| Some((measure.name, measure.goal?))) {
        text += &format!("  {{ id: '{name}', title: '{goal}' }},\n");
    }
    is_generated("web/src/measures.ts", &(text + "];\n"));
}

#[test]
fn the_page_has_the_limits_of_free_text() {
    let servers = LOCAL_SERVERS.map(|url| format!("'{url}'")).join(", ");
    let text = format!(
        "// Made from homebody-life.\n\n\
         /** The addresses of Ollama and llama.cpp on the machine of Homebody, which are asked without another address. */\n\
         export const LOCAL_SERVERS = [{servers}] as const;\n\n\
         /** The longest text. */\nexport const MOST_CHARACTERS = {MOST_CHARACTERS};\n\n\
         /** Most answers about a text. */\nexport const MOST_ROUNDS = {MOST_ROUNDS};\n"
    );
    is_generated("web/src/free-text.ts", &text);
}

#[test]
fn the_page_has_the_options_of_a_run() {
    /// The largest whole number that is exact in the page.
    const MOST_EXACT: f64 = 9_007_199_254_740_991.0;
    let schema = RunOptions::schema().to_value();
    let mut text = "// Made from RunOptions in crates/homebody-simulation/src/run_options.rs.\n\n\
         import type { RunOptions } from './wire';\n\n\
         export type RunOption = {\n  \
         /** A type of JSON Schema. */\n  type: 'array' | 'boolean' | 'integer' | 'number' | 'object' | 'string';\n  \
         /** Of its field; missing for an option that the form of the page does not offer. */\n  label?: string;\n  \
         help: string;\n  least?: number;\n  /** In place of the least value. */\n  above?: number;\n  most?: number;\n  \
         /** A regular expression that the whole text matches. */\n  pattern?: string;\n  \
         /** The expected values, in words. */\n  expected?: string;\n};\n\n\
         export const RUN_OPTIONS: Readonly<Record<keyof RunOptions, RunOption>> = {\n"
        .to_owned();
    for (name, option) in schema["properties"].as_object().unwrap() {
        let kind = option["type"].as_str().or(option["type"][0].as_str()).unwrap();
        text += &format!("  {name}: {{ type: '{kind}'");
        let words = [("label", "title"), ("help", "description"), ("pattern", "pattern"), ("expected", "expected")];
        for (field, key) in words.into_iter().filter(|(_, key)| option[key].is_string()) {
            let words = option[key].as_str().unwrap().lines().next().unwrap();
            text += &format!(", {field}: {}", json!(words));
        }
        for (field, key) in [("least", "minimum"), ("above", "exclusiveMinimum"), ("most", "maximum")] {
            if let Some(number) = option[key].as_f64() {
                text += &format!(", {field}: {}", number.min(MOST_EXACT));
            }
        }
        text += " },\n";
    }
    is_generated("web/src/run-options.ts", &(text + "};\n"));
}
