// The fields of an element, with their values and explanations: read from the schema of the home's file, so that a new
// key has its field here, too.

import schema from '../../../../schemas/home.schema.json';
import { DEVICES } from '../../devices';
import type { Path } from '../../json';
import { type RootSchema, type Schema, aboutOf, resolved as resolvedIn } from '../../json-schema';
import { spoken } from '../../plan/words';
import type { Element, List, Value } from './model';

export type Unit = 'm' | '°' | 's' | '°C' | 'lx' | 'W' | '%' | '/min' | 'a second' | '';

export type Bounds = { least: number; most: number; whole: boolean };

type Option = { value: string; title: string; about: string };

export type Field = {
  path: Path;
  label: string;
  about: string;
  unit: Unit;
  required: boolean;
  /** The default. */
  fallback: unknown;
} & (
  | { form: 'text'; longest: number; long: boolean }
  | { form: 'number'; bounds: Bounds }
  | { form: 'flag' }
  | { form: 'choice'; options: Option[] }
  /** The name of another element of the home. */
  | { form: 'bearer' }
  /** A fixed number of numbers, each with a word. */
  | { form: 'numbers'; bounds: Bounds; words: string[] }
  /** Any number of numbers, within limits. */
  | { form: 'list'; bounds: Bounds; fewest: number; most: number }
  /** Any number of names of sensors, within limits. */
  | { form: 'names'; fewest: number; most: number }
  | { form: 'corners'; bounds: Bounds; fewest: number; most: number }
  /** One of several alternatives, each with fields of its own. */
  | { form: 'way'; options: (Option & { fields: Field[]; plain: boolean })[] }
);

const root = schema as unknown as RootSchema;

/** A longer suffix comes before one that it ends with. */
const UNITS: [suffix: string, unit: Unit][] = [
  ['_per_s', 'a second'], ['_m', 'm'], ['_deg', '°'], ['_s', 's'], ['_c', '°C'], ['_lux', 'lx'], ['_percent', '%'], ['_bpm', '/min'], ['_pm', '/min'],
];

/** The words of numbers in pairs and triples. */
const WORDS: Record<string, string[]> = {
  at: ['East', 'North'], from: ['East', 'North'], to: ['East', 'North'], size_m: ['Width', 'Depth'], field_deg: ['Across', 'Up and down'],
  rows: ['Far', 'Middle', 'Near'], pixels: ['Columns', 'Rows'],
};

/** Those that are lengths without a suffix. */
const METRES = new Set(['at', 'from', 'to']);

const LABELS: Record<string, string> = {
  at: 'Place', from: 'From', to: 'To', on: 'Attached to', facing_deg: 'Direction, from east', enterable: 'Residents can be in or on it', outside: 'Leads outside',
  level: 'Sees', preset: 'Device model', first_fire_s: 'First event', refire_s: 'Next events',
  notice: 'Notices',
};

/** The names of choices, if the file's word alone is unclear. */
const CHOICES: Record<string, string> = {
  'level paper': 'any change in a beam', 'level sensitivity': 'large changes only', 'level zones': 'changes between zones',
  'notice ': 'as the device does', 'notice all': 'every movement', 'notice chance': 'by chance',
  'role ': 'from its name',
  ...Object.fromEntries(DEVICES.map(({ key, name }) => [`preset ${key}`, name])),
};

const resolved = (of: Schema) => resolvedIn(root, of);

function unitOf(key: string): [Unit, string] {
  const found = UNITS.find(([suffix]) => key.endsWith(suffix));
  if (found) return [found[1], key.slice(0, -found[0].length)];
  return [key.endsWith('watts') ? 'W' : '', key];
}

function labelOf(key: string): string {
  const [, word] = unitOf(key);
  const label = LABELS[key] ?? spoken(word);
  return label.charAt(0).toUpperCase() + label.slice(1);
}

function bounds(of: Schema): Bounds {
  return { least: of.minimum ?? of.exclusiveMinimum ?? -1e6, most: of.maximum ?? 1e6, whole: of.type === 'integer' };
}

function field(key: string, raw: Schema, path: Path, required: boolean): Field | null {
  const of = resolved(raw);
  const [unit] = unitOf(key);
  const types = [of.type ?? []].flat();
  const about = aboutOf(of);
  const base = { path: [...path, key], label: labelOf(key), about, unit, required, fallback: of.default };
  if (key === 'on' || key === 'room') return { ...base, form: 'bearer' };
  if (of.oneOf) {
    const options = of.oneOf.map((one) => {
      const name = one.const ?? one.required?.[0] ?? '';
      const nested = one.const === undefined ? resolved(one.properties?.[name] ?? {}) : undefined;
      return { value: name, title: CHOICES[`${key} ${name}`] ?? spoken(name), about: one.description ?? '', plain: nested === undefined, fields: nested ? fieldsOfObject(nested, [...path, key, name]) : [] };
    });
    // An optional value without a default has a choice for leaving it out.
    const silence = { value: '', title: CHOICES[`${key} `] ?? 'nothing', about: '', plain: true, fields: [] };
    if (!required && of.default === undefined) options.unshift(silence);
    return options.every(({ plain }) => plain) ? { ...base, form: 'choice', options } : { ...base, form: 'way', options };
  }
  if (types.includes('string')) return { ...base, form: 'text', longest: of.maxLength ?? 4000, long: of.maxLength === undefined };
  if (types.includes('boolean')) return { ...base, form: 'flag' };
  if (types.includes('number') || types.includes('integer')) return { ...base, form: 'number', bounds: bounds(of) };
  if (!types.includes('array') || !of.items) return null;
  const [fewest, most] = [of.minItems ?? 0, of.maxItems ?? 1000];
  if (of.items.type === 'string') return { ...base, form: 'names', fewest, most };
  if (of.items.type === 'array') return { ...base, unit: 'm', form: 'corners', bounds: bounds(of.items.items ?? {}), fewest, most };
  if (fewest === most) return { ...base, unit: METRES.has(key) ? 'm' : unit, form: 'numbers', bounds: bounds(of.items), words: WORDS[key] ?? ['Minimum', 'Maximum'] };
  return { ...base, form: 'list', bounds: bounds(of.items), fewest, most };
}

function fieldsOfObject(of: Schema, path: Path): Field[] {
  return Object.entries(of.properties ?? {}).flatMap(([key, one]) => (key === 'kind' || key === '$schema' ? [] : (field(key, one, path, of.required?.includes(key) ?? false) ?? [])));
}

function schemaOf(list: List, value: Value): Schema | undefined {
  const of = resolved(root.properties![list]!.items!);
  return of.oneOf ? of.oneOf.find(({ properties }) => properties?.kind?.const === value.kind) : of;
}

export function fieldsOf({ list, index, value }: Element): Field[] {
  const of = schemaOf(list, value);
  return of ? fieldsOfObject(of, [list, index]) : [];
}

/** Whether elements of this list and kind have a key. */
export function takes({ list, value }: Pick<Element, 'list' | 'value'>, key: string): boolean {
  return schemaOf(list, value)?.properties?.[key] !== undefined;
}

/** The default of a key of a kind of sensor. */
export function usualOf(kind: string, key: string): unknown {
  return schemaOf('sensors', { kind })?.properties?.[key]?.default;
}

export function homeFields(): Field[] {
  const { name, about, latitude_deg } = root.properties!;
  return Object.entries({ name, about, latitude_deg }).flatMap(([key, one]) => (one && field(key, one, [], key === 'name')) ?? []);
}

/** The description of a kind of sensor. */
export function aboutKind(kind: string): string {
  return aboutOf(schemaOf('sensors', { kind }) ?? {});
}
