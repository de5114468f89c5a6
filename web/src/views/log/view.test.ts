import { encode } from '@msgpack/msgpack';
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Live } from '../../live.svelte';
import type { Wire } from '../../socket';
import { FakeFiles } from '../../testing/files';
import { frame } from '../../testing/frames';
import { daysFrom } from '../../testing/dates';
import { madeUpRun } from '../../testing/home';
import { button, EVIL, expectText, fakeWire, write } from '../../testing/page';
import type { Connect, LiveCountsView, RowsView } from '../../wire';
import LogView from './Log.svelte';

const LOGGER = '{\n  "to": ["sqlite:log.db"],\n  "table": "event",\n  "ids": {\n    "bed": "C1"\n  },\n  "messages": "fire_only"\n}\n';
const SCENARIO = '{\n  "$schema": "../schemas/scenario.schema.json",\n  "home": "home.json"\n}\n';
const HOME = JSON.stringify({ sensors: [{ name: 'hall motion', kind: 'motion' }, { name: 'bed', kind: 'bed' }, { name: 'front door', kind: 'contact' }] });
const ROWS: RowsView = {
  problems: [],
  places: [
    { to: 'sqlite:log.db', table: 'event', columns: ['run_id', 'ts'], rows: [['1', '07:12']] },
    { to: 'casas:log.txt', table: null, columns: [], rows: [['07:12', 'Bed', 'ON']] },
  ],
  kinds: [['sqlite:', 'a database file'], ['csv:', 'values'], ['casas:', 'text']],
  cut: null,
};
const GROWTH: LiveCountsView = { hours: [[1, 2, 3]], today: [[5, 0]], left_out: 0 };

let live: Live;
let wire: Wire;
let view: Record<string, unknown>;
let files: FakeFiles;
let rowsNow: RowsView;

async function settle(ms = 1500): Promise<void> {
  await vi.advanceTimersByTimeAsync(ms);
  flushSync();
}

async function begin(texts: Record<string, string> = {}, links: { logger?: string | null } = {}, rows: RowsView = ROWS): Promise<void> {
  rowsNow = rows;
  files = new FakeFiles({ 'home.json': HOME, 'logger.json': LOGGER, 'scenario.json': SCENARIO, ...texts }, { home: 'home.json', logger: 'logger.json', lives: [], ...links }, {
    '/api/rows': () => rowsNow,
    '/api/growth': () => GROWTH,
    '/api/connect': ({ url }: Connect) => (url.includes('nowhere') ? { works: false, said: 'the folder does not exist' } : { works: true, said: 'It can be written.' }),
  });
  vi.spyOn(window, 'fetch').mockImplementation((path, init) => files.fetch(String(path), init ?? {}));
  wire = fakeWire();
  live = new Live('token', () => {}, () => wire);
  live.open();
  wire.onopen!();
  wire.onmessage!({ data: JSON.stringify({ tell: 'run', run: { ...madeUpRun(1, 3), days: daysFrom('2009-03-02', 30 * 86_400_000_000) } }) });
  wire.onmessage!({ data: encode(frame({ now_us: 7_200_000_000, told: 1234 })) });
  view = mount(LogView, { target: document.body, props: { live } });
  await settle();
}

const input = (label: string) => {
  const named = [...document.querySelectorAll('label')].find((one) => one.textContent!.trim() === label);
  return (named ? document.getElementById(named.getAttribute('for')!) : document.querySelector(`[aria-label="${label}"]`)) as HTMLInputElement;
};
const written = () => live.drafts.text('logger.json');

function type(label: string, text: string): void {
  const field = input(label);
  write(field, text);
}

function choose(label: string, value: string): void {
  const select = input(label) as unknown as HTMLSelectElement;
  write(select, value, 'change');
}

beforeEach(() => void vi.useFakeTimers());

afterEach(async () => {
  await unmount(view);
  live.close();
  vi.restoreAllMocks();
  vi.useRealTimers();
});

test('each field is a small change of the text, and the rows are asked for with it', async () => {
  await begin();
  expect(input('Table').value).toBe('event');
  type('Table', 'reading');
  expect(written()).toBe(LOGGER.replace('"event"', '"reading"'));
  type('Table', '');
  expect(written()).toBe(LOGGER.replace('  "table": "event",\n', ''));
  type('Time', 'at');
  type('Id of front door', 'D1');
  choose('Kind of destination 1', 'csv:');
  expect(JSON.parse(written()!)).toEqual({ to: ['csv:log.csv'], ids: { bed: 'C1', 'front door': 'D1' }, messages: 'fire_only', columns: { time: 'at' } });
  await settle();
  expect(files.drafts('/api/rows')).toEqual({ 'logger.json': written() });
});

test('messages have their form, and remember what was asked of each', async () => {
  await begin();
  const radio = (index: number) => document.querySelectorAll<HTMLInputElement>('input[type="radio"]')[index]!;
  radio(1).click();
  flushSync();
  type('Hold time in seconds', '2.5');
  type('Hold time in seconds', '');
  radio(2).click();
  flushSync();
  expect(JSON.parse(written()!).messages).toEqual({ occupancy: { timeout_s: 90 } });
  radio(1).click();
  flushSync();
  expect(JSON.parse(written()!).messages).toEqual({ on_off: { hold_s: 2.5 } });
  radio(0).click();
  flushSync();
  expect(written()).toBe(LOGGER);
});

test('the first rows are shown: a table of a database, the lines of a text', async () => {
  await begin();
  const regions = [...document.querySelectorAll('[aria-label^="Rows of destination"]')];
  expect([...regions[0]!.querySelectorAll('th')].map((cell) => cell.textContent)).toEqual(['run_id', 'ts']);
  expect(regions[1]!.querySelector('pre')!.textContent).toBe('07:12\tBed\tON');
});

test('where no row comes it is said of how many days', async () => {
  await begin({}, {}, { ...ROWS, places: [{ ...ROWS.places[0]!, rows: [] }] });
  expect(document.body.textContent).toContain('No events in the first three days.');
});

test('where rows were not looked for to the end, it is said until when', async () => {
  const cut = 'Rows up to 2026-01-05 09:00:50 are shown. The simulation stopped here after 5 seconds, because too much happens.';
  await begin({}, {}, { ...ROWS, places: [{ ...ROWS.places[0]!, rows: [] }], cut });
  expect(document.body.textContent).toContain(cut);
  expect(document.body.textContent).not.toContain('No sensor says anything');
});

test('while something is wrong, the rows from before stay, and what is wrong is said', async () => {
  const problem = { file: 'logger.json', line: 3, column: 12, width: 1, what: 'no name for a table', hint: 'use a to z' };
  await begin();
  rowsNow = { ...ROWS, places: [], problems: [problem] };
  type('Table', 'E!');
  await settle();
  expect(document.body.textContent).toContain('Rows from before this problem');
  expect(document.querySelectorAll('[aria-label^="Rows of destination"]')).toHaveLength(2);
});

test('a problem stands beside its field', async () => {
  await begin();
  files.check = { problems: [{ file: 'logger.json', line: 5, column: 12, width: 1, what: 'twice', hint: 'another' }, { file: 'logger.json', line: 1, column: 1, width: 1, what: 'odd', hint: null }, { file: 'home.json', line: 1, column: 1, width: 1, what: 'elsewhere', hint: null }], warnings: [] };
  type('Table', 'x');
  await settle();
  const field = input('Id of bed');
  expect(field.getAttribute('aria-invalid')).toBe('true');
  expect(document.getElementById(field.getAttribute('aria-describedby')!)!.textContent).toContain('twice');
  expect(input('Id of front door').getAttribute('aria-invalid')).toBe('false');
  expect(document.querySelector('[aria-label="Logger file"]')!.textContent).toContain('odd');
  expect(document.querySelector('[aria-label="Logger file"]')!.textContent).not.toContain('elsewhere');
});

test('a scenario without a logger’s file gets one with the first change, linked and saved together', async () => {
  await begin({}, { logger: null });
  delete files.texts['logger.json'];
  await settle(3000);
  expect(document.body.textContent).toContain('The scenario has no logger');
  expect(live.drafts.unsaved).toEqual([]);
  expect(input('Address of destination 1').value).toBe('log.db');
  type('Table', 'event');
  expect(written()).toBe('{\n  "$schema": "../schemas/logger.schema.json",\n  "table": "event"\n}\n');
  expect(live.drafts.text('scenario.json')).toBe(SCENARIO.replace('"home.json"\n', '"home.json",\n  "logger": "logger.json"\n'));
  await live.drafts.save();
  expect(Object.keys(files.texts).sort()).toEqual(['home.json', 'logger.json', 'scenario.json']);
});

test('a file that is there but not linked is not written over', async () => {
  await begin({}, { logger: null });
  type('Table', 'event');
  expect(live.drafts.unsaved).toEqual(['logger-2.json', 'scenario.json']);
});

test('changes are taken back and made again, the letters of a word together', async () => {
  await begin();
  for (const text of ['r', 're', 'rea']) type('Table', text);
  await settle();
  type('Table', 'read');
  expect(button('Redo').disabled).toBe(true);
  button('Undo').click();
  flushSync();
  expect(input('Table').value).toBe('rea');
  button('Undo').click();
  flushSync();
  expect(live.drafts.unsaved).toEqual([]);
  button('Redo').click();
  button('Redo').click();
  flushSync();
  expect(input('Table').value).toBe('read');
});

test('ids are numbered, pasted, and taken back at once', async () => {
  await begin();
  button('Assign 2').click();
  flushSync();
  expect(JSON.parse(written()!).ids).toEqual({ bed: 'C1', 'hall motion': 'M001', 'front door': 'D001' });
  button('Undo').click();
  flushSync();
  expect(written()).toBe(LOGGER);
  const paste = new Event('paste', { bubbles: true, cancelable: true });
  Object.defineProperty(paste, 'clipboardData', { value: { getData: () => 'B1\nB2\n' } });
  input('Id of bed').dispatchEvent(paste);
  flushSync();
  expect(paste.defaultPrevented).toBe(true);
  expect(JSON.parse(written()!).ids).toEqual({ bed: 'B1', 'front door': 'B2' });
});

test('a place is tried, and what was found is said', async () => {
  await begin();
  button('Test').click();
  await settle(50);
  expect(document.querySelector('.result')!.textContent).toContain('It can be written.');
  type('Address of destination 1', '/nowhere/log.db');
  expect(document.querySelector('.result')!.textContent!.trim()).toBe('');
  button('Test').click();
  await settle(50);
  expect(document.querySelector('.result')!.textContent).toContain('the folder does not exist');
  button('Add destination').click();
  flushSync();
  expect(JSON.parse(written()!).to).toEqual(['sqlite:/nowhere/log.db', 'sqlite:log.db']);
  button('Remove destination 1').click();
  flushSync();
  expect(JSON.parse(written()!).to).toEqual(['sqlite:log.db']);
});

test('a text that is not JSON is mended as text', async () => {
  await begin({ 'logger.json': '{ "to": ' });
  expect(input('Table')).toBeNull();
  type('File text', '{}');
  expect(input('Table').value).toBe('');
});

test('the log of the run is seen to grow, in a drawing and in words', async () => {
  await begin();
  expect(document.body.textContent).toContain('1,234 events so far');
  const map = document.querySelector<HTMLElement>('[role="application"]')!;
  map.focus();
  for (const key of ['ArrowRight', 'ArrowDown']) map.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
  flushSync();
  expect(document.querySelector('.foot .said')!.textContent).toBe('Mon, 2 March 2009, 01 to 02 h: 2 firings');
  map.dispatchEvent(new KeyboardEvent('keydown', { key: 'End', bubbles: true, cancelable: true }));
  flushSync();
  expect(document.querySelector('.foot .said')!.textContent).toContain('no data');
  document.querySelectorAll<HTMLInputElement>('.head input[type="checkbox"]')[0]!.click();
  flushSync();
  expect([...document.querySelectorAll('[aria-labelledby="density-title"] tbody tr td')].slice(0, 6).map((cell) => cell.textContent)).toEqual(['6', '02 to 03 h', '1', '2', 'no data', 'no data']);
});

test('hostile names and odd files are text', async () => {
  const evil = JSON.stringify({ to: [EVIL, 'constructor', '__proto__'], table: EVIL, columns: { time: EVIL }, ids: { [EVIL]: EVIL, __proto__: 'x' }, messages: EVIL, time: EVIL });
  await begin(
    { 'logger.json': evil, 'home.json': JSON.stringify({ sensors: [{ name: `${EVIL}${'x'.repeat(4000)}`, kind: EVIL }, { name: '‮a\nb', kind: 'motion' }] }) }, {},
    { problems: [{ file: EVIL, line: 1, column: 1, width: 1, what: EVIL, hint: EVIL }], places: [{ to: EVIL, table: EVIL, columns: [EVIL], rows: [[EVIL]] }], kinds: [], cut: EVIL },
  );
  expectText(EVIL);
});
