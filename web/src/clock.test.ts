import { expect, test } from 'vitest';
import { date, field, read, time, words } from './clock';

const CLOCK = '2009-03-02 07:12:03';

test('a clock is said again as it is, wherever the reader lives', () => {
  expect(words(read(CLOCK))).toBe('2 March, 07:12:03');
  expect(date(read(CLOCK))).toBe('Mon, 2 March 2009');
  expect(time(read(CLOCK))).toBe('07:12:03');
  expect(field(read(CLOCK))).toBe('2009-03-02T07:12:03');
  expect(words(read('2009-03-02 00:00:00'))).toBe('2 March, 00:00:00');
});

test('what is no clock is said as nothing', () => {
  expect([words(read('later')), date(NaN), time(NaN), field(NaN)]).toEqual(['', '', '', '']);
});
