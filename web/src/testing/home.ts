// A made-up home with any number of sensors, for tests, for measuring, and for looking at the page without a server.

import type { At } from '../plan/geometry';
import { daysFrom } from './dates';
import type { DoorView, HomeView, RoomView, RunView, SensorView, SolidView, ThingView } from '../wire';

type Rect = [number, number, number, number];

const ROOMS: [string, Rect][] = [
  ['sitting room', [0, 0, 5.4, 4.4]],
  ['kitchen', [5.4, 0, 9, 3.4]],
  ['bathroom', [9, 0, 12, 3.4]],
  ['hall', [5.4, 3.4, 12, 4.6]],
  ['bedroom', [0, 4.4, 5.4, 8]],
  ['study', [5.4, 4.6, 8.6, 8]],
  ['guest room', [8.6, 4.6, 12, 8]],
];

const DOORS: [string, At, At, boolean, boolean][] = [
  ['sitting room door', [5.4, 3.5], [5.4, 4.3], true, false],
  ['bedroom door', [4.2, 4.4], [5.05, 4.4], true, false],
  ['kitchen door', [6.6, 3.4], [7.5, 3.4], true, false],
  ['bathroom door', [9.4, 3.4], [10.2, 3.4], false, false],
  ['study door', [6.2, 4.6], [7.05, 4.6], true, false],
  ['guest room door', [9.3, 4.6], [10.15, 4.6], true, false],
  ['front door', [12, 3.55], [12, 4.45], false, true],
];

const FURNITURE: [string, Rect, boolean][] = [
  ['sofa', [0.15, 0.9, 1.0, 2.9], true],
  ['low table', [1.5, 1.5, 2.2, 2.5], false],
  ['armchair', [2.9, 0.3, 3.75, 1.15], true],
  ['bookcase', [0.15, 3.9, 2.1, 4.25], false],
  ['television', [4.9, 1.3, 5.25, 2.7], false],
  ['cooker', [5.5, 0.1, 6.1, 0.7], false],
  ['worktop', [6.1, 0.1, 7.7, 0.7], false],
  ['sink', [7.7, 0.1, 8.4, 0.7], false],
  ['refrigerator', [8.4, 0.1, 8.9, 0.8], false],
  ['kitchen table', [7.6, 1.7, 8.8, 2.5], false],
  ['shower', [11, 0.1, 11.9, 1.1], true],
  ['toilet', [11.2, 2.0, 11.9, 2.5], true],
  ['washbasin', [9.6, 0.1, 10.4, 0.6], false],
  ['bed', [0.15, 5.6, 2.2, 7.2], true],
  ['wardrobe', [2.6, 7.3, 4.8, 7.9], false],
  ['chest of drawers', [4.8, 5.3, 5.3, 6.6], false],
  ['desk', [5.5, 6.9, 7.1, 7.9], false],
  ['desk chair', [6.0, 6.2, 6.6, 6.8], true],
  ['guest bed', [10.7, 5.8, 11.9, 7.8], true],
  ['coat rack', [7.9, 4.2, 8.9, 4.5], false],
];

const THINGS: [string, ThingView['kind']][] = [
  ...DOORS.map(([name]) => [name, 'door'] as [string, 'door']),
  ['cooker', 'furniture'],
  ['television', 'furniture'],
  ['sink', 'furniture'],
  ['refrigerator', 'furniture'],
  ...ROOMS.map(([name]) => [name, 'lamp'] as [string, 'lamp']),
];

const HOUR_US = 3_600_000_000;
const LENGTH_US = 30 * 24 * HOUR_US;

const KINDS = ['bed', 'contact', 'stove_temperature', 'pressure', 'power', 'flow', 'light', 'temperature', 'ceiling_motion'];

function corners([left, bottom, right, top]: Rect): At[] {
  return [[left, bottom], [right, bottom], [right, top], [left, top]];
}

function centre([left, bottom, right, top]: Rect): At {
  return [(left + right) / 2, (bottom + top) / 2];
}

const VERBS: Record<ThingView['kind'], [string, string]> = { door: ['Open', 'Close'], furniture: ['Use', 'Stop using'], lamp: ['Turn on', 'Turn off'] };

export function madeUpHome(sensors = 18, names: (name: string) => string = (name) => name): HomeView {
  const rooms: RoomView[] = ROOMS.map(([name, rect]) => ({ name: names(name), outline: corners(rect), middle: centre(rect), floor: null }));
  const solids: SolidView[] = [
    ...walls().map((outline) => ({ kind: 'wall' as const, name: null, outline, enterable: false })),
    ...FURNITURE.map(([name, rect, enterable]) => ({ kind: 'furniture' as const, name: names(name), outline: corners(rect), enterable })),
  ];
  const doors: DoorView[] = DOORS.map(([name, from, to, open, outside]) => ({ name: names(name), from, to, open, outside }));
  const things: ThingView[] = THINGS.map(([name, kind]) => ({ name: names(name), kind, at: placeOf(name), verbs: VERBS[kind] }));
  return {
    name: names('Made-up cottage'),
    bounds: [[-0.1, -0.1], [12.1, 8.1]],
    rooms, solids, doors, things,
    sensors: Array.from({ length: sensors }, (_, index) => sensor(index, names)),
  };
}

export function madeUpRun(residents = 2, sensors = 18, driven: number | null = null, names: (name: string) => string = (name) => name): RunView {
  const people = ['Agnes', 'Bertram', 'Carla', 'Dietmar', 'Edith', 'Fritz', 'Greta', 'Hugo', 'Irma', 'Jakob'];
  return {
    id: 'cottage-1',
    scenario: names('Made-up cottage'),
    home: madeUpHome(sensors, names),
    residents: Array.from({ length: residents }, (_, index) => ({ name: names(people[index % people.length]!), radius_m: 0.22 })),
    driven,
    length_us: LENGTH_US,
    seed: 7,
    conditions: [],
    without: [],
    nights: [], days: daysFrom('2009-03-02', LENGTH_US, 6 * HOUR_US + 55 * 60_000_000),
    log: ['sqlite:log.db'],
    replay: false,
    files: {},
  };
}

/** The neighbours of a room's doors, for wanderers. */
export const DOORWAYS: [number, number, At][] = [
  [0, 3, [5.4, 3.9]], [0, 4, [4.62, 4.4]], [1, 3, [7.05, 3.4]], [2, 3, [9.8, 3.4]], [3, 5, [6.6, 4.6]], [3, 6, [9.7, 4.6]],
];

/** A free point in a room. */
export function spotIn(room: number, chance: () => number): At {
  const [left, bottom, right, top] = ROOMS[room]![1];
  return [left + (right - left) * (0.35 + 0.3 * chance()), bottom + (top - bottom) * (0.35 + 0.3 * chance())];
}

function placeOf(name: string): At {
  const door = DOORS.find(([of]) => of === name);
  if (door) return [(door[1][0] + door[2][0]) / 2, (door[1][1] + door[2][1]) / 2];
  const piece = FURNITURE.find(([of]) => of === name) ?? ROOMS.find(([of]) => of === name)!;
  return centre(piece[1]);
}

/** Walls along the edges of all rooms, with gaps for doors. */
function walls(): At[][] {
  const edges = new Map<string, [number, number][]>();
  for (const [, [left, bottom, right, top]] of ROOMS) {
    for (const x of [left, right]) (edges.get(`x${x}`) ?? edges.set(`x${x}`, []).get(`x${x}`)!).push([bottom, top]);
    for (const y of [bottom, top]) (edges.get(`y${y}`) ?? edges.set(`y${y}`, []).get(`y${y}`)!).push([left, right]);
  }
  return [...edges].flatMap(([line, spans]) => {
    const [axis, at] = [line[0], Number(line.slice(1))];
    const outer = at === 0 || at === (axis === 'x' ? 12 : 8);
    const half = outer ? 0.1 : 0.05;
    const gaps = DOORS.filter(([, from, to]) => (axis === 'x' ? from[0] === at && to[0] === at : from[1] === at && to[1] === at));
    const cuts = gaps.map(([, from, to]) => (axis === 'x' ? [from[1], to[1]] : [from[0], to[0]]) as [number, number]);
    return without(spans, cuts).map(([from, to]) =>
      axis === 'x' ? corners([at - half, from - half, at + half, to + half]) : corners([from - half, at - half, to + half, at + half]),
    );
  });
}

function without(spans: [number, number][], cuts: [number, number][]): [number, number][] {
  return spans.flatMap(([from, to]) => {
    const parts: [number, number][] = [];
    let begin = from;
    for (const [open, shut] of [...cuts].filter(([open]) => open >= from && open < to).sort((a, b) => a[0] - b[0])) {
      // Half a wall's thickness is added at each end again.
      parts.push([begin, open - 0.1]);
      begin = shut + 0.1;
    }
    parts.push([begin, to]);
    return parts.filter(([a, b]) => b > a);
  });
}

/** Six in ten are motion sensors on a wall, each facing its room; the rest are of all other kinds. */
function sensor(index: number, names: (name: string) => string): SensorView {
  const [room, [left, bottom, right, top]] = ROOMS[index % ROOMS.length]!;
  const round = Math.floor(index / ROOMS.length);
  if (index % 5 < 3) {
    const corner = (index * 3 + round) % 4;
    const at: At = [corner % 2 ? right - 0.12 - 0.25 * round * 0.4 : left + 0.12 + 0.25 * round * 0.4, corner < 2 ? bottom + 0.15 : top - 0.15];
    const towards = Math.atan2((bottom + top) / 2 - at[1], (left + right) / 2 - at[0]);
    return { name: names(`${room} motion${round > 0 ? ` ${round + 1}` : ''}`), kind: 'motion', room: names(room), at, facing_deg: (towards * 180) / Math.PI, beams: fan(at, towards, [left, bottom, right, top]), area: null, camera: null };
  }
  const kind = KINDS[(index + round) % KINDS.length]!;
  const at: At = [left + 0.6 + ((index * 0.83) % Math.max(right - left - 1.2, 0.1)), bottom + 0.6 + ((index * 0.47) % Math.max(top - bottom - 1, 0.1))];
  const area: At[] | null = ['ceiling_motion', 'bed', 'pressure'].includes(kind) ? corners([at[0] - 0.5, at[1] - 0.4, at[0] + 0.5, at[1] + 0.4]) : null;
  return { name: names(`${room} ${kind.replaceAll('_', ' ')}${round > 0 ? ` ${round + 1}` : ''}`), kind, room: names(room), at, facing_deg: null, beams: [], area, camera: null };
}

function fan(at: At, towards: number, [left, bottom, right, top]: Rect): [At, At][] {
  return Array.from({ length: 32 }, (_, index) => {
    const angle = towards + ((index - 15.5) / 31) * 1.9;
    const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
    const far = Math.min(
      dx > 0 ? (right - at[0]) / dx : dx < 0 ? (left - at[0]) / dx : Infinity,
      dy > 0 ? (top - at[1]) / dy : dy < 0 ? (bottom - at[1]) / dy : Infinity,
      10,
    );
    const end: At = [at[0] + dx * Math.max(far - 0.05, 0), at[1] + dy * Math.max(far - 0.05, 0)];
    const near = Math.min(0.4, Math.max(far - 0.05, 0));
    return [[at[0] + dx * near, at[1] + dy * near], end];
  });
}
