import { expect, test } from 'vitest';
import { Server } from '../../server';
import { date } from '../../testing/dates';
import { fakeRuns, storedDay, storedRun } from '../../testing/stored';
import type { PersonDay, PlaybackView } from '../../wire';
import { bodyAt } from './bodies';
import { counts, gaps, lit, prepare } from './day';
import { heatOf } from './heat';
import { clockOf, dayAt, follow, instantOf } from '../../localtime';
import { Stored } from './stored';
import { Ticker } from './ticker';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;
const clock = (run: PlaybackView, at: number) => new Date(clockOf(run, at)).toISOString().slice(0, 19);

async function opened(run = storedRun('one')): Promise<Stored> {
  const stored = await Stored.open(new Server('t', () => {}, fakeRuns([run.name], () => run)), run.name);
  await Promise.all(run.days.map((_, number) => stored.day(number)));
  return stored;
}

test('a run that begins at noon, and clocks that are set, show the right time', () => {
  const run = storedRun('one', 0, {
    length_us: 59 * HOUR,
    days: [date('2009-03-07', 0, 12, { clock_us: 12 * HOUR }), date('2009-03-08', 12 * HOUR, 23, { turn: [14 * HOUR, HOUR] }), date('2009-03-09', 35 * HOUR)],
  });
  expect([0, 12 * HOUR - 1, 12 * HOUR, 35 * HOUR, 59 * HOUR].map((at) => dayAt(run, at))).toEqual([0, 0, 1, 2, 2]);
  expect(clock(run, 0)).toBe('2009-03-07T12:00:00');
  expect(clock(run, 13.5 * HOUR)).toBe('2009-03-08T01:30:00');
  expect(clock(run, 14 * HOUR)).toBe('2009-03-08T03:00:00');
  expect(clock(run, 34.5 * HOUR)).toBe('2009-03-08T23:30:00');
  for (const at of [0, 13.5 * HOUR, 14 * HOUR, 20 * HOUR, 35 * HOUR, 50 * HOUR]) expect(instantOf(run, clockOf(run, at))).toBe(at);
  expect(instantOf(run, Date.parse('2009-03-07T11:00:00Z'))).toBeNull();
  expect(instantOf(run, Date.parse('2009-03-10T11:00:00Z'))).toBeNull();
});

test('two runs follow one clock: the same date where both know it, else the same day by its number', () => {
  const one = storedRun('one', 3);
  const late = storedRun('late', 2, { days: [date('2009-03-03', 0), date('2009-03-04', DAY)], length_us: 2 * DAY });
  expect(follow(one, DAY + 7 * HOUR, late)).toBe(7 * HOUR);
  expect(follow(one, 7 * HOUR, late)).toBeNull();
  const other = storedRun('other', 1, { days: [date('2011-07-01', 0, 14, { clock_us: 10 * HOUR })], length_us: 14 * HOUR });
  expect(follow(one, 11 * HOUR, other)).toBe(HOUR);
  expect(follow(one, 9 * HOUR, other)).toBeNull();
  expect(follow(one, DAY + 11 * HOUR, other)).toBeNull();
});

test('strides are walked evenly, and who rests faces where the last one led', () => {
  const run = storedRun('one');
  const life: PersonDay = {
    chances: [],
    movements: [
      [0, 10, 'stride', 'standing', [0, 0], [0, 2]],
      [10, 20, 'rest', 'sitting', [0, 2], [0, 2]],
      [20, 30, 'away', 'standing', null, null],
    ],
    rooms: [[0, 15, 3]],
    activities: [[5, 20, 1]],
  };
  expect(bodyAt(run, life, 5)).toEqual({ at: [0, 1], heading_deg: 90, posture: 'standing', room: 3, activity: 'cooking' });
  expect(bodyAt(run, life, 16)).toEqual({ at: [0, 2], heading_deg: 90, posture: 'sitting', room: null, activity: 'cooking' });
  expect(bodyAt(run, life, 25)).toBeNull();
  expect(bodyAt(run, life, 31)).toBeNull();
  expect(bodyAt(run, { ...life, movements: [] }, 5)).toBeNull();
});

test('a sensor is lit for two seconds of the run, and OFF lights none', () => {
  const run = storedRun('one', 1, { sensors: ['a', 'b'] });
  const day = prepare(run, 0, { rows: [[10e6, 0, 0], [11e6, 1, 1], [20e6, 0, 0]], lives: [], until_us: DAY });
  expect([9e6, 10e6, 11.9e6, 12e6, 20.5e6].map((at) => lit(day, at))).toEqual([[], [0], [0], [], [0]]);
  expect(counts(day, 20e6)).toEqual([2, 0]);
});

test('stillness is more than a minute in which nothing fires and nobody strides', () => {
  expect(gaps([[0, 10e6], [5e6, 100e6], [160e6, 160e6], [221e6, 221e6]], 0, 300e6)).toEqual([[160e6, 221e6], [221e6, 300e6]]);
  const run = storedRun('one', 1);
  const day = prepare(run, 0, {
    rows: [[100e6, 0, 0]],
    until_us: DAY,
    lives: [{ movements: [[300e6, 400e6, 'stride', 'standing', [0, 0], [1, 1]], [400e6, 900e6, 'in_place', 'lying', [0, 0], [0, 0]]], rooms: [], activities: [], chances: [] }],
  });
  expect(day.quiet).toEqual([[0, 100e6], [100e6, DAY]]);
  expect(day.still).toEqual([[0, 100e6], [100e6, 300e6], [400e6, DAY]]);
});

test('skipping stillness jumps to what happens next, and without it time just goes by', async () => {
  const ticker = new Ticker(await opened());
  ticker.play();
  ticker.step(1);
  expect(ticker.now_us).toBe(1e6);
  ticker.skip = true;
  ticker.step(0.1);
  expect(ticker.now_us).toBe(7 * HOUR);
  ticker.step(1);
  expect(ticker.now_us).toBe(7 * HOUR + 1e6);
});

test('a day that is not here yet is waited for, and none is jumped over', async () => {
  const run = storedRun('one', 3);
  const stored = await Stored.open(new Server('t', () => {}, fakeRuns(['one'], () => run)), 'one');
  const ticker = new Ticker(stored);
  ticker.play();
  ticker.step(1);
  expect(ticker.now_us).toBe(0);
  await stored.day(0);
  ticker.speed = 1000;
  ticker.step(3600);
  expect(ticker.now_us).toBe(DAY);
  ticker.step(1);
  expect(ticker.now_us).toBe(DAY);
});

test('at the end it stops, and plays again from the beginning of the day', async () => {
  const ticker = new Ticker(await opened());
  ticker.go(Infinity);
  expect(ticker.now_us).toBe(0);
  ticker.go(3 * DAY - 1e6);
  ticker.play();
  ticker.step(5);
  expect([ticker.now_us, ticker.playing, ticker.over]).toEqual([3 * DAY, false, true]);
  ticker.play();
  expect([ticker.now_us, ticker.playing]).toEqual([2 * DAY, true]);
});

test('days are turned at the same time on the clock, and activities are gone to in order', async () => {
  const ticker = new Ticker(await opened());
  ticker.go(8 * HOUR);
  ticker.turn(1);
  expect(ticker.now_us).toBe(DAY + 8 * HOUR);
  ticker.activity(true);
  expect(ticker.now_us).toBe(DAY + 12 * HOUR);
  ticker.activity(false);
  expect(ticker.now_us).toBe(DAY);
  ticker.turn(-1);
  ticker.turn(-1);
  expect(ticker.now_us).toBe(0);
  expect(ticker.activity(false)).toBe(false);
  ticker.turn(9);
  ticker.turn(1);
  expect(ticker.now_us).toBe(3 * DAY);
});

test('heat is the time of the day, by the truth and by sensors alone', () => {
  const run = storedRun('one');
  const day = prepare(run, 1, storedDay(run, 1));
  const sum = (all: Float64Array) => all.reduce((a, b) => a + b, 0);
  // Both are at home but for the last hour.
  expect(sum(heatOf(run, day, true).seconds)).toBeCloseTo(2 * 23 * 3600, 3);
  const alone = heatOf(run, day, false);
  expect(sum(alone.seconds)).toBeGreaterThan(60 * 60);
  expect(alone.words.every(([name]) => run.home.sensors.some((sensor) => sensor.name === name))).toBe(true);
});

test('of a run whose log is still read a day is shown once it has come, and the rest grows', async () => {
  const [early, whole] = [storedRun('long', 3, { values: ['ON'], read_us: 2 * HOUR }), storedRun('long', 3)];
  const asked: string[] = [];
  let read_us: number | null = 2 * HOUR;
  const fetch = fakeRuns(['long'], () => whole);
  const server = new Server('t', () => {}, async (path, init) => {
    asked.push(path);
    if (path.endsWith('/reading')) {
      read_us = read_us === null || read_us > DAY ? null : read_us + DAY;
      return Response.json({ read_us });
    }
    return path === '/api/runs/long' ? Response.json(read_us === null ? whole : { ...early, read_us }) : fetch(path, init);
  });
  const stored = await Stored.open(server, 'long');
  const shares: number[] = [];
  const { home } = stored.view;
  await stored.day(0, (share) => shares.push(share));
  expect(shares).toEqual([2 / 24]);
  expect([stored.view.values, stored.view.read_us, stored.view.home === home]).toEqual([['ON'], 26 * HOUR, true]);
  expect(asked.slice(0, 3)).toEqual(['/api/runs/long', '/api/runs/long/reading', '/api/runs/long/days/0']);
  await stored.readAll(() => true, (share) => shares.push(share));
  expect([shares.at(-1), stored.view.values, stored.view.read_us]).toEqual([1, ['ON', 'OFF'], null]);
  const before = asked.length;
  await stored.readAll(() => true, () => {});
  expect(asked).toHaveLength(before);
});
