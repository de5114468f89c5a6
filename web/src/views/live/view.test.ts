import { encode } from '@msgpack/msgpack';
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Live } from '../../live.svelte';
import type { Wire } from '../../socket';
import { firing, frame } from '../../testing/frames';
import { date } from '../../testing/dates';
import { madeUpRun } from '../../testing/home';
import { button, EVIL, expectText, fakeWire, fieldOf, write } from '../../testing/page';
import type { RunFrame, RunView } from '../../wire';
import LiveView from './Live.svelte';

let sent: { say: string }[];
let wire: Wire;
let live: Live;
let view: Record<string, unknown>;

function begin(run: RunView): void {
  sent = [];
  wire = fakeWire((text) => sent.push(JSON.parse(text)));
  live = new Live('token', () => {}, () => wire);
  live.open();
  wire.onopen!();
  wire.onmessage!({ data: JSON.stringify({ tell: 'run', run }) });
  view = mount(LiveView, { target: document.body, props: { live } });
  show({});
  sent.length = 0;
}

function show(part: Partial<RunFrame>): void {
  vi.advanceTimersByTime(500);
  wire.onmessage!({ data: encode(frame({ bodies: live.run!.residents.map(() => ({ at: [6.1, 3.9], heading_deg: 0, posture: 'standing', room: 3, activity: 'walking' })), ...part })) });
  vi.advanceTimersByTime(500);
  flushSync();
}

function key(type: 'keydown' | 'keyup', code: string, target: Element | null = document.activeElement): KeyboardEvent {
  const event = new KeyboardEvent(type, { code, key: code === 'Space' ? ' ' : code, bubbles: true, cancelable: true });
  (target ?? document.body).dispatchEvent(event);
  flushSync();
  return event;
}

const plan = () => document.querySelector<HTMLElement>('[role="application"]')!;

beforeEach(() => {
  // The page asks a missing server about saved files.
  vi.stubGlobal('fetch', () => Promise.reject(new TypeError('no server')));
  vi.useFakeTimers();
  begin(madeUpRun(2, 18, 0));
});

afterEach(async () => {
  await unmount(view);
  live.close();
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

test('what is recorded is known to go on until it is over, and a replay records nothing', () => {
  const folder = live.run!.id;
  expect(folder).not.toBeNull();
  show({ state: 'paused' });
  expect(live.ongoing).toBe(folder);
  show({ state: 'over' });
  expect(live.ongoing).toBeNull();
  wire.onmessage!({ data: JSON.stringify({ tell: 'run', run: { ...live.run, replay: true } }) });
  show({});
  expect(live.ongoing).toBeNull();
});

test('keys walk after any button of the panel, and not while something is written or chosen', () => {
  for (const at of [button('Sit'), button('10×')]) {
    at.focus();
    key('keydown', 'KeyW');
    key('keyup', 'KeyW');
    expect(sent.splice(0)).toEqual([{ say: 'hold', keys: ['up'] }, { say: 'hold', keys: [] }]);
  }
  for (const at of ['#walks', 'input[type="datetime-local"]', 'input[type="range"]']) {
    document.querySelector<HTMLElement>(at)!.focus();
    key('keydown', 'KeyW');
    expect(sent).toEqual([]);
  }
  void unmount(view);
  begin(madeUpRun(2, 18, null));
  key('keydown', 'KeyW', document.body);
  expect(sent).toEqual([]);
});

test('without a run it is said what is wrong, and a run is begun once that is mended', () => {
  void unmount(view);
  live.close();
  live = new Live('token', () => {}, () => wire);
  live.open();
  wire.onopen!();
  view = mount(LiveView, { target: document.body, props: { live } });
  const problem = { file: 'logger.json', line: 5, column: 3, width: 4, what: 'there is no sensor "hall motion"', hint: null };
  const unbegun = { tell: 'unbegun', why: 'Cannot start a run: the scenario has a problem.', problems: [problem] };
  wire.onmessage!({ data: JSON.stringify(unbegun) });
  flushSync();
  const card = () => document.querySelector('[aria-label="No run"]')!;
  expect(card().textContent).toContain('Cannot start a run');
  expect(card().textContent).toContain('there is no sensor');
  live.drafts.check = { problems: [], warnings: [] };
  flushSync();
  expect(card().textContent).toContain('All problems are fixed.');
  wire.onmessage!({ data: JSON.stringify({ tell: 'run', run: madeUpRun(2, 18, 0) }) });
  flushSync();
  expect(card()).toBeNull();
  show({});
  // It is also shown next to a run that continues, until the user closes it.
  wire.onmessage!({ data: JSON.stringify(unbegun) });
  flushSync();
  expect(plan()).not.toBeNull();
  button('Dismiss').click();
  flushSync();
  expect(card()).toBeNull();
});

test('what has been saved since the run began is told, and a run is begun anew on request', () => {
  void unmount(view);
  begin({ ...madeUpRun(2, 18, null), files: { 'home.json': 'old', 'logger.json': 'same', 'gone.json': 'x' } });
  const said = () => document.querySelector('[aria-label="Run"]')!.textContent!.replace(/\s+/g, ' ');
  const files = (home: string) => {
    const file = (name: string, version: string) => ({ name, version, text: '' });
    live.drafts.files = { entry: 'scenario.json', home: 'home.json', logger: null, lives: [], files: [file('home.json', home), file('logger.json', 'same')] };
    flushSync();
  };
  files('old');
  expect(said()).not.toContain('since this run began');
  files('new');
  expect(said()).toContain('home.json has been saved since this run started. The run still uses the old version.');
  button('New run').click();
  expect(sent).toEqual([{ say: 'start', driven: null, options: { without: [] } }]);
});

test('of a home whose files are gone it is said that they are, with a run and without one, and no more once they are back', () => {
  const said = () => document.querySelector('.gone')?.textContent!.replace(/\s+/g, ' ') ?? '';
  const files = (...names: string[]) => {
    live.drafts.files = { entry: 'scenario.json', home: 'home.json', logger: null, lives: [], files: names.map((name) => ({ name, version: 'v', text: '' })) };
    flushSync();
  };
  expect(said()).toBe('');
  files('home.json');
  expect(said()).toBe('');
  files();
  expect(said()).toContain('The files of this home are no longer');
  expect(said()).toContain('The current run continues, but no new run can start.');
  show({ state: 'over' });
  expect(said()).not.toContain('goes on, but');
  live.run = null;
  flushSync();
  expect(said()).toContain('The files of this home are no longer');
  files('home.json');
  expect(said()).toBe('');
});

test('a stove is turned on and a wardrobe opened, and who is out finds the door', () => {
  const things = live.run!.home.things;
  expect(things.length).toBeGreaterThan(0);
  const verbs = new Set([...document.querySelectorAll('[aria-label="Within reach"] button')].map((one) => one.textContent!.trim()));
  for (const verb of verbs) expect(['Open', 'Close', 'Turn on', 'Turn off', 'Use', 'Stop using']).toContain(verb);
  const near = live.run!.home.doors.find(({ outside }) => outside)!;
  const at = things.find(({ name }) => name === near.name)!.at;
  show({ bodies: [{ at, heading_deg: 0, posture: 'standing', room: null, activity: null }, null] });
  show({ bodies: [null, null] });
  const reach = () => document.querySelector('[aria-label="Within reach"]')!.textContent!;
  expect(reach()).toContain(near.name);
});

test('of who is out of the home the table of people says so', () => {
  show({ now_us: 60e6 });
  show({ now_us: 120e6, bodies: [null, null] });
  const rows = [...document.querySelectorAll('.people tbody tr')].map((row) => [...row.querySelectorAll('td')].map((cell) => cell.textContent!.trim()));
  expect(rows).toEqual([['out', '', 'away'], ['out', '', 'away']]);
});

test('the menu of what is kept closes by Escape, by a press elsewhere and once something is chosen', () => {
  const menu = document.querySelector<HTMLDetailsElement>('details.menu')!;
  const summary = menu.querySelector('summary')!;
  const press = (at: Element) => at.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true }));
  const open = () => {
    menu.open = true;
    button('Image (PNG)').focus();
  };
  open();
  press(button('Image (PNG)'));
  expect(menu.open).toBe(true);
  key('keydown', 'Enter');
  expect(menu.open).toBe(true);
  key('keydown', 'Escape');
  expect([menu.open, document.activeElement]).toEqual([false, summary]);
  open();
  press(button('10×'));
  expect(menu.open).toBe(false);
  open();
  button('Table (CSV)').click();
  expect([menu.open, document.activeElement]).toEqual([false, summary]);
  plan().focus();
  key('keydown', 'Escape');
  expect(document.activeElement).toBe(plan());
});

test('keys of the plan are its own', () => {
  plan().focus();
  const event = key('keydown', 'KeyW');
  key('keydown', 'KeyW');
  key('keyup', 'KeyW');
  expect(sent).toEqual([{ say: 'hold', keys: ['up'] }, { say: 'hold', keys: [] }]);
  expect(event.defaultPrevented).toBe(true);
  expect(key('keydown', 'Tab').defaultPrevented).toBe(false);
});

test('leaving the plan, the window or the page lets go of all keys', () => {
  for (const leave of [
    () => plan().blur(),
    () => window.dispatchEvent(new Event('blur')),
    () => {
      vi.spyOn(document, 'hidden', 'get').mockReturnValueOnce(true);
      document.dispatchEvent(new Event('visibilitychange'));
    },
    () => document.querySelector('canvas')!.dispatchEvent(new Event('pointercancel')),
  ]) {
    plan().focus();
    key('keydown', 'ArrowLeft');
    sent.length = 0;
    leave();
    expect(sent).toEqual([{ say: 'hold', keys: [] }]);
  }
});

test('where nobody is moved by keys, they move the plan and nobody', () => {
  void unmount(view);
  begin(madeUpRun(1, 3, null));
  plan().focus();
  key('keydown', 'KeyW');
  key('keydown', 'ArrowUp');
  expect(sent).toEqual([]);
});

test('a button of the pad is held by a finger, by Enter and by Space, and Space does not pause then', () => {
  const up = button('Walk up');
  up.setPointerCapture = () => {};
  up.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true }));
  up.dispatchEvent(new PointerEvent('pointerup', { bubbles: true }));
  up.focus();
  key('keydown', 'Space');
  key('keyup', 'Space');
  const [down, let_go] = [{ say: 'hold', keys: ['up'] }, { say: 'hold', keys: [] }];
  expect(sent).toEqual([down, let_go, down, let_go]);
});

test('Space plays and pauses, and does nothing to a field', () => {
  key('keydown', 'Space', document.body);
  show({ state: 'paused' });
  plan().focus();
  key('keydown', 'Space');
  expect(sent).toEqual([{ say: 'pause' }, { say: 'play' }]);
  document.querySelector<HTMLElement>('input[type="range"]')!.focus();
  key('keydown', 'Space');
  expect(sent).toHaveLength(2);
});

test('controls say what they are for', () => {
  button('Step 1 s').click();
  button('100×').click();
  button('As fast').click();
  button('Sit').click();
  button('Stop').click();
  expect(sent).toEqual([
    { say: 'step', seconds: 1 },
    { say: 'speed', times: 100 },
    { say: 'speed', times: null },
    { say: 'be', posture: 'sitting' },
    { say: 'stop' },
  ]);
});

test('a run leads to Care once it has a day', () => {
  const link = () => document.querySelector('a[href^="#/care"]')?.getAttribute('href');
  show({ now_us: 3_600_000_000 });
  expect(link()).toBeUndefined();
  show({ now_us: 30 * 3_600_000_000 });
  expect(link()).toBe(`#/care/${live.run!.id}`);
});

test('a run begins with whom was chosen, and one that was stopped can be lived again', () => {
  const who = document.querySelector<HTMLSelectElement>('#walks')!;
  write(who, '1', 'change');
  expect(button('Replay').disabled).toBe(true);
  button('New run').click();
  show({ state: 'over' });
  button('Replay').click();
  expect(sent).toEqual([{ say: 'start', driven: 1, options: { without: [] } }, { say: 'replay', run: 'cottage-1' }]);
});

test('what is chosen for the next run, and what is not saved yet, is said to wait', () => {
  const said = () => document.querySelector('[aria-label="Run"]')!.textContent!.replace(/\s+/g, ' ');
  expect(said()).not.toContain('Applies to');
  const who = document.querySelector<HTMLSelectElement>('#walks')!;
  write(who, '1', 'change');
  expect(said()).toContain('Applies to the next run');
  expect(said()).not.toContain('not saved');
  live.drafts.write('home.json', '{}');
  flushSync();
  expect(said()).toContain('home.json is not saved. A new run uses the version on disk.');
});

test('what becomes of the run that goes on is said, and what went wrong stays until it is read', () => {
  const said = () => document.querySelector('[aria-label="Run"]')!.textContent!.replace(/\s+/g, ' ');
  expect(said()).not.toContain('A new run stops');
  show({ now_us: 3_600e6 });
  expect(said()).toContain(`A new run stops ${live.run!.id}, which stays in Playback.`);
  expect(button('New run').title).toContain('which stays in Playback');
  live.note('The disk is full.', true);
  live.note('All is well.', false);
  vi.advanceTimersByTime(3_600_000);
  expect(live.notes.map(({ text }) => text)).toEqual(['The disk is full.']);
  live.dismiss(live.notes[0]!.id);
  expect(live.notes).toEqual([]);
});

test('what is chosen for the next run stays when the run is told of again', () => {
  void unmount(view);
  const run = { ...madeUpRun(2, 18, null), conditions: ['depression', 'frailty'], id: null };
  begin(run);
  const tell = (part: Partial<RunView>) => {
    wire.onmessage!({ data: JSON.stringify({ tell: 'run', run: { ...run, ...part } }) });
    show({});
  };
  const who = document.querySelector<HTMLSelectElement>('#walks')!;
  write(who, '1', 'change');
  document.querySelector<HTMLInputElement>('fieldset input')!.click();
  flushSync();
  tell({ id: 'cottage-1' });
  expect(who.value).toBe('1');
  button('New run').click();
  expect(sent).toEqual([{ say: 'start', driven: 1, options: { without: ['depression'] } }]);
  tell({ driven: 0, without: ['frailty'] });
  expect(who.value).toBe('0');
  expect([...document.querySelectorAll<HTMLInputElement>('fieldset input')].map((box) => box.checked)).toEqual([true, false]);
});

test('time is gone to by keys once they rest, and is said in words', () => {
  const slider = document.querySelector<HTMLInputElement>('input[aria-label="Time in the run"]')!;
  expect(slider.getAttribute('aria-valuetext')).toBe('2 March, 06:55:00');
  for (const name of ['PageUp', 'ArrowRight', 'ArrowRight']) slider.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true, cancelable: true }));
  flushSync();
  expect(slider.getAttribute('aria-valuetext')).toBe('2 March, 07:57:00');
  expect(sent).toEqual([]);
  vi.advanceTimersByTime(400);
  expect(sent).toEqual([{ say: 'jump', to_us: 3_720_000_000 }]);
});

test('a date and time is gone to across a change of clocks, and no farther than the run', () => {
  void unmount(view);
  const hour = 3_600_000_000;
  begin({ ...madeUpRun(1, 3), length_us: 48 * hour, days: [
    date('2009-03-07', 0, 12, { clock_us: 12 * hour }), date('2009-03-08', 12 * hour, 23, { turn: [14 * hour, hour] }), date('2009-03-09', 35 * hour, 13),
  ] });
  const field = document.querySelector<HTMLInputElement>('input[aria-label="Date and time to go to"]')!;
  expect([field.min, field.max]).toEqual(['2009-03-07T12:00:00', '2009-03-09T13:00:00']);
  for (const asked of ['2009-03-08T01:59:00', '2009-03-08T04:00:00', '2009-03-10T00:00:00']) {
    write(field, asked);
    button('Go').click();
    flushSync();
  }
  expect(sent).toEqual([{ say: 'jump', to_us: 14 * hour - 60e6 }, { say: 'jump', to_us: 15 * hour }]);
  expect(live.notes.map(({ text }) => text)).toEqual(['That time is outside the run.']);
});

test('a run starts without conditions and with the options of its form, and a wrong one is marked', () => {
  void unmount(view);
  begin({ ...madeUpRun(1, 3), conditions: ['depression', 'frailty'], without: ['frailty'] });
  const boxes = [...document.querySelectorAll<HTMLInputElement>('fieldset input')];
  expect(boxes.map((box) => box.checked)).toEqual([true, false]);
  boxes.forEach((box) => box.click());
  const seed = fieldOf('Seed');
  const ask = (value: string) => {
    write(seed, value);
  };
  for (const wrong of ['9007199254740992', '-1', '1.5']) {
    ask(wrong);
    expect(button('New run').disabled, wrong).toBe(true);
    expect(seed.getAttribute('aria-invalid')).toBe('true');
  }
  ask('9007199254740991');
  button('New run').click();
  expect(sent).toEqual([{ say: 'start', driven: null, options: { seed: 9007199254740991, without: ['depression'] } }]);
});

test('the message of the server about an option is at its field until the field changes', () => {
  const days = fieldOf('Length in days');
  wire.onmessage!({ data: JSON.stringify({ tell: 'unbegun', why: 'A run cannot last 40000 days.', problems: [], option: 'days' }) });
  flushSync();
  const said = () => days.closest('.option')!.querySelector('.wrong')!.textContent;
  expect([said(), days.getAttribute('aria-invalid'), document.querySelector('[aria-label="No run"]')]).toEqual(['A run cannot last 40000 days.', 'true', null]);
  write(days, '4');
  expect([said(), days.getAttribute('aria-invalid')]).toEqual(['', 'false']);
});

test('the message of the server about conditions is shown for a run without conditions, too', () => {
  expect(live.run!.conditions).toEqual([]);
  wire.onmessage!({ data: JSON.stringify({ tell: 'unbegun', why: 'No routine shows flu.\nNo routine shows frailty.', problems: [], option: 'without' }) });
  flushSync();
  const said = () => document.querySelector('[aria-label="Run"] [role="alert"]')?.textContent;
  expect([said(), document.querySelector('[aria-label="No run"]')]).toEqual(['No routine shows flu.\nNo routine shows frailty.', null]);
  write(fieldOf('Seed'), '4');
  expect(said()).toBeUndefined();
});

test('things within reach are used, and the others are not listed', () => {
  const doors = document.querySelector('[aria-label="Within reach"]')!;
  expect(doors.textContent).toContain('sitting room door');
  expect(doors.textContent).not.toContain('front door');
  button('Open sitting room door').click();
  expect(sent).toEqual([{ say: 'use', thing: 0, on: true }]);
});

test('the table names the sensors, by what is stored of them as well, the newest first, and says what is not stored', () => {
  show({ now_us: 9_000_000, told: 60, firings: [firing(57, 7_000_000), firing(58, 8_000_000, 1, false), firing(59, 9_000_000, 2)] });
  const rows = [...document.querySelectorAll('table[aria-rowcount] tbody tr')].map((row) => row.textContent!.replace(/\s+/g, ' ').trim());
  expect(rows.map((row) => row.replaceAll(' ', ''))).toEqual([
    '06:55:09bathroommotionS2message59', expect.stringContaining('(notstored)'), '06:55:07sittingroommotionS0message57', '57more,notshown',
  ]);
  expect(document.querySelector('table[aria-rowcount] tbody td')!.getAttribute('title')).toBe('Stored as time 59');
});

test('as a table the time line counts what the server has counted since the run began', () => {
  [...document.querySelectorAll('label')].find((label) => label.textContent!.includes('Table'))!.querySelector('input')!.click();
  show({ now_us: 9_000_000, told: 60, counts: [57, 3], firings: [firing(59, 9_000_000, 0)] });
  const table = document.querySelector('[aria-labelledby="strip-title"] table')!;
  expect(table.querySelector('th[title]')!.getAttribute('title')).toBe('Since the run started');
  expect([...table.querySelectorAll('tbody tr')].slice(0, 2).map((row) => [...row.querySelectorAll('td')].map((cell) => cell.textContent))).toEqual([['1', '57'], ['0', '3']]);
});

test('of five hundred rows few are in the page', () => {
  show({ now_us: 600, told: 600, firings: Array.from({ length: 600 }, (_, seq) => firing(seq, seq)) });
  expect(document.querySelector('table[aria-rowcount]')!.getAttribute('aria-rowcount')).toBe('501');
  expect(document.querySelectorAll('table[aria-rowcount] tbody tr').length).toBeLessThan(60);
});

test('firings are spoken of', () => {
  show({ now_us: 1, told: 1, firings: [firing(0, 1, 0)] });
  expect(document.querySelector('[aria-live="polite"]')!.textContent).toBe(`New events: ${live.run!.home.sensors[0]!.name}.`);
});

test('hostile names are text', () => {
  void unmount(view);
  const run = madeUpRun(2, 18, 0, (name) => `${EVIL} ${name} ${'x'.repeat(4000)}`);
  begin({ ...run, id: EVIL, log: [EVIL] });
  show({ now_us: 9, told: 1, firings: [{ ...firing(0, 9), row: [EVIL, EVIL, EVIL] }] });
  expectText(EVIL);
});

test('a run that ended with its server is told of, with how far it came; one that goes on is not', () => {
  const old = live.run!.id!;
  const told = (run: Partial<RunView>) => {
    wire.onmessage!({ data: JSON.stringify({ tell: 'run', run: { ...live.run, ...run } }) });
    return live.notes.map(({ text }) => text);
  };
  const cut = () => {
    wire.onclose!({ code: 1006 });
    vi.advanceTimersByTime(60_000);
    wire.onopen!();
  };
  show({ now_us: 3_600e6 });
  expect(told({ id: 'another' })).toEqual([]);
  told({ id: old });
  show({ now_us: 3_600e6 });
  cut();
  expect(told({ id: old })).toEqual([]);
  show({ now_us: 7_200e6 });
  cut();
  const notes = told({ id: 'next' });
  expect(notes).toHaveLength(1);
  expect(notes[0]).toMatch(new RegExp(`^The server stopped, and ${old} stopped with it at .*\\d{4}, \\d\\d:55:00\\. That part is saved and listed in Playback`));
  expect(notes[0]).toContain('--resume');
});

test('a new run does not go on as fast as it goes because the one before did', () => {
  show({ speed: null });
  button('New run').click();
  expect(sent.map(({ say }) => say)).toEqual(['speed', 'start']);
  sent.length = 0;
  show({ speed: 100 });
  button('New run').click();
  expect(sent.map(({ say }) => say)).toEqual(['start']);
});

test('what is hatched leads to Playback, which has all of it', () => {
  show({ now_us: 90_000e6, told: 900, firings: [firing(899, 90_000e6 - 1)] });
  button('Show all').click();
  flushSync();
  expect(document.querySelector<HTMLAnchorElement>('.hatched a')!.getAttribute('href')).toBe(`#/playback/${encodeURIComponent(live.run!.id!)}`);
});

test('a click that reaches nobody is said so', () => {
  wire.onclose!({ code: 1006 });
  button('Step 1 s').click();
  expect(live.status).toBe('lost');
  expect(live.notes.map((note) => note.bad)).toEqual([true]);
});
