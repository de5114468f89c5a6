// A made-up logger file, and a growing log.

import type { DateView, HomeView, RowsView } from '../wire';

const DAY_US = 86_400_000_000;
/** The start of the made-up run. */
const MORNING_US = (6 * 60 + 55) * 60_000_000;

/** The files of a made-up home with a logger, and the answers about its log. */
export function madeUpLogger(home: HomeView): { texts: Record<string, string>; answers: Record<string, () => unknown> } {
  const sensors = home.sensors.map(({ name, kind, at }) => ({ kind, name, at }));
  const ids = new Map(home.sensors.map(({ name }, index) => [name, `M${String(index + 1).padStart(3, '0')}`]));
  const text = (value: unknown) => `${JSON.stringify(value, null, 2)}\n`;
  const texts = {
    'scenario.json': text({ name: home.name, home: 'home.json', logger: 'logger.json' }),
    'home.json': text({ name: home.name, sensors }),
    'logger.json': text({ to: ['sqlite:log.db', 'casas:log.txt'], table: 'event', ids: Object.fromEntries(ids), time: 'local' }),
  };
  const fired = home.sensors.slice(0, 12).map(({ name }, index) => [`2009-03-02 06:55:${10 + index}.250000`, ids.get(name)!, 'ON']);
  const hours = Array.from({ length: 9 }, (_, day) => Array.from({ length: 24 }, (_, hour) => (hour < 6 || (day % 3 === 0 && hour === 11) ? day % 2 : 30 + ((hour * 7 + day * 13) % 140))));
  const days = hours.map((_, day): DateView => {
    const begin_us = day === 0 ? 0 : day * DAY_US - MORNING_US;
    return { date: `2009-03-${String(day + 2).padStart(2, '0')}`, begin_us, end_us: (day + 1) * DAY_US - MORNING_US, clock_us: day === 0 ? MORNING_US : 0, turn: null };
  });
  const today = Array.from({ length: 900 }, (_, index) => [days[8]!.begin_us + index * 61_000_000, (index * 7) % home.sensors.length]);
  const answers = {
    '/api/rows': (): RowsView => ({
      problems: [],
      places: [
        { to: 'sqlite:log.db', table: 'event', columns: ['run_id', 'seq', 'fired_at', 'sensor', 'value'], rows: fired.map((row, index) => ['1', String(index), ...row]) },
        { to: 'casas:log.txt', table: null, columns: [], rows: fired },
      ],
      kinds: [['sqlite:', 'a database file, with a table as the network has it'], ['csv:', 'comma-separated values with a header line'], ['casas:', 'the text of the CASAS homes']],
      cut: null,
    }),
    '/api/connect': () => ({ works: true, said: 'Each run writes its own into a new folder in runs. Homebody can write there.' }),
    '/api/growth': () => ({ days, hours, today, left_out: 0 }),
  };
  return { texts, answers };
}
