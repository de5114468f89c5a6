// What this page has seen of the run that is being lived: which sensors fired when, and what everybody did where. What was told of but
// not shown, as at the greatest speeds, is not in it.

import type { Frame, RunView } from './wire';

/** So far back it is kept. */
export const KEPT_US = 36 * 3_600e6;

/** Of a sensor no more firings are kept, of a person no more spans. */
const MOST = 10_000;

type Span = [begin: number, end: number, what: number];

export class Lived {
  /** By sensor, in order, and what was said with each. */
  fired: number[][] = [];
  said: string[][] = [];
  /** By resident: what they did and in which room they were, by the numbers of `names` and of the home's rooms. */
  activities: Span[][] = [];
  rooms: Span[][] = [];
  /** What was done by anybody. */
  names: string[] = [];
  from_us = 0;
  now_us = 0;

  clear({ home, residents }: Pick<RunView, 'home' | 'residents'>): void {
    this.fired = home.sensors.map(() => []);
    this.said = home.sensors.map(() => []);
    this.activities = residents.map(() => []);
    this.rooms = residents.map(() => []);
    this.names = [];
    this.from_us = this.now_us = -1;
  }

  take(frame: Frame): void {
    const { now_us } = frame;
    if (this.now_us < 0) this.from_us = Math.min(now_us, frame.firings[0]?.at_us ?? now_us);
    else if (now_us < this.now_us) this.goBack(now_us);
    for (const { sensor, at_us, value } of frame.firings) {
      const last = this.fired[sensor]?.at(-1);
      // A firing may be told of twice after the run was taken back.
      if (this.fired[sensor] === undefined || (last !== undefined && at_us <= last)) continue;
      this.fired[sensor].push(at_us);
      this.said[sensor]!.push(value);
    }
    frame.bodies.forEach((body, who) => {
      this.goOn(this.activities[who], body?.activity == null || body.activity === '' ? null : this.nameOf(body.activity), now_us);
      this.goOn(this.rooms[who], body?.room ?? null, now_us);
    });
    this.now_us = now_us;
    this.from_us = Math.max(this.from_us, now_us - KEPT_US);
    this.forget();
  }

  private nameOf(activity: string): number {
    const known = this.names.indexOf(activity);
    return known >= 0 ? known : this.names.push(activity) - 1;
  }

  /** What was so at the last look is taken to have been so until now. */
  private goOn(spans: Span[] | undefined, what: number | null, now_us: number): void {
    if (spans === undefined) return;
    const last = spans.at(-1);
    const goes_on = last !== undefined && last[1] === this.now_us;
    if (goes_on) last[1] = now_us;
    if (what !== null && (!goes_on || last[2] !== what)) spans.push([now_us, now_us, what]);
    // What ended at this look ended before the next.
    if (goes_on && what === null) last[1] = now_us - 1;
  }

  private forget(): void {
    const least = this.now_us - KEPT_US;
    this.fired.forEach((fired, sensor) => {
      let old = Math.max(fired.length - MOST, 0);
      while (old < fired.length && fired[old]! < least) old += 1;
      if (old > 0) [fired.splice(0, old), this.said[sensor]!.splice(0, old)];
    });
    for (const spans of [...this.activities, ...this.rooms]) {
      let old = Math.max(spans.length - MOST, 0);
      while (old < spans.length && spans[old]![1] < least) old += 1;
      if (old > 0) spans.splice(0, old);
    }
  }

  /** The run was taken back: what is not yet so any more is forgotten. */
  private goBack(now_us: number): void {
    this.fired.forEach((fired, sensor) => {
      const kept = fired.filter((at) => at <= now_us).length;
      fired.length = this.said[sensor]!.length = kept;
    });
    for (const spans of [...this.activities, ...this.rooms]) {
      while ((spans.at(-1)?.[0] ?? -1) > now_us) spans.pop();
      const last = spans.at(-1);
      if (last !== undefined) last[1] = Math.min(last[1], now_us);
    }
    this.from_us = Math.min(this.from_us, now_us);
    this.now_us = now_us;
  }
}
