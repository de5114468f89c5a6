// A stored run with its fetched days. Log and truth of a long run are still being read while it is open.

import { createSubscriber } from 'svelte/reactivity';
import type { Sight } from '../../charts/axis';
import { type Band, type Counts, type Curve, type Drawing, type Lane, countBetween, countsOf } from '../../charts/lanes';
import type { Shade } from '../../charts/shades';
import { dayAt } from '../../localtime';
import { type Server, lanesPath, readingPath, restPath, storedPath } from '../../server';
import type { DayView, LanesView, PlaybackView, ReadingView } from '../../wire';
import { type Day, prepare } from './day';
import { OUT, placeName, spansIn } from './uncertainty';
import { type Pair, correspondingDay, pairsOf, sensorName, sensorPairs } from './comparison';

/** Number of days that are kept; the least recently used go first. */
const KEPT = 12;

/** Interval of progress requests. */
const ASKED_EACH_MS = 300;

/** Number of progress answers after which the summary of the log is fetched anew. */
const RENEWED_EACH = 5;

export class Stored {
  private readonly watched: () => void;
  private grown: () => void = () => {};
  private readonly days = new Map<number, Day>();
  private readonly coming = new Map<number, Promise<Day>>();
  /** Firings of each sensor over the whole run, once they have arrived. */
  lanes: LanesView | null = null;
  private counting: Promise<LanesView> | null = null;
  /** Ends the requests for a day in pieces. */
  private stopped = false;

  constructor(
    private known_: PlaybackView,
    private readonly server: Pick<Server, 'json' | 'packed'>,
  ) {
    this.watched = createSubscriber((update) => {
      this.grown = update;
      return () => (this.grown = () => {});
    });
  }

  static async open(server: Pick<Server, 'json' | 'packed'>, name: string): Promise<Stored> {
    return new Stored(await server.json<PlaybackView>(storedPath(name)), server);
  }

  /** The present view of the run. */
  get view(): PlaybackView {
    this.watched();
    return this.known_;
  }

  /** Fetches the present summary of log and truth; the home and the days stay. */
  private async renew(): Promise<void> {
    const { sensors, values, hours, remarks, activities, spans, read_us } = await this.server.json<PlaybackView>(storedPath(this.known_.name));
    this.known_ = { ...this.known_, sensors, values, hours, remarks, activities, spans, read_us };
    this.grown();
  }

  /** Waits until all of the log is read, or until it is no longer wanted; `onshare` gets the share. */
  async readAll(wanted: () => boolean, onshare: (share: number) => void): Promise<void> {
    for (let asked = 1; this.known_.read_us !== null && wanted(); asked++) {
      const read_us = await this.ask();
      onshare(Math.max(read_us ?? this.known_.length_us, 0) / Math.max(this.known_.length_us, 1));
      if (read_us === null || asked % RENEWED_EACH === 0) await this.renew();
    }
  }

  /** The instant up to which the log is read, after a pause; null for all. */
  private async ask(): Promise<number | null> {
    await new Promise((resolve) => setTimeout(resolve, ASKED_EACH_MS));
    return (await this.server.json<ReadingView>(readingPath(this.known_.name))).read_us;
  }

  /** Waits until the log is read up to an instant. */
  private async readUpTo(until_us: number, onshare: (share: number) => void): Promise<void> {
    let read_us = this.known_.read_us;
    while (read_us !== null && read_us < until_us) {
      onshare(Math.max(read_us, 0) / until_us);
      read_us = await this.ask();
    }
  }

  /** The day of an instant, if it has arrived. */
  at(at_us: number): Day | null {
    return this.days.get(dayAt(this.view, at_us)) ?? null;
  }

  /** Fetches the firings of each sensor over the whole run. */
  async count(): Promise<void> {
    if (this.lanes !== null) return;
    this.counting ??= this.server.packed<LanesView>(lanesPath(this.view.name));
    try {
      this.lanes = await this.counting;
    } finally {
      this.counting = null;
    }
  }

  /** A day by its number, if it has arrived. */
  known(number: number): Day | null {
    return this.days.get(number) ?? null;
  }

  has(number: number): boolean {
    return this.days.has(number);
  }

  /** Days on their way are shown with the pieces that have arrived. */
  stop(): void {
    if (this.coming.size > 0) this.stopped = true;
  }

  /** A day of a very large truth arrives in pieces. */
  private async pieces(number: number, onshare: (share: number) => void): Promise<DayView> {
    this.stopped = false;
    const { begin_us, end_us } = this.view.days[number]!;
    await this.readUpTo(end_us, onshare);
    const view = await this.server.packed<DayView>(storedPath(this.view.name, number));
    // The day may have new sensors or values.
    if (this.known_.read_us !== null) await this.renew();
    while (view.until_us < end_us && !this.stopped) {
      onshare((view.until_us - begin_us) / Math.max(end_us - begin_us, 1));
      const more = await this.server.packed<DayView>(restPath(this.view.name, number, view.until_us));
      // Without progress of the server, requests would never end.
      if (more.until_us <= view.until_us) break;
      view.until_us = more.until_us;
      more.lives.forEach(({ movements }, who) => {
        const known = view.lives[who]?.movements;
        const last = known?.at(-1)?.[1] ?? -Infinity;
        for (const movement of movements) if (movement[1] > last) known?.push(movement);
      });
    }
    return view;
  }

  /** A day, fetched if necessary. */
  async day(number: number, onshare: (share: number) => void = () => {}): Promise<Day> {
    const known = this.days.get(number);
    if (known !== undefined) {
      // It is the most recently used one now.
      this.days.delete(number);
      this.days.set(number, known);
      return known;
    }
    const before = this.coming.get(number);
    if (before !== undefined) return before;
    const fetched = this.pieces(number, onshare).then((view) => {
      const day = prepare(this.view, number, view);
      this.days.set(number, day);
      for (const old of [...this.days.keys()].slice(0, -KEPT)) this.days.delete(old);
      return day;
    });
    this.coming.set(number, fetched);
    try {
      return await fetched;
    } finally {
      this.coming.delete(number);
    }
  }
}

/** The corresponding content of another run, in the first run's time. */
export type Other = { view: PlaybackView; day: Day | null; later_us: number };

/** Largest number of days that are drawn firing by firing; more are drawn as counts. */
export const MOST_DAYS = 4;

/** The visible days of a run. */
export function daysIn(view: PlaybackView, { from_us, to_us }: Sight): number[] {
  const [first, last] = [dayAt(view, from_us), dayAt(view, Math.max(to_us - 1, from_us))];
  return Array.from({ length: last - first + 1 }, (_, index) => first + index);
}

/** The drawing of the visible interval, without days that have not arrived. With `others`, another run's days next to these. */
export function drawingOf(
  view: PlaybackView, sight: Sight, days: readonly (Day | null)[], truth: boolean, { rooms = false, others = null as (Other | null)[] | null } = {},
): Drawing {
  const here = days.filter((day) => day !== null);
  const own = bandsOf(view, here, truth, rooms, 0);
  const known = (others ?? []).filter((other) => other !== null);
  const beside = known.length === 0 ? [] : bandsOf(known[0]!.view, known.flatMap(({ day }) => day ?? []), truth, rooms, known[0]!.later_us);
  return {
    calendar: view,
    sight,
    bands: besideEachOther(own, beside),
    shades: view.walk === null || !truth ? [] : shadesOf(view, here),
    lanes: known.length === 0 ? view.sensors.map((_, sensor) => laneOf(view, sensor, here)) : pairedLanes(view, days, others!),
  };
}

/** A run as a whole, as far as its counts have arrived. */
export type Whole = { view: PlaybackView; whole: LanesView | null };

/** The whole run as counts, if it is too long to be drawn firing by firing. With `other`, another run's counts next to its own. */
export function wholeOf({ view, whole }: Whole, truth: boolean, other: Whole | null = null): Pick<Drawing, 'bands' | 'lanes'> {
  if (other === null) {
    const lanes = view.sensors.map((_, sensor) => ({ ...laneOf(view, sensor, []), ...(whole === null ? {} : { density: countsFor(whole, sensor) }) }));
    return { bands: longBands(view, truth, view.spans), lanes };
  }
  const days = view.days.map((_, number) => correspondingDay(view, number, other.view));
  const beside = longBands(other.view, truth, spansBeside(other.view, days));
  return { bands: besideEachOther(longBands(view, truth, view.spans), beside), lanes: pairedCounts({ view, whole }, other, days) };
}

function longBands(view: PlaybackView, truth: boolean, spans: PlaybackView['spans']): Band[] {
  if (!truth || view.walk !== null || !view.has_truth) return [];
  return view.residents.map(({ name }, who) => ({ name, who, spans: spans[who] ?? [], names: view.activities }));
}

/** A resident's bands of two runs are below each other. */
function besideEachOther(own: Band[], beside: Band[]): Band[] {
  const others = beside.map((band) => ({ ...band, isBeside: true }));
  return own.flatMap((band, index) => [band, ...others.slice(index, index + 1)]).concat(others.slice(own.length));
}

function countsFor(whole: LanesView, sensor: number): Counts {
  return countsOf(whole.bucket_us, whole.counts[sensor] ?? []);
}

function joined<T extends Float64Array | Uint32Array>(parts: T[], make: (length: number) => T): T {
  if (parts.length === 1) return parts[0]!;
  const all = make(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part as never, at);
    at += part.length;
  }
  return all;
}

function laneOf(view: PlaybackView, sensor: number, days: readonly Day[]): Lane {
  const known = view.home.sensors[sensor];
  const fired = joined(days.map((day) => day.fired[sensor] ?? new Float64Array()), (length) => new Float64Array(length));
  const said = joined(days.map((day) => day.said[sensor] ?? new Uint32Array()), (length) => new Uint32Array(length));
  const curve = curvesOf([{ view, said }])?.[0];
  return {
    name: sensorName(view, sensor), kind: known?.kind ?? '', fired, said: (index) => view.values[said[index]!] ?? '',
    ...(known?.room == null ? {} : { place: known.room }), ...(curve === undefined ? {} : { curve }),
  };
}

/** The values of a sensor, in one run or in several, with the range of all, if all are numbers, and at least three differ. */
function curvesOf(all: readonly { view: PlaybackView; said: ArrayLike<number> }[]): Curve[] | null {
  const found = new Set<number>();
  const curves: ArrayLike<number>[] = [];
  for (const { view, said } of all) {
    const numbers = new Map<number, number>();
    for (let index = 0; index < said.length; index++) {
      const value = said[index]!;
      if (numbers.has(value)) continue;
      const text = view.values[value] ?? '';
      const number = text.trim() === '' ? NaN : Number(text);
      if (!Number.isFinite(number)) return null;
      numbers.set(value, number);
      found.add(number);
    }
    curves.push(Float64Array.from(said, (value) => numbers.get(value)!));
  }
  if (found.size <= 2) return null;
  const [low, high] = [Math.min(...found), Math.max(...found)];
  return curves.map((values) => ({ values, low, high }));
}

/** Lanes of two runs, one for each sensor. */
function pairedLanes(view: PlaybackView, days: readonly (Day | null)[], others: readonly (Other | null)[]): Lane[] {
  const lanes = new Map<string, { name: string; kind: string; parts: Pair[] }>();
  const there = others.find((other) => other !== null)?.view;
  days.forEach((day, index) => {
    const other = others[index];
    if (!other) return;
    for (const pair of pairsOf(view, day, other.view, other.day, other.later_us)) {
      const lane = lanes.get(pair.name) ?? { name: pair.name, kind: pair.kind, parts: [] };
      lane.parts.push(pair);
      lanes.set(pair.name, lane);
    }
  });
  const all = (parts: Pair[], of: (pair: Pair) => ArrayLike<number>) => joined(parts.map((pair) => Float64Array.from(of(pair))), (length) => new Float64Array(length));
  const room = new Map(view.home.sensors.map(({ name, room }) => [name, room]));
  const words = (view: PlaybackView | undefined, said: ArrayLike<number>) => (index: number) => view?.values[said[index]!] ?? '';
  return [...lanes.values()].map(({ name, kind, parts }) => {
    const [said, saidBeside] = [all(parts, ({ saidFirst }) => saidFirst), all(parts, ({ saidSecond }) => saidSecond)];
    const curves = there === undefined ? null : curvesOf([{ view, said }, { view: there, said: saidBeside }]);
    return {
      name, kind, ...(room.get(name) == null ? {} : { place: room.get(name)! }), ...(curves === null ? {} : { curve: curves[0]! }),
      fired: all(parts, ({ first }) => first), said: words(view, said),
      beside: {
        fired: all(parts, ({ second }) => second), said: words(there, saidBeside), ...(curves === null ? {} : { curve: curves[1]! }),
        onlyFirst: all(parts, ({ onlyFirst }) => onlyFirst), onlySecond: all(parts, ({ onlySecond }) => onlySecond),
      },
    };
  });
}

/** By day of the first run, the corresponding day of the other. */
type DaysBeside = readonly ReturnType<typeof correspondingDay>[];

/** The other run's longest activities in the first one's time, on days that the first has. */
function spansBeside(other: PlaybackView, days: DaysBeside): PlaybackView['spans'] {
  const later = new Map(days.flatMap((day) => (day === null ? [] : [[day.number, day.later_us]])));
  return other.spans.map((spans) => spans.flatMap(([begin, end, what]): typeof spans => {
    const later_us = later.get(dayAt(other, begin));
    return later_us === undefined ? [] : [[begin - later_us, end - later_us, what]];
  }));
}

/** Counts of two runs, one lane for each sensor. */
function pairedCounts({ view, whole }: Whole, other: Whole, days: DaysBeside): Lane[] {
  const own = (sensor: number | undefined) => (sensor === undefined ? null : laneOf(view, sensor, []));
  const pairs = sensorPairs(view, other.view);
  if (whole === null) return pairs.map(({ name, kind, first }) => own(first) ?? { name, kind, fired: [] });
  const { bucket_us } = whole;
  const parts = Math.max(...whole.counts.map(({ length }) => length), 0);
  /** The time difference to the other run in each part, if it has that day. */
  const later = Array.from({ length: parts }, (_, part) => days[dayAt(view, part * bucket_us)]?.later_us ?? null);
  return pairs.map(({ name, kind, first, second }) => {
    const counts = later.map((_, part) => (first === undefined ? 0 : (whole.counts[first]?.[part] ?? 0)));
    const lane = { ...(own(first) ?? { name, kind, fired: [] }), density: countsOf(bucket_us, counts) };
    if (other.whole === null) return lane;
    const theirs = second === undefined ? null : countsFor(other.whole, second);
    const beside = later.map((later_us, part) => (later_us === null || theirs === null ? 0 : countBetween(theirs, part * bucket_us + later_us, (part + 1) * bucket_us + later_us)));
    const shared = counts.map((count, part) => (later[part] === null ? 0 : count));
    return { ...lane, densityBeside: { counts: countsOf(bucket_us, beside), shared: countsOf(bucket_us, shared) } };
  });
}

/** Activities of residents, and with `rooms` their rooms. */
function bandsOf(view: PlaybackView, days: readonly Day[], truth: boolean, rooms: boolean, later_us: number): Band[] {
  if (!truth || view.walk !== null || !view.has_truth) return [];
  const spans = (who: number, of: 'activities' | 'rooms') => {
    const all = days.flatMap((day) => day.view.lives[who]?.[of] ?? []);
    // An activity over midnight is in both days.
    const once = all.filter(([begin], index) => index === 0 || begin > all[index - 1]![0]);
    return later_us === 0 ? once : once.map(([begin, end, what]) => [begin - later_us, end - later_us, what] as const);
  };
  // People who do not come on these days take no room.
  const comes = (who: number) => who === 0 || days.length === 0 || days.some((day) => (day.view.lives[who]?.activities.length ?? 0) + (day.view.lives[who]?.rooms.length ?? 0) > 0);
  return view.residents.flatMap(({ name }, who): Band[] => !comes(who) ? [] : [
    { name, who, spans: spans(who, 'activities'), names: view.activities },
    ...(rooms ? [{ name: 'where', who: null, spans: spans(who, 'rooms'), names: view.home.rooms.map((room) => room.name), isRoom: true }] : []),
  ]);
}

/** Probabilities of rooms and of being out, by resident. */
function shadesOf(view: PlaybackView, days: readonly Day[]): Shade[] {
  const by = (place: number) => view.residents.map((_, who) => days.flatMap((day) => {
    const doubt = day.doubts[who];
    return doubt === undefined ? [] : spansIn(doubt, place, view.days[day.number]!.end_us);
  }));
  return [...view.home.rooms.keys(), OUT].map((place) => ({ name: placeName(view.home, place), by: by(place) }));
}
