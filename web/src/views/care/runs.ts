// The run that the care view opens first.

import type { KeptLogView, StoredView } from '../../wire';

/** Days from which on a run shows changes, and the number of runs that are tried (our choice). */
const [ENOUGH_DAYS, MOST_TRIED] = [7, 3];

/** The newest finished run that is long enough, then shorter ones; a run that continues may not have written anything yet. */
export function firstTried(runs: readonly StoredView[], logs: readonly KeptLogView[], ongoing: string | null): string[] {
  const finished = runs.filter(({ name }) => name !== ongoing);
  const isLong = ({ days }: StoredView) => days >= ENOUGH_DAYS;
  const tried = [...finished.filter(isLong), ...finished.filter((run) => !isLong(run))].slice(0, MOST_TRIED);
  return [...tried, ...logs.slice(0, 1)].map(({ name }) => name);
}
