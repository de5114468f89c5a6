// Two runs side by side: the corresponding sensors, days and firings, and the differences.

import { dayAt, follow } from '../../localtime';
import type { PlaybackView } from '../../wire';
import type { Day } from './day';

/** Firings within this time correspond to each other (our choice). */
export const ALIKE_US = 60_000_000;

/** A sensor of either run, and its firings on a day, all in the first run's time. */
export type Pair = {
  name: string;
  kind: string;
  first: ArrayLike<number>;
  second: ArrayLike<number>;
  /** The value of each firing, by its number in the run. */
  saidFirst: ArrayLike<number>;
  saidSecond: ArrayLike<number>;
  /** Firings of the first without a counterpart in the second, and the reverse. */
  onlyFirst: number[];
  onlySecond: number[];
};

/** The second run's day that corresponds to a day of the first, and its time difference. */
export function correspondingDay(first: PlaybackView, number: number, second: PlaybackView): { number: number; later_us: number } | null {
  const day = first.days[number];
  if (day === undefined) return null;
  const middle = day.begin_us + (day.end_us - day.begin_us) / 2;
  for (const at of [middle, day.begin_us, day.end_us - 1]) {
    const there = follow(first, at, second);
    if (there !== null) return { number: dayAt(second, there), later_us: there - at };
  }
  return null;
}

/** The firings of `these` without a counterpart among `others`; each counterpart counts once. Both are in order. */
export function withoutCounterpart(these: ArrayLike<number>, others: ArrayLike<number>, alike_us = ALIKE_US): number[] {
  const alone: number[] = [];
  let next = 0;
  for (let index = 0; index < these.length; index++) {
    const at = these[index]!;
    while (next < others.length && others[next]! < at - alike_us) next += 1;
    if (next < others.length && others[next]! <= at + alike_us) next += 1;
    else alone.push(at);
  }
  return alone;
}

export function sensorName(view: PlaybackView, sensor: number): string {
  return view.home.sensors[sensor]?.name ?? view.sensors[sensor] ?? '';
}

/** The sensors of both runs by name, in the first's order, then those of the second only; with their numbers in each. */
export function sensorPairs(first: PlaybackView, second: PlaybackView): { name: string; kind: string; first?: number; second?: number }[] {
  const left = new Map(second.sensors.map((_, index) => [sensorName(second, index), index]));
  const pairs = first.sensors.map((_, index) => {
    const name = sensorName(first, index);
    const other = left.get(name);
    left.delete(name);
    return { name, kind: first.home.sensors[index]?.kind ?? '', first: index, ...(other === undefined ? {} : { second: other }) };
  });
  return [...pairs, ...[...left].map(([name, index]) => ({ name, kind: second.home.sensors[index]?.kind ?? '', second: index }))];
}

/** The firings of both runs' sensors on a day. */
export function pairsOf(first: PlaybackView, day: Day | null, second: PlaybackView, beside: Day | null, later_us: number): Pair[] {
  const moved = (sensor: number | undefined) => (sensor === undefined ? [] : Float64Array.from(beside?.fired[sensor] ?? [], (at) => at - later_us));
  const both = day !== null && beside !== null;
  return sensorPairs(first, second).map(({ name, kind, first: own, second: other }) => {
    const [a, b] = [own === undefined ? [] : (day?.fired[own] ?? []), moved(other)];
    return { name, kind, first: a, second: b, saidFirst: (own === undefined ? undefined : day?.said[own]) ?? [], saidSecond: (other === undefined ? undefined : beside?.said[other]) ?? [], onlyFirst: both ? withoutCounterpart(a, b) : [], onlySecond: both ? withoutCounterpart(b, a) : [] };
  });
}

/** Seconds of a day by name. */
function lasting(day: Day | null, [begin_us, end_us]: [number, number], of: 'rooms' | 'activities', name: (number: number) => string): Map<string, number> {
  const all = new Map<string, number>();
  for (const life of day?.view.lives ?? []) {
    for (const [begin, end, what] of life[of]) {
      const seconds = Math.max(Math.min(end, end_us) - Math.max(begin, begin_us), 0) / 1e6;
      all.set(name(what), (all.get(name(what)) ?? 0) + seconds);
    }
  }
  return all;
}

export type Spent = { name: string; first: number; second: number };

/** Rooms or activities and the seconds of a day in each run, the largest difference first. */
export function spent(first: PlaybackView, day: Day | null, second: PlaybackView, beside: Day | null, of: 'rooms' | 'activities'): Spent[] {
  const sums = ([[first, day], [second, beside]] as const).map(([view, one]) => {
    const date = one === null ? undefined : view.days[one.number];
    const name = (number: number) => (of === 'rooms' ? view.home.rooms[number]?.name : view.activities[number]) ?? '';
    return lasting(one, [date?.begin_us ?? 0, date?.end_us ?? 0], of, name);
  });
  const names = new Set([...sums[0]!.keys(), ...sums[1]!.keys()]);
  const rows = [...names].map((name) => ({ name, first: sums[0]!.get(name) ?? 0, second: sums[1]!.get(name) ?? 0 }));
  return rows.sort((a, b) => Math.abs(b.second - b.first) - Math.abs(a.second - a.first));
}

/** The second run's excess of rows in each hour of each day of the first; null for a day that it lacks. */
export function hoursMore(first: PlaybackView, second: PlaybackView): (number[] | null)[] {
  return first.hours.map((hours, number) => {
    const other = second.hours[correspondingDay(first, number, second)?.number ?? -1];
    return other === undefined ? null : hours.map((count, hour) => (other[hour] ?? 0) - count);
  });
}
