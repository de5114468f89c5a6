import { encode } from '@msgpack/msgpack';
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Drafts } from '../../drafts.svelte';
import { type Fetch, Server } from '../../server';
import { FakeFiles } from '../../testing/files';
import { FLAT } from '../../testing/flat';
import { madeUpHome } from '../../testing/home';
import type { CoverageView, Layouts as Asked, LayoutsView } from '../../wire';
import LayoutComparison from './LayoutComparison.svelte';
import { Editor } from './editor.svelte';
import { Layouts, sensorsOf } from './layouts.svelte';

let drafts: Drafts;
let editor: Editor;
let view: Record<string, unknown>;
let stop: () => void;

const coverage: CoverageView = {
  step_m: 1, corner: [0, 0], columns: 1, cells: new Uint8Array([1]), whole: { name: 'flat', floor_m2: 15, seen_by: [0.25, 0.75, 0, 0] }, rooms: [], sensors: [], overlaps: [], dead_zones: [],
};

/** The sensors of the draft. */
function compared({ one, other }: Asked): LayoutsView {
  const layouts = [one, other].map(({ name, draft }) => ({ name, devices: [], home: madeUpHome(sensorsOf(draft.texts['home.json']!).length), coverage }));
  return { problems: [], layouts, differences: [] } as LayoutsView;
}

beforeEach(async () => {
  vi.useFakeTimers();
  const files = new FakeFiles({ 'home.json': FLAT, 'scenario.json': '{}' }, { home: 'home.json', logger: null, lives: [] });
  const fetch: Fetch = async (path, init) =>
    path === '/api/beside' ? new Response(encode(compared(JSON.parse(String(init.body)))) as BodyInit) : files.fetch(path, init);
  const server = new Server('token', () => {}, fetch);
  drafts = new Drafts(server, () => {});
  stop = drafts.open();
  await vi.advanceTimersByTimeAsync(10);
  editor = new Editor(drafts);
  editor.notice();
  view = mount(LayoutComparison, { target: document.body, props: { editor, server, layouts: new Layouts() } });
});

afterEach(async () => {
  await unmount(view);
  stop();
  vi.useRealTimers();
});

const table = () => [...document.querySelectorAll('tbody tr:first-child td')].map((cell) => Number(cell.textContent));
const told = () => document.querySelector('[role="status"]')?.textContent ?? '';

async function compare(): Promise<void> {
  document.querySelector<HTMLButtonElement>('button[type="submit"]')!.click();
  await vi.advanceTimersByTimeAsync(300);
  flushSync();
}

test('two layouts that were compared are shown no longer than they are what they were', async () => {
  const count = sensorsOf(FLAT).length;
  editor.select(['sensors/0']);
  editor.delete();
  await compare();
  expect([table(), told()]).toEqual([[count, count - 1], '']);
  editor.undo();
  flushSync();
  expect([table(), told()]).toEqual([[], 'The home has changed since this comparison. Compare again.']);
  await compare();
  expect([table(), told()]).toEqual([[count, count], '']);
  // The saved text is another layout, too.
  editor.redo();
  await compare();
  await drafts.save();
  flushSync();
  expect(table()).toEqual([]);
});
