// A plan on a canvas: still parts are on a canvas of their own, and only the moving parts are drawn over it.

import type { HomeView, ResidentView, RunFrame } from '../wire';
import { type At, distance } from './geometry';
import { NAME_HIGH, floorsOf, framed } from './floors';
import { Eased, Glow, Pulses, Throttle, isFast } from './glow';
import type { Layers } from './layers';
import { type Lain, laid, lainIn } from './lying';
import {
  type Person, drawCounts, drawDoors, drawFloor, drawOn, drawPeople, drawPulses, drawSeen, drawTrails, litRooms, sides,
} from './moving';
import { type Palette, daylight } from './palette';
import type { Pen } from './pen';
import { drawNames, drawStill, place } from './still';
import { Trails } from './trails';
import { type Insets, type Size, type View, fitBest, pan, toPlan, toScreen, zoom } from './transform';

/** The clock is at the left, or above; a scale is below it; the buttons are at the right. */
export function waysPast({ width, height }: Size): Insets[] {
  return [
    { left: width + 18, top: 12, right: 58, bottom: 12 },
    { left: 14, top: height + 20, right: 58, bottom: 42 },
  ];
}

/** The size of the clock until it is measured. */
const CLOCK: Size = { width: 150, height: 92 };

/** Distance at which the pointer shows the name of a sensor, in pixels. */
const NEAR = 14;

export type Scene = {
  home: HomeView;
  residents: ResidentView[];
  driven: number | null;
  layers: Layers;
  palette: Palette;
  reducedMotion: boolean;
};

export class Stage {
  view: View = { scale: 1, x: 0, y: 0 };
  private size: Size = { width: 0, height: 0 };
  private dpr = 1;
  private scene: Scene | null = null;
  /** The largest size of the clock, or the default. */
  private clock = CLOCK;
  private fitted = true;
  private sides: number[] = [];
  private lain: Lain[] = [];
  /** The parts below the beams of detections, and the texts over them. */
  private readonly still = document.createElement('canvas');
  private readonly names = document.createElement('canvas');
  private stillIs = false;
  private readonly glow = new Glow();
  private readonly lamps = new Glow();
  private readonly day = new Eased();
  private readonly pulses = new Pulses();
  private readonly trails = new Trails();
  /** The counts at the last growth. */
  private shown: number[] = [];
  private readonly counting = new Throttle(400);
  private frame: RunFrame | null = null;
  private sure: readonly number[] | null = null;
  private dirty = true;
  private paint: ((pen: Pen, view: View) => void) | null = null;

  constructor(private readonly canvas: HTMLCanvasElement) {}

  set(scene: Scene): void {
    const before = this.scene?.home;
    if (before !== scene.home) {
      this.sides = sides(scene.home);
      this.lain = lainIn(scene.home);
      this.trails.clear();
      this.pulses.clear();
      this.frame = null;
      // Each run sends the same home again: it stays where the user has moved it.
      if (String(before?.bounds) !== String(scene.home.bounds)) this.fitted = true;
    }
    this.scene = scene;
    if (this.fitted) this.fit();
    this.stale();
  }

  resize(width: number, height: number, dpr: number): void {
    if (width < 1 || height < 1) return;
    // More than two is invisible, but takes four times as long.
    this.dpr = Math.min(dpr, 2);
    const before = toPlan(this.view, [this.size.width / 2, this.size.height / 2]);
    this.size = { width, height };
    for (const canvas of [this.canvas, this.still, this.names]) {
      canvas.width = Math.round(width * this.dpr);
      canvas.height = Math.round(height * this.dpr);
    }
    if (this.fitted) this.fit();
    else {
      const [x, y] = toScreen(this.view, before);
      this.view = pan(this.view, width / 2 - x, height / 2 - y);
    }
    this.stale();
  }

  /** Keeps an area of this size free. The plan does not move if the clock becomes smaller. */
  past({ width, height }: Size): void {
    const clock = { width: Math.max(width, this.clock.width), height: Math.max(height, this.clock.height) };
    if (clock.width === this.clock.width && clock.height === this.clock.height) return;
    this.clock = clock;
    if (this.fitted) this.fit();
  }

  /** The content of the clock changes: forgets its size. */
  forgetClock(): void {
    this.clock = CLOCK;
    if (this.fitted) this.fit();
  }

  /** Shows all of the home, in the middle. */
  fit(): void {
    this.fitted = true;
    if (this.scene) {
      const { home } = this.scene;
      const named = floorsOf(home.rooms).length > 0 ? NAME_HIGH : 0;
      this.view = fitBest(framed(home), this.size, waysPast(this.clock).map((way) => ({ ...way, top: way.top + named })));
    }
    this.stale();
  }

  zoom(factor: number, at: At = [this.size.width / 2, this.size.height / 2]): void {
    this.fitted = false;
    this.view = zoom(this.view, factor, at);
    this.stale();
  }

  pan(dx: number, dy: number): void {
    this.fitted = false;
    this.view = pan(this.view, dx, dy);
    this.stale();
  }

  /** Draws over floor and furniture, below detections, names and people. */
  over(paint: ((pen: Pen, view: View) => void) | null): void {
    this.paint = paint;
    this.dirty = true;
  }

  /** The sensor under the pointer. */
  sensorAt(at: At): number | null {
    let [nearest, near] = [null as number | null, NEAR];
    this.scene?.home.sensors.forEach((sensor, index) => {
      const far = distance(place(sensor, this.view), at);
      if (far < near) [nearest, near] = [index, far];
    });
    return nearest;
  }

  /** `sure` is the probability of each body's position, if it is uncertain. */
  take(frame: RunFrame, now_ms: number, sure: readonly number[] | null = null): void {
    const goesBack = this.frame !== null && frame.now_us < this.frame.now_us;
    if (goesBack) this.trails.clear();
    this.frame = frame;
    this.sure = sure;
    this.trails.take(frame, now_ms);
    if (isFast(frame.speed)) this.pulses.clear();
    else for (const firing of frame.firings) this.pulses.fire(firing.sensor, now_ms);
    this.dirty = true;
  }

  /** @returns whether it drew something: a paused run costs nothing. */
  draw(now_ms: number, counts: number[] = []): boolean {
    const scene = this.scene;
    const pen = this.canvas.getContext('2d');
    if (scene === null || pen === null || this.size.width < 1) return false;
    const { frame, view } = this;
    const fast = frame !== null && frame.state !== 'paused' && isFast(frame.speed);
    const pulses = this.pulses.at(now_ms);
    const lit = this.glow.step(scene.home.sensors.length, fast || frame === null ? [] : frame.seeing, now_ms);
    const dusk = this.day.step(daylight(frame?.sun ?? 1), now_ms);
    const lamps = this.lamps.step(scene.home.rooms.length, frame ? litRooms(scene.home, frame.on) : [], now_ms);
    const fading = this.trails.fade(now_ms);
    if (fast && this.counting.due(now_ms)) {
      this.shown = counts.slice();
      this.dirty = true;
    }
    if (!this.dirty && !lit && !dusk && !lamps && !fading && pulses.length === 0) return false;
    this.dirty = pulses.length > 0;
    if (!this.stillIs) this.redrawStill(scene);

    this.begin(pen);
    pen.fillStyle = scene.palette.outside;
    pen.fillRect(0, 0, this.size.width, this.size.height);
    drawFloor(pen, scene.home, view, scene.palette, this.day.level ?? 1, this.lamps.levels);
    this.copy(pen, this.still);
    this.paint?.(pen, view);
    drawSeen(pen, scene.home, view, scene.palette, this.glow.levels, scene.layers);
    // Below all names, as a sensor on a door is at the same place.
    drawDoors(pen, scene.home, view, scene.palette, frame?.on ?? [], this.sides);
    this.copy(pen, this.names);
    if (frame === null) return true;
    drawOn(pen, scene.home, view, scene.palette, frame.on);
    if (scene.layers.trails && !scene.reducedMotion && !fast) drawTrails(pen, view, this.trails.of, now_ms);
    drawPulses(pen, scene.home, view, scene.palette, pulses, scene.reducedMotion);
    if (fast) drawCounts(pen, scene.home, view, scene.palette, this.shown);
    drawPeople(pen, view, scene.palette, this.persons(scene, frame), this.size);
    return true;
  }

  private persons(scene: Scene, frame: RunFrame): Person[] {
    return scene.residents.flatMap((resident, index) => {
      const body = frame.bodies[index];
      return body ? [{ resident, body: laid(body, this.lain), index, driven: scene.driven === index, sure: this.sure?.[index] ?? 1 }] : [];
    });
  }

  private begin(pen: Pen): void {
    pen.setTransform(this.dpr, 0, 0, this.dpr, 0, 0);
  }

  private copy(pen: Pen, from: HTMLCanvasElement): void {
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(from, 0, 0);
    this.begin(pen);
  }

  private stale(): void {
    this.stillIs = false;
    this.dirty = true;
  }

  private redrawStill(scene: Scene): void {
    for (const [canvas, draw] of [[this.still, drawStill], [this.names, drawNames]] as const) {
      const pen = canvas.getContext('2d');
      if (pen === null) return;
      pen.setTransform(1, 0, 0, 1, 0, 0);
      pen.clearRect(0, 0, canvas.width, canvas.height);
      this.begin(pen);
      draw(pen, scene.home, this.view, scene.layers, scene.palette, this.size);
    }
    this.stillIs = true;
  }
}
