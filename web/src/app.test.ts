import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import App from './App.svelte';
import { WRONG_TOKEN, type Wire } from './socket';
import { fakeWire, write } from './testing/page';

let app: Record<string, unknown>;
let wires: Wire[];
let sent: string[];

function open(hash: string, withWire: boolean): void {
  [wires, sent] = [[], []];
  window.location.hash = hash;
  const fake = () => {
    const wire: Wire = fakeWire((text) => sent.push(text));
    wires.push(wire);
    return wire;
  };
  app = mount(App, { target: document.body, props: withWire ? { fake } : {} });
  flushSync();
}

// Views that ask a server find none here.
beforeEach(() => void vi.stubGlobal('fetch', () => Promise.reject(new TypeError('no server'))));

afterEach(async () => {
  await unmount(app);
  vi.unstubAllGlobals();
  window.sessionStorage.clear();
});

const form = () => document.querySelector('form');

test('without a token it is asked for, and what is none is not sent', () => {
  open('#/live', false);
  expect(document.querySelector('nav')).toBeNull();
  form()!.dispatchEvent(new Event('submit', { bubbles: true, cancelable: true }));
  flushSync();
  expect(document.querySelector('[role="alert"]')!.textContent).toContain('not an access token');
});

test('the server does not know the token: it is asked for again, and why is said', () => {
  open('#/live', true);
  wires[0]!.onopen!();
  flushSync();
  expect(document.querySelector('nav')).not.toBeNull();
  wires[0]!.onclose!({ code: WRONG_TOKEN });
  flushSync();
  expect(document.querySelector('nav')).toBeNull();
  expect(document.querySelector('[role="alert"]')!.textContent).toContain('does not accept this token');
  expect(window.sessionStorage.getItem('homebody-token')).toBeNull();
});

test('what was asked with the token before, and is refused late, does not send the next away', async () => {
  let refuse: (() => void)[] = [];
  vi.stubGlobal('fetch', () => new Promise((answer) => refuse.push(() => answer(new Response('', { status: 401 })))));
  open('#/log', true);
  const late = refuse;
  expect(late.length).toBeGreaterThan(0);
  wires[0]!.onclose!({ code: WRONG_TOKEN });
  flushSync();
  refuse = [];
  const field = document.querySelector<HTMLInputElement>('#token')!;
  write(field, 'ab'.repeat(16));
  form()!.dispatchEvent(new Event('submit', { bubbles: true, cancelable: true }));
  flushSync();
  wires[1]!.onopen!();
  for (const one of late) one();
  await new Promise((done) => setTimeout(done, 20));
  flushSync();
  expect(document.querySelector('.status')!.textContent).toContain('connected');
  expect(window.sessionStorage.getItem('homebody-token')).toBe('ab'.repeat(16));
});

test('a lost connection is seen, and so is that it is back', () => {
  open('#/live', true);
  wires[0]!.onopen!();
  wires[0]!.onclose!({ code: 1006 });
  flushSync();
  expect(document.querySelector('.status')!.textContent).toContain('connection lost, reconnecting');
  [...document.querySelectorAll('button')].find((button) => button.textContent === 'Try now')!.click();
  wires[1]!.onopen!();
  flushSync();
  expect(document.querySelector('.status')!.textContent).toContain('connected');
  expect(sent).toEqual(['{"say":"hello","token":"fake-token"}', '{"say":"hello","token":"fake-token"}']);
});

test('the address says which view is seen, and the line stays open', () => {
  open('#/log', true);
  expect(document.querySelector('[aria-current="page"]')!.textContent).toBe('Log');
  expect(document.body.textContent).toContain('First rows');
  window.location.hash = '#/life';
  window.dispatchEvent(new Event('hashchange'));
  flushSync();
  expect(document.querySelector('[aria-current="page"]')!.textContent).toBe('Life');
  expect(wires).toHaveLength(1);
});
