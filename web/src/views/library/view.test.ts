import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Server } from '../../server';
import { FakeStore } from '../../testing/store';
import { write } from '../../testing/page';
import type { CardView, LibraryView as View, StoredView } from '../../wire';
import { Library } from './library.svelte';
import LibraryView from './Library.svelte';

let app: Record<string, unknown>;
let asked: string[];
let view: View;
/** The reason why nothing is restored. */
let refusal: string | null = null;

let card: CardView;
const CARD: CardView = { home: '{ "rooms": [{ "name": "hall", "outline": [[0, 0], [4, 0], [4, 3]] }] }', residents: ['agnes'], problems: 2, runs: 0, latest: [], goes_on: null };

const stored = (name: string): StoredView => ({ name, scenario: 'flat', start: '2009-03-02 00:00:00', days: 3, has_truth: true, walked_back: null, problem: null, made_ms: null, seed: null, without: [], about: { title: '', note: '' } });

function answers(path: string, init: RequestInit): Response {
  asked.push(`${init.method} ${path}${typeof init.body === 'string' ? ` ${init.body}` : ''}`);
  if (path === '/api/library') return Response.json(view);
  if (path.includes('/runs/')) return Response.json([[0, 1]]);
  if (init.method === 'DELETE') return Response.json({ key: `${path.split('/').at(-1)}~1` });
  if (refusal !== null && path.includes('/put-aside/')) return new Response(refusal, { status: 422 });
  if (path.startsWith('/api/library/logs/') || path.startsWith('/api/homes/')) return Response.json({ name: 'tm 1', remarks: [] });
  if (path.endsWith('/copy')) return new Response('The name flat 2 is already in use here.', { status: 422 });
  if (init.method === 'POST' && path === '/api/library/homes/cottage') return Response.json({ name: 'cottage', remarks: [] });
  return Response.json(init.method === 'GET' ? card : 'flat');
}

async function settled() {
  for (let turn = 0; turn < 10; turn++) await Promise.resolve().then(() => new Promise((done) => setTimeout(done, 0)));
  flushSync();
}

async function open(part: Partial<View> = {}) {
  const home = { name: 'flat', title: 'flat', about: '', changed_ms: 0 };
  view = { folder: '/homes', trouble: null, homes: [home], more: 0, aside: [], templates: [{ name: 'studio', about: 'A room.' }], runs_beside: 0, ...part };
  const server = new Server('token', () => {}, async (path, init) => answers(path, init));
  app = mount(LibraryView, { target: document.body, props: { server } });
  await settled();
}

beforeEach(() => {
  [asked, card] = [[], CARD];
  // Everything is visible.
  vi.stubGlobal('IntersectionObserver', class {
    constructor(private readonly tell: (all: { isIntersecting: boolean }[]) => void) {}
    observe() {
      this.tell([{ isIntersecting: true }]);
    }
    disconnect() {}
  });
  HTMLDialogElement.prototype.showModal = function () {
    this.open = true;
  };
});

afterEach(async () => {
  await unmount(app);
  vi.unstubAllGlobals();
});

const button = (name: string) => [...document.querySelectorAll('button')].find((one) => (one.getAttribute('aria-label') ?? one.textContent!.trim()) === name)!;

test('a home is drawn, with who lives there and what is wrong, and leads to its own address', async () => {
  await open();
  const article = document.querySelector('article')!;
  expect(article.querySelector('polygon.room')).not.toBeNull();
  expect(article.textContent).toContain('agnes');
  expect(article.querySelector('a.wrong')!.textContent).toContain('2 problems');
  expect(article.querySelector('a.open')!.getAttribute('href')).toBe('/homes/flat/#/plan');
});

test('of a run that is being lived no length is told', async () => {
  card = { ...CARD, runs: 2, latest: ['flat-2', 'flat-1'].map(stored), goes_on: 'flat-2' };
  await open();
  expect([...document.querySelectorAll('article li .quiet')].map((one) => one.textContent)).toEqual(['running', '3 days']);
});

test('a home with runs leads to Care, and so does each run', async () => {
  card = { ...CARD, runs: 1, latest: [stored('flat-1')] };
  await open();
  expect([...document.querySelectorAll('article a')].filter((link) => link.textContent!.startsWith('Care')).map((link) => link.getAttribute('href'))).toEqual(['/homes/flat/#/care', '/homes/flat/#/care/flat-1']);
});

test('of twins it is said which was lived without what', async () => {
  card = { ...CARD, runs: 2, latest: [{ ...stored('flat-2'), without: ['cognitive_decline'] }, stored('flat-1')] };
  await open();
  expect([...document.querySelectorAll('article li .quiet')].map((one) => one.textContent)).toEqual(['3 days, without cognitive decline', '3 days']);
});

test('a home that is deleted leaves its place, from which it is put back', async () => {
  const homes = ['attic', 'flat', 'hut'].map((name) => ({ name, title: name, about: '', changed_ms: 0 }));
  await open({ homes, aside: [{ key: 'old~1', name: 'old' }] });
  const places = () => [...document.querySelector('.cards')!.children].map((one) => one.getAttribute('aria-label'));
  Object.defineProperty(HTMLElement.prototype, 'offsetHeight', { configurable: true, get: () => 321 });
  for (const name of ['flat', 'attic']) {
    view = { ...view, homes: view.homes.filter((home) => home.name !== name) };
    button(`Delete ${name}`).click();
    await settled();
  }
  delete (HTMLElement.prototype as { offsetHeight?: number }).offsetHeight;
  expect(places()).toEqual(['attic, deleted', 'flat, deleted', 'hut']);
  const [first, second] = [...document.querySelectorAll<HTMLElement>('.gone')];
  expect([first!.style.minHeight, first!.contains(document.activeElement)]).toEqual(['321px', true]);
  expect(document.querySelector('.note')!.textContent!.trim()).toBe('');
  // Shows the reason.
  refusal = 'The name flat is already in use here.';
  second!.querySelector('button')!.click();
  await settled();
  expect(second!.querySelector('[role="alert"]')!.textContent).toBe(refusal);
  refusal = null;
  view = { ...view, homes: homes.slice(1) };
  second!.querySelector('button')!.click();
  await settled();
  expect(asked).toContain('POST /api/library/put-aside/flat~1 {}');
  expect(places()).toEqual(['attic, deleted', 'flat', 'hut']);
  button('Dismiss').click();
  flushSync();
  expect(places()).toEqual(['flat', 'hut']);
  button('Restore').click();
  await settled();
  expect(asked).toContain('POST /api/library/put-aside/old~1 {}');
  expect(document.querySelector('.note')!.textContent).toContain('Restored old');
});

test('homes that are deleted one after the other or at once keep their places, also beside one that is renamed or dismissed', async () => {
  const home = (name: string) => ({ name, title: name, about: '', changed_ms: 0 });
  const homes = [...'abcdef'].map(home);
  await open({ homes });
  const library = new Library(new Server('token', () => {}, async (path, init) => answers(path, init)));
  await library.load();
  const places = () => library.entries.map(({ home, deleted }) => (deleted ? `no ${home.name}` : home.name));
  const remove = (name: string) => {
    view = { ...view, homes: view.homes.filter((home) => home.name !== name) };
    return library.remove(home(name), 100);
  };
  await remove('b');
  await remove('c');
  expect(places()).toEqual(['a', 'no b', 'no c', 'd', 'e', 'f']);
  view = { ...view, homes: view.homes.map((one) => (one.name === 'd' ? home('z') : one)) };
  expect(await library.call('d', 'z', 'name')).toBeNull();
  expect(places()).toEqual(['a', 'no b', 'no c', 'z', 'e', 'f']);
  await Promise.all(['e', 'z'].map(remove));
  expect(places()).toEqual(['a', 'no b', 'no c', 'no z', 'no e', 'f']);
  library.forget('c~1');
  expect(places()).toEqual(['a', 'no b', 'no z', 'no e', 'f']);
  view = { ...view, homes: [home('a'), home('z'), home('f')] };
  expect(await library.putBack({ key: 'z~1', name: 'z' })).toBe(true);
  expect(places()).toEqual(['a', 'no b', 'z', 'no e', 'f']);
});

test('a copy has a name that is free, and why there is none is said in its dialog', async () => {
  await open();
  button('Duplicate flat').click();
  flushSync();
  const dialog = document.querySelector<HTMLDialogElement>('dialog[open]')!;
  expect(dialog.querySelector('input')!.value).toBe('flat 2');
  dialog.querySelector('form')!.dispatchEvent(new Event('submit', { bubbles: true, cancelable: true }));
  await settled();
  expect(asked).toContain('POST /api/library/homes/flat/copy {"name":"flat 2"}');
  expect(dialog.querySelector('[role="alert"]')!.textContent).toContain('The name flat 2 is already in use');
  expect(dialog.open).toBe(true);
});

test('a home is begun empty with a picture under its plan; of a file that is no picture none is made', async () => {
  const store = new FakeStore();
  vi.stubGlobal('indexedDB', store);
  vi.stubGlobal('Image', class { src = ''; decode = () => Promise.resolve(); });
  await open();
  const library = new Library(new Server('token', () => {}, async (path, init) => answers(path, init)));
  const begun = (type: string) => library.make('cottage', { kind: 'image', file: new File(['a picture'], 'cottage.png', { type }) });
  expect(await begun('text/plain')).toBe('This file is not a PNG, JPEG or SVG image.');
  expect([asked.filter((one) => one.startsWith('POST')), store.kept.size]).toEqual([[], 0]);
  expect(await begun('image/png')).toEqual({ name: 'cottage', remarks: [] });
  expect(asked).toContain('POST /api/library/homes/cottage {"from":"empty"}');
  expect(store.kept.get('cottage')).toMatchObject({ name: 'cottage.png', at: [5, 3.5], width_m: 7 });
  // A home with a picture that the browser cannot store is made all the same, and says so.
  store.isFull = true;
  expect(await begun('image/png')).toMatchObject({ remarks: [expect.stringContaining('cannot store the image')] });
});

test('a folder that cannot be written says so, and offers nothing that would fail', async () => {
  await open({ trouble: 'Cannot write to this folder: read-only.', runs_beside: 3, more: 7 });
  expect(document.querySelector('.trouble')!.textContent).toContain('read-only');
  for (const name of ['New home', 'Rename flat', 'Duplicate flat', 'Delete flat']) expect(button(name).disabled).toBe(true);
  expect(document.body.textContent).toContain('3 runs in the folder');
  expect(document.body.textContent).toContain('7 more homes are in the folder');
});

test('the log that a home was made from is walked through it by one button', async () => {
  await open();
  const went = vi.spyOn(window.location, 'assign').mockImplementation(() => {});
  button('New home').click();
  flushSync();
  document.querySelector<HTMLInputElement>('input[value="log"]')!.click();
  flushSync();
  const input = document.querySelector<HTMLInputElement>('input[type="file"]')!;
  const file = new File(['2009-10-16 M001 ON'], 'tm 1.csv');
  Object.defineProperty(input, 'files', { value: [file], writable: true });
  input.dispatchEvent(new Event('change', { bubbles: true }));
  document.querySelector('dialog form')!.dispatchEvent(new SubmitEvent('submit', { bubbles: true, cancelable: true }));
  await settled();
  expect(asked).toContain('POST /api/library/logs/tm%201/tm%201.csv');
  // The page asks about the log before it leaves the home.
  expect(went).not.toHaveBeenCalled();
  button('Open the log in this home').click();
  await settled();
  expect(asked.at(-1)).toBe('POST /api/homes/tm%201/walk/tm%201.csv');
  expect(went.mock.calls).toEqual([['/homes/tm%201/#/playback']]);
  // After closing the dialog, the page stays here.
  button('Open the log in this home').click();
  document.querySelector<HTMLDialogElement>('dialog[open]')!.open = false;
  await settled();
  expect([asked.filter((one) => one.includes('/walk/')).length, went.mock.calls.length]).toEqual([2, 1]);
});

test('of a home in which nothing is drawn it is not said that something is wrong', async () => {
  card = { ...CARD, home: '{ "name": "home", "rooms": [] }' };
  await open();
  expect(document.querySelector('article')!.textContent).toContain('Draw the plan');
  expect(document.querySelector('article .wrong')).toBeNull();
});

test('why a name cannot be had goes once another is typed', async () => {
  await open();
  button('Duplicate flat').click();
  flushSync();
  const dialog = document.querySelector('dialog[aria-labelledby="call-title"]')!;
  dialog.querySelector('form')!.dispatchEvent(new SubmitEvent('submit', { bubbles: true, cancelable: true }));
  await settled();
  const problem = dialog.querySelector('[role="alert"]')!;
  expect(problem.textContent).toBe('The name flat 2 is already in use here.');
  const field = dialog.querySelector('input')!;
  write(field, '');
  expect(problem.textContent).toBe('');
});
