import { decode, encode } from '@msgpack/msgpack';
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Live } from '../../live.svelte';
import { type Fetch, Server } from '../../server';
import { ROUTINE, fakeLives } from '../../testing/life';
import { frame } from '../../testing/frames';
import { madeUpRun } from '../../testing/home';
import { button, EVIL, expectText, fakeWire, write } from '../../testing/page';
import { Drafts } from '../../drafts.svelte';
import type { Month, PageCommand, WriteStatement } from '../../wire';
import { whereOf, withoutLines } from './life.svelte';
import LifeView from './Life.svelte';

let view: Record<string, unknown>;
let live: Live;
let said: PageCommand[];
let asked: { path: string; body: unknown }[];

async function settle(ms = 100): Promise<void> {
  await vi.advanceTimersByTimeAsync(ms);
  flushSync();
}

async function begin(fetch: Fetch = fakeLives()): Promise<void> {
  asked = [];
  const server = new Server('token', () => {}, (path, init) => {
    asked.push({ path, body: typeof init.body === 'string' ? JSON.parse(init.body) : null });
    return fetch(path, init);
  });
  live = new Live('token', () => {}, () => fakeWire());
  said = [];
  Object.assign(live, { server, drafts: new Drafts(server, (text, bad) => live.note(text, bad)), say: (say: PageCommand) => said.push(say) > 0, run: madeUpRun(), frame: frame({}) });
  view = mount(LifeView, { target: document.body, props: { live } });
  // The editor is imported, which a fake clock does not hasten.
  await vi.dynamicImportSettled();
  for (let turn = 0; turn < 12; turn++) await settle();
}

const region = (name: string) => document.querySelector<HTMLElement>(`[aria-label="${name}"]`)!;
const months = () => asked.filter(({ path }) => path === '/api/month').map(({ body }) => body as Month);
const editor = () => document.querySelector('.editor .editor')!.shadowRoot!;
const options = () => [...document.querySelectorAll('[role="option"]')].map((option) => option.textContent!);

function press(key: string, target: Element): void {
  target.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
  flushSync();
}

beforeEach(() => {
  vi.useFakeTimers();
  window.location.hash = '#/life';
});

afterEach(async () => {
  await unmount(view);
  vi.useRealTimers();
});

test('a routine is shown with how it was understood', async () => {
  await begin();
  expect(editor().textContent).toContain('she gets up at about 06:45');
  expect(region('Interpretation').textContent).toContain('she gets up at about 06:45');
  expect(region('Problems').textContent).toContain('Every sentence is understood.');
  expect(region('Conditions').textContent).toContain('Starts on day 9 (10 Mar 2009), moderate from day 15 (16 Mar 2009), and stays.');
});

test('what is wrong is underlined and told, and so is that the days are those of before', async () => {
  await begin();
  live.drafts.write('0.routine', ROUTINE.replace('gets up', 'wtches'));
  for (let turn = 0; turn < 12; turn++) await settle();
  expect(editor().querySelector('.cm-lintRange-error')!.textContent).toBe('wtches');
  expect(region('Interpretation').textContent).not.toContain('about 06:45');
  expect(region('Problems').textContent).toContain('1 problem');
  expect(region('Problems').textContent).toContain('did you mean "watches television"?');
  expect(region('Days').textContent).toContain('not understood. These days are from before the mistake.');
  expect(button('Go to line')).toBeTruthy();
  expect([button('Watch run').disabled, button('Run all days').disabled]).toEqual([true, true]);
  // A problem that is older than the text is grey, and its button is disabled.
  live.drafts.write('0.routine', `${ROUTINE.replace('gets up', 'wtches')}\n`);
  await settle(0);
  expect([button('Change to “watches television”').disabled, region('Problems').querySelector('ul')!.className]).toEqual([true, expect.stringContaining('old')]);
  for (let turn = 0; turn < 12; turn++) await settle();
  expect([button('Change to “watches television”').disabled, region('Problems').querySelector('ul')!.className]).toEqual([false, expect.not.stringContaining('old')]);
  live.drafts.write('0.routine', ROUTINE.replace('gets up', 'wtches'));
  for (let turn = 0; turn < 12; turn++) await settle();
  button('Change to “watches television”').click();
  flushSync();
  expect(live.drafts.text('0.routine')).toBe(ROUTINE.replace('gets up', 'watches television'));
  button('Undo: Change to').click();
  expect(live.drafts.text('0.routine')).toBe(ROUTINE.replace('gets up', 'wtches'));
});

test('a page that opens on a wrong line draws the days without it, and says which it is', async () => {
  const lines = ROUTINE.split('\n');
  const line = lines.findIndex((one) => one.includes('gets up')) + 1;
  await begin(fakeLives(['Agnes'], new Map([['0.routine', ROUTINE.replace('gets up', 'wtches')]])));
  expect(region('Days').textContent).toContain(`Line ${line}: not understood. These days are shown without it.`);
  expect(options().length).toBeGreaterThan(0);
  expect(months().at(-1)!.draft.texts['0.routine']!.split('\n')).toEqual(lines.with(line - 1, ''));
  expect(live.drafts.unsaved).toEqual([]);
});

test('lines that are wrong are left out only of routines, and are named', () => {
  const at = (file: string, line: number) => ({ file, line, column: 1, width: 1, what: '', hint: null });
  const text = (name: string) => (name === 'a.routine' ? 'one\ntwo\nthree' : undefined);
  expect(withoutLines({ texts: {} }, [at('a.routine', 2)], text)).toEqual({ texts: { 'a.routine': 'one\n\nthree' } });
  expect(withoutLines({ texts: { 'a.routine': 'eins\nzwei' } }, [at('a.routine', 1), at('a.routine', 2)], text)).toEqual({ texts: { 'a.routine': '\n' } });
  expect(withoutLines({ texts: {} }, [at('a.routine', 2), at('home.json', 2)], text)).toBeNull();
  expect(withoutLines({ texts: {} }, [at('a.routine', 0)], text)).toBeNull();
  expect([[3], [7, 3, 7], [1, 2, 3, 4, 5, 6]].map((lines) => whereOf(lines.map((line) => at('a.routine', line)), 'a.routine'))).toEqual(['Line 3', 'Lines 3 and 7', 'Lines 1, 2, 3 and 3 more']);
  expect(whereOf([at('a.routine', 1), at('home.json', 4)], 'a.routine')).toBe('a.routine, home.json');
});

test('where the days are not lived to their end, it is said until when', async () => {
  const cut = 'The days are shown up to 2026-01-05 09:00:50. The simulation stopped here after 5 seconds, because too much happens.';
  const whole = fakeLives();
  await begin(async (path, init) => {
    const answer = await whole(path, init);
    if (path !== '/api/month') return answer;
    return new Response(encode({ ...(decode(await answer.arrayBuffer()) as object), cut }) as BodyInit);
  });
  expect(region('Days').textContent).toContain(cut);
});

test('a day is chosen by keys and told as a table', async () => {
  await begin();
  const list = document.querySelector('[role="listbox"]')!;
  expect(options()).toHaveLength(28);
  expect(options()[6]).toContain('Clocks go forward by 1 h.');
  for (const key of ['ArrowDown', 'ArrowDown', 'Enter']) press(key, list);
  expect(region('Selected day').textContent).toContain('Wed, 4 March 2009');
  region('Selected day').querySelector('input')!.click();
  flushSync();
  expect(region('The day as a table').textContent).toContain('preparing breakfast');
  button('Next day').click();
  flushSync();
  expect(region('Selected day').textContent).toContain('Thu, 5 March 2009');
  press('Escape', list);
  expect(region('Selected day')).toBeNull();
});

test('a condition is left out, and both lives are compared', async () => {
  await begin();
  const before = options();
  [...document.querySelectorAll('label')].find((label) => label.textContent!.includes('depression'))!.querySelector('input')!.click();
  for (let turn = 0; turn < 8; turn++) await settle();
  expect(months().at(-1)!.without).toEqual(['depression']);
  expect(options()[20]).toMatch(/With all conditions: sleep 8 h.*Without depression: sleep 6 h 30 min/);
  expect(options()[20]).not.toBe(before[20]);
  button('Watch run').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  // A refused run plays no other.
  expect(said).toEqual([{ say: 'start', driven: null, options: { without: ['depression'] } }]);
  live['hear']({ tell: 'note', text: 'it is wrong', bad: true });
  await settle();
  expect([said.length, window.location.hash]).toEqual([1, '#/life']);
  button('Watch run').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  live['hear']({ tell: 'unbegun', why: 'No routine shows depression.', problems: [], option: 'without' });
  await settle();
  expect([said.length, document.querySelector('.generate [role="alert"]')!.textContent]).toEqual([2, 'No routine shows depression.']);
  said.length = 0;
  button('Watch run').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  live['hear']({ tell: 'run', run: madeUpRun() });
  await settle();
  expect(said).toEqual([{ say: 'start', driven: null, options: { without: ['depression'] } }, { say: 'speed', times: 100 }, { say: 'play' }]);
  expect(window.location.hash).toBe('#/live');
});

test('other days are asked for, and never beyond the last', async () => {
  await begin();
  const field = [...document.querySelectorAll('label')].find((label) => label.textContent!.startsWith('From day'))!.querySelector('input')!;
  write(field, '999', 'change');
  for (let turn = 0; turn < 8; turn++) await settle();
  expect(months().at(-1)!.from).toBe(29);
  expect(field.value).toBe('30');
});

test('a condition is added as a sentence', async () => {
  const files = new Map([['0.routine', ROUTINE]]);
  await begin(fakeLives(['Agnes'], files));
  region('Conditions').querySelector('button')!.click();
  flushSync();
  document.querySelector<HTMLFormElement>('form')!.dispatchEvent(new SubmitEvent('submit', { bubbles: true, cancelable: true }));
  for (let turn = 0; turn < 5; turn++) await settle();
  expect(live.drafts.text('0.routine')).toBe(`${ROUTINE}From week 6, over 4 weeks, she shows moderate grief.\n`);
  expect(editor().textContent).toContain('moderate grief');
  await live.drafts.save();
  expect(files.get('0.routine')).toContain('moderate grief');
});

test('where all of it has been lived it can be played back', async () => {
  await begin();
  const told = () => document.querySelector('.generate')!.textContent!;
  live.frame = frame({ state: 'paused', now_us: 86_400_000_000 });
  flushSync();
  expect(told()).toContain('Both stop cottage-1 at day 2 of 31');
  expect(button('Run all days').title).toContain('cottage-1 stops at day 2 of 31 and stays in Playback');
  live.frame = frame({});
  flushSync();
  expect(told()).not.toContain('Both stop');
  button('Run all days').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  live['hear']({ tell: 'run', run: madeUpRun() });
  await settle();
  expect(said[1]).toEqual({ say: 'speed', times: null });
  live.frame = frame({ state: 'playing', speed: null, now_us: 86_400_000_000 });
  flushSync();
  expect(document.querySelector('.generate')!.textContent).toContain('day 2 of 31');
  live.stored = live.run!.id;
  live.frame = frame({ state: 'over', speed: null });
  flushSync();
  expect(document.querySelector<HTMLAnchorElement>('.generate a')!.hash).toBe('#/playback/cottage-1');
});

test('another resident is chosen', async () => {
  await begin(fakeLives(['Agnes', 'Bertram']));
  window.location.hash = '#/life/Bertram';
  window.dispatchEvent(new Event('hashchange'));
  for (let turn = 0; turn < 12; turn++) await settle();
  expect(editor().textContent).toContain('Bertram is 82.');
});

test('nobody who lives by a routine, and a routine that is not there', async () => {
  await begin(fakeLives([]));
  expect(document.body.textContent).toContain('No resident has a routine');
  await unmount(view);
  await begin(fakeLives(['Agnes'], new Map()));
  expect(document.body.textContent).toContain('Cannot read the routine');
  expect(document.body.textContent).toContain('0.routine is missing');
});

/** The field of a label in the form of a statement. */
const fieldIn = (label: string) => [...document.querySelectorAll<HTMLLabelElement>('dialog[open] label')].find((one) => one.textContent!.trim().startsWith(label))!.control as HTMLInputElement;

async function filled(field: HTMLInputElement, value: string): Promise<void> {
  write(field, value);
  for (let turn = 0; turn < 6; turn++) await settle();
}

test('a statement is added by its form, and its problems stand in the way', async () => {
  await begin();
  button('Add a statement').click();
  await settle();
  const dialog = document.querySelector('dialog[open]')!;
  await filled(fieldIn('Activity'), 'juggles');
  expect(dialog.textContent).toContain('nobody juggles');
  expect(dialog.textContent).toContain('choose another activity');
  expect(button('Insert').disabled).toBe(true);
  await filled(fieldIn('Activity'), 'knits');
  await filled(fieldIn('Place'), 'bed');
  expect(dialog.querySelector('[aria-label="Sentence"]')!.textContent).toContain('She knits in the bed.');
  expect(live.drafts.text('0.routine')).toBe(ROUTINE);
  button('Insert').click();
  for (let turn = 0; turn < 4; turn++) await settle();
  expect(document.querySelector('dialog[open]')).toBeNull();
  expect(live.drafts.text('0.routine')).toBe(ROUTINE.replace('\n', '\nShe knits in the bed.\n'));
});

test('the sentence at the cursor is edited by its form, and a line without one has none', async () => {
  await begin();
  button('Edit as a form').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  expect(document.body.textContent).toContain('Line 1 has no sentence that is understood.');
  await unmount(view);
  const text = 'she reads for 1 hour\n';
  await begin(fakeLives(['Agnes'], new Map([['0.routine', text]])));
  button('Edit as a form').click();
  for (let turn = 0; turn < 6; turn++) await settle();
  await filled(fieldIn('Activity'), 'sings');
  button('Replace').click();
  for (let turn = 0; turn < 4; turn++) await settle();
  expect(live.drafts.text('0.routine')).toBe('She sings.\n');
});

test('the form asks about the text in the editor, with the statement as it was opened', async () => {
  const text = 'she reads for 1 hour\n';
  const files = new Map([['0.routine', text]]);
  await begin(fakeLives(['Agnes'], files));
  button('Edit as a form').click();
  for (let turn = 0; turn < 6; turn++) await settle();
  // Another program changes the file, and the page has not seen it yet.
  files.set('0.routine', `she sings for 1 hour\n${text}`);
  write(fieldIn('Place'), 'bed');
  for (let turn = 0; turn < 4; turn++) await settle();
  const requests = asked.filter(({ path }) => path === '/api/statement').map(({ body }) => body as WriteStatement);
  const { draft, instead } = requests.find(({ statement }) => statement.place === 'bed')!;
  expect(draft.texts['0.routine']).toBe(text);
  expect(instead).toEqual({ number: 0, statement: { kind: 'habit', activity: 'reads', when: {} } });
});

test('a wrong text stays in its field, is named, and stands in the way', async () => {
  await begin();
  button('Add a statement').click();
  await settle();
  const dialog = document.querySelector('dialog[open]')!;
  const at = dialog.querySelector<HTMLInputElement>('[aria-label="Time of day: at"]')!;
  await filled(at, '25:00');
  at.dispatchEvent(new Event('blur'));
  await settle();
  expect([at.value, button('Insert').disabled]).toEqual(['25:00', true]);
  expect(dialog.textContent).toContain('Write a time such as 14:30.');
  const requests = asked.length;
  await filled(at, '09:00');
  at.dispatchEvent(new Event('blur'));
  for (let turn = 0; turn < 6; turn++) await settle();
  expect(asked.length).toBeGreaterThan(requests);
  expect([at.value, button('Insert').disabled]).toEqual(['09:00', false]);
  // A text that is too long is not cut.
  await filled(fieldIn('Place'), 'b'.repeat(10_000));
  expect(dialog.textContent).toContain('Write at most 1,000 characters.');
  expect([fieldIn('Place').value.length, button('Insert').disabled]).toEqual([10_000, true]);
});

/** Answers of the fake server that the test holds back or lets fail. */
function withAnswers(of: { fails: boolean; waits: Promise<void> | null }): Fetch {
  const fetch = fakeLives();
  return async (path, init) => {
    if (path !== '/api/statement') return fetch(path, init);
    if (of.fails) throw new TypeError('offline');
    await of.waits;
    return fetch(path, init);
  };
}

test('an answer that comes after the form was closed writes nothing, and the form is there again as it was left', async () => {
  let answer = () => {};
  const of = { fails: false, waits: new Promise<void>((done) => (answer = done)) };
  await begin(withAnswers(of));
  button('Add a statement').click();
  await settle();
  write(fieldIn('Activity'), 'knits');
  button('Insert').click();
  await settle();
  document.querySelector<HTMLDialogElement>('dialog[open]')!.close();
  answer();
  for (let turn = 0; turn < 6; turn++) await settle();
  expect(live.drafts.text('0.routine')).toBe(ROUTINE);
  button('Add a statement').click();
  for (let turn = 0; turn < 6; turn++) await settle();
  expect(fieldIn('Activity').value).toBe('knits');
  expect(live.drafts.text('0.routine')).toBe(ROUTINE);
  button('Start anew').click();
  await settle();
  expect(fieldIn('Activity').value).toBe('reads');
  button('Cancel').click();
});

test('without the server, a press of Insert shows the failure and inserts nothing later', async () => {
  const of = { fails: true, waits: null };
  await begin(withAnswers(of));
  button('Add a statement').click();
  for (let turn = 0; turn < 6; turn++) await settle();
  button('Insert').click();
  for (let turn = 0; turn < 6; turn++) await settle();
  const dialog = document.querySelector('dialog[open]')!;
  expect(dialog.querySelector('[role="alert"]')).not.toBeNull();
  expect(dialog.querySelector('[role="status"]')!.textContent).toBe('');
  of.fails = false;
  await filled(fieldIn('Activity'), 'knits');
  expect(live.drafts.text('0.routine')).toBe(ROUTINE);
  button('Insert').click();
  for (let turn = 0; turn < 4; turn++) await settle();
  expect(live.drafts.text('0.routine')).toContain('She knits.');
});

test('the form is not offered for a routine in another language', async () => {
  await begin(fakeLives(['Agnes'], new Map([['0.routine', 'Sprache: Deutsch\n']])));
  expect(document.body.textContent).toContain('The form writes English sentences only.');
  expect(button('Add a statement').disabled).toBe(true);
});

test('hostile names are text', async () => {
  const long = `${EVIL}${'x'.repeat(4000)}`;
  await begin(fakeLives([EVIL, long], new Map([['0.routine', `${EVIL} is 82.\n\u202e# ${long}\n`], ['1.routine', '']])));
  press('Enter', document.querySelector('[role="listbox"]')!);
  expectText(EVIL);
});
