// A stored run as the page knows it, and the days of it that have been fetched.

import type { Sight } from '../../charts/axis';
import { type Band, type Counts, type Curve, type Drawing, type Lane, countsOf } from '../../charts/lanes';
import type { Shade } from '../../charts/shades';
import { dayAt } from '../../localtime';
import { type Server, lanesPath, restPath, storedPath } from '../../server';
import type { DayView, LanesView, PlaybackView } from '../../wire';
import { type Day, prepare } from './day';
import { OUT, placeName, spansIn } from './doubt';
import { type Pair, pairsOf, sensorName } from './twin';

/** So many days are kept; those that were wanted longest ago go first. */
const KEPT = 12;

export class Stored {
  private readonly days = new Map<number, Day>();
  private readonly coming = new Map<number, Promise<Day>>();
  /** How often each sensor spoke over the whole run, once that is here. */
  lanes: LanesView | null = null;
  private counting: Promise<LanesView> | null = null;
  /** Nothing more of a day that is on its way is asked for. */
  private stopped = false;

  constructor(
    readonly view: PlaybackView,
    private readonly server: Pick<Server, 'packed'>,
  ) {}

  static async open(server: Pick<Server, 'json' | 'packed'>, name: string): Promise<Stored> {
    return new Stored(await server.json<PlaybackView>(storedPath(name)), server);
  }

  /** The day of an instant, if it is here already. */
  at(at_us: number): Day | null {
    return this.days.get(dayAt(this.view, at_us)) ?? null;
  }

  /** Fetches how often each sensor spoke over the whole run. */
  async count(): Promise<void> {
    if (this.lanes !== null) return;
    this.counting ??= this.server.packed<LanesView>(lanesPath(this.view.name));
    try {
      this.lanes = await this.counting;
    } finally {
      this.counting = null;
    }
  }

  /** A day by its number, if it is here already. */
  known(number: number): Day | null {
    return this.days.get(number) ?? null;
  }

  has(number: number): boolean {
    return this.days.has(number);
  }

  /** What has come of days that are on their way is all that is shown of them. */
  stop(): void {
    if (this.coming.size > 0) this.stopped = true;
  }

  /** A day of a very large truth comes in pieces. */
  private async pieces(number: number, onshare: (share: number) => void): Promise<DayView> {
    this.stopped = false;
    const { begin_us, end_us } = this.view.days[number]!;
    const view = await this.server.packed<DayView>(storedPath(this.view.name, number));
    while (view.until_us < end_us && !this.stopped) {
      onshare((view.until_us - begin_us) / Math.max(end_us - begin_us, 1));
      const more = await this.server.packed<DayView>(restPath(this.view.name, number, view.until_us));
      // A server that does not come on would be asked for ever.
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

  /** A day, fetched if need be. */
  async day(number: number, onshare: (share: number) => void = () => {}): Promise<Day> {
    const known = this.days.get(number);
    if (known !== undefined) {
      // It is the last one that was wanted now.
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

/** What else is drawn beside days: the same of another run, on the first run's time. */
export type Other = { view: PlaybackView; day: Day | null; later_us: number };

/** So many days at most are drawn firing by firing; of more only counts are. */
export const MOST_DAYS = 4;

/** The days of a run that are in sight. */
export function daysIn(view: PlaybackView, { from_us, to_us }: Sight): number[] {
  const [first, last] = [dayAt(view, from_us), dayAt(view, Math.max(to_us - 1, from_us))];
  return Array.from({ length: last - first + 1 }, (_, index) => first + index);
}

/** What is in sight as it is drawn; of days that have not been fetched nothing is in it. With `others` another run's days beside these. */
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
    // A resident's bands of two runs stand below each other.
    bands: own.flatMap((band, index) => [band, ...beside.slice(index, index + 1)]).concat(beside.slice(own.length)),
    shades: view.walk === null || !truth ? [] : shadesOf(view, here),
    lanes: known.length === 0 ? view.sensors.map((_, sensor) => laneOf(view, sensor, here)) : pairedLanes(view, days, others!),
  };
}

/** The whole run as counts, where it is too long to be drawn firing by firing. */
export function wholeOf(view: PlaybackView, sight: Sight, whole: LanesView | null, truth: boolean): Drawing {
  const bands = !truth || view.walk !== null || !view.has_truth ? [] : view.residents.map(({ name }, who) => ({ name, who, spans: view.spans[who] ?? [], names: view.activities }));
  const lanes = view.sensors.map((_, sensor) => {
    const density = whole === null ? undefined : countsFor(whole, sensor);
    return { ...laneOf(view, sensor, []), ...(density === undefined ? {} : { density }) };
  });
  return { calendar: view, sight, bands, lanes };
}

const counted = new WeakMap<LanesView, Map<number, Counts>>();

/** Sums are made once. */
function countsFor(whole: LanesView, sensor: number): Counts {
  const known = counted.get(whole) ?? new Map<number, Counts>();
  counted.set(whole, known);
  const of = known.get(sensor) ?? countsOf(whole.bucket_us, whole.counts[sensor] ?? []);
  known.set(sensor, of);
  return of;
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
  const curve = curveOf(view, said);
  return {
    name: sensorName(view, sensor), kind: known?.kind ?? '', fired, said: (index) => view.values[said[index]!] ?? '',
    ...(known?.room == null ? {} : { place: known.room }), ...(curve === null ? {} : { curve }),
  };
}

/** What a sensor said as numbers, if all of it is some, and more than two of them. */
function curveOf(view: PlaybackView, said: Uint32Array): Curve | null {
  const numbers = new Map<number, number>();
  for (const value of said) {
    if (numbers.has(value)) continue;
    const text = view.values[value] ?? '';
    const number = text.trim() === '' ? NaN : Number(text);
    if (!Number.isFinite(number)) return null;
    numbers.set(value, number);
  }
  if (numbers.size <= 2) return null;
  const all = [...numbers.values()];
  return { values: Float64Array.from(said, (value) => numbers.get(value)!), low: Math.min(...all), high: Math.max(...all) };
}

/** Lanes of two runs, of which each sensor has one. */
function pairedLanes(view: PlaybackView, days: readonly (Day | null)[], others: readonly (Other | null)[]): Lane[] {
  const lanes = new Map<string, { name: string; kind: string; parts: Pair[] }>();
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
  return [...lanes.values()].map(({ name, kind, parts }) => ({
    name, kind, ...(room.get(name) == null ? {} : { place: room.get(name)! }), fired: all(parts, ({ first }) => first),
    beside: { fired: all(parts, ({ second }) => second), onlyFirst: all(parts, ({ onlyFirst }) => onlyFirst), onlySecond: all(parts, ({ onlySecond }) => onlySecond) },
  }));
}

/** What residents did, and with `rooms` where. */
function bandsOf(view: PlaybackView, days: readonly Day[], truth: boolean, rooms: boolean, later_us: number): Band[] {
  if (!truth || view.walk !== null || !view.has_truth) return [];
  const spans = (who: number, of: 'activities' | 'rooms') => {
    const all = days.flatMap((day) => day.view.lives[who]?.[of] ?? []);
    // What goes on over midnight is told of both days.
    const once = all.filter(([begin], index) => index === 0 || begin > all[index - 1]![0]);
    return later_us === 0 ? once : once.map(([begin, end, what]) => [begin - later_us, end - later_us, what] as const);
  };
  // Whoever does not come on these days takes no room.
  const comes = (who: number) => who === 0 || days.length === 0 || days.some((day) => (day.view.lives[who]?.activities.length ?? 0) + (day.view.lives[who]?.rooms.length ?? 0) > 0);
  return view.residents.flatMap(({ name }, who): Band[] => !comes(who) ? [] : [
    { name, who, spans: spans(who, 'activities'), names: view.activities },
    ...(rooms ? [{ name: 'where', who: null, spans: spans(who, 'rooms'), names: view.home.rooms.map((room) => room.name), isRoom: true }] : []),
  ]);
}

/** How likely residents were in each room, and out. */
function shadesOf(view: PlaybackView, days: readonly Day[]): Shade[] {
  const by = (place: number) => view.residents.map((_, who) => days.flatMap((day) => {
    const doubt = day.doubts[who];
    return doubt === undefined ? [] : spansIn(doubt, place, view.days[day.number]!.end_us);
  }));
  return [...view.home.rooms.keys(), OUT].map((place) => ({ name: placeName(view.home, place), by: by(place) }));
}
