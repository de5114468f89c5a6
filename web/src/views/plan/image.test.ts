import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Drafts } from '../../drafts.svelte';
import { Server } from '../../server';
import { FakeFiles } from '../../testing/files';
import { FLAT } from '../../testing/flat';
import { FakeStore } from '../../testing/store';
import { Viewport } from './viewport.svelte';
import { Editor } from './editor.svelte';
import Image from './Image.svelte';
import { click, promptOf } from './tools';
import { Underlay } from './underlay.svelte';

let editor: Editor;
let underlay: Underlay;
let view: Record<string, unknown>;
let stop: () => void;

const picture = (name: string) => new File(['a picture'], name, { type: 'image/png' });

beforeEach(async () => {
  vi.useFakeTimers();
  vi.stubGlobal('indexedDB', new FakeStore());
  vi.stubGlobal('Image', class { naturalWidth = 100; naturalHeight = 100; src = ''; decode = () => Promise.resolve(); });
  const files = new FakeFiles({ 'home.json': FLAT, 'scenario.json': '{}' }, { home: 'home.json', logger: null, lives: [] });
  const drafts = new Drafts(new Server('token', () => {}, files.fetch), () => {});
  stop = drafts.open();
  await vi.advanceTimersByTimeAsync(10);
  editor = new Editor(drafts);
  editor.notice();
  underlay = new Underlay({ json: <T>() => Promise.resolve(null as T), file: () => Promise.reject(new Error('no picture')) });
  editor.underlay = underlay;
  await underlay.choose(picture('plan.png'), [5, 5], [10, 10]);
  view = mount(Image, { target: document.body, props: { underlay, editor, viewport: new Viewport() } });
  flushSync();
});

afterEach(async () => {
  await unmount(view);
  stop();
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

const field = (label: string) => document.querySelector<HTMLInputElement>(`[aria-label="${label}"]`)!;

function type(label: string, typed: string): void {
  field(label).value = typed;
  field(label).dispatchEvent(new Event('change', { bubbles: true }));
  flushSync();
}

test('after two points a number goes to how far apart they are, and what came of it is undone', () => {
  editor.hold({ tool: 'scale' });
  click(editor, editor.home!, [1, 5], null);
  flushSync();
  expect([field('Real distance'), promptOf(editor)]).toEqual([null, 'Click two points of the image with a known distance.']);
  click(editor, editor.home!, [5, 5], null);
  flushSync();
  expect(document.activeElement).toBe(field('Real distance'));
  expect(promptOf(editor)).toBe('Type the real distance of the two points under Image.');
  type('Real distance', '8');
  expect([underlay.lies.width_m, underlay.lies.at, editor.tool.tool, editor.canUndo]).toEqual([20, [9, 5], 'select', true]);
  expect(document.activeElement!.textContent).toBe('Set scale with two points');
  const { text } = editor;
  void underlay.lie({ opacity: 0.9 });
  editor.undo();
  expect(underlay.lies).toEqual({ at: [5, 5], width_m: 10, turn_deg: 0, opacity: 0.9 });
  editor.redo();
  expect([underlay.lies.width_m, editor.text, editor.canRedo]).toEqual([20, text, false]);
});

test('two points that are the same scale nothing: two others are asked for', () => {
  editor.hold({ tool: 'scale' });
  for (let twice = 0; twice < 2; twice++) click(editor, editor.home!, [1, 5], null);
  flushSync();
  type('Real distance', '8');
  expect([underlay.lies.width_m, editor.canUndo, editor.tool.tool, editor.drawn]).toEqual([10, false, 'scale', []]);
  expect(editor.said).toBe('Both points are the same. Click two different points.');
});

test('numbers of the image are steps beside those of the home, and another image is left where it lies', async () => {
  type('Rotation of the image', '90');
  editor.add('places', { name: 'here', at: [1, 1] });
  type('Width of the image', '12');
  type('Width of the image', '12');
  editor.undo();
  expect([underlay.lies.width_m, underlay.lies.turn_deg, editor.text!.includes('"here"')]).toEqual([10, 90, true]);
  editor.undo();
  expect([underlay.lies.turn_deg, editor.text!.includes('"here"')]).toEqual([90, false]);
  await underlay.choose(picture('other.png'), [1, 1], [4, 4]);
  editor.undo();
  expect([underlay.lies.width_m, underlay.lies.turn_deg, editor.canUndo]).toEqual([4, 0, false]);
});
