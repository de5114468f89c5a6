import { beforeEach, expect, test } from 'vitest';
import { Refused, Server, keepToken, runPath, takeToken, tokenIn } from './server';

const HEX = 'deadbeef'.repeat(8);

let kept: Map<string, string>;
let replaced: unknown[];

const keeper = () => ({
  getItem: (name: string) => kept.get(name) ?? null,
  setItem: (name: string, value: string) => void kept.set(name, value),
  removeItem: (name: string) => void kept.delete(name),
});

const history = { replaceState: (...all: unknown[]) => void replaced.push(all[2]) };

beforeEach(() => {
  kept = new Map();
  replaced = [];
});

test('the token is taken from the address, kept, and gone from the address bar', () => {
  expect(takeToken({ hash: `#token=${HEX}` }, history, keeper)).toBe(HEX);
  expect(replaced).toEqual(['#/live']);
  expect(takeToken({ hash: '#/plan' }, history, keeper)).toBe(HEX);
  expect(replaced).toHaveLength(1);
});

test('a fragment that is no token is taken for none, and does not stay either', () => {
  expect(takeToken({ hash: '#token=<script>' }, history, keeper)).toBeNull();
  expect([replaced, kept.size]).toEqual([['#/live'], 0]);
});

test('a browser that keeps nothing is no error', () => {
  const forbids = () => {
    throw new Error('forbidden');
  };
  expect(takeToken({ hash: `#token=${HEX}` }, history, forbids)).toBe(HEX);
  expect(takeToken({ hash: '' }, history, forbids)).toBeNull();
  keepToken(forbids, HEX);
});

test('a token may be pasted by itself or in its address', () => {
  expect(tokenIn(` ${HEX}\n`)).toBe(HEX);
  expect(tokenIn(`http://127.0.0.1:8642/#token=${HEX}`)).toBe(HEX);
  for (const text of ['', 'short', 'two words here', 'http://127.0.0.1:8642/']) expect(tokenIn(text)).toBeNull();
});

test('every question carries the token', async () => {
  const asked: [string, RequestInit][] = [];
  const server = new Server(HEX, () => {}, async (path, init) => {
    asked.push([path, init]);
    return new Response('{"a":1}');
  });
  expect(await server.json('/api/x')).toEqual({ a: 1 });
  await server.post('/api/y', { b: 2 });
  expect(asked.map(([path, init]) => [path, init.method, init.body])).toEqual([['/api/x', 'GET', undefined], ['/api/y', 'POST', '{"b":2}']]);
  for (const [, init] of asked) expect((init.headers as Record<string, string>)['x-homebody-token']).toBe(HEX);
});

test('a wrong token is told to who can ask for another', async () => {
  let told = 0;
  const server = new Server(HEX, () => (told += 1), async () => new Response('', { status: 401 }));
  await expect(server.json('/api/x')).rejects.toThrow(Refused);
  expect(told).toBe(1);
});

test('what the server says went wrong is what is shown', async () => {
  const answers = async (text: string, status: number) => new Server(HEX, () => {}, async () => new Response(text, { status })).json('/api/x');
  await expect(answers('the run is still being lived', 409)).rejects.toThrow('the run is still being lived');
  await expect(answers('', 500)).rejects.toThrow('500');
  const cut = new Server(HEX, () => {}, () => Promise.reject(new TypeError('failed')));
  await expect(cut.json('/api/x')).rejects.toThrow('Cannot reach');
});

test('a refusal has the sentence and the code of its message', async () => {
  const told = { code: 'page::no-run', what: 'There is no run "a".', data: { run: 'a' } };
  const server = new Server(HEX, () => {}, async () => Response.json(told, { status: 404 }));
  const error = await server.json('/api/x').catch((error: unknown) => error);
  expect(error).toMatchObject({ status: 404, message: 'There is no run "a".', code: 'page::no-run' });
});

test('a file has the name that the server gives it', async () => {
  const headers = { 'content-disposition': 'attachment; filename="log.db"' };
  const server = new Server(HEX, () => {}, async () => new Response('x', { headers }));
  expect((await server.file('/api/x', 'otherwise')).name).toBe('log.db');
  const plain = new Server(HEX, () => {}, async () => new Response('x'));
  expect((await plain.file('/api/x', 'otherwise')).name).toBe('otherwise');
});

test('a run whose name is a path leads nowhere else', () => {
  expect(runPath('../a b?', 'log')).toBe('/api/runs/..%2Fa%20b%3F/log');
});
