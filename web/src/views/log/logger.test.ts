import { expect, test } from 'vitest';
import { type Sensor, another, loggerOf, numbered, pasted, sensorsOf, splitPlace, turnedInto } from './logger';

const KINDS: [string, string][] = [['sqlite:', 'a database file'], ['csv:', 'values'], ['casas:', 'text']];
const SENSORS: Sensor[] = [
  { name: 'hall motion', kind: 'motion' },
  { name: 'front door', kind: 'contact' },
  { name: 'bed motion', kind: 'motion' },
  { name: 'bed', kind: 'bed' },
];

test('what a file leaves out goes as it usually does', () => {
  expect(loggerOf({})).toMatchObject({ to: [], table: '', messages: 'fire_only', time: 'local', hold_s: '' });
  const logger = loggerOf({ to: ['csv:a'], table: 'event', columns: { time: 'ts' }, ids: { bed: 'A1' }, messages: { on_off: { hold_s: 4.1 } }, time: 'utc' });
  expect(logger).toMatchObject({ to: ['csv:a'], table: 'event', messages: 'on_off', hold_s: '4.1', time: 'utc' });
  expect(logger.columns).toEqual({ run: '', seq: '', time: 'ts', sensor: '', value: '' });
  expect(logger.ids.get('bed')).toBe('A1');
  expect(loggerOf({ messages: { occupancy: { timeout_s: 90 } } })).toMatchObject({ messages: 'occupancy', hold_s: '90' });
});

test('odd values are no fault of the form', () => {
  for (const odd of [null, 5, 'x', [], { to: 5, table: [], columns: null, ids: [1], messages: 7, time: {} }, { messages: { on_off: null } }]) {
    expect(() => loggerOf(odd)).not.toThrow();
  }
  expect(loggerOf({ messages: { on_off: null }, time: {} })).toMatchObject({ messages: '', time: '' });
  expect(sensorsOf({ sensors: [{ name: 'a', kind: 'motion' }, { name: 5 }, null] })).toEqual([{ name: 'a', kind: 'motion' }]);
  expect(sensorsOf([])).toBeNull();
});

test('a place that becomes another kind keeps its name, unless that was the usual one', () => {
  expect(splitPlace('csv:/a:b.csv', KINDS)).toEqual(['csv:', '/a:b.csv']);
  expect(splitPlace('mysql:x', KINDS)).toEqual([null, 'mysql:x']);
  expect(turnedInto('sqlite:log.db', 'csv:', KINDS)).toBe('csv:log.csv');
  expect(turnedInto('sqlite:/data/all.db', 'csv:', KINDS)).toBe('csv:/data/all.db');
  expect(another(['sqlite:log.db'], KINDS)).toBe('csv:log.csv');
  expect(another(['sqlite:log.db', 'csv:log.csv', 'casas:log.txt'], KINDS)).toBe('sqlite:log-4.db');
});

test('sensors are numbered by kind, as X10 units, or with letters of one’s own, and nothing twice', () => {
  expect([...numbered(SENSORS, 'casas', '', []).values()]).toEqual(['M001', 'D001', 'M002', 'I001']);
  expect([...numbered(SENSORS, 'prefix', 'S', ['s002']).values()]).toEqual(['S001', 'S003', 'S004', 'S005']);
  const many = Array.from({ length: 300 }, (_, index) => ({ name: `s${index}`, kind: 'motion' }));
  const codes = [...numbered(many, 'x10', '', ['a3']).values()];
  expect(codes.slice(0, 17)).toEqual(['A1', 'A2', 'A4', 'A5', 'A6', 'A7', 'A8', 'A9', 'A10', 'A11', 'A12', 'A13', 'A14', 'A15', 'A16', 'B1', 'B2']);
  expect(new Set(codes).size).toBe(300);
});

test('a column goes down from where it is pasted, and two columns find their sensors', () => {
  expect([...pasted('A1\r\nA2\r\n', SENSORS, 2)]).toEqual([['bed motion', 'A1'], ['bed', 'A2']]);
  expect([...pasted('A1\nA2\nA3\nA4\nA5\nA6', SENSORS, 3)]).toEqual([['bed', 'A1']]);
  expect([...pasted('name\tid\nbed\tB7\nhall motion\tB1\nattic\tB9', SENSORS, 0)]).toEqual([['bed', 'B7'], ['hall motion', 'B1']]);
  expect([...pasted('B7\tbed', SENSORS, 0)]).toEqual([['bed', 'B7']]);
});
