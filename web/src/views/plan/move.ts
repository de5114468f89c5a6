// Changes of the file when something is moved, turned or pulled at a handle. All values are computed from the home
// before the movement, so that nothing is rounded twice.

import type { Change } from '../../json';
import { type At, distance, middle, minus } from '../../plan/geometry';
import { mountOf } from '../../plan/kinds';
import { type Element, type Home, IN_WALL_M, atOf, bearerOf, cornersKey, formOf, number, of, point, points, spanOf, wallsOf } from './model';
import { takes } from './schema';
import { add, along, angleOf, direction, dot, exact, onLine, rounded, times, toSegment, turn, wrapped } from './shape';
import { type Guides, type Snapping, mount, snapPoint, snapShift, spanAt, targetsOf } from './snap';

type How = {
  /** Null without snapping. */
  snapping: Snapping | null;
  /** For a wall: its attached elements stay behind. */
  alone: boolean;
};

export type Moved = { changes: Change[]; guides: Guides };

/** Points within this distance are one. */
const SAME_M = 0.002;
/** Largest distance of a sensor on a wall from the wall's face. */
const HANGS_M = 0.08;

const LEAST_SIZE_M = 0.05;

function path(element: Element, ...rest: (string | number)[]): (string | number)[] {
  return [element.list, element.index, ...rest];
}

export function move(home: Home, elements: Element[], by: At, { snapping, alone }: How): Moved {
  const one = elements.length === 1 ? elements[0] : undefined;
  if (one?.list === 'doors') return { changes: moveDoor(home, one, by, snapping), guides: {} };
  if (one && mountOf(one.value.kind) === 'wall' && snapping) return moveLens(home, one, by, snapping);
  const shifted = snapping ? snapElements(home, elements, by, snapping) : { shift: by, guides: {} };
  const { shift } = shifted;
  const walls = elements.filter(({ list }) => list === 'walls');
  const ids = new Set(elements.map(({ id }) => id));
  const changes = moveWalls(home, new Map(walls.flatMap((wall) => {
    const span = spanOf(wall);
    return span ? [[wall.id, { from: exact(add(span.from, shift)), to: exact(add(span.to, shift)) }] as const] : [];
  })), alone, ids);
  for (const element of elements) {
    if (element.list === 'walls') continue;
    const key = cornersKey(element);
    const [at, span] = [atOf(element), spanOf(element)];
    if (key) changes.push({ path: path(element, key), value: points(element.value[key])!.map((at) => exact(add(at, shift))) });
    else if (at) changes.push({ path: path(element, 'at'), value: exact(add(at, shift)) });
    else if (span) for (const end of ['from', 'to'] as const) changes.push({ path: path(element, end), value: exact(add(span[end], shift)) });
  }
  return { changes, guides: shifted.guides };
}

function snapElements(home: Home, elements: Element[], by: At, snapping: Snapping) {
  const marks = elements.flatMap((element) => {
    const span = spanOf(element);
    if (span) return [span.from, span.to];
    const [form, at] = [formOf(element), atOf(element)];
    return form ? [...(at ? [at] : []), ...form] : at ? [at] : [];
  });
  const targets = targetsOf(home, new Set(elements.map(({ id }) => id)));
  // A piece of furniture that snapped to a wall's line would stand in the wall.
  return snapShift(by, marks, elements.every(({ list }) => list === 'furniture') ? targets.faces : targets, snapping);
}

function moveLens(home: Home, sensor: Element, by: At, snapping: Snapping): Moved {
  const at = atOf(sensor);
  if (!at) return { changes: [], guides: {} };
  const targets = targetsOf(home, new Set());
  const to = add(at, by);
  const now = mount(to, targets, snapping.grid_m);
  if (!now) {
    const { at: free, guides } = snapPoint(to, { ...targets, ends: [], xs: [], ys: [], walls: [] }, snapping);
    return { changes: [{ path: path(sensor, 'at'), value: free }], guides };
  }
  const before = mount(at, targets, null);
  const facing = number(sensor.value.facing_deg);
  const changes: Change[] = [{ path: path(sensor, 'at'), value: now.at }];
  const turned = before ? now.normal_deg - before.normal_deg : 0;
  // On another wall it faces the room as on the old one.
  if (facing !== null && Math.abs(turned) > 0.01) changes.push({ path: path(sensor, 'facing_deg'), value: wrapped(facing + turned) });
  return { changes, guides: {} };
}

function moveDoor(home: Home, door: Element, by: At, snapping: Snapping | null): Change[] {
  const span = spanOf(door);
  if (!span) return [];
  const width = distance(span.from, span.to);
  const to = add(middle([span.from, span.to]), by);
  const walls = wallsOf(home);
  const placed = spanAt(to, walls, width, snapping?.grid_m ?? null, holding(walls, span));
  if (!placed) return [];
  // The hinge stays at the same end.
  const turned = dot(minus(placed.to, placed.from), minus(span.to, span.from)) < 0;
  const [from, end] = turned ? [placed.to, placed.from] : [placed.from, placed.to];
  return [{ path: path(door, 'from'), value: from }, { path: path(door, 'to'), value: end }];
}

type Span = { from: At; to: At };
type Walls = ReturnType<typeof wallsOf>;

function holding(walls: Walls, { from, to }: Span): Walls[number] | undefined {
  return walls.find((wall) => [from, to].every((at) => toSegment(at, wall.from, wall.to) <= IN_WALL_M));
}

/** Moves the ends of walls, together with attached elements: adjoining walls, doors, corners of rooms, sensors. */
export function moveWalls(home: Home, moved: Map<string, Span>, alone: boolean, except = new Set<string>()): Change[] {
  const walls = wallsOf(home);
  const spans = new Map(moved);
  if (!alone) {
    for (const { element, from, to } of walls) {
      if (moved.has(element.id)) continue;
      const ends = { from: carried(from, walls, moved), to: carried(to, walls, moved) };
      if (ends.from || ends.to) spans.set(element.id, { from: ends.from ?? from, to: ends.to ?? to });
    }
  }
  const changes: Change[] = [];
  for (const { element } of walls) {
    const span = spans.get(element.id);
    if (span) for (const end of ['from', 'to'] as const) changes.push({ path: path(element, end), value: span[end] });
  }
  if (alone || moved.size === 0) return changes;
  for (const door of of(home, 'doors')) if (!except.has(door.id)) changes.push(...carryDoor(door, walls, spans));
  for (const room of of(home, 'rooms')) {
    const corners = except.has(room.id) || !cornersKey(room) ? null : points(room.value.outline);
    corners?.forEach((corner, index) => {
      const to = carried(corner, walls, spans);
      if (to) changes.push({ path: path(room, 'outline', index), value: to });
    });
  }
  for (const sensor of of(home, 'sensors')) {
    const at = mountOf(sensor.value.kind) === 'wall' && !except.has(sensor.id) ? atOf(sensor) : null;
    const shift = at && shiftOf(at, walls, spans);
    if (at && shift) changes.push({ path: path(sensor, 'at'), value: exact(add(at, shift)) });
  }
  return changes;
}

/** The new place of a point on a wall's line: ends move with the wall, points between them only across it. */
function carried(at: At, walls: Walls, spans: Map<string, Span>): At | null {
  for (const { element, from, to } of walls) {
    const span = spans.get(element.id);
    if (!span) continue;
    if (distance(at, from) <= SAME_M) return span.from;
    if (distance(at, to) <= SAME_M) return span.to;
  }
  for (const { element, from, to } of walls) {
    const span = spans.get(element.id);
    if (span && toSegment(at, from, to) <= SAME_M) return exact(add(at, across(at, from, to, span)));
  }
  return null;
}

function across(at: At, from: At, to: At, span: Span): At {
  const { along_m, length_m } = along(at, from, to);
  const share = length_m === 0 ? 0 : along_m / length_m;
  const by = add(times(minus(span.from, from), 1 - share), times(minus(span.to, to), share));
  const way = times(minus(to, from), 1 / (length_m || 1));
  return minus(by, times(way, dot(by, way)));
}

function carryDoor(door: Element, walls: Walls, spans: Map<string, Span>): Change[] {
  const jambs = spanOf(door);
  const wall = jambs && holding(walls.filter(({ element }) => spans.has(element.id)), jambs);
  const span = wall && spans.get(wall.element.id);
  if (!jambs || !wall || !span) return [];
  const length_m = distance(span.from, span.to);
  const before_m = distance(wall.from, wall.to);
  // Its distance from the end that stays; for a moved wall, from its beginning.
  const keepsTo = distance(span.to, wall.to) <= SAME_M && distance(span.from, wall.from) > SAME_M;
  const place = (at: At) => {
    const { along_m } = along(at, wall.from, wall.to);
    return exact(onLine(span.from, span.to, keepsTo ? length_m - (before_m - along_m) : along_m));
  };
  return [{ path: path(door, 'from'), value: place(jambs.from) }, { path: path(door, 'to'), value: place(jambs.to) }];
}

/** The move of a sensor with its walls; in a corner, each in its own direction. */
function shiftOf(at: At, walls: Walls, spans: Map<string, Span>): At | null {
  let shift: At | null = null;
  for (const { element, from, to, thickness_m } of walls) {
    const span = spans.get(element.id);
    if (!span || toSegment(at, from, to) > thickness_m / 2 + HANGS_M) continue;
    const by = across(at, from, to, span);
    const more = (a: number, b: number) => (Math.abs(a) > Math.abs(b) ? a : b);
    shift = shift ? [more(shift[0], by[0]), more(shift[1], by[1])] : by;
  }
  return shift && Math.hypot(...shift) > 0.0005 ? shift : null;
}

/** Counter-clockwise, about its middle. */
export function turnBy(element: Element, deg: number): Change[] {
  if (takes(element, 'facing_deg')) {
    const facing = number(element.value.facing_deg) ?? 0;
    return [{ path: path(element, 'facing_deg'), value: wrapped(facing + deg) }];
  }
  if (element.list === 'furniture' && atOf(element)) {
    const to = wrapped((number(element.value.turn_deg) ?? 0) + deg);
    return [{ path: path(element, 'turn_deg'), value: to === 0 && !('turn_deg' in element.value) ? undefined : to }];
  }
  const key = cornersKey(element);
  if (key) {
    const corners = points(element.value[key])!;
    return [{ path: path(element, key), value: corners.map((at) => exact(turn(at, middle(corners), deg))) }];
  }
  return [];
}

export type Handle = {
  key: string;
  label: string;
  shape: 'point' | 'size' | 'turn' | 'aim';
  at: At;
};

/** The handles of an element; `off_m` is the distance of the handles that turn it. */
export function handlesOf(element: Element, off_m: number): Handle[] {
  const span = spanOf(element);
  if (span) {
    return (['from', 'to'] as const).map((key) => ({ key, label: key === 'from' ? 'first end' : 'second end', shape: 'point', at: span[key] }));
  }
  const corners = cornersKey(element);
  if (corners) return points(element.value[corners])!.map((at, index) => ({ key: `${corners}/${index}`, label: `corner ${index + 1}`, shape: 'point', at }));
  const [at, size] = [atOf(element), point(element.value.size_m)];
  if (takes(element, 'facing_deg') && at) {
    return [{ key: 'aim', label: 'direction', shape: 'aim', at: add(at, times(direction(number(element.value.facing_deg) ?? 0), off_m)) }];
  }
  if (element.list !== 'furniture' || !at || !size) return [];
  const deg = number(element.value.turn_deg) ?? 0;
  const form = formOf(element)!;
  const top = add(at, times(direction(deg + 90), size[1] / 2 + off_m * 0.6));
  return [
    ...form.map((at, index): Handle => ({ key: `size/${index}`, label: `corner ${index + 1}, to resize`, shape: 'size', at })),
    { key: 'turn', label: 'turn', shape: 'turn', at: top },
  ];
}

/** Pulls a handle to a point. */
export function pull(home: Home, element: Element, key: string, to: At, { snapping, alone }: How): Moved {
  const at = atOf(element);
  const step = snapping ? 5 : 1;
  if (key === 'aim' && at) {
    return { changes: [{ path: path(element, 'facing_deg'), value: wrapped(Math.round(angleOf(minus(to, at)) / step) * step) }], guides: {} };
  }
  if (key === 'turn' && at) {
    return { changes: [{ path: path(element, 'turn_deg'), value: wrapped(Math.round((angleOf(minus(to, at)) - 90) / step) * step) }], guides: {} };
  }
  if (element.list === 'doors' && (key === 'from' || key === 'to')) return { changes: pullJamb(home, element, key, to, snapping), guides: {} };
  const snapped = snapping ? snapPoint(to, targetsOf(home, new Set([element.id, ...attachedTo(home, element, key, alone)])), snapping) : { at: exact(to), guides: {} };
  if (element.list === 'walls' && (key === 'from' || key === 'to')) {
    const span = spanOf(element)!;
    return { changes: moveWalls(home, new Map([[element.id, { ...span, [key]: snapped.at }]]), alone), guides: snapped.guides };
  }
  const [list, index] = key.split('/');
  if (list === 'size') return { changes: resize(element, Number(index), snapped.at), guides: snapped.guides };
  return { changes: [{ path: path(element, list!, Number(index)), value: snapped.at }], guides: snapped.guides };
}

/** Elements that move along with the end of a wall are no targets of snapping. */
function attachedTo(home: Home, element: Element, key: string, alone: boolean): string[] {
  const at = element.list === 'walls' && !alone ? point(element.value[key]) : null;
  if (!at) return [];
  const walls = wallsOf(home).filter(({ from, to }) => Math.min(distance(from, at), distance(to, at)) <= SAME_M);
  const rooms = of(home, 'rooms').filter((room) => formOf(room)?.some((corner) => distance(corner, at) <= SAME_M));
  return [...walls.map(({ element }) => element.id), ...rooms.map(({ id }) => id)];
}

function pullJamb(home: Home, door: Element, key: 'from' | 'to', to: At, snapping: Snapping | null): Change[] {
  const span = spanOf(door);
  const other = span?.[key === 'from' ? 'to' : 'from'];
  const wall = other && wallsOf(home).filter(({ from, to: end }) => toSegment(other, from, end) <= 0.02).sort((a, b) => toSegment(to, a.from, a.to) - toSegment(to, b.from, b.to))[0];
  if (!wall) return [{ path: path(door, key), value: exact(to) }];
  const { along_m, length_m } = along(to, wall.from, wall.to);
  const grid = snapping ? rounded(Math.round(along_m / snapping.grid_m) * snapping.grid_m) : along_m;
  return [{ path: path(door, key), value: exact(onLine(wall.from, wall.to, Math.min(Math.max(grid, 0), length_m))) }];
}

/** The opposite corner stays. */
function resize(element: Element, corner: number, to: At): Change[] {
  const form = formOf(element);
  const opposite = form?.[(corner + 2) % 4];
  if (!opposite) return [];
  const deg = number(element.value.turn_deg) ?? 0;
  const off = minus(to, opposite);
  const sides = [dot(off, direction(deg)), dot(off, direction(deg + 90))] as const;
  const sign = [[-1, -1], [1, -1], [1, 1], [-1, 1]][corner]!;
  const size = sides.map((side, axis) => Math.max(rounded(side * sign[axis]!), LEAST_SIZE_M)) as At;
  const half = add(times(direction(deg), (size[0] * sign[0]!) / 2), times(direction(deg + 90), (size[1] * sign[1]!) / 2));
  return [{ path: path(element, 'size_m'), value: size }, { path: path(element, 'at'), value: exact(add(opposite, half)) }];
}

/** Renames an element, also as a bearer of sensors. */
export function rename(home: Home, element: Element, name: string): Change[] {
  const changes: Change[] = [{ path: path(element, 'name'), value: name }];
  for (const sensor of of(home, 'sensors')) {
    if (bearerOf(home, sensor) !== element) continue;
    const key = sensor.value.on === element.name ? 'on' : 'room';
    changes.push({ path: path(sensor, key), value: name });
  }
  return changes;
}
