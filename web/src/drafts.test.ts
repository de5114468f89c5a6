import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Drafts } from './drafts.svelte';
import { Server } from './server';
import type { FileView, Save, SavedView } from './wire';

/** A disk with two files that others change, too. */
class Disk {
  files: Record<string, string> = { 'home.json': '{}', 'a.routine': 'She reads.' };
  notes: string[] = [];
  saves: Save[] = [];
  /** Answers wait in `held` until they are released. */
  slow = false;
  held: (() => void)[] = [];
  /** The files cannot be read. */
  broken = false;
  readonly server = new Server('token', () => {}, (path, init) => {
    const answer = this.answer(path, init);
    return this.slow && path === '/api/files' ? new Promise((done) => this.held.push(() => done(answer))) : Promise.resolve(answer);
  });
  readonly drafts = new Drafts(this.server, (text) => this.notes.push(text));

  view(name: string): FileView {
    const text = this.files[name];
    return text === undefined ? { name, text: '', version: '' } : { name, text, version: `v-${text}` };
  }

  private answer(path: string, init: RequestInit): Response {
    const json = (value: unknown) => new Response(JSON.stringify(value));
    if (path === '/api/files/versions') return json(Object.fromEntries(Object.keys(this.files).map((name) => [name, this.view(name).version])));
    if (this.broken && path === '/api/files' && init.method === 'GET') return new Response('The disk is busy.', { status: 500 });
    if (path === '/api/check') return json({ problems: [], warnings: [] });
    if (init.method === 'POST') return json(this.save(JSON.parse(init.body as string) as Save));
    return json({ entry: 'scenario.json', home: 'home.json', logger: 'logger.json' in this.files ? 'logger.json' : null, lives: [], files: Object.keys(this.files).map((name) => this.view(name)) });
  }

  private save(save: Save): SavedView {
    this.saves.push(save);
    const changed = save.files.filter(({ name, version }) => (version ?? '') !== this.view(name).version).map(({ name }) => this.view(name));
    if (changed.length > 0) return { saved: {}, changed };
    for (const { name, text } of save.files) this.files[name] = text;
    return { saved: Object.fromEntries(save.files.map(({ name }) => [name, this.view(name).version])), changed: [] };
  }
}

let disk: Disk;
let drafts: Drafts;
let stop: () => void;
const later = () => vi.advanceTimersByTimeAsync(2500);

beforeEach(async () => {
  vi.useFakeTimers();
  disk = new Disk();
  drafts = disk.drafts;
  stop = drafts.open();
  await later();
});
afterEach(() => {
  stop();
  vi.useRealTimers();
});

test('a draft is what differs from the disk, and saving it makes it the disk’s', async () => {
  drafts.write('a.routine', 'She naps.');
  expect([drafts.text('a.routine'), drafts.unsaved]).toEqual(['She naps.', ['a.routine']]);
  drafts.write('a.routine', 'She reads.');
  expect(drafts.unsaved).toEqual([]);
  drafts.write('a.routine', 'She knits.');
  drafts.write('new.json', '{}');
  expect(await drafts.save()).toBe(true);
  expect(disk.files).toEqual({ 'home.json': '{}', 'a.routine': 'She knits.', 'new.json': '{}' });
  expect(drafts.unsaved).toEqual([]);
  expect(await drafts.save()).toBe(true);
  expect(disk.saves.length, 'nothing to save is not sent').toBe(1);
});

test('what another program changes is taken where nothing was written here', async () => {
  drafts.write('home.json', '{ }');
  disk.files['a.routine'] = 'She paces.';
  await later();
  expect(drafts.text('a.routine')).toBe('She paces.');
  expect([drafts.text('home.json'), drafts.changed]).toEqual(['{ }', []]);
});

test('what is written here and changed there is asked about before it is replaced', async () => {
  drafts.write('a.routine', 'Mine.');
  disk.files['a.routine'] = 'Theirs.';
  await later();
  expect(drafts.changed.map(({ text }) => text)).toEqual(['Theirs.']);
  expect(await drafts.save()).toBe(false);
  expect(disk.files['a.routine']).toBe('Theirs.');
  drafts.keepDraft('a.routine');
  // Known versions are not requested again, but later ones are.
  await later();
  expect(drafts.changed).toEqual([]);
  disk.files['a.routine'] = 'Theirs again.';
  expect(await drafts.save()).toBe(false);
  expect(drafts.changed.map(({ text }) => text)).toEqual(['Theirs again.']);
  drafts.discard('a.routine');
  expect([drafts.text('a.routine'), drafts.unsaved, drafts.changed]).toEqual(['Theirs again.', [], []]);
});

test('a file that has gone is let go or made again', async () => {
  drafts.write('a.routine', 'Mine.');
  delete disk.files['a.routine'];
  await later();
  expect(drafts.changed).toEqual([{ name: 'a.routine', text: '', version: '' }]);
  expect(drafts.text('a.routine')).toBe('Mine.');
  drafts.keepDraft('a.routine');
  await later();
  expect([drafts.changed, drafts.text('a.routine')]).toEqual([[], 'Mine.']);
  expect(await drafts.save()).toBe(true);
  expect(disk.files['a.routine']).toBe('Mine.');

  drafts.write('a.routine', 'Mine again.');
  delete disk.files['a.routine'];
  await later();
  drafts.discard('a.routine');
  await later();
  expect([drafts.text('a.routine'), drafts.unsaved, drafts.changed]).toEqual([undefined, [], []]);
});

test('a change that comes to the same as the draft is no change', async () => {
  drafts.write('a.routine', 'Both.');
  disk.files['a.routine'] = 'Both.';
  await later();
  expect([drafts.changed, drafts.unsaved]).toEqual([[], []]);
});

test('a file that another program makes meanwhile is asked about before it is replaced', async () => {
  drafts.write('new.json', 'Mine.');
  await later();
  expect(drafts.changed).toEqual([]);
  disk.files['new.json'] = 'Theirs.';
  await later();
  expect(drafts.changed.map(({ text }) => text)).toEqual(['Theirs.']);
  expect(await drafts.save()).toBe(false);
  expect(disk.files['new.json']).toBe('Theirs.');
  drafts.keepDraft('new.json');
  expect(await drafts.save()).toBe(true);
  expect(disk.files['new.json']).toBe('Mine.');
});

test('what was loaded before a save does not come after it', async () => {
  disk.slow = true;
  disk.files['home.json'] = '{ }';
  await vi.advanceTimersByTimeAsync(2000);
  disk.slow = false;
  drafts.write('a.routine', 'Mine.');
  expect(await drafts.save()).toBe(true);
  // The answer from before the save arrives.
  for (const answer of disk.held.splice(0)) answer();
  await vi.advanceTimersByTimeAsync(0);
  expect([drafts.text('a.routine'), drafts.unsaved]).toEqual(['Mine.', []]);
});

test('what is saved is saved though it cannot be loaded at once, and is loaded later', async () => {
  drafts.write('logger.json', '{}');
  disk.broken = true;
  expect(await drafts.save()).toBe(true);
  expect([drafts.unsaved, disk.notes, drafts.saving]).toEqual([[], [], false]);
  await later();
  disk.broken = false;
  await later();
  expect(drafts.files!.logger).toBe('logger.json');
});

test('what was written outlives a server that begins anew', async () => {
  drafts.write('a.routine', 'Mine.');
  const next = new Disk();
  const notes: string[] = [];
  drafts.reconnect(next.server, (text) => notes.push(text));
  await later();
  expect(await drafts.save()).toBe(true);
  expect([next.files['a.routine'], disk.files['a.routine'], notes]).toEqual(['Mine.', 'She reads.', []]);
});

test('a home is gone once none of its files is on the disk, also where drafts of some are here still', async () => {
  expect(drafts.isDeleted).toBe(false);
  drafts.write('home.json', '{ "rooms": [] }');
  const { 'a.routine': routine } = disk.files;
  disk.files = { 'a.routine': routine! };
  await later();
  expect(drafts.isDeleted).toBe(false);
  disk.files = {};
  await later();
  expect(drafts.isDeleted).toBe(true);
  drafts.discard('home.json');
  expect(drafts.isDeleted).toBe(true);
  disk.files = { 'a.routine': routine! };
  await later();
  expect(drafts.isDeleted).toBe(false);
});

test('the files of a home that is gone are written back, with what was written since', async () => {
  const whole = { ...disk.files };
  drafts.write('home.json', '{ "rooms": [] }');
  disk.files = {};
  await later();
  expect([drafts.isDeleted, drafts.kept]).toEqual([true, Object.keys(whole).length]);
  await drafts.writeBack();
  await later();
  expect(disk.files).toEqual({ ...whole, 'home.json': '{ "rooms": [] }' });
  expect([drafts.isDeleted, drafts.unsaved, drafts.changed, disk.notes]).toEqual([false, [], [], []]);
});
