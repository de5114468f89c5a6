// A search over the run in playback, and its hits.

import { findPath, said, type Server } from '../../server';
import type { Find, FoundView, HitView, PlaybackView, SearchSubject } from '../../wire';

/** Each kind of search, with usual hours and lengths. */
export const ASKED: Record<SearchSubject, { title: string; of: string | null; between: [number, number] | null; least_min: number }> = {
  room: { title: 'a person is in', of: 'Room', between: [0, 6], least_min: 0 },
  on: { title: 'is on or open', of: 'Sensor', between: null, least_min: 30 },
  still: { title: 'no movement', of: null, between: [8, 20], least_min: 180 },
  doing: { title: 'activity is', of: 'Activity', between: null, least_min: 0 },
  fall: { title: 'a person falls', of: null, between: null, least_min: 0 },
  seen_fall: { title: 'a fall seen by cameras', of: null, between: null, least_min: 0 },
  lost: { title: 'a lost message', of: null, between: null, least_min: 0 },
  alert: { title: 'a change that Care found', of: null, between: null, least_min: 0 },
};

/** The first choice, by words in the name. */
const FIRST = { room: /bath|toilet|wc/i, on: /stove|oven|cooker|hob/i, doing: /sleep|nap/i };

export class Finding {
  what = $state<SearchSubject>('room');
  name = $state('');
  /** Hours of the day; null for any time. */
  between = $state<[number, number] | null>(ASKED.room.between);
  least_min = $state<number | null>(0);
  found = $state.raw<FoundView | null>(null);
  /** The description of the search, in words. */
  title = $state('');
  private isOfCameras = false;
  busy = $state(false);
  /** The search and its hits are visible. */
  isOpen = $state(false);
  problem = $state('');
  private asked = 0;

  constructor(
    private readonly server: Pick<Server, 'post'>,
    private readonly stored: { readonly view: PlaybackView },
  ) {
    this.choose('room');
  }

  /** A run with an incomplete log may get further sensors and activities. */
  get run(): PlaybackView {
    return this.stored.view;
  }

  get hits(): readonly HitView[] {
    return this.found?.hits ?? [];
  }

  /** The number of hits, in words; falls by cameras and by the truth are counted separately. */
  get counted(): string {
    const { hits, found } = this;
    if (found === null) return '';
    if (this.isOfCameras) {
      const true_ = hits.filter(({ is_fall }) => is_fall).length;
      return `Falls seen by cameras: ${hits.length - true_}${this.run.has_truth ? `, in the ground truth: ${true_}` : ''}`;
    }
    return found.all === 1 ? 'Once:' : `${found.all.toLocaleString('en-GB')} times:`;
  }

  /** The possible names for a kind of search. */
  names(what: SearchSubject = this.what): string[] {
    const { home, sensors, activities } = this.run;
    if (what === 'room') return home.rooms.map(({ name }) => name);
    if (what === 'on') return sensors.map((id, index) => home.sensors[index]?.name ?? id);
    return what === 'doing' ? [...activities].sort() : [];
  }

  choose(what: SearchSubject): void {
    const names = this.names(what);
    const first = what === 'room' || what === 'on' || what === 'doing' ? FIRST[what] : null;
    this.what = what;
    this.name = names.find((name) => first?.test(name)) ?? names[0] ?? '';
    this.between = ASKED[what].between;
    this.least_min = ASKED[what].least_min;
  }

  async find(): Promise<void> {
    const asked = ++this.asked;
    const { what, name, between, least_min } = this;
    const of = ASKED[what].of === null ? null : name;
    if (between !== null && between[0] === between[1]) {
      [this.found, this.problem] = [null, 'The two times of day must differ.'];
      return;
    }
    const query: Find = {
      what,
      name: of,
      between_min: between === null ? null : [(between[0] * 60) % 1440, between[1] * 60],
      least_s: Math.max(least_min ?? 0, 0) * 60,
    };
    [this.busy, this.problem] = [true, ''];
    try {
      const found = await this.server.post<FoundView>(findPath(this.run.name), query);
      if (asked !== this.asked) return;
      this.isOfCameras = what === 'seen_fall';
      this.found = found;
      this.title = this.isOfCameras ? '' : `${of === null || what !== 'on' ? ASKED[what].title : ''}${of === null ? '' : `${what === 'room' ? ' the' : ''} ${of}`}${what === 'on' ? ` ${ASKED.on.title}` : ''}`.trim();
    } catch (error) {
      if (asked === this.asked) [this.found, this.problem] = [null, said(error)];
    } finally {
      if (asked === this.asked) this.busy = false;
    }
  }

  clear(): void {
    this.asked += 1;
    [this.found, this.problem, this.busy] = [null, '', false];
  }

  /** The index of the hit at an instant, or of the last before it; -1 before the first. */
  at(at_us: number): number {
    let [low, high] = [0, this.hits.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.hits[middle]!.begin_us <= at_us) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** The next hit, or the one before; null beyond the last. */
  next(at_us: number, forward: boolean): HitView | null {
    const now = this.at(at_us);
    if (forward) return this.hits[now + 1] ?? null;
    const here = this.hits[now];
    // At the beginning of a hit, the one before is meant.
    return here === undefined ? null : at_us - here.begin_us > 1e6 ? here : (this.hits[this.at(here.begin_us - 1)] ?? null);
  }
}
