import { encode } from '@msgpack/msgpack';
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { choices } from '../../choices.svelte';
import type { Fetch } from '../../server';
import { Live } from '../../live.svelte';
import { FakeFiles } from '../../testing/files';
import { FLAT } from '../../testing/flat';
import { madeUpHome } from '../../testing/home';
import { button, EVIL, fakeWire, write } from '../../testing/page';
import type { PlanView, ProblemView } from '../../wire';
import View from './Plan.svelte';


let files: FakeFiles;
let live: Live;
let view: Record<string, unknown>;
let problems: ProblemView[];
/** The problems do not prevent the coverage. */
let isSeen = false;

const PLAN = (): PlanView => ({
  problems,
  home: problems.length > 0 && !isSeen ? null : madeUpHome(3),
  coverage: problems.length > 0 && !isSeen ? null : {
    step_m: 1, corner: [0, 0], columns: 2, cells: new Uint8Array([0, 1, 2, 255]),
    whole: { name: 'flat', floor_m2: 15, seen_by: [0.25, 0.25, 0.5, 0] },
    rooms: [{ name: 'room', floor_m2: 10, seen_by: [0.3, 0.7, 0, 0] }],
    sensors: [{ name: 'room motion', seen_m2: 7, alone_m2: 4 }],
    overlaps: [['room motion', 'bath motion', 0.5]],
    dead_zones: [{ number: 1, room: 'room', area_m2: 3, middle: [1, 1], outline: [[0, 0], [1, 0], [1, 1]], holes: [] }],
  },
});

async function begin(home: string | null, answers: Record<string, (body: never) => unknown> = {}): Promise<void> {
  [problems, isSeen] = [[], false];
  files = new FakeFiles(home === null ? { 'scenario.json': '{}' } : { 'home.json': home, 'scenario.json': '{}' }, { home: home === null ? null : 'home.json', logger: null, lives: [] }, answers);
  const fetch: Fetch = async (path, init) => {
    const answer = await files.fetch(path, init);
    return path === '/api/plan' ? new Response(encode(PLAN()) as BodyInit) : answer;
  };
  vi.stubGlobal('fetch', fetch);
  live = new Live('token', () => {}, () => fakeWire());
  view = mount(View, { target: document.body, props: { live } });
  await settle();
}

/** Completes all pending work. */
async function settle(): Promise<void> {
  for (let round = 0; round < 4; round++) {
    await vi.advanceTimersByTimeAsync(300);
    flushSync();
  }
}

beforeEach(() => vi.useFakeTimers());

afterEach(async () => {
  await unmount(view);
  choices.setUnits('metric');
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

const plan = () => document.querySelector<HTMLElement>('[role="application"]')!;
const field = (label: string) => document.querySelector<HTMLInputElement>(`[aria-label="${label}"]`) ?? [...document.querySelectorAll('label')].map((one) => (one.textContent!.trim() === label ? (one.control as HTMLInputElement | null) ?? one.querySelector('input') : null)).find(Boolean)!;
const text = () => live.drafts.text('home.json')!;
const value = () => JSON.parse(text());
const said = () => document.querySelector('.status')!.textContent!.replaceAll(/\s+/g, ' ').trim();

function click(name: string): void {
  button(name).click();
  flushSync();
}

function key(key: string, more: KeyboardEventInit = {}): KeyboardEvent {
  const event = new KeyboardEvent('keydown', { key, code: key === ' ' ? 'Space' : key, bubbles: true, cancelable: true, ...more });
  (document.activeElement ?? document.body).dispatchEvent(event);
  flushSync();
  return event;
}

function type(label: string, typed: string): void {
  const input = field(label);
  write(input, typed, 'change');
}

test('another name is followed into other files, as one step that is undone', async () => {
  const renamed = vi.fn(({ draft, from, to }: { draft: { texts: Record<string, string> }; from: string; to: string }) => ({
    mentions: [{ file: 'logger.json', line: 1, said: from, goes: true }],
    is_shared: false,
    texts: { 'home.json': (draft.texts['home.json'] ?? FLAT).replaceAll(JSON.stringify(from), JSON.stringify(to)), 'logger.json': `{"ids":{"${to}":"A1"}}` },
  }));
  await begin(FLAT, { '/api/rename': renamed as never });
  files.texts['logger.json'] = '{"ids":{"room motion":"A1"}}';
  await vi.advanceTimersByTimeAsync(3000);
  const home = text();
  live.drafts.write('home.json', home);
  click('List');
  click('room motion');
  click('Element');
  type('Name', 'parlour motion');
  await settle();
  expect(renamed).toHaveBeenCalledOnce();
  expect(text()).toBe(home.replaceAll('"room motion"', '"parlour motion"'));
  expect(live.drafts.text('logger.json')).toBe('{"ids":{"parlour motion":"A1"}}');
  click('Undo');
  expect([text(), live.drafts.text('logger.json')]).toEqual([home, '{"ids":{"room motion":"A1"}}']);
  click('Redo');
  expect(live.drafts.text('logger.json')).toBe('{"ids":{"parlour motion":"A1"}}');
  // Undo leaves later changes of that file.
  live.drafts.write('logger.json', '{"ids":{}}');
  click('Undo');
  expect([text(), live.drafts.text('logger.json')]).toEqual([home, '{"ids":{}}']);
});

test('a thing whose name another has is renamed only here, which is said', async () => {
  let is_shared = false;
  await begin(FLAT, { '/api/rename': () => ({ mentions: [], texts: {}, is_shared }) });
  click('List');
  click('room motion');
  click('Element');
  for (const name of ['parlour motion', 'hall motion']) {
    type('Name', name);
    await settle();
    expect(text()).toBe(FLAT.replaceAll('"room motion"', JSON.stringify(name)));
    expect(document.body.textContent!.includes('Renamed only here. Another element has the same name')).toBe(is_shared);
    is_shared = true;
  }
});

test('what speaks of a thing that is deleted is told, and goes as well on request', async () => {
  await begin(FLAT, { '/api/forget': () => ({ mentions: [{ file: 'logger.json', line: 1, said: '"room motion": "A1"', goes: true }], texts: { 'logger.json': '{"ids":{}}' }, is_shared: false }) });
  files.texts['logger.json'] = '{"ids":{"room motion":"A1"}}';
  await vi.advanceTimersByTimeAsync(3000);
  const home = text();
  click('List');
  click('room motion');
  click('Element');
  click('Delete');
  await settle();
  expect(document.querySelector('[role="alertdialog"]')!.textContent).toContain('One line still refers to what you deleted');
  click('Remove it too');
  expect(live.drafts.text('logger.json')).toBe('{"ids":{}}');
  expect(document.querySelector('[role="alertdialog"]')).toBeNull();
  click('Undo');
  click('Undo');
  expect([text(), live.drafts.text('logger.json')]).toEqual([home, '{"ids":{"room motion":"A1"}}']);
});

test('what has one answer is mended by a button', async () => {
  const mend = { what: 'Remove the 2 ids of deleted sensors', texts: { 'logger.json': '{"ids":{}}' } };
  await begin(FLAT, { '/api/mends': () => [mend] });
  files.texts['logger.json'] = '{"ids":{"a":"1","b":"2"}}';
  files.check = { problems: [{ file: 'logger.json', line: 1, column: 8, width: 3, what: 'there is no sensor "a"', hint: null }], warnings: [] };
  await vi.advanceTimersByTimeAsync(3000);
  await settle();
  click('Problems');
  await settle();
  click('Remove the 2 ids');
  expect(live.drafts.text('logger.json')).toBe('{"ids":{}}');
});

test('a hint that has one answer is a button, and that is one step', async () => {
  await begin(FLAT);
  const bed = { name: 'cot', at: [2, 1], size_m: [0.9, 2], height_m: 0.5, enterable: true };
  files.check = {
    problems: [{ file: 'ann.routine', line: 0, column: 0, width: 1, what: 'there is nowhere in this home to sleep', hint: `give it a bed; add ${JSON.stringify(bed)}`, fix: { kind: 'add', piece: bed, room: null, rest: 'give it a bed' } }],
    warnings: [],
  };
  live.drafts.write('home.json', `${FLAT}\n`);
  live.drafts.write('home.json', FLAT);
  await settle();
  click('Problems');
  expect(document.querySelector('.hint')!.textContent).toBe('give it a bed');
  expect(document.querySelector('a[href^="#/life"]')).toBeNull();
  click('Add “cot”');
  expect(value().furniture[2]).toEqual(bed);
  click('Undo');
  expect(text()).toBe(FLAT);
});

test('the sensors that wake a camera are a list of names', async () => {
  const camera = { kind: 'camera', name: 'eye', at: [3, 2], facing_deg: 0, woken_by: ['room motion', 'old motion'] };
  await begin(JSON.stringify({ ...JSON.parse(FLAT), sensors: [...JSON.parse(FLAT).sensors, camera] }, null, 2));
  click('List');
  click('eye');
  click('Element');
  const pick = field('Add to: Woken by');
  expect([...pick.querySelectorAll('option')].map(({ textContent }) => textContent)).toEqual(['another sensor', 'bed sensor', 'bath contact', 'room light', 'bath motion']);
  expect(document.querySelector('.names .gone')!.textContent).toContain('old motion');
  write(pick, 'bath motion', 'change');
  expect(value().sensors[5].woken_by).toEqual(['room motion', 'old motion', 'bath motion']);
  for (const name of ['old motion', 'room motion', 'bath motion']) click(`Remove ${name} from: Woken by`);
  expect(value().sensors[5]).not.toHaveProperty('woken_by');
  expect(text()).not.toContain('null');
});

test('all can be selected, moved, turned and deleted by keys', async () => {
  await begin(FLAT);
  plan().focus();
  const seen = new Set<string>();
  for (let press = 0; press < 16; press++) {
    key('PageDown');
    seen.add(document.getElementById(plan().getAttribute('aria-activedescendant')!)!.getAttribute('aria-label')!);
  }
  expect(seen.size).toBe(16);
  expect(seen).toContain('room light, light sensor');
  click('List');
  click('stove');
  plan().focus();
  key('ArrowRight');
  key('ArrowUp', { shiftKey: true });
  key('[');
  expect(value().furniture[1]).toMatchObject({ at: [3.05, 0.41], turn_deg: 15 });
  key('Delete');
  expect(value().furniture).toHaveLength(1);
  key('z', { ctrlKey: true });
  key('z', { ctrlKey: true });
  key('z', { ctrlKey: true });
  expect(text()).toBe(FLAT);
});

test('a tool is used without a mouse', async () => {
  await begin(FLAT);
  plan().focus();
  key('w');
  expect(said()).toContain('Click where the wall starts');
  key('Enter');
  for (let press = 0; press < 9; press++) key('ArrowRight');
  key('Enter');
  key('Escape');
  key('Escape');
  const [, , , , , wall] = value().walls;
  expect(wall.to[0] - wall.from[0]).toBeCloseTo(0.9, 1);
  expect(button('Select').getAttribute('aria-pressed')).toBe('true');
});

test('after another view was looked at all goes on, and can be undone', async () => {
  await begin(FLAT);
  click('List');
  click('stove');
  plan().focus();
  key('ArrowRight');
  const moved = text();
  await unmount(view);
  view = mount(View, { target: document.body, props: { live } });
  await settle();
  expect(document.querySelector('#tab-panel h2')!.textContent).toBe('stove');
  plan().focus();
  key('PageDown');
  expect(document.querySelector('#tab-panel h2')!.textContent).not.toBe('stove');
  expect(document.getElementById('form-furniture/1')!.getAttribute('points')).toContain('2.75,');
  key('z', { ctrlKey: true });
  expect(text()).toBe(FLAT);
  expect(moved).not.toBe(FLAT);
  expect(document.getElementById('form-furniture/1')!.getAttribute('points')).not.toContain('2.75,');
});

test('the keys of tools count as soon as the plan is shown, and the plan has the focus then', async () => {
  await begin(FLAT);
  const takes = () => document.querySelector('[aria-label="Tools"] [aria-pressed="true"]')!.getAttribute('data-tool');
  for (const [letter, tool] of [['w', 'wall'], ['U', 'furniture'], ['s', 'sensor'], ['v', 'select']] as const) {
    (document.activeElement as HTMLElement).blur();
    expect(key(letter).defaultPrevented).toBe(true);
    expect([takes(), document.activeElement]).toEqual([tool, plan()]);
  }
  const zoom = button('Zoom in');
  zoom.focus();
  expect([key('w').defaultPrevented, takes(), document.activeElement]).toEqual([false, 'select', zoom]);
});

test('a key of a tool that means something else where the focus is takes none', async () => {
  await begin(FLAT);
  click('List');
  click('room motion');
  click('Element');
  const dialog = document.createElement('dialog');
  const select = document.body.appendChild(document.createElement('select'));
  for (const place of [field('Name'), document.querySelector<HTMLElement>('[role="slider"]')!, select]) {
    place.focus();
    expect(document.activeElement).toBe(place);
    key('w');
    expect(button('Select').getAttribute('aria-pressed')).toBe('true');
    expect(document.activeElement).toBe(place);
  }
  select.remove();
  document.body.append(dialog);
  dialog.setAttribute('open', '');
  (document.activeElement as HTMLElement).blur();
  key('w');
  dialog.remove();
  for (const more of [{ ctrlKey: true }, { metaKey: true }, { altKey: true }]) key('w', more);
  expect(button('Select').getAttribute('aria-pressed')).toBe('true');
});

test('keys that change the plan count only while it has the focus, and Space is nobody\'s', async () => {
  await begin(FLAT);
  document.body.focus();
  for (const letter of ['Delete', 'ArrowLeft', '[']) expect(key(letter).defaultPrevented, letter).toBe(false);
  expect(text()).toBe(FLAT);
  plan().focus();
  expect(key(' ').defaultPrevented).toBe(false);
  expect(key('Tab').defaultPrevented).toBe(false);
});

test('what is pressed and moved is dragged, and let go it is one step', async () => {
  await begin(FLAT);
  const mouse = (type: string, x: number, y: number, target: Element = plan()) => {
    target.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, button: 0, pointerId: 1, bubbles: true, cancelable: true }));
    flushSync();
  };
  plan().setPointerCapture = () => {};
  const scale = 50;
  mouse('pointerdown', 100, 100, document.getElementById('form-furniture/1')!);
  for (let step = 1; step <= 5; step++) mouse('pointermove', 100 - step * 5, 100 - step * 5);
  expect(value().furniture[1].at).not.toEqual([3, 0.4]);
  mouse('pointerup', 75, 75);
  const [x, y] = value().furniture[1].at;
  expect(Math.abs(x - (3 - 25 / scale))).toBeLessThan(0.2);
  expect(Math.abs(y - (0.4 + 25 / scale))).toBeLessThan(0.2);
  expect(document.querySelector('#tab-panel h2')!.textContent).toBe('stove');
  key('z', { ctrlKey: true });
  expect(text()).toBe(FLAT);
  // A press with a small move is a click, and one on empty floor selects nothing.
  mouse('pointerdown', 10, 10);
  mouse('pointerup', 11, 10);
  expect(document.querySelector('#tab-panel h2')!.textContent).toBe('Home');
});

test('numbers are typed in the chosen units, and what cannot be is said', async () => {
  await begin(FLAT);
  click('List');
  click('room motion');
  click('Element');
  type('Place: north', '1.75');
  type('Direction, from east', '-30');
  expect(value().sensors[0]).toMatchObject({ at: [0.12, 1.75], facing_deg: -30 });
  type('Direction, from east', '900');
  expect(value().sensors[0].facing_deg).toBe(-30);
  expect(document.querySelector('[role="alert"]')!.textContent).toContain('From -360 to 360.');
  type('Field: across', '110');
  expect(value().sensors[0].field_deg).toEqual([110, 50]);
  type('Field: across', '');
  expect(value().sensors[0]).not.toHaveProperty('field_deg');
  choices.setUnits('feet');
  flushSync();
  expect(field('Reach').placeholder).toBe('32.81');
  type('Reach', '20');
  expect(value().sensors[0].reach_m).toBe(6.096);
  const level = field('Sees');
  write(level, 'zones', 'change');
  type('Rows: middle', '7');
  expect(value().sensors[0].level).toEqual({ zones: { rows: [11, 7, 5] } });
});

test('another name is taken over by the sensors', async () => {
  await begin(FLAT);
  click('List');
  click('bed');
  click('Element');
  type('Name', EVIL);
  await settle();
  expect(value().furniture[0].name).toBe(EVIL);
  expect(value().sensors[1].on).toBe(EVIL);
  type('Name', '  ');
  expect(value().furniture[0].name).toBe(EVIL);
});

test('what the sensors see is in figures, and is old while there is a problem, which leads to its place', async () => {
  await begin(FLAT);
  expect(document.querySelector('[aria-label="Colours of the floor"]')!.textContent).toMatch(/^Sensors.*none.*no room to stand/);
  click('Coverage');
  expect(document.querySelector('tbody')!.textContent!.replaceAll(/\s+/g, ' ')).toContain('All15.0 m²25.0 %25.0 %50.0 %0.0 %');
  expect(document.body.textContent).toContain('Dead zones 1');
  const line = FLAT.split('\n').findIndex((one) => one.includes('"stove"')) + 1;
  problems = [{ file: 'home.json', line, column: 7, width: 4, what: `${EVIL} reaches out`, hint: 'move it' }];
  plan().focus();
  key('PageDown');
  key('ArrowLeft');
  await settle();
  expect(document.body.textContent).toContain('These figures are out of date');
  click('Problems');
  expect(document.body.textContent).toContain('move it');
  click('Show stove');
  expect(document.querySelector('#tab-panel h2')!.textContent).toBe('stove');
  expect(document.getElementById('form-furniture/1')!.getAttribute('aria-label')).toContain('has a problem');
});

test('a problem that keeps no sensor from seeing leaves what is seen as it is', async () => {
  await begin(FLAT);
  click('Coverage');
  problems = [{ file: 'home.json', line: 3, column: 7, width: 4, what: 'another piece of furniture is named "bed" too', hint: null }];
  isSeen = true;
  plan().focus();
  key('PageDown');
  key('ArrowLeft');
  await settle();
  expect(document.querySelector('tbody')!.textContent).toContain('All');
  expect(document.body.textContent).not.toContain('out of date');
  expect(document.querySelector('#tab-problems')!.textContent).toContain('1');
});

test('what mends a problem is done once: its button is dead until the home is checked anew', async () => {
  const toilet = { name: 'toilet', at: [5, 2.5], size_m: [0.4, 0.6], height_m: 0.4, enterable: true };
  const lacks: ProblemView = { file: 'home.json', line: 0, column: 0, width: 0, what: 'nobody can use a toilet', hint: 'give it one', fix: { kind: 'add', piece: toilet, room: 'bath', rest: 'give it one' } };
  await begin(FLAT, { '/api/mends': () => [] });
  files.check = { problems: [lacks], warnings: [] };
  live.drafts.write('home.json', `${FLAT}\n`);
  await settle();
  click('Problems');
  const count = () => value().furniture.filter(({ name }: { name: string }) => name === 'toilet').length;
  click('Add “toilet” to “bath”');
  expect([count(), button('Add “toilet” to “bath”').disabled]).toEqual([1, true]);
  click('Add “toilet” to “bath”');
  expect(count()).toBe(1);
  files.check = { problems: [], warnings: [] };
  await settle();
  expect(button('Add “toilet”')).toBeUndefined();
});

test('what is drawn over the image is named among its fields', async () => {
  await begin(FLAT);
  const tab = () => document.querySelector('[role="tab"][aria-selected="true"]')!.textContent!.trim();
  click('Image');
  click('Wall');
  expect(tab()).toBe('Element');
  // The image can be opened while the user draws over it.
  click('Image');
  expect(tab()).toBe('Image');
});

test('suggested sensors take the places of those of their kind, which are named, in one step', async () => {
  const fresh = [{ kind: 'motion', name: 'new motion', at: [3.9, 1.5], facing_deg: 180 }];
  const forget = vi.fn(() => ({ mentions: [{ file: 'logger.json', line: 1, said: '"room motion": "A1"', goes: true }], texts: {}, is_shared: false }));
  await begin(FLAT, {
    '/api/parts': () => ({ problems: [], parts: [], devices: [], csv: '' }),
    '/api/suggest': () => ({ problems: [], refused: null, sensors: JSON.stringify(fresh), steps: [{ sensor: 'new motion', score: 0.99964, reached: [{ goal: 'falls', score: 0.99964, value: 0.99964, unit: 'of the floor' }, { goal: 'depression', score: 0, value: 28, unit: 'days until found' }] }], whole: null, own: null }),
    '/api/forget': forget,
  });
  click('Install');
  await settle();
  click('Suggest sensors');
  await settle();
  expect(document.querySelector('[aria-label="Suggested sensors"]')!.textContent).toContain('1 sensor of 6: more sensors add nothing.');
  expect(document.querySelector('#suggest-goes')!.textContent!.replaceAll(/\s+/g, ' ').trim()).toBe('Replace: 5 sensors in all. Removed: room motion. Kept: 4 sensors.');
  // Some of it is invisible.
  expect([...document.querySelectorAll('[aria-label="Suggested sensors"] strong')].map((one) => one.textContent)).toEqual(['99.9 %', '99.9 %', '0.0 %']);
  expect([...document.querySelectorAll('[aria-label="Suggested sensors"] ul > li')].map((one) => one.textContent)).toEqual(['Most of the floor: 99.9 % (of the floor with room to stand)', 'Depression: 0.0 % (not found within four weeks)']);
  click('Replace the current motion sensor');
  await settle();
  expect(value().sensors.map(({ name }: { name: string }) => name)).toEqual(['bed sensor', 'bath contact', 'room light', 'bath motion', 'new motion']);
  expect(forget).toHaveBeenCalledWith(expect.objectContaining({ kind: 'sensor', names: ['room motion'] }));
  expect(document.querySelector('[role="alertdialog"]')!.textContent).toContain('"room motion": "A1"');
  click('Undo');
  expect(text()).toBe(FLAT);
});

test('a sensor alone is asked for with a home that has no other', async () => {
  await begin(FLAT);
  click('List');
  click('room motion');
  click('Coverage');
  const mode = document.querySelector('select')!;
  write(mode, 'alone', 'change');
  await settle();
  expect(JSON.parse(files.drafts('/api/plan')!['home.json']!).sensors).toEqual([JSON.parse(FLAT).sensors[0]]);
  expect(text()).toBe(FLAT);
});

test('a file that is no JSON is told of and not touched, and drawn again once it is mended', async () => {
  const broken = FLAT.replace('"walls": [', '"walls": [[[');
  await begin(broken);
  expect(document.body.textContent).toMatch(/home\.json cannot be shown/);
  expect(document.body.textContent).toMatch(/Line \d+, column \d+/);
  key('z', { ctrlKey: true });
  key('v', { ctrlKey: true });
  expect(live.drafts.unsaved).toEqual([]);
  files.texts['home.json'] = FLAT;
  await vi.advanceTimersByTimeAsync(2500);
  flushSync();
  expect(plan()).not.toBeNull();
});

test('a scenario without a home says how to name one', async () => {
  await begin(null);
  expect(document.body.textContent).toContain('has no home file');
});

test('names from the file are text and nothing else', async () => {
  const rough = FLAT.replace('"stove"', JSON.stringify(EVIL)).replace('"room motion"', JSON.stringify(`\u202e${'long '.repeat(900)}\n👩‍👩‍👧`)).replace('"flat"', JSON.stringify(EVIL));
  await begin(rough);
  for (const tab of ['List', 'Coverage', 'Problems', 'Element']) click(tab);
  plan().focus();
  for (let press = 0; press < 20; press++) key('PageDown');
  key('d', { ctrlKey: true });
  expect(() => value()).not.toThrow();
  expect(document.querySelector('main script, img[onerror], .plan script, [onerror]')).toBeNull();
  expect((globalThis as { broken?: number }).broken).toBeUndefined();
});
