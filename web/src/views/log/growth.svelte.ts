// What the log of the run that is being lived has got so far, asked about once a second while it grows.

import { type Density, scaleOf } from '../../charts/density';
import type { Lane } from '../../charts/lanes';
import type { Live } from '../../live.svelte';
import { dayAt } from '../../localtime';
import { kindOf } from '../../plan/kinds';
import { said } from '../../server';
import type { LiveCountsView, RunView, SensorView } from '../../wire';

const EVERY_MS = 1000;

export type Grown = {
  run: RunView;
  density: Density;
  /** The day that is being lived. */
  number: number;
  /** By sensor: when it fired on that day. */
  fired: number[][];
  until_us: number;
  /** How many firings of the day are not in `fired`. */
  leftOut: number;
};

export class Growth {
  now = $state.raw<Grown | null>(null);
  problem = $state('');
  private asking = false;
  /** What it was when it was last asked: while nothing moves on, nothing is asked. */
  private last: { run: RunView; now_us: number } | null = null;

  constructor(private readonly live: Pick<Live, 'run' | 'latest' | 'server'>) {}

  /** @returns how to stop. */
  begin(): () => void {
    void this.look();
    const timer = setInterval(() => void this.look(), EVERY_MS);
    return () => clearInterval(timer);
  }

  async look(): Promise<void> {
    const { run, latest } = this.live;
    if (run === null || latest === null || this.asking) return;
    if (this.last !== null && this.last.run === run && this.last.now_us === latest.now_us) return;
    this.asking = true;
    const asked = { run, now_us: latest.now_us };
    try {
      const view = await this.live.server.json<LiveCountsView>('/api/growth');
      // Of a run that has ended meanwhile nothing is shown under the name of the next.
      if (this.live.run !== run) return;
      this.now = grown(run, view, this.live.latest?.now_us ?? asked.now_us);
      this.problem = '';
      this.last = asked;
    } catch (error) {
      this.problem = said(error);
    } finally {
      this.asking = false;
    }
  }
}

export function grown(run: RunView, view: LiveCountsView, now_us: number): Grown {
  const hours = run.days.map((_, day) => view.hours[day] ?? []);
  const fired: number[][] = run.home.sensors.map(() => []);
  for (const [at, sensor] of view.today) fired[sensor]?.push(at);
  // What is told may be of a moment before or after the last frame, and another day.
  const last = view.today.at(-1)?.[0];
  const until_us = Math.max(now_us, last ?? 0);
  return {
    run, fired, until_us, leftOut: view.left_out,
    density: { days: run.days, hours, until_us, most: scaleOf(hours) },
    number: dayAt(run, last ?? now_us),
  };
}

/** A lane for each sensor, or for each kind of them. */
export function lanesOf(sensors: SensorView[], fired: number[][], byKind: boolean): Lane[] {
  if (!byKind) return sensors.map(({ name, kind }, index) => ({ name, kind, fired: fired[index] ?? [] }));
  const kinds = [...new Set(sensors.map(({ kind }) => kind))];
  return kinds.map((kind) => ({
    name: kindOf(kind).word,
    kind,
    fired: sensors.flatMap((sensor, index) => (sensor.kind === kind ? (fired[index] ?? []) : [])).sort((a, b) => a - b),
  }));
}
