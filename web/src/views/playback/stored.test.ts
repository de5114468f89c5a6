import { expect, test } from 'vitest';
import { countIn } from '../../charts/lanes';
import { storedDay, storedRun } from '../../testing/stored';
import type { DayView } from '../../wire';
import { prepare } from './day';
import { daysIn, drawingOf, wholeOf } from './stored';

const HOUR = 3_600_000_000;
const DAY = 24 * HOUR;
const run = storedRun('one', 3, { values: ['ON', 'OFF', '20.5', '21.0', '19'] });
const day = (number: number, rows: DayView['rows']) => prepare(run, number, { ...storedDay(run, number), rows });

test('a sensor that says numbers is a curve, one that says words is not', () => {
  const one = day(0, [[HOUR, 0, 2], [2 * HOUR, 0, 3], [3 * HOUR, 0, 4], [HOUR, 1, 0], [2 * HOUR, 1, 2], [HOUR, 2, 2], [2 * HOUR, 2, 3]]);
  const { lanes } = drawingOf(run, { from_us: 0, to_us: DAY }, [one], true);
  expect(lanes[0]!.curve).toMatchObject({ low: 19, high: 21 });
  expect(Array.from(lanes[0]!.curve!.values)).toEqual([20.5, 21, 19]);
  expect([lanes[1]!.curve, lanes[2]!.curve]).toEqual([undefined, undefined]);
  expect([lanes[1]!.said!(0), lanes[1]!.said!(1), lanes[0]!.place]).toEqual(['ON', '20.5', run.home.sensors[0]!.room]);
});

test('days that lie side by side are one drawing, and what goes on over midnight is drawn once', () => {
  const two = [day(0, [[HOUR, 0, 0]]), day(1, [[DAY + HOUR, 0, 0]])];
  const sleeps: [number, number, number] = [DAY - HOUR, DAY + HOUR, 0];
  for (const one of two) one.view.lives[0]!.activities = [sleeps];
  const sight = { from_us: 20 * HOUR, to_us: 30 * HOUR };
  expect(daysIn(run, sight)).toEqual([0, 1]);
  const { bands, lanes } = drawingOf(run, sight, two, true, { rooms: true });
  expect(bands[0]!.spans).toEqual([sleeps]);
  expect(bands.filter(({ isRoom }) => isRoom)).toHaveLength(2);
  expect([lanes[0]!.fired.length, countIn(lanes[0]!, sight)]).toEqual([2, 1]);
});

test('a run as a whole is counts and its longest activities, without the truth counts alone', () => {
  const counts = run.sensors.map((_, sensor) => Array.from({ length: 72 }, () => sensor));
  const sight = { from_us: 0, to_us: 3 * DAY };
  const whole = wholeOf({ view: run, whole: { bucket_us: HOUR, counts } }, true);
  expect([whole.bands.length, countIn(whole.lanes[2]!, sight)]).toEqual([2, 144]);
  expect(wholeOf({ view: run, whole: null }, false).bands).toEqual([]);
  expect(wholeOf({ view: run, whole: null }, false).lanes[2]!.density).toBeUndefined();
});
