import { expect, test } from 'vitest';
import { storedRun, walkedDay, walkedRun } from '../../testing/stored';
import { prepare } from './day';
import { BETWEEN, OUT, chanceOf, chancesAt, uncertaintyOf, likely, percent, placeName, sureOf } from './uncertainty';
import { drawingOf } from './stored';
import { Ticker } from './ticker';

const run = walkedRun('week');
const life = walkedDay(run, 0).lives[0]!;
const MINUTE = 60e6;

test('what changes at one instant is one change, and chances come to 1', () => {
  const doubt = uncertaintyOf(run, { ...life, chances: [[0, 4, 1], [MINUTE, 4, 0.48], [MINUTE, 2, 0.48], [2 * MINUTE, 4, 0], [2 * MINUTE, OUT, 0.2]] });
  expect([...doubt.at]).toEqual([0, MINUTE, 2 * MINUTE]);
  const now = chancesAt(doubt, MINUTE)!;
  expect([chanceOf(now, 4), chanceOf(now, 2), chanceOf(now, OUT), chanceOf(now, BETWEEN)]).toEqual([0.5, 0.5, 0, 0]);
  expect(chancesAt(doubt, -1)).toBeNull();
  expect(chanceOf(chancesAt(doubt, 9 * MINUTE)!, 2)).toBeCloseTo(0.48 / 0.68);
});

test('who is in a room is as sure as that room, and who is on the way as sure as the likeliest place', () => {
  const doubt = uncertaintyOf(run, { ...life, chances: [[0, 4, 0.7], [0, 2, 0.3]] });
  const now = chancesAt(doubt, 0)!;
  expect(sureOf(now, 2)).toBeCloseTo(0.3);
  expect(sureOf(now, null)).toBeCloseTo(0.7);
  expect(likely(now).map(([place]) => place)).toEqual([4, 2]);
  expect([placeName(run.home, OUT), placeName(run.home, BETWEEN), placeName(run.home, 4)]).toEqual(['out', 'between rooms', run.home.rooms[4]!.name]);
  expect([1, 0.996, 0.5].map(percent)).toEqual(['100 %', '99 %', '50 %']);
});

const sight = { from_us: 0, to_us: run.days[0]!.end_us };

test('a day has a shade for each room and for being out, as dark as they are likely; that of a run has what was done', () => {
  const day = prepare(run, 0, walkedDay(run, 0));
  const drawing = drawingOf(run, sight, [day], true);
  const [bedroom, out] = [run.home.rooms[4]!.name, 'out'].map((name) => drawing.shades!.find((shade) => shade.name === name)!.by[0]!);
  expect(bedroom!.map(([, , chance]) => Math.round(chance * 10))).toEqual([10, 6]);
  expect(out!.map(([begin, end]) => (end - begin) / MINUTE)).toEqual([10]);
  expect(drawing.shades).toHaveLength(run.home.rooms.length + 1);
  expect(drawingOf(run, sight, [day], false).shades).toEqual([]);
  const lived = storedRun('lived');
  expect(drawingOf(lived, sight, [null], true).bands.map(({ names }) => names)).toEqual([lived.activities, lived.activities]);
});

test('from room to room is gone by the stays', () => {
  const ticker = new Ticker({ view: run, at: () => null } as never);
  ticker.go(0);
  expect(ticker.activity(true)).toBe(true);
  expect(ticker.now_us).toBe(run.walk!.stays[0]![1]![0]);
});
