// Made from crates/homebody-web/src/wire.rs, which says what each means.

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
middle: [number, number], };

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

export type ThingView = { name: string, kind: ThingKind, at: [number, number], };

export type ThingKind = "door" | "furniture" | "lamp";

export type SensorView = { name: string, 
/**
 * As its file says it: `motion`, `bed`, `contact`, ...
 */
kind: string, at: [number, number], 
/**
 * The parts of its beams in which it sees a standing adult, from where to where; of sensors on walls.
 */
beams: Array<[[number, number], [number, number]]>, 
/**
 * What it sees from the ceiling, or the mat or bed that it feels.
 */
area: Array<[number, number]> | null, };

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
 * Where the log goes, as URLs.
 */
log: Array<string>, 
/**
 * Whether a recording is being lived again.
 */
replay: boolean, };

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
 * The last of those since the frame before, in order.
 */
firings: Array<FiringView>, };

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
 * Time, sensor and message as they are stored; nothing where the logger's file says that this is not.
 */
row: [string, string, string] | null, };

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
 * Why it cannot be played back.
 */
problem: string | null, };

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
hours: Array<Array<number>>, has_truth: boolean, 
/**
 * The names of activities.
 */
activities: Array<string>, 
/**
 * What each resident did: begin, end and the activity's number. Of a long run the short ones are left out.
 */
spans: Array<Array<[number, number, number]>>, 
/**
 * What is missing or was skipped, in sentences.
 */
remarks: Array<string>, };

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
lives: Array<LifeView>, };

export type LifeView = { 
/**
 * Begin, end, what it was, in which posture, from where, to where.
 */
movements: Array<[number, number, Doing, Posture, [number, number] | null, [number, number] | null]>, 
/**
 * Begin, end and the number of the home's room; between rooms there is none.
 */
rooms: Array<[number, number, number]>, 
/**
 * Begin, end and the activity's number.
 */
activities: Array<[number, number, number]>, };

export type Doing = "stride" | "stir" | "rest" | "away";

export type Say = { "say": "hello", token: string, } | { "say": "play" } | { "say": "pause" } | { "say": "step", seconds: number, } | { "say": "speed", times: number | null, } | { "say": "jump", to_us: number, } | { "say": "hold", keys: Array<Key>, } | { "say": "be", posture: Posture, } | { "say": "use", thing: number, on: boolean, } | { "say": "start", driven: number | null, without: Array<string>, seed: number | null, } | { "say": "stop" } | { "say": "replay", run: string, };

export type Key = "up" | "down" | "left" | "right" | "fast" | "slow";

export type Tell = { "tell": "run", run: RunView, } | { "tell": "note", text: string, bad: boolean, };
