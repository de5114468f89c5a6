// Days in wall time: the positions of intervals in the 24 hours, also on a day on which clocks are set.

import { read, twoDigits } from '../../clock';
import { sinceMidnight } from '../../localtime';
import type { DateView, MonthView } from '../../wire';

const DAY_US = 86_400_000_000;

export type Span = readonly [begin_us: number, end_us: number, what: number];

/** A part of an interval: begin and end on the clock, since midnight, and whether its hour is unique, the first or the second. */
export type Piece = { from_us: number; to_us: number; what: number; pass: 'only' | 'first' | 'second' };

/** The parts of intervals in a day. */
export function piecesOf(day: DateView, spans: readonly Span[]): Piece[] {
  const [turn, by] = day.turn ?? [day.end_us, 0];
  // Clocks that are set back repeat an hour.
  const cuts = by < 0 ? [turn + by, turn, turn - by] : [turn];
  const pieces: Piece[] = [];
  for (const [begin, end, what] of spans) {
    const from = Math.max(begin, day.begin_us);
    const to = Math.min(end, day.end_us);
    if (to <= from) continue;
    const edges = [from, ...cuts.filter((cut) => cut > from && cut < to), to];
    for (let edge = 0; edge + 1 < edges.length; edge++) {
      const [a, b] = [edges[edge]!, edges[edge + 1]!];
      const pass = by >= 0 || a < turn + by || a >= turn - by ? 'only' : a < turn ? 'first' : 'second';
      const from_us = sinceMidnight(day, a);
      pieces.push({ from_us, to_us: Math.min(from_us + b - a, DAY_US), what, pass });
    }
  }
  return pieces;
}

/** The intervals that touch a day, unchanged. */
export function touching(day: DateView, spans: readonly Span[]): Span[] {
  return spans.filter(([begin, end]) => begin < day.end_us && end > day.begin_us);
}

/** Durations by name, in the order of the names; `named` gives the name of an interval's number. */
export function totals(day: DateView, spans: readonly Span[], named: (what: number) => string): Map<string, number> {
  const all = new Map<string, number>();
  for (const [begin, end, what] of spans) {
    const lasts = Math.min(end, day.end_us) - Math.max(begin, day.begin_us);
    if (lasts > 0) all.set(named(what), (all.get(named(what)) ?? 0) + lasts);
  }
  return all;
}

/** Firings of motion sensors in each hour of an average day. */
export function meanHours(view: Pick<MonthView, 'hours'>): number[] {
  const days = Math.max(view.hours.length, 1);
  return Array.from({ length: 24 }, (_, hour) => view.hours.reduce((sum, hours) => sum + (hours[hour] ?? 0), 0) / days);
}

/** The clock change of a day: `Clocks go forward by 1 h.` */
export function turnOf(day: DateView): string {
  if (day.turn === null) return '';
  const hours = Math.abs(day.turn[1]) / 3_600_000_000;
  return `Clocks go ${day.turn[1] > 0 ? 'forward' : 'back'} by ${Number(hours.toFixed(2))} h.`;
}

const short = new Intl.DateTimeFormat('en-GB', { timeZone: 'UTC', weekday: 'short', day: 'numeric', month: 'short' });
const dated = new Intl.DateTimeFormat('en-GB', { timeZone: 'UTC', day: 'numeric', month: 'short', year: 'numeric' });

/** `Mon 2 Mar`. */
export function weekday(date: string): string {
  const ms = read(`${date} 00:00:00`);
  return Number.isFinite(ms) ? short.format(ms).replace(',', '') : date.slice(0, 10);
}

export function isWeekend(date: string): boolean {
  const day = new Date(read(`${date} 00:00:00`)).getUTCDay();
  return day === 0 || day === 6;
}

/** The date a number of days after another, `2 Mar 2009`; empty for an invalid date. */
export function dateAfter(date: string, days: number): string {
  const ms = read(`${date} 00:00:00`) + days * 86_400_000;
  return Number.isFinite(ms) ? dated.format(ms) : '';
}

/** From one date to another: `2–29 Mar 2009`. */
export function datesFrom(first: string, last: string): string {
  const [from, to] = [first, last].map((date) => read(`${date} 00:00:00`)) as [number, number];
  return Number.isFinite(from) && Number.isFinite(to) ? dated.formatRange(from, to).replace(/\s*–\s*/, ' – ') : '';
}

/** `07:05`, from microseconds since midnight. */
export function clock(since_midnight_us: number): string {
  const minutes = Math.floor(since_midnight_us / 60e6);
  return `${twoDigits(Math.floor(minutes / 60) % 24)}:${twoDigits(minutes % 60)}`;
}
