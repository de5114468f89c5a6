// The wall time of a run. The server sends the start of each day and the instants at which clocks are set; the page
// knows no time zone.

import { read } from './clock';
import type { DateView, PlaybackView } from './wire';

/** The days of a run, in order and without gaps. */
export type Calendar = Pick<PlaybackView, 'days' | 'length_us'>;
type Days = Pick<PlaybackView, 'days'>;

const HOUR_US = 3_600_000_000;

/** The day of an instant; the run's end belongs to its last day. */
export function dayAt(run: Days, at_us: number): number {
  let [low, high] = [0, run.days.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (run.days[middle]!.begin_us <= at_us) low = middle;
    else high = middle - 1;
  }
  return Math.max(low, 0);
}

/** `day 3 of 90`. */
export function dayOf(run: Days, at_us: number): string {
  return run.days.length === 0 ? '' : `day ${dayAt(run, at_us) + 1} of ${run.days.length}`;
}

/** The clock at an instant of a day, in microseconds since midnight. */
export function sinceMidnight(day: DateView, at_us: number): number {
  const turned = day.turn !== null && at_us >= day.turn[0] ? day.turn[1] : 0;
  return day.clock_us + at_us - day.begin_us + turned;
}

/** The clock at an instant of the run, in milliseconds as if it were UTC. */
export function clockOf(run: Days, at_us: number): number {
  const day = run.days[dayAt(run, at_us)];
  return day === undefined ? NaN : read(`${day.date} 00:00:00`) + sinceMidnight(day, at_us) / 1000;
}

/** The instant of a clock time; the first of two, and null outside of the run. */
export function instantOf(run: Calendar, clock_ms: number): number | null {
  const date = new Date(clock_ms).toISOString().slice(0, 10);
  const number = numberOf(run, date);
  return number === null ? null : instantIn(run, number, clock_ms - read(`${date} 00:00:00`));
}

/** The day with a date. Dates sort as texts. */
function numberOf({ days }: Days, date: string): number | null {
  let [low, high] = [0, days.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (days[middle]!.date < date) low = middle + 1;
    else high = middle;
  }
  return days[low]?.date === date ? low : null;
}

/** Two runs have a date in common. */
function isShared({ days: first }: Days, { days: second }: Days): boolean {
  return first.length > 0 && second.length > 0 && first[0]!.date <= second.at(-1)!.date && second[0]!.date <= first.at(-1)!.date;
}

/** The instant of a time since midnight on a day of the run; null outside of the run. */
function instantIn(run: Calendar, number: number, since_midnight_ms: number): number | null {
  const day = run.days[number];
  if (day === undefined) return null;
  const plain = day.begin_us + since_midnight_ms * 1000 - day.clock_us;
  const at = day.turn === null || plain < day.turn[0] ? plain : Math.max(plain - day.turn[1], day.turn[0]);
  return at < 0 || at > run.length_us ? null : at;
}

/**
 * The time of a second run for an instant of the first: at the same date and time if it has that date, otherwise at the
 * same time of its day with the same number.
 */
export function follow(first: Calendar, at_us: number, second: Calendar): number | null {
  const clock = clockOf(first, at_us);
  if (!Number.isFinite(clock)) return null;
  if (isShared(first, second)) return instantOf(second, clock);
  const midnight = Math.floor(clock / 86_400_000) * 86_400_000;
  return instantIn(second, dayAt(first, at_us), clock - midnight);
}

/** The simulated duration of an hour of a day's clock, up to an instant of the run. */
export function livedOf(day: DateView, hour: number, until_us: number): number {
  const within = (from_us: number, to_us: number, begin_us: number) =>
    Math.max(Math.min(begin_us + HOUR_US, to_us, until_us) - Math.max(begin_us, from_us), 0);
  const begin_us = day.begin_us + hour * HOUR_US - day.clock_us;
  if (day.turn === null) return within(day.begin_us, day.end_us, begin_us);
  const [at, by] = day.turn;
  return within(day.begin_us, at, begin_us) + within(at, day.end_us, begin_us - by);
}
