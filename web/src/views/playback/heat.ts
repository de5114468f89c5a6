// The time of residents in each place on a day: by the truth, or, without it, by the sensors that fired last.

import { type Palette, viridis } from '../../plan/palette';
import type { Pen } from '../../plan/pen';
import { type View, toScreen } from '../../plan/transform';
import type { PlaybackView, SensorView } from '../../wire';
import { type Day, STILL_US } from './day';

const CELL_M = 0.25;

export type Heat = {
  columns: number;
  seconds: Float64Array;
  most: number;
  /** The rooms, or without truth the sensors, with the most time. */
  words: [name: string, seconds: number][];
  /** All of them. */
  all: [name: string, seconds: number][];
  /** It is the excess of one run over another. */
  isMore: boolean;
};

type At = [number, number];

export function heatOf(run: PlaybackView, day: Day, truth: boolean): Heat {
  const [[left, bottom], [right, top]] = run.home.bounds;
  const columns = Math.max(Math.ceil((right - left) / CELL_M), 1);
  const seconds = new Float64Array(columns * Math.max(Math.ceil((top - bottom) / CELL_M), 1));
  const add = ([x, y]: At, by: number) => {
    const cell = Math.floor((y - bottom) / CELL_M) * columns + Math.floor((x - left) / CELL_M);
    if (cell >= 0 && cell < seconds.length) seconds[cell]! += by;
  };
  const { begin_us, end_us } = run.days[day.number]!;
  const words = new Map<string, number>();
  const tell = (name: string, by: number) => words.set(name, (words.get(name) ?? 0) + by);
  const within = (begin: number, end: number) => Math.max(Math.min(end, end_us) - Math.max(begin, begin_us), 0) / 1e6;
  if (truth) {
    for (const { movements, rooms } of day.view.lives) {
      for (const [begin, end, , , from, to] of movements) {
        if (from === null || to === null) continue;
        const steps = Math.max(Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / CELL_M), 1);
        for (let step = 0; step < steps; step++) {
          const share = (step + 0.5) / steps;
          add([from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share], within(begin, end) / steps);
        }
      }
      for (const [begin, end, room] of rooms) tell(run.home.rooms[room]?.name ?? '', within(begin, end));
    }
  } else {
    const spots = run.home.sensors.map(spotsOf);
    day.view.rows.forEach(([at, sensor], index) => {
      const next = day.view.rows[index + 1]?.[0] ?? end_us;
      const by = Math.min(next - at, STILL_US) / 1e6;
      for (const spot of spots[sensor] ?? []) add(spot, by / spots[sensor]!.length);
      tell(run.home.sensors[sensor]?.name ?? run.sensors[sensor] ?? '', by);
    });
  }
  const all = [...words].sort((a, b) => b[1] - a[1]);
  return { columns, seconds, most: seconds.reduce((a, b) => Math.max(a, b), 0), words: all.filter(([, of]) => of >= 60).slice(0, 5), all, isMore: false };
}

/** The excess of a second run in each spot, negative for a deficit; null for homes of different sizes. */
export function heatMore(run: PlaybackView, first: Heat, other: PlaybackView, second: Heat): Heat | null {
  const isAlike = JSON.stringify(run.home.bounds) === JSON.stringify(other.home.bounds);
  if (!isAlike) return null;
  const seconds = second.seconds.map((of, cell) => of - first.seconds[cell]!);
  const known = new Map(first.all);
  const names = new Map([...second.all, ...first.all.filter(([name]) => !second.all.some(([one]) => one === name)).map(([name]): [string, number] => [name, 0])]);
  const all = [...names].map(([name, of]): [string, number] => [name, of - (known.get(name) ?? 0)]).sort((a, b) => Math.abs(b[1]) - Math.abs(a[1]));
  return {
    columns: second.columns, seconds, all, words: all.filter(([, of]) => Math.abs(of) >= 60).slice(0, 5),
    most: seconds.reduce((most, of) => Math.max(most, Math.abs(of)), 0), isMore: true,
  };
}

/** The possible positions of a person who triggers a sensor: along its beams, in its area, or at it. */
function spotsOf(sensor: SensorView): At[] {
  if (sensor.beams.length > 0) {
    return sensor.beams.flatMap(([from, to]) => [0.2, 0.4, 0.6, 0.8].map((share): At => [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share]));
  }
  const corners = sensor.area ?? [sensor.at];
  const middle: At = [corners.reduce((sum, at) => sum + at[0], 0) / corners.length, corners.reduce((sum, at) => sum + at[1], 0) / corners.length];
  return [middle, ...corners.map(([x, y]): At => [(x + middle[0]) / 2, (y + middle[1]) / 2])];
}

/** From 0 to 1; a minute in one spot is visible next to hours in another. */
function share(seconds: number, most: number): number {
  return most <= 1 ? 0 : Math.log1p(seconds) / Math.log1p(most);
}

export function drawHeat(pen: Pen, view: View, run: PlaybackView, heat: Heat, palette: Palette): void {
  const [[left, bottom]] = run.home.bounds;
  pen.globalAlpha = 0.8;
  heat.seconds.forEach((seconds, cell) => {
    if (Math.abs(seconds) < 1) return;
    const [column, row] = [cell % heat.columns, Math.floor(cell / heat.columns)];
    const [x, y] = toScreen(view, [left + column * CELL_M, bottom + (row + 1) * CELL_M]);
    const strength = share(Math.abs(seconds), heat.most);
    pen.fillStyle = heat.isMore ? (seconds < 0 ? palette.seen : palette.beam) : viridis(strength);
    if (heat.isMore) pen.globalAlpha = 0.85 * strength;
    const size = CELL_M * view.scale + 0.6;
    pen.fillRect(x, y, size, size);
  });
  pen.globalAlpha = 1;
}

/** `+8 h 12 min`. */
export function longMore(seconds: number): string {
  return `${seconds < 0 ? '−' : '+'}${long(Math.abs(seconds))}`;
}

/** `8 h 12 min`. */
export function long(seconds: number): string {
  const minutes = Math.round(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** The same, with seconds for short times: `4 min 12 s`. */
export function lasting(seconds: number): string {
  const whole = Math.round(seconds);
  return whole >= 600 ? long(seconds) : whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)} min ${whole % 60} s`;
}
