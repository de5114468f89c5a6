import { expect, test } from 'vitest';
import { madeUpHome } from '../testing/home';
import { type At, box, facing, inside, openDoors, openLeaf, within } from './geometry';
import { litRooms, sides } from './moving';

const L: At[] = [[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]];

test('an outline with a corner turned in', () => {
  expect(inside(L, [0.5, 2.5])).toBe(true);
  expect(inside(L, [3, 0.5])).toBe(true);
  expect(inside(L, [3, 2])).toBe(false);
  expect(box(L)).toEqual([0, 0, 4, 3]);
});

test('a leaf opens a quarter turn against the clock about its first jamb', () => {
  const [x, y] = openLeaf([2, 1], [3, 1]);
  expect([x, y]).toEqual([2, 2]);
});

test('a sensor faces where its file says, and east where that says nothing', () => {
  expect([90, 225, null].map((facing_deg) => facing({ facing_deg }))).toEqual([Math.PI / 2, 1.25 * Math.PI, 0]);
});

test('doors stand as the frame says; one that nobody can use, as the home says', () => {
  const home = madeUpHome();
  expect(openDoors(home, [6])).toEqual([false, false, false, false, false, false, true]);
  home.things = [];
  expect(openDoors(home, [])).toEqual(home.doors.map((door) => door.open));
});

test('a door leads out of the home inwards', () => {
  const home = madeUpHome();
  const front = home.doors.findIndex((door) => door.outside);
  const { from, to } = home.doors[front]!;
  const leaf = openLeaf(from, to);
  const tip: At = sides(home)[front] === 1 ? leaf : [2 * from[0] - leaf[0], 2 * from[1] - leaf[1]];
  expect(tip[0]).toBeLessThan(from[0]);
});

test('what can be reached, the nearest first', () => {
  const home = madeUpHome();
  home.things = [
    { name: 'far', kind: 'lamp', at: [1, 2], verbs: ['Open', 'Close'] },
    { name: 'near', kind: 'furniture', at: [3.9, 2], verbs: ['Open', 'Close'] },
    { name: 'nearest', kind: 'door', at: [5, 2.4], verbs: ['Open', 'Close'] },
    { name: 'beyond the wall', kind: 'furniture', at: [5.8, 2], verbs: ['Open', 'Close'] },
  ];
  expect(within(home, [5, 2], 1.2)).toEqual([2, 1]);
  expect(within(home, [5, 2], 0.3)).toEqual([]);
});

test('a lamp lights the room of its name, and a stove lights none', () => {
  const home = madeUpHome();
  const lamp = home.things.findIndex(({ kind, name }) => kind === 'lamp' && name === 'study');
  const stove = home.things.findIndex(({ name }) => name === 'cooker');
  expect(litRooms(home, [lamp, stove])).toEqual([home.rooms.findIndex(({ name }) => name === 'study')]);
});
