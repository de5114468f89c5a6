// The state of playback: one run or two, with one clock.

import { Throttle } from '../../plan/glow';
import { Refused, type Server } from '../../server';
import type { StoredView } from '../../wire';
import { read } from '../../clock';
import { dayAt, follow, instantOf } from '../../localtime';
import { runName } from './run-names';
import { MOST_DAYS, type Other, Stored } from './stored';
import { keepMarks, marksOf } from './marks';
import { Ticker } from './ticker';
import { correspondingDay } from './comparison';

/** Text changes at most this often, so that it can be read. */
const TEXT_MS = 100;

export class Player {
  list = $state.raw<StoredView[] | null>(null);
  first = $state.raw<Stored | null>(null);
  second = $state.raw<Stored | null>(null);
  /** The name of the run that is being opened. */
  opening = $state<string | null>(null);
  problem = $state('');
  playing = $state(false);
  speed = $state(1);
  skip = $state(false);
  truth = $state(true);
  heat = $state(false);
  /** Draws the second run's excess over the first, instead of its content. */
  differ = $state(true);
  /** The instant of texts; drawings use every one. */
  shown_us = $state(0);
  /** The user's marks in the first run, in order; the browser stores them. */
  marks = $state.raw<readonly number[]>([]);
  /** Share of the day that has arrived, if it arrives in pieces. */
  share = $state<number | null>(null);
  /** Share of a long run's log that has been read. */
  read = $state<number | null>(null);
  /** Grows when a day arrives. */
  came = $state(0);
  /** Grows when the user jumps to another time; not as time passes. */
  went = $state(0);

  ticker: Ticker | null = null;
  private readonly texts = new Throttle(TEXT_MS);
  /** Of several runs chosen in a row only the last is shown. */
  private asked = 0;
  private askedBeside = 0;

  constructor(private readonly server: Pick<Server, 'json' | 'packed'>) {}

  /** Fetches the list, and opens a run with this name, or the latest, at a moment of its clock. */
  async begin(name: string | null, moment: string | null = null): Promise<void> {
    await this.refresh();
    if (this.list === null) return;
    const wanted = name ?? this.list.find(({ problem }) => problem === null)?.name;
    if (wanted !== undefined) await this.open(wanted, moment);
  }

  /** Fetches the list again after a new run. */
  async refresh(): Promise<void> {
    try {
      this.list = await this.server.json<StoredView[]>('/api/runs');
    } catch (error) {
      this.problem = said(error);
    }
  }

  async open(name: string, moment: string | null = null): Promise<void> {
    const asked = ++this.asked;
    if (this.first?.view.name === name) {
      this.opening = null;
      this.goTo(moment);
      return;
    }
    this.pause();
    this.opening = name;
    this.problem = '';
    this.read = null;
    try {
      const run = await Stored.open(this.server, name);
      if (asked !== this.asked) return;
      if (run.view.days.length === 0) throw new Refused(422, 'This run is empty: it contains no simulated time.');
      if (this.second?.view.name === name) this.second = null;
      this.first = run;
      this.marks = marksOf(name);
      this.ticker = new Ticker(run);
      this.set();
      this.show();
      if (!this.goTo(moment)) this.load();
      void this.readOn(run);
    } catch (error) {
      if (asked === this.asked) this.problem = said(error);
    } finally {
      if (asked === this.asked) this.opening = null;
    }
  }

  /** The run on display was deleted. */
  close(): void {
    this.pause();
    this.asked += 1;
    this.first = this.ticker = null;
  }

  async beside(name: string | null): Promise<void> {
    const asked = ++this.askedBeside;
    this.second = null;
    if (name === null) {
      this.opening = null;
      return;
    }
    this.opening = name;
    try {
      const run = await Stored.open(this.server, name);
      if (asked !== this.askedBeside || this.first?.view.name === name) return;
      this.second = run;
      this.problem = '';
      this.load();
      void this.readOn(run);
    } catch (error) {
      if (asked === this.askedBeside) this.problem = said(error);
    } finally {
      if (asked === this.askedBeside) this.opening = null;
    }
  }

  /** The view of a run grows until all of its log is read. */
  private async readOn(run: Stored): Promise<void> {
    const wanted = () => run === this.first || run === this.second;
    try {
      await run.readAll(wanted, (share) => run === this.first && (this.read = share));
    } catch (error) {
      if (wanted()) this.problem = said(error);
    }
    if (run === this.first) this.read = null;
  }

  /** The instant of the second run. */
  get second_us(): number | null {
    return this.first && this.second && this.ticker ? follow(this.first.view, this.ticker.now_us, this.second.view) : null;
  }

  /** The name of a run next to another one. */
  called({ view }: Stored): string {
    const listed = this.list?.find(({ name }) => name === view.name);
    return listed === undefined ? view.name : runName(listed);
  }

  /** The second run's day that corresponds to a day of the first; it may not have arrived. */
  besideOn(number: number): Other | null {
    if (this.first === null || this.second === null) return null;
    const { view } = this.second;
    const beside = correspondingDay(this.first.view, number, view);
    return { view, day: beside === null ? null : this.second.at(view.days[beside.number]!.begin_us), later_us: beside?.later_us ?? 0 };
  }

  /** Marks the present time, or removes the mark. */
  mark(): void {
    if (this.first === null || this.ticker === null) return;
    const at_us = Math.round(this.ticker.now_us);
    const near = this.marks.find((one) => Math.abs(one - at_us) < 1e6);
    this.marks = near === undefined ? [...this.marks, at_us].sort((a, b) => a - b) : this.marks.filter((one) => one !== near);
    keepMarks(this.first.view.name, this.marks);
  }

  /** Fetches the visible days of the first run, and those of the second next to them; for too many days only the counts of both. */
  async look(numbers: readonly number[]): Promise<void> {
    const { first, second } = this;
    if (first === null) return;
    if (numbers.length > MOST_DAYS) {
      await Promise.all([first, second].map((run) => run && this.count(run)));
      return;
    }
    for (const number of numbers) {
      if (first.known(number) === null) await this.fetch(first, number, false);
      const beside = second === null ? null : correspondingDay(first.view, number, second.view);
      if (second !== null && beside !== null && second.known(beside.number) === null) await this.fetch(second, beside.number, false);
    }
  }

  private async count(run: Stored): Promise<void> {
    if (run.lanes !== null) return;
    const wanted = () => run === this.first || run === this.second;
    try {
      await run.count();
      if (wanted()) this.came += 1;
    } catch (error) {
      if (wanted()) this.problem = said(error);
    }
  }

  step(seconds: number, now_ms: number): void {
    const { ticker } = this;
    if (ticker === null) return;
    const before = ticker.number;
    // A hidden page does not catch up.
    ticker.step(Math.min(seconds, 0.25));
    if (ticker.number !== before || (ticker.playing && this.first?.at(ticker.now_us) === null)) this.load();
    if (this.playing !== ticker.playing) this.show();
    else if (ticker.playing && this.texts.due(now_ms)) this.shown_us = ticker.now_us;
  }

  toggle(): void {
    if (this.ticker === null) return;
    if (this.ticker.playing) this.ticker.playing = false;
    else this.ticker.play();
    this.show();
    this.load();
  }

  /** Cancels the rest of a day in pieces. */
  stop(): void {
    this.first?.stop();
  }

  pause(): void {
    if (this.ticker) this.ticker.playing = false;
    this.playing = false;
  }

  go(to_us: number): void {
    this.ticker?.go(to_us);
    this.arrive();
  }

  /** @returns whether the run has such a moment: a date and a time on its clock. */
  private goTo(moment: string | null): boolean {
    const at_us = this.first === null || moment === null ? null : instantOf(this.first.view, read(moment));
    if (at_us !== null) this.go(at_us);
    return at_us !== null;
  }

  turn(days: number): void {
    this.ticker?.turn(days);
    this.arrive();
  }

  activity(forward: boolean): void {
    this.ticker?.activity(forward);
    this.arrive();
  }

  set(): void {
    if (this.ticker === null) return;
    this.ticker.speed = this.speed;
    this.ticker.skip = this.skip;
    this.ticker.alone = !this.truth || !this.ticker.run.view.has_truth;
  }

  private arrive(): void {
    this.went += 1;
    this.show();
    this.load();
  }

  private show(): void {
    if (this.ticker === null) return;
    this.shown_us = this.ticker.now_us;
    this.playing = this.ticker.playing;
  }

  /** Fetches the present day of each run, then the next and the one before. */
  private load(): void {
    for (const [run, at] of [[this.first, this.ticker?.now_us ?? null], [this.second, this.second_us]] as const) {
      if (run === null || at === null) continue;
      const today = dayAt(run.view, at);
      void (async () => {
        if (!(await this.fetch(run, today, true))) return;
        for (const ahead of [today + 1, today - 1, today + 2]) await this.fetch(run, ahead, false);
      })();
    }
  }

  /** @returns whether the day is here. A failed fetch in advance is repeated on that day. */
  private async fetch(run: Stored, number: number, now: boolean): Promise<boolean> {
    if (number < 0 || number >= run.view.days.length) return false;
    const isNew = !run.has(number);
    try {
      await run.day(number, (share) => now && run === this.first && (this.share = share));
    } catch (error) {
      if (now && (run === this.first || run === this.second)) {
        this.problem = said(error);
        this.pause();
      }
      return false;
    }
    if (now && run === this.first) this.share = null;
    if (isNew) this.came += 1;
    return true;
  }
}

function said(error: unknown): string {
  return error instanceof Refused ? error.message : 'Cannot show the run: cannot read the answer of the server.';
}
