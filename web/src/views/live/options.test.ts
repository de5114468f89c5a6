import { expect, test } from 'vitest';
import { RUN_OPTIONS } from '../../run-options';
import { OFFERED, read } from './options';

test('an empty form leaves all options to the scenario', () => {
  expect(read({})).toEqual({ options: {}, wrong: {} });
  expect(read({ days: ' ', start: '', numbers: '\n' })).toEqual({ options: {}, wrong: {} });
});

test('fields become options of their types', () => {
  const fields = { days: '1.5', start: ' 2026-11-01T08:00 ', seed: '9007199254740991', numbers: 'gait.slowest = 0.25\nlife.day_spread=1', one_of_many: 'yes' };
  expect(read(fields)).toEqual({
    options: { days: 1.5, start: '2026-11-01T08:00', seed: 9007199254740991, numbers: { 'gait.slowest': 0.25, 'life.day_spread': 1 }, one_of_many: true },
    wrong: {},
  });
  for (const start of ['now', 'today', '2026-11-01', '2026-11-01 08:00:09']) expect(read({ start }).options).toEqual({ start });
});

test.each([
  ['days', '0'], ['days', '36526'], ['days', 'ten'], ['seed', '-1'], ['seed', '1.5'], ['seed', '9007199254740992'],
  ['start', 'tomorrow'], ['start', '8:00'], ['numbers', 'gait.slowest'], ['numbers', '=1'], ['numbers', 'a=b'], ['numbers', 'a=1=2'], ['numbers', 'a=1\na = 2'],
] as const)('%s cannot be %s', (name, text) => {
  const { options, wrong } = read({ [name]: text });
  expect(options).toEqual({});
  expect(Object.keys(wrong)).toEqual([name]);
  expect(wrong[name]).toMatch(/^Expected .+\.$/);
});

test('each offered option has a label and a help, and conditions have a field of their own', () => {
  for (const { label, help } of OFFERED) expect(label !== '' && help !== '').toBe(true);
  expect(Object.keys(RUN_OPTIONS).filter((name) => !OFFERED.some((one) => one.name === name))).toEqual(['without']);
});
