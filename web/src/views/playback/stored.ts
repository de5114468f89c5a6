// A stored run as the page knows it, and the days of it that have been fetched.

import type { DayDrawing } from '../../charts/lanes';
import { dayAt } from '../../localtime';
import { type Server, restPath, storedPath } from '../../server';
import type { DayView, PlaybackView } from '../../wire';
import { type Day, prepare } from './day';
import { OUT, placeName, spansIn } from './doubt';

/** So many days are kept; those that were wanted longest ago go first. */
const KEPT = 12;

export class Stored {
  private readonly days = new Map<number, Day>();
  private readonly coming = new Map<number, Promise<Day>>();
  /** Nothing more of a day that is on its way is asked for. */
  private stopped = false;

  constructor(
    readonly view: PlaybackView,
    private readonly server: Pick<Server, 'packed'>,
  ) {}

  static async open(server: Pick<Server, 'json' | 'packed'>, name: string): Promise<Stored> {
    return new Stored(await server.json<PlaybackView>(storedPath(name)), server);
  }

  /** The day of an instant, if it is here already. */
  at(at_us: number): Day | null {
    return this.days.get(dayAt(this.view, at_us)) ?? null;
  }

  has(number: number): boolean {
    return this.days.has(number);
  }

  /** What has come of days that are on their way is all that is shown of them. */
  stop(): void {
    if (this.coming.size > 0) this.stopped = true;
  }

  /** A day of a very large truth comes in pieces. */
  private async pieces(number: number, onshare: (share: number) => void): Promise<DayView> {
    this.stopped = false;
    const { begin_us, end_us } = this.view.days[number]!;
    const view = await this.server.packed<DayView>(storedPath(this.view.name, number));
    while (view.until_us < end_us && !this.stopped) {
      onshare((view.until_us - begin_us) / Math.max(end_us - begin_us, 1));
      const more = await this.server.packed<DayView>(restPath(this.view.name, number, view.until_us));
      // A server that does not come on would be asked for ever.
      if (more.until_us <= view.until_us) break;
      view.until_us = more.until_us;
      more.lives.forEach(({ movements }, who) => {
        const known = view.lives[who]?.movements;
        const last = known?.at(-1)?.[1] ?? -Infinity;
        for (const movement of movements) if (movement[1] > last) known?.push(movement);
      });
    }
    return view;
  }

  /** A day, fetched if need be. */
  async day(number: number, onshare: (share: number) => void = () => {}): Promise<Day> {
    const known = this.days.get(number);
    if (known !== undefined) {
      // It is the last one that was wanted now.
      this.days.delete(number);
      this.days.set(number, known);
      return known;
    }
    const before = this.coming.get(number);
    if (before !== undefined) return before;
    const fetched = this.pieces(number, onshare).then((view) => {
      const day = prepare(this.view, number, view);
      this.days.set(number, day);
      for (const old of [...this.days.keys()].slice(0, -KEPT)) this.days.delete(old);
      return day;
    });
    this.coming.set(number, fetched);
    try {
      return await fetched;
    } finally {
      this.coming.delete(number);
    }
  }
}

/** A day as it is drawn; nothing is in it before it has been fetched. */
export function drawingOf(view: PlaybackView, number: number, day: Day | null, truth: boolean): DayDrawing {
  return {
    calendar: view,
    number,
    ...(view.walk === null ? done(view, day, truth) : walked(view, number, day, truth)),
    lanes: view.sensors.map((id, index) => {
      const sensor = view.home.sensors[index];
      return { name: sensor?.name ?? id, kind: sensor?.kind ?? '', fired: day?.fired[index] ?? [] };
    }),
  };
}

/** What residents did. */
function done(view: PlaybackView, day: Day | null, truth: boolean): Pick<DayDrawing, 'bands' | 'activities'> {
  const bands = truth ? view.residents.map(({ name }, index) => ({ name, spans: day?.view.lives[index]?.activities ?? [] })) : [];
  return { bands, activities: view.activities };
}

/** How likely residents were in each room, and out. */
function walked(view: PlaybackView, number: number, day: Day | null, truth: boolean): Pick<DayDrawing, 'bands' | 'activities' | 'shades'> {
  const { end_us } = view.days[number]!;
  const places = [...view.home.rooms.keys(), OUT];
  const shade = (place: number) => ({ name: placeName(view.home, place), by: (day?.doubts ?? []).map((doubt) => spansIn(doubt, place, end_us)) });
  return { bands: [], activities: [], shades: truth ? places.map(shade) : [] };
}
