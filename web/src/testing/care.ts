// A made-up care view: over three months a resident slowly changes. Tests use it, and so does the page without a server.

import type { BesideUsual, CareDay, CareView, ChartPoint, ChangeEpisode, MeasureChart, MeasureGroup, NoteChange, NoteView, ValueForm } from '../wire';
import type { Fetch } from '../server';

const DAY_MS = 86_400_000;
const FIRST = Date.parse('2009-03-02T00:00:00Z');
const FULL_AFTER = 28;
const LEAST = 7;

type Row = [measure: string, title: string, group: MeasureGroup, unit: ValueForm, usual: number, sd: number, change: number];

/** The usual value of each measure, its standard deviation, and the change over the episode. */
const ROWS: Row[] = [
  ['bedtime', 'Bedtime', 'night', 'clock', 22.5, 0.4, 0],
  ['rising', 'Getting up', 'night', 'clock', 6.8, 0.4, 0.8],
  ['sleep', 'Sleep', 'night', 'hours', 7.1, 0.5, 0.9],
  ['restlessness', 'Restlessness in bed', 'night', 'amount', 4.2, 0.7, 0],
  ['density_night', 'Movement at night', 'night', 'amount', 22, 5, 0],
  ['bathroom_night', 'Bathroom visits at night', 'bathroom', 'times', 1.4, 0.7, 0],
  ['bathroom_day', 'Bathroom visits by day', 'bathroom', 'times', 7, 1.5, 0],
  ['showers', 'Showers', 'bathroom', 'times', 0.6, 0.5, 0],
  ['meals', 'Kitchen meals', 'meals', 'times', 3.2, 0.6, -0.7],
  ['time_out', 'Time out of the home', 'out', 'hours', 2.1, 0.7, 0],
  ['outings', 'Outings', 'out', 'times', 1.2, 0.6, -0.4],
  ['visits', 'Visitors', 'out', 'times', 0.4, 0.4, 0],
  ['room_changes', 'Room changes', 'moving', 'times', 203, 22, -65],
  ['pace', 'Walking pace', 'moving', 'of_usual', 1, 0.05, -0.06],
  ['walking_speed', 'Walking speed', 'moving', 'metres_a_second', 0.72, 0.05, 0],
  ['sedentary', 'Sitting and resting', 'moving', 'hours', 4.7, 0.6, 1.5],
  ['density_morning', 'Movement in the morning', 'moving', 'amount', 354, 40, -120],
  ['interdaily_stability', 'Regularity of days', 'rhythm', 'amount', 0.62, 0.05, 0],
];

const dateOf = (day: number) => new Date(FIRST + day * DAY_MS).toISOString().slice(0, 10);

/** A number from -1.5 to 1.5 that is always the same for a day and a measure. */
function chance(day: number, row: number): number {
  const mixed = Math.sin(day * 12.9898 + row * 78.233) * 43_758.5453;
  return (mixed - Math.floor(mixed)) * 3 - 1.5;
}

const shown = (unit: ValueForm, value: number) => (unit === 'clock' ? `at ${String(Math.floor(value) % 24).padStart(2, '0')}:${String(Math.round((value % 1) * 60) % 60).padStart(2, '0')}` : unit === 'hours' ? `${value.toFixed(1)} hours` : unit === 'times' ? `${Math.round(value)} times` : value.toFixed(1));

/** @param since the number of the first day of the episode; null without one. */
export function madeUpCare(name: string, length = 90, since: number | null = 45, with_: Partial<CareView> = {}): CareView {
  const away = (day: number) => day === 20 || day === 21;
  const days = Array.from({ length }, (_, day): CareDay => ({ day: dateOf(day), known: away(day) ? 'nobody_home' : day === 33 ? 'partly' : 'whole', told: [] }));
  const charts = ROWS.map(([measure, title, group, unit, usual, sd, change], row): MeasureChart => {
    const points = days.map(({ day, known }, number): ChartPoint => {
      const grown = since === null ? 0 : Math.min(Math.max((number - since) / 21, 0), 1) * change;
      const value = known === 'whole' && !(row === 3 && number === length - 1) ? Math.max(usual + grown + sd * chance(number, row), 0) : null;
      const range: [number, number] | null = number < LEAST ? null : [Math.max(usual - 2 * sd, 0), usual + 2 * sd];
      const beside: BesideUsual = range === null ? 'not_known' : value === null ? 'as_usual' : value > range[1] ? 'more' : value < range[0] ? 'less' : 'as_usual';
      const words = { more: `, more than usual (${usual})`, less: `, less than usual (${usual})`, as_usual: ', as usual', not_known: '' }[beside];
      if (value !== null && measure !== 'showers') days[number]!.told.push({ measure, words: `${title}: ${shown(unit, value)}${words}`, beside });
      return { day, value: value === null ? null : unit === 'times' ? Math.round(value) : value, usual: range };
    });
    return { measure, title, group, unit, little: sd / 2, is_guess: measure === 'showers', days: points };
  });
  const episode = since === null ? [] : [madeUpEpisode(since, since + 9, null, length)];
  return {
    name,
    person: 'Margaret',
    day: dateOf(length - 1),
    headline: since === null ? { state: 'as_usual', words: 'As usual' } : { state: 'changed', words: episode[0]!.words },
    reference: { from: dateOf(0), to: dateOf(Math.min(FULL_AFTER + 1, length - 1)), days: Math.min(FULL_AFTER, length), is_marked: false },
    remarks: ['Showers are estimated: no sensor is at the shower'],
    silent: ['The sensor hall motion has sent nothing since 28 May 2009'],
    walks: 'lived',
    days,
    absences: length > 21 ? [{ from: dateOf(20), to: dateOf(21) }] : [],
    sentences: [
      { words: 'Margaret was out for at most 2 hours on most days of the last two weeks.', numbers: 'On 11 of 14 days; 1.2 hours on average.', measure: 'time_out', days: [] },
      { words: 'Showered on about half of the last 14 days.', numbers: 'On 7 of 14 days.', measure: 'showers', days: [dateOf(length - 3)] },
    ],
    episodes: episode,
    charts,
    ...with_,
  };
}

/** An episode between numbers of days. */
export function madeUpEpisode(since: number, found: number, over: number | null, length: number): ChangeEpisode {
  const during = Array.from({ length: (over ?? length) - since }, (_, day) => dateOf(since + day));
  const date = (day: string) => new Date(`${day}T00:00:00Z`).toLocaleDateString('en-GB', { day: 'numeric', month: 'long', timeZone: 'UTC' });
  return {
    since: dateOf(since),
    worse: [],
    found: dateOf(found),
    over: over === null ? null : dateOf(over),
    course: over === null ? 'growing' : 'over',
    signs: [
      { measure: 'rising', is_more: true, value: 7.57, usual: 6.77, shift_sd: 1.6, shown_by: during.slice(5), words: 'getting up 47 min later', numbers: 'at 07:34 on average, usually 06:46' },
      { measure: 'sedentary', is_more: true, value: 6.2, usual: 4.7, shift_sd: 2.1, shown_by: during.slice(8), words: '1.5 h more sitting and resting', numbers: '6.2 hours on average, usually 4.7' },
      { measure: 'room_changes', is_more: false, value: 138, usual: 203, shift_sd: -1.9, shown_by: during.slice(3, 12), words: 'fewer room changes by 32 %', numbers: '138 times on average, usually 203' },
    ],
    seen_with: [{ condition: 'depression', likelihood_ratio: 4.2 }, { condition: 'heart-failure', likelihood_ratio: 2.3 }],
    words: `${over === null ? `Since about ${date(dateOf(since))}` : `From about ${date(dateOf(since))} to ${date(dateOf(over - 1))}`}: getting up 47 min later, 1.5 h more sitting and resting, and fewer room changes by 32 %`,
  };
}

/** The care view of a state, by the page's address: `?care=calm`, `few`, `new`, `over` or `no_home`. */
export function careIn(state: string | null, name: string): CareView {
  switch (state) {
    case 'calm':
      return madeUpCare(name, 90, null);
    case 'few':
      return madeUpCare(name, 5, null, { headline: { state: 'not_known', words: 'What is usual is not known yet: 5 complete days of 7 days needed' } });
    case 'new':
      return madeUpCare(name, 56, 45, { headline: { state: 'look_today', words: madeUpEpisode(45, 54, null, 56).words } });
    case 'over':
      return madeUpCare(name, 90, null, { headline: { state: 'as_usual', words: 'As usual again since 10 May' }, episodes: [madeUpEpisode(45, 54, 69, 90)] });
    case 'no_home':
      return madeUpCare(name, 12, null, { walks: 'no_home' });
    default:
      return madeUpCare(name);
  }
}

/** Answers about the care of runs, before another server. */
export function fakeCare(others: Fetch, of: (name: string) => CareView = (name) => madeUpCare(name)): Fetch {
  const notes = new Map<string, NoteView[]>();
  return async (path, init) => {
    const [, run, what] = /^\/api\/runs\/([^/]+)\/(care|notes)$/.exec(path) ?? [];
    if (run === undefined) return path === '/api/logs' ? Response.json([]) : others(path, init);
    if (what === 'care') return Response.json(of(decodeURIComponent(run)));
    if (init.method === 'POST') {
      const { note } = JSON.parse(String(init.body)) as NoteChange;
      const others = (notes.get(run) ?? []).filter((other) => other.day !== note.day || other.about !== note.about);
      notes.set(run, note.seen || note.note !== '' ? [...others, { ...note, at: '2009-06-01T09:30' }] : others);
    }
    return Response.json(notes.get(run) ?? []);
  };
}
