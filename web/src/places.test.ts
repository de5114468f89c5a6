import { expect, test } from 'vitest';
import { lineOf, offsetOf, unitsAfter } from './places';

test('lines and columns are counted in characters, from one', () => {
  const text = '{\n  "😀😀": 1,\n  "b": 2\n}';
  const offset = text.indexOf('1');
  expect(lineOf(text, offset)).toEqual({ line: 2, column: 9 });
  expect(offsetOf(text, 2, 9)).toBe(offset);
  expect(offsetOf(text, 99, 99)).toBeLessThanOrEqual(text.length);
});

test('a place is counted in units', () => {
  expect(unitsAfter('a👩b', 2)).toBe(3);
  expect(unitsAfter('ab', 9)).toBe(2);
});

test('a column behind the end of its line is the end', () => {
  expect(offsetOf('ab\ncd', 1, 9)).toBe(2);
  expect(offsetOf('ab\ncd', 2, 0)).toBe(3);
});
