// What somebody has marked in a run; the browser keeps it, and the server is told nothing.

import { keep, read } from '../../kept';

const storage = () => window.localStorage;
const nameOf = (run: string) => `homebody-marks/${run}`;
/** So many are kept of a run. */
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
