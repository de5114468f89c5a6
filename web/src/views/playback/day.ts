// A day of a stored run, made ready for drawing: its rows by sensor, and when nothing stirs.

import type { DayView, PersonDay, PlaybackView } from '../../wire';
import { above } from './above';
import { type Doubt, doubtOf } from './doubt';

/** Shorter stillness is not worth a jump. */
export const STILL_US = 60_000_000;

export type Span = [begin: number, end: number];

export type Day = {
  number: number;
  view: DayView;
  /** By sensor: when it fired. What says that it is off again is none. */
  fired: Float64Array[];
  /** What each of these said, by the number of the value in the run. */
  said: Uint32Array[];
  /** When for longer than a minute no sensor said anything; and when, besides, nobody went anywhere. */
  quiet: Span[];
  still: Span[];
  /** By resident; none but of a log that was walked back. */
  doubts: Doubt[];
};

/** Messages after which nothing happens in front of the sensor. */
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
    doubts: run.walk === null ? [] : view.lives.map((life) => doubtOf(run, life)),
  };
}

/** What lies between spans, in the order of their beginnings, where it is long enough. */
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

/** How often each sensor fired since the day began. */
export function counts(day: Day, now_us: number): number[] {
  return day.fired.map((all) => above(all, now_us, (at) => at));
}

/** The span in which an instant lies, of spans in order that do not overlap. */
export function spanAt<T extends readonly [number, number, ...unknown[]]>(spans: readonly T[], at_us: number): T | null {
  const span = spans[above(spans, at_us, ([begin]) => begin) - 1];
  return span !== undefined && at_us < span[1] ? span : null;
}

export function movementAt(life: PersonDay, at_us: number): number {
  const index = above(life.movements, at_us, ([begin]) => begin) - 1;
  const movement = life.movements[index];
  return movement !== undefined && at_us <= movement[1] ? index : -1;
}
