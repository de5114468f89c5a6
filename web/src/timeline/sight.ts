// What of a run's time is in sight: it is zoomed about an instant, moved, and stays within what there is.

import type { Sight } from '../charts/axis';

/** Nothing shorter is shown. */
export const LEAST_US = 1e6;

/** How much a step of the wheel or a key zooms. */
export const STEP = 1.35;

export function spanOf({ from_us, to_us }: Sight): number {
  return to_us - from_us;
}

/** No shorter than a second, no longer than there is, and within it. */
export function within({ from_us, to_us }: Sight, whole: Sight): Sight {
  const span = Math.min(Math.max(to_us - from_us, LEAST_US), Math.max(spanOf(whole), LEAST_US));
  const from = Math.min(Math.max(from_us, whole.from_us), Math.max(whole.to_us - span, whole.from_us));
  return { from_us: from, to_us: from + span };
}

/** So many times as long; the instant stays where it is on the screen. */
export function zoomed(sight: Sight, times: number, at_us: number, whole: Sight): Sight {
  const share = (at_us - sight.from_us) / Math.max(spanOf(sight), 1);
  const span = Math.min(Math.max(spanOf(sight) * times, LEAST_US), Math.max(spanOf(whole), LEAST_US));
  const from = at_us - share * span;
  return within({ from_us: from, to_us: from + span }, whole);
}

export function moved(sight: Sight, by_us: number, whole: Sight): Sight {
  return within({ from_us: sight.from_us + by_us, to_us: sight.to_us + by_us }, whole);
}

/** As long as before, and with the instant in it: what plays on past the end turns the page. */
export function following(sight: Sight, at_us: number, whole: Sight): Sight {
  if (at_us >= sight.from_us && at_us <= sight.to_us) return sight;
  const span = spanOf(sight);
  const from = at_us > sight.to_us && at_us <= sight.to_us + span ? sight.to_us : at_us - span / 2;
  return within({ from_us: from, to_us: from + span }, whole);
}

/**
 * What is in sight once the time is another one. It follows a time that somebody went to, and one that runs out of it; who looks
 * elsewhere goes on looking there.
 */
export function kept(sight: Sight, before_us: number, now_us: number, went: boolean, whole: Sight): Sight {
  const wasIn = before_us >= sight.from_us && before_us <= sight.to_us;
  return went || wasIn ? following(sight, now_us, whole) : sight;
}

/** `3.5 years`, `3 d 4 h`, `12 min`, `40 s`: how much is in sight. */
export function lengthOf(sight: Sight): string {
  const seconds = Math.round(spanOf(sight) / 1e6);
  const [days, hours, minutes] = [Math.floor(seconds / 86_400), Math.floor(seconds / 3600) % 24, Math.floor(seconds / 60) % 60];
  if (days >= 731) return `${Number((days / 365.25).toFixed(1))} years`;
  if (days >= 1) return days >= 10 ? `${Math.round(seconds / 86_400)} d` : hours === 0 ? `${days} d` : `${days} d ${hours} h`;
  if (hours >= 1) return minutes === 0 ? `${hours} h` : `${hours} h ${minutes} min`;
  return minutes >= 1 ? (seconds % 60 === 0 ? `${minutes} min` : `${minutes} min ${seconds % 60} s`) : `${seconds} s`;
}
