import { expect, test } from 'vitest';
import { Refused } from '../../server';
import type { CareDay, MeasureChart, NoteChange, NoteView } from '../../wire';
import { described, monthsOf, stepped } from './calendar';
import { between, inFull, monthsLater, shifted, weekday } from './dates';
import { momentOf } from './moment';
import { Notes } from './notes.svelte';
import { compared, usualSpans } from './spans';

const chart = (measure: string, unit: MeasureChart['unit'], values: (number | null)[], little = 0.5): MeasureChart => ({
  measure, title: measure, unit, little, is_guess: false, days: values.map((value, index) => ({ day: shifted('2024-02-26', index), value, usual: null })),
});
const days = (count: number, first = '2024-02-26'): CareDay[] => Array.from({ length: count }, (_, index) => ({ day: shifted(first, index), known: 'whole', told: [] }));

test('days are counted over leap days and ends of months', () => {
  expect([shifted('2024-02-28', 2), shifted('2024-01-01', -1), monthsLater('2024-01-31', 1), monthsLater('2024-01-31', -2)]).toEqual(['2024-03-01', '2023-12-31', '2024-02-29', '2023-11-30']);
  expect([weekday('2024-02-26'), weekday('2024-03-03'), between('2024-02-28', '2024-03-01'), inFull('2024-02-29')]).toEqual([0, 6, 2, 'Thursday 29 February 2024']);
});

test('a month has whole weeks from Monday, and no day twice', () => {
  const alert = { day: '2024-03-02', rule: 'sleep', words: '', numbers: '', measures: [], days: [] };
  const notes: NoteView[] = [{ day: '2024-03-02', rule: 'sleep', seen: true, note: 'x' }];
  const months = monthsOf({ days: days(8), alerts: [alert, { ...alert, rule: 'meals' }] }, notes);
  expect(months.map(({ title, weeks }) => [title, weeks.length])).toEqual([['February 2024', 1], ['March 2024', 2]]);
  const cells = months.flatMap(({ weeks }) => weeks.flatMap((week) => week.days)).filter((cell) => cell !== null);
  expect(cells.map(({ day }) => day)).toEqual(days(8).map(({ day }) => day));
  expect(described(cells[5]!)).toBe('Saturday 2 March 2024, 1 alert open, 1 alert acknowledged, with a note');
  expect(monthsOf({ days: [], alerts: [] }, [])).toEqual([]);
});

test('keys stay within the log', () => {
  const to = (key: string, day: string) => stepped(key, day, '2024-02-26', '2024-03-04');
  expect([to('ArrowUp', '2024-02-28'), to('ArrowDown', '2024-02-28'), to('End', '2024-03-04'), to('a', '2024-03-01')]).toEqual(['2024-02-26', '2024-03-04', '2024-03-04', null]);
});

test('a night is seen from going to bed on the evening before, a morning from getting up', () => {
  const care = { charts: [chart('bedtime', 'clock', [24.5, null]), chart('rising', 'clock', [7.5, null])] };
  expect(momentOf(care, 'sleep', '2024-02-26')).toBe('2024-02-26T00:15:00');
  expect(momentOf(care, 'bathroom_night', '2024-02-27')).toBe('2024-02-26T21:45:00');
  expect([momentOf(care, 'meals', '2024-02-26'), momentOf(care, null, '2024-02-27')]).toEqual(['2024-02-26T07:15:00', '2024-02-27T06:45:00']);
  expect(momentOf(care, 'density_morning', '2024-02-27')).toBe('2024-02-27T06:00:00');
});

test('the last two weeks stand beside the two before, and of a short log its halves', () => {
  expect(usualSpans({ days: days(40), day: '2024-04-05' })).toEqual([{ from: '2024-03-23', to: '2024-04-05' }, { from: '2024-03-09', to: '2024-03-22' }]);
  expect(usualSpans({ days: days(7), day: '2024-03-03' })).toEqual([{ from: '2024-03-01', to: '2024-03-03' }, { from: '2024-02-27', to: '2024-02-29' }]);
  expect(usualSpans({ days: [], day: null })).toBeNull();
});

test('what chance may make is about the same, and what is more is said in words', () => {
  const spans = [{ from: '2024-03-02', to: '2024-03-06' }, { from: '2024-02-26', to: '2024-03-01' }] as const;
  const words = (unit: MeasureChart['unit'], values: (number | null)[]) => compared({ charts: [chart('m', unit, values)] }, ...spans)[0]!;
  const wild = words('hours', [5, 9, 6, 8, 7, 9, 6, 8, 7, 9]);
  expect([wild.first.words, wild.second.words, wild.words, wild.is_more]).toEqual(['7.8 h', '7.0 h', 'about the same', null]);
  expect(words('hours', [7, 7, 7, 7, 7, 8, 8, 8.5, 8, 8]).words).toBe('1 hour 6 minutes more a day');
  expect(words('clock', [22, 22, 22, 22, 22, 21.5, 21.5, 21.5, 21.5, 21.5]).words).toBe('30 minutes earlier');
  expect(words('times', [3, 3, 3, 3, 3, 2, 2, 2, 2, 2]).words).toBe('1.0 fewer a day');
  const few = words('times', [3, 3, null, null, null, 2, 2, 2, 2, 2]);
  expect([few.words, few.is_more]).toEqual(['too few days', null]);
  expect(words('times', [null, null, null, null, null, 2, 2, 2, 2, 2]).second.words).toBe('no data');
});

test('a note that another page has written meanwhile is shown, and nothing is lost', async () => {
  const theirs: NoteView = { day: '2024-03-01', rule: '', seen: false, note: 'theirs' };
  const posted: NoteChange[] = [];
  let kept: NoteView[] = [];
  const noted = new Notes({
    json: <T>() => Promise.resolve(kept as T),
    post: <T>(_: string, body: unknown) => {
      posted.push(body as NoteChange);
      return kept.length > 0 ? Promise.reject<T>(new Refused(409, 'Somebody else has.')) : Promise.resolve([(body as NoteChange).note] as T);
    },
  });
  await noted.open('a');
  kept = [theirs];
  const done = noted.change(theirs, { note: 'mine' });
  expect(noted.of(theirs).note).toBe('mine');
  await done;
  expect([noted.of(theirs).note, noted.problem]).toEqual(['theirs', 'Somebody else has. The saved note is shown now. Enter yours again.']);
  kept = [];
  await noted.change(theirs, { note: 'both' });
  expect(posted.at(-1)).toEqual({ before: theirs, note: { ...theirs, note: 'both' } });
  expect([noted.of(theirs).note, noted.problem]).toEqual(['both', '']);
});
