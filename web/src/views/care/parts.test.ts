import { expect, test } from 'vitest';
import { Refused } from '../../server';
import type { CareDay, MeasureChart, NoteChange, NoteView } from '../../wire';
import { madeUpEpisode } from '../../testing/care';
import { listedRun as run } from '../../testing/stored';
import { described, monthsOf, stepped } from './calendar';
import { between, inFull, monthsLater, shifted, spanInWords, weekday } from './dates';
import { absenceInWords, courseInWords, episodeOn, inOrder, limitInWords, ratiosInWords, referenceInWords, seenWithInWords, writtenBy } from './episodes';
import { momentOf } from './moment';
import { Notes } from './notes.svelte';
import { firstTried } from './runs';
import { aroundDay, changed, compared, overlap, presetsOf } from './spans';

const chart = (measure: string, unit: MeasureChart['unit'], values: (number | null)[], little = 0.5): MeasureChart => ({
  measure, title: measure, group: 'night', unit, little, is_guess: false, days: values.map((value, index) => ({ day: shifted('2024-02-26', index), value, usual: null })),
});
const days = (count: number, first = '2024-02-26'): CareDay[] => Array.from({ length: count }, (_, index) => ({ day: shifted(first, index), known: 'whole', told: [] }));

test('days are counted over leap days and ends of months', () => {
  expect([shifted('2024-02-28', 2), shifted('2024-01-01', -1), monthsLater('2024-01-31', 1), monthsLater('2024-01-31', -2)]).toEqual(['2024-03-01', '2023-12-31', '2024-02-29', '2023-11-30']);
  expect([weekday('2024-02-26'), weekday('2024-03-03'), between('2024-02-28', '2024-03-01'), inFull('2024-02-29')]).toEqual([0, 6, 2, 'Thursday 29 February 2024']);
});

test('a span of days has the parts of a date in which its ends differ', () => {
  const spans = [['2009-03-02', '2009-03-29'], ['2009-02-27', '2009-03-29'], ['2008-12-30', '2009-01-02'], ['2009-03-02', '2009-03-02']] as const;
  expect(spans.map(([from, to]) => spanInWords(from, to))).toEqual(['2 to 29 March 2009', '27 February to 29 March 2009', '30 December 2008 to 2 January 2009', '2 March 2009']);
});

test('a month has whole weeks from Monday, no day twice, and the marks of its days', () => {
  const episode = { ...madeUpEpisode(0, 1, null, 8), since: '2024-03-01', found: '2024-03-02' };
  const notes: NoteView[] = [{ day: '2024-03-02', about: 'episode', seen: true, note: 'x', who: '', at: '' }, { day: '2024-03-03', about: 'reference', seen: true, note: '', who: '', at: '' }];
  const months = monthsOf({ days: days(8), episodes: [episode] }, notes);
  expect(months.map(({ title, weeks }) => [title, weeks.length])).toEqual([['February 2024', 1], ['March 2024', 2]]);
  const cells = months.flatMap(({ weeks }) => weeks.flatMap((week) => week.days)).filter((cell) => cell !== null);
  expect(cells.map(({ day }) => day)).toEqual(days(8).map(({ day }) => day));
  expect(described(cells[3]!)).toBe('Thursday 29 February 2024, nothing unusual');
  expect(described(cells[5]!)).toBe('Saturday 2 March 2024, within the change since 1 March, a change was found, with a note');
  expect(described(cells[6]!)).toBe('Sunday 3 March 2024, within the change since 1 March, a comparison begins');
  expect(monthsOf({ days: [], episodes: [] }, [])).toEqual([]);
});

test('an episode has its days from the first until it is over', () => {
  const over = madeUpEpisode(10, 14, 30, 90);
  const open = madeUpEpisode(45, 50, null, 90);
  const care = { episodes: [open, over] };
  expect([over.since, over.over, shifted(over.over!, -1)].map((day) => episodeOn(care, day!)?.found)).toEqual([over.found, undefined, over.found]);
  expect([shifted(open.since, -1), '2030-01-01'].map((day) => episodeOn(care, day)?.found)).toEqual([undefined, open.found]);
  expect([courseInWords(over), courseInWords(open)]).toEqual(['over since 1 April 2009', 'still growing']);
});

test('open episodes are before those that were dealt with, and before those that are over', () => {
  const [over, dealt, open] = [madeUpEpisode(10, 14, 30, 90), madeUpEpisode(31, 35, null, 90), madeUpEpisode(45, 50, null, 90)];
  expect(inOrder([dealt, over, open], (episode) => episode === dealt)).toEqual([open, dealt, over]);
  expect(inOrder([dealt, over, open], () => false)).toEqual([dealt, open, over]);
});

test('conditions are named in careful words', () => {
  const seen = [{ condition: 'depression', likelihood_ratio: 4.21 }, { condition: 'other_thing', likelihood_ratio: 2 }];
  expect(seenWithInWords(seen, 'Ada')).toBe('In simulated lives, such signs are seen with low mood (depression) or other thing. Ask Ada; this is no diagnosis.');
  expect(seenWithInWords(seen.slice(0, 1), 'the residents')).toContain('Ask them; this is no diagnosis.');
  expect(ratiosInWords(seen)).toContain('4.2 for depression, 2.0 for other thing');
});

test('a short reference says what cannot be seen yet', () => {
  const reference = (count: number) => ({ from: '2009-03-02', to: shifted('2009-03-02', count - 1), days: count, is_marked: false });
  expect([null, reference(6), reference(7), reference(27), reference(28)].map((one) => limitInWords(one).split(':')[0])).toEqual(['No change can be seen yet', 'No change can be seen yet', 'Only large changes can be seen yet', 'Only large changes can be seen yet', '']);
  expect([referenceInWords(reference(28)), referenceInWords(reference(1))]).toEqual(['Compared with 2 to 29 March 2009 (28 complete days)', 'Known so far: 2 March 2009 (1 complete day)']);
  expect(referenceInWords(null)).toContain('no complete day');
});

test('absences and notes are sentences', () => {
  expect([absenceInWords({ from: '2009-07-13', to: '2009-07-16' }), absenceInWords({ from: '2009-07-13', to: '2009-07-13' })]).toEqual(['Away from 13 to 16 July 2009', 'Away on 13 July 2009']);
  expect([writtenBy({ who: 'Eve', at: '2009-03-02T14:05' }), writtenBy({ who: '', at: '2009-03-02T14:05' }), writtenBy({ who: 'Eve', at: '' }), writtenBy({ who: '', at: '' })]).toEqual(['by Eve on 2 March 2009 at 14:05', 'on 2 March 2009 at 14:05', 'by Eve', '']);
});

test('the newest finished run of a week or more opens first, and a run that continues never', () => {
  const runs = [run('now', 30), run('short', 1), run('long', 90), run('older', 90)];
  expect(firstTried(runs, [{ name: 'log', log: 'log.csv' }], 'now')).toEqual(['long', 'older', 'short', 'log']);
  expect(firstTried([run('now', 1)], [], 'now')).toEqual([]);
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

test('presets have periods that the log has, and that do not overlap', () => {
  const reference = { from: '2024-02-26', to: '2024-03-24', days: 28, is_marked: false };
  const names = (length: number, to = 28) => presetsOf({ days: days(length), day: days(length).at(-1)!.day, reference: { ...reference, to: shifted(reference.from, Math.min(to, length) - 1) } }).map(({ name }) => name);
  expect([names(400), names(90), names(15), names(7), names(3)]).toEqual([['reference', 'month', 'year'], ['reference', 'month'], ['halves'], ['halves'], []]);
  for (const length of [7, 10, 20, 29, 31, 40, 90, 400]) {
    const of = days(length);
    for (const { spans } of presetsOf({ days: of, day: of.at(-1)!.day, reference })) {
      expect(overlap(...spans), `${length} days`).toBe(false);
      expect([spans[1].from >= of[0]!.day, spans[0].to <= of.at(-1)!.day], `${length} days`).toEqual([true, true]);
    }
  }
  const [first] = presetsOf({ days: days(90), day: days(90).at(-1)!.day, reference });
  expect(first!.spans).toEqual([{ from: '2024-05-12', to: '2024-05-25' }, { from: '2024-02-26', to: '2024-03-24' }]);
  expect(presetsOf({ days: [], day: null, reference: null })).toEqual([]);
});

test('the days around a day, and own periods, stay within the log', () => {
  const care = { days: days(40), day: '2024-04-05' };
  expect(aroundDay(care, '2024-03-15')).toEqual([{ from: '2024-03-15', to: '2024-04-05' }, { from: '2024-02-26', to: '2024-03-14' }]);
  expect(aroundDay(care, '2024-02-27')).toBeNull();
  const span = { from: '2024-03-01', to: '2024-03-05' };
  expect([changed(care, span, 'from', '2020-01-01'), changed(care, span, 'from', '2024-03-09'), changed(care, span, 'to', '2030-01-01')]).toEqual([
    { from: '2024-02-26', to: '2024-03-05' }, { from: '2024-03-09', to: '2024-03-09' }, { from: '2024-03-01', to: '2024-04-05' },
  ]);
});

test('what chance may make is about the same, and what is more is said in words', () => {
  const spans = [{ from: '2024-03-02', to: '2024-03-06' }, { from: '2024-02-26', to: '2024-03-01' }] as const;
  const words = (unit: MeasureChart['unit'], values: (number | null)[]) => compared({ charts: [chart('m', unit, values)] }, ...spans)[0]!;
  const wild = words('hours', [5, 9, 6, 8, 7, 9, 6, 8, 7, 9]);
  expect([wild.first.words, wild.second.words, wild.words, wild.is_more]).toEqual(['7.8 h', '7.0 h', 'about the same', null]);
  expect(words('hours', [7, 7, 7, 7, 7, 8, 8, 8.5, 8, 8]).words).toBe('1 hour 6 minutes more a day');
  expect(words('clock', [22, 22, 22, 22, 22, 21.5, 21.5, 21.5, 21.5, 21.5]).words).toBe('30 minutes earlier');
  expect(words('times', [3, 3, 3, 3, 3, 2, 2, 2, 2, 2]).words).toBe('1.0 fewer a day');
  expect(words('amount', [300, 300, 300, 300, 300, 200, 200, 200, 200, 200]).words).toBe('33 % less');
  const few = words('times', [3, 3, null, null, null, 2, 2, 2, 2, 2]);
  expect([few.words, few.is_more]).toEqual(['too few days', null]);
  expect(words('times', [null, null, null, null, null, 2, 2, 2, 2, 2]).second.words).toBe('no data');
});

test('a note that another page has written meanwhile is shown, and nothing is lost', async () => {
  const theirs: NoteView = { day: '2024-03-01', about: 'day', seen: false, note: 'theirs', who: 'Eve', at: '2024-03-02T09:00' };
  const storage = new Map<string, string>();
  const keeper = () => ({ getItem: (name: string) => storage.get(name) ?? null, setItem: (name: string, value: string) => void storage.set(name, value), removeItem: (name: string) => void storage.delete(name) });
  const posted: NoteChange[] = [];
  let kept: NoteView[] = [];
  const noted = new Notes({
    json: <T>() => Promise.resolve(kept as T),
    post: <T>(_: string, body: unknown) => {
      posted.push(body as NoteChange);
      return kept.length > 0 ? Promise.reject<T>(new Refused(409, 'Somebody else has.')) : Promise.resolve([(body as NoteChange).note] as T);
    },
  }, keeper);
  noted.be('Adam');
  await noted.open('a');
  kept = [theirs];
  const done = noted.change(theirs, { note: 'mine' });
  expect(noted.of(theirs).note).toBe('mine');
  await done;
  expect([noted.of(theirs).note, noted.problem]).toEqual(['theirs', 'Somebody else has. The saved note is shown now. Enter yours again.']);
  kept = [];
  await noted.change(theirs, { note: 'both' });
  expect(posted.at(-1)).toEqual({ before: theirs, note: { ...theirs, note: 'both', who: 'Adam', at: '' } });
  expect([noted.of(theirs).note, noted.problem]).toEqual(['both', '']);
  expect(new Notes({ json: () => Promise.reject(), post: () => Promise.reject() }, keeper).who).toBe('Adam');
});
