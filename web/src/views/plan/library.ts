// Elements for a home: furniture of usual sizes, and sensors of all kinds. The sizes are typical ones (our choice).

import type { Product } from '../../devices';
import { type At, inside } from '../../plan/geometry';
import { rowOf, sensesMotion } from '../../plan/kinds';
import { spoken } from '../../plan/words';
import { SENSOR_KINDS } from '../../sensors';
import { madeOf } from './devices';
import { type Element, type Home, type List, type Value, formOf, of, spanOf } from './model';
import { usualOf } from './schema';
import { exact, toSegment, turnedBox, wrapped } from './shape';
import { type Targets, mount } from './snap';

export type Piece = { name: string; size_m: At; height_m: number; enterable?: true };

export const FURNITURE: { title: string; pieces: Piece[] }[] = [
  {
    title: 'Sleeping',
    pieces: [
      { name: 'bed', size_m: [2.0, 0.9], height_m: 0.6, enterable: true },
      { name: 'double bed', size_m: [2.0, 1.6], height_m: 0.6, enterable: true },
      { name: 'nightstand', size_m: [0.45, 0.4], height_m: 0.6 },
      { name: 'wardrobe', size_m: [1.8, 0.6], height_m: 2.0 },
      { name: 'dresser', size_m: [1.2, 0.5], height_m: 0.9 },
    ],
  },
  {
    title: 'Living',
    pieces: [
      { name: 'armchair', size_m: [0.85, 0.85], height_m: 1.0, enterable: true },
      { name: 'sofa', size_m: [1.9, 0.9], height_m: 0.85, enterable: true },
      { name: 'chair', size_m: [0.45, 0.45], height_m: 0.9, enterable: true },
      { name: 'table', size_m: [1.2, 0.8], height_m: 0.75 },
      { name: 'coffee table', size_m: [0.9, 0.5], height_m: 0.45 },
      { name: 'desk', size_m: [1.4, 0.7], height_m: 0.75 },
      { name: 'bookcase', size_m: [1.2, 0.3], height_m: 1.9 },
      { name: 'TV bench', size_m: [1.5, 0.45], height_m: 1.1 },
      { name: 'rug', size_m: [2.0, 1.4], height_m: 0.02, enterable: true },
    ],
  },
  {
    title: 'Bathroom',
    pieces: [
      { name: 'toilet', size_m: [0.45, 0.7], height_m: 0.45, enterable: true },
      { name: 'shower', size_m: [0.9, 0.9], height_m: 0.05, enterable: true },
      { name: 'bathtub', size_m: [1.7, 0.75], height_m: 0.55, enterable: true },
      { name: 'washbasin', size_m: [0.6, 0.5], height_m: 0.85 },
      { name: 'washing machine', size_m: [0.6, 0.6], height_m: 0.9 },
    ],
  },
  {
    title: 'Kitchen',
    pieces: [
      { name: 'fridge', size_m: [0.6, 0.65], height_m: 1.8 },
      { name: 'stove', size_m: [0.6, 0.6], height_m: 0.9 },
      { name: 'sink', size_m: [0.8, 0.6], height_m: 0.9 },
      { name: 'counter', size_m: [1.2, 0.6], height_m: 0.9 },
      { name: 'dishwasher', size_m: [0.6, 0.6], height_m: 0.85 },
      { name: 'cupboard', size_m: [1.0, 0.4], height_m: 1.9 },
    ],
  },
];

export const PIECES = FURNITURE.flatMap(({ pieces }) => pieces);

export type SensorKind = keyof typeof SENSOR_KINDS;

/** The mount of a kind of sensor: on a wall, on the ceiling over an area, on a thing, in a room, at a point of one. */
export type Mount = (typeof SENSOR_KINDS)[SensorKind]['mount'];

export const SENSORS = Object.fromEntries(Object.entries(SENSOR_KINDS).map(([kind, { mount }]) => [kind, mount])) as Record<SensorKind, Mount>;

export const DOOR_WIDTH_M = 0.9;

/** Default side of the area of a ceiling sensor. */
export const AREA_M = 1.2;

/** Largest distance from a click to the wall of a new sensor. */
export const FARTHEST_PUT_UP_M = 3;

/** A door is thin, so clicks near it count. */
const NEAR_DOOR_M = 0.25;

/** A name that no element of the home has, ignoring case. */
export function freshName(home: Home, name: string, lists?: List[]): string {
  const taken = new Set(home.elements.filter(({ list }) => !lists || lists.includes(list)).map(({ name }) => name.trim().toLowerCase()));
  let [fresh, count] = [name, 1];
  while (taken.has(fresh.trim().toLowerCase())) fresh = `${name} ${++count}`;
  return fresh;
}

function roomAt(home: Home, at: At): Element | undefined {
  return of(home, 'rooms').find((room) => inside(formOf(room) ?? [], at));
}

/** A sensor is in a room, or sees an area of it. */
function inRoom(home: Home, value: Value, room: Element | undefined): boolean {
  const spot = (value.at ?? (value.area as At[] | undefined)?.[0]) as At | undefined;
  return spot !== undefined && room !== undefined && roomAt(home, spot)?.id === room.id;
}

export function newPiece(home: Home, { name, size_m, height_m, enterable }: Piece, at: At, turn_deg = 0): Value {
  return { name: freshName(home, name), at: exact(at), size_m, turn_deg: turn_deg === 0 ? undefined : turn_deg, height_m, enterable };
}

/** A sensor at a click; if it cannot be there, a sentence with advice. */
export function newSensor(home: Home, kind: SensorKind, at: At, targets: Targets, grid_m: number | null, device?: Product): Value | string {
  const word = spoken(kind);
  const named = (of: string) => freshName(home, `${of} ${word}`.trim().slice(0, 90), ['sensors']);
  const room = roomAt(home, at);
  switch (SENSORS[kind]) {
    case 'wall': {
      const mounted = mount(at, targets, grid_m, FARTHEST_PUT_UP_M) ?? { at: exact(at), normal_deg: 0 };
      return { kind, name: named(roomAt(home, mounted.at)?.name ?? ''), at: mounted.at, height_m: usualOf(kind, 'height_m'), facing_deg: wrapped(mounted.normal_deg), ...(device && madeOf(device)) };
    }
    case 'ceiling': {
      const area = turnedBox(at, [AREA_M, AREA_M], 0).map(exact);
      return { kind, name: named(room?.name ?? ''), area };
    }
    case 'free': {
      // Without snapping it is at the click, as on the ceiling.
      const mounted = (grid_m === null ? null : mount(at, targets, grid_m, FARTHEST_PUT_UP_M)) ?? { at: exact(at), normal_deg: 0 };
      const room = roomAt(home, mounted.at);
      // A sleeping camera needs sensors that wake it: the motion sensors of its room.
      const wakers = of(home, 'sensors').filter(({ value }) => sensesMotion(value.kind) && inRoom(home, value, room));
      const woken = wakers.length > 0 ? { woken_by: wakers.map(({ name }) => name) } : { always: true };
      return room ? { kind, name: named(room.name), at: mounted.at, facing_deg: wrapped(mounted.normal_deg), ...woken } : `Click the room that the ${word} watches.`;
    }
    case 'room':
      return room ? { kind, name: named(room.name), room: room.name } : `Click the room that the ${word} sensor measures.`;
    case 'thing': {
      const thing = thingAt(home, kind, at);
      return thing ? { kind, name: named(thing.name), on: thing.name } : `Click ${SENSOR_KINDS[kind].bearers.map((bearer) => BEARERS[bearer]).join(' or ')} for the ${word} sensor.`;
    }
  }
}

type Bearer = (typeof SENSOR_KINDS)[SensorKind]['bearers'][number];

const BEARERS: Record<Bearer, string> = {
  door: 'a door',
  furniture: 'a piece of furniture',
  enterable: 'a piece of furniture that residents can be in or on',
  lamp: 'the floor of a room, for its lamp',
};

/** The possible bearers of a sensor, in the order of the search. */
export function bearersOf(home: Home, kind: unknown): Element[] {
  const furniture = of(home, 'furniture');
  const borne: Record<Bearer, () => Element[]> = {
    door: () => of(home, 'doors'),
    furniture: () => furniture,
    enterable: () => furniture.filter(({ value }) => value.enterable === true),
    lamp: () => of(home, 'rooms'),
  };
  const bearers = rowOf(String(kind))?.bearers ?? [];
  return bearers.length > 0 ? bearers.flatMap((bearer) => borne[bearer]()) : furniture;
}

function thingAt(home: Home, kind: SensorKind, at: At): Element | undefined {
  return bearersOf(home, kind).find((thing) => {
    if (thing.name === '') return false;
    const span = thing.list === 'doors' ? spanOf(thing) : null;
    return span ? toSegment(at, span.from, span.to) <= NEAR_DOOR_M : inside(formOf(thing) ?? [], at);
  });
}

/** A copy with a name of its own; a sensor keeps its bearer. */
export function copyOf(home: Home, { list, value, name }: Element): Value {
  return name === '' ? { ...value } : { ...value, name: freshName(home, name.replace(/ \d+$/, ''), list === 'sensors' ? ['sensors'] : undefined) };
}
