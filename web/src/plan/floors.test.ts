import { expect, test } from 'vitest';
import { madeUpHome } from '../testing/home';
import type { HomeView } from '../wire';
import { drawFloorNames, drawFrames, floorsOf, framed } from './floors';
import { light } from './palette';
import type { Box, Pen } from './pen';

const square = (x: number): [number, number][] => [[x, 0], [x + 4, 0], [x + 4, 3], [x, 3]];

function house(floors: (string | null)[]): HomeView {
  const rooms = floors.map((floor, index) => ({ name: `room ${index}`, outline: square(5 * index), middle: [0, 0] as [number, number], floor }));
  return { ...madeUpHome(), rooms };
}

/** The strokes and texts of a drawing. */
function drawn(home: HomeView): { frames: number; names: string[]; taken: number } {
  const seen = { frames: 0, names: [] as string[] };
  const taken: Box[] = [];
  const pen = new Proxy({} as Pen, {
    get: (_, key) => {
      if (key === 'stroke') return () => seen.frames++;
      if (key === 'fillText') return (words: string) => seen.names.push(words.replace(/[\u2066-\u2069]/g, ''));
      if (key === 'measureText') return (words: string) => ({ width: 6 * words.length });
      return () => undefined;
    },
    set: () => true,
  });
  const view = { scale: 50, x: 0, y: 0 };
  drawFrames(pen, home, view, light);
  drawFloorNames(pen, home, view, light, taken);
  return { ...seen, taken: taken.length };
}

test('rooms of one floor share a frame, which is around all of them', () => {
  const floors = floorsOf(house(['ground', null, 'first', 'ground']).rooms);
  expect(floors.map(({ name }) => name)).toEqual(['ground', 'first']);
  expect(floors[0]!.least[0]).toBeLessThan(0);
  expect(floors[0]!.most[0]).toBeGreaterThan(19);
  expect(floors[1]!.least[0]).toBeGreaterThan(9);
});

test('each floor has a frame and its name; a home of one has none', () => {
  expect(drawn(house(['ground', 'first']))).toEqual({ frames: 2, names: ['ground', 'first'], taken: 2 });
  expect(drawn(house([null, null]))).toEqual({ frames: 0, names: [], taken: 0 });
});

test('a home is shown with its frames; without any as large as it is', () => {
  const home = house(['ground', 'first']);
  const [[left, bottom], [right, top]] = framed({ ...home, bounds: [[0, 0], [9, 3]] });
  expect([left < 0, bottom < 0, right > 9, top > 3]).toEqual([true, true, true, true]);
  expect(framed({ ...house([null]), bounds: [[0, 0], [9, 3]] })).toEqual([[0, 0], [9, 3]]);
});
