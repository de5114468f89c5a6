import { expect, test } from 'vitest';
import { clockAt, date, dayOf, field, read, time, words } from './clock';

const CLOCK = '2009-03-02 07:12:03';

test('a clock is said again as it is, wherever the reader lives', () => {
  expect(words(read(CLOCK))).toBe('2 March, 07:12:03');
  expect(date(read(CLOCK))).toBe('Mon, 2 March 2009');
  expect(time(read(CLOCK))).toBe('07:12:03');
  expect(field(read(CLOCK))).toBe('2009-03-02T07:12:03');
  expect(words(read('2009-03-02 00:00:00'))).toBe('2 March, 00:00:00');
});

test('another instant is as far on the clock', () => {
  expect(words(clockAt(0, 3_600_000_000, CLOCK))).toBe('2 March, 06:12:03');
  expect(words(clockAt(86_400_000_000, 0, CLOCK))).toBe('3 March, 07:12:03');
});

test('what is no clock is said as nothing', () => {
  expect([words(read('later')), date(NaN), time(NaN), field(NaN)]).toEqual(['', '', '', '']);
});

test('days of a run are counted from one, and the end is in the last', () => {
  const day = 86_400_000_000;
  expect(dayOf(0, 90 * day)).toBe('day 1 of 90');
  expect(dayOf(day, 90 * day)).toBe('day 2 of 90');
  expect(dayOf(90 * day, 90 * day)).toBe('day 90 of 90');
  expect(dayOf(5, 10)).toBe('day 1 of 1');
});
