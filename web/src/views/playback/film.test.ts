import { expect, test, vi } from 'vitest';
import { storedRun } from '../../testing/stored';
import type { MomentView, PlaybackView, SilhouettesView } from '../../wire';
import { Film, partOf } from './film.svelte';

const CAMERA = { pixels: [4, 3] as [number, number], period_us: 200_000, always: false, seen: [], hidden: [] };

function run(): PlaybackView {
  const run = storedRun('cameras', 1);
  run.home.sensors.slice(0, 2).forEach((sensor) => (sensor.camera = CAMERA));
  return run;
}

const moment = (at_us: number, sensors: number[]): MomentView => ({ at_us, pictures: sensors.map((sensor) => ({ sensor, packed: new Uint8Array([1, 2]) })), persons: [] });

/** A server with these moments, and a limit on each answer. */
function film(moments: MomentView[], most = 100) {
  const asked: string[] = [];
  const packed = vi.fn(async (path: string) => {
    asked.push(path);
    const [, from, to] = /silhouettes\/(\d+)\/(\d+)\//.exec(path)!.map(Number) as [number, number, number];
    const of = moments.filter(({ at_us }) => at_us >= from && at_us < to);
    const view: SilhouettesView = { until_us: of.length > most ? of[most]!.at_us : to, corner: [0, 0], edge_m: 0.05, moments: of.slice(0, most) };
    return view as never;
  });
  return { film: new Film({ packed }, run()), asked };
}

const settled = () => new Promise((done) => setTimeout(done, 5));

test('a picture is shown until the next is due, and of a camera without one the log says whether it is awake', async () => {
  const { film: of, asked } = film([moment(1_000_000, [0, 1]), moment(1_200_000, [0])]);
  expect(of.at(1_000_000, 1, [true, true]).looks).toEqual([null, null]);
  of.want(1_000_000, 1, false);
  await settled();
  expect(asked).toEqual(['/api/runs/cameras/silhouettes/0/10000000/0']);
  const seen = (at_us: number, awake = [true, false]) => of.at(at_us, 1, awake).looks.map((look) => [look!.awake, look!.packed.length]);
  expect(seen(900_000)).toEqual([[true, 0], [false, 0]]);
  expect(seen(1_100_000)).toEqual([[true, 2], [true, 2]]);
  expect(seen(1_300_000)).toEqual([[true, 2], [false, 0]]);
  expect(seen(1_500_000)).toEqual([[true, 0], [false, 0]]);
});

test('a part that comes in pieces is asked for until it is whole, and what comes next while it plays', async () => {
  const { film: of, asked } = film([1, 2, 3, 12].map((second) => moment(second * 1e6, [1])), 2);
  of.want(3_050_000, 1, true);
  await settled();
  expect(asked.map((path) => path.split('silhouettes/')[1])).toEqual(['0/10000000/0', '3000000/10000000/0', '10000000/20000000/0']);
  expect(of.at(3_050_000, 1, [false, false]).looks[1]!.packed.length).toBe(2);
});

test('at a high speed only some of the instants are asked for', () => {
  expect(partOf(0, 1).every_us).toBe(0);
  const { every_us, span } = partOf(3_700e6, 60);
  expect(every_us).toBe(12e6);
  expect(span(0)).toEqual([3_600e6, 4_200e6]);
});
