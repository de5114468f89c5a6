// The home by its file's text. It is drawn with its problems; elements without a place or a form are only in the list.

import { type Node, getNodeValue } from 'jsonc-parser';
import { type Fault, isFault, tree } from '../../json';
import { type At, middle } from '../../plan/geometry';
import { spoken } from '../../plan/words';
import { thick, turnedBox } from './shape';

export const LISTS = ['rooms', 'walls', 'doors', 'furniture', 'places', 'sensors'] as const;

export type List = (typeof LISTS)[number];

export const NOUNS: Record<List, { one: string; many: string }> = {
  rooms: { one: 'room', many: 'rooms' },
  walls: { one: 'wall', many: 'walls' },
  doors: { one: 'door', many: 'doors' },
  furniture: { one: 'piece of furniture', many: 'furniture' },
  places: { one: 'place', many: 'places' },
  sensors: { one: 'sensor', many: 'sensors' },
};

export type Value = Record<string, unknown>;

export type Element = {
  /** Such as `walls/3`. */
  id: string;
  list: List;
  index: number;
  /** Empty for elements without a name, such as walls. */
  name: string;
  value: Value;
  offset: number;
  length: number;
};

export type Home = {
  text: string;
  /** The values outside of the lists. */
  value: Value;
  elements: Element[];
  byId: Map<string, Element>;
  byList: Record<List, Element[]>;
  /** The first element of each name in a list. */
  byName: Record<List, Map<string, Element>>;
  /** By sensor: the number of earlier sensors on the same thing. */
  before: Map<Element, number>;
};

const WALL_THICKNESS_M = 0.1;

/** Largest distance of a door from its wall's middle line. */
export const IN_WALL_M = 0.01;

export function readHome(text: string): Home | Fault {
  const root = tree(text);
  if (isFault(root)) return root;
  if (root.type !== 'object') return { what: 'the file must contain a JSON object', offset: root.offset };
  const value: Value = {};
  const elements: Element[] = [];
  for (const property of root.children ?? []) {
    const [key, node] = property.children ?? [];
    if (key === undefined || node === undefined) continue;
    const list = LISTS.find((list) => list === key.value);
    if (list === undefined) value[key.value] = getNodeValue(node);
    else elements.push(...(node.type === 'array' ? (node.children ?? []) : []).map((child, index) => element(list, index, child)));
  }
  // Of two lists with one name, only the last counts.
  const byId = new Map(elements.map((element) => [element.id, element]));
  const byList = Object.fromEntries(LISTS.map((list) => [list, [...byId.values()].filter((element) => element.list === list)])) as Home['byList'];
  const byName = Object.fromEntries(LISTS.map((list) => [list, new Map(byList[list].toReversed().map((element) => [element.name, element]))])) as Home['byName'];
  const home: Home = { text, value, elements: LISTS.flatMap((list) => byList[list]), byId, byList, byName, before: new Map() };
  const counts = new Map<Element, number>();
  for (const sensor of byList.sensors) {
    const bearer = bearerOf(home, sensor);
    if (bearer === null || atOf(sensor)) continue;
    home.before.set(sensor, counts.get(bearer) ?? 0);
    counts.set(bearer, (counts.get(bearer) ?? 0) + 1);
  }
  return home;
}

export function isHome(read: Home | Fault): read is Home {
  return 'elements' in read;
}

function element(list: List, index: number, node: Node): Element {
  const value: Value = node.type === 'object' ? { ...getNodeValue(node) } : {};
  const name = typeof value.name === 'string' ? value.name : '';
  return { id: `${list}/${index}`, list, index, name, value, offset: node.offset, length: node.length };
}

export function of(home: Home, list: List): Element[] {
  return home.byList[list];
}

/** The title of an element in a list. */
export function titleOf(element: Element): string {
  if (element.name !== '') return element.name;
  return `${NOUNS[element.list].one} ${element.index + 1}`;
}

/** `wall`, `piece of furniture`, `motion sensor`. */
export function nounOf(element: Element): string {
  const kind = element.list === 'sensors' && typeof element.value.kind === 'string' ? `${spoken(element.value.kind.slice(0, 40))} ` : '';
  return kind + NOUNS[element.list].one;
}

export function number(value: unknown): number | null {
  return typeof value === 'number' && Math.abs(value) <= 1e6 ? value : null;
}

export function point(value: unknown): At | null {
  if (!Array.isArray(value) || value.length !== 2) return null;
  const [x, y] = value.map(number);
  return x == null || y == null ? null : [x, y];
}

export function points(value: unknown): At[] | null {
  if (!Array.isArray(value) || value.length < 3) return null;
  const read = value.map(point);
  return read.every((at) => at !== null) ? (read as At[]) : null;
}

export type Wall = { element: Element; from: At; to: At; thickness_m: number };

/** Walls and doors, which have two ends. */
export function spanOf(element: Element): { from: At; to: At } | null {
  const [from, to] = [point(element.value.from), point(element.value.to)];
  return from && to ? { from, to } : null;
}

export function wallsOf(home: Home): Wall[] {
  return of(home, 'walls').flatMap((element) => {
    const span = spanOf(element);
    return span ? [{ element, ...span, thickness_m: number(element.value.thickness_m) ?? WALL_THICKNESS_M }] : [];
  });
}

/** The position of an element: of places, wall sensors and rectangles. */
export function atOf(element: Element): At | null {
  return point(element.value.at);
}

/** The key of the corners of an element that has corners. */
export function cornersKey(element: Element): 'outline' | 'area' | null {
  if (points(element.value.outline)) return 'outline';
  return points(element.value.area) ? 'area' : null;
}

/** The outline of an element on the floor. */
export function formOf(element: Element): At[] | null {
  const { value } = element;
  const span = spanOf(element);
  if (element.list === 'walls' || element.list === 'doors') {
    return span && thick(span.from, span.to, number(value.thickness_m) ?? WALL_THICKNESS_M);
  }
  const key = cornersKey(element);
  if (key !== null) return points(value[key]);
  const [at, size] = [point(value.at), point(value.size_m)];
  return element.list === 'furniture' && at && size ? turnedBox(at, size, number(value.turn_deg) ?? 0) : null;
}

/** The place of an element's sign and name: a sensor on something is at the place of that. */
export function spotOf(home: Home, element: Element): At | null {
  const at = atOf(element);
  if (at) return at;
  const form = formOf(element);
  if (form) return middle(form);
  if (element.list !== 'sensors') return null;
  const bearer = bearerOf(home, element);
  const on = bearer && formOf(bearer);
  if (!on) return null;
  const [x, y] = middle(on);
  // Several on one thing are next to each other.
  return [x + (home.before.get(element) ?? 0) * 0.2, y];
}

/** The bearer of a sensor, or its room. */
export function bearerOf(home: Home, sensor: Element): Element | null {
  const { on, room } = sensor.value;
  const named = (name: unknown, lists: List[]) =>
    typeof name === 'string' ? (lists.map((list) => home.byName[list].get(name)).find((found) => found !== undefined) ?? null) : null;
  return named(on, ['furniture', 'doors']) ?? named(on, ['rooms']) ?? named(room, ['rooms']);
}

/** The lower left and the upper right corner of all outlines. */
export function boundsOf(home: Home): [At, At] {
  const corners = home.elements.flatMap((element) => formOf(element) ?? (atOf(element) ? [atOf(element)!] : []));
  // An empty home has room for a flat.
  if (corners.length === 0) return [[0, 0], [10, 7]];
  const [xs, ys] = [corners.map(([x]) => x), corners.map(([, y]) => y)];
  const least = (all: number[]) => all.reduce((a, b) => Math.min(a, b));
  const most = (all: number[]) => all.reduce((a, b) => Math.max(a, b));
  return [[least(xs), least(ys)], [most(xs), most(ys)]];
}
