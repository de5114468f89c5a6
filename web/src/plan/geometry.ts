// Points and outlines on the plan, in metres.

import type { HomeView, SensorView } from '../wire';

export type At = [number, number];

export function distance(a: At, b: At): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

export function minus(a: At, b: At): At {
  return [a[0] - b[0], a[1] - b[1]];
}

export function cross(a: At, b: At): number {
  return a[0] * b[1] - a[1] * b[0];
}

/** The way from one point to another crosses an outline. */
function passes(outline: At[], from: At, to: At): boolean {
  const side = (a: At, b: At, p: At) => Math.sign(cross(minus(b, a), minus(p, a)));
  return outline.some((corner, index) => {
    const next = outline[(index + 1) % outline.length]!;
    return side(from, to, corner) * side(from, to, next) < 0 && side(corner, next, from) * side(corner, next, to) < 0;
  });
}

/** Left, bottom, right and top of an outline. */
export function box(outline: At[]): [number, number, number, number] {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of outline) {
    left = Math.min(left, x);
    right = Math.max(right, x);
    bottom = Math.min(bottom, y);
    top = Math.max(top, y);
  }
  return [left, bottom, right, top];
}

export function middle(outline: At[]): At {
  const [left, bottom, right, top] = box(outline);
  return [(left + right) / 2, (bottom + top) / 2];
}

export function inside(outline: At[], [x, y]: At): boolean {
  let within = false;
  for (let i = 0, j = outline.length - 1; i < outline.length; j = i++) {
    const [ax, ay] = outline[i]!;
    const [bx, by] = outline[j]!;
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) within = !within;
  }
  return within;
}

/** The leaf of an open door: a quarter turn counter-clockwise from its hinge, the first jamb. */
export function openLeaf(from: At, to: At): At {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  return [from[0] - dy, from[1] + dx];
}

/** The direction of a sensor's glyph, in radians counter-clockwise from east. */
export function facing({ facing_deg }: Pick<SensorView, 'facing_deg'>): number {
  return ((facing_deg ?? 0) * Math.PI) / 180;
}

/** The state of doors. A usable door reports its state; others have that of the home. */
export function openDoors(home: HomeView, on: number[]): boolean[] {
  const isOn = new Set(on);
  const things = new Map(home.things.flatMap((thing, index) => (thing.kind === 'door' ? [[thing.name, index]] : [])));
  return home.doors.map((door) => {
    const thing = things.get(door.name);
    return thing === undefined ? door.open : isOn.has(thing);
  });
}

/** The things within reach of a person at `at`, the nearest first; not through walls. */
export function within(home: HomeView, at: At, reach_m: number): number[] {
  const walls = home.solids.filter(({ kind }) => kind === 'wall');
  const far = home.things.map((thing) => distance(thing.at, at));
  const isBehind = (thing: At) => walls.some(({ outline }) => passes(outline, at, thing));
  const near = home.things.flatMap((thing, index) => (far[index]! <= reach_m && !isBehind(thing.at) ? [index] : []));
  return near.sort((a, b) => far[a]! - far[b]!);
}
