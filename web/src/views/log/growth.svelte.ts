// The growing log of the present run, requested about once a second.

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
  /** The present day. */
  number: number;
  /** By sensor: its firings on that day. */
  fired: number[][];
  until_us: number;
  /** Number of firings of the day that are not in `fired`. */
  leftOut: number;
};

export class Growth {
  now = $state.raw<Grown | null>(null);
  problem = $state('');
  private asking = false;
  /** The run and its time at the last request: without progress, there is no request. */
  private last: { run: RunView; now_us: number } | null = null;

  constructor(private readonly live: Pick<Live, 'run' | 'latest' | 'server'>) {}

  /** @returns a function that ends the requests. */
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
      // A run that has ended meanwhile is not shown under the name of the next.
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
  // The answer may be from before or after the last frame, and from another day.
  const last = view.today.at(-1)?.[0];
  const until_us = Math.max(now_us, last ?? 0);
  return {
    run, fired, until_us, leftOut: view.left_out,
    density: { days: run.days, hours, until_us, most: scaleOf(hours) },
    number: dayAt(run, last ?? now_us),
  };
}

export function lanesOf(sensors: SensorView[], fired: number[][], byKind: boolean): Lane[] {
  if (!byKind) return sensors.map(({ name, kind }, index) => ({ name, kind, fired: fired[index] ?? [] }));
  const kinds = [...new Set(sensors.map(({ kind }) => kind))];
  return kinds.map((kind) => ({
    name: kindOf(kind).word,
    kind,
    fired: sensors.flatMap((sensor, index) => (sensor.kind === kind ? (fired[index] ?? []) : [])).sort((a, b) => a - b),
  }));
}
