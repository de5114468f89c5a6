import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { frame } from '../testing/frames';
import { madeUpRun } from '../testing/home';
import type { RunFrame } from '../wire';
import { usual } from './layers';
import { light } from './palette';
import { type Scene, Stage } from './stage';
import { Trails } from './trails';
import { toScreen } from './transform';

type Call = { canvas: HTMLCanvasElement; name: string; args: unknown[] };

let calls: Call[];
let canvas: HTMLCanvasElement;
let stage: Stage;

const run = madeUpRun(2, 18);
const body = (x: number) => ({ at: [x, 2] as [number, number], heading_deg: 0, posture: 'standing' as const, room: 0, activity: null });
const scene: Scene = { home: run.home, residents: run.residents, driven: null, layers: usual(18), palette: light, reducedMotion: false };

beforeEach(() => {
  calls = [];
  // A canvas that draws nothing, and records the calls.
  vi.spyOn(HTMLCanvasElement.prototype, 'getContext').mockImplementation(function (this: HTMLCanvasElement) {
    return new Proxy({}, {
      get: (_, name: string) => (...args: unknown[]) => {
        calls.push({ canvas: this, name, args });
        return name === 'measureText' ? { width: String(args[0]).length * 6 } : undefined;
      },
      set: () => true,
    }) as unknown as GPUCanvasContext;
  });
  canvas = document.createElement('canvas');
  stage = new Stage(canvas);
  stage.resize(800, 600, 2);
  stage.set(scene);
});

afterEach(() => vi.restoreAllMocks());

/** The calls since the last time, on the visible canvas and on the others. */
function drawn(now_ms: number, counts: number[] = []): { seen: Call[]; kept: Call[]; did: boolean } {
  calls = [];
  const did = stage.draw(now_ms, counts);
  return { did, seen: calls.filter((call) => call.canvas === canvas), kept: calls.filter((call) => call.canvas !== canvas) };
}

function take(part: Partial<RunFrame>, now_ms: number): void {
  stage.take(frame({ bodies: [body(2), null], ...part }), now_ms);
}

test('a canvas has as many pixels as the screen, but no more than two each way', () => {
  expect([canvas.width, canvas.height]).toEqual([1600, 1200]);
  stage.resize(800, 600, 3);
  expect(canvas.width).toBe(1600);
});

test('what stands still is drawn once, and copied from then on', () => {
  take({}, 0);
  expect(drawn(0).kept.length).toBeGreaterThan(500);
  take({ now_us: 1, bodies: [body(2.5), null] }, 16);
  const { seen, kept } = drawn(16);
  expect(kept).toEqual([]);
  expect(seen.filter(({ name }) => name === 'drawImage')).toHaveLength(2);
  stage.zoom(2);
  expect(drawn(32).kept.length).toBeGreaterThan(100);
});

test('no door is drawn over names', () => {
  const { seen } = drawn(0);
  const last = (of: string) => seen.findLastIndex(({ name }) => name === of);
  expect(scene.home.doors.length).toBeGreaterThan(0);
  expect(last('stroke')).toBeGreaterThan(-1);
  // Before the first frame, the sheet with all names is drawn last.
  expect(last('drawImage')).toBeGreaterThan(last('stroke'));
});

test('where nothing changes nothing is drawn', () => {
  take({ state: 'paused' }, 0);
  for (let at = 0; at < 3000; at += 16) stage.draw(at);
  expect(drawn(3000)).toEqual({ did: false, seen: [], kept: [] });
});

test('somebody who is out is not drawn', () => {
  take({}, 0);
  const named = (name: string) => drawn(0).seen.some((call) => call.name === 'fillText' && String(call.args[0]).includes(name));
  expect(named('Agnes')).toBe(true);
  stage.set({ ...scene });
  expect(named('Bertram')).toBe(false);
});

test('who lies in a bed has the head at the wall, whatever way they came', () => {
  const heads = () => drawn(0).seen.filter(({ name }) => name === 'rotate').map(({ args }) => [Math.cos(Number(args[0])), -Math.sin(Number(args[0]))].map(Math.round).map(String));
  take({ bodies: [{ ...body(1.2), at: [1.2, 6.4], heading_deg: 90, posture: 'lying' }, null] }, 0);
  expect(heads()).toEqual([['-1', '0']]);
  take({ bodies: [{ ...body(3), at: [3, 6.4], heading_deg: 90, posture: 'lying' }, null] }, 0);
  // Next to each other, in the order of arrival.
  expect(heads()).toEqual([['0', '1']]);
});

test('in fast time no ring grows, and counts grow no more often than one can read', () => {
  const [x, y] = run.home.sensors[0]!.at;
  const centre = [stage.view.x + x * stage.view.scale, stage.view.y - y * stage.view.scale];
  const rings = (calls: Call[]) => calls.filter(({ name, args }) => name === 'arc' && args[0] === centre[0] && args[1] === centre[1]).length;
  const fired = [{ seq: 0, at_us: 1, sensor: 0, value: 'ON', row: null }];
  take({ firings: fired }, 1000);
  expect(rings(drawn(1500).seen)).toBe(1);

  const shown: string[] = [];
  for (let at = 0; at < 2000; at += 16) {
    take({ now_us: at, speed: 1000, seeing: [0, 1, 2], firings: fired }, 2000 + at);
    const { seen } = drawn(2000 + at, run.home.sensors.map(() => 7000 + at));
    expect(rings(seen)).toBe(0);
    const count = seen.find(({ name, args }) => name === 'fillText' && /^[78]\d{3}$/.test(String(args[0])));
    if (count) shown.push(String(count.args[0]));
  }
  expect(new Set(shown).size).toBeGreaterThanOrEqual(4);
  expect(new Set(shown).size).toBeLessThanOrEqual(6);
});

test('a sensor is found under the pointer, and none where there is none', () => {
  const [x, y] = run.home.sensors[0]!.at;
  const at: [number, number] = [stage.view.x + x * stage.view.scale + 3, stage.view.y - y * stage.view.scale];
  expect(stage.sensorAt(at)).toBe(0);
  expect(stage.sensorAt([-500, -500])).toBeNull();
});

test('where somebody has moved the plan it stays with the next run of the same home, and another home is fitted', () => {
  const all = stage.view;
  stage.zoom(2);
  stage.pan(30, 10);
  const moved = stage.view;
  stage.set({ ...scene, home: { ...run.home } });
  expect(stage.view).toEqual(moved);
  const [[left, bottom], [right, top]] = run.home.bounds;
  stage.set({ ...scene, home: { ...run.home, bounds: [[left, bottom], [right + 5, top]] } });
  expect(stage.view).not.toEqual(moved);
  stage.set(scene);
  expect(stage.view).toEqual(all);
});

test('with the next run of the same home nobody is drawn before a frame has come', () => {
  take({}, 0);
  const named = () => drawn(0).seen.some((call) => call.name === 'fillText' && String(call.args[0]).includes('Agnes'));
  expect(named()).toBe(true);
  stage.set({ ...scene, home: { ...run.home } });
  expect(named()).toBe(false);
});

test('a clock with a long name hides nothing of the home', () => {
  const corner = () => toScreen(stage.view, [run.home.bounds[0][0], run.home.bounds[1][1]]);
  const hides = ([x, y]: [number, number], { width, height }: { width: number; height: number }) => x < width + 10 && y < height + 10;
  const clock = { width: 500, height: 150 };
  expect(hides(corner(), clock)).toBe(true);
  stage.past(clock);
  expect(hides(corner(), clock)).toBe(false);
  // A home that the user has moved stays.
  stage.pan(-5, -5);
  const moved = stage.view;
  stage.past({ width: 100, height: 400 });
  expect(stage.view).toEqual(moved);
});

test('the plan stays where it is while words in the clock come and go', () => {
  stage.past({ width: 500, height: 150 });
  const { view } = stage;
  for (const [width, height] of [[120, 92], [500, 92], [300, 150], [0, 0]] as const) {
    stage.past({ width, height });
    expect(stage.view).toEqual(view);
  }
  stage.past({ width: 120, height: 200 });
  expect(stage.view).not.toEqual(view);
});

test('once the clock says something else the plan stands as it did before', () => {
  stage.past({ width: 120, height: 80 });
  const { view } = stage;
  stage.past({ width: 500, height: 150 });
  expect(stage.view).not.toEqual(view);
  stage.forgetClock();
  stage.past({ width: 120, height: 80 });
  expect(stage.view).toEqual(view);
});

test('who was taken somewhere leaves no trail on the way', () => {
  const trails = new Trails();
  const go = (x: number) => trails.take(frame({ bodies: [{ ...body(0), at: [x, 1] }] }), 0);
  for (const x of [1, 1.3, 1.6]) go(x);
  expect(trails.of[0]!.map(({ at }) => at[0])).toEqual([1, 1.3, 1.6]);
  for (const x of [6, 2, 9]) go(x);
  expect(trails.of[0]!.map(({ at }) => at[0])).toEqual([9]);
  go(9.3);
  expect(trails.of[0]!.map(({ at }) => at[0])).toEqual([9, 9.3]);
});

test('names of people and of sensors stay inside the picture', () => {
  const at = (words: string) => drawn(0).seen.filter((call) => call.name === 'fillText' && String(call.args[0]).includes(words)).map((call) => Number(call.args[2]));
  take({}, 0);
  const [first] = at('Agnes');
  // Her name is above her, and has no room there.
  stage.pan(0, -first! - 4);
  expect(at('Agnes')[0]).toBeGreaterThan(8);
  // A person out of the picture has no name in it.
  stage.pan(0, -400);
  expect(at('Agnes')[0]).toBeLessThan(0);
  stage.fit();
  let names = 0;
  for (let step = 0; step < 60; step++) {
    stage.pan(0, 13);
    for (const { args } of drawn(0).kept.filter(({ name, args }) => name === 'fillText' && /motion|contact/.test(String(args[0])))) {
      names += 1;
      expect(Number(args[2])).toBeLessThan(600 - 8);
    }
  }
  expect(names).toBeGreaterThan(0);
});
