// Shapes on the plan, and the relative positions of points, in metres and degrees counter-clockwise from east.

import { type At, cross, distance, minus } from '../../plan/geometry';

export function add(a: At, b: At): At {
  return [a[0] + b[0], a[1] + b[1]];
}

export function times(a: At, by: number): At {
  return [a[0] * by, a[1] * by];
}

export function dot(a: At, b: At): number {
  return a[0] * b[0] + a[1] * b[1];
}

export function direction(deg: number): At {
  return [Math.cos((deg * Math.PI) / 180), Math.sin((deg * Math.PI) / 180)];
}

export function angleOf([x, y]: At): number {
  return (Math.atan2(y, x) * 180) / Math.PI;
}

/** To millimetres, or hundredths of degrees: a multiple of 1 / `parts`. */
export function rounded(value: number, parts = 1000): number {
  return Math.round(value * parts) / parts + 0;
}

/** From 0 to less than 360, in hundredths. */
export function wrapped(deg: number): number {
  return rounded(((rounded(deg, 100) % 360) + 360) % 360, 100);
}

const WINDS = ['east', 'north-east', 'north', 'north-west', 'west', 'south-west', 'south', 'south-east'];

/** The nearest of eight points of the compass: an angle from east alone is read as a bearing from north. */
export function windOf(deg: number): string {
  return WINDS[Math.round(wrapped(deg) / 45) % 8]!;
}

export function turn(at: At, about: At, deg: number): At {
  const [cos, sin] = direction(deg);
  const [x, y] = minus(at, about);
  return [about[0] + x * cos - y * sin, about[1] + x * sin + y * cos];
}

/** To the millimetre. */
export function exact([x, y]: At): At {
  return [rounded(x), rounded(y)];
}

/** The outline of a line with a thickness. */
export function thick(from: At, to: At, thickness_m: number): At[] {
  const far = distance(from, to) || 1;
  const aside: At = times([-(to[1] - from[1]) / far, (to[0] - from[0]) / far], thickness_m / 2);
  return [minus(from, aside), minus(to, aside), add(to, aside), add(from, aside)];
}

export function turnedBox(at: At, [width, depth]: At, deg: number): At[] {
  const corners: At[] = [[-width, -depth], [width, -depth], [width, depth], [-width, depth]];
  return corners.map(([x, y]) => turn([at[0] + x / 2, at[1] + y / 2], at, deg));
}

/** Position of a point relative to the line from a to b: along it in metres, and to its left. */
export function along(at: At, from: At, to: At): { along_m: number; left_m: number; length_m: number } {
  const length_m = distance(from, to);
  if (length_m === 0) return { along_m: 0, left_m: distance(at, from), length_m };
  const way = times(minus(to, from), 1 / length_m);
  const off = minus(at, from);
  return { along_m: dot(off, way), left_m: cross(way, off), length_m };
}

/** The point at a distance along the line from a to b. */
export function onLine(from: At, to: At, along_m: number): At {
  const length_m = distance(from, to) || 1;
  return add(from, times(minus(to, from), along_m / length_m));
}

export function toSegment(at: At, from: At, to: At): number {
  const { along_m, length_m } = along(at, from, to);
  return distance(at, onLine(from, to, clamp(along_m, 0, length_m)));
}

export function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), Math.max(least, most));
}

export function area(outline: At[]): number {
  let sum = 0;
  outline.forEach((a, index) => (sum += cross(a, outline[(index + 1) % outline.length]!)));
  return sum / 2;
}
