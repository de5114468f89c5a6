// Made from crates/homebody-web/src/wire.rs and what is below it, which say what each means.

export type HomeView = { name: string, 
/**
 * The lower left and the upper right corner of all there is.
 */
bounds: [[number, number], [number, number]], rooms: Array<RoomView>, 
/**
 * Walls, doors that are closed, and furniture: convex outlines.
 */
solids: Array<SolidView>, doors: Array<DoorView>, 
/**
 * What can be used, in the order of [`Frame::on`].
 */
things: Array<ThingView>, 
/**
 * In the order in which firings count them.
 */
sensors: Array<SensorView>, };

export type RoomView = { name: string, outline: Array<[number, number]>, 
/**
 * Where its name goes.
 */
middle: [number, number], 
/**
 * The floor that it is on, in a home of several.
 */
floor: string | null, };

export type SolidView = { kind: SolidKind, 
/**
 * Of furniture.
 */
name: string | null, outline: Array<[number, number]>, 
/**
 * Whether bodies can be in it: a bed, a chair, a rug.
 */
enterable: boolean, };

export type SolidKind = "wall" | "door" | "furniture";

export type DoorView = { name: string, 
/**
 * Its jambs; a door that stands open is hinged at the first.
 */
from: [number, number], to: [number, number], open: boolean, 
/**
 * Whether it leads out of the home.
 */
outside: boolean, };

export type ThingView = { name: string, kind: ThingKind, at: [number, number], 
/**
 * What is done to it, and what undoes that: `Turn on`, `Turn off`.
 */
verbs: [string, string], };

export type ThingKind = "door" | "furniture" | "lamp";

export type SensorView = { name: string, 
/**
 * As its file says it: `motion`, `bed`, `contact`, ...
 */
kind: string, 
/**
 * The room that it is in.
 */
room: string | null, at: [number, number], 
/**
 * Where it looks, counted from east against the clock; of sensors on walls.
 */
facing_deg: number | null, 
/**
 * The parts of its beams in which it sees a standing adult, from where to where; of sensors on walls.
 */
beams: Array<[[number, number], [number, number]]>, 
/**
 * What it sees from the ceiling, or the mat or bed that it feels.
 */
area: Array<[number, number]> | null, 
/**
 * Of cameras.
 */
camera: CameraView | null, };

export type CameraView = { 
/**
 * Columns and rows of its pictures.
 */
pixels: [number, number], 
/**
 * From one picture to the next.
 */
period_us: number, 
/**
 * Whether it never sleeps.
 */
always: boolean, 
/**
 * The floor, beds and seats that it sees, as rectangles: left, lower, right and upper edge.
 */
seen: Array<[number, number, number, number]>, 
/**
 * The same of what it would see if furniture did not hide it.
 */
hidden: Array<[number, number, number, number]>, };

export type RunView = { 
/**
 * The name of its folder, if it is stored in one: what playback knows it by.
 */
id: string | null, scenario: string, home: HomeView, 
/**
 * Residents first, then visitors and pets.
 */
residents: Array<ResidentView>, 
/**
 * Who is moved by keys.
 */
driven: number | null, length_us: number, 
/**
 * A number below 2^53.
 */
seed: number, 
/**
 * Conditions that its residents show, or would if they were not left out.
 */
conditions: Array<string>, 
/**
 * Those that are left out.
 */
without: Array<string>, 
/**
 * By the clock on the wall.
 */
days: Array<DateView>, 
/**
 * From when to when the sun is down.
 */
nights: Array<[number, number]>, 
/**
 * Where the log goes, as URLs.
 */
log: Array<string>, 
/**
 * Whether a recording is being lived again.
 */
replay: boolean, 
/**
 * The versions of the scenario's files that it goes by: what has another one now was saved since. Of a replay there are none.
 */
files: { [key in string]: string }, };

export type ResidentView = { name: string, radius_m: number, };

export type Frame = { now_us: number, 
/**
 * The time on the home's clock, as `2009-03-02 07:12:03`.
 */
clock: string, state: State, 
/**
 * How many seconds go by in a second; nothing where it goes as fast as it can.
 */
speed: number | null, 
/**
 * By resident; nothing for those who are out.
 */
bodies: Array<BodyView | null>, 
/**
 * The sensors that see somebody move.
 */
seeing: Array<number>, 
/**
 * The things that are on, or open.
 */
on: Array<number>, 
/**
 * The sine of the sun's height: below 0 it is dark.
 */
sun: number, 
/**
 * How many firings there have been.
 */
told: number, 
/**
 * The same by sensor.
 */
counts: Array<number>, 
/**
 * The last of those since the frame before, in order.
 */
firings: Array<FiringView>, 
/**
 * The cameras, in the order of sensors.
 */
looks: Array<LookView>, };

export type State = "paused" | "playing" | "over";

export type BodyView = { at: [number, number], 
/**
 * Where it faces, counted from east against the clock.
 */
heading_deg: number, posture: Posture, room: number | null, 
/**
 * What the truth calls what it does.
 */
activity: string | null, };

export type Posture = "standing" | "sitting" | "lying";

export type FiringView = { seq: number, at_us: number, sensor: number, value: string, 
/**
 * Time, sensor and message as they are stored; nothing where no log is looked at.
 */
row: [string, string, string] | null, };

export type LookView = { 
/**
 * Its number among the home's sensors.
 */
sensor: number, awake: boolean, 
/**
 * Its silhouette, packed: lengths of runs of pixels that are off and on in turns; empty where it sees nobody.
 */
packed: Uint8Array, };

export type StoredView = { 
/**
 * The name of its folder.
 */
name: string, scenario: string, 
/**
 * The local date and time of its start.
 */
start: string, days: number, has_truth: boolean, 
/**
 * The name of the log that its path was made from by walking it back.
 */
walked_back: string | null, 
/**
 * Why it cannot be played back.
 */
problem: string | null, 
/**
 * The stable code of the problem.
 */
problem_code?: string, 
/**
 * When its files were begun, in milliseconds since 1970, where that is known.
 */
made_ms: number | null, 
/**
 * A number below 2^53.
 */
seed: number | null, 
/**
 * Conditions that are left out of it.
 */
without: Array<string>, 
/**
 * What somebody has called it, and noted about it.
 */
about: RunAbout, };

export type RunAbout = { 
/**
 * At most 100 letters; none where it is known by its folder alone.
 */
title: string, 
/**
 * At most 2,000 letters.
 */
note: string, };

export type PutAside = { 
/**
 * The name under which it is fetched back.
 */
key: string, };

export type LibraryView = { 
/**
 * Its path on the server's machine.
 */
folder: string, 
/**
 * Why nothing can be changed in it, if that is so.
 */
trouble: string | null, 
/**
 * Those that were changed last come first.
 */
homes: Array<HomeEntryView>, 
/**
 * How many more there are, which are not shown.
 */
more: number, 
/**
 * What was deleted, and can be put back.
 */
aside: Array<AsideView>, templates: Array<TemplateView>, 
/**
 * How many runs lie beside the homes, and belong to none.
 */
runs_beside: number, };

export type HomeEntryView = { 
/**
 * The name of its folder.
 */
name: string, 
/**
 * What its scenario calls itself; empty where that cannot be read.
 */
title: string, about: string, 
/**
 * When one of its files was changed last, in milliseconds since 1970, where that is known.
 */
changed_ms: number | null, };

export type AsideView = { 
/**
 * The name under which it is put back.
 */
key: string, 
/**
 * What it is called then.
 */
name: string, };

export type TemplateView = { name: string, about: string, };

export type CardView = { 
/**
 * The text of its plan, right or wrong; nothing where it cannot be read.
 */
home: string | null, residents: Array<string>, 
/**
 * How much is wrong with it.
 */
problems: number, 
/**
 * How many runs it has.
 */
runs: number, 
/**
 * Those that were lived last.
 */
latest: Array<StoredView>, 
/**
 * The one that is being lived in the page.
 */
goes_on: string | null, };

export type NewHome = { "from": "empty" } | { "from": "template", name: string, };

export type MadeView = { name: string, 
/**
 * What was left out or guessed, and what is missing, in sentences.
 */
remarks: Array<string>, };

export type CallHome = { name: string, };

export type PlaybackView = { name: string, scenario: string, home: HomeView, 
/**
 * In the order of [`DayView::lives`].
 */
residents: Array<ResidentView>, 
/**
 * The local date and time of its start.
 */
start: string, zone: string, length_us: number, 
/**
 * What the log calls its sensors: those of the home in the home's order, then those that stand nowhere in it.
 */
sensors: Array<string>, 
/**
 * What sensors say in the log.
 */
values: Array<string>, days: Array<DateView>, 
/**
 * How many rows the log has in each hour of the clock, by day.
 */
hours: Array<Array<number>>, 
/**
 * From when to when the sun is down.
 */
nights: Array<[number, number]>, has_truth: boolean, 
/**
 * The names of activities.
 */
activities: Array<string>, 
/**
 * What each resident did: begin, end and the activity's number. Of a long run the short ones are left out.
 */
spans: Array<Array<[number, number, number]>>, 
/**
 * Of a log that was walked back: then the rows are those of the log as it was given, and instead of the truth there is
 * what was made of them.
 */
walk: WalkView | null, 
/**
 * Whether its cameras have kept silhouettes.
 */
has_silhouettes: boolean, 
/**
 * What is missing or was skipped, in sentences.
 */
remarks: Array<string>, 
/**
 * Up to when the log is read by now; what else is told of it here, its sensors, values and hours, is as far. `None` once all is read.
 */
read_us: number | null, };

export type LanesView = { bucket_us: number, 
/**
 * By sensor, from the run's start on.
 */
counts: Array<Array<number>>, };

export type ReadingView = { 
/**
 * `None` once all of it is.
 */
read_us: number | null, };

export type FilmView = { 
/**
 * Up to here all is told; where that is not the end that was asked for, the rest is asked for next.
 */
until_us: number, 
/**
 * The corner from which the cubes of voxel persons are counted.
 */
corner: [number, number], 
/**
 * The side of a cube.
 */
edge_m: number, 
/**
 * In the order of time.
 */
moments: Array<MomentView>, };

export type MomentView = { at_us: number, pictures: Array<PictureView>, 
/**
 * Who is told by them, one in each room at most.
 */
persons: Array<PersonView>, };

export type PictureView = { 
/**
 * The camera's number among the home's sensors.
 */
sensor: number, 
/**
 * As of a camera in the run that is being lived.
 */
packed: Uint8Array, };

export type PersonView = { 
/**
 * The cubes at the surface of what two cameras or more agree on: three numbers each, counted from the corner to the east, to the
 * north and up. None where one camera alone tells of somebody.
 */
cubes: Array<number>, 
/**
 * How high the top is above the floor.
 */
height_m: number, 
/**
 * How high the middle is.
 */
centroid_up_m: number, 
/**
 * The angle of the longest extent to the vertical.
 */
tilt_deg: number, 
/**
 * Where, seen from above.
 */
at: [number, number], 
/**
 * How far somebody is on the feet, from 0 to 1.
 */
upright: number, in_between: number, on_the_ground: number, };

export type CareView = { 
/**
 * What the run is called.
 */
name: string, 
/**
 * Whom it is about.
 */
person: string, 
/**
 * The day that is told of, as `2009-03-02`.
 */
day: string | null, 
/**
 * Whether enough days lie before the last two weeks to say what has changed.
 */
is_compared: boolean, 
/**
 * What cannot be said.
 */
remarks: Array<string>, 
/**
 * Who walks when it is played back.
 */
walks: WalksView, 
/**
 * All days in order.
 */
days: Array<CareDayView>, 
/**
 * About the last two weeks, what has changed first.
 */
sentences: Array<CareSentenceView>, 
/**
 * The latest first.
 */
alerts: Array<AlertView>, charts: Array<ChartView>, };

export type WalksView = "lived" | "walked_back" | "sensors" | "no_home";

export type CareDayView = { day: string, known: KnownView, 
/**
 * Nothing of a day that is not whole.
 */
told: Array<TodayView>, };

export type KnownView = "whole" | "nobody_home" | "partly";

export type TodayView = { measure: string, words: string, 
/**
 * More than usual, or less; null as usual.
 */
is_more: boolean | null, };

export type CareSentenceView = { words: string, 
/**
 * On how many days, and what it comes to.
 */
numbers: string, measure: string, is_change: boolean, days: Array<string>, };

export type AlertView = { day: string, rule: string, words: string, 
/**
 * What it came to, and what was usual.
 */
numbers: string, 
/**
 * The measures that it is about.
 */
measures: Array<string>, 
/**
 * The days that show it.
 */
days: Array<string>, };

export type ChartView = { measure: string, title: string, unit: CareUnit, 
/**
 * What is less than this apart is the same.
 */
little: number, is_guess: boolean, days: Array<PointView>, };

export type CareUnit = "hours" | "clock" | "times" | "of_usual" | "metres_a_second";

export type PointView = { day: string, value: number | null, 
/**
 * From where to where it was usual.
 */
usual: [number, number] | null, };

export type NoteView = { 
/**
 * As `2009-03-02`.
 */
day: string, 
/**
 * The alert's rule; empty for the day itself.
 */
rule: string, 
/**
 * Whether somebody has seen to it.
 */
seen: boolean, note: string, };

export type NoteIt = { 
/**
 * What the page has seen there before; null where nothing was noted.
 */
before: NoteView | null, 
/**
 * With no note, and seen to by nobody, nothing is kept of it.
 */
note: NoteView, };

export type KeptLogView = { 
/**
 * The name of its folder.
 */
name: string, 
/**
 * The name of its file.
 */
log: string, };

export type WalkView = { 
/**
 * What the log was called.
 */
log: string, 
/**
 * Where each resident most likely was: begin, end and the place's number, as chances have it. Short stays are left out.
 */
stays: Array<Array<[number, number, number]>>, };

export type DateView = { 
/**
 * Such as `2009-03-02`.
 */
date: string, begin_us: number, end_us: number, 
/**
 * The time on the clock when the day begins in the run: its first one may begin at noon.
 */
clock_us: number, 
/**
 * When clocks are set in it, and by how much.
 */
turn: [number, number] | null, };

export type DayView = { 
/**
 * The log's rows: instant, sensor and value.
 */
rows: Array<[number, number, number]>, 
/**
 * By resident; of none where there is no truth.
 */
lives: Array<LifeView>, 
/**
 * Up to here movements are told; where that is not the day's end, the rest is asked for next.
 */
until_us: number, };

export type LifeView = { 
/**
 * Begin, end, what it was, in which posture, from where, to where.
 */
movements: Array<[number, number, MotionState, Posture, [number, number] | null, [number, number] | null]>, 
/**
 * Begin, end and the number of the home's room; between rooms there is none.
 */
rooms: Array<[number, number, number]>, 
/**
 * Begin, end and the activity's number.
 */
activities: Array<[number, number, number]>, 
/**
 * Of a log that was walked back: an instant, a place, and how likely somebody is there from then on. The place is the
 * number of the home's room, -1 for out, -2 for between the rooms; those that are not told of have no chance.
 */
chances: Array<[number, number, number]>, };

export type Find = { what: FindWhat, 
/**
 * Which room, sensor or activity; of lost messages a sensor, of alerts and falls that cameras see a rule, or null for all.
 */
name: string | null, 
/**
 * Between which minutes of the day, over midnight where the first is later; null at any time.
 */
between_min: [number, number] | null, 
/**
 * For how many seconds at least.
 */
least_s: number, };

export type FindWhat = "room" | "on" | "still" | "doing" | "fall" | "seen_fall" | "lost" | "alert";

export type FoundView = { 
/**
 * In the order of time; of too many the first.
 */
hits: Array<HitView>, 
/**
 * How many there are.
 */
all: number, 
/**
 * How it was looked for, where that is not what one would think.
 */
remarks: Array<string>, };

export type HitView = { begin_us: number, end_us: number, 
/**
 * Whether the truth tells of it as a fall.
 */
is_fall: boolean, 
/**
 * Whose it was, and what, as far as it is known.
 */
words: string, };

export type WalkingView = { 
/**
 * What it is called.
 */
log: string, state: WalkState, 
/**
 * How much of it is done, from 0 to 1.
 */
share: number, 
/**
 * The run that came of it.
 */
run: string | null, 
/**
 * Why none came of it.
 */
problem: string | null, 
/**
 * The stable code of the problem.
 */
problem_code?: string, };

export type WalkState = "coming" | "walking" | "done" | "failed" | "stopped";

export type MotionState = "stride" | "in_place" | "rest" | "away";

export type Say = { "say": "hello", token: string, } | { "say": "play" } | { "say": "pause" } | { "say": "step", seconds: number, } | { "say": "speed", times: number | null, } | { "say": "jump", to_us: number, } | { "say": "hold", keys: Array<Key>, } | { "say": "be", posture: Posture, } | { "say": "use", thing: number, on: boolean, } | { "say": "start", driven: number | null, 
/**
 * Seed of all random numbers (default: that of the scenario)
 */
seed: number | null, 
/**
 * Leave out a condition of the routine; repeatable
 *
 * Homebody uses the same random numbers with and without the condition, except where the condition has an effect.
 */
without: Array<string>, } | { "say": "stop" } | { "say": "replay", run: string, };

export type Key = "up" | "down" | "left" | "right" | "fast" | "slow";

export type Tell = { "tell": "run", run: RunView, } | { "tell": "note", text: string, bad: boolean, code?: string, } | { "tell": "unbegun", why: string, problems: Array<ProblemView>, code?: string, };

export type RefusedView = { 
/**
 * The stable code, such as `page::no-run`.
 */
code?: string, 
/**
 * The message, as sentences.
 */
what: string, 
/**
 * The values that the message quotes, by name.
 */
data: Record<string, unknown>, };

export type FilesView = { 
/**
 * The scenario's own file; those that follow are the ones that it links, as far as it can be read.
 */
entry: string, home: string | null, logger: string | null, lives: Array<LivesView>, files: Array<FileView>, };

export type UnderlayView = { 
/**
 * The name of the picture's file beside it.
 */
picture: string, 
/**
 * Where its middle is, in metres.
 */
at: [number, number], width_m: number, 
/**
 * Against the clock.
 */
turn_deg: number, };

export type LivesView = { name: string, 
/**
 * The name of the routine's file.
 */
routine: string, };

export type FileView = { name: string, text: string, 
/**
 * A sign of what is on disk: another text has another version.
 */
version: string, };

export type Draft = { texts: { [key in string]: string }, };

export type Save = { files: Array<SaveFile>, };

export type SaveFile = { name: string, text: string, 
/**
 * The version that the text was made from; nothing for a file that is not there yet.
 */
version: string | null, };

export type SavedView = { 
/**
 * The new versions by name; empty where nothing was written.
 */
saved: { [key in string]: string }, 
/**
 * What is on disk where it is not what the texts were made from.
 */
changed: Array<FileView>, };

export type CheckView = { problems: Array<ProblemView>, warnings: Array<ProblemView>, };

export type Named = "room" | "door" | "furniture" | "place" | "sensor" | "resident";

export type Rename = { draft: Draft, kind: Named, from: string, to: string, };

export type Forget = { draft: Draft, kind: Named, names: Array<string>, };

export type NamesView = { mentions: Array<MentionView>, 
/**
 * The texts that change, as they are then.
 */
texts: { [key in string]: string }, 
/**
 * Whether another thing of its kind has one of both names: then nothing else is renamed.
 */
is_shared: boolean, };

export type MentionView = { file: string, 
/**
 * From 1.
 */
line: number, 
/**
 * The line, cut where it is long.
 */
said: string, 
/**
 * Whether it goes with the thing in `texts`; what does not is left to whoever writes the file.
 */
goes: boolean, };

export type MendView = { 
/**
 * What is done, as a button says it.
 */
what: string, 
/**
 * The texts that change, as they are then.
 */
texts: { [key in string]: string }, };

export type ProblemView = { 
/**
 * The stable code, such as `home::rooms-overlap`.
 */
code?: string, file: string, 
/**
 * From 1; 0 where the file as a whole is meant.
 */
line: number, 
/**
 * In characters, from 1; 0 where the file as a whole is meant.
 */
column: number, 
/**
 * How many characters are meant.
 */
width: number, what: string, hint: string | null, 
/**
 * The change that solves it, where there is one.
 */
fix?: FixView, };

export type FixView = { "kind": "replace", with: string, } | { "kind": "let_enter", furniture: string, } | { "kind": "add", piece: Record<string, unknown>, room: string | null, 
/**
 * The hint without the words for this change.
 */
rest: string, };

export type PlanView = { 
/**
 * Of the home's file alone.
 */
problems: Array<ProblemView>, 
/**
 * Nothing where there are problems.
 */
home: HomeView | null, coverage: CoverageView | null, };

export type CoverageView = { 
/**
 * The side of a cell.
 */
step_m: number, 
/**
 * The south-west corner of the first cell.
 */
corner: [number, number], columns: number, 
/**
 * Row by row from the south-west, a byte each: 255 where no body can stand, else how many sensors see it.
 */
cells: Uint8Array, whole: FloorView, rooms: Array<FloorView>, 
/**
 * Of those that look; in the order of the home's file.
 */
sensors: Array<SeenView>, 
/**
 * Pairs of sensors and the floor that both see, the largest first.
 */
overlaps: Array<[string, string, number]>, 
/**
 * The largest first.
 */
dead_zones: Array<DeadZoneView>, };

export type FloorView = { name: string, floor_m2: number, 
/**
 * Shares that are seen by none, one, two, and three or more.
 */
seen_by: [number, number, number, number], };

export type SeenView = { name: string, seen_m2: number, 
/**
 * The part of it that no other sensor sees.
 */
alone_m2: number, };

export type DeadZoneView = { 
/**
 * From 1, the largest first.
 */
number: number, room: string | null, area_m2: number, middle: [number, number], outline: Array<[number, number]>, holes: Array<Array<[number, number]>>, };

export type ImportView = { 
/**
 * The text of a home's file.
 */
text: string, 
/**
 * What was left out or guessed, in sentences.
 */
remarks: Array<string>, };

export type Explain = { draft: Draft, file: string, };

export type ExplainView = { 
/**
 * Of the routine's file and the conditions it shows; empty does not mean that other files are right.
 */
problems: Array<ProblemView>, 
/**
 * The date of the scenario's first day, and how many days it has; none where it cannot be read.
 */
first: string, days: number, sentences: Array<SentenceView>, 
/**
 * What is left unsaid and goes as it usually does.
 */
unsaid: Array<SentenceView>, conditions: Array<ConditionView>, 
/**
 * What may be written, for completion.
 */
words: Array<WordView>, };

export type SentenceView = { 
/**
 * From 1.
 */
line: number, 
/**
 * The words it was understood from.
 */
said: string, 
/**
 * `person`, `habit`, `rule` or `change`.
 */
kind: string, what: string, days: string, when: string, 
/**
 * When it begins, in seconds since midnight: one in twenty begins before the first, the mean, one in twenty after the last.
 */
start_s: [number, number, number] | null, 
/**
 * How long it lasts, in the same way.
 */
lasts_s: [number, number, number] | null, in_words: string, };

export type ConditionView = { name: string, 
/**
 * How severe it is on each day of the scenario: 0 where it is not there, 1 at its moderate full strength.
 */
severity: Array<number>, sentences: Array<SentenceView>, };

export type WordView = { 
/**
 * What is written.
 */
text: string, kind: WordKind, 
/**
 * What it says, in a few words.
 */
about: string, };

export type WordKind = "sentence" | "activity" | "time" | "place" | "condition";

export type Month = { draft: Draft, 
/**
 * The first day, counted from 0.
 */
from: number, 
/**
 * At most 31.
 */
days: number, 
/**
 * Conditions that are left out.
 */
without: Array<string>, };

export type MonthView = { 
/**
 * Why there is none.
 */
problems: Array<ProblemView>, days: Array<DateView>, residents: Array<string>, 
/**
 * The names of activities.
 */
activities: Array<string>, 
/**
 * What each resident did: begin, end and the activity's number.
 */
spans: Array<Array<[number, number, number]>>, 
/**
 * The names of rooms.
 */
rooms: Array<string>, 
/**
 * Where each resident was: begin, end and the room's number; away or between rooms there is none.
 */
stays: Array<Array<[number, number, number]>>, 
/**
 * How often motion sensors fired in each hour of the clock, by day.
 */
hours: Array<Array<number>>, 
/**
 * Where and why it ends before the last day, in sentences.
 */
cut: string | null, };

export type RowsView = { problems: Array<ProblemView>, 
/**
 * One for each place that the log goes to.
 */
places: Array<PlaceRowsView>, 
/**
 * Until when rows were looked for and why no longer, in sentences.
 */
cut: string | null, 
/**
 * How the URLs of places begin, and what each is.
 */
kinds: Array<[string, string]>, };

export type PlaceRowsView = { 
/**
 * The URL as the file has it.
 */
to: string, 
/**
 * Of a database.
 */
table: string | null, columns: Array<string>, rows: Array<Array<string>>, };

export type Connect = { url: string, };

export type ConnectView = { works: boolean, 
/**
 * What was found there, or why it does not work and what to do.
 */
said: string, 
/**
 * The stable code of the message, where it does not work.
 */
code?: string, };

export type GrowthView = { 
/**
 * How often motion sensors fired in each hour of the clock, by day.
 */
hours: Array<Array<number>>, 
/**
 * The firings of the day that is being lived: instant and sensor.
 */
today: Array<[number, number]>, 
/**
 * How many firings of that day are not in `today`.
 */
left_out: number, };

export type PartView = { number: number, name: string, kind: string, 
/**
 * Make and model, or the kind where any will do.
 */
device: string, network: string, 
/**
 * Floor, room and place in words.
 */
place: string, 
/**
 * Height, direction and field; null for what has no lens.
 */
aim: string | null, };

export type PartsView = { 
/**
 * Of the home; then there is nothing else.
 */
problems: Array<ProblemView>, 
/**
 * How many of which device, the most first.
 */
devices: Array<[string, number]>, parts: Array<PartView>, 
/**
 * The same as comma-separated values.
 */
csv: string, };

export type Layouts = { one: NamedLayout, other: NamedLayout, };

export type NamedLayout = { name: string, draft: Draft, };

export type LayoutsView = { 
/**
 * Of either home; then there is nothing else.
 */
problems: Array<ProblemView>, layouts: Array<LayoutView>, differences: Array<DiffersView>, };

export type LayoutView = { name: string, devices: Array<[string, number]>, home: HomeView, coverage: CoverageView, };

export type DiffersView = { sensor: string, what: string, };

export type Suggest = { draft: Draft, 
/**
 * How many there may be.
 */
sensors: number, 
/**
 * What is to be seen, as `homebody suggest-sensors` has it.
 */
to_see: Array<string>, 
/**
 * How many people live there, where that is asked for which somebody has to.
 */
people: number, 
/**
 * What motion sensors are to be; null as in Godsey & Skubic 2009.
 */
device: string | null, };

export type SuggestionView = { 
/**
 * Of the home, or of the lives in it; then there is nothing else.
 */
problems: Array<ProblemView>, 
/**
 * Why there is none, in a sentence.
 */
refused: string | null, 
/**
 * The stable code of that message.
 */
code?: string, 
/**
 * The sensors as `home.json` takes them: a list in JSON.
 */
sensors: string, 
/**
 * With one sensor, two, and so on.
 */
steps: Array<StepView>, 
/**
 * All of them, where some went for others in the end.
 */
whole: StepView | null, 
/**
 * The sensors that the home has.
 */
own: StepView | null, };

export type StepView = { 
/**
 * The name of the sensor that came last.
 */
sensor: string, 
/**
 * The mean over all that is to be seen, from 0 to 1.
 */
score: number, reached: Array<ReachedView>, };

export type ReachedView = { goal: string, score: number, value: number, unit: string, };
