// The fields for the options of the next run. Each field has a text, or `yes` for a switch that is on; an empty field is as the
// scenario says.

import { RUN_OPTIONS, type RunOption } from '../../run-options';
import type { RunOptions } from '../../wire';

type Name = keyof RunOptions;
type Value = RunOptions[Name];

export type Fields = Partial<Record<Name, string>>;

/** The options that have a field, in order. */
export const OFFERED = (Object.entries(RUN_OPTIONS) as [Name, RunOption][]).flatMap(([name, option]) => (option.label === undefined ? [] : [{ name, ...option, label: option.label }]));

/** The options of the fields, and the messages of wrong fields. */
export function read(fields: Fields): { options: Partial<RunOptions>; wrong: Fields } {
  const options: Partial<Record<Name, Value>> = {};
  const wrong: Fields = {};
  for (const { name, ...option } of OFFERED) {
    const text = fields[name]?.trim() ?? '';
    if (text === '') continue;
    const value = valueOf(text, option);
    if (value === undefined) wrong[name] = `Expected ${expected(option)}.`;
    else options[name] = value;
  }
  return { options: options as Partial<RunOptions>, wrong };
}

/** Undefined for a text that is not a value of the option. */
function valueOf(text: string, option: RunOption): Value | undefined {
  switch (option.type) {
    case 'boolean':
      return true;
    case 'object': {
      const lines = text.split(/[\n,]/).map((line) => line.trim()).filter((line) => line !== '');
      const pairs = lines.map((line) => line.split('=').map((part) => part.trim()));
      const entries = new Map(pairs.map(([name = '', value = '']) => [name, Number(value)]));
      const isValid = entries.size === pairs.length && pairs.every((pair) => pair.length === 2 && !pair.includes('')) && [...entries.values()].every(Number.isFinite);
      return isValid ? Object.fromEntries(entries) : undefined;
    }
    case 'string':
      return option.pattern === undefined || new RegExp(option.pattern).test(text) ? text : undefined;
    default: {
      const { least = -Infinity, above = -Infinity, most = Infinity } = option;
      const value = Number(text);
      return value >= least && value > above && value <= most && (option.type === 'number' || Number.isInteger(value)) ? value : undefined;
    }
  }
}

function expected({ type, least = 0, most = 0, expected = '' }: RunOption): string {
  if (type === 'object') return 'NAME=VALUE on each line, each name once, with a number as the value';
  return type === 'integer' ? `a whole number from ${least.toLocaleString('en')} to ${most.toLocaleString('en')}` : expected;
}
