// The position in a stored run: it plays, skips quiet intervals, and waits for days that have not arrived.

import { type Day, spanAt } from './day';
import { clockOf, dayAt, instantOf } from '../../localtime';
import type { Stored } from './stored';

export class Ticker {
  now_us = 0;
  playing = false;
  speed = 1;
  skip = false;
  /** Without truth, a run without messages counts as quiet. */
  alone = false;

  constructor(public run: Stored) {}

  get over(): boolean {
    return this.now_us >= this.run.view.length_us;
  }

  /** At the run's end it restarts at the day's beginning. */
  play(): void {
    if (this.over) this.now_us = this.today.begin_us;
    this.playing = this.run.view.length_us > 0;
  }

  get number(): number {
    return dayAt(this.run.view, this.now_us);
  }

  get today() {
    return this.run.view.days[this.number]!;
  }

  go(to_us: number): void {
    if (Number.isFinite(to_us)) this.now_us = Math.min(Math.max(to_us, 0), this.run.view.length_us);
  }

  /** Advances by seconds of the watcher's time. */
  step(seconds: number): void {
    if (!this.playing) return;
    const day = this.run.at(this.now_us);
    // Time stands still without the day.
    if (day === null) return;
    const { end_us } = this.today;
    let next = this.now_us + seconds * this.speed * 1e6;
    if (this.skip) next = Math.max(next, this.awake(day, Math.min(next, end_us)));
    // Each day ends at its end, so that no day is skipped unseen.
    this.now_us = Math.min(next, end_us);
    if (this.over) this.playing = false;
  }

  /** The end of the quiet interval at an instant. */
  private awake(day: Day, at_us: number): number {
    return spanAt(this.alone ? day.quiet : day.still, at_us)?.[1] ?? at_us;
  }

  /** Moves by days, at the same time of the clock if possible. */
  turn(days: number): void {
    const { view } = this.run;
    const number = Math.min(Math.max(this.number + days, 0), view.days.length - 1);
    if (number === this.number) {
      this.now_us = days < 0 ? 0 : view.length_us;
      return;
    }
    const wanted = clockOf(view, this.now_us) + (number - this.number) * 86_400_000;
    const { begin_us, end_us } = view.days[number]!;
    this.now_us = Math.min(Math.max(instantOf(view, wanted) ?? (days < 0 ? begin_us : end_us - 1), begin_us), end_us - 1);
  }

  /** The start of the next or the last activity of any resident; for located people, of a stay in a room. */
  activity(forward: boolean): boolean {
    const day = this.run.at(this.now_us);
    const { spans: done, walk } = this.run.view;
    const spans = walk === null ? [...done.flat(), ...(day?.view.lives.flatMap(({ activities }) => activities) ?? [])] : walk.stays.flat();
    // A grace of a second: asking for the last one during playback means the one before.
    const found = spans.map(([begin]) => begin).filter((begin) => (forward ? begin > this.now_us : begin < this.now_us - 1e6));
    if (found.length === 0) return false;
    this.go(found.reduce((a, b) => (forward ? Math.min(a, b) : Math.max(a, b))));
    return true;
  }
}
