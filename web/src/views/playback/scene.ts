// The scene of a stored run at an instant, in the form of a plan's frame.

import type { BodyView, HomeView, RunFrame } from '../../wire';
import { bodiesAt } from './bodies';
import { type Day, lit } from './day';
import type { Stored } from './stored';

/** Doors have the state of the home: a log does not know better. */
export function doorsOpen(home: HomeView): number[] {
  const open = new Set(home.doors.filter((door) => door.open).map((door) => door.name));
  return home.things.flatMap((thing, index) => (thing.kind === 'door' && open.has(thing.name) ? [index] : []));
}

export function frameAt(run: Stored, day: Day | null, at_us: number, before_us: number, how: { playing: boolean; speed: number; truth: boolean; on: number[] }): RunFrame {
  const bodies: (BodyView | null)[] = day && how.truth ? bodiesAt(run.view, day, at_us) : run.view.residents.map(() => null);
  const seeing = day ? lit(day, at_us) : [];
  // A ring begins only around firings since the last picture, not around those that a jump passes over.
  const fresh = day && how.playing && at_us > before_us && at_us - before_us < 2_000_000 * Math.max(how.speed, 1)
    ? seeing.filter((sensor) => day.fired[sensor]!.some((at) => at > before_us && at <= at_us))
    : [];
  return {
    now_us: at_us,
    clock: '',
    state: how.playing ? 'playing' : 'paused',
    speed: how.speed,
    bodies,
    seeing,
    on: how.on,
    sun: 1,
    told: 0,
    counts: [],
    looks: [],
    firings: fresh.map((sensor) => ({ seq: 0, at_us, sensor, value: '', row: null })),
  };
}
