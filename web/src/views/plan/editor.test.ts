import { encode } from '@msgpack/msgpack';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Drafts } from '../../drafts.svelte';
import { Server } from '../../server';
import { FakeFiles } from '../../testing/files';
import { FLAT } from '../../testing/flat';
import type { CoverageView, PlanView } from '../../wire';
import { Coverage } from './coverage.svelte';
import { Editor } from './editor.svelte';
import { colours } from './heat';
import { shortcut } from './keys';
import { click, finish } from './tools';

let files: FakeFiles;
let drafts: Drafts;
let editor: Editor;
let stop: () => void;

beforeEach(async () => {
  vi.useFakeTimers();
  files = new FakeFiles({ 'home.json': FLAT, 'scenario.json': '{}' }, { home: 'home.json', logger: null, lives: [] });
  drafts = new Drafts(new Server('token', () => {}, files.fetch), () => {});
  stop = drafts.open();
  await vi.advanceTimersByTimeAsync(10);
  editor = new Editor(drafts);
  editor.notice();
});

afterEach(() => {
  stop();
  vi.useRealTimers();
});

test('a drag is one step, and undo and redo go there and back', () => {
  editor.select(['furniture/0']);
  editor.begin();
  for (let at = 1; at <= 5; at++) editor.drag([{ path: ['furniture', 0, 'at'], value: [1 + at / 10, 2] }]);
  editor.end();
  const moved = editor.text!;
  expect(moved).toContain('"bed", "at": [1.5, 2]');
  expect(drafts.unsaved).toEqual(['home.json']);
  editor.undo();
  expect(editor.text).toBe(FLAT);
  expect(drafts.unsaved).toEqual([]);
  expect(editor.canUndo).toBe(false);
  editor.redo();
  expect(editor.text).toBe(moved);
  expect(editor.selected).toEqual(['furniture/0']);
});

test('a drag that is given up leaves nothing, and no step', () => {
  editor.begin();
  editor.drag([{ path: ['furniture', 0, 'at'], value: [9, 9] }]);
  editor.cancel();
  expect([editor.text, editor.canUndo]).toEqual([FLAT, false]);
});

test('nudges that follow one another are one step, later ones another', () => {
  editor.select(['places/0']);
  editor.nudge([0.05, 0], false);
  editor.nudge([0.05, 0], false);
  vi.advanceTimersByTime(2000);
  editor.nudge([0, 0.01], false);
  expect(editor.chosen[0]!.value.at).toEqual([2.1, 1.01]);
  editor.undo();
  expect(editor.chosen[0]!.value.at).toEqual([2.1, 1]);
  editor.undo();
  expect(editor.text).toBe(FLAT);
});

test('what another program has written is drawn, and can be undone', async () => {
  files.texts['home.json'] = FLAT.replace('[2, 1]', '[2, 2]');
  await vi.advanceTimersByTimeAsync(2100);
  editor.notice();
  expect(editor.text).toBe(files.texts['home.json']);
  editor.undo();
  expect(editor.text).toBe(FLAT);
});

test('copies are pasted beside, under names of their own, and deleted again', () => {
  editor.select(['furniture/0', 'sensors/0', 'doors/0']);
  editor.copy();
  editor.paste();
  expect(editor.chosen.map(({ name }) => name)).toEqual(['bed 2', 'room motion 2', 'bath door 2']);
  expect(editor.chosen[0]!.value.at).toEqual([1.3, 1.7]);
  editor.paste();
  expect(editor.chosen[0]!.value.at).toEqual([1.6, 1.4]);
  editor.delete();
  editor.undo();
  editor.undo();
  editor.undo();
  expect(editor.text).toBe(FLAT);
  editor.select(['furniture/0', 'furniture/1', 'rooms/1']);
  editor.delete();
  expect(JSON.parse(editor.text!)).toMatchObject({ furniture: [], rooms: [{ name: 'room' }] });
  expect(editor.selected).toEqual([]);
});

test('a file that is no JSON is not touched', () => {
  editor.write('{ "rooms": [');
  expect(editor.home).toBeNull();
  expect(editor.fault!.what).not.toBe('');
  editor.select(['furniture/0']);
  editor.delete();
  editor.nudge([1, 1], false);
  editor.add('walls', { from: [0, 0], to: [1, 0] });
  editor.paste();
  expect(editor.text).toBe('{ "rooms": [');
  editor.undo();
  expect(editor.text).toBe(FLAT);
});

test('walls are clicked one after the other, and end where they meet one that is there', () => {
  const snapping = { tolerance_m: 0.1, grid_m: 0.05 };
  editor.hold({ tool: 'wall' });
  for (const at of [[4.02, 1.48], [5.03, 1.52], [5.01, 2.98]] as [number, number][]) click(editor, editor.home!, at, snapping);
  const walls = JSON.parse(editor.text!).walls.slice(5);
  expect(walls).toEqual([{ from: [4, 1.5], to: [5.05, 1.5] }, { from: [5.05, 1.5], to: [5.05, 3] }]);
  finish(editor, editor.home!);
  expect(editor.drawn).toEqual([]);
  editor.hold({ tool: 'fill' });
  click(editor, editor.home!, [5.5, 1], snapping);
  expect(editor.one!.value.name).toBe('room 2');
  expect(editor.one!.value.outline).toHaveLength(6);
  // The next click fills the next space, and does not fill one that is a room already.
  const rooms = () => JSON.parse(editor.text!).rooms.length;
  click(editor, editor.home!, [5.3, 0.5], snapping);
  expect([rooms(), editor.one!.value.name, editor.said, editor.tool.tool]).toEqual([3, 'room 2', 'This space is already room 2.', 'fill']);
  click(editor, editor.home!, [4.5, 2.5], snapping);
  expect([rooms(), editor.one!.value.name, editor.said]).toEqual([4, 'room 3', '']);
});

test('a camera is put up at the wall that is near and looks into the room, and without snapping where it is put', () => {
  const put = (snapping: { tolerance_m: number; grid_m: number } | null) => {
    editor.hold({ tool: 'sensor', kind: 'camera' });
    click(editor, editor.home!, [1, 1.5], snapping);
    const { at, facing_deg } = editor.one!.value;
    return { at, facing_deg };
  };
  expect(put({ tolerance_m: 0.1, grid_m: 0.05 })).toEqual({ at: [0.12, 1.5], facing_deg: 0 });
  expect(put(null)).toEqual({ at: [1, 1.5], facing_deg: 0 });
});

test('a room is clicked corner by corner and closed at the first', () => {
  editor.hold({ tool: 'room' });
  finish(editor, editor.home!);
  expect(editor.said).toBe('A room needs at least three corners.');
  for (const at of [[7, 0], [9, 0], [9, 2], [7.001, 0.001]] as [number, number][]) click(editor, editor.home!, at, { tolerance_m: 0.1, grid_m: 0.05 });
  expect(editor.one!.value).toEqual({ name: 'room 2', outline: [[7, 0], [9, 0], [9, 2]] });
  expect(editor.tool.tool).toBe('select');
});

test('a click that can do nothing says what to do', () => {
  editor.hold({ tool: 'fill' });
  click(editor, editor.home!, [20, 20], null);
  expect(editor.said).toContain('No walls enclose this spot');
  editor.hold({ tool: 'sensor', kind: 'bed' });
  click(editor, editor.home!, [5, 2.5], null);
  expect(editor.said).toContain('for the bed sensor');
  expect(editor.text).toBe(FLAT);
});

test('keys with Ctrl are ours but in fields', () => {
  const key = (key: string, shiftKey = false) => shortcut(new KeyboardEvent('keydown', { key, shiftKey, ctrlKey: true }), editor);
  expect(key('c')).toBe(false);
  editor.select(['places/0']);
  expect([key('d'), key('Z', true), key('z'), key('y'), key('z')]).toEqual([true, true, true, true, true]);
  expect(editor.text).toBe(FLAT);
  expect(key('s')).toBe(false);
  const field = document.body.appendChild(document.createElement('input'));
  field.focus();
  expect(key('a')).toBe(false);
  field.remove();
});

const cells = (counts: number[]): CoverageView => ({
  step_m: 1, corner: [0, 0], columns: 2, cells: new Uint8Array(counts), whole: { name: 'flat', floor_m2: 4, seen_by: [0, 0, 0, 0] }, rooms: [], sensors: [], overlaps: [], dead_zones: [],
});

const HOME = { name: '', bounds: [[0, 0], [1, 1]], rooms: [], solids: [], doors: [], things: [], sensors: [] } as PlanView['home'];

test('one question is under way at a time, and the next is the latest', async () => {
  const asked: string[] = [];
  const answers: (() => void)[] = [];
  const server = new Server('token', () => {}, async (_, { body }) => {
    const { texts } = JSON.parse(String(body)) as { texts: Record<string, string> };
    asked.push(texts.home!);
    await new Promise<void>((go) => answers.push(go));
    const bad = texts.home === 'bad';
    const view: PlanView = { problems: bad ? [{ file: 'home', line: 1, column: 1, width: 1, what: 'wrong', hint: null }] : [], home: bad ? null : HOME, coverage: bad ? null : cells([texts.home!.length]) };
    return new Response(encode(view) as BodyInit);
  });
  const coverage = new Coverage(server);
  const answer = async () => {
    answers.shift()!();
    await vi.advanceTimersByTimeAsync(5);
  };
  for (const home of ['a', 'bb', 'ccc', 'dddd']) coverage.ask({ texts: { home } }, null);
  await vi.advanceTimersByTimeAsync(5);
  expect(asked).toEqual(['a']);
  await answer();
  expect(asked).toEqual(['a', 'dddd']);
  expect([...coverage.seen!.coverage.cells]).toEqual([1]);
  await answer();
  expect([...coverage.seen!.coverage.cells]).toEqual([4]);
  // While the home has problems, the last coverage stays, and is marked as outdated.
  coverage.ask({ texts: { home: 'bad' } }, { texts: { home: 'alone' } });
  await vi.advanceTimersByTimeAsync(5);
  await answer();
  expect([coverage.stale, coverage.problems!.length, [...coverage.seen!.coverage.cells]]).toEqual([true, 1, [4]]);
  coverage.ask({ texts: { home: 'good' } }, { texts: { home: 'alone' } });
  await vi.advanceTimersByTimeAsync(5);
  await answer();
  await answer();
  expect([coverage.stale, [...coverage.alone!.cells], asked.at(-1)]).toEqual([false, [5], 'alone']);
});

test('a server that cannot answer is told of, and asked again', async () => {
  let works = false;
  const server = new Server('token', () => {}, async () => (works ? new Response(encode({ problems: [], home: HOME, coverage: cells([1]) }) as BodyInit) : new Response('It is on fire.', { status: 500 })));
  const coverage = new Coverage(server);
  coverage.ask({ texts: {} }, null);
  await vi.advanceTimersByTimeAsync(5);
  expect(coverage.trouble).toContain('It is on fire.');
  works = true;
  coverage.ask({ texts: {} }, null);
  await vi.advanceTimersByTimeAsync(5);
  expect([coverage.trouble, coverage.stale]).toEqual(['', false]);
});

test('each number of sensors has its colour, and no floor none', () => {
  const all = cells([0, 1, 2, 3, 4, 9, 255]);
  const count = colours(all, 'count', null);
  expect([count[0], count[6]]).toEqual([null, null]);
  expect(new Set(count.slice(1, 4)).size).toBe(3);
  expect([count[4], count[5]]).toEqual([count[3], count[3]]);
  const alone = colours(all, 'alone', cells([0, 1, 1, 0, 0, 0, 255]));
  expect(alone.map((colour) => colour !== null)).toEqual([false, true, true, false, false, false, false]);
  expect(alone[1]).not.toBe(alone[2]);
  expect([colours(all, 'off', null), colours(all, 'dead', null), colours(all, 'alone', null), colours(all, 'alone', cells([1]))]).toEqual([[], [], [], []]);
});
