import { expect, test } from 'vitest';
import { type Change, apply } from '../../json';
import type { At } from '../../plan/geometry';
import { FLAT } from '../../testing/flat';
import { type Home, isHome, readHome } from './model';
import { handlesOf, move, moveWalls, pull, rename, turnBy } from './move';
import { mount, spanAt, targetsOf } from './snap';

const FREE = { snapping: null, alone: false };
const SNAP = { snapping: { tolerance_m: 0.12, grid_m: 0.05 }, alone: false };

function home(text = FLAT): Home {
  const read = readHome(text);
  if (!isHome(read)) throw new Error(read.what);
  return read;
}

const flat = home();
const el = (id: string, of = flat) => of.byId.get(id)!;

/** The home after the changes. */
function after(changes: Change[], text = FLAT) {
  return JSON.parse(apply(text, changes));
}

test('a wall takes along the walls that meet it, its doors, the corners of rooms and the sensors on it', () => {
  const { changes } = move(flat, [el('walls/4')], [0.5, 0], FREE);
  const moved = after(changes);
  expect(moved.walls[4]).toEqual({ from: [4.5, 0], to: [4.5, 3] });
  expect(moved.doors[0]).toMatchObject({ from: [4.5, 1], to: [4.5, 1.9] });
  expect(moved.rooms[0].outline).toEqual([[0, 0], [4.5, 0], [4.5, 3], [0, 3]]);
  expect(moved.rooms[1].outline).toEqual([[4.5, 0], [6, 0], [6, 3], [4.5, 3]]);
  // The outer walls are met in their middles, and stay.
  expect(moved.walls.slice(0, 4)).toEqual(JSON.parse(FLAT).walls.slice(0, 4));
});

test('an outer wall stretches those that end on it', () => {
  const moved = after(move(flat, [el('walls/2')], [0, 1], FREE).changes);
  expect(moved.walls[1].to).toEqual([6, 4]);
  expect(moved.walls[3].from).toEqual([0, 4]);
  expect(moved.walls[4].to).toEqual([4, 4]);
  expect(moved.doors[0]).toMatchObject({ from: [4, 1], to: [4, 1.9] });
  expect(moved.rooms[0].outline[2]).toEqual([4, 4]);
  const west = after(move(flat, [el('walls/3')], [-1, 0], FREE).changes);
  expect(west.sensors[0].at).toEqual([-0.88, 1.5]);
  expect(west.doors[1]).toMatchObject({ from: [1, 0], to: [1.9, 0] });
});

test('alone a wall leaves all behind', () => {
  const { changes } = move(flat, [el('walls/4')], [0.5, 0], { ...FREE, alone: true });
  expect(changes.every(({ path }) => path[0] === 'walls' && path[1] === 4)).toBe(true);
});

test('the end of a wall is pulled, and what meets it there comes along', () => {
  const { changes } = pull(flat, el('walls/0'), 'to', [7, 0], SNAP);
  const moved = after(changes);
  expect(moved.walls[0].to).toEqual([7, 0]);
  expect(moved.walls[1].from).toEqual([7, 0]);
  expect(moved.rooms[1].outline[1]).toEqual([7, 0]);
  expect(moved.doors[1]).toMatchObject({ from: [1, 0], to: [1.9, 0] });
  const pulled = after(moveWalls(flat, new Map([['walls/0', { from: [-1, 0], to: [6, 0] }]]), false));
  expect(pulled.doors[1]).toMatchObject({ from: [1, 0], to: [1.9, 0] });
});

test('a door goes along its wall, not off it, and onto another', () => {
  const slid = after(move(flat, [el('doors/0')], [0.1, 1.6], SNAP).changes).doors[0];
  expect(slid).toMatchObject({ from: [4, 2.1], to: [4, 3] });
  const other = after(move(flat, [el('doors/0')], [2, 0], SNAP).changes).doors[0];
  expect(other.from[0]).toBe(6);
  expect(Math.abs(other.to[1] - other.from[1])).toBeCloseTo(0.9);
  const turned = after(move(flat, [el('doors/1')], [1.5, 3], SNAP).changes).doors[1];
  expect([turned.from[1], turned.to[1]]).toEqual([3, 3]);
  expect(turned.to[0]).toBeGreaterThan(turned.from[0]);
});

test('a sensor keeps to walls and looks into the room from each of them', () => {
  const along = after(move(flat, [el('sensors/0')], [0.07, 0.6], SNAP).changes).sensors[0];
  expect(along).toMatchObject({ at: [0.12, 2.1], facing_deg: 0 });
  const south = after(move(flat, [el('sensors/0')], [2.4, -1.4], SNAP).changes).sensors[0];
  expect(south).toMatchObject({ at: [2.5, 0.12], facing_deg: 90 });
  const bath = after(move(flat, [el('sensors/0')], [5.7, 0.5], SNAP).changes).sensors[0];
  expect(bath).toMatchObject({ at: [5.88, 2], facing_deg: 180 });
  const free = after(move(flat, [el('sensors/0')], [2, 0.3], FREE).changes).sensors[0];
  expect(free).toMatchObject({ at: [2.12, 1.8], facing_deg: 0 });
});

test('from outside a sensor comes to the side of the wall where a room is', () => {
  expect(mount([2, 3.1], targetsOf(flat, new Set()), 0.05)).toMatchObject({ at: [2, 2.88] });
  expect(mount([2, 1.5], targetsOf(flat, new Set()), 0.05)).toBeNull();
});

test('furniture comes to rest against walls, and on the grid where there is none', () => {
  const bed = after(move(flat, [el('furniture/0')], [0.07, 0.43], SNAP).changes).furniture[0];
  expect(bed.at).toEqual([1.1, 2.45]);
  const stove = after(move(flat, [el('furniture/1')], [-0.53, 0.88], SNAP).changes).furniture[1];
  expect(stove.at).toEqual([2.45, 1.3]);
  expect(after(move(flat, [el('furniture/1')], [-0.123, 0.2345], FREE).changes).furniture[1].at).toEqual([2.877, 0.635]);
});

test('several things are moved together, each once', () => {
  const moved = after(move(flat, flat.elements, [1, 2], FREE).changes);
  expect(moved.rooms[0].outline[0]).toEqual([1, 2]);
  expect(moved.walls[4]).toEqual({ from: [5, 2], to: [5, 5] });
  expect(moved.doors[0]).toMatchObject({ from: [5, 3], to: [5, 3.9] });
  expect(moved.sensors[0].at).toEqual([1.12, 3.5]);
});

test('things are turned about themselves', () => {
  expect(turnBy(el('sensors/0'), -15)[0]).toMatchObject({ path: ['sensors', 0, 'facing_deg'], value: 345 });
  expect(turnBy(el('furniture/0'), 90)[0]!.value).toBe(90);
  const area = after(turnBy(el('sensors/4'), 90)).sensors[4].area as At[];
  expect(area).toEqual([[5.5, 0.5], [5.5, 1.5], [4.5, 1.5], [4.5, 0.5]]);
  expect(turnBy(el('sensors/1'), 90)).toEqual([]);
});

test('handles aim, turn and size', () => {
  expect(handlesOf(el('sensors/0'), 1).map(({ key, at }) => [key, at])).toEqual([['aim', [1.12, 1.5]]]);
  expect(after(pull(flat, el('sensors/0'), 'aim', [2.12, 3.5], SNAP).changes).sensors[0].facing_deg).toBe(45);
  expect(after(pull(flat, el('furniture/0'), 'turn', [0, 2], SNAP).changes).furniture[0].turn_deg).toBe(90);
  const sized = after(pull(flat, el('furniture/0'), 'size/2', [3, 3.45], FREE).changes).furniture[0];
  expect(sized).toMatchObject({ size_m: [3, 1.9], at: [1.5, 2.5] });
  const least = after(pull(flat, el('furniture/0'), 'size/2', [-9, -9], FREE).changes).furniture[0];
  expect(least.size_m).toEqual([0.05, 0.05]);
  expect(after(pull(flat, el('rooms/0'), 'outline/2', [4.5, 2.5], FREE).changes).rooms[0].outline[2]).toEqual([4.5, 2.5]);
  expect(after(pull(flat, el('doors/0'), 'to', [3, 2.33], SNAP).changes).doors[0].to).toEqual([4, 2.35]);
});

test('a turned piece is sized along its own sides', () => {
  const text = apply(FLAT, turnBy(el('furniture/0'), 90));
  const turned = home(text);
  const [, , corner] = handlesOf(el('furniture/0', turned), 1);
  const sized = after(pull(turned, el('furniture/0', turned), 'size/2', [corner!.at[0], corner!.at[1] + 1], FREE).changes, text).furniture[0];
  expect(sized.size_m).toEqual([3, 0.9]);
});

test('another name is also where sensors name what they hang on, and nowhere else', () => {
  const bed = after(rename(flat, el('furniture/0'), 'daybed'));
  expect([bed.furniture[0].name, bed.sensors[1].on]).toEqual(['daybed', 'daybed']);
  const room = after(rename(flat, el('rooms/0'), 'parlour'));
  expect(room.sensors[3].room).toBe('parlour');
  expect(room.sensors[0].name).toBe('room motion');
  expect(after(rename(flat, el('doors/0'), 'd')).sensors[2].on).toBe('d');
});

test('a door is as wide as its wall at most', () => {
  const walls = targetsOf(home('{"walls": [{"from": [0, 0], "to": [0.5, 0]}]}'), new Set()).walls;
  expect(spanAt([9, 9], walls, 0.9, 0.05)).toEqual({ from: [0, 0], to: [0.5, 0] });
  expect(spanAt([0, 0], [], 0.9, 0.05)).toBeNull();
});
