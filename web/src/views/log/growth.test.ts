import { expect, test } from 'vitest';
import { countAt, datesOf, scaleOf, words } from '../../charts/density';
import { madeUpRun } from '../../testing/home';
import { daysFrom } from '../../testing/dates';
import type { RunView } from '../../wire';
import { Growth, grown, lanesOf } from './growth.svelte';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;
const run: RunView = { ...madeUpRun(1, 3), days: daysFrom('2009-03-02', 3 * DAY), length_us: 3 * DAY };

test('what is not lived yet is no data, and an hour without a firing is none', () => {
  const now = grown(run, { hours: [[5, 0, 7], [9]], today: [[DAY + 5, 1], [DAY + 9, 2], [DAY + 9, 1]], left_out: 4 }, DAY + HOUR / 2);
  const { density } = now;
  expect([countAt(density, 0, 0), countAt(density, 0, 1), countAt(density, 1, 0), countAt(density, 1, 1), countAt(density, 2, 0)]).toEqual([5, 0, 9, null, null]);
  expect(words(density, 0, 0)).toBe('Mon, 2 March 2009, 00 to 01 h: 5 firings');
  expect(words(density, 0, 1)).toBe('Mon, 2 March 2009, 01 to 02 h: no firings');
  expect(words(density, 2, 7)).toBe('Wed, 4 March 2009, 07 to 08 h: no data');
  expect([now.number, now.leftOut]).toEqual([1, 4]);
  expect(now.fired).toEqual([[], [DAY + 5, DAY + 9], [DAY + 9]]);
});

test('colours change only where a round number is passed', () => {
  expect([[[]], [[0]], [[7]], [[11]], [[199]], [[200]], [[201]], [[612]]].map(scaleOf)).toEqual([10, 10, 10, 20, 200, 200, 500, 1000]);
});

test('dates are written as far apart as they are wide', () => {
  const days = daysFrom('2009-03-02', 90 * DAY);
  expect(datesOf(days, 700).map(({ label }) => label)).toEqual(['2 Mar', '16 Mar', '30 Mar', '13 Apr', '27 Apr', '11 May']);
  expect(datesOf(days.slice(0, 3), 700).map(({ label }) => label)).toEqual(['2 Mar', '3 Mar', '4 Mar']);
});

test('lanes are of sensors, or of kinds with all their firings in order', () => {
  const sensors = [['a', 'motion'], ['b', 'bed'], ['c', 'motion']].map(([name, kind]) => ({ ...run.home.sensors[0]!, name: name!, kind: kind! }));
  expect(lanesOf(sensors, [[1, 5], [2], [3]], false).map(({ name }) => name)).toEqual(['a', 'b', 'c']);
  expect(lanesOf(sensors, [[1, 5], [2], [3]], true)).toEqual([
    { name: 'motion, on a wall', kind: 'motion', fired: [1, 3, 5] },
    { name: 'bed', kind: 'bed', fired: [2] },
  ]);
});

test('it is asked while the run goes on, and once when it does not', async () => {
  let asked = 0;
  const live = {
    run, latest: { now_us: 0 },
    server: { json: async () => ((asked += 1), { hours: [], today: [], left_out: 0 }) },
  };
  const growth = new Growth(live as never);
  await growth.look();
  await growth.look();
  expect(asked).toBe(1);
  live.latest = { now_us: 5 };
  await growth.look();
  expect(asked).toBe(2);
  live.run = { ...run };
  await growth.look();
  expect([asked, growth.now?.run === live.run]).toEqual([3, true]);
});

test('what the server refuses is said, and asked again', async () => {
  let works = false;
  const live = { run, latest: { now_us: 0 }, server: { json: async () => (works ? { hours: [], today: [], left_out: 0 } : Promise.reject(new Error('no run'))) } };
  const growth = new Growth(live as never);
  await growth.look();
  expect([growth.problem, growth.now]).toEqual(['no run', null]);
  works = true;
  await growth.look();
  expect(growth.problem).toBe('');
  expect(growth.now).not.toBeNull();
});
