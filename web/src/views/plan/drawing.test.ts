import { expect, test } from 'vitest';
import { frameOf, frontOf, strokesOf } from '../../plan/symbols';
import { FLAT } from '../../testing/flat';
import { described } from './described';
import { chainsOf, clearancesOf, dimensionsOf, numbersAt, sidesOf } from './dimensions';
import { stepsOf } from './grid';
import { type Home, formOf, isHome, of, readHome, wallsOf } from './model';
import { mistakesOf, overlapsOf, told } from './overlaps';
import { turnedBox } from './shape';
import { flush, gridOf, targetsOf } from './snap';
import { typedEnd, typedOn } from './typed';

function home(text: string): Home {
  const read = readHome(text);
  if (!isHome(read)) throw new Error(read.what);
  return read;
}

const flat = home(FLAT);
const SNAPPING = { tolerance_m: 0.1, grid_m: 0.05 };

test('a length and an angle are typed, and what is no part of one is not', () => {
  const typed = (keys: string) => [...keys].reduce<string>((all, key) => typedOn(all, key) ?? all, '');
  expect([typed('4.5'), typed('4.5<90'), typed('4,5 90'), typed('4@-45'), typed('w4x.y2'), typed('1.2.3'), typed('<4')]).toEqual(['4.5', '4.5<90', '4,5<90', '4<-45', '4.2', '1.23', '4']);
  expect([typedOn('45', 'Backspace'), typedOn('', 'Backspace'), typedOn('', '-'), typedOn('4', 'Shift')]).toEqual(['4', null, null, null]);
  expect(typedEnd([1, 1], '4.5', [9, 1], 'metric')).toEqual([5.5, 1]);
  expect(typedEnd([1, 1], '4,5<90', [9, 1], 'metric')).toEqual([1, 5.5]);
  expect(typedEnd([0, 0], '10<180', null, 'feet')).toEqual([-3.048, 0]);
  for (const none of ['', '0', '4<', '4<-', '99999', '.']) expect(typedEnd([0, 0], none, [1, 0], 'metric')).toBeNull();
});

test('lines of the grid are never nearer than can be seen, and are multiples of what is snapped to', () => {
  for (const units of ['metric', 'feet'] as const) {
    for (const scale of [4, 20, 50, 120, 600]) {
      const { fine_m, strong_m } = stepsOf(scale, units);
      expect(fine_m * scale).toBeGreaterThanOrEqual(9);
      const times = fine_m / gridOf(units);
      expect(Math.abs(times - Math.round(times))).toBeLessThan(1e-6);
      expect(strong_m).toBeGreaterThan(fine_m);
    }
  }
  expect(stepsOf(200, 'metric').fine_m).toBe(0.05);
});

test('dimension lines go from wall to wall, and from a piece to the walls around it', () => {
  expect(chainsOf(flat)).toEqual({ xs: [0, 4, 6], ys: [0, 3], left: 0, bottom: 0 });
  expect(chainsOf(home('{ "rooms": [{ "name": "a", "outline": [[1, 1], [3, 1], [3, 2]] }] }'))).toEqual({ xs: [1, 3], ys: [1, 2], left: 1, bottom: 1 });
  expect(chainsOf(home('{}')).xs).toEqual([]);
  const metres = (id: string) => clearancesOf(flat, flat.byId.get(id)!).map(({ from, to }) => Math.round(Math.hypot(to[0] - from[0], to[1] - from[1]) * 100) / 100);
  const around = metres('furniture/1');
  // Its back is at the wall, which is not measured.
  expect(around).toEqual([0.65, 2.2, 2.6]);
  // From a sensor to the walls east, north and south of it, but not to its own.
  expect(metres('sensors/0')).toEqual([3.83, 1.4, 1.4]);
  expect(metres('sensors/4')).toHaveLength(4);
  expect(metres('sensors/1')).toEqual([]);
  expect(sidesOf(of(flat, 'rooms')[0]!)).toHaveLength(4);
});

test('a piece is put with its back at the wall that is near, into a corner, and nowhere else', () => {
  const targets = targetsOf(flat, new Set());
  expect(flush([2, 2.6], [1.8, 0.6], 'long', targets, SNAPPING)).toEqual({ at: [2, 2.6], turn_deg: 0 });
  expect(flush([0.3, 1.5], [1.8, 0.6], 'long', targets, SNAPPING)).toEqual({ at: [0.4, 1.5], turn_deg: 90 });
  expect(flush([3.7, 1.5], [1.8, 0.6], 'long', targets, SNAPPING)).toEqual({ at: [3.65, 1.5], turn_deg: 270 });
  // The head of a bed that is wider than deep is at the wall.
  expect(flush([1, 1.5], [2, 0.9], 'short', targets, SNAPPING)).toEqual({ at: [1.1, 1.5], turn_deg: 0 });
  expect(flush([0.93, 2.6], [1.8, 0.6], 'long', targets, SNAPPING)).toEqual({ at: [1, 2.6], turn_deg: 0 });
  expect(flush([2, 1.5], [0.5, 0.5], 'long', targets, SNAPPING)).toBeNull();
  for (const at of [[2, 2.6], [0.3, 1.5], [3.7, 1.5], [0.93, 2.6]] as const) {
    const put = flush([...at], [1.8, 0.6], 'long', targets, SNAPPING)!;
    const text = FLAT.replace('"at": [1, 2], "size_m": [2, 0.9]', `"at": [${put.at}], "turn_deg": ${put.turn_deg}, "size_m": [1.8, 0.6]`);
    expect(overlapsOf(home(text)).filter(({ piece }) => piece.index === 0)).toEqual([]);
  }
});

test('the back of a piece is its side at a wall, and the front is across', () => {
  const walls = wallsOf(flat).map(({ element }) => formOf(element)!);
  const sofa = frameOf('sofa', turnedBox([2, 0.55], [1.9, 0.9], 0), walls)!;
  expect(sofa.back[1]).toBeCloseTo(-0.45);
  expect(frontOf(sofa)[0]![1]).toBeGreaterThan(1);
  // A bed has its head at a wall, not its long side.
  const bed = frameOf('bed', turnedBox([1.1, 0.55], [2, 0.9], 0), walls)!;
  expect(bed.back[0]).toBeCloseTo(-1);
  // Far from walls it stays unturned.
  const chair = frameOf('chair', turnedBox([2, 1.5], [0.45, 0.45], 0), walls)!;
  expect([chair.at[0], chair.at[1], chair.back[1]]).toEqual([2, 1.5, expect.closeTo(0.225)]);
  expect(frameOf('table', [[0, 0], [1, 0], [1, 1]], walls)).toBeNull();
  for (const [name, frame] of [['bed', bed], ['sofa', sofa], ['chair', chair]] as const) expect(strokesOf(name, frame).length).toBeGreaterThan(0);
  expect(strokesOf('something', chair)).toEqual([]);
});

test('what stands in something else is told, but for what belongs there', () => {
  expect(overlapsOf(flat).map((one) => told(one, 'metric'))).toEqual(['bed overlaps a wall by 0.10 m']);
  const crowded = home(FLAT.replace('"at": [3, 0.4]', '"at": [1.5, 1.8]').replace('"at": [1, 2]', '"at": [1.2, 1.8]'));
  expect(overlapsOf(crowded).map((one) => told(one, 'metric'))).toEqual(['bed overlaps stove by 0.75 m']);
  const chairs = '{ "furniture": [{ "name": "chair", "at": [1, 1], "size_m": [0.5, 0.5], "height_m": 0.9 }, { "name": "table", "at": [1, 1.3], "size_m": [1, 1], "height_m": 0.7 }, { "name": "rug", "at": [1, 1], "size_m": [2, 2], "height_m": 0.02 }] }';
  expect(overlapsOf(home(chairs))).toEqual([]);
});

test('a problem is what hardly anybody means: not what may stand on another, hang above it, or be drawn to the middle of a wall', () => {
  const mistakes = (text: string) => mistakesOf(home(text)).map((one) => told(one, 'metric'));
  const crowded = FLAT.replace('"at": [3, 0.4]', '"at": [1.5, 1.8]').replace('"at": [1, 2]', '"at": [1.2, 1.8]');
  expect(mistakes(crowded)).toEqual(['bed overlaps stove by 0.75 m']);
  // Its bed goes to the middle of a wall.
  expect(overlapsOf(flat)).toHaveLength(1);
  expect(mistakes(FLAT)).toEqual([]);
  expect(mistakes(FLAT.replace('"at": [1, 2]', '"at": [0.94, 2]'))).toEqual(['bed overlaps a wall by 0.16 m']);
  const piece = (name: string, at: number[], size_m: number[], height_m: number) => ({ name, at, size_m, height_m });
  const kitchen = [piece('Cooker', [1, 1], [0.6, 0.62], 0.85), piece('Box 2', [1, 1], [0.6, 0.58], 1.615), piece('Kitchen upper cabinet', [1.1, 1], [0.6, 0.54], 2.3), piece('Plant 9', [1, 1], [0.15, 0.13], 1.06)];
  const text = JSON.stringify({ furniture: kitchen });
  expect(overlapsOf(home(text)).length).toBeGreaterThan(3);
  expect(mistakes(text)).toEqual([]);
  // By its last word: a thing named after its owner may stand on it.
  const inWardrobe = (name: string) => mistakes(JSON.stringify({ furniture: [piece(name, [1, 1], [0.6, 0.6], 0.8), piece('Wardrobe 12', [1, 1], [0.6, 0.6], 2)] })).length;
  expect(['desk lamp', 'Bed pillow 2', 'toilet brush', 'shower curtain'].map(inWardrobe)).toEqual([0, 0, 0, 0]);
  expect(['double bed', 'Sofa 2', 'tables', 'washing machine'].map(inWardrobe)).toEqual([1, 1, 1, 1]);
  // Nothing hangs through a wall.
  const wall = [{ from: [0, 0], to: [3, 0], thickness_m: 0.2 }];
  const shelf = (y: number) => JSON.stringify({ walls: wall, furniture: [piece('Box', [1, y], [1, 0.5], 0.9)] });
  expect([mistakes(shelf(0.2)), mistakes(shelf(0.1))]).toEqual([[], ['Box overlaps a wall by 0.25 m']]);
});

test('an angle has the point of the compass beside it', () => {
  const facing = (deg: number) => home(FLAT.replace('"facing_deg": 0', `"facing_deg": ${deg}`)).byId.get('sensors/0')!;
  expect([0, 90, -90, 222].map((deg) => described(facing(deg), 'metric').split(' · ').at(-1))).toEqual(
    ['faces east (0° from east)', 'faces north (90° from east)', 'faces south (-90° from east)', 'faces south-west (222° from east)'],
  );
  expect(described([[0, 0], [0, 2]], 'metric')).toBe('2.00 m at 90° (north)');
});

test('names keep off the numbers of dimension lines', () => {
  const view = { scale: 50, x: 100, y: 300 };
  const dimensions = dimensionsOf(flat, view, null, true, 'metric');
  expect(dimensions.chains.map(({ words }) => words)).toEqual(['4.00 m', '2.00 m', '6.00 m', '3.00 m']);
  const boxes = numbersAt(dimensions);
  dimensions.chains.forEach(({ at: [x, y], upright }, index) => {
    const [left, top, right, bottom] = boxes[index]!;
    expect(left < x && x < right && top < y && y < bottom).toBe(true);
    // Numbers of upright lines are upright.
    expect(bottom - top > right - left).toBe(upright);
  });
  // A line that is too short for its number has none.
  expect(numbersAt(dimensionsOf(flat, { ...view, scale: 5 }, null, true, 'metric'))).toEqual([]);
});
