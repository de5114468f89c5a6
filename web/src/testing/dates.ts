// Days in wall time, for tests.

import type { DateView } from '../wire';

const HOUR_US = 3_600_000_000;
const DAY_US = 24 * HOUR_US;

export function date(text: string, begin_us: number, hours = 24, with_: Partial<DateView> = {}): DateView {
  return { date: text, begin_us, end_us: begin_us + hours * HOUR_US, clock_us: 0, turn: null, ...with_ };
}

/** The days of a run of this length from this time of a date on, without a clock change. */
export function daysFrom(first: string, length_us: number, clock_us = 0): DateView[] {
  const midnight = Date.parse(`${first}T00:00:00Z`);
  return Array.from({ length: Math.ceil((clock_us + length_us) / DAY_US) }, (_, day) => {
    const text = new Date(midnight + (day * DAY_US) / 1000).toISOString().slice(0, 10);
    const begin_us = Math.max(day * DAY_US - clock_us, 0);
    const end_us = Math.min((day + 1) * DAY_US - clock_us, length_us);
    return { ...date(text, begin_us), end_us, clock_us: day === 0 ? clock_us : 0 };
  });
}
