import { expect, test } from 'vitest';
import { Announcer } from './announce';

test('one sentence in five seconds, whatever fires', () => {
  const announcer = new Announcer();
  const said: number[] = [];
  for (let at = 0; at < 30_000; at += 10) {
    announcer.fired(`sensor ${at % 70}`);
    if (announcer.due(at) !== null) said.push(at);
  }
  expect(said).toEqual([0, 5000, 10_000, 15_000, 20_000, 25_000]);
});

test('it names the sensors that fired most, and counts the others', () => {
  const announcer = new Announcer();
  for (const [name, times] of [['hall', 1], ['kitchen', 3], ['bed', 2], ['stove', 2], ['bath', 1], ['study', 1]] as const) {
    for (let time = 0; time < times; time++) announcer.fired(name);
  }
  expect(announcer.due(0)).toBe('New events: kitchen 3 times, bed 2 times, stove 2 times, hall and 2 other sensors.');
});

test('nothing is said of nothing, and nothing twice', () => {
  const announcer = new Announcer();
  expect(announcer.due(0)).toBeNull();
  announcer.fired('hall');
  expect(announcer.due(10)).toBe('New events: hall.');
  expect(announcer.due(6000)).toBeNull();
});
