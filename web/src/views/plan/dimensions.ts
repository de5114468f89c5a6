// Dimension lines: distances of walls along the whole home, and the measures and clearances of the selected thing.

import { type At, cross, distance, middle, minus } from '../../plan/geometry';
import { type Element, type Home, atOf, formOf, of, spanOf, wallsOf } from './model';
import type { Box } from '../../plan/pen';
import { type View, toScreen } from '../../plan/transform';
import { type Units, length } from '../../units';
import { add, angleOf, direction, times } from './shape';

/** Walls closer to each other are measured as one (our choice). */
const NEAREST_M = 0.25;
/** Largest distance that is measured to a wall, and smallest distance of things off a wall (our choice). */
const FARTHEST_M = 8;
const AT_WALL_M = 0.015;
/** Largest distance of a sensor on a wall (our choice). */
const ON_WALL_M = 0.1;

/** Distance of the chains from the home, and space of a number, in pixels (our choice). */
const OFF = 22;
const WIDE = 34;
/** Half of a line of numbers, and the width of one of its letters, in pixels (our choice). */
const HALF = 8;
const LETTER = 7;

const WAYS: At[] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

export type Chains = { xs: number[]; ys: number[]; left: number; bottom: number };

/** Positions of walls along the grid, from left to right and from bottom to top; without walls, the corners of rooms. */
export function chainsOf(home: Home): Chains {
  const walls = wallsOf(home);
  const corners = of(home, 'rooms').flatMap((room) => formOf(room) ?? []);
  const ends = walls.length > 0 ? walls.flatMap(({ from, to }) => [from, to]) : corners;
  const upright = walls.filter(({ from, to }) => Math.abs(from[0] - to[0]) < 0.001).map(({ from }) => from[0]);
  const level = walls.filter(({ from, to }) => Math.abs(from[1] - to[1]) < 0.001).map(({ from }) => from[1]);
  const axis = (own: number[], index: 0 | 1) => apart([...own, ...outermost(ends.map((end) => end[index]))]);
  const least = (index: 0 | 1) => ends.reduce((low, end) => Math.min(low, end[index]), Infinity);
  return { xs: axis(upright, 0), ys: axis(level, 1), left: least(0), bottom: least(1) };
}

function outermost(all: number[]): number[] {
  return all.length === 0 ? [] : [all.reduce((a, b) => Math.min(a, b)), all.reduce((a, b) => Math.max(a, b))];
}

function apart(all: number[]): number[] {
  const sorted = all.toSorted((a, b) => a - b);
  const last = sorted.at(-1);
  const kept: number[] = [];
  for (const one of sorted) if (kept.length === 0 || one - kept.at(-1)! >= NEAREST_M) kept.push(one);
  // The last position is the end of the home.
  if (last !== undefined && kept.at(-1) !== last) kept[kept.length - 1] = last;
  return kept;
}

export type Measure = { from: At; to: At };

/** The sides of a thing, each from end to end; the line of a wall. */
export function sidesOf(element: Element): Measure[] {
  const span = element.list === 'walls' || element.list === 'doors' ? spanOf(element) : null;
  if (span) return [span];
  const form = element.list === 'rooms' ? formOf(element) : null;
  return form === null ? [] : form.map((from, index) => ({ from, to: form[(index + 1) % form.length]! })).filter(({ from, to }) => distance(from, to) >= NEAREST_M);
}

/** From each side of a piece of furniture straight to the wall in front of it; from a sensor to the walls around it. */
export function clearancesOf(home: Home, element: Element): Measure[] {
  const { rays, nearest_m } = raysOf(element);
  if (rays.length === 0) return [];
  const edges = chunks(wallsOf(home).flatMap(({ element }) => formOf(element) ?? []));
  return rays.flatMap(({ from, way }) => {
    const far_m = edges.reduce((near, [a, b]) => Math.min(near, hit(from, way, a, b)), FARTHEST_M);
    return far_m > nearest_m && far_m < FARTHEST_M ? [{ from, to: add(from, times(way, far_m)) }] : [];
  });
}

function raysOf(element: Element): { rays: { from: At; way: At }[]; nearest_m: number } {
  const form = formOf(element);
  if (element.list === 'sensors') {
    const spot = atOf(element) ?? (form && middle(form));
    return { rays: spot === null ? [] : WAYS.map((way) => ({ from: spot, way })), nearest_m: ON_WALL_M };
  }
  const corners = element.list === 'furniture' && form?.length === 4 ? form : [];
  const rays = corners.map((corner, index) => {
    const from = middle([corner, corners[(index + 1) % 4]!]);
    return { from, way: direction(angleOf(minus(from, middle(corners)))) };
  });
  return { rays, nearest_m: AT_WALL_M };
}

function chunks(corners: At[]): [At, At][] {
  return corners.map((corner, index) => [corner, corners[index % 4 === 3 ? index - 3 : index + 1]!]);
}

/** Distance along a ray to a line; infinite if it misses it. */
function hit(from: At, way: At, a: At, b: At): number {
  const side = minus(b, a);
  const across = cross(way, side);
  if (Math.abs(across) < 1e-9) return Infinity;
  const off = minus(a, from);
  const [far, share] = [cross(off, side) / across, cross(off, way) / across];
  return far > -1e-6 && share >= 0 && share <= 1 ? Math.max(far, 0) : Infinity;
}

/** A dimension line on the screen, with the place of its number. */
export type Dimension = { from: At; to: At; at: At; upright: boolean; words: string };

/** Those of the whole home, of the sides of one thing, and around it. */
export type Dimensions = { chains: Dimension[]; own: Dimension[]; around: Dimension[] };

export function dimensionsOf(home: Home, view: View, one: Element | null, whole: boolean, units: Units): Dimensions {
  const drawn = (from: At, to: At, metres: number): Dimension => {
    const upright = Math.abs(from[1] - to[1]) > Math.abs(from[0] - to[0]);
    return { from, to, at: middle([from, to]), upright, words: length(metres, units) };
  };
  /** From each to the next, all on one line; if there are several, the total beyond it. */
  const chain = (all: number[], place: (value: number) => At, [x, y]: At): Dimension[] => {
    const step = (a: number, b: number, rows: number) => {
      const [from, to] = [place(a), place(b)];
      return drawn([from[0] + x * rows, from[1] + y * rows], [to[0] + x * rows, to[1] + y * rows], b - a);
    };
    const steps = all.slice(1).map((value, index) => step(all[index]!, value, 1));
    return all.length > 2 ? [...steps, step(all[0]!, all.at(-1)!, 2)] : steps;
  };
  const placed = ({ from, to }: Measure) => drawn(toScreen(view, from), toScreen(view, to), distance(from, to));
  const chains = whole ? chainsOf(home) : null;
  return {
    chains: chains === null ? [] : [
      ...chain(chains.xs, (x) => toScreen(view, [x, chains.bottom]), [0, OFF]),
      ...chain(chains.ys, (y) => toScreen(view, [chains.left, y]), [-OFF, 0]),
    ],
    own: one === null ? [] : sidesOf(one).map(placed),
    around: one === null ? [] : clearancesOf(home, one).map(placed),
  };
}

export const hasNumber = ({ from, to }: Dimension) => distance(from, to) >= WIDE;

/** The places of the numbers, which names avoid. */
export function numbersAt({ chains, own, around }: Dimensions): Box[] {
  return [...chains, ...own, ...around].filter(hasNumber).map(({ at: [x, y], upright, words }) => {
    const [wide, high] = upright ? [HALF, (words.length * LETTER) / 2] : [(words.length * LETTER) / 2, HALF];
    return [x - wide, y - high, x + wide, y + high];
  });
}
