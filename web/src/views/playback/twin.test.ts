import { expect, test } from 'vitest';
import { countBetween, countIn } from '../../charts/lanes';
import { laneAt } from '../../timeline/read';
import { tableOf } from '../../timeline/table';
import { date, daysFrom } from '../../testing/dates';
import { storedDay, storedRun } from '../../testing/stored';
import { runName } from './run-names';
import { prepare } from './day';
import { heatMore, heatOf } from './heat';
import { drawingOf, wholeOf } from './stored';
import { correspondingDay, hoursMore, withoutCounterpart, pairsOf, spent } from './comparison';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;
const one = storedRun('one');
const day = prepare(one, 0, storedDay(one, 0));
const busiest = day.fired.reduce((most, fired, sensor) => (fired.length > day.fired[most]!.length ? sensor : most), 0);
/** The same day without the first firing of the busiest sensor, and with an additional one. */
const twin = storedRun('two');
const other = (() => {
  const view = storedDay(twin, 0);
  const gone = view.rows.findIndex(([, sensor]) => sensor === busiest);
  const rows = view.rows.filter((_, index) => index !== gone);
  rows.push([DAY - 2, busiest, 0]);
  return prepare(twin, 0, { ...view, rows });
})();

test('a firing stands for one of the other run that is near; what has none is lacking there', () => {
  expect(withoutCounterpart([10, 20, 30], [11, 31], 2)).toEqual([20]);
  expect(withoutCounterpart([10, 11], [10], 2)).toEqual([11]);
  expect(withoutCounterpart([5], [8], 2)).toEqual([5]);
  expect(withoutCounterpart([], [8], 2)).toEqual([]);
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
  expect(correspondingDay(one, 0, late)).toEqual({ number: 1, later_us: DAY });
  expect(correspondingDay(one, 2, late)).toBeNull();
  const there = prepare(late, 1, storedDay(late, 1));
  const drawing = drawingOf(one, { from_us: 0, to_us: DAY }, [day], true, { others: [{ view: late, day: there, later_us: DAY }] });
  expect(drawing.bands).toHaveLength(4);
  expect(drawing.bands[1]!.spans.map(([begin]) => begin)).toEqual(drawing.bands[0]!.spans.map(([begin]) => begin));
  expect(Math.min(...drawing.lanes.flatMap(({ beside }) => [...Array.from(beside!.fired)]))).toBeLessThan(DAY);
});

test('of many days the counts of both runs are by the first one’s time; what the second does not know differs in nothing', () => {
  // The second began a day earlier, has an additional sensor, and ends a day before the first.
  const early = storedRun('early', 3, { days: daysFrom('2009-03-01', 3 * DAY), home: { ...twin.home, sensors: twin.home.sensors.map((sensor, index) => (index === 1 ? { ...sensor, name: 'a new one' } : sensor)) } });
  const whole = { bucket_us: HOUR, counts: one.sensors.map(() => Array.from({ length: 72 }, () => 4)) };
  const other = { bucket_us: HOUR, counts: early.sensors.map((_, sensor) => Array.from({ length: 72 }, (_, part) => (part < 24 ? 100 : part < 48 ? 4 + sensor : 0))) };
  const { bands, lanes } = wholeOf({ view: one, whole }, true, { view: early, whole: other });
  expect(lanes.map(({ name }) => name)).toEqual([...one.sensors.map((_, index) => one.home.sensors[index]!.name), 'a new one']);
  const days = (lane: (typeof lanes)[number]) => [0, 1, 2].map((day) => {
    const of = (counts: typeof lane.density) => countBetween(counts!, day * DAY, (day + 1) * DAY);
    return [of(lane.density), of(lane.densityBeside!.counts), of(lane.densityBeside!.shared)];
  });
  expect(days(lanes[2]!)).toEqual([[96, 24 * 6, 96], [96, 0, 96], [96, 0, 0]]);
  expect([days(lanes[1]!)[0], days(lanes.at(-1)!)[0]]).toEqual([[96, 0, 96], [0, 24 * 5, 0]]);
  expect(countIn(lanes[2]!, { from_us: 0, to_us: DAY })).toBe(96 + 24 * 6);
  expect(laneAt(lanes[2]!, HOUR, HOUR)!.words).toBe('about 8 events here, in the second run 12');
  // Bands are below each other, those of the second a day earlier than in its own time.
  expect(bands.map(({ isBeside, spans }) => [isBeside ?? false, spans[0]![0], spans.length])).toEqual([[false, 0, 6], [true, 0, 4], [false, 0, 6], [true, 0, 4]]);
  const table = tableOf({ from_us: 0, to_us: HOUR }, bands.slice(0, 2), [lanes[2]!], String, { first: 'one', second: 'early' });
  const of = (row: string) => [2, 5].map((column) => row.split(',')[column]);
  expect(table.trim().split('\n').map(of)).toEqual([['what', 'run'], ['activity', 'one'], ['activity beside', 'early'], ['count', 'one'], ['count beside', 'early']]);
  // Until the counts of one arrive, there are none of it.
  expect(wholeOf({ view: one, whole }, true, { view: early, whole: null }).lanes[2]!.densityBeside).toBeUndefined();
  expect(wholeOf({ view: one, whole: null }, true, { view: early, whole: other }).lanes).toHaveLength(lanes.length);
});

test('what sensors of both runs say is read on the time line and is in the table, each by its own run’s values', () => {
  const second = storedRun('two', 3, { values: ['OPEN', 'OFF'] });
  const sight = { from_us: 0, to_us: DAY };
  const { lanes } = drawingOf(one, sight, [day], true, { others: [{ view: second, day: other, later_us: 0 }] });
  const lane = lanes[busiest]!;
  expect(laneAt(lane, day.fired[busiest]![0]!, 1)!.words).toBe('ON');
  expect(laneAt(lane, DAY - 3, 2)!.words).toBe('OPEN in the second run');
  const rows = tableOf(sight, [], [lane], String, { first: 'one', second: 'two' }).trim().split('\n').slice(1).map((row) => row.split(','));
  const said = (run: string) => new Set(rows.filter((row) => row[5] === run).map(([, , what, , said]) => `${what} ${said}`));
  expect([said('one'), said('two')]).toEqual([new Set(['sensor ON']), new Set(['sensor beside OPEN'])]);
});

test('numbers of both runs are curves between the lowest and the highest of both', () => {
  const values = ['ON', 'OFF', '20.5', '21.0', '19', 'warm'];
  const [first, second] = [storedRun('one', 3, { values }), storedRun('two', 3, { values: [...values].reverse() })];
  const rows = (run: typeof first, rows: [number, number, number][]) => prepare(run, 0, { ...storedDay(run, 0), rows });
  const own = rows(first, [[HOUR, 0, 2], [2 * HOUR, 0, 3], [HOUR, 1, 2], [2 * HOUR, 1, 3]]);
  const theirs = rows(second, [[HOUR, 0, 3], [2 * HOUR, 0, 1], [HOUR, 1, 0], [2 * HOUR, 1, 2]]);
  const { lanes } = drawingOf(first, { from_us: 0, to_us: DAY }, [own], true, { others: [{ view: second, day: theirs, later_us: 0 }] });
  const numbers = { curve: lanes[0]!.curve!, beside: lanes[0]!.beside!.curve! };
  expect([Array.from(numbers.curve.values), Array.from(numbers.beside.values)]).toEqual([[20.5, 21], [20.5, 19]]);
  expect([numbers.curve, numbers.beside].map(({ low, high }) => [low, high])).toEqual([[19, 21], [19, 21]]);
  // One has a word as a value, so neither is a curve.
  expect([lanes[1]!.curve, lanes[1]!.beside!.curve]).toEqual([undefined, undefined]);
});

test('twins are called by what they were lived without, behind the name that somebody gave them', () => {
  const run = { name: 'flat-2', about: { title: '', note: '' }, without: ['low_mood', 'insomnia'] };
  expect(runName({ ...run, without: [] })).toBe('flat-2');
  expect(runName(run)).toBe('flat-2 without low mood, insomnia');
  expect(runName({ ...run, about: { title: 'the well one', note: '' } })).toBe('the well one (flat-2) without low mood, insomnia');
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
