import { expect, test } from 'vitest';
import { tickAt } from './lanes';

test('ticks are where their instants are, and what is too old or to come has none', () => {
  expect(tickAt(600_000_000, 600_000_000, 100, 700)).toBe(700);
  expect(tickAt(300_000_000, 600_000_000, 100, 700)).toBe(400);
  expect(tickAt(0, 600_000_000, 100, 700)).toBe(100);
  expect(tickAt(0, 600_000_001, 100, 700)).toBeNull();
  expect(tickAt(9, 8, 100, 700)).toBeNull();
});
