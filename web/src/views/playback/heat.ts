// How long somebody was where on a day: by the truth, or, where there is none, by the sensors that were the last to fire.

import { viridis } from '../../plan/palette';
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
  const sorted = [...words].sort((a, b) => b[1] - a[1]).filter(([, of]) => of >= 60);
  return { columns, seconds, most: seconds.reduce((a, b) => Math.max(a, b), 0), words: sorted.slice(0, 5) };
}

/** Where who makes a sensor fire may be: along its beams, or in its area, or at it. */
function spotsOf(sensor: SensorView): At[] {
  if (sensor.beams.length > 0) {
    return sensor.beams.flatMap(([from, to]) => [0.2, 0.4, 0.6, 0.8].map((share): At => [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share]));
  }
  const corners = sensor.area ?? [sensor.at];
  const middle: At = [corners.reduce((sum, at) => sum + at[0], 0) / corners.length, corners.reduce((sum, at) => sum + at[1], 0) / corners.length];
  return [middle, ...corners.map(([x, y]): At => [(x + middle[0]) / 2, (y + middle[1]) / 2])];
}

/** From 0 to 1; a minute in one spot is seen beside hours in another. */
function share(seconds: number, most: number): number {
  return most <= 1 ? 0 : Math.log1p(seconds) / Math.log1p(most);
}

export function drawHeat(pen: Pen, view: View, run: PlaybackView, heat: Heat): void {
  const [[left, bottom]] = run.home.bounds;
  pen.globalAlpha = 0.8;
  heat.seconds.forEach((seconds, cell) => {
    if (seconds < 1) return;
    const [column, row] = [cell % heat.columns, Math.floor(cell / heat.columns)];
    const [x, y] = toScreen(view, [left + column * CELL_M, bottom + (row + 1) * CELL_M]);
    pen.fillStyle = viridis(share(seconds, heat.most));
    const size = CELL_M * view.scale + 0.6;
    pen.fillRect(x, y, size, size);
  });
  pen.globalAlpha = 1;
}

/** `8 h 12 min`. */
export function long(seconds: number): string {
  const minutes = Math.round(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}
