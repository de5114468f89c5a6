// What somebody noted about alerts: kept in the browser, by run.

import { type Keeper, keep, read } from '../../kept';
import type { AlertView } from '../../wire';

export interface Noted {
  /** Whether somebody has seen to it. */
  seen: boolean;
  note: string;
}

const KEY = 'homebody-care';

function all(keeper: () => Keeper): Record<string, Record<string, Noted>> {
  try {
    const kept: unknown = JSON.parse(read(keeper, KEY) ?? '{}');
    return typeof kept === 'object' && kept !== null ? (kept as Record<string, Record<string, Noted>>) : {};
  } catch {
    return {};
  }
}

/** What an alert is known by. */
export function keyOf(alert: Pick<AlertView, 'day' | 'rule'>): string {
  return `${alert.day} ${alert.rule}`;
}

/** What was noted about the alerts of a run. */
export function notedOf(keeper: () => Keeper, run: string): Record<string, Noted> {
  const kept = all(keeper);
  return Object.hasOwn(kept, run) ? kept[run]! : {};
}

/** Notes something about an alert; nothing of it is left where there is no note and nobody has seen to it. */
export function note(keeper: () => Keeper, run: string, alert: Pick<AlertView, 'day' | 'rule'>, noted: Noted): void {
  const kept = all(keeper);
  const { [keyOf(alert)]: _, ...others } = Object.hasOwn(kept, run) ? kept[run]! : {};
  const of_run = noted.seen || noted.note !== '' ? { ...others, [keyOf(alert)]: noted } : others;
  keep(keeper, KEY, JSON.stringify({ ...kept, [run]: of_run }));
}
