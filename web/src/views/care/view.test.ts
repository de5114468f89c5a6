import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Live } from '../../live.svelte';
import { Server } from '../../server';
import type { CareView, NoteChange, NoteView, PlaybackContent, StoredView } from '../../wire';
import CarePage from './Care.svelte';
import { shifted } from './dates';
import { EVIL, write } from '../../testing/page';

const FIRST = '2009-02-20';
const days = Array.from({ length: 39 }, (_, index) => shifted(FIRST, index));

const care = (name: string, walks: PlaybackContent = 'lived'): CareView => ({
  name,
  person: 'Ada',
  day: '2009-03-30',
  is_compared: true,
  remarks: ['Outings are unknown: no sensor is at an entrance'],
  walks,
  days: days.map((day) => ({
    day,
    known: day === '2009-03-10' ? 'nobody_home' : day === '2009-03-11' ? 'partly' : 'whole',
    told: day === '2009-03-10' ? [] : [
      { measure: 'sleep', words: 'Slept for 4.0 hours, less than usual (7.0)', is_more: day >= '2009-03-28' ? false : null },
      { measure: 'meals', words: `Had a meal in the kitchen 3 times, as usual ${EVIL}`, is_more: null },
    ],
  })),
  sentences: [
    { words: 'Less sleep than before on most nights of the last two weeks: 4.0 hours on average, previously 7.0.', numbers: 'On 2 of 14 nights.', measure: 'sleep', is_change: true, days: ['2009-03-29', '2009-03-30'] },
    { words: 'Ada was out for at most 2 hours on every day of the last two weeks.', numbers: 'On 14 of 14 days; 1.2 hours on average.', measure: 'time_out', is_change: false, days: [] },
  ],
  alerts: [{ day: '2009-03-29', rule: 'sleep', words: 'Less sleep than usual, two nights in a row', numbers: '4.0 hours, usually 7.0.', measures: ['sleep'], days: ['2009-03-28', '2009-03-29'] }],
  charts: [
    { measure: 'sleep', title: 'Sleep', unit: 'hours', little: 0.5, is_guess: false, days: days.map((day, index) => ({ day, value: day < '2009-03-16' ? 7 + (index % 2) * 0.2 : 4, usual: [6.5, 7.5] })) },
    { measure: 'bedtime', title: 'Bedtime', unit: 'clock', little: 0.4, is_guess: false, days: days.map((day) => ({ day, value: 22.5, usual: null })) },
  ],
});

const stored = (name: string): StoredView => ({ name, walked_back: null, scenario: name, start: '2009-03-02 00:00:00', days: 30, has_truth: false, problem: null, made_ms: null, seed: null, without: [], about: { title: '', note: '' } });

let view: Record<string, unknown>;
let answers: Record<string, unknown>;
let notes: NoteView[];
let sent: [string, unknown][];

async function settle() {
  for (let turn = 0; turn < 10; turn++) {
    await new Promise((done) => setTimeout(done, 0));
    flushSync();
  }
}

async function begin(hash = '#/care', ongoing: string | null = null) {
  window.location.hash = hash;
  const fetch = async (path: string, init: RequestInit) => {
    if (init.method === 'POST') {
      const body: unknown = typeof init.body === 'string' ? JSON.parse(init.body) : init.body;
      sent.push([path, body]);
      if (path.endsWith('/notes')) {
        const { note } = body as NoteChange;
        notes = [...notes.filter((other) => other.day !== note.day || other.rule !== note.rule), note];
        return Response.json(notes);
      }
    }
    if (path.endsWith('/notes')) return Response.json(notes);
    return path in answers ? Response.json(answers[path]) : new Response('There is no such run.', { status: 404 });
  };
  const server = new Server('token', () => {}, fetch);
  view = mount(CarePage, { target: document.body, props: { live: { server, ongoing } as Live } });
  await settle();
}

const text = () => document.body.textContent!.replace(/\s+/g, ' ');
const one = <T extends Element>(selector: string) => document.querySelector<T>(selector)!;
const cell = () => one<HTMLButtonElement>('td[aria-selected="true"] button');

function press(key: string) {
  cell().dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
}

beforeEach(() => {
  [notes, sent] = [[], []];
  answers = { '/api/runs': [stored('a'), stored('b')], '/api/logs': [], '/api/walk': null, '/api/runs/a/care': care('a'), '/api/runs/b/care': care('b', 'sensors') };
});
afterEach(() => unmount(view));

test('of twins the menu says which was lived without what', async () => {
  answers['/api/runs'] = [stored('a'), { ...stored('b'), without: ['low_mood'] }];
  await begin();
  expect([...document.querySelectorAll('#care-run option')].map((option) => option.textContent!.split(' · ')[0])).toEqual(['a', 'b without low mood']);
});

test('a run that is being lived has no length in the menu', async () => {
  await begin('#/care/b', 'a');
  expect([...document.querySelectorAll('#care-run option')].map((option) => option.textContent)).toEqual(['a · 2009-03-02, running', 'b · 2009-03-02, 30 days']);
});

test('the day, what has changed and what is worth a look are told in words', async () => {
  await begin();
  for (const told of ['Latest day: Monday 30 March 2009', 'One thing was unusual', 'Slept for 4.0 hours, less than usual', 'Less sleep than before on most nights', '1 alert needs attention, 1 in all', 'Outings are unknown']) {
    expect(text()).toContain(told);
  }
  expect(document.querySelector('img')).toBeNull();
});

test('arrow keys go through the calendar by day and week, and the day that is open follows', async () => {
  await begin();
  expect(cell().title).toBe('Monday 30 March 2009, 1 unusual measure');
  for (const [key, label] of [
    ['ArrowLeft', 'Sunday 29 March 2009, 1 alert open, 1 unusual measure'],
    ['ArrowUp', 'Sunday 22 March 2009, nothing unusual'],
    ['Home', 'Monday 16 March 2009, nothing unusual'],
    ['PageUp', 'Friday 20 February 2009, nothing unusual'],
    ['ArrowLeft', 'Friday 20 February 2009, nothing unusual'],
    ['PageDown', 'Friday 20 March 2009, nothing unusual'],
    ['End', 'Sunday 22 March 2009, nothing unusual'],
  ] as const) {
    press(key);
    await settle();
    expect(cell().title, key).toBe(label);
    expect(document.activeElement).toBe(cell());
  }
  expect(one('.opened h2').textContent).toBe('Sunday 22 March 2009');
  expect(window.location.hash).toBe('#/care/a@2009-03-22');
  expect(document.querySelectorAll('td button[tabindex="0"]').length).toBe(1);
  for (const [label, told] of [['10 March', 'Away for most of this day'], ['11 March', 'Incomplete data']] as const) {
    one<HTMLButtonElement>(`td button[title*="${label}"]`).click();
    flushSync();
    expect(one('.opened').textContent).toContain(told);
  }
});

test('an alert is seen to with a note, which is kept by the server, and so is one of a day', async () => {
  await begin('#/care/a@2009-03-29');
  const alert = one<HTMLElement>('.opened .alert');
  alert.querySelector<HTMLInputElement>('input[type=checkbox]')!.click();
  const note = alert.querySelector<HTMLInputElement>('input[type=text]')!;
  write(note, ' a cold ', 'change');
  await settle();
  const seen = { day: '2009-03-29', rule: 'sleep', seen: true, note: '' };
  expect(sent).toEqual([
    ['/api/runs/a/notes', { before: null, note: seen }],
    ['/api/runs/a/notes', { before: seen, note: { ...seen, note: 'a cold' } }],
  ]);
  expect(text()).toContain('The one alert is acknowledged');
  expect(cell().title).toBe('Sunday 29 March 2009, 1 alert acknowledged, 1 unusual measure, with a note');
  const ofDay = one<HTMLInputElement>('input[placeholder="Note on this day"]');
  write(ofDay, 'her son came', 'change');
  await settle();
  expect(sent.at(-1)).toEqual(['/api/runs/a/notes', { before: null, note: { day: '2009-03-29', rule: '', seen: false, note: 'her son came' } }]);
});

test('a sentence opens down to its days, and leads to them walked', async () => {
  await begin();
  one<HTMLElement>('details').setAttribute('open', '');
  one<HTMLElement>('details').dispatchEvent(new Event('toggle'));
  flushSync();
  expect(document.querySelectorAll('svg .marked').length).toBe(4);
  expect(one<HTMLAnchorElement>('details a').getAttribute('href')).toBe('#/playback/a@2009-03-29T22:15:00');
  one<HTMLButtonElement>('details li button').click();
  flushSync();
  expect(one('.opened h2').textContent).toBe('Sunday 29 March 2009');
});

test('where nobody can be seen walking that is said, and a log is walked back on wish', async () => {
  await begin('#/care/b');
  expect(one<HTMLSelectElement>('#care-run').value).toBe('b');
  expect(text()).toContain('Playback shows its sensors only');
  answers['/api/runs/b/log'] = 'rows';
  one<HTMLButtonElement>('.card .about button').click();
  await settle();
  expect(sent.map(([path]) => path)).toEqual(['/api/walk/b.db/b']);
  await unmount(view);
  answers['/api/logs'] = [{ name: 'c', log: 'c.csv' }];
  answers['/api/runs/c/care'] = care('c', 'no_home');
  await begin('#/care/c');
  expect(text()).toContain('has no floor plan');
  expect(document.querySelector('a[href^="#/playback"]')).toBeNull();
});

test('two spans stand side by side, and may be others', async () => {
  await begin();
  const row = () => [...document.querySelectorAll('section[aria-label="Compare two periods"] tbody tr')].map((tr) => [...tr.children].filter((part) => !part.matches('.picture')).map((part) => part.textContent));
  expect(row()[0]).toEqual(['Sleep', '4.0 h', '6.9 h', '2 hours 53 minutes less a day']);
  expect(row()[1]).toEqual(['Bedtime', '22:30', '22:30', 'about the same']);
  const [from] = document.querySelectorAll<HTMLInputElement>('input[type=date]');
  from!.value = '2009-03-29';
  from!.dispatchEvent(new Event('change', { bubbles: true }));
  flushSync();
  expect(row()[0]!.at(-1)).toBe('too few days');
});

test('without a usual nothing is called usual or unusual', async () => {
  const few = care('a');
  answers['/api/runs/a/care'] = { ...few, sentences: [], alerts: [], charts: few.charts.map((chart) => ({ ...chart, days: chart.days.map((day) => ({ ...day, usual: null })) })) };
  await begin();
  expect(text()).toContain('Not enough days yet to know the usual range');
  expect(text()).toContain('Not enough days yet to compare');
  expect(text()).not.toContain('Everything was as usual');
  // Draws neither good nor bad.
  const drawn = () => [...one('[aria-label="Latest day"] ul').children].map((row) => row.className.match(/odd|unknown/)?.[0] ?? 'usual');
  expect(drawn()).toEqual(['odd', 'unknown']);
  await unmount(view);
  answers['/api/runs/a/care'] = care('a');
  await begin();
  expect(drawn()).toEqual(['odd', 'usual']);
});

test('with an alert nothing is said to be as usual, or not to stand out, without it', async () => {
  const of = care('a');
  const calm = { ...of, sentences: of.sentences.filter((sentence) => !sentence.is_change), days: of.days.map((day) => ({ ...day, told: day.told.map((one) => ({ ...one, is_more: null })) })) };
  const begun = async (alerts: CareView['alerts']) => {
    answers['/api/runs/a/care'] = { ...calm, alerts };
    await begin();
    const shown = text();
    await unmount(view);
    return shown;
  };
  const without = await begun([]);
  expect(without).toContain('Everything was as usual.');
  expect(without).toContain('against the weeks before.');
  const withOne = await begun([{ ...of.alerts[0]!, day: of.day! }]);
  expect(withOne).not.toContain('Everything was as usual.');
  expect(withOne).toContain('An alert of this day is under Needs attention');
  expect(withOne).toContain('Alerts of these days are under Needs attention');
  await begin();
});

test('where too little lies before, nothing is said to be as before', async () => {
  const alone = care('a');
  answers['/api/runs/a/care'] = { ...alone, is_compared: false, sentences: alone.sentences.filter((sentence) => !sentence.is_change) };
  await begin();
  expect(text()).toContain('Not enough days yet to compare');
  expect(text()).not.toContain('No change');
});

test('several alerts about sensors of one day are all told', async () => {
  const of = care('a');
  const silent = (sensor: string) => ({ day: '2009-03-29', rule: 'sensor', words: `The sensor ${sensor} has said nothing`, numbers: '', measures: [], days: ['2009-03-27'] });
  answers['/api/runs/a/care'] = { ...of, alerts: [silent('hall'), silent('bed')] };
  await begin();
  expect(text()).toContain('The sensor hall has said nothing');
  expect(text()).toContain('The sensor bed has said nothing');
});

test('of runs of which nothing is written yet the one before is shown, unless it is asked for', async () => {
  answers['/api/runs'] = [stored('lived'), stored('a')];
  await begin();
  expect([one<HTMLSelectElement>('select').value, text().includes('Slept for 4.0 hours'), document.querySelector('[role="alert"]')?.textContent ?? '']).toEqual(['a', true, '']);
  await unmount(view);
  await begin('#/care/lived');
  expect(text()).toContain('There is no such run.');
});

test('what goes wrong is said', async () => {
  answers = { '/api/runs': [], '/api/walk': null };
  await begin();
  expect(text()).toContain('No runs yet');
  const chosen = vi.fn();
  one<HTMLInputElement>('input[type="file"]').click = chosen;
  one<HTMLButtonElement>('p.about button').click();
  expect(chosen).toHaveBeenCalledOnce();
  await unmount(view);
  answers = { '/api/runs': [stored('a')], '/api/walk': null };
  await begin();
  expect([...document.querySelectorAll('[role=alert]')].map((alert) => alert.textContent).join()).toContain('There is no such run.');
});
