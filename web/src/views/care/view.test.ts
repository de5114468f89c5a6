import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Live } from '../../live.svelte';
import { Server } from '../../server';
import type { CareView, NoteChange, NoteView } from '../../wire';
import { madeUpCare, madeUpEpisode } from '../../testing/care';
import { EVIL, button, write } from '../../testing/page';
import { listedRun } from '../../testing/stored';
import CarePage from './Care.svelte';

/** Ninety days from 2 March on, with a change since 16 April that was found on 25 April. */
const care = (name: string, with_: Partial<CareView> = {}) => madeUpCare(name, 90, 45, with_);
const calm = (name: string, length = 90, with_: Partial<CareView> = {}) => madeUpCare(name, length, null, with_);
const FOUND = '2009-04-25';

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
        notes = notes.filter((other) => other.day !== note.day || other.about !== note.about);
        if (note.seen || note.note !== '') notes.push({ ...note, at: '2009-06-01T09:30' });
        return Response.json(notes);
      }
    }
    if (path.endsWith('/notes')) return Response.json(notes);
    return path in answers ? Response.json(answers[path]) : new Response('There is no such run.', { status: 404 });
  };
  const server = new Server('token', () => {}, fetch, '/api/homes/flat');
  view = mount(CarePage, { target: document.body, props: { live: { server, ongoing } as Live } });
  await settle();
}

const text = (of: Element = document.body) => of.textContent!.replace(/\s+/g, ' ');
const one = <T extends Element = HTMLElement>(selector: string) => document.querySelector<T>(selector)!;
const cell = () => one<HTMLButtonElement>('td[aria-selected="true"] button');
const part = (label: string) => one(`section[aria-label="${label}"]`);
const own = (path: string) => `/api/homes/flat${path}`;

function press(key: string) {
  cell().dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
}

beforeEach(() => {
  window.localStorage.clear();
  [notes, sent] = [[], []];
  answers = {
    [own('/runs')]: [listedRun('a'), listedRun('b')], [own('/logs')]: [], [own('/walk')]: null,
    [own('/runs/a/care')]: care('a'), [own('/runs/b/care')]: care('b', { walks: 'sensors' }),
  };
});
afterEach(() => unmount(view));

test('of twins the menu says which was lived without what', async () => {
  answers[own('/runs')] = [listedRun('a'), { ...listedRun('b'), without: ['low_mood'] }];
  await begin();
  expect([...document.querySelectorAll('#care-run option')].map((option) => option.textContent!.split(' · ')[0])).toEqual(['a', 'b without low mood']);
});

test('a run that is being lived has no length in the menu', async () => {
  await begin('#/care/b', 'a');
  expect([...document.querySelectorAll('#care-run option')].map((option) => option.textContent)).toEqual(['a · 2009-03-02, running', 'b · 2009-03-02, 30 days']);
});

test('the headline has a word for its state, and says with what it compares', async () => {
  for (const [state, word] of [['look_today', 'Look today'], ['changed', 'Changed'], ['as_usual', 'As usual'], ['not_known', 'Not known']] as const) {
    answers[own('/runs/a/care')] = care('a', { headline: { state, words: `Words of ${state} ${EVIL}` } });
    await begin();
    expect(text(one('.state'))).toBe(word);
    expect(document.querySelectorAll('.state svg').length).toBe(1);
    expect(text(part('State'))).toContain(`Words of ${state}`);
    expect(document.querySelector('img')).toBeNull();
    await unmount(view);
  }
  await begin();
  const state = text(part('State'));
  for (const told of ['Compared with 2 to 31 March 2009 (28 complete days).', 'Away from 22 to 23 March 2009.', 'has sent nothing since 28 May 2009. Check the battery.']) expect(state).toContain(told);
  expect(state).not.toContain('can be seen yet');
  expect(text()).toContain('For research. Not a medical device; it makes no diagnosis.');
});

test('with few days the headline says what cannot be seen yet', async () => {
  for (const [length, words] of [[5, 'No change can be seen yet'], [12, 'Only large changes can be seen yet']] as const) {
    answers[own('/runs/a/care')] = calm('a', length);
    await begin();
    expect(text(part('State'))).toContain(words);
    await unmount(view);
  }
  answers[own('/runs/a/care')] = calm('a', 5);
  await begin();
  expect(text(one('#care-day'))).toContain('Nothing can be compared: too few complete days yet to know what is usual.');
  expect(text(part('Changes'))).toContain('Not enough days yet to find a change.');
  const kinds = [...document.querySelectorAll('#care-day li')].map((row) => row.className.match(/usual|unknown|odd|sign/)![0]);
  expect([...new Set(kinds)]).toEqual(['unknown']);
  expect(text()).not.toContain('as usual');
});

test('arrow keys go through the calendar by day and week, and the day that is open follows', async () => {
  answers[own('/runs/a/care')] = calm('a', 39, { days: calm('a', 39).days.map((day) => ({ ...day, told: [] })) });
  await begin();
  expect(cell().title).toBe('Thursday 9 April 2009, nothing unusual');
  for (const [key, label] of [
    ['ArrowLeft', 'Wednesday 8 April'], ['ArrowUp', 'Wednesday 1 April'], ['Home', 'Monday 30 March'], ['PageUp', 'Monday 2 March'],
    ['ArrowLeft', 'Monday 2 March'], ['PageDown', 'Thursday 2 April'], ['End', 'Sunday 5 April'],
  ] as const) {
    press(key);
    await settle();
    expect(cell().title, key).toBe(`${label} 2009, nothing unusual`);
    expect(document.activeElement).toBe(cell());
  }
  expect(one('.opened h2').textContent).toBe('Sunday 5 April 2009');
  expect(window.location.hash).toBe('#/care/a@2009-04-05');
  expect(document.querySelectorAll('td button[tabindex="0"]').length).toBe(1);
  for (const [label, told] of [['22 March', 'Away for most of this day'], ['4 April', 'Incomplete data']] as const) {
    one<HTMLButtonElement>(`td button[title*="${label}"]`).click();
    flushSync();
    expect(text(one('.opened'))).toContain(told);
  }
});

test('an episode has its course, its signs and careful words', async () => {
  await begin();
  const episode = text(one('.episode'));
  for (const told of ['Since about 16 April', 'Found on 25 April 2009; still growing', 'Getting up 47 min later: at 07:34 on average, usually 06:46', 'low mood (depression) or a weak heart (heart failure). Ask Margaret; this is no diagnosis.', 'Likelihood ratio: 4.2 for depression']) expect(episode).toContain(told);
  expect(text(part('Changes'))).toContain('One change needs attention.');
});

test('a sign opens to its days and its chart, and a day of it opens', async () => {
  await begin();
  const sign = one('.signs details');
  expect(sign.querySelector('svg')).toBeNull();
  sign.setAttribute('open', '');
  sign.dispatchEvent(new Event('toggle'));
  flushSync();
  expect(sign.querySelectorAll('svg .marked').length).toBe(40);
  expect([sign.querySelectorAll('svg .span').length, sign.querySelectorAll('svg .reference').length, sign.querySelectorAll('svg .usual').length]).toEqual([1, 1, 1]);
  expect(sign.querySelectorAll('li button').length).toBe(15);
  button('Show all 40 days').click();
  flushSync();
  expect(sign.querySelectorAll('li button').length).toBe(40);
  expect(document.querySelectorAll('td .marked').length).toBe(40);
  sign.querySelector<HTMLButtonElement>('li button')!.click();
  flushSync();
  expect(one('.opened h2').textContent).toBe('Tuesday 21 April 2009');
  expect(document.activeElement).toBe(one('#care-day'));
});

test('an episode is dealt with by name and note, stays in its place, and is folded for the next reader', async () => {
  await begin();
  const [dealt, who, note] = [...one('.episode').querySelectorAll<HTMLInputElement>('.row input')];
  write(who!, ' Eve ', 'change');
  await settle();
  expect(sent).toEqual([]);
  dealt!.click();
  await settle();
  const seen: NoteView = { day: FOUND, about: 'episode', seen: true, note: '', who: 'Eve', at: '' };
  write(note!, ' called the doctor ', 'change');
  await settle();
  const stored = { ...seen, at: '2009-06-01T09:30' };
  expect(sent).toEqual([
    [own('/runs/a/notes'), { before: null, note: seen }],
    [own('/runs/a/notes'), { before: stored, note: { ...seen, note: 'called the doctor' } }],
  ]);
  expect(document.querySelector('details.episode')).toBeNull();
  expect(text(part('Changes'))).toContain('The open change is dealt with.');
  await unmount(view);
  await begin();
  expect(one<HTMLDetailsElement>('details.episode').open).toBe(false);
  expect(text(one('details.episode summary'))).toContain('Dealt with by Eve on 1 June 2009 at 09:30: called the doctor');
  expect(one<HTMLInputElement>('input.who').value).toBe('Eve');
  // Paper shows it unfolded.
  window.dispatchEvent(new Event('beforeprint'));
  expect(one<HTMLDetailsElement>('details.episode').open).toBe(true);
  window.dispatchEvent(new Event('afterprint'));
  expect(one<HTMLDetailsElement>('details.episode').open).toBe(false);
});

test('the name of the user is known for the next note, also one about a day', async () => {
  window.localStorage.setItem('homebody-who', 'Eve');
  await begin('#/care/a@2009-04-25');
  write(one<HTMLInputElement>('input[placeholder="Note on this day"]'), 'her son came', 'change');
  await settle();
  expect(sent).toEqual([[own('/runs/a/notes'), { before: null, note: { day: FOUND, about: 'day', seen: false, note: 'her son came', who: 'Eve', at: '' } }]]);
  expect(text(one('#care-day'))).toContain('Note by Eve on 1 June 2009 at 09:30.');
  expect(cell().title).toContain('a change was found, with a note');
  expect(text(one('ul.printed'))).toBe('25 April 2009: her son came (by Eve on 1 June 2009 at 09:30)');
});

test('episodes that are over are folded, after the open ones', async () => {
  const over = madeUpEpisode(10, 14, 30, 90);
  answers[own('/runs/a/care')] = care('a', { episodes: [over, ...care('a').episodes] });
  await begin();
  const all = [...document.querySelectorAll('.episode')];
  expect(all.map((episode) => episode.tagName)).toEqual(['DIV', 'DETAILS']);
  expect(text(all[1]!.querySelector('summary')!)).toContain('over since 1 April 2009');
});

test('a new comparison begins on a day, and is taken back', async () => {
  await begin();
  answers[own('/runs/a/care')] = care('a', { episodes: [], headline: { state: 'not_known', words: 'What is usual is not known yet' } });
  button('Compare from here on').click();
  await settle();
  const mark: NoteView = { day: '2009-04-26', about: 'reference', seen: true, note: '', who: '', at: '' };
  expect(sent).toEqual([[own('/runs/a/notes'), { before: null, note: mark }]]);
  expect(text(part('State'))).toContain('What is usual is not known yet');
  expect(text(part('State'))).toContain('Marked on 1 June 2009 at 09:30: days are compared from Sunday 26 April 2009 on.');
  answers[own('/runs/a/care')] = care('a');
  button('Take back').click();
  await settle();
  expect(sent.at(-1)).toEqual([own('/runs/a/notes'), { before: { ...mark, at: '2009-06-01T09:30' }, note: { ...mark, seen: false } }]);
  expect(text(part('State'))).toContain('Since about 16 April');
  expect(text(part('State'))).not.toContain('days are compared from');
});

test('a day within a change leads to it, and is not as usual', async () => {
  const of = care('a');
  const usual = of.days.map((day) => ({ ...day, told: day.told.map((one) => ({ ...one, words: `${one.measure}: as ever, as usual`, beside: 'as_usual' as const })) }));
  answers[own('/runs/a/care')] = { ...of, days: usual };
  await begin();
  const day = one('#care-day');
  expect(text(day)).not.toContain('Everything is as usual');
  expect(text(day)).toContain('Nothing unusual today beyond the change since 16 April.');
  expect(text(day)).toContain('rising: as ever (part of the change: getting up 47 min later)');
  day.querySelector<HTMLButtonElement>('button.link')!.click();
  expect(document.activeElement).toBe(one(`#episode-${FOUND}-title`));
  await unmount(view);
  answers[own('/runs/a/care')] = { ...calm('a'), days: usual };
  await begin();
  expect(text(one('#care-day'))).toContain('Everything is as usual today.');
});

test('measures of a day are in groups, and those without data are named', async () => {
  await begin('#/care/a@2009-05-30');
  expect([...document.querySelectorAll('#care-day h3')].map((title) => title.textContent)).toEqual(['Night', 'Bathroom', 'Meals', 'Out and visitors', 'Moving at home', 'Rhythm']);
  expect(text(one('#care-day'))).toContain('Without data on this day: restlessness in bed.');
  expect([...document.querySelectorAll('section[aria-label="Day by day"] h3')].map((title) => title.textContent)).toEqual(['Night', 'Bathroom', 'Meals', 'Out and visitors', 'Moving at home', 'Rhythm']);
  expect(document.querySelectorAll('section[aria-label="Day by day"] figure').length).toBe(care('a').charts.length);
});

test('a run of sensors alone is reconstructed on wish', async () => {
  await begin('#/care/b');
  expect(one<HTMLSelectElement>('#care-run').value).toBe('b');
  expect(text()).toContain('Playback shows its sensors only');
  answers[own('/runs/b/log')] = 'rows';
  button('Reconstruct movements').click();
  await settle();
  expect(sent.map(([path]) => path)).toEqual([own('/walk/b.db/b')]);
});

test('a log without a floor plan becomes a home in one click, where the page is one of a library', async () => {
  answers[own('/logs')] = [{ name: 'c', log: 'c.csv' }];
  answers[own('/runs/c/care')] = care('c', { walks: 'no_home' });
  answers[own('/runs/c/log')] = 'rows';
  await begin('#/care/c');
  expect(text()).toContain('no floor plan');
  expect(text()).toContain('Start homebody serve without a scenario');
  expect(document.querySelector('a[href^="#/playback"]')).toBeNull();
  await unmount(view);
  window.history.replaceState(null, '', '/homes/flat/#/care/c');
  answers['/api/library'] = { folder: '', trouble: null, homes: [{ name: 'c', title: '', about: '', changed_ms: null }], more: 0, aside: [], templates: [], runs_beside: 0 };
  answers['/api/library/logs/c%202/c'] = { name: 'c 2', remarks: [] };
  answers['/api/homes/c%202/walk/c'] = true;
  const gone = vi.fn();
  vi.spyOn(window.location, 'assign').mockImplementation(gone);
  await begin('#/care/c');
  button('Make a home').click();
  await settle();
  expect(sent.map(([path]) => path)).toEqual(['/api/library/logs/c%202/c', '/api/homes/c%202/walk/c']);
  expect(gone).toHaveBeenCalledWith('/homes/c%202/#/care');
  window.history.replaceState(null, '', '/');
  vi.restoreAllMocks();
});

test('the last days are compared with the usual ones, and periods may be others', async () => {
  await begin();
  const row = (title: string) => {
    const found = [...part('Compare two periods').querySelectorAll('tbody tr:not(.group)')].find((tr) => tr.firstElementChild!.textContent === title)!;
    return [...found.children].filter((child) => !child.matches('.picture')).map((child) => child.textContent);
  };
  const heads = () => [...part('Compare two periods').querySelectorAll('thead th:not(.picture)')].map((head) => head.textContent).slice(1, 3);
  expect(heads()).toEqual(['17 to 30 May 2009 (14 days)', '2 to 31 March 2009 (30 days)']);
  expect(row('Getting up').at(-1)).toMatch(/^\d+ minutes later$/);
  expect(row('Bedtime').at(-1)).toBe('about the same');
  const select = one<HTMLSelectElement>('#care-periods');
  expect([...select.options].map(({ value }) => value)).toEqual(['reference', 'month', 'day', 'own']);
  write(select, 'day', 'change');
  expect(heads()).toEqual(['16 April to 13 May 2009 (28 days)', '19 March to 15 April 2009 (28 days)']);
  write(select, 'own', 'change');
  const [from] = document.querySelectorAll<HTMLInputElement>('input[type=date]');
  write(from!, '2009-05-12', 'change');
  expect(heads()[0]).toBe('12 to 13 May 2009 (2 days)');
  expect(row('Getting up').at(-1)).toBe('too few days');
  write(from!, '2009-04-10', 'change');
  expect(text(part('Compare two periods'))).toContain('These periods overlap');
});

test('of runs without results the next is shown, unless it is asked for, and a running one is not', async () => {
  answers[own('/runs')] = [listedRun('running', 1), listedRun('short', 2), listedRun('failed'), listedRun('a')];
  await begin('#/care', 'running');
  expect([one<HTMLSelectElement>('select').value, text().includes('Margaret'), document.querySelector('[role="alert"]')?.textContent ?? '']).toEqual(['a', true, '']);
  await unmount(view);
  await begin('#/care/failed');
  expect(text()).toContain('There is no such run.');
});

test('what goes wrong is said', async () => {
  answers = { [own('/runs')]: [], [own('/walk')]: null };
  await begin();
  expect(text()).toContain('No finished run yet');
  const chosen = vi.fn();
  one<HTMLInputElement>('input[type="file"]').click = chosen;
  one<HTMLButtonElement>('p.about button').click();
  expect(chosen).toHaveBeenCalledOnce();
  await unmount(view);
  answers = { [own('/runs')]: [listedRun('a')], [own('/walk')]: null };
  await begin();
  expect([...document.querySelectorAll('[role=alert]')].map((alert) => alert.textContent).join()).toContain('There is no such run.');
});
