// The space around a point that walls enclose: the walls' middle lines are cut at their crossings, and the smallest way
// around the point is followed.

import { type At, distance, inside, minus } from '../../plan/geometry';
import { along, angleOf, area, exact, onLine } from './shape';

type Line = { from: At; to: At };

/** Ends within this distance are one: a gap in a drawing, not in a wall. */
const SAME_M = 0.02;

export function enclosed(walls: Line[], at: At): At[] | null {
  const spots: At[] = [];
  const spot = (at: At) => {
    const found = spots.findIndex((other) => distance(at, other) <= SAME_M);
    return found >= 0 ? found : spots.push(exact(at)) - 1;
  };
  const neighbours = new Map<number, Set<number>>();
  const join = (a: number, b: number) => {
    if (a === b) return;
    for (const [one, other] of [[a, b], [b, a]] as const) neighbours.set(one, (neighbours.get(one) ?? new Set()).add(other));
  };
  for (const wall of walls) {
    const cuts = walls.flatMap((other) => (other === wall ? [] : meetings(wall, other)));
    const { length_m } = along(wall.to, wall.from, wall.to);
    const stops = [0, ...cuts, length_m].filter((cut) => cut >= 0 && cut <= length_m).sort((a, b) => a - b);
    const passed = stops.map((cut) => spot(onLine(wall.from, wall.to, cut)));
    passed.slice(1).forEach((next, index) => join(passed[index]!, next));
  }
  prune(neighbours);
  let best: At[] | null = null;
  const seen = new Set<string>();
  for (const [from, tos] of neighbours) {
    for (const to of tos) {
      if (seen.has(`${from} ${to}`)) continue;
      const outline = follow(neighbours, spots, from, to, seen);
      // A counter-clockwise way is a space; a clockwise one is the outside.
      if (area(outline) > 0 && inside(outline, at) && (best === null || area(outline) < area(best))) best = outline;
    }
  }
  return best && straightened(best);
}

/** The positions of another wall on a wall, in metres along it. */
function meetings(wall: Line, other: Line): number[] {
  const found: number[] = [];
  for (const end of [other.from, other.to]) {
    const { along_m, left_m, length_m } = along(end, wall.from, wall.to);
    if (Math.abs(left_m) <= SAME_M && along_m >= 0 && along_m <= length_m) found.push(along_m);
  }
  const [a, b] = [along(wall.from, other.from, other.to), along(wall.to, other.from, other.to)];
  if (a.left_m * b.left_m < 0) {
    const share = a.left_m / (a.left_m - b.left_m);
    const there = a.along_m + (b.along_m - a.along_m) * share;
    if (there >= 0 && there <= a.length_m) found.push(share * along(wall.to, wall.from, wall.to).length_m);
  }
  return found;
}

/** Removes dead ends. */
function prune(neighbours: Map<number, Set<number>>): void {
  let loose = [...neighbours].filter(([, tos]) => tos.size === 1).map(([from]) => from);
  while (loose.length > 0) {
    const next: number[] = [];
    for (const from of loose) {
      const to = [...(neighbours.get(from) ?? [])][0];
      neighbours.delete(from);
      if (to === undefined) continue;
      neighbours.get(to)?.delete(from);
      if (neighbours.get(to)?.size === 1) next.push(to);
    }
    loose = next;
  }
}

/** Follows walls, turning as far left as possible, until the way is back at its start. */
function follow(neighbours: Map<number, Set<number>>, spots: At[], first: number, second: number, seen: Set<string>): At[] {
  const outline: At[] = [];
  let [from, to] = [first, second];
  while (!seen.has(`${from} ${to}`)) {
    seen.add(`${from} ${to}`);
    outline.push(spots[from]!);
    const came = angleOf(minus(spots[from]!, spots[to]!));
    const turnOf = (next: number) => (came - angleOf(minus(spots[next]!, spots[to]!)) + 720) % 360 || 360;
    const next = [...neighbours.get(to)!].reduce((best, next) => (turnOf(next) < turnOf(best) ? next : best));
    [from, to] = [to, next];
  }
  return outline;
}

/** Removes corners on a straight line. */
function straightened(outline: At[]): At[] {
  return outline.filter((at, index) => {
    const [before, after] = [outline.at(index - 1)!, outline[(index + 1) % outline.length]!];
    return Math.abs(along(at, before, after).left_m) > 0.001;
  });
}
