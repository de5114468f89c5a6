// Made from the table in crates/homebody-analysis/src/measures/registry.rs, which has the definitions.

/** Measures of the night before the day, but for parts of the day. */
export const OF_NIGHT: ReadonlySet<string> = new Set(['time_in_bed', 'bedtime', 'sleep', 'restlessness', 'bathroom_night']);

/** Measures of a part of the day, with its first hour. */
export const FIRST_HOURS: Readonly<Record<string, number>> = { density_night: 0, density_morning: 6, density_afternoon: 12, density_evening: 18 };

/** Measures that the page offers as goals of suggested sensors. */
export const MEASURE_GOALS = [
  { id: 'bathroom_night', title: 'Bathroom visits at night' },
  { id: 'time_out', title: 'Time away from home' },
];
