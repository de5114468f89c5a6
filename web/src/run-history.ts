// The page's history of the present run: firings of sensors, and activities and rooms of people. Parts that were not
// sent, as at the greatest speeds or after a jump, are missing, and the history knows when they were.

import { AWAY } from './activities';
import type { Unseen } from './charts/unseen';
import type { BodyView, FiringView, RunFrame, RunView } from './wire';

/** Length of the history. */
export const KEPT_US = 36 * 3_600e6;

/** Largest numbers of firings of a sensor, and of intervals of a person. */
const MOST = 10_000;

/** A longer gap between two frames is a jump, or was too fast to see: the activities in it are unknown (our choice). */
const SEEN_US = 600e6;

type Span = [begin: number, end: number, what: number];

export class RunHistory {
  /** By sensor, in order: its firings, and their values. */
  fired: number[][] = [];
  said: string[][] = [];
  /** By resident: activities and rooms, by their indices in `names` and in the home's rooms. */
  activities: Span[][] = [];
  rooms: Span[][] = [];
  /** The activities of all residents. */
  names: string[] = [];
  /** By sensor: intervals with firings that are not in `fired`. Together with the dropped ones, they add up to the server's counts. */
  missed: Unseen[][] = [];
  /** Intervals with unknown activities. */
  unseen: Unseen[] = [];
  private forgotten: number[] = [];
  /** By resident. */
  private visitors: boolean[] = [];
  from_us = 0;
  now_us = 0;
  private told = 0;

  clear({ home, residents }: Pick<RunView, 'home' | 'residents'>): void {
    this.fired = home.sensors.map(() => []);
    this.said = home.sensors.map(() => []);
    this.activities = residents.map(() => []);
    this.rooms = residents.map(() => []);
    this.names = [];
    // Visitors are named after their hosts.
    this.visitors = residents.map(({ name }) => residents.some((host) => name.startsWith(`${host.name}'s `)));
    this.missed = home.sensors.map(() => []);
    this.unseen = [];
    this.forgotten = home.sensors.map(() => 0);
    this.told = 0;
    this.from_us = this.now_us = -1;
  }

  take(frame: RunFrame): void {
    const { now_us, firings, counts } = frame;
    if (this.now_us < 0) this.from_us = Math.min(now_us, firings[0]?.at_us ?? now_us);
    else if (now_us < this.now_us || frame.told < this.told || (firings[0]?.seq ?? Infinity) < this.told) this.goBack(frame);
    this.told = frame.told;
    this.miss(counts, firings, Math.min(firings[0]?.at_us ?? now_us, now_us));
    for (const { sensor, at_us, value } of firings) {
      if (this.fired[sensor] === undefined) continue;
      this.fired[sensor].push(at_us);
      this.said[sensor]!.push(value);
    }
    if (now_us - this.now_us > SEEN_US) add(this.unseen, { from_us: Math.max(this.now_us, 0), to_us: now_us, missing: 0 });
    frame.bodies.forEach((body, who) => {
      const activity = this.doing(who, body);
      this.extend(this.activities[who], activity === '' ? null : this.nameOf(activity), now_us);
      this.extend(this.rooms[who], body?.room ?? null, now_us);
    });
    this.now_us = now_us;
    this.from_us = Math.max(this.from_us, now_us - KEPT_US);
    this.forget();
  }

  /** The activity of a person, also out of the home; visitors elsewhere have none. */
  doing(who: number, body: BodyView | null): string {
    if (body === null) return this.visitors[who] ? '' : AWAY;
    return body.activity ?? '';
  }

  private nameOf(activity: string): number {
    const known = this.names.indexOf(activity);
    return known >= 0 ? known : this.names.push(activity) - 1;
  }

  /** Extends the last value until now, if the last frame is recent. */
  private extend(spans: Span[] | undefined, what: number | null, now_us: number): void {
    if (spans === undefined) return;
    const last = spans.at(-1);
    const continues = last !== undefined && last[1] === this.now_us && now_us - this.now_us <= SEEN_US;
    if (continues) last[1] = now_us;
    if (what !== null && (!continues || last[2] !== what)) spans.push([now_us, now_us, what]);
    // An interval that ends with this frame ended before the next.
    if (continues && what === null) last[1] = now_us - 1;
  }

  /** Firings that the server counts and has not sent happened before the first that it sends. */
  private miss(counts: number[], firings: FiringView[], before_us: number): void {
    this.missed.forEach((parts, sensor) => {
      if (counts[sensor] === undefined) return;
      const known = parts.filter(({ missing }) => missing > 0);
      const fresh = firings.reduce((sum, firing) => sum + (firing.sensor === sensor ? 1 : 0), 0);
      const missing = counts[sensor] - this.forgotten[sensor]! - known.reduce((sum, part) => sum + part.missing, 0) - this.fired[sensor]!.length - fresh;
      // The count of a part that was cut is computed anew.
      const from_us = parts.reduce((from, part) => (part.missing > 0 ? from : Math.min(from, part.from_us)), Math.max(this.now_us, 0));
      this.missed[sensor] = known;
      if (missing > 0) add(known, { from_us, to_us: Math.max(before_us, from_us + 1), missing });
      // The run went back to before the dropped firings.
      else this.forgotten[sensor]! += missing;
    });
  }

  private forget(): void {
    const least = this.now_us - KEPT_US;
    this.fired.forEach((fired, sensor) => {
      let old = 0;
      while (old < fired.length && fired[old]! < least) old += 1;
      const most = Math.max(fired.length - MOST, old);
      if (most > old) add(this.missed[sensor]!, { from_us: fired[old]!, to_us: fired[most]!, missing: most - old });
      if (most > 0) [fired.splice(0, most), this.said[sensor]!.splice(0, most)];
      const gone = this.missed[sensor]!.filter(({ to_us }) => to_us < least);
      this.missed[sensor] = this.missed[sensor]!.filter(({ to_us }) => to_us >= least);
      this.forgotten[sensor]! += old + gone.reduce((sum, { missing }) => sum + missing, 0);
    });
    this.unseen = this.unseen.filter(({ to_us }) => to_us >= least);
    for (const spans of [...this.activities, ...this.rooms]) {
      let old = Math.max(spans.length - MOST, 0);
      while (old < spans.length && spans[old]![1] < least) old += 1;
      if (old > 0) spans.splice(0, old);
    }
  }

  /** The run went back: drops later firings, and does not keep repeated ones twice. */
  private goBack({ now_us, firings }: RunFrame): void {
    const again_us = firings[0]?.at_us ?? Infinity;
    this.fired.forEach((fired, sensor) => {
      fired.length = this.said[sensor]!.length = fired.filter((at) => at <= now_us && at < again_us).length;
      this.missed[sensor] = cut(this.missed[sensor]!, Math.min(now_us, again_us));
    });
    this.unseen = cut(this.unseen, now_us);
    for (const spans of [...this.activities, ...this.rooms]) {
      while ((spans.at(-1)?.[0] ?? -1) > now_us) spans.pop();
      const last = spans.at(-1);
      if (last !== undefined) last[1] = Math.min(last[1], now_us);
    }
    this.from_us = Math.min(this.from_us, now_us);
    this.now_us = Math.min(this.now_us, now_us);
  }
}

/** Adjacent intervals become one. */
function add(all: Unseen[], part: Unseen): void {
  const at = all.findIndex(({ to_us }) => to_us === part.from_us);
  if (at < 0) all.push(part);
  else all[at] = { from_us: all[at]!.from_us, to_us: part.to_us, missing: all[at]!.missing + part.missing };
}

/** The parts until an instant; the count of a part that is cut is unknown. */
function cut(all: Unseen[], until_us: number): Unseen[] {
  return all.flatMap((part) => (part.from_us >= until_us ? [] : part.to_us <= until_us ? [part] : [{ ...part, to_us: until_us, missing: 0 }]));
}
