import { expect, test } from 'vitest';
import { sinceMidnight } from '../../localtime';
import { date } from '../../testing/dates';
import { type Span, clock, dateAfter, datesFrom, isWeekend, meanHours, piecesOf, totals, turnOf, weekday } from './days';
import { clockHours } from './draw';

const HOUR = 3_600_000_000;
const plain = date('2009-03-02', 0);
const short = date('2009-03-08', 0, 23, { turn: [2 * HOUR, HOUR] });
const long = date('2009-11-01', 0, 25, { turn: [2 * HOUR, -HOUR] });

const hours = (day: typeof plain, spans: Span[]) => piecesOf(day, spans).map(({ from_us, to_us, pass }) => [from_us / HOUR, to_us / HOUR, pass]);

test('what lies across midnight is cut there', () => {
  expect(hours(plain, [[-2 * HOUR, 7 * HOUR, 0], [23 * HOUR, 30 * HOUR, 0], [30 * HOUR, 31 * HOUR, 0]])).toEqual([[0, 7, 'only'], [23, 24, 'only']]);
});

test('where clocks go forward an hour is left out', () => {
  expect(hours(short, [[0, 5 * HOUR, 0]])).toEqual([[0, 2, 'only'], [3, 6, 'only']]);
});

test('where clocks go back an hour comes twice', () => {
  expect(hours(long, [[0, 5 * HOUR, 0]])).toEqual([[0, 1, 'only'], [1, 2, 'first'], [1, 2, 'second'], [2, 4, 'only']]);
  expect(hours(long, [[23 * HOUR, 25 * HOUR, 0]])).toEqual([[22, 24, 'only']]);
});

test('a run that begins at noon begins at noon', () => {
  const noon = date('2009-03-02', 0, 12, { clock_us: 12 * HOUR });
  expect(hours(noon, [[0, HOUR, 0]])).toEqual([[12, 13, 'only']]);
  expect(clock(sinceMidnight(noon, 90 * 60e6))).toBe('13:30');
});

test('hours of the clock are as long as they were', () => {
  const of = (day: typeof plain) => clockHours({ days: [day] }, day).map(([from, to, hour]) => [hour, (to - from) / HOUR]);
  expect(of(plain)).toEqual(Array.from({ length: 24 }, (_, hour) => [hour, 1]));
  expect(of(short).map(([hour]) => hour)).not.toContain(2);
  expect(of(long).slice(0, 3)).toEqual([[0, 1], [1, 2], [2, 1]]);
});

test('times are added up within the day', () => {
  const all = totals(plain, [[-HOUR, HOUR, 0], [2 * HOUR, 3 * HOUR, 1], [4 * HOUR, 5 * HOUR, 0]], (what) => ['sleep', 'out'][what]!);
  expect([...all]).toEqual([['sleep', 2 * HOUR], ['out', HOUR]]);
});

test('days in words', () => {
  expect(weekday('2009-03-02')).toBe('Mon 2 Mar');
  expect([isWeekend('2009-03-02'), isWeekend('2009-03-08')]).toEqual([false, true]);
  expect(dateAfter('2009-03-30', 2)).toBe('1 Apr 2009');
  expect([dateAfter('no date', 1), weekday('no date')]).toEqual(['', 'no date']);
  expect([datesFrom('2009-03-02', '2009-03-29'), datesFrom('2009-03-02', '2009-04-01'), datesFrom('', '')]).toEqual(['2 – 29 Mar 2009', '2 Mar – 1 Apr 2009', '']);
  expect([turnOf(short), turnOf(long), turnOf(plain)]).toEqual(['Clocks go forward by 1 h.', 'Clocks go back by 1 h.', '']);
});

test('an average day', () => {
  const day = (count: number) => Array.from({ length: 24 }, () => count);
  expect(meanHours({ hours: [day(2), day(4)] })[5]).toBe(3);
  expect(meanHours({ hours: [] })[0]).toBe(0);
});
