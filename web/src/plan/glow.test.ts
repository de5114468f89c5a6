import { expect, test } from 'vitest';
import { Eased, Glow, Pulses, Throttle, isFast } from './glow';

/** Flashes by WCAG 2.3.1: a brightness rises and falls by more than a tenth. */
function flashes(levels: number[]): number {
  let [count, low, high, rising] = [0, levels[0]!, levels[0]!, false];
  for (const level of levels) {
    if (rising) {
      high = Math.max(high, level);
      if (level < high - 0.1) [rising, low, count] = [false, level, count + 1];
    } else {
      low = Math.min(low, level);
      if (level > low + 0.1) [rising, high] = [true, level];
    }
  }
  return count;
}

test('flashes are counted', () => {
  expect(flashes([0, 1, 0, 1, 0, 1, 0])).toBe(3);
  expect(flashes([0, 0.5, 1, 1])).toBe(0);
});

for (const hertz of [1, 2, 3, 5, 8, 15, 30, 60]) {
  test(`a sensor that comes and goes ${hertz} times a second flashes at most three times`, () => {
    const glow = new Glow();
    const levels = Array.from({ length: 240 }, (_, frame) => {
      glow.step(1, Math.floor((frame * 2 * hertz) / 60) % 2 === 0 ? [0] : [], (frame * 1000) / 60);
      return glow.levels[0]!;
    });
    expect(flashes(levels) / 4).toBeLessThanOrEqual(3);
  });
}

test('without the slow fading it would flash', () => {
  const raw = Array.from({ length: 240 }, (_, frame) => Math.floor((frame * 16) / 60) % 2);
  expect(flashes(raw) / 4).toBeGreaterThan(3);
});

test('a sensor that sees somebody lights up and goes dark again', () => {
  const glow = new Glow();
  for (let at = 0; at <= 500; at += 20) glow.step(2, [1], at);
  expect(glow.levels).toEqual([0, 1]);
  for (let at = 520; at <= 2500; at += 20) glow.step(2, [], at);
  expect(glow.levels).toEqual([0, 0]);
  expect(glow.step(2, [], 2600)).toBe(false);
});

test('never more than three rings begin within a second', () => {
  const pulses = new Pulses();
  const begun: number[] = [];
  for (let at = 0; at < 5000; at += 10) if (pulses.fire(Math.floor(at / 10) % 40, at)) begun.push(at);
  expect(begun.length).toBeGreaterThanOrEqual(12);
  for (const at of begun) expect(begun.filter((other) => other > at - 1000 && other <= at).length).toBeLessThanOrEqual(3);
});

test('a ring grows old and ends', () => {
  const pulses = new Pulses();
  pulses.fire(4, 1000);
  expect(pulses.at(1000)).toEqual([{ sensor: 4, age: 0 }]);
  expect(pulses.at(1550)[0]!.age).toBeCloseTo(0.5);
  expect(pulses.at(2200)).toEqual([]);
});

test('days that go by in a moment do not make the floor flash', () => {
  const eased = new Eased();
  const levels = Array.from({ length: 240 }, (_, frame) => {
    eased.step(frame % 8 < 4 ? 1 : 0, (frame * 1000) / 60);
    return eased.level!;
  });
  expect(flashes(levels) / 4).toBeLessThanOrEqual(3);
});

test('fast time is beyond twenty, and as fast as it goes', () => {
  expect([0.1, 1, 20, 20.5, 1000, null].map(isFast)).toEqual([false, false, false, true, true, true]);
});

test('a throttle lets through the first, and then one in its time', () => {
  const throttle = new Throttle(100);
  expect([0, 50, 99, 100, 150, 200].map((at) => throttle.due(at))).toEqual([true, false, false, true, false, true]);
});
