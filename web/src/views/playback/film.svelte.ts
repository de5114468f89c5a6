// The camera pictures of a stored run around the present time. They arrive in parts, and the last few are kept: nothing
// else of the server's file is read.

import type { Look } from '../../cameras/silhouette';
import type { At } from '../../plan/geometry';
import { type Server, filmPath, said } from '../../server';
import type { SilhouettesView, MomentView, PersonView, PlaybackView } from '../../wire';
import { above } from './sorted-search';

/** Length of a part, in the run's time. */
const PART_US = 10e6;
/** Number of parts that are kept; the least recently used go first. */
const KEPT = 12;
/** Up to this speed every picture is fetched; above it, five in a second of the watcher's time. */
const ALL_UP_TO = 5;

type Part = { moments: MomentView[]; corner: At; edge_m: number };
/** The content at an instant. */
export type Shown = { looks: (Look | null)[]; person: PersonView | null; corner: At; edge_m: number };

export class Film {
  /** Grows when a part arrives. */
  came = $state(0);
  problem = $state('');
  /** The numbers of cameras among the home's sensors. */
  readonly cameras: number[];
  private readonly parts = new Map<string, Part>();
  private wanted: { at_us: number; speed: number; ahead: boolean } | null = null;
  private busy = false;

  constructor(
    private readonly server: Pick<Server, 'packed'>,
    private readonly run: PlaybackView,
  ) {
    this.cameras = run.home.sensors.flatMap(({ camera }, index) => (camera === null ? [] : [index]));
  }

  /** Requests the pictures of an instant at this speed, and with `ahead` the next ones. */
  want(at_us: number, speed: number, ahead: boolean): void {
    this.wanted = { at_us, speed, ahead };
    void this.fetch();
  }

  /**
   * The content at an instant, without pictures that have not arrived.
   *
   * @param awake by camera, its state in the log.
   */
  at(at_us: number, speed: number, awake: readonly boolean[]): Shown {
    const { every_us, key } = partOf(at_us, speed);
    const part = this.parts.get(key(0));
    if (part === undefined) return { looks: this.cameras.map(() => null), person: null, corner: [0, 0], edge_m: 0 };
    const moments = [...(this.parts.get(key(-1))?.moments.slice(-3) ?? []), ...part.moments];
    const last = above(moments, at_us, (moment) => moment.at_us);
    /** The latest picture of a camera, if none was due since. */
    const latest = <T>(period_us: number, find: (moment: MomentView) => T | undefined): T | undefined => {
      for (let index = last - 1; index >= 0 && at_us - moments[index]!.at_us <= Math.max(period_us, every_us); index--) {
        const found = find(moments[index]!);
        if (found !== undefined) return found;
      }
      return undefined;
    };
    const periods = this.cameras.map((camera) => this.run.home.sensors[camera]!.camera!.period_us);
    const looks = this.cameras.map((camera, index): Look => {
      const packed = latest(periods[index]!, ({ pictures }) => pictures.find(({ sensor }) => sensor === camera)?.packed) ?? [];
      return { awake: awake[index] === true || packed.length > 0, packed };
    });
    const person = latest(Math.max(...periods, 0), ({ persons }) => persons.find(({ cubes }) => cubes.length > 0) ?? persons[0]) ?? null;
    return { looks, person, corner: part.corner, edge_m: part.edge_m };
  }

  private async fetch(): Promise<void> {
    if (this.busy || this.wanted === null) return;
    const { at_us, speed, ahead } = this.wanted;
    const { span, key } = partOf(at_us, speed);
    const missing = (ahead ? [0, 1] : [0]).find((step) => !this.parts.has(key(step)) && span(step)[0] < this.run.length_us);
    if (missing === undefined) return;
    this.busy = true;
    try {
      this.keep(key(missing), await this.whole(...span(missing), partOf(at_us, speed).every_us));
      this.problem = '';
    } catch (error) {
      // It is not requested again before another one.
      [this.wanted, this.problem] = [null, said(error)];
    } finally {
      this.busy = false;
    }
    void this.fetch();
  }

  private async whole(from_us: number, to_us: number, every_us: number): Promise<Part> {
    const part: Part = { moments: [], corner: [0, 0], edge_m: 0 };
    for (let next = from_us; next < to_us; ) {
      const view = await this.server.packed<SilhouettesView>(filmPath(this.run.name, next, to_us, every_us));
      part.moments.push(...view.moments);
      [part.corner, part.edge_m] = [view.corner, view.edge_m];
      // Without progress of the server, requests would never end.
      if (view.until_us <= next) break;
      next = Math.min(view.until_us, to_us);
    }
    return part;
  }

  private keep(key: string, part: Part): void {
    this.parts.set(key, part);
    for (const old of [...this.parts.keys()].slice(0, -KEPT)) this.parts.delete(old);
    this.came += 1;
  }
}

/** The part of an instant: the interval of its pictures, its span and its name, and its neighbours. */
export function partOf(at_us: number, speed: number) {
  const times = speed <= ALL_UP_TO ? 1 : Math.ceil(speed);
  const every_us = times === 1 ? 0 : times * 0.2e6;
  const long_us = PART_US * times;
  const number = Math.floor(at_us / long_us);
  return {
    every_us,
    span: (step: number): [number, number] => [(number + step) * long_us, (number + step + 1) * long_us],
    key: (step: number) => `${times} ${number + step}`,
  };
}
