import { expect, test } from 'vitest';
import page from '../../../../../docs/reference/statements.md?raw';
import { type Trapezoid, faultOf, hasOwnBounds, isTurned, plain, read, setAfterMidnight, shown, withSingle, withSpread, withUsual } from './amounts';
import { KINDS } from './labels';
import { SAID } from '../../../activities';
import { FEW_ACTIVITIES, type Field, type Names, type Statement, atPlace, firstOf, fitted, freshValue, groupOf, knownName, nameOf, namesOf, ofWay, parted, unshown, wayOf, withKey } from './model';

const NAMES: Names = { places: ['armchair', 'room'], rooms: ['room'], things: ['stove'], conditions: ['depression'], person: 'Walter', days: 7, first: '2009-05-01' };

const kinds = Object.keys(KINDS);
const EXAMPLES = [...page.matchAll(/```json\n(.*?)\n```/g)].map(([, json]) => JSON.parse(json!) as Statement);

/** The value as a user leaves it who visits every field and writes the text that is shown there. */
function visited(field: Field, value: unknown): unknown {
  if (value === undefined || value === null) return value;
  switch (field.form) {
    case 'trapezoid': {
      const now = value as Trapezoid;
      const again = (of: number) => read(shown(of, field.amount), field.amount, of)!;
      return { low: again(now.low), from: again(now.from), to: again(now.to), high: again(now.high) };
    }
    case 'number':
      return read(shown(value as number, field.amount), field.amount, value as number);
    case 'group':
      return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, key === 'kind' && field.key === field.name ? one : visited(field.fields.find((of) => of.key === key)!, one)]));
    case 'way': {
      const { chosen, inner } = wayOf(value);
      const option = field.options.find((one) => one.value === chosen)!;
      return option.field === null ? chosen : { [chosen]: visited(option.field, inner) };
    }
    case 'items':
      return (value as unknown[]).map((one, index) => visited(field.items[index]!, one));
    case 'list':
      return (value as unknown[]).map((one) => visited(field.item, one));
    default:
      return value;
  }
}

/** Up to the accuracy of floating point. */
function rounded(value: unknown): unknown {
  return JSON.parse(JSON.stringify(value), (_, one: unknown) => (typeof one === 'number' ? Number(one.toPrecision(9)) : one));
}

function all(field: Field, path: string[] = []): string[] {
  const inner = field.form === 'group' ? field.fields : field.form === 'way' ? field.options.flatMap((one) => one.field ?? []) : field.form === 'items' ? field.items : field.form === 'list' ? [field.item] : [];
  return [[...path, field.key].join('/'), ...inner.flatMap((one) => all(one, [...path, field.key]))];
}

test('every example of the reference has a field for all that it says, and comes back as it was', () => {
  expect(EXAMPLES.length).toBe(9);
  for (const example of EXAMPLES) {
    const group = groupOf(example.kind)!;
    expect(unshown(group, example), JSON.stringify(example)).toEqual([]);
    expect(rounded(visited(group, example))).toEqual(rounded(example));
  }
});

test('no field speaks of seconds', () => {
  const texts = (field: Field): string[] => {
    const own = [field.label, field.about];
    if (field.form === 'group') return [...own, ...field.fields.flatMap(texts)];
    if (field.form === 'way') return [...own, ...field.options.flatMap(({ title, about, field }) => [title, about, ...(field ? texts(field) : [])])];
    return field.form === 'items' ? [...own, ...field.items.flatMap(texts)] : field.form === 'list' ? [...own, ...texts(field.item)] : own;
  };
  for (const kind of kinds) expect(texts(groupOf(kind)!).filter((text) => /seconds|None|_s\b/i.test(text))).toEqual([]);
});

test('what has no field is named and stays', () => {
  const example = EXAMPLES.find(({ kind }) => kind === 'habit')!;
  const strange = { ...example, mood: 'calm', when: { ...(example.when as object), time: { at: 'noonish' }, days: { weekdays: ['funday'] } } };
  expect(unshown(groupOf('habit')!, strange)).toEqual(['/when/days/weekdays', '/when/time/at', '/mood']);
  expect(withKey(strange, 'place', 'bed')).toEqual({ ...strange, place: 'bed' });
  expect(withKey({ place: 'bed', activity: 'reading' }, 'place', undefined)).toEqual({ activity: 'reading' });
});

test('every field of every kind is in the form, at once or behind “More”', () => {
  expect(kinds.toSorted()).toEqual(['away', 'change', 'event', 'habit', 'note', 'person', 'rule', 'sleep', 'thing', 'visit']);
  for (const kind of kinds) {
    const group = groupOf(kind)!;
    const { main, more } = parted(group);
    expect([...main, ...more].map(({ key }) => key).sort()).toEqual(group.fields.map(({ key }) => key).sort());
    expect(main.length).toBeGreaterThan(0);
  }
  const paths = all(groupOf('rule')!);
  for (const path of ['rule/whenever/between/between', 'rule/only_if/only_if/state/dark', 'rule/response/do/lasts', 'rule/lapse/later', 'rule/when/phase/fading_days']) expect(paths).toContain(path);
});

test('a new statement of each kind, and of each choice, has only fields of the form', () => {
  for (const kind of kinds) expect(unshown(groupOf(kind)!, firstOf(kind, NAMES))).toEqual([]);
  const choices = (field: Field): void => {
    if (field.form === 'way') for (const option of field.options) if (option.field) expect(unshown(option.field, freshValue(option.field, NAMES))).toEqual([]);
    if (field.form === 'group') field.fields.forEach(choices);
  };
  kinds.forEach((kind) => choices(groupOf(kind)!));
});

test('the activities of the form are those of the table', () => {
  for (const label of Object.values(FEW_ACTIVITIES).flat()) expect(SAID.has(label), label).toBe(true);
  for (const kind of kinds) {
    const { activity } = firstOf(kind, NAMES);
    if (activity !== undefined) expect(SAID.has(String(activity)), kind).toBe(true);
  }
});

test('times are hours and minutes, lengths are minutes, and shares are percent', () => {
  expect([shown(69_900, 'clock'), shown(90_000, 'clock'), shown(7920.000000000001, 'minutes'), shown(0.05, 'percent')]).toEqual(['19:25', '01:00', '132', '5']);
  expect([read('19:25', 'clock'), read('7', 'clock'), read('1930', 'clock'), read('01:00', 'clock', 90_000), read('24:00', 'clock')]).toEqual([69_900, 25_200, 70_200, 90_000, 86_400]);
  expect([read('25:00', 'clock'), read('12:60', 'clock'), read('soon', 'clock'), read('', 'minutes')]).toEqual([null, null, null, null]);
  expect([read('1,5', 'minutes'), read('7', 'percent')]).toEqual([90, 0.07]);
});

test('other usual values keep the outer bounds that were stated', () => {
  const length = plain(1800, 1800, 'minutes');
  expect(length).toEqual({ low: 1620, from: 1800, to: 1800, high: 1980 });
  expect(withSingle(length, 3600, 'minutes')).toEqual(plain(3600, 3600, 'minutes'));
  expect(withUsual(length, 'to', 2400, 'minutes')).toEqual({ low: 1800, from: 1800, to: 2400, high: 2400 });
  const wide = withSpread(plain(36_000, 36_000, 'clock'), 1800);
  expect([wide, plain(36_000, 36_000, 'clock'), plain(36_000, 39_600, 'clock')].map((value) => hasOwnBounds(value, 'clock'))).toEqual([true, false, false]);
  expect(withSingle(wide, 39_600, 'clock')).toEqual({ low: 37_800, from: 39_600, to: 39_600, high: 41_400 });
  expect(setAfterMidnight(setAfterMidnight(wide, true), false)).toEqual(wide);
});

test('the sentence at the cursor is found, with all its statements', () => {
  const statement = (line: number, column: number, length: number) => ({ places: [{ line, column, length }], statement: {}, sentences: [] });
  const found = [statement(1, 1, 10), statement(1, 12, 20), statement(1, 12, 20), { places: [{ line: 1, column: 40, length: 5 }, { line: 3, column: 3, length: 9 }], statement: {}, sentences: [] }];
  expect(atPlace(found, { line: 1, column: 4 })).toEqual([0]);
  expect(atPlace(found, { line: 1, column: 20 })).toEqual([1, 2]);
  expect(atPlace(found, { line: 3, column: 1 })).toEqual([3]);
  expect(atPlace(found, { line: 2, column: 1 })).toEqual([]);
});

test('fields have plain names', () => {
  expect([nameOf('/when/lasts_s/high'), nameOf('/effect/later/by_s'), nameOf('/only_if/0/state')]).toEqual(['When, Length, never above', 'Change, Later, By', 'Only if, State']);
  const words = [{ text: 'bed', kind: 'place', about: 'place' }, { text: 'stove', kind: 'place', about: 'thing' }, { text: 'severe heart failure', kind: 'condition', about: 'condition' }] as const;
  expect(namesOf(words, 'Agnes')).toEqual({ places: ['bed'], rooms: [], things: ['stove', 'bed'], conditions: ['heart-failure'], person: 'Agnes', days: 0, first: '' });
});

test('one end of a range never changes the other, and a second value before the first is a fault', () => {
  const morning = plain(28_800, 28_800, 'clock');
  for (const typed of [3600, 36_000]) expect(withUsual(morning, 'to', typed, 'clock').from).toBe(28_800);
  expect(isTurned(withUsual(plain(57_600, 57_600, 'clock'), 'to', 54_000, 'clock'))).toBe(true);
  expect(isTurned(withUsual(plain(1800, 1800, 'minutes'), 'to', 240, 'minutes'))).toBe(true);
  expect(isTurned(withUsual(plain(1800, 1800, 'minutes'), 'to', 2700, 'minutes'))).toBe(false);
});

test('the end of a range across midnight is on the next day', () => {
  const night = withUsual(plain(82_800, 82_800, 'clock'), 'to', 3600, 'clock');
  expect([night.from, night.to]).toEqual([82_800, 90_000]);
  const evening = withUsual(night, 'from', 72_000, 'clock');
  expect([evening.from, evening.to]).toEqual([72_000, 90_000]);
  expect(withUsual(evening, 'to', 79_200, 'clock').to).toBe(79_200);
});

test('an end before the beginning is on the next day', () => {
  const until = (at: number, end: number) => (fitted({ kind: 'habit', when: { time: { at: plain(at, at, 'clock') }, until_s: plain(end, end, 'clock') } }, 'when', NAMES).when as { until_s: Trapezoid }).until_s.from;
  expect([until(82_800, 3600), until(36_000, 90_000), until(36_000, 43_200)]).toEqual([90_000, 3600 + 86_400, 43_200]);
});

test('a text that is no value of its field is named', () => {
  expect(faultOf('25:00', 'clock', {})).toBe('Write a time such as 14:30.');
  expect([faultOf('1.5', 'days', { whole: true, least: 1 }), faultOf('-1', 'plain', { whole: true, least: 1, most: 7 })]).toEqual(['Write a whole number, 1 or more.', 'Write a whole number from 1 to 7.']);
  expect([faultOf('100.5', 'percent', { least: 0, most: 1 }), faultOf('3.3', 'percent', { least: 0, most: 1 })]).toEqual(['Write a number from 0 to 100.', '']);
  for (const large of ['1e308', '1e307', '-1e308']) expect(faultOf(large, 'minutes', {})).toBe('Write a number.');
  expect(faultOf('11:00', 'clock', { most: 36_000 })).toBe('Write a time up to 10:00.');
});

test('the limits of fields are those of the data', () => {
  const inner = (field: Field, ...keys: string[]): Field => keys.reduce((of, key) => (of.form === 'group' ? of.fields.find((one) => one.key === key)! : of.form === 'items' ? of.items[Number(key)]! : of), field);
  const limits = (...keys: string[]) => (inner(groupOf('habit')!, 'when', ...keys) as Extract<Field, { form: 'number' }>).limits;
  expect(limits('chance', 'probability')).toMatchObject({ least: 0, most: 1 });
  expect(limits('chance', 'days_a_week')).toMatchObject({ whole: true, least: 1, most: 7 });
  expect(limits('days', 'every')).toMatchObject({ whole: true, least: 1 });
});

test('names are known whatever their case', () => {
  expect([knownName(' Bedroom ', 'place', ['bedroom']), knownName('READS', 'activity', ['reads']), knownName('fixes clocks', 'activity', ['reads'])]).toEqual(['bedroom', 'reading', 'fixes clocks']);
});

/** The statements that the form begins with, after each choice of the user. */
function beginnings(): Statement[] {
  const firsts = kinds.filter((kind) => kind !== 'note').map((kind) => firstOf(kind, NAMES));
  const chosen = (kind: string, key: string) => {
    const field = groupOf(kind)!.fields.find((one) => one.key === key) as Extract<Field, { form: 'way' }>;
    return field.options.map((option) => fitted({ ...firstOf(kind, NAMES), [key]: ofWay(option.value, option.field, NAMES) }, key, NAMES) as Statement);
  };
  const stumble = fitted({ ...firstOf('event', NAMES), activity: FEW_ACTIVITIES.event![1] }, 'activity', NAMES) as Statement;
  return [...firsts, stumble, ...chosen('rule', 'whenever'), ...chosen('rule', 'response'), ...chosen('thing', 'effect'), ...chosen('change', 'effect')];
}

// A test of the server reads them.
test('the statements to begin with are those that the server has read', async () => {
  const text = `[\n${beginnings().map((one) => `  ${JSON.stringify(one)}`).join(',\n')}\n]\n`;
  await expect(text).toMatchFileSnapshot('../../../testing/first-statements.json');
  expect(groupOf('thing')!.fields.find(({ key }) => key === 'effect')).toMatchObject({ options: [{ value: 'forgets' }, { value: 'keeps_on' }, { value: 'spares' }] });
});
