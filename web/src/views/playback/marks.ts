// The user's marks in a run; the browser stores them, and the server does not get them.

import { keep, read } from '../../browser-storage';

const storage = () => window.localStorage;
const nameOf = (run: string) => `homebody-marks/${run}`;
/** Largest number of marks of a run. */
const MOST = 500;

export function marksOf(run: string): number[] {
  try {
    const kept: unknown = JSON.parse(read(storage, nameOf(run)) ?? '[]');
    return Array.isArray(kept) ? kept.filter((one): one is number => Number.isFinite(one)).slice(0, MOST) : [];
  } catch {
    return [];
  }
}

export function keepMarks(run: string, marks: readonly number[]): void {
  keep(storage, nameOf(run), marks.length === 0 ? null : JSON.stringify(marks.slice(0, MOST)));
}
