// Made from crates/homebody-web/src/wire.rs and what is below it, which say what each means.

export type HomeView = { name: string, 
/**
 * The lower left and the upper right corner of the plan.
 */
bounds: [[number, number], [number, number]], rooms: Array<RoomView>, 
/**
 * Walls, closed doors and furniture, as convex outlines.
 */
solids: Array<SolidView>, doors: Array<DoorView>, 
/**
 * In the order of [`RunFrame::on`].
 */
things: Array<ThingView>, 
/**
 * In the order of the numbers of sensors.
 */
sensors: Array<SensorView>, };

export type RoomView = { name: string, outline: Array<[number, number]>, 
/**
 * The place of its name.
 */
middle: [number, number], 
/**
 * In a home of several floors.
 */
floor: string | null, };

export type SolidView = { kind: SolidKind, name: string | null, outline: Array<[number, number]>, enterable: boolean, };

export type SolidKind = "wall" | "door" | "furniture";

export type DoorView = { name: string, 
/**
 * The jambs; an open door is hinged at the first.
 */
from: [number, number], to: [number, number], open: boolean, outside: boolean, };

export type ThingView = { name: string, kind: ThingKind, at: [number, number], 
/**
 * The verbs that switch it on and off, such as `Turn on` and `Turn off`.
 */
verbs: [string, string], };

export type ThingKind = "door" | "furniture" | "lamp";

export type SensorView = { name: string, 
/**
 * The key of its kind, such as `motion`, `bed` or `contact`.
 */
kind: string, room: string | null, at: [number, number], 
/**
 * Counted from east against the clock; for sensors on walls.
 */
facing_deg: number | null, 
/**
 * The parts of its beams that detect a standing adult; for sensors on walls.
 */
beams: Array<[[number, number], [number, number]]>, 
/**
 * The area of a ceiling sensor, or the mat or bed.
 */
area: Array<[number, number]> | null, camera: CameraView | null, };

export type CameraView = { 
/**
 * Columns and rows of a picture.
 */
pixels: [number, number], 
/**
 * The time between two pictures.
 */
period_us: number, 
/**
 * True for a camera that never sleeps.
 */
always: boolean, 
/**
 * The floor, beds and seats in its view, as rectangles: left, lower, right and upper edge.
 */
seen: Array<[number, number, number, number]>, 
/**
 * The parts of its view that furniture hides, as rectangles.
 */
hidden: Array<[number, number, number, number]>, };

export type RunView = { 
/**
 * The name of its folder, once it has one.
 */
id: string | null, scenario: string, home: HomeView, 
/**
 * Residents first, then visitors and pets.
 */
residents: Array<ResidentView>, 
/**
 * The resident that keys move.
 */
driven: number | null, length_us: number, 
/**
 * Below 2^53.
 */
seed: number, 
/**
 * All conditions of its residents, with those that are left out.
 */
conditions: Array<string>, without: Array<string>, days: Array<DateView>, 
/**
 * The intervals in which the sun is down.
 */
nights: Array<[number, number]>, 
/**
 * The destinations of the log, as URLs.
 */
log: Array<string>, replay: boolean, 
/**
 * The versions of the scenario's files at the start of the run; none for a replay.
 */
files: { [key in string]: string }, };

export type ResidentView = { name: string, radius_m: number, };

export type RunFrame = { now_us: number, 
/**
 * The time on the home's clock, as `2009-03-02 07:12:03`.
 */
clock: string, state: RunState, 
/**
 * In simulated seconds a second; null for as fast as possible.
 */
speed: number | null, 
/**
 * By resident; null for those who are out.
 */
bodies: Array<BodyView | null>, 
/**
 * The sensors that detect movement.
 */
seeing: Array<number>, 
/**
 * The things that are on or open.
 */
on: Array<number>, 
/**
 * The sine of the sun's height: below 0 it is dark.
 */
sun: number, 
/**
 * The number of rows of the log so far.
 */
told: number, 
/**
 * The same by sensor.
 */
counts: Array<number>, 
/**
 * The latest rows since the frame before, in order.
 */
firings: Array<FiringView>, 
/**
 * In the order of sensors.
 */
looks: Array<CameraStateView>, };

export type RunState = "paused" | "playing" | "over";

export type BodyView = { at: [number, number], 
/**
 * Counted from east against the clock.
 */
heading_deg: number, posture: MapPosture, room: number | null, 
/**
 * The label of the ground truth.
 */
activity: string | null, };

export type MapPosture = "standing" | "sitting" | "lying";

export type FiringView = { seq: number, at_us: number, sensor: number, value: string, 
/**
 * Time, sensor and message as they are stored; null without a log.
 */
row: [string, string, string] | null, };

export type CameraStateView = { 
/**
 * Its number among the home's sensors.
 */
sensor: number, awake: boolean, 
/**
 * Its packed silhouette: lengths of runs of pixels that are off and on in turns; empty without a body.
 */
packed: Uint8Array, };

export type StoredView = { 
/**
 * The name of its folder.
 */
name: string, scenario: string, 
/**
 * Local date and time.
 */
start: string, days: number, has_truth: boolean, 
/**
 * The name of the log that was located for its path.
 */
walked_back: string | null, 
/**
 * The reason why playback is not possible.
 */
problem: string | null, problem_code?: string, 
/**
 * The time when its files were created, in milliseconds since 1970.
 */
made_ms: number | null, 
/**
 * Below 2^53.
 */
seed: number | null, without: Array<string>, about: RunAbout, };

export type RunAbout = { 
/**
 * At most 100 characters; empty for a run without a title.
 */
title: string, 
/**
 * At most 2,000 characters.
 */
note: string, };

export type DeletedKey = { key: string, };

export type LibraryView = { 
/**
 * Its path on the server's machine.
 */
folder: string, 
/**
 * The reason why homes cannot be changed.
 */
trouble: string | null, 
/**
 * The latest change first.
 */
homes: Array<HomeEntryView>, 
/**
 * The number of homes that are not listed.
 */
more: number, aside: Array<DeletedHome>, templates: Array<TemplateView>, 
/**
 * The number of runs next to the homes, which belong to none.
 */
runs_beside: number, };

export type HomeEntryView = { 
/**
 * The name of its folder.
 */
name: string, 
/**
 * The name in its scenario; empty if that cannot be read.
 */
title: string, about: string, 
/**
 * The last change of one of its files, in milliseconds since 1970.
 */
changed_ms: number | null, };

export type DeletedHome = { 
/**
 * The key by which it is restored.
 */
key: string, name: string, };

export type TemplateView = { name: string, about: string, };

export type CardView = { 
/**
 * The text of its plan, valid or not.
 */
home: string | null, residents: Array<string>, problems: number, runs: number, latest: Array<StoredView>, 
/**
 * The run that is being recorded.
 */
goes_on: string | null, };

export type NewHome = { "from": "empty" } | { "from": "template", name: string, };

export type MadeView = { name: string, 
/**
 * Omissions, guesses and missing parts, in sentences.
 */
remarks: Array<string>, };

export type CallHome = { name: string, };

export type PlaybackView = { name: string, scenario: string, home: HomeView, 
/**
 * In the order of [`DayView::lives`].
 */
residents: Array<ResidentView>, 
/**
 * Local date and time.
 */
start: string, zone: string, length_us: number, 
/**
 * The sensors of the log: those of the home in its order, then those without a place in it.
 */
sensors: Array<string>, 
/**
 * The messages of the sensors.
 */
values: Array<string>, days: Array<DateView>, 
/**
 * The number of rows in each hour of the clock, by day.
 */
hours: Array<Array<number>>, 
/**
 * The intervals in which the sun is down.
 */
nights: Array<[number, number]>, has_truth: boolean, activities: Array<string>, 
/**
 * For each resident begin, end and number of each activity. A long run has only the longest.
 */
spans: Array<Array<[number, number, number]>>, 
/**
 * For a located log: the rows are those of the original log, and the estimates replace the ground truth.
 */
walk: LocatedView | null, has_silhouettes: boolean, 
/**
 * Missing or skipped data, in sentences.
 */
remarks: Array<string>, 
/**
 * The end of the part that is read so far, with its sensors, values and hours; null once all is read.
 */
read_us: number | null, };

export type LanesView = { bucket_us: number, 
/**
 * By sensor, from the start of the run.
 */
counts: Array<Array<number>>, };

export type ReadingView = { 
/**
 * Null once all is read.
 */
read_us: number | null, };

export type SilhouettesView = { 
/**
 * The end of the silhouettes here; if it is before the requested end, the page requests the rest.
 */
until_us: number, 
/**
 * The origin of the cubes.
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
 * One in each room at most.
 */
persons: Array<PersonView>, };

export type PictureView = { 
/**
 * The camera's number among the home's sensors.
 */
sensor: number, 
/**
 * As in [`CameraStateView`].
 */
packed: Uint8Array, };

export type PersonView = { 
/**
 * The surface cubes of the body that two cameras or more agree on: three numbers each, from the corner to the east, to the north
 * and up. Empty if only one camera sees the person.
 */
cubes: Array<number>, 
/**
 * Of the top above the floor.
 */
height_m: number, centroid_up_m: number, 
/**
 * The angle of the longest extent to the vertical.
 */
tilt_deg: number, 
/**
 * Seen from above.
 */
at: [number, number], 
/**
 * Membership from 0 to 1.
 */
upright: number, in_between: number, on_the_ground: number, };

export type CareView = { 
/**
 * The name of the run.
 */
name: string, person: string, 
/**
 * The last day that counts, as `2009-03-02`.
 */
day: string | null, headline: Headline, 
/**
 * The reference days; null before the first day that counts.
 */
reference: ReferenceDays | null, remarks: Array<string>, 
/**
 * Sensors that are silent, in sentences.
 */
silent: Array<string>, 
/**
 * The content of its playback.
 */
walks: PlaybackContent, 
/**
 * In order.
 */
days: Array<CareDay>, 
/**
 * Days on which the home was empty for most of the day.
 */
absences: Array<DaysAway>, 
/**
 * About the last two weeks.
 */
sentences: Array<CareSentenceView>, 
/**
 * The latest first.
 */
episodes: Array<ChangeEpisode>, charts: Array<MeasureChart>, };

export type PlaybackContent = "lived" | "walked_back" | "sensors" | "no_home";

export type CareDay = { day: string, known: DayKnowledge, 
/**
 * The measures; none on a day that does not count.
 */
told: Array<MeasureWords>, };

export type DayKnowledge = "whole" | "nobody_home" | "partly";

export type MeasureWords = { measure: string, 
/**
 * In words, such as `Slept for 7.2 hours, as usual`.
 */
words: string, beside: BesideUsual, };

export type CareSentenceView = { words: string, 
/**
 * The number of days, and the result.
 */
numbers: string, measure: string, days: Array<string>, };

export type BesideUsual = "more" | "less" | "as_usual" | "not_known";

export type MeasureGroup = "night" | "bathroom" | "meals" | "out" | "moving" | "rhythm";

export type Headline = { state: HeadlineState, 
/**
 * A sentence, without a full stop.
 */
words: string, };

export type HeadlineState = "look_today" | "changed" | "not_known" | "as_usual";

export type ReferenceDays = { from: string, to: string, 
/**
 * The number of days that count.
 */
days: number, 
/**
 * Somebody chose its first day. Otherwise it is the first of the log.
 */
is_marked: boolean, };

export type DaysAway = { from: string, to: string, };

export type ChangeEpisode = { 
/**
 * The estimated first day.
 */
since: string, 
/**
 * The day after whose end it was found.
 */
found: string, 
/**
 * The days after whose end it was known to have become worse.
 */
worse: string[], 
/**
 * The first day that was as usual again; `None` while it lasts.
 */
over: string | null, course: Course, 
/**
 * The strongest first.
 */
signs: Array<Sign>, 
/**
 * Conditions that make such signs in simulated people, the likeliest first.
 */
seen_with: Array<SeenWith>, 
/**
 * The signs in a sentence, without a full stop.
 */
words: string, };

export type Course = "growing" | "steady" | "easing" | "over";

export type Sign = { measure: string, is_more: boolean, 
/**
 * The mean of the last week of the episode.
 */
value: number, 
/**
 * The usual value of the same days.
 */
usual: number, 
/**
 * The mean distance of all days of the episode, in standard deviations of a day.
 */
shift_sd: number, 
/**
 * The days that show it.
 */
shown_by: string[], 
/**
 * The difference in words, such as `getting up 47 min later`.
 */
words: string, 
/**
 * The value and the usual one, such as `at 07:34 on average, usually 06:46`.
 */
numbers: string, };

export type SeenWith = { condition: string, likelihood_ratio: number, };

export type MeasureChart = { measure: string, title: string, group: MeasureGroup, unit: ValueForm, 
/**
 * Smaller differences do not count.
 */
little: number, 
/**
 * The measure is a guess.
 */
is_guess: boolean, days: Array<ChartPoint>, };

export type ValueForm = "hours" | "clock" | "times" | "of_usual" | "metres_a_second" | "amount";

export type ChartPoint = { day: string, 
/**
 * The measure; `None` where it is unknown, or the day does not count.
 */
value: number | null, 
/**
 * The usual range on that day.
 */
usual: [number, number] | null, };

export type NoteView = { 
/**
 * As `2009-03-02`: the day, or that on which the episode was found.
 */
day: string, about: NoteSubject, 
/**
 * True once a person has dealt with it.
 */
seen: boolean, note: string, 
/**
 * The name of the person who has written it; empty if none is given.
 */
who: string, 
/**
 * The time at which it was stored, as `2009-03-02T14:05`, by the clock of the server; empty in a new note.
 */
at: string, };

export type NoteSubject = "day" | "episode" | "reference";

export type NoteChange = { 
/**
 * The note that the page has read; null if there was none.
 */
before: NoteView | null, 
/**
 * An empty note that is not marked as seen is removed.
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

export type LocatedView = { 
/**
 * The name of the log.
 */
log: string, 
/**
 * The most likely place of each resident: begin, end and number as in chances, without short stays.
 */
stays: Array<Array<[number, number, number]>>, };

export type DateView = { 
/**
 * Such as `2009-03-02`.
 */
date: string, begin_us: number, end_us: number, 
/**
 * The time on the clock at `begin_us`: the first day may begin at noon.
 */
clock_us: number, 
/**
 * The instant at which clocks are set, and by how much.
 */
turn: [number, number] | null, };

export type DayView = { 
/**
 * Instant, sensor and value of each row of the log.
 */
rows: Array<[number, number, number]>, 
/**
 * By resident; empty without ground truth.
 */
lives: Array<PersonDay>, 
/**
 * The end of the movements here; if it is before the end of the day, the page requests the rest.
 */
until_us: number, };

export type PersonDay = { 
/**
 * Begin, end, kind, posture, from, to.
 */
movements: Array<[number, number, MovementKind, MapPosture, [number, number] | null, [number, number] | null]>, 
/**
 * Begin, end and number of the home's room; nothing between rooms.
 */
rooms: Array<[number, number, number]>, 
/**
 * Begin, end and number of the activity.
 */
activities: Array<[number, number, number]>, 
/**
 * For a located log: instant, place and probability of a person there from then on. The place is the number of the home's room,
 * -1 for out, -2 for between the rooms; places that are not listed have none.
 */
chances: Array<[number, number, number]>, };

export type Find = { what: SearchSubject, 
/**
 * The room, sensor or activity; for lost messages the sensor, for alerts and falls that cameras see the rule; null for all.
 */
name: string | null, 
/**
 * Minutes of the day, over midnight if the first is later; null for any time.
 */
between_min: [number, number] | null, 
/**
 * The shortest duration, in seconds.
 */
least_s: number, };

export type SearchSubject = "room" | "on" | "still" | "doing" | "fall" | "seen_fall" | "lost" | "alert";

export type FoundView = { 
/**
 * The first in the order of time.
 */
hits: Array<HitView>, 
/**
 * The total.
 */
all: number, 
/**
 * Unusual conditions of the search.
 */
remarks: Array<string>, };

export type HitView = { begin_us: number, end_us: number, 
/**
 * True for a fall of the ground truth.
 */
is_fall: boolean, 
/**
 * The person and the match, if known.
 */
words: string, };

export type LocatingView = { log: string, state: LocatingState, 
/**
 * The completed share, from 0 to 1.
 */
share: number, 
/**
 * The resulting run.
 */
run: string | null, 
/**
 * The reason of a failure.
 */
problem: string | null, problem_code?: string, };

export type LocatingState = "coming" | "walking" | "done" | "failed" | "stopped";

export type MovementKind = "stride" | "in_place" | "rest" | "away";

export type PageCommand = { "say": "hello", token: string, } | { "say": "play" } | { "say": "pause" } | { "say": "step", seconds: number, } | { "say": "speed", times: number | null, } | { "say": "jump", to_us: number, } | { "say": "hold", keys: Array<Key>, } | { "say": "be", posture: MapPosture, } | { "say": "use", thing: number, on: boolean, } | { "say": "start", driven: number | null, options: Partial<RunOptions>, } | { "say": "stop" } | { "say": "replay", run: string, };

export type RunOptions = { 
/**
 * Duration of the run: 90s, 15m, 2h, 7d or 52w (default: that of the scenario)
 *
 * Days and weeks follow the calendar: a run of 7d ends at the hour at which it started, even if clocks change in between.
 */
days: number | null, 
/**
 * Start of the run in the home's local time: now, today, 2026-11-01 or 2026-11-01T08:00 (default: the start in the scenario)
 */
start: string | null, 
/**
 * Set a parameter of the models; repeatable
 *
 * `homebody parameters` lists all parameters with units and ranges. The recording stores the values.
 */
numbers: Record<string, number>, 
/**
 * Let the residents differ from their routines as people differ, each seed in its own way
 */
one_of_many: boolean, 
/**
 * Seed of all random numbers (default: that of the scenario)
 */
seed: number | null, 
/**
 * Leave out a condition of the routine; repeatable
 *
 * Homebody uses the same random numbers with and without the condition, except where the condition has an effect.
 */
without: Array<string>, };

export type Key = "up" | "down" | "left" | "right" | "fast" | "slow";

export type RunNotice = { "tell": "run", run: RunView, } | { "tell": "note", text: string, bad: boolean, code?: string, } | { "tell": "unbegun", why: string, problems: Array<ProblemView>, 
/**
 * The name of the option.
 */
option?: string, code?: string, };

export type RefusedView = { 
/**
 * The stable code, such as `page::no-run`.
 */
code?: string, 
/**
 * In sentences.
 */
what: string, 
/**
 * The values in the message, by name.
 */
data: Record<string, unknown>, };

export type FilesView = { 
/**
 * The scenario's own file. It names the home, the logger and the routines below.
 */
entry: string, home: string | null, logger: string | null, lives: Array<ResidentRoutineView>, files: Array<FileView>, };

export type UnderlayView = { 
/**
 * The name of the image's file in the same folder.
 */
picture: string, 
/**
 * Its middle, in metres.
 */
at: [number, number], width_m: number, 
/**
 * Against the clock.
 */
turn_deg: number, };

export type ResidentRoutineView = { name: string, 
/**
 * The name of its file.
 */
routine: string, };

export type FileView = { name: string, text: string, 
/**
 * A digest of the text.
 */
version: string, };

export type Draft = { texts: { [key in string]: string }, };

export type Save = { files: Array<SaveFile>, };

export type SaveFile = { name: string, text: string, 
/**
 * The version that the draft is based on; null for a new file.
 */
version: string | null, };

export type SavedView = { 
/**
 * The new versions by name; empty if nothing was saved.
 */
saved: { [key in string]: string }, 
/**
 * The files that other programs or pages have changed.
 */
changed: Array<FileView>, };

export type CheckView = { problems: Array<ProblemView>, warnings: Array<ProblemView>, };

export type Named = "room" | "door" | "furniture" | "place" | "sensor" | "resident";

export type Rename = { draft: Draft, kind: Named, from: string, to: string, };

export type Forget = { draft: Draft, kind: Named, names: Array<string>, };

export type NamesView = { mentions: Array<MentionView>, 
/**
 * The changed texts.
 */
texts: { [key in string]: string }, 
/**
 * True if another thing of its kind has the old or the new name. Then nothing is renamed.
 */
is_shared: boolean, };

export type MentionView = { file: string, 
/**
 * From 1.
 */
line: number, 
/**
 * The line, shortened.
 */
said: string, 
/**
 * True if `texts` removes it; the author of the file removes the others.
 */
goes: boolean, };

export type MendView = { 
/**
 * The label of the button.
 */
what: string, 
/**
 * The changed texts.
 */
texts: { [key in string]: string }, };

export type ProblemView = { 
/**
 * The stable code, such as `home::rooms-overlap`.
 */
code?: string, file: string, 
/**
 * From 1; 0 for the whole file.
 */
line: number, 
/**
 * In characters, from 1; 0 for the whole file.
 */
column: number, 
/**
 * In characters.
 */
width: number, what: string, hint: string | null, fix?: FixView, };

export type FixView = { "kind": "replace", with: string, } | { "kind": "let_enter", furniture: string, } | { "kind": "add", piece: Record<string, unknown>, room: string | null, 
/**
 * The hint without the words for this change.
 */
rest: string, };

export type PlanView = { 
/**
 * Of the home's file only.
 */
problems: Array<ProblemView>, home: HomeView | null, coverage: CoverageView | null, };

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
 * Row by row from the south-west, a byte each: 255 without room for a body, else the number of sensors.
 */
cells: Uint8Array, whole: FloorView, rooms: Array<FloorView>, 
/**
 * The sensors with a field, in the order of the home's file.
 */
sensors: Array<SensorCoverage>, 
/**
 * Pairs of sensors and their common floor, the largest first.
 */
overlaps: Array<[string, string, number]>, 
/**
 * The largest first.
 */
dead_zones: Array<DeadZoneView>, };

export type FloorView = { name: string, floor_m2: number, 
/**
 * The shares with no, one, two, and three or more sensors.
 */
seen_by: [number, number, number, number], };

export type SensorCoverage = { name: string, 
/**
 * The floor that it sees, in square metres.
 */
seen_m2: number, 
/**
 * The part of `seen_m2` that no other sensor sees.
 */
alone_m2: number, };

export type DeadZoneView = { 
/**
 * From 1, the largest first.
 */
number: number, room: string | null, area_m2: number, middle: [number, number], outline: Array<[number, number]>, holes: Array<Array<[number, number]>>, };

export type ImportView = { 
/**
 * As a home's file.
 */
text: string, 
/**
 * Omissions and guesses, in sentences.
 */
remarks: Array<string>, };

export type Explain = { draft: Draft, file: string, };

export type ExplainView = { 
/**
 * Of the routine's file and its conditions only.
 */
problems: Array<ProblemView>, 
/**
 * The date of the scenario's first day, and the number of its days; empty for an invalid scenario.
 */
first: string, days: number, 
/**
 * Whether the text is in another language than English, which forms write.
 */
is_foreign: boolean, sentences: Array<SentenceView>, 
/**
 * The defaults for what the routine does not say.
 */
unsaid: Array<SentenceView>, conditions: Array<ConditionView>, words: Array<Completion>, };

export type SentenceView = { 
/**
 * From 1.
 */
line: number, 
/**
 * The words of the routine.
 */
said: string, 
/**
 * `person`, `habit`, `rule` or `change`.
 */
kind: string, what: string, days: string, when: string, 
/**
 * The begin in seconds since midnight: the 5th percentile, the mean, the 95th percentile.
 */
start_s: [number, number, number] | null, 
/**
 * The duration in seconds: the same three.
 */
lasts_s: [number, number, number] | null, in_words: string, };

export type ConditionView = { name: string, 
/**
 * For each day of the scenario, from 0 without the condition to 1 at moderate strength.
 */
severity: Array<number>, sentences: Array<SentenceView>, };

export type StatementsView = { 
/**
 * Of other files; a routine with problems has the statements that are understood.
 */
problems: Array<ProblemView>, statements: Array<StatementView>, };

export type StatementView = { 
/**
 * Of its sentences. A person may have several, and several statements may have the same one.
 */
places: Array<SentencePlace>, statement: Record<string, unknown>, 
/**
 * As they would be written, without the other statements of the same sentence.
 */
sentences: Array<string>, };

export type SentencePlace = { 
/**
 * From 1.
 */
line: number, 
/**
 * In characters, from 1.
 */
column: number, 
/**
 * In characters.
 */
length: number, };

export type WriteStatement = { draft: Draft, file: string, statement: Record<string, unknown>, 
/**
 * The statement that it replaces; null for a new one.
 */
instead: ReplacedStatement | null, 
/**
 * The line, from 1, after which a new sentence stands.
 */
line: number, };

export type ReplacedStatement = { 
/**
 * In its routine, from 0.
 */
number: number, statement: Record<string, unknown>, };

export type WrittenStatementView = { 
/**
 * As they are written, without the other statements of the same sentence.
 */
sentences: Array<string>, 
/**
 * The interpretation of the sentences in their routine.
 */
meaning: Array<SentenceView>, 
/**
 * The faults of the fields, all of them. Values that no sentence says are among them.
 */
faults: Array<FieldFaultView>, 
/**
 * Problems that the sentences cause, in the words of the program.
 */
problems: Array<ProblemView>, 
/**
 * Warnings about the sentences.
 */
warnings: Array<ProblemView>, 
/**
 * In the order of the text; empty if the sentences cannot be written.
 */
edits: Array<TextEditView>, };

export type FieldFaultView = { 
/**
 * The JSON pointer of the field, such as `/when/lasts_s`; empty for the whole statement.
 */
field: string, what: string, hint: string | null, };

export type TextEditView = { line: number, column: number, to_line: number, to_column: number, insert: string, };

export type FreeTextRequest = { draft: Draft, 
/**
 * The routine of the resident.
 */
file: string, text: string, by: Answerer, };

export type Answerer = { "kind": "model", 
/**
 * Null for a server on the machine of Homebody.
 */
url: string | null, 
/**
 * The name of the model; null for the only one of the server.
 */
name: string | null, 
/**
 * It goes to the address of `url` only, and is not stored.
 */
key: string | null, } | { "kind": "assistant", answers: Array<string>, };

export type FreeTextView = { 
/**
 * Each text has another.
 */
number: number, 
/**
 * The routine of the resident.
 */
file: string, state: FreeTextState, 
/**
 * The round that is at work, from 1.
 */
round: number, 
/**
 * The model and its address, without a key.
 */
model: string | null, 
/**
 * A warning that others can read the key on its way, in sentences.
 */
warning: string | null, rounds: Array<RoundView>, 
/**
 * The next prompt for an assistant; null if nothing more is to be asked.
 */
prompt: string | null, 
/**
 * The lines of the best round; empty before the first.
 */
lines: Array<DraftLineView>, 
/**
 * Sentences of the text that the answer leaves out.
 */
left_out: Array<string>, 
/**
 * The reason why a run with all statements stops.
 */
run_stops: string | null, 
/**
 * The reason of a failure, in sentences.
 */
problem: string | null, problem_code?: string, };

export type FreeTextState = "beginning" | "asking" | "checking" | "done" | "failed" | "stopped";

export type RoundView = { problems: Array<string>, 
/**
 * Differences between statements and their simulation.
 */
differences: Array<string>, };

export type DraftLineView = { source: string, is_in_text: boolean, statements: Array<DraftStatementView>, assumed: Array<string>, cannot_be_said: Array<string>, };

export type DraftStatementView = { 
/**
 * The sentence of the model.
 */
text: string, 
/**
 * The reason why it is refused.
 */
refused: string | null, 
/**
 * Its meaning, as canonical sentences with their numbers.
 */
sentences: Array<SentenceView>, 
/**
 * The expectation and the result of a simulation that differs.
 */
difference: [string, string] | null, };

export type AcceptLines = { 
/**
 * The text that the person has seen.
 */
number: number, 
/**
 * By line.
 */
accepted: Array<boolean>, };

export type AcceptedView = { text: string, 
/**
 * Statements that need one that was not accepted; they are comments in the text.
 */
lost: Array<string>, };

export type Completion = { text: string, kind: CompletionKind, about: string, };

export type CompletionKind = "sentence" | "activity" | "time" | "place" | "condition";

export type Month = { draft: Draft, 
/**
 * The first day, from 0.
 */
from: number, 
/**
 * At most 31.
 */
days: number, 
/**
 * Conditions to leave out.
 */
without: Array<string>, };

export type MonthView = { problems: Array<ProblemView>, days: Array<DateView>, residents: Array<string>, activities: Array<string>, 
/**
 * For each resident begin, end and number of each activity.
 */
spans: Array<Array<[number, number, number]>>, rooms: Array<string>, 
/**
 * For each resident begin, end and number of each stay in a room.
 */
stays: Array<Array<[number, number, number]>>, 
/**
 * The firings of motion sensors in each hour of the clock, by day.
 */
hours: Array<Array<number>>, 
/**
 * The place and reason of an early end, in sentences.
 */
cut: string | null, };

export type RowsView = { problems: Array<ProblemView>, 
/**
 * By destination of the log.
 */
places: Array<PlaceRowsView>, 
/**
 * The end of the simulation and its reason, in sentences.
 */
cut: string | null, 
/**
 * The schemes of URLs, with descriptions.
 */
kinds: Array<[string, string]>, };

export type PlaceRowsView = { 
/**
 * The URL of the file.
 */
to: string, 
/**
 * For databases.
 */
table: string | null, columns: Array<string>, rows: Array<Array<string>>, };

export type Connect = { url: string, };

export type ConnectView = { works: boolean, 
/**
 * The result, or the reason of a failure with a hint.
 */
said: string, 
/**
 * The stable code of a failure.
 */
code?: string, };

export type LiveCountsView = { 
/**
 * The firings of motion sensors in each hour of the clock, by day.
 */
hours: Array<Array<number>>, 
/**
 * Instant and sensor of each firing of the last day.
 */
today: Array<[number, number]>, 
/**
 * The number of firings of that day that `today` leaves out.
 */
left_out: number, };

export type PartView = { number: number, name: string, kind: string, 
/**
 * Make and model, or the kind if any model will do.
 */
device: string, network: string, 
/**
 * Floor, room and place in words.
 */
place: string, 
/**
 * Height, direction and field; null for a sensor without a lens.
 */
aim: string | null, };

export type PartsView = { 
/**
 * Of the home; then the rest is empty.
 */
problems: Array<ProblemView>, 
/**
 * The number of each device, the largest first.
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
 * Of either home; then the rest is empty.
 */
problems: Array<ProblemView>, layouts: Array<LayoutView>, differences: Array<SensorDifference>, };

export type LayoutView = { name: string, devices: Array<[string, number]>, home: HomeView, coverage: CoverageView, };

export type SensorDifference = { sensor: string, 
/**
 * The differences in the second layout.
 */
what: string, };

export type Suggest = { draft: Draft, 
/**
 * The largest number.
 */
sensors: number, 
/**
 * The goals, as in `homebody suggest-sensors`.
 */
to_see: Array<string>, 
/**
 * The number of people to simulate, for goals that need them.
 */
people: number, 
/**
 * The motion sensor to use; null for that of Godsey & Skubic 2009.
 */
device: string | null, };

export type SuggestionView = { 
/**
 * Of the home or its routines; then the rest is empty.
 */
problems: Array<ProblemView>, 
/**
 * The reason of a refusal, in a sentence.
 */
refused: string | null, code?: string, 
/**
 * The list of sensors for `home.json`.
 */
sensors: string, 
/**
 * With one sensor, two, and so on.
 */
steps: Array<StepView>, 
/**
 * The final layout, if exchanges improved the last step.
 */
whole: StepView | null, 
/**
 * The sensors of the home.
 */
own: StepView | null, };

export type StepView = { 
/**
 * The name of the last sensor.
 */
sensor: string, 
/**
 * The mean over the goals, from 0 to 1.
 */
score: number, reached: Array<Reached>, };

export type Reached = { goal: string, 
/**
 * From 0 to 1.
 */
score: number, 
/**
 * In `unit`: days until found, the mean error of a day, the share of the floor.
 */
value: number, unit: string, };
