import { expect, test } from 'vitest';
import { storedRun } from '../../testing/stored';
import { Finding } from './finding.svelte';

const HOUR = 3_600_000_000;
const hits = [1, 2, 30].map((hour) => ({ begin_us: hour * HOUR, end_us: hour * HOUR + 600e6, is_fall: false, words: 'Agnes' }));

function finding(answer: unknown = { hits, all: 3, remarks: [] }) {
  const asked: [string, unknown][] = [];
  const post = async (path: string, body: unknown) => {
    asked.push([path, body]);
    if (answer instanceof Error) throw answer;
    return answer as never;
  };
  return { made: new Finding({ post } as never, { view: storedRun('one') }), asked };
}

test('what is looked for is asked of the run, with the hours and the length that are meant', async () => {
  const { made, asked } = finding();
  expect(made.name).toBe('bathroom');
  await made.find();
  expect(asked).toEqual([['/api/runs/one/find', { what: 'room', name: 'bathroom', between_min: [0, 360], least_s: 0 }]]);
  made.choose('still');
  await made.find();
  expect(asked[1]![1]).toEqual({ what: 'still', name: null, between_min: [480, 1200], least_s: 10_800 });
  made.between = [22, 6];
  made.least_min = null;
  await made.find();
  expect(asked[2]![1]).toEqual({ what: 'still', name: null, between_min: [1320, 360], least_s: 0 });
});

test('the next and the one before are by time, and beyond the last there is none', async () => {
  const { made } = finding();
  await made.find();
  expect([0, HOUR, 1.5 * HOUR, 40 * HOUR].map((at) => made.at(at))).toEqual([-1, 0, 0, 2]);
  expect(made.next(0, true)?.begin_us).toBe(HOUR);
  expect(made.next(HOUR, true)?.begin_us).toBe(2 * HOUR);
  expect(made.next(30 * HOUR, true)).toBeNull();
  // In the middle of a hit its beginning is meant, at its beginning the one before.
  expect(made.next(2 * HOUR + 300e6, false)?.begin_us).toBe(2 * HOUR);
  expect(made.next(2 * HOUR, false)?.begin_us).toBe(HOUR);
  expect(made.next(HOUR, false)).toBeNull();
});

test('what cannot be looked for is said, and what was found before is gone', async () => {
  const { made } = finding(new Error('broken'));
  made.found = { hits, all: 3, remarks: [] };
  await made.find();
  expect([made.found, made.busy]).toEqual([null, false]);
  expect(made.problem).not.toBe('');
});

test('what cameras take for a fall and what the truth tells of are counted apart', async () => {
  const words = ['anna: by the truth: has fallen, hall', 'by one camera: lies on the ground', 'anna: by the truth: has fallen, hall'];
  const { made } = finding({ hits: words.map((words, index) => ({ ...hits[index]!, is_fall: index !== 1, words })), all: 3, remarks: [] });
  await made.find();
  expect(made.counted).toBe('3 times:');
  made.choose('seen_fall');
  await made.find();
  expect([made.counted, made.title]).toEqual(['Falls seen by cameras: 1, in the ground truth: 2', '']);
});
