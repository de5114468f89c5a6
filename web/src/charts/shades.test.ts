import { expect, test } from 'vitest';
import { columns } from './shades';

test('a column is as dark as its mean chance', () => {
  const means = columns([[0, 15, 1], [15, 25, 0.5], [30, 100, 0.25]], 0, 40, 4);
  expect([...means]).toEqual([1, 0.75, 0.25, 0.25]);
  expect([...columns([[-50, 5, 1]], 0, 10, 2)]).toEqual([1, 0]);
  expect([...columns([], 0, 0, 1)]).toEqual([0]);
});
