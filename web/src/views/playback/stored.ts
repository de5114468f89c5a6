// A stored run as the page knows it, and the days of it that have been fetched.

import type { Band, Drawing } from '../../charts/lanes';
import type { Shade } from '../../charts/shades';
import { dayAt } from '../../localtime';
import { type Server, restPath, storedPath } from '../../server';
import type { DayView, PlaybackView } from '../../wire';
import { type Day, prepare } from './day';
import { OUT, placeName, spansIn } from './doubt';
import { pairsOf, sensorName } from './twin';

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

/** What else is drawn beside a day: the same of another run, on the first run's time. */
export type Other = { view: PlaybackView; day: Day | null; later_us: number };

/** A day as it is drawn; nothing is in it before it has been fetched. */
export function drawingOf(view: PlaybackView, number: number, day: Day | null, truth: boolean, other: Other | null = null): Drawing {
  const { begin_us, end_us } = view.days[number]!;
  const beside = other === null ? [] : bandsOf(other.view, other.day, truth, other.later_us);
  const own = bandsOf(view, day, truth, 0);
  return {
    calendar: view,
    sight: { from_us: begin_us, to_us: end_us },
    // A resident's two bands stand below each other.
    bands: other === null ? own : own.flatMap((band, index) => [band, ...beside.slice(index, index + 1)]).concat(beside.slice(own.length)),
    shades: view.walk === null || !truth ? [] : shadesOf(view, number, day),
    lanes:
      other === null
        ? view.sensors.map((_, index) => ({ name: sensorName(view, index), kind: view.home.sensors[index]?.kind ?? '', fired: day?.fired[index] ?? [] }))
        : pairsOf(view, day, other.view, other.day, other.later_us).map(({ name, kind, first, second, onlyFirst, onlySecond }) => ({
            name, kind, fired: first, beside: { fired: second, onlyFirst, onlySecond },
          })),
  };
}

/** What residents did. */
function bandsOf(view: PlaybackView, day: Day | null, truth: boolean, later_us: number): Band[] {
  if (!truth || view.walk !== null || !view.has_truth) return [];
  return view.residents.map(({ name }, who) => {
    const spans = day?.view.lives[who]?.activities ?? [];
    return { name, who, spans: later_us === 0 ? spans : spans.map(([begin, end, what]) => [begin - later_us, end - later_us, what] as const), names: view.activities };
  });
}

/** How likely residents were in each room, and out. */
function shadesOf(view: PlaybackView, number: number, day: Day | null): Shade[] {
  const { end_us } = view.days[number]!;
  const shade = (place: number) => ({ name: placeName(view.home, place), by: (day?.doubts ?? []).map((doubt) => spansIn(doubt, place, end_us)) });
  return [...view.home.rooms.keys(), OUT].map(shade);
}
