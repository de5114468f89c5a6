// A day of a stored run, prepared for drawing: its rows by sensor, and its quiet intervals.

import type { DayView, PersonDay, PlaybackView } from '../../wire';
import { above } from './sorted-search';
import { type Uncertainty, uncertaintyOf } from './uncertainty';

/** Shorter quiet intervals are not skipped. */
export const STILL_US = 60_000_000;

export type Span = [begin: number, end: number];

export type Day = {
  number: number;
  view: DayView;
  /** By sensor: its firings, without messages of their end. */
  fired: Float64Array[];
  /** The value of each, by its number in the run. */
  said: Uint32Array[];
  /** Intervals of more than a minute without a message; and those that, in addition, have no movement of people. */
  quiet: Span[];
  still: Span[];
  /** By resident; empty without located people. */
  doubts: Uncertainty[];
};

/** Messages after an event in front of the sensor. */
function isOff(value: string): boolean {
  return /^(off|false)$/i.test(value);
}

export function prepare(run: PlaybackView, number: number, view: DayView): Day {
  const { begin_us, end_us } = run.days[number]!;
  const off = run.values.map(isOff);
  const fired: number[][] = run.sensors.map(() => []);
  const said: number[][] = run.sensors.map(() => []);
  for (const [at, sensor, value] of view.rows) {
    if (off[value]) continue;
    fired[sensor]?.push(at);
    said[sensor]?.push(value);
  }
  const rows = view.rows.map(([at]): Span => [at, at]);
  const strides = view.lives.flatMap(({ movements }) => movements.flatMap(([begin, end, doing]): Span[] => (doing === 'stride' ? [[begin, end]] : [])));
  return {
    number,
    view,
    fired: fired.map((all) => Float64Array.from(all)),
    said: said.map((all) => Uint32Array.from(all)),
    quiet: gaps(rows, begin_us, end_us),
    still: gaps([...rows, ...strides].sort((a, b) => a[0] - b[0]), begin_us, end_us),
    doubts: run.walk === null ? [] : view.lives.map((life) => uncertaintyOf(run, life)),
  };
}

/** The gaps between intervals in order of their beginnings, if they are long enough. */
export function gaps(spans: Span[], begin_us: number, end_us: number): Span[] {
  const found: Span[] = [];
  let last = begin_us;
  for (const [begin, end] of spans) {
    if (begin - last > STILL_US) found.push([last, begin]);
    last = Math.max(last, end);
  }
  if (end_us - last > STILL_US) found.push([last, end_us]);
  return found;
}

/** The sensors that fired within the last two seconds of the run. */
export function lit(day: Day, now_us: number, for_us = 2_000_000): number[] {
  return day.fired.flatMap((all, sensor) => {
    const last = all[above(all, now_us, (at) => at) - 1];
    return last !== undefined && now_us - last < for_us ? [sensor] : [];
  });
}

/** Firings of each sensor since the start of the day. */
export function counts(day: Day, now_us: number): number[] {
  return day.fired.map((all) => above(all, now_us, (at) => at));
}

/** The interval of an instant, in a sorted list without overlaps. */
export function spanAt<T extends readonly [number, number, ...unknown[]]>(spans: readonly T[], at_us: number): T | null {
  const span = spans[above(spans, at_us, ([begin]) => begin) - 1];
  return span !== undefined && at_us < span[1] ? span : null;
}

export function movementAt(life: PersonDay, at_us: number): number {
  const index = above(life.movements, at_us, ([begin]) => begin) - 1;
  const movement = life.movements[index];
  return movement !== undefined && at_us <= movement[1] ? index : -1;
}
