import { expect, test } from 'vitest';
import { inSight } from './rows';

test('only rows in sight are made, and the height is that of all', () => {
  for (const scrolled of [0, 13, 2700, 13_000, 99_999]) {
    const { from, to, above, below } = inSight(500, 27, scrolled, 300);
    expect(to - from).toBeLessThanOrEqual(12 + 2 * 6);
    expect(above + (to - from) * 27 + below).toBe(500 * 27);
  }
});

test('what is in sight is among them', () => {
  const { from, to } = inSight(500, 27, 2700, 300);
  expect(from).toBeLessThanOrEqual(100);
  expect(to).toBeGreaterThanOrEqual(112);
});

test('few rows, and none', () => {
  expect(inSight(3, 27, 0, 300)).toEqual({ from: 0, to: 3, above: 0, below: 0 });
  expect(inSight(0, 27, 0, 300)).toEqual({ from: 0, to: 0, above: 0, below: 0 });
});
