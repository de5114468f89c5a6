import { expect, test } from 'vitest';
import { date } from '../../testing/dates';
import { storedDay, storedRun } from '../../testing/stored';
import { prepare } from './day';
import { heatMore, heatOf } from './heat';
import { drawingOf } from './stored';
import { dayBeside, hoursMore, lacking, pairsOf, spent } from './twin';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;
const one = storedRun('one');
const day = prepare(one, 0, storedDay(one, 0));
const busiest = day.fired.reduce((most, fired, sensor) => (fired.length > day.fired[most]!.length ? sensor : most), 0);
/** The same day without the first firing of the busiest sensor, and with one more of its own. */
const twin = storedRun('two');
const other = (() => {
  const view = storedDay(twin, 0);
  const gone = view.rows.findIndex(([, sensor]) => sensor === busiest);
  const rows = view.rows.filter((_, index) => index !== gone);
  rows.push([DAY - 2, busiest, 0]);
  return prepare(twin, 0, { ...view, rows });
})();

test('a firing stands for one of the other run that is near; what has none is lacking there', () => {
  expect(lacking([10, 20, 30], [11, 31], 2)).toEqual([20]);
  expect(lacking([10, 11], [10], 2)).toEqual([11]);
  expect(lacking([5], [8], 2)).toEqual([5]);
  expect(lacking([], [8], 2)).toEqual([]);
});

test('what one run has and the other lacks is told by sensor; the same run twice lacks nothing', () => {
  const pair = pairsOf(one, day, twin, other, 0)[busiest]!;
  expect([pair.onlyFirst.length, pair.onlySecond]).toEqual([1, [DAY - 2]]);
  const same = pairsOf(one, day, twin, prepare(twin, 0, storedDay(twin, 0)), 0);
  expect(same.flatMap(({ onlyFirst, onlySecond }) => [...onlyFirst, ...onlySecond])).toEqual([]);
});

test('a sensor that only the second run has is a lane of its own, and what is not here yet lacks nothing', () => {
  const more = storedRun('more', 3, { home: { ...twin.home, sensors: twin.home.sensors.map((sensor, index) => (index === busiest ? { ...sensor, name: 'a new one' } : sensor)) } });
  const pairs = pairsOf(one, day, more, other, 0);
  expect(pairs).toHaveLength(one.sensors.length + 1);
  expect(pairs.at(-1)!.name).toBe('a new one');
  expect(pairs.at(-1)!.onlySecond).toHaveLength(other.fired[busiest]!.length);
  expect(pairsOf(one, day, twin, null, 0).every(({ onlyFirst }) => onlyFirst.length === 0)).toBe(true);
});

test('lanes and bands of both runs are by the first one’s time', () => {
  const late = storedRun('late', 3, { days: [date('2009-03-01', 0), date('2009-03-02', DAY), date('2009-03-03', 2 * DAY)] });
  expect(dayBeside(one, 0, late)).toEqual({ number: 1, later_us: DAY });
  expect(dayBeside(one, 2, late)).toBeNull();
  const there = prepare(late, 1, storedDay(late, 1));
  const drawing = drawingOf(one, { from_us: 0, to_us: DAY }, [day], true, { others: [{ view: late, day: there, later_us: DAY }] });
  expect(drawing.bands).toHaveLength(4);
  expect(drawing.bands[1]!.spans.map(([begin]) => begin)).toEqual(drawing.bands[0]!.spans.map(([begin]) => begin));
  expect(Math.min(...drawing.lanes.flatMap(({ beside }) => [...Array.from(beside!.fired)]))).toBeLessThan(DAY);
});

test('time in rooms and hours of the log differ by what the second has more', () => {
  const shorter = prepare(twin, 0, { ...storedDay(twin, 0), lives: storedDay(twin, 0).lives.map((life) => ({ ...life, rooms: [[0, 6 * HOUR, 4], [6 * HOUR, 7 * HOUR, 0]] })) });
  const rows = spent(one, day, twin, shorter, 'rooms');
  expect(rows.map(({ name, first, second }) => [name, (second - first) / 3600])).toEqual([[one.home.rooms[4]!.name, -2], [one.home.rooms[0]!.name, 2]]);
  const busier = storedRun('busier', 2, { hours: [one.hours[0]!.map((count) => count + 1), one.hours[1]!] });
  expect(hoursMore(one, busier).map((hours) => hours?.reduce((a, b) => a + b, 0) ?? null)).toEqual([24, 0, null]);
});

test('heat differs by what the second has more, in homes of one size alone', () => {
  const [first, second] = [heatOf(one, day, false), heatOf(twin, other, false)];
  const more = heatMore(one, first, twin, second)!;
  expect(more.isMore && more.most).toBeGreaterThan(0);
  expect(heatMore(one, first, twin, first)!.most).toBe(0);
  const wider = { ...twin, home: { ...twin.home, bounds: [[0, 0], [50, 50]] as typeof twin.home.bounds } };
  expect(heatMore(one, first, wider, second)).toBeNull();
});
