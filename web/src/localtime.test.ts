import { expect, test } from 'vitest';
import { calendarOf, clockOf, dayOf, instantOf, livedOf } from './localtime';
import { date } from './testing/stored';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;

test('the days of a run follow from its start and the clocks that are set in it', () => {
  expect(calendarOf({ start: '2009-03-06 12:00:00', length_us: 3 * DAY, turns: [[38 * HOUR, HOUR]] }).days).toEqual([
    date('2009-03-06', 0, 12, { clock_us: 12 * HOUR }),
    date('2009-03-07', 12 * HOUR),
    // Set forward at two, two hours into it.
    { ...date('2009-03-08', 36 * HOUR, 23), turn: [38 * HOUR, HOUR] },
    date('2009-03-09', 59 * HOUR, 13),
  ]);
  expect(calendarOf({ start: '2009-03-06 12:00:00', length_us: 5 * HOUR, turns: [] }).days).toEqual([date('2009-03-06', 0, 5, { clock_us: 12 * HOUR })]);
  expect(calendarOf({ start: 'no time', length_us: DAY, turns: [] }).days).toEqual([]);
});

test('clocks that are set at midnight', () => {
  const forward = calendarOf({ start: '2009-03-06 00:00:00', length_us: 2 * DAY, turns: [[DAY, HOUR]] });
  expect(forward.days.slice(0, 2)).toEqual([date('2009-03-06', 0), date('2009-03-07', DAY, 23, { clock_us: HOUR })]);
  const back = calendarOf({ start: '2009-03-06 00:00:00', length_us: 2 * DAY, turns: [[DAY, -HOUR]] });
  expect(back.days.slice(0, 2)).toEqual([date('2009-03-06', 0, 25, { turn: [DAY, -HOUR] }), date('2009-03-07', 25 * HOUR, 23)]);
  for (const calendar of [forward, back]) {
    for (const at of [0, 23.9 * HOUR, 26 * HOUR, 40 * HOUR]) expect(instantOf(calendar, clockOf(calendar, at))).toBe(at);
  }
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

test('days are counted from one, by the calendar, and the end is in the last', () => {
  const run = calendarOf({ start: '2009-03-06 12:00:00', length_us: 2 * DAY, turns: [] });
  expect([0, 12 * HOUR - 1, 12 * HOUR, 2 * DAY].map((at) => dayOf(run, at))).toEqual(['day 1 of 3', 'day 1 of 3', 'day 2 of 3', 'day 3 of 3']);
  expect(dayOf({ days: [] }, 0)).toBe('');
});
