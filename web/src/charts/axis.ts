// The time axis from left to right: positions of instants, and the labelled times.

import { dayMonth, read, time, year } from '../clock';
import { type Calendar, clockOf, dayAt, sinceMidnight } from '../localtime';
import type { Palette } from '../plan/palette';
import { FONT, type Ink } from '../plan/pen';

/** Height of the row of times. */
export const AXIS = 18;

type Days = Pick<Calendar, 'days'>;

/** The visible interval, in microseconds of the run. */
export type Sight = { from_us: number; to_us: number };

/** The end of names and the start of time, in pixels. */
export function left(width: number): number {
  return Math.min(150, width * 0.3);
}

export function right(width: number): number {
  return width - 12;
}

/** The position of an instant on the drawing, and the instant of a position. */
export function xOf(from_us: number, to_us: number, width: number, at_us: number): number {
  return left(width) + ((at_us - from_us) / Math.max(to_us - from_us, 1)) * (right(width) - left(width));
}

export function instantAt(from_us: number, to_us: number, width: number, x: number): number {
  const share = Math.min(Math.max((x - left(width)) / (right(width) - left(width)), 0), 1);
  return from_us + share * (to_us - from_us);
}

/** The index of the first element of a sorted list that is not before an instant. */
export function firstFrom(all: ArrayLike<number>, at_us: number): number {
  let [low, high] = [0, all.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (all[middle]! < at_us) low = middle + 1;
    else high = middle;
  }
  return low;
}

const SECOND_US = 1e6;
const DAY_US = 86_400 * SECOND_US;
/** Round times within a day, and round numbers of days and months. */
const STEPS_US = [1, 2, 5, 10, 30, 60, 120, 300, 600, 1800, 3600, 7200, 10_800, 21_600, 43_200].map((seconds) => seconds * SECOND_US);
const STEPS_DAYS = [1, 2, 7, 14];
const STEPS_MONTHS = [1, 2, 3, 6, 12, 24, 60, 120];
const MONTH_US = 30.44 * DAY_US;
/** Width of a label, in pixels. */
const ROOM = 62;

export type Tick = { at_us: number; label: string; isDay: boolean };

/** The labelled times, as close as their width permits. */
export function ticksOf(calendar: Days, { from_us, to_us }: Sight, wide: number): Tick[] {
  const span = Math.max(to_us - from_us, 1);
  const has_room = (step_us: number) => (span / step_us) * ROOM <= wide;
  const [first, last] = [dayAt(calendar, from_us), dayAt(calendar, to_us)];
  const step = STEPS_US.find(has_room);
  const ticks: Tick[] = [];
  if (step === undefined) {
    const days = STEPS_DAYS.find((count) => has_room(count * DAY_US));
    const months = STEPS_MONTHS.find((count) => has_room(count * MONTH_US)) ?? Math.ceil(((span / MONTH_US) * ROOM) / Math.max(wide, 1));
    for (let number = first; number <= last; number++) {
      const day = calendar.days[number];
      if (day === undefined || day.begin_us < from_us || day.begin_us > to_us) continue;
      const isRound = days !== undefined ? number % days === 0 : day.date.endsWith('-01') && monthsSinceNought(day.date) % months === 0;
      if (isRound) ticks.push({ at_us: day.begin_us, label: dayMonth(read(`${day.date} 00:00:00`)), isDay: true });
    }
    return withYears(calendar, ticks);
  }
  for (let number = first; number <= last; number++) {
    const day = calendar.days[number];
    if (day === undefined) continue;
    const [begin, end] = [Math.max(day.begin_us, from_us), Math.min(day.end_us, to_us)];
    const offset = sinceMidnight(day, begin) % step;
    for (let at = begin - offset + (offset > 0 ? step : 0); at <= end; at += step) {
      // The day's end is the start of the next day.
      if (at === day.end_us && number < last) continue;
      const clock = clockOf(calendar, Math.min(at, day.end_us - 1));
      if (!Number.isFinite(clock)) continue;
      const shown = time(Math.round(clock / 1000) * 1000);
      const isDay = shown === '00:00:00' && at < day.end_us;
      ticks.push({ at_us: at, label: isDay && span > DAY_US ? dayMonth(clock) : shown.slice(0, step < 60 * SECOND_US ? 8 : 5), isDay });
    }
  }
  return withYears(calendar, ticks);
}

function monthsSinceNought(date: string): number {
  return Number(date.slice(0, 4)) * 12 + Number(date.slice(5, 7)) - 1;
}

/** If the days are of several years, the first visible date and the first date of each year have a label with the year. */
function withYears(calendar: Days, ticks: Tick[]): Tick[] {
  const yearAt = (number: number) => calendar.days.at(number)?.date.slice(0, 4);
  if (yearAt(0) === yearAt(-1)) return ticks;
  let before = '';
  return ticks.map((tick) => {
    if (!tick.isDay || !/ /.test(tick.label)) return tick;
    const now = year(clockOf(calendar, tick.at_us));
    const isNew = now !== before;
    before = now;
    return isNew ? { ...tick, label: tick.label === '1 Jan' ? now : `${tick.label} ${now}` } : tick;
  });
}

/** Lines at round times of the clock, across the whole drawing, and the times in its first row. */
export function drawAxis(pen: Ink, calendar: Days, sight: Sight, width: number, high: number, palette: Palette, labels = true): void {
  pen.font = `11px ${FONT}`;
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const { at_us, label, isDay } of ticksOf(calendar, sight, right(width) - left(width))) {
    const place = xOf(sight.from_us, sight.to_us, width, at_us);
    pen.globalAlpha = isDay ? 0.7 : 0.35;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(place, labels ? AXIS - 3 : 0, 1, high);
    pen.globalAlpha = 1;
    if (!labels || place > width - 22) continue;
    pen.fillStyle = palette.quiet;
    pen.fillText(label, place, AXIS / 2);
  }
}
