// A logger's file as a form. Missing values have their defaults; invalid ones are left out here, and the check reports
// them.

import { isObject } from '../../json';
import { rowOf } from '../../plan/kinds';

export type Logger = {
  to: string[];
  table: string;
  columns: Record<Column, string>;
  /** The network's own id by the sensor's name. */
  ids: Map<string, string>;
  messages: Messages;
  /** From the last firing to the message of its end. */
  hold_s: string;
  time: string;
};

type Column = 'run' | 'seq' | 'time' | 'sensor' | 'value';
export type Messages = 'fire_only' | 'on_off' | 'occupancy' | '';

export const TABLE = 'firing';
export const PLACE = 'sqlite:log.db';

export const COLUMNS: { column: Column; usual: string; title: string; about: string }[] = [
  { column: 'run', usual: 'run_id', title: 'Run', about: 'the id of the run' },
  { column: 'seq', usual: 'seq', title: 'Number', about: 'number of the row' },
  { column: 'time', usual: 'fired_at', title: 'Time', about: 'time of the event' },
  { column: 'sensor', usual: 'sensor', title: 'Sensor', about: 'id or name of the sensor' },
  { column: 'value', usual: 'value', title: 'Message', about: 'value of the event' },
];

export const MESSAGES: { kind: Exclude<Messages, ''>; title: string; about: string; example: string; seconds: { key: string; label: string; usual: number } | null }[] = [
  {
    kind: 'fire_only', title: 'One row for each event',
    about: 'As in X10 networks: a sensor repeats its event as long as it detects a person.', example: 'ON, ON, ON', seconds: null,
  },
  {
    kind: 'on_off', title: 'ON, then OFF',
    about: 'As in CASAS homes: OFF follows when no event has come for the hold time. Each event restarts the hold time.', example: 'ON, OFF',
    seconds: { key: 'hold_s', label: 'Hold time in seconds', usual: 4 },
  },
  {
    kind: 'occupancy', title: 'Occupancy: true, then false',
    about: 'As with Zigbee sensors: false follows when no event has come for the timeout.', example: 'true, false',
    seconds: { key: 'timeout_s', label: 'Timeout in seconds', usual: 90 },
  },
];

export const TIMES: { time: string; title: string; example: string }[] = [
  { time: 'local', title: 'Local time', example: '2009-03-02 07:12:03.250000' },
  { time: 'local_offset', title: 'Local time with UTC offset', example: '2009-03-02T07:12:03.250000-06:00' },
  { time: 'utc', title: 'UTC', example: '2009-03-02T13:12:03.250000Z' },
  { time: 'epoch_s', title: 'Seconds since 1970', example: '1235999523.250000' },
  { time: 'epoch_ms', title: 'Milliseconds since 1970', example: '1235999523250' },
];

export function loggerOf(value: unknown): Logger {
  const file = isObject(value) ? value : {};
  const columns = isObject(file.columns) ? file.columns : {};
  const ids = isObject(file.ids) ? file.ids : {};
  const { kind, hold_s } = messagesOf(file.messages);
  return {
    to: Array.isArray(file.to) ? file.to.map(text) : [],
    table: text(file.table),
    columns: Object.fromEntries(COLUMNS.map(({ column }) => [column, text(columns[column])])) as Record<Column, string>,
    ids: new Map(Object.entries(ids).map(([sensor, id]) => [sensor, text(id)])),
    messages: kind,
    hold_s,
    time: file.time === undefined ? 'local' : text(file.time),
  };
}

function messagesOf(value: unknown): { kind: Messages; hold_s: string } {
  if (value === undefined || value === 'fire_only') return { kind: 'fire_only', hold_s: '' };
  for (const { kind, seconds } of MESSAGES) {
    const inner = isObject(value) ? value[kind] : undefined;
    if (seconds && isObject(inner)) return { kind, hold_s: text(inner[seconds.key]) };
  }
  return { kind: '', hold_s: '' };
}

function text(value: unknown): string {
  return typeof value === 'string' ? value : typeof value === 'number' ? String(value) : '';
}

export type Sensor = { name: string; kind: string };

/** The sensors of a home's file; null if it has no readable list. */
export function sensorsOf(home: unknown): Sensor[] | null {
  if (!isObject(home) || !Array.isArray(home.sensors)) return null;
  return home.sensors.flatMap((one): Sensor[] => (isObject(one) && typeof one.name === 'string' ? [{ name: one.name, kind: text(one.kind) }] : []));
}

/** The known beginning of a destination's URL, and the rest. */
export function splitPlace(url: string, kinds: [string, string][]): [begin: string | null, rest: string] {
  const begin = kinds.map(([begin]) => begin).filter((begin) => url.startsWith(begin)).sort((a, b) => b.length - a.length)[0];
  return begin === undefined ? [null, url] : [begin, url.slice(begin.length)];
}

const FILES: Record<string, string> = { 'sqlite:': 'log.db', 'csv:': 'log.csv', 'casas:': 'log.txt' };

/** A destination of another kind: the default name of the old kind becomes that of the new one. */
export function turnedInto(url: string, begin: string, kinds: [string, string][]): string {
  const [, rest] = splitPlace(url, kinds);
  const usual = rest === '' || Object.values(FILES).includes(rest);
  return begin + (usual ? (FILES[begin] ?? '') : rest);
}

/** A new destination to start from. */
export function another(places: string[], kinds: [string, string][]): string {
  const all = Object.entries(FILES).filter(([begin]) => kinds.some(([known]) => known === begin)).map(([begin, file]) => begin + file);
  return all.find((one) => !places.includes(one)) ?? PLACE.replace('log', `log-${places.length + 1}`);
}

export type Numbering = 'casas' | 'x10' | 'prefix';

/** Unused ids for sensors, in their order. */
export function numbered(sensors: Sensor[], how: Numbering, prefix: string, taken: string[]): Map<string, string> {
  // Networks and the check ignore case.
  const used = new Set(taken.map((id) => id.toLowerCase()));
  const counts = new Map<string, number>();
  return new Map(
    sensors.map(({ name, kind }) => {
      const begin = how === 'casas' ? (rowOf(kind)?.casas ?? 'I') : prefix;
      for (;;) {
        const number = (counts.get(begin) ?? 0) + 1;
        counts.set(begin, number);
        const id = how === 'x10' ? x10(number) : begin + String(number).padStart(3, '0');
        if (used.has(id.toLowerCase())) continue;
        used.add(id.toLowerCase());
        return [name, id];
      }
    }),
  );
}

/** House A to P with 16 units each; further ids do not exist. */
function x10(number: number): string {
  const house = Math.floor((number - 1) / 16);
  return `${String.fromCharCode(65 + (house % 16))}${((number - 1) % 16) + 1}${house < 16 ? '' : `-${Math.floor(house / 16) + 1}`}`;
}

/**
 * Pasted cells of a spreadsheet: a column of ids starts at a sensor; of two columns, one has the names of sensors, the
 * other their ids.
 */
export function pasted(copied: string, sensors: Sensor[], from: number): Map<string, string> {
  const rows = copied.replace(/\r?\n$/, '').split(/\r?\n/).map((row) => row.split('\t').map((cell) => cell.trim()));
  const known = new Set(sensors.map(({ name }) => name));
  const named = rows.flatMap((cells): [string, string][] => {
    const at = cells.findIndex((cell) => known.has(cell));
    return at !== -1 && cells.length > 1 ? [[cells[at]!, cells[at === 0 ? 1 : at - 1]!]] : [];
  });
  if (named.length > 0) return new Map(named);
  return new Map(rows.slice(0, sensors.length - from).map((cells, index) => [sensors[from + index]!.name, cells[0]!]));
}
