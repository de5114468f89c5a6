import { expect, test } from 'vitest';
import { SPEEDS, long, short, stepOf } from './speed';

test('speeds are written for the eye and for the ear', () => {
  expect([0.1, 1, 2.5, 1000, null].map(short)).toEqual(['0.1×', '1×', '2.5×', '1,000×', 'as fast as possible']);
  expect([0.5, 1, 1000, null].map(long)).toEqual(['0.5 times real time', 'real time', '1,000 times real time', 'as fast as possible']);
});

test('the slider goes from a tenth to a thousand, and each step is its own', () => {
  expect([SPEEDS[0], SPEEDS.at(-1)]).toEqual([0.1, 1000]);
  expect(SPEEDS.map(stepOf)).toEqual(SPEEDS.map((_, index) => index));
  expect(SPEEDS[stepOf(7)]).toBe(5);
  expect(SPEEDS[stepOf(null)]).toBe(1000);
});
