// Positions of people by the truth.

import type { BodyView, PersonDay, PlaybackView } from '../../wire';
import { type Day, movementAt, spanAt } from './day';

/** Number of earlier strides searched for the heading of a person who stands or sits. */
const BACK = 200;

/** The bodies at an instant; null for people who are out, or without data. */
export function bodiesAt(run: PlaybackView, day: Day, at_us: number): (BodyView | null)[] {
  return run.residents.map((_, index) => {
    const life = day.view.lives[index];
    return life === undefined ? null : bodyAt(run, life, at_us);
  });
}

export function bodyAt(run: PlaybackView, life: PersonDay, at_us: number): BodyView | null {
  const index = movementAt(life, at_us);
  const movement = life.movements[index];
  if (movement === undefined) return null;
  const [begin, end, , posture, from, to] = movement;
  if (from === null || to === null) return null;
  const share = end > begin ? Math.min(Math.max((at_us - begin) / (end - begin), 0), 1) : 1;
  const activity = spanAt(life.activities, at_us);
  return {
    at: [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share],
    heading_deg: heading(life, index),
    posture,
    room: spanAt(life.rooms, at_us)?.[2] ?? null,
    activity: activity === null ? null : (run.activities[activity[2]] ?? null),
  };
}

/** The heading: along the stride, or along the last one. */
function heading(life: PersonDay, index: number): number {
  for (let back = index; back >= Math.max(index - BACK, 0); back--) {
    const [, , doing, , from, to] = life.movements[back]!;
    if (doing === 'stride' && from !== null && to !== null && (from[0] !== to[0] || from[1] !== to[1])) {
      return (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI;
    }
  }
  return 90;
}
