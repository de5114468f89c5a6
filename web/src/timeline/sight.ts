// The visible interval of a run: it is zoomed about an instant, moved, and stays within the whole.

import type { Sight } from '../charts/axis';

/** The shortest visible interval. */
export const LEAST_US = 1e6;

/** Factor of a step of the wheel or a key. */
export const STEP = 1.35;

export function spanOf({ from_us, to_us }: Sight): number {
  return to_us - from_us;
}

/** At least a second, at most the whole, and within it. */
export function within({ from_us, to_us }: Sight, whole: Sight): Sight {
  const span = Math.min(Math.max(to_us - from_us, LEAST_US), Math.max(spanOf(whole), LEAST_US));
  const from = Math.min(Math.max(from_us, whole.from_us), Math.max(whole.to_us - span, whole.from_us));
  return { from_us: from, to_us: from + span };
}

/** Zooms by a factor; the instant stays where it is on the screen. */
export function zoomed(sight: Sight, times: number, at_us: number, whole: Sight): Sight {
  const share = (at_us - sight.from_us) / Math.max(spanOf(sight), 1);
  const span = Math.min(Math.max(spanOf(sight) * times, LEAST_US), Math.max(spanOf(whole), LEAST_US));
  const from = at_us - share * span;
  return within({ from_us: from, to_us: from + span }, whole);
}

export function moved(sight: Sight, by_us: number, whole: Sight): Sight {
  return within({ from_us: sight.from_us + by_us, to_us: sight.to_us + by_us }, whole);
}

/** Of the same length, and with the instant in it: playing past the end turns the page. */
export function following(sight: Sight, at_us: number, whole: Sight): Sight {
  if (at_us >= sight.from_us && at_us <= sight.to_us) return sight;
  const span = spanOf(sight);
  const from = at_us > sight.to_us && at_us <= sight.to_us + span ? sight.to_us : at_us - span / 2;
  return within({ from_us: from, to_us: from + span }, whole);
}

/**
 * The visible interval after a change of time. It follows a jump, and a time that runs out of it; otherwise it stays
 * where the user looks.
 */
export function kept(sight: Sight, before_us: number, now_us: number, went: boolean, whole: Sight): Sight {
  const wasIn = before_us >= sight.from_us && before_us <= sight.to_us;
  return went || wasIn ? following(sight, now_us, whole) : sight;
}

/** `3.5 years`, `3 d 4 h`, `12 min`, `40 s`: the length of the visible interval. */
export function lengthOf(sight: Sight): string {
  const seconds = Math.round(spanOf(sight) / 1e6);
  const [days, hours, minutes] = [Math.floor(seconds / 86_400), Math.floor(seconds / 3600) % 24, Math.floor(seconds / 60) % 60];
  if (days >= 731) return `${Number((days / 365.25).toFixed(1))} years`;
  if (days >= 1) return days >= 10 ? `${Math.round(seconds / 86_400)} d` : hours === 0 ? `${days} d` : `${days} d ${hours} h`;
  if (hours >= 1) return minutes === 0 ? `${hours} h` : `${hours} h ${minutes} min`;
  return minutes >= 1 ? (seconds % 60 === 0 ? `${minutes} min` : `${minutes} min ${seconds % 60} s`) : `${seconds} s`;
}
