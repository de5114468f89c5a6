// Made from RunOptions in crates/homebody-simulation/src/run_options.rs.

import type { RunOptions } from './wire';

export type RunOption = {
  /** A type of JSON Schema. */
  type: 'array' | 'boolean' | 'integer' | 'number' | 'object' | 'string';
  /** Of its field; missing for an option that the form of the page does not offer. */
  label?: string;
  help: string;
  least?: number;
  /** In place of the least value. */
  above?: number;
  most?: number;
  /** A regular expression that the whole text matches. */
  pattern?: string;
  /** The expected values, in words. */
  expected?: string;
};

export const RUN_OPTIONS: Readonly<Record<keyof RunOptions, RunOption>> = {
  days: { type: 'number', label: "Length in days", help: "Duration of the run in days (default: that of the scenario)", expected: "more than 0 and at most 36,525 (a hundred years)", above: 0, most: 36525 },
  start: { type: 'string', label: "Start", help: "Start of the run in the home's local time: now, today, 2026-11-01 or 2026-11-01T08:00 (default: the start in the scenario)", pattern: "^(now|today|\\d{4}-\\d\\d-\\d\\d([T ]\\d\\d:\\d\\d(:\\d\\d)?)?)$", expected: "now, today, a date, or a date and time, such as '2009-03-02T00:00:00'" },
  seed: { type: 'integer', label: "Seed", help: "Seed of all random numbers (default: that of the scenario)", least: 0, most: 9007199254740991 },
  without: { type: 'array', help: "Leave out a condition of the routine; repeatable", expected: "a list of conditions" },
  numbers: { type: 'object', label: "Parameters", help: "Parameters of the models by name, such as gait.slowest=0.25; the command homebody parameters lists all", expected: "a mapping of parameters of the models, such as {'life.day_spread': 0.3}" },
  one_of_many: { type: 'boolean', label: "Residents differ from their routines", help: "Let the residents differ from their routines as people differ, each seed in its own way" },
};
