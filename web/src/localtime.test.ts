import { expect, test } from 'vitest';
import { clockOf, dayOf, follow, instantOf, livedOf } from './localtime';
import { date, daysFrom } from './testing/dates';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;

test('clocks that are set at midnight', () => {
  const forward = { days: [date('2009-03-06', 0), date('2009-03-07', DAY, 23, { turn: [DAY, HOUR] })], length_us: 47 * HOUR };
  const back = { days: [date('2009-03-06', 0, 25, { turn: [DAY, -HOUR] }), date('2009-03-07', 25 * HOUR, 23)], length_us: 48 * HOUR };
  for (const calendar of [forward, back]) {
    for (const at of [0, 23.9 * HOUR, 26 * HOUR, 40 * HOUR]) expect(instantOf(calendar, clockOf(calendar, at))).toBe(at);
  }
  expect(clockOf(forward, DAY)).toBe(Date.parse('2009-03-07T01:00:00Z'));
  expect([DAY, 25 * HOUR].map((at) => clockOf(back, at))).toEqual(['2009-03-06T23:00:00Z', '2009-03-07T00:00:00Z'].map(Date.parse));
});

test('an hour that the clock leaves out is not lived, and one that comes twice is lived twice', () => {
  const spring = date('2009-03-08', 0, 23, { turn: [2 * HOUR, HOUR] });
  expect([1, 2, 3, 23].map((hour) => livedOf(spring, hour, DAY))).toEqual([HOUR, 0, HOUR, HOUR]);
  const autumn = date('2009-11-01', 0, 25, { turn: [2 * HOUR, -HOUR] });
  expect([0, 1, 2].map((hour) => livedOf(autumn, hour, 2 * DAY))).toEqual([HOUR, 2 * HOUR, HOUR]);
  const noon = date('2009-03-06', 0, 12, { clock_us: 12 * HOUR });
  expect([11, 12, 23].map((hour) => livedOf(noon, hour, DAY))).toEqual([0, HOUR, HOUR]);
  expect([12, 13, 14].map((hour) => livedOf(noon, hour, 1.5 * HOUR))).toEqual([HOUR, HOUR / 2, 0]);
});

test('a run follows another by the date, or where they share none, by the number of the day', () => {
  const of = (from: string, days: number) => ({ days: daysFrom(from, days * DAY), length_us: days * DAY });
  const first = of('2009-03-06', 3);
  expect([0, 1, 2].map((day) => follow(first, day * DAY + HOUR, of('2009-03-07', 2)))).toEqual([null, HOUR, DAY + HOUR]);
  expect([0, 1, 2].map((day) => follow(first, day * DAY + HOUR, of('2019-03-06', 2)))).toEqual([HOUR, DAY + HOUR, null]);
  expect(follow(first, HOUR, { days: [], length_us: 0 })).toBeNull();
});

test('days are counted from one, by the calendar, and the end is in the last', () => {
  const run = { days: daysFrom('2009-03-06', 2 * DAY, 12 * HOUR) };
  expect([0, 12 * HOUR - 1, 12 * HOUR, 2 * DAY].map((at) => dayOf(run, at))).toEqual(['day 1 of 3', 'day 1 of 3', 'day 2 of 3', 'day 3 of 3']);
  expect(dayOf({ days: [] }, 0)).toBe('');
});
