// Pieces of furniture that overlap each other or a wall. A chair stands below its table and a sink in its counter. Of a
// piece only the top is known, not its bottom: a piece on another or above it looks like an overlap.

import type { At } from '../../plan/geometry';
import { type Units, length } from '../../units';
import { type Element, type Home, formOf, number, of, titleOf, wallsOf } from './model';
import { angleOf, direction, dot } from './shape';
import { minus } from '../../plan/geometry';

/** Largest depth that does not count: the walls of a plan are not exact to the centimetre (our choice). */
const DEEPEST_M = 0.02;
/** Lower pieces are walked over, and stand below everything (our choice). */
const LOW_M = 0.05;

const BELONG: [RegExp, RegExp][] = [
  [/chair|stool|bench/, /table|desk|counter|piano/],
  [/sink|basin|stove|cooker|hob|oven|dishwasher|microwave|kettle|lamp|television|\btv\b/, /counter|cupboard|cabinet|vanity|table|desk|bench|shelf|dresser/],
  [/shower/, /bath/],
];

/** Pieces that stand on the floor, and under nothing (our choice), by the last word of their name: a desk lamp is a lamp. */
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
 * Overlaps that are probably mistakes: two pieces on the floor; a piece on the floor that reaches beyond the middle of
 * a wall, to which many people draw; and any piece that comes out on the other side of a wall.
 */
export function mistakesOf(home: Home): Overlap[] {
  const thickness_m = new Map(wallsOf(home).map(({ element, thickness_m }) => [element, thickness_m]));
  return overlapsOf(home).filter(({ piece, other, deep_m }) => {
    const wall_m = thickness_m.get(other);
    if (wall_m === undefined) return onFloor(piece) && onFloor(other);
    return deep_m > DEEPEST_M + (onFloor(piece) ? wall_m / 2 : wall_m);
  });
}

/** Pieces to sit or lie on stand on the floor, whatever their name. */
const onFloor = ({ name, value }: Element) => value.enterable === true || ON_FLOOR.test(name.toLowerCase());

function belong(one: Element, other: Element): boolean {
  const [a, b] = [one.name.toLowerCase(), other.name.toLowerCase()];
  return BELONG.some(([small, large]) => (small.test(a) && large.test(b)) || (small.test(b) && large.test(a)));
}

/** The distance of a move that separates two convex outlines; 0 if they are separate. */
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

export function told({ piece, other, deep_m }: Overlap, units: Units): string {
  const into = other.list === 'walls' ? 'a wall' : titleOf(other).slice(0, 80);
  return `${titleOf(piece).slice(0, 80)} overlaps ${into} by ${length(deep_m, units)}`;
}
