import { beforeEach, expect, test } from 'vitest';
import { Refused, lanesPath, storedPath } from '../../server';
import { storedDay, storedRun } from '../../testing/stored';
import { Player } from './player.svelte';

const DAYS = 5;

/** The answers of the server, by path; `held` ones wait until they are released, and `broken` ones fail. */
let held: Map<string, () => void>;
let holds: Set<string>;
let broken: Set<string>;
let player: Player;

async function answer<T>(path: string, value: unknown): Promise<T> {
  if (holds.has(path)) await new Promise<void>((go) => held.set(path, go));
  if (broken.has(path)) throw new Refused(500, `${path} is broken.`);
  return value as T;
}

const nameOf = (path: string) => path.split('/')[3]!;

const server = {
  json: <T>(path: string) => answer<T>(path, storedRun(nameOf(path), DAYS)),
  packed: <T>(path: string) => answer<T>(path, storedDay(storedRun(nameOf(path), DAYS), Number(path.split('/').at(-1)))),
};

const settle = () => new Promise((done) => setTimeout(done));

async function letGo(path: string): Promise<void> {
  holds.delete(path);
  held.get(path)!();
  await settle();
}

beforeEach(async () => {
  [held, holds, broken] = [new Map(), new Set(), new Set()];
  player = new Player(server);
  await player.open('a');
  await settle();
});

test('a day of a very large truth comes in pieces, with how much of it has come, and can be stopped', async () => {
  const day = storedDay(storedRun('large', DAYS), 0);
  const shares: (number | null)[] = [];
  let asked = 0;
  const pieces = {
    json: server.json,
    packed: async <T>(path: string) => {
      const from = Number(/\/from\/(\d+)$/.exec(path)?.[1] ?? 0);
      if (!path.includes('/days/0')) return server.packed<T>(path);
      asked += 1;
      const until_us = Math.min(from + 6 * 3600e6, 86_400e6);
      const movements = (all: typeof day.lives[number]['movements']) => all.filter(([begin, end]) => begin < until_us && end > from);
      await settle();
      shares.push(player.share);
      return { ...day, rows: from === 0 ? day.rows : [], lives: day.lives.map((life) => ({ ...life, movements: movements(life.movements) })), until_us } as T;
    },
  };
  player = new Player(pieces);
  await player.open('large');
  for (let turn = 0; turn < 20; turn++) await settle();
  expect(asked).toBe(4);
  expect(shares).toEqual([null, 0.25, 0.5, 0.75]);
  expect(player.share).toBeNull();
  expect(player.first!.at(0)!.view.lives.map(({ movements }) => movements)).toEqual(day.lives.map(({ movements }) => movements));

  [asked, player] = [0, new Player(pieces)];
  await player.open('large');
  while (player.share === null) await settle();
  player.stop();
  for (let turn = 0; turn < 20; turn++) await settle();
  expect(asked).toBeLessThan(4);
  expect(player.first!.at(0)).not.toBeNull();
});

test('who goes back to the run that is shown does not get another one that comes late', async () => {
  holds.add(storedPath('b'));
  void player.open('b');
  await settle();
  expect(player.opening).toBe('b');
  await player.open('a');
  expect(player.opening).toBeNull();
  await letGo(storedPath('b'));
  expect([player.first!.view.name, player.opening, player.problem]).toEqual(['a', null, '']);
});

test('a second run that is not wanted any more is not being opened', async () => {
  holds.add(storedPath('b'));
  void player.beside('b');
  await settle();
  expect(player.opening).toBe('b');
  await player.beside(null);
  expect(player.opening).toBeNull();
  await letGo(storedPath('b'));
  expect([player.second, player.opening]).toEqual([null, null]);
});

test('of many days the counts of both runs are fetched, once; if one’s do not come it is said', async () => {
  const asked: string[] = [];
  const counting = {
    json: server.json,
    packed: async <T>(path: string) => {
      if (!path.endsWith('/lanes')) return server.packed<T>(path);
      asked.push(path);
      return answer<T>(path, { bucket_us: 3600e6, counts: [] });
    },
  };
  player = new Player(counting);
  await player.open('a');
  await player.look([0, 1, 2, 3, 4]);
  broken.add(lanesPath('b'));
  await player.beside('b');
  await player.look([0, 1, 2, 3, 4]);
  expect(player.problem).toBe(`${lanesPath('b')} is broken.`);
  broken.clear();
  await player.look([0, 1, 2, 3, 4]);
  expect(asked).toEqual([lanesPath('a'), lanesPath('b'), lanesPath('b')]);
  expect([player.first!.lanes, player.second!.lanes].map((lanes) => lanes?.bucket_us)).toEqual([3600e6, 3600e6]);
});

test('a day of a run that is not shown any more may fail', async () => {
  const path = storedPath('b', 0);
  holds.add(path);
  broken.add(path);
  await player.open('b');
  await player.open('c');
  await settle();
  player.toggle();
  await letGo(path);
  expect([player.first!.view.name, player.playing, player.problem]).toEqual(['c', true, '']);
});

test('a day that is read ahead may fail, and is asked for again on its day', async () => {
  broken.add(storedPath('b', 2));
  await player.open('b');
  player.toggle();
  await settle();
  expect([player.playing, player.problem]).toEqual([true, '']);
  expect([0, 1, 2].map((day) => player.first!.has(day))).toEqual([true, true, false]);
  player.turn(1);
  await settle();
  expect([player.playing, player.problem]).toEqual([true, '']);
  expect(player.first!.has(3), 'the days after it come all the same').toBe(true);
  player.turn(1);
  await settle();
  expect([player.playing, player.problem]).toEqual([false, `${storedPath('b', 2)} is broken.`]);
  broken.clear();
  player.go(player.ticker!.now_us);
  await settle();
  expect(player.first!.has(2)).toBe(true);
});

test('a run opens at a moment of its clock; one that it has not leaves it where it is', async () => {
  await player.open('b', '2009-03-04T07:30:00');
  const at = (2 * 24 + 7.5) * 3_600_000_000;
  expect(player.ticker!.now_us).toBe(at);
  await player.open('b', '2012-01-01T00:00:00');
  expect(player.ticker!.now_us).toBe(at);
  await player.open('b', '2009-03-02T06:00:00');
  expect(player.ticker!.now_us).toBe(6 * 3_600_000_000);
});
