import { expect, test } from 'vitest';
import { fit, fitBest, pan, toPlan, toScreen, zoom } from './transform';

const SIZE = { width: 800, height: 600 };
const NONE = { left: 0, top: 0, right: 0, bottom: 0 };

test('all of the home fits, in the middle, with its top up', () => {
  const view = fit([[0, 0], [10, 5]], SIZE, { left: 100, top: 0, right: 0, bottom: 0 });
  expect(view.scale).toBe(70);
  expect(toScreen(view, [0, 2.5])).toEqual([100, 300]);
  expect(toScreen(view, [10, 2.5])).toEqual([800, 300]);
  expect(toScreen(view, [0, 5])[1]).toBeLessThan(toScreen(view, [0, 0])[1]);
});

test('a home without width divides by nothing', () => {
  const view = fit([[3, 3], [3, 3]], SIZE, NONE);
  expect(Number.isFinite(view.scale)).toBe(true);
  expect(toScreen(view, [3, 3])).toEqual([400, 300]);
});

test('of two ways the larger plan is taken', () => {
  const beside = { ...NONE, left: 400 };
  const above = { ...NONE, top: 100 };
  expect(fitBest([[0, 0], [10, 1]], SIZE, [beside, above]).scale).toBe(80);
  expect(fitBest([[0, 0], [1, 10]], SIZE, [beside, above]).scale).toBe(60);
});

test('there and back is the same point', () => {
  const view = pan(zoom(fit([[-2, -1], [9.4, 6.6]], SIZE, NONE), 1.7, [123, 456]), -40, 7);
  const [x, y] = toPlan(view, toScreen(view, [1.25, 3.5]));
  expect(x).toBeCloseTo(1.25, 10);
  expect(y).toBeCloseTo(3.5, 10);
});

test('what is under the pointer stays there while zooming', () => {
  const view = fit([[0, 0], [10, 8]], SIZE, NONE);
  const before = toPlan(view, [600, 100]);
  const after = toPlan(zoom(view, 2.5, [600, 100]), [600, 100]);
  expect(after[0]).toBeCloseTo(before[0], 10);
  expect(after[1]).toBeCloseTo(before[1], 10);
});

test('zooming has an end on both sides, and there nothing slides away', () => {
  let view = fit([[0, 0], [10, 8]], SIZE, NONE);
  for (let time = 0; time < 100; time++) view = zoom(view, 1.5, [0, 0]);
  expect(view.scale).toBe(600);
  expect(zoom(view, 1.5, [300, 300])).toEqual(view);
  for (let time = 0; time < 100; time++) view = zoom(view, 0.5, [0, 0]);
  expect(view.scale).toBe(4);
});
