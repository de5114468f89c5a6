// Pieces of furniture that stand in each other or in a wall. A chair stands below its table and a sink in its counter. Of a piece only the top
// is known, not where it begins: what stands on another or hangs above it looks as if it stood in it.

import type { At } from '../../plan/geometry';
import { type Units, length } from '../../units';
import { type Element, type Home, formOf, number, of, titleOf, wallsOf } from './model';
import { angleOf, direction, dot } from './shape';
import { minus } from '../../plan/geometry';

/** So deep may one be in another: the walls of a plan are not exact to the centimetre (ours). */
const DEEPEST_M = 0.02;
/** What is lower is walked over, and stands below all (ours). */
const LOW_M = 0.05;

const BELONG: [RegExp, RegExp][] = [
  [/chair|stool|bench/, /table|desk|counter|piano/],
  [/sink|basin|stove|cooker|hob|oven|dishwasher|microwave|kettle|lamp|television|\btv\b/, /counter|cupboard|cabinet|vanity|table|desk|bench|shelf|dresser/],
  [/shower/, /bath/],
];

/** What stands on the floor, and under nothing (ours), by the last word of its name: a desk lamp is a lamp. */
const ON_FLOOR = /\b(wardrobe|bookcase|dresser|nightstand|bed|sofa|couch|armchair|table|desk|fridge|refrigerator|freezer|stove|washing machine|toilet|bathtub|shower|piano)s?( \d+)?$/;

export type Overlap = { piece: Element; other: Element; deep_m: number };

export function overlapsOf(home: Home): Overlap[] {
  const pieces = of(home, 'furniture').flatMap((piece) => {
    const form = formOf(piece);
    return form && (number(piece.value.height_m) ?? 1) > LOW_M ? [{ piece, form }] : [];
  });
  const walls = wallsOf(home).flatMap(({ element }) => {
    const form = formOf(element);
    return form ? [{ element, form }] : [];
  });
  return pieces.flatMap(({ piece, form }, index) => [
    ...pieces.slice(index + 1).filter((other) => !belong(piece, other.piece)).map((other) => ({ piece, other: other.piece, deep_m: depth(form, other.form) })),
    ...walls.map((wall) => ({ piece, other: wall.element, deep_m: depth(form, wall.form) })),
  ]).filter(({ deep_m }) => deep_m > DEEPEST_M);
}

/**
 * Those that hardly anybody means: of two that stand on the floor; of one that stands there and reaches beyond the middle of a wall, to which many
 * draw; and of any piece that comes out on the other side of a wall.
 */
export function mistakesOf(home: Home): Overlap[] {
  const thickness_m = new Map(wallsOf(home).map(({ element, thickness_m }) => [element, thickness_m]));
  return overlapsOf(home).filter(({ piece, other, deep_m }) => {
    const wall_m = thickness_m.get(other);
    if (wall_m === undefined) return onFloor(piece) && onFloor(other);
    return deep_m > DEEPEST_M + (onFloor(piece) ? wall_m / 2 : wall_m);
  });
}

/** What people sit or lie on stands there, whatever it is called. */
const onFloor = ({ name, value }: Element) => value.enterable === true || ON_FLOOR.test(name.toLowerCase());

function belong(one: Element, other: Element): boolean {
  const [a, b] = [one.name.toLowerCase(), other.name.toLowerCase()];
  return BELONG.some(([small, large]) => (small.test(a) && large.test(b)) || (small.test(b) && large.test(a)));
}

/** How far one convex outline would have to be moved to be beside another; nothing where they are. */
function depth(a: At[], b: At[]): number {
  let least = Infinity;
  for (const outline of [a, b]) {
    for (let index = 0; index < outline.length; index++) {
      const normal = direction(angleOf(minus(outline[(index + 1) % outline.length]!, outline[index]!)) + 90);
      const [low, high] = reach(a, normal);
      const [from, to] = reach(b, normal);
      least = Math.min(least, high - from, to - low);
      if (least <= 0) return 0;
    }
  }
  return Number.isFinite(least) ? least : 0;
}

function reach(outline: At[], normal: At): At {
  const all = outline.map((at) => dot(at, normal));
  return [Math.min(...all), Math.max(...all)];
}

/** In a sentence. */
export function told({ piece, other, deep_m }: Overlap, units: Units): string {
  const into = other.list === 'walls' ? 'a wall' : titleOf(other).slice(0, 80);
  return `${titleOf(piece).slice(0, 80)} overlaps ${into} by ${length(deep_m, units)}`;
}
