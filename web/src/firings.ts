// The firings that arrived: the last few hundred for the table, the last ten minutes for the time line, and the counts
// of each sensor. Firings that are reported but not sent are counted, never ignored.

import type { FiringView, RunFrame } from './wire';

/** A firing, or a number of firings without details. */
type Row = { firing: FiringView } | { missing: number; until_us: number };

const KEPT = 500;

export const LANE_US = 600_000_000;

/** A lane with more ticks is a solid bar. */
const KEPT_A_LANE = 4000;

export class Firings {
  /** Oldest first. */
  rows: Row[] = [];
  /** By sensor: the instants of its firings within the last ten minutes. */
  lanes: number[][] = [];
  /** By sensor: its firings since the start of the run. */
  counts: number[] = [];
  /** Grows with every row, also when old rows are dropped. */
  added = 0;
  now_us = 0;
  private told: number | null = null;

  clear(sensors: number): void {
    this.rows = [];
    this.lanes = Array.from({ length: sensors }, () => []);
    this.counts = [];
    this.added = 0;
    this.now_us = 0;
    this.told = null;
  }

  /** Returns the new firings of the frame. */
  take(frame: RunFrame): FiringView[] {
    if (frame.now_us < this.now_us || (this.told !== null && frame.told < this.told)) this.goBack(frame);
    this.now_us = frame.now_us;
    const missing = frame.told - (this.told ?? 0) - frame.firings.length;
    this.told = frame.told;
    this.counts = frame.counts;
    if (missing > 0) this.push({ missing, until_us: frame.now_us });
    for (const firing of frame.firings) {
      this.push({ firing });
      (this.lanes[firing.sensor] ??= []).push(firing.at_us);
    }
    this.forget();
    return frame.firings;
  }

  private push(row: Row): void {
    this.rows.push(row);
    this.added += 1;
  }

  private forget(): void {
    if (this.rows.length > KEPT) this.rows.splice(0, this.rows.length - KEPT);
    const from = this.now_us - LANE_US;
    for (const lane of this.lanes) {
      let old = Math.max(lane.length - KEPT_A_LANE, 0);
      while (old < lane.length && lane[old]! < from) old += 1;
      if (old > 0) lane.splice(0, old);
    }
  }

  /** The run went back: drops later firings, and does not keep repeated ones twice. */
  private goBack(frame: RunFrame): void {
    const again = frame.firings[0]?.seq ?? Infinity;
    const from_us = frame.firings[0]?.at_us ?? Infinity;
    this.rows = this.rows.filter((row) =>
      'firing' in row ? row.firing.seq < again && row.firing.at_us <= frame.now_us : row.until_us <= frame.now_us,
    );
    this.lanes = this.lanes.map((lane) => lane.filter((at) => at <= frame.now_us && at < from_us));
    this.told = frame.told - frame.firings.length;
    this.added += 1;
  }
}
