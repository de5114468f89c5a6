// The recent ways of bodies.

import { type At, distance } from './geometry';
import type { RunFrame } from '../wire';

const KEPT_MS = 9000;
const LONGEST = 400;
/** Shorter steps are invisible. */
const STEP_M = 0.04;
/** A longer step is a jump: it leaves no trail, and ends the old one. */
const LEAP_M = 0.8;

export type Step = { at: At; since_ms: number };

export class Trails {
  /** By resident, the oldest first. */
  readonly of: Step[][] = [];

  take(frame: RunFrame, now_ms: number): void {
    frame.bodies.forEach((body, index) => {
      const steps = (this.of[index] ??= []);
      if (body === null) {
        steps.length = 0;
        return;
      }
      const last = steps.at(-1);
      const far = last === undefined ? Infinity : distance(last.at, body.at);
      if (far > LEAP_M) steps.length = 0;
      if (far > STEP_M) steps.push({ at: body.at, since_ms: now_ms });
      // In a hidden tab frames arrive, but no drawing fades them.
      if (steps.length > LONGEST) steps.splice(0, steps.length - LONGEST);
    });
  }

  /** @returns whether any step remains. */
  fade(now_ms: number): boolean {
    for (const steps of this.of) {
      let old = 0;
      while (old < steps.length && now_ms - steps[old]!.since_ms > KEPT_MS) old += 1;
      if (old > 0) steps.splice(0, old);
    }
    return this.of.some((steps) => steps.length > 1);
  }

  /** The strength of a step, from 1 to 0. */
  static left(step: Step, now_ms: number): number {
    return Math.max(1 - (now_ms - step.since_ms) / KEPT_MS, 0);
  }

  clear(): void {
    this.of.length = 0;
  }
}
