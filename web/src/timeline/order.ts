// The order of lanes, and the lanes that are left out.

import type { Sight } from '../charts/axis';
import { type Lane, countIn } from '../charts/lanes';

export const ORDERS = { home: 'Plan order', place: 'By room', active: 'Busiest first', name: 'By name' } as const;

export type Order = keyof typeof ORDERS;

/** The indices of the lanes in this order; with `active` only those with a firing in sight. */
export function ordered(lanes: readonly Lane[], order: Order, active: boolean, sight: Sight): number[] {
  const counts = order === 'active' || active ? lanes.map((lane) => countIn(lane, sight)) : [];
  const kept = lanes.map((_, index) => index).filter((index) => !active || counts[index]! > 0);
  const place = (index: number) => lanes[index]!.place ?? '';
  const name = (index: number) => lanes[index]!.name;
  if (order === 'place') {
    // Rooms in the order of the home; lanes without a room come last.
    const rooms = [...new Set(lanes.map(({ place }) => place ?? ''))].sort((a, b) => Number(a === '') - Number(b === ''));
    return kept.sort((a, b) => rooms.indexOf(place(a)) - rooms.indexOf(place(b)) || a - b);
  }
  if (order === 'active') return kept.sort((a, b) => counts[b]! - counts[a]! || a - b);
  return order === 'name' ? kept.sort((a, b) => name(a).localeCompare(name(b)) || a - b) : kept;
}
