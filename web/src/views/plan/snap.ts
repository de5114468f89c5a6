// Targets of snapping for points and shapes: ends and lines of walls, the faces of walls, and the grid.

import { type At, distance, inside, minus } from '../../plan/geometry';
import { type Home, type Wall, formOf, of, wallsOf } from './model';
import { add, along, angleOf, clamp, direction, exact, onLine, times, toSegment, turnedBox, wrapped } from './shape';
import type { Units } from '../../units';

/** Distance of a lens from the wall: a small case. */
const LENS_OFF_WALL_M = 0.02;
/** Distance from a wall's face of a point next to the wall. */
const BESIDE_M = 0.05;
/** Distance that a door is dragged off its wall before it moves to another. */
const KEEPS_M = 0.4;
/** Distance at which a piece of furniture is placed against a wall. */
const NEAR_WALL_M = 0.3;
/** Largest distance of a wall that attracts sensors. */
const FARTHEST_MOUNT_M = 0.5;

/** Five centimetres, or two inches. */
export function gridOf(units: Units): number {
  return units === 'metric' ? 0.05 : 0.0508;
}

/** `xs` and `ys` are the lines of walls and their faces; furniture stands against faces alone. */
export type Targets = { walls: Wall[]; ends: At[]; xs: number[]; ys: number[]; faces: { xs: number[]; ys: number[] }; rooms: At[][] };

export type Snapping = { tolerance_m: number; grid_m: number };

export type Guides = { x?: number | undefined; y?: number | undefined };

/** Those of a home stay the same during a drag. */
let known: { home: Home; except: string; targets: Targets } | null = null;

/** Elements that do not move along. */
export function targetsOf(home: Home, except: Set<string>): Targets {
  const key = [...except].join();
  if (known?.home !== home || known.except !== key) known = { home, except: key, targets: findTargets(home, except) };
  return known.targets;
}

function findTargets(home: Home, except: Set<string>): Targets {
  const walls = wallsOf(home).filter(({ element }) => !except.has(element.id));
  const rooms = of(home, 'rooms').flatMap((room) => {
    const form = formOf(room);
    return form ? [form] : [];
  });
  const corners = of(home, 'rooms').filter(({ id }) => !except.has(id)).flatMap((room) => formOf(room) ?? []);
  const ends = [...walls.flatMap(({ from, to }) => [from, to]), ...corners];
  const faces = { xs: [] as number[], ys: [] as number[] };
  // The faces of walls along the grid, as targets of furniture; faces on the outside are left out.
  for (const wall of walls) {
    for (const side of [1, -1]) {
      const [x, y] = face(wall, side, 0.5, 0);
      const isIn = rooms.length === 0 || [0.05, 0.25, 0.5, 0.75, 0.95].some((share) => rooms.some((room) => inside(room, face(wall, side, share, BESIDE_M))));
      if (isIn && Math.abs(wall.from[0] - wall.to[0]) < 0.001) faces.xs.push(x);
      if (isIn && Math.abs(wall.from[1] - wall.to[1]) < 0.001) faces.ys.push(y);
    }
  }
  const [xs, ys] = [[...ends.map(([x]) => x), ...faces.xs], [...ends.map(([, y]) => y), ...faces.ys]];
  return { walls, ends, xs, ys, faces, rooms };
}

/** A point next to a wall, at a distance along it and off its face. */
function face({ from, to, thickness_m }: Wall, side: number, share: number, off_m: number): At {
  const normal = direction(angleOf(minus(to, from)) + 90 * side);
  return add(add(times(from, 1 - share), times(to, share)), times(normal, thickness_m / 2 + off_m));
}

function toGrid(value: number, grid_m: number): number {
  return Math.round(value / grid_m) * grid_m;
}

function nearest(value: number, to: number[], tolerance_m: number): number | undefined {
  let [best, far] = [undefined as number | undefined, tolerance_m];
  for (const other of to) {
    if (Math.abs(other - value) <= far) [best, far] = [other, Math.abs(other - value)];
  }
  return best;
}

/** A single point: of a wall, a room or an area. */
export function snapPoint(at: At, targets: Targets, { tolerance_m, grid_m }: Snapping): { at: At; guides: Guides } {
  const end = targets.ends.filter((end) => distance(end, at) <= tolerance_m).sort((a, b) => distance(a, at) - distance(b, at))[0];
  if (end) return { at: end, guides: { x: end[0], y: end[1] } };
  const [x, y] = [nearest(at[0], targets.xs, tolerance_m), nearest(at[1], targets.ys, tolerance_m)];
  if (x === undefined && y === undefined) {
    const wall = targets.walls.find(({ from, to }) => toSegment(at, from, to) <= tolerance_m);
    if (wall) return { at: onLine(wall.from, wall.to, along(at, wall.from, wall.to).along_m), guides: {} };
  }
  return { at: exact([x ?? toGrid(at[0], grid_m), y ?? toGrid(at[1], grid_m)]), guides: { x, y } };
}

/** A shape as a whole: one of its lines snaps to a line of the home, or its first point to the grid, if the grid is finite. */
export function snapShift(shift: At, marks: At[], targets: Pick<Targets, 'xs' | 'ys'>, { tolerance_m, grid_m }: Snapping): { shift: At; guides: Guides } {
  const first = marks[0];
  if (first === undefined) return { shift, guides: {} };
  const guides: Guides = {};
  const axis = (index: 0 | 1, lines: number[]) => {
    let [best, far] = [undefined as number | undefined, tolerance_m];
    for (const mark of marks) {
      const line = nearest(mark[index] + shift[index], lines, far);
      if (line === undefined) continue;
      [best, far] = [line - mark[index], Math.abs(line - mark[index] - shift[index])];
      guides[index === 0 ? 'x' : 'y'] = line;
    }
    if (best !== undefined) return best;
    return grid_m === Infinity ? shift[index] : toGrid(first[index] + shift[index], grid_m) - first[index];
  };
  return { shift: [axis(0, targets.xs), axis(1, targets.ys)], guides };
}

export type Mount = { at: At; normal_deg: number };

/** The place on the nearest wall's face for a lens that faces a room. */
export function mount(at: At, targets: Targets, grid_m: number | null, farthest_m = FARTHEST_MOUNT_M): Mount | null {
  let best: (Mount & { cost: number }) | null = null;
  for (const { from, to, thickness_m } of targets.walls) {
    const { along_m, length_m } = along(at, from, to);
    if (length_m === 0) continue;
    const there = clamp(grid_m === null ? along_m : toGrid(along_m, grid_m), 0, length_m);
    for (const side of [1, -1]) {
      const normal_deg = angleOf(minus(to, from)) + 90 * side;
      const lens = add(onLine(from, to, there), times(direction(normal_deg), thickness_m / 2 + LENS_OFF_WALL_M));
      const far = distance(lens, at);
      const isIn = targets.rooms.length === 0 || targets.rooms.some((room) => inside(room, lens));
      const cost = far + (isIn ? 0 : 10);
      if (far <= farthest_m + thickness_m && (best === null || cost < best.cost)) best = { at: exact(lens), normal_deg, cost };
    }
  }
  return best;
}

/** The place of a piece with its back at the face of a near wall; null without one. */
export function flush(at: At, size: At, back: 'short' | 'long', targets: Targets, { tolerance_m, grid_m }: Snapping): { at: At; turn_deg: number } | null {
  // The back of an unturned piece is above; of a piece that is wider than deep with its back at a short side, to the
  // left.
  const aside = back === 'short' && size[0] > size[1];
  const depth_m = aside ? size[0] : size[1];
  const there = mount(at, targets, grid_m, depth_m / 2 + Math.max(tolerance_m, NEAR_WALL_M));
  if (there === null) return null;
  const into = direction(there.normal_deg);
  const turn_deg = wrapped(there.normal_deg + (aside ? 0 : 90));
  const stands = add(there.at, times(into, depth_m / 2 - LENS_OFF_WALL_M));
  const { shift } = snapShift([0, 0], turnedBox(stands, size, turn_deg), targets.faces, { tolerance_m, grid_m: Infinity });
  const way = direction(there.normal_deg + 90);
  const beside = shift[0] * way[0] + shift[1] * way[1];
  return { at: exact(add(stands, times(way, beside))), turn_deg };
}

/** The span in the nearest wall for a door of this width; its present wall is preferred. */
export function spanAt(at: At, walls: Wall[], width_m: number, grid_m: number | null, own?: Wall): { from: At; to: At } | null {
  const far = (wall: Wall) => toSegment(at, wall.from, wall.to) - (wall === own ? KEEPS_M : 0);
  const sorted = [...walls].sort((a, b) => far(a) - far(b));
  const wall = sorted.find(({ from, to }) => distance(from, to) >= width_m) ?? sorted[0];
  if (wall === undefined) return null;
  const { along_m, length_m } = along(at, wall.from, wall.to);
  const begin = grid_m === null ? along_m - width_m / 2 : toGrid(along_m - width_m / 2, grid_m);
  const least = clamp(begin, 0, length_m - width_m);
  return { from: exact(onLine(wall.from, wall.to, least)), to: exact(onLine(wall.from, wall.to, least + Math.min(width_m, length_m))) };
}
