// The fields of statements, read from their schema, so that a new field has its place in the form, too. The form changes
// single fields of a statement, and keeps all others.

import schema from '../../../../../schemas/statements.schema.json';
import { SAID } from '../../../activities';
import { type RootSchema, type Schema, aboutOf as describedAs, definitionOf, resolved as resolvedIn } from '../../../json-schema';
import type { Completion, StatementView } from '../../../wire';
import { type Amount, type Limits, type Trapezoid, isAfterMidnight, plain, setAfterMidnight } from './amounts';
import { choiceLabel, itemLabel, labelOf, onOff, severities } from './labels';

export type Statement = { kind: string } & Record<string, unknown>;

/** Names of the home, for fields that take one. */
export type Names = { places: readonly string[]; rooms: readonly string[]; things: readonly string[]; conditions: readonly string[]; person: string; /** The number of days of the run, and its first date. */ days: number; first: string };

/** The names among the words that a routine may use. */
export function namesOf(words: readonly Completion[], person: string, days = 0, first = ''): Names {
  const of = (kind: Completion['kind'], ...about: string[]) => words.filter((word) => word.kind === kind && (about.length === 0 || about.includes(word.about))).map(({ text }) => text);
  const conditions = of('condition').map((shown) => shown.replace(/^(mild|moderate|severe) /, '').replaceAll(' ', '-'));
  return { places: of('place', 'place', 'room'), rooms: of('place', 'room'), things: [...of('place', 'thing'), ...of('place', 'place')], conditions: [...new Set(conditions)], person, days, first };
}

/** What a text names. */
export type Naming = 'activity' | 'place' | 'room' | 'thing' | 'condition' | 'visitor' | 'day' | 'words';

type Base = {
  key: string;
  label: string;
  about: string;
  /** Whether the data always has it. */
  required: boolean;
  /** Whether it may be left open; a group that may not be is always shown. */
  nullable: boolean;
  fallback: unknown;
};

export type Field = Base &
  (
    | { form: 'trapezoid'; amount: Amount; limits: Limits }
    /** A number may have words, such as those of a severity. */
    | { form: 'number'; amount: Amount; limits: Limits; words: Readonly<Record<string, number>> | null }
    /** The words for yes and no, of a flag that is no box. */
    | { form: 'flag'; words: readonly [string, string] | null }
    | { form: 'text'; naming: Naming }
    | { form: 'choice'; options: Option[] }
    /** Any of some words. */
    | { form: 'set'; options: Option[] }
    | { form: 'list'; item: Field }
    /** A list of a fixed length. */
    | { form: 'items'; items: Field[] }
    | { form: 'group'; name: string; fields: Field[] }
    /** One of several alternatives, each with a field or none. */
    | { form: 'way'; options: (Option & { field: Field | null })[] }
  );

export type Option = { value: string; title: string; about: string };

const root = schema as unknown as RootSchema;
const kinds = root.definitions.Statement!.oneOf!;

/** The first fields of a group, or of a group of a kind of statement; the others are behind "More". A group without a row shows all. */
const MAIN: Readonly<Record<string, readonly string[]>> = {
  habit: ['activity', 'place', 'when'],
  sleep: ['activity', 'place', 'when'],
  away: ['activity', 'eats_out', 'when'],
  visit: ['visitor', 'does', 'key', 'when'],
  event: ['activity', 'place', 'falling', 'when'],
  change: ['effect', 'when'],
  thing: ['effect', 'when'],
  rule: ['whenever', 'lasts_s', 'only_if', 'response', 'then'],
  person: ['name', 'age_years', 'pace_mps'],
  When: ['days', 'time', 'lasts_s', 'chance'],
  'When of change': ['phase', 'days', 'chance'],
  'When of rule': ['phase', 'chance'],
  DaySelection: ['weekdays', 'every'],
  HabitChance: ['probability', 'days_a_week'],
};

/** The label of an activity, by its usual words. */
const labelOfWords = (words: string) => [...SAID].find(([, said]) => said === words)?.[0] ?? words;

/** The activities of kinds that have few. */
export const FEW_ACTIVITIES: Readonly<Record<string, readonly string[]>> = {
  sleep: ['gets up', 'goes to bed'].map(labelOfWords),
  away: ['leaves the apartment', 'comes home'].map(labelOfWords),
  event: ['falls', 'nearly falls'].map(labelOfWords),
};

const clockOf = (hours: number) => hours * 3600;
const clock = (hours: number) => plain(clockOf(hours), clockOf(hours), 'clock');
const minutes = (number: number) => plain(number * 60, number * 60, 'minutes');

/** Statements to begin with, without their kinds. */
const FIRST: Readonly<Record<string, Record<string, unknown>>> = {
  habit: { activity: labelOfWords('reads'), when: { time: { at: clock(10) }, lasts_s: minutes(30) } },
  sleep: { activity: labelOfWords('goes to bed'), when: { time: { at: clock(22.5) } } },
  away: { activity: labelOfWords('leaves the apartment'), when: { time: { at: clock(10) }, lasts_s: minutes(120) } },
  visit: { visitor: 'daughter', activity: labelOfWords('visits'), when: { time: { at: clock(14) }, lasts_s: minutes(120) } },
  event: { activity: labelOfWords('falls'), when: { chance: { days_a_week: 1 } } },
  change: { effect: { later: { activity: labelOfWords('gets up'), by_s: plain(3600, 3600, 'plain') } } },
  note: { text: '' },
};

/** The amount of a number, by the end of its path; the first match counts. */
const AMOUNTS: readonly [RegExp, Amount][] = [
  [/\/(at|until_s|between\/\d)$/, 'clock'],
  [/\/(lasts_s|lasts|by_s|later|after\/1|before\/1)$/, 'minutes'],
  [/\/(probability|becomes\/0)$/, 'percent'],
  [/_days$/, 'days'],
  [/\/after_m$/, 'metres'],
  [/\/(pace_mps|pace_each_week)$/, 'speed'],
  [/\/(pulse|respiration)$/, 'rate'],
  [/\/(factor|pace|irregular|days_differ|restless)$/, 'factor'],
];

/** The limits of numbers in the data, by the end of their path, where the schema has wider ones. */
const LIMITS: readonly [RegExp, Limits][] = [
  [/\/days_a_week$/, { least: 1, most: 7 }],
  [/\/every$/, { least: 1 }],
  [/\/of_month\/\d$/, { least: 0, most: 31 }],
  [/\/(by_s|pace_each_week|pulse|respiration)$/, {}],
  [/\/becomes\/0$/, { least: 0, most: 1 }],
  [/\/times\/\d$/, { least: 1 }],
];

function limitsOf({ minimum, maximum, type }: Schema, path: string): Limits {
  const whole = [type].flat().includes('integer');
  return { whole, ...(matchOf(LIMITS, path) ?? { least: minimum ?? 0, most: maximum }) };
}

/** What texts name, by the end of their path. */
const NAMINGS: readonly [RegExp, Naming][] = [
  [/\/(range\/place|dark)$/, 'room'],
  [/\/(place|at)$/, 'place'],
  [/\/(thing|thing_on|on|rings)$/, 'thing'],
  [/\/condition$/, 'condition'],
  [/\/(visitor|company)$/, 'visitor'],
];

const resolved = (of: Schema) => resolvedIn(root, of);
/** The description of a field for a person: those about the numbers and words of the data say nothing here. */
function aboutOf(of: Schema): string {
  const about = describedAs(of);
  return /\bseconds\b|\bNone\b|\[/i.test(about) ? '' : about;
}

const typesOf = (of: Schema) => [of.type ?? []].flat();

function matchOf<T>(rows: readonly [RegExp, T][], path: string): T | undefined {
  return rows.find(([form]) => form.test(path))?.[1];
}

/** The field of a schema at a path such as `/when/lasts_s`. */
function fieldOf(raw: Schema, key: string, path: string, label: string, required: boolean): Field {
  const of = resolved(raw);
  const name = definitionOf(raw) ?? key;
  const base: Base = { key, label, about: aboutOf(raw.description === undefined ? of : raw), required, nullable: isOptional(of) || isOptional(raw), fallback: of.default };
  // A trapezoid is explained by its fields.
  if (name === 'Fuzzy') return { ...base, about: raw.description === undefined ? '' : base.about, form: 'trapezoid', amount: matchOf(AMOUNTS, path) ?? 'plain', limits: limitsOf({}, path) };
  if (name === 'Activity') return { ...base, form: 'text', naming: 'activity' };
  if (name === 'PhaseDay') return { ...base, form: 'text', naming: 'day' };
  if (of.oneOf) return choiceOf(of, base, name, path);
  const options = optionsOf(of, key);
  if (options.length > 0) return { ...base, form: 'choice', options };
  const types = typesOf(of);
  if (types.includes('boolean')) return { ...base, form: 'flag', words: onOff(key) };
  if (types.includes('number') || types.includes('integer')) return { ...base, form: 'number', amount: matchOf(AMOUNTS, path) ?? 'plain', limits: limitsOf(of, path), words: severities(key) };
  if (types.includes('string')) return { ...base, form: 'text', naming: matchOf(NAMINGS, path) ?? 'words' };
  if (types.includes('array')) return listOf(of, base, path);
  return { ...base, form: 'group', name, fields: fieldsOf(of, path) };
}

function fieldsOf(of: Schema, path: string): Field[] {
  return Object.entries(of.properties ?? {}).flatMap(([key, one]) => (key === 'kind' && one.const !== undefined ? [] : [fieldOf(one, key, `${path}/${key}`, labelAt(`${path}/${key}`, key), of.required?.includes(key) ?? false)]));
}

/** The label of a field; the length of a rule is that of its trigger. */
function labelAt(path: string, key: string): string {
  return path === '/lasts_s' ? 'For at least' : path.endsWith('/turn/on') ? 'Turn it' : labelOf(key);
}

function optionsOf(of: Schema, key: string): Option[] {
  const words = of.enum ?? (of.const === undefined ? [] : [of.const]);
  return words.map((value) => ({ value, title: choiceLabel(key, value), about: of.enum ? '' : aboutOf(of) }));
}

/** What the titles of choices depend on. */
const CHOICE_OF: Readonly<Record<string, string>> = { HabitTime: 'time', RuleTrigger: 'trigger', Response: 'response', Effect: 'effect' };

function choiceOf(of: Schema, base: Base, name: string, path: string): Field {
  const what = CHOICE_OF[name] ?? base.key;
  const options = of.oneOf!.flatMap((one): (Option & { field: Field | null })[] => {
    const plainOnes = optionsOf(one, what);
    if (plainOnes.length > 0) return plainOnes.map((option) => ({ ...option, field: null }));
    const [key, inner] = Object.entries(one.properties ?? {})[0]!;
    // The words of the choice say what its field is.
    const field = fieldOf(inner, key, `${path}/${key}`, labelOf(key), !typesOf(inner).includes('null'));
    return [{ value: key, title: choiceLabel(what, key), about: aboutOf(one), field: { ...field, label: innerLabel(field) } }];
  });
  return options.every(({ field }) => field === null) ? { ...base, form: 'choice', options } : { ...base, form: 'way', options };
}

function innerLabel(field: Field): string {
  if (field.form === 'trapezoid') return field.amount === 'clock' ? 'Time of day' : 'Amount';
  if (field.form === 'text') return { activity: 'Activity', place: 'Place', room: 'Room', thing: 'Thing', condition: 'Condition', visitor: 'Who', day: 'Day', words: 'Words' }[field.naming];
  if (field.form === 'choice') return 'Which';
  return field.label;
}

function listOf(of: Schema, base: Base, path: string): Field {
  const items = of.items as Schema | Schema[] | undefined;
  if (Array.isArray(items)) {
    return { ...base, form: 'items', items: items.map((item, index) => fieldOf(item, base.key, `${path}/${index}`, itemLabel(base.key, index), !isOptional(item))) };
  }
  const item = fieldOf(items ?? {}, base.key, `${path}/0`, base.label, true);
  return item.form === 'choice' ? { ...base, form: 'set', options: item.options } : { ...base, form: 'list', item };
}

function isOptional(of: Schema): boolean {
  return typesOf(of).includes('null') || (of.anyOf?.some((one) => one.type === 'null') ?? false);
}

export type Group = Extract<Field, { form: 'group' }>;

/** Effects on things, which are statements of a kind of their own. */
const OF_THINGS: ReadonlySet<string> = new Set(['forgets', 'keeps_on', 'spares']);

/** The effects that a kind of statement has. */
function withOwnEffects(field: Field, kind: string): Field {
  if (field.key !== 'effect' || field.form !== 'way') return field;
  return { ...field, options: field.options.filter(({ value }) => OF_THINGS.has(value) === (kind === 'thing')) };
}

const groups = new Map<string, Group>(
  kinds.map((of) => {
    const kind = of.properties!.kind!.const!;
    const fields = fieldsOf(of, '').map((field) => withOwnEffects(field, kind));
    return [kind, { form: 'group', name: kind, key: kind, label: '', about: aboutOf(of), required: true, nullable: false, fallback: undefined, fields }];
  }),
);

/** All fields of a kind of statement. */
export function groupOf(kind: string): Group | undefined {
  return groups.get(kind);
}

/** The fields of a group that are shown at once, and those behind "More". */
export function parted({ name, fields }: Group, kind = ''): { main: Field[]; more: Field[] } {
  const first = MAIN[`${name} of ${kind}`] ?? MAIN[name];
  if (first === undefined) return { main: fields, more: [] };
  const main = first.flatMap((key) => fields.filter((field) => field.key === key));
  return { main, more: fields.filter((field) => !main.includes(field)) };
}

/** A thing of the home to begin with. */
function usualThing({ things }: Names): string {
  return things.find((name) => /stove|cooker/i.test(name)) ?? things[0] ?? '';
}

/** A day in the middle of the run, at most its 40th. */
export function dayInside({ days }: Names): string {
  return `day ${days === 0 ? 1 : Math.min(40, Math.ceil(days / 2))}`;
}

/** A name as it is known, whatever its case and the space around it. */
export function knownName(text: string, naming: Naming, offered: readonly string[]): string {
  const written = text.trim();
  const known = offered.find((one) => one.toLowerCase() === written.toLowerCase()) ?? written;
  return naming === 'activity' ? labelOfWords(known) : known;
}

/** The gain of an aversion, as the sentences have it. */
const SHY_GAIN = 1.5;

/** Flags that are off at first. */
const UNUSUAL: ReadonlySet<string> = new Set(['slowly', 'very']);

/** A value to begin with. */
export function freshValue(field: Field, names: Names): unknown {
  switch (field.form) {
    case 'trapezoid':
      return { clock: plain(43_200, 43_200, 'clock'), minutes: plain(1800, 1800, field.key === 'by_s' ? 'plain' : 'minutes'), speed: plain(0.7, 0.7, 'speed'), factor: plain(1.5, 1.5, 'factor'), rate: plain(5, 5, 'rate'), percent: null, days: null, metres: null, plain: plain(1, 1, 'plain') }[field.amount];
    case 'number':
      if (field.key === 'gain') return SHY_GAIN;
      return { clock: 43_200, percent: 0.5, days: 7, metres: 50, minutes: 1800, speed: 1, factor: 1, rate: 1, plain: 1 }[field.amount];
    case 'flag':
      return !UNUSUAL.has(field.key);
    case 'text':
      return { activity: labelOfWords('reads'), place: names.places[0] ?? '', room: names.rooms[0] ?? '', thing: usualThing(names), condition: names.conditions[0] ?? '', visitor: field.required ? 'daughter' : null, day: dayInside(names), words: '' }[field.naming];
    case 'choice':
      return field.options[0]!.value;
    case 'set':
    case 'list':
      return [];
    case 'items':
      // A time that has come has passed until midnight.
      if (field.key === 'between') return [clockOf(12), clockOf(24)];
      return field.items.map((item) => (item.required ? freshValue(item, names) : null));
    case 'group':
      return Object.fromEntries(field.fields.filter(({ required }) => required).map((inner) => [inner.key, freshValue(inner, names)]));
    case 'way': {
      const { value, field: inner } = field.options[0]!;
      return ofWay(value, inner, names);
    }
  }
}

/** The data of an alternative. */
export function ofWay(value: string, inner: Field | null, names: Names): unknown {
  return inner === null ? value : { [value]: inner.form === 'text' && !inner.required ? null : freshValue(inner, names) };
}

/** The alternative of a value. */
export function wayOf(value: unknown): { chosen: string; inner: unknown } {
  if (typeof value === 'string') return { chosen: value, inner: undefined };
  if (typeof value !== 'object' || value === null) return { chosen: '', inner: undefined };
  const [chosen, inner] = Object.entries(value)[0] ?? ['', undefined];
  return { chosen, inner };
}

/** A statement of a kind to begin with. */
export function firstOf(kind: string, names: Names): Statement {
  const first = FIRST[kind];
  if (kind === 'change') return { kind, when: { phase: { from: dayInside(names) } }, ...structuredClone(first) };
  if (first !== undefined) return fitted({ kind, ...structuredClone(first) }, 'activity', names) as Statement;
  const fields = freshValue(groupOf(kind)!, names) as Record<string, unknown>;
  if (kind === 'person') return { kind, name: names.person, age_years: 80 };
  const thing = usualThing(names);
  if (kind === 'thing') return { kind, when: { chance: { probability: 0.05 } }, effect: { forgets: { thing } } };
  if (kind === 'rule') return { kind, whenever: { on: thing }, lasts_s: plain(1200, 1200, 'minutes'), response: { turn: { thing, on: false } } };
  return { kind, ...fields };
}

/** Triggers that happen in a moment, and so have no length. */
const MOMENTS: ReadonlySet<string> = new Set(['rings', 'done', 'between', 'follows', 'wakes']);

/** What effects need to be sentences: a chance, or a time. */
const WHEN_OF_EFFECT: Readonly<Record<string, Record<string, unknown>>> = {
  forgets: { chance: { probability: 0.05 } },
  keeps_on: { time: { within: 'night' } },
  spares: {},
  skips: { chance: { probability: 0.2 } },
  days_are: { chance: { probability: 0.2 } },
};

/** A statement after a change of a field, without what does not fit it any more. */
export function fitted(statement: Record<string, unknown>, key: string, names: Names): Record<string, unknown> {
  if (key === 'whenever' && MOMENTS.has(wayOf(statement.whenever).chosen)) return withKey(statement, 'lasts_s', undefined);
  if (key === 'when') {
    const when = (statement.when ?? {}) as { time?: { at?: Trapezoid }; until_s?: Trapezoid | null; nights?: number };
    const [at, until] = [when.time?.at, when.until_s];
    if (!at || !until || when.nights || isAfterMidnight(at)) return statement;
    // From 23:00 until 01:00 ends on the next day.
    const clockTime = setAfterMidnight(until, false);
    return { ...statement, when: { ...when, until_s: setAfterMidnight(until, clockTime.from < at.from) } };
  }
  if (key === 'effect') {
    const { chance: _, time: __, lasts_s: ___, ...rest } = (statement.when ?? {}) as Record<string, unknown>;
    return { ...statement, when: { ...rest, ...WHEN_OF_EFFECT[wayOf(statement.effect).chosen] } };
  }
  if (statement.kind === 'event' && key === 'activity') {
    const fall = groupOf('event')!.fields.find((field) => field.key === 'falling')!;
    return withKey(statement, 'falling', statement.activity === labelOfWords('falls') ? (statement.falling ?? freshValue(fall, names)) : undefined);
  }
  return statement;
}

/** Another value of a key; an undefined one is removed. */
export function withKey(of: Record<string, unknown>, key: string, value: unknown): Record<string, unknown> {
  if (value !== undefined) return { ...of, [key]: value };
  const { [key]: _, ...rest } = of;
  return rest;
}

const isObject = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);

/** The pointers of the parts of a value that a field does not show; they are kept. */
export function unshown(field: Field, value: unknown, pointer = ''): string[] {
  if (value === undefined || value === null) return [];
  switch (field.form) {
    case 'trapezoid':
      return isObject(value) && ['low', 'from', 'to', 'high'].every((key) => typeof value[key] === 'number') && Object.keys(value).length === 4 ? [] : [pointer];
    case 'number':
      return typeof value === 'number' ? [] : [pointer];
    case 'flag':
      return typeof value === 'boolean' ? [] : [pointer];
    case 'text':
      return typeof value === 'string' ? [] : [pointer];
    case 'choice':
      return field.options.some((option) => option.value === value) ? [] : [pointer];
    case 'set':
      return Array.isArray(value) && value.every((one) => field.options.some((option) => option.value === one)) ? [] : [pointer];
    case 'list':
      return Array.isArray(value) ? value.flatMap((one, index) => unshown(field.item, one, `${pointer}/${index}`)) : [pointer];
    case 'items':
      return Array.isArray(value) && value.length === field.items.length ? value.flatMap((one, index) => unshown(field.items[index]!, one, `${pointer}/${index}`)) : [pointer];
    case 'group': {
      if (!isObject(value)) return [pointer];
      return Object.entries(value).flatMap(([key, one]) => {
        const inner = field.fields.find((of) => of.key === key);
        if (inner !== undefined) return unshown(inner, one, `${pointer}/${key}`);
        return pointer === '' && key === 'kind' ? [] : [`${pointer}/${key}`];
      });
    }
    case 'way': {
      const { chosen, inner } = wayOf(value);
      const option = field.options.find((one) => one.value === chosen);
      if (option === undefined || (isObject(value) && Object.keys(value).length !== 1)) return [pointer];
      return option.field === null ? [] : unshown(option.field, inner, `${pointer}/${chosen}`);
    }
  }
}

/** The place of a cursor: line and column from 1, the column in characters. */
export type TextPlace = { line: number; column: number };

/** The numbers of the statements whose sentence has a place; without one there, those of a sentence of its line. */
export function atPlace(all: readonly StatementView[], { line, column }: TextPlace): number[] {
  const places = all.flatMap(({ places }) => places.filter((place) => place.line === line));
  const distance = (place: { column: number; length: number }) => Math.max(place.column - column, column - (place.column + place.length), 0);
  const nearest = places.toSorted((a, b) => distance(a) - distance(b))[0];
  if (nearest === undefined) return [];
  return all.flatMap(({ places }, number) => (places.some((place) => place.line === line && place.column === nearest.column) ? [number] : []));
}

/** The words for a field, by its JSON pointer. */
export function nameOf(pointer: string): string {
  const bounds: Record<string, string> = { low: 'never below', high: 'never above', from: 'from', to: 'to' };
  const keys = pointer.split('/').filter((part) => part !== '' && !/^\d+$/.test(part));
  return keys.map((key, index) => (index > 0 && index === keys.length - 1 && bounds[key] !== undefined ? bounds[key] : labelAt(`/${keys.slice(0, index + 1).join('/')}`, key))).join(', ');
}
