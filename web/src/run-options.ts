// Made from RunOptions in crates/homebody-simulation/src/run_options.rs.

/** The options of a run: the explanation, and the range of a number. */
export const RUN_OPTIONS = {
  days: { help: 'Duration of the run: 90s, 15m, 2h, 7d or 52w (default: that of the scenario)', least: 0, most: 36525 },
  start: { help: 'Start of the run in the home\'s local time: now, today, 2026-11-01 or 2026-11-01T08:00 (default: the start in the scenario)' },
  seed: { help: 'Seed of all random numbers (default: that of the scenario)', least: 0, most: 9007199254740991 },
  without: { help: 'Leave out a condition of the routine; repeatable' },
  numbers: { help: 'Set a parameter of the models; repeatable' },
  one_of_many: { help: 'Let the residents differ from their routines as people differ, each seed in its own way' },
} as const;
