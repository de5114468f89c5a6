// Names of stored runs that distinguish two of one scenario.

import { spoken } from '../../plan/words';
import type { StoredView } from '../../wire';

/** A run's own name, after its description, and the conditions that it was simulated without. */
export function runName({ name, about, without }: Pick<StoredView, 'name' | 'about' | 'without'>): string {
  const own = about.title !== '' ? `${about.title.slice(0, 60)} (${name.slice(0, 40)})` : name.slice(0, 60);
  return [own, withoutOf({ without })].filter(Boolean).join(' ');
}

/** `without depression`; empty for a run with all conditions. */
export function withoutOf({ without }: Pick<StoredView, 'without'>): string {
  return without.length > 0 ? `without ${spoken(without.join(', ').slice(0, 60))}` : '';
}

/** The length of a run; unknown while it continues. */
export function lengthOf({ name, days }: Pick<StoredView, 'name' | 'days'>, ongoing: string | null): string {
  if (name === ongoing) return 'running';
  return days === 1 ? '1 day' : `${days} days`;
}

/** The start and length of a run. */
export function spanOf(run: Pick<StoredView, 'name' | 'start' | 'days'>, ongoing: string | null): string {
  return `${run.start.slice(0, 10)}, ${lengthOf(run, ongoing)}`;
}
