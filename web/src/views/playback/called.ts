// What stored runs are called, so that two of one scenario are told apart.

import { spoken } from '../../plan/words';
import type { StoredView } from '../../wire';

/** A run's own name, behind the one that somebody gave it, and the conditions that it was lived without. */
export function calledOf({ name, about, without }: Pick<StoredView, 'name' | 'about' | 'without'>): string {
  const own = about.title !== '' ? `${about.title.slice(0, 60)} (${name.slice(0, 40)})` : name.slice(0, 60);
  return [own, withoutOf({ without })].filter(Boolean).join(' ');
}

/** `without depression`; nothing of a run that was lived with all there is. */
export function withoutOf({ without }: Pick<StoredView, 'without'>): string {
  return without.length > 0 ? `without ${spoken(without.join(', ').slice(0, 60))}` : '';
}

/** How long a run is; of one that is being lived nobody knows how long it will be. */
export function lengthOf({ name, days }: Pick<StoredView, 'name' | 'days'>, goesOn: string | null): string {
  if (name === goesOn) return 'running';
  return days === 1 ? '1 day' : `${days} days`;
}

/** When a run begins and how long it is. */
export function spanOf(run: Pick<StoredView, 'name' | 'start' | 'days'>, goesOn: string | null): string {
  return `${run.start.slice(0, 10)}, ${lengthOf(run, goesOn)}`;
}
