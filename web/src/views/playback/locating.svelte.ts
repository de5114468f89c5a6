// Locating people from a log: the server does it in the background.

import { type Server, keepPath, said, walkPath } from '../../server';
import type { LocatingView } from '../../wire';

/** Interval of progress requests. */
const EVERY_MS = 300;

/** The server's limit; larger files are not sent. */
const LARGEST_BYTES = 64 << 20;

export class Locating {
  view = $state.raw<LocatingView | null>(null);
  problem = $state('');
  private asked = 0;
  /** It has been seen in progress: otherwise it was over before anyone looked. */
  private goes = false;
  private timer: ReturnType<typeof setTimeout> | null = null;

  /** @param ondone gets the run of the located people. */
  constructor(
    private readonly server: Pick<Server, 'json' | 'post' | 'remove'>,
    private readonly ondone: (run: string) => void,
  ) {}

  get isRunning(): boolean {
    return this.view?.state === 'coming' || this.view?.state === 'walking';
  }

  /** Watches a log in progress: this page or another may have opened it earlier. */
  watch(): void {
    void this.look(++this.asked);
  }

  /** Stops watching; the server continues. */
  leave(): void {
    this.asked += 1;
    if (this.timer !== null) clearTimeout(this.timer);
  }

  /** In the home of a run, or of the scenario for null; without any home the log is only stored. */
  async open(log: File, run: string | null, ofNoHome = false): Promise<void> {
    this.problem = '';
    if (log.size > LARGEST_BYTES) {
      this.problem = `${log.name} is larger than ${LARGEST_BYTES >> 20} MB. Open a part of it, or use homebody locate.`;
      return;
    }
    if (log.size === 0) {
      this.problem = `${log.name} is empty.`;
      return;
    }
    const asked = ++this.asked;
    this.goes = true;
    this.view = { log: log.name, state: 'coming', share: 0, run: null, problem: null };
    try {
      await this.server.post(ofNoHome ? keepPath(log.name) : walkPath(log.name, run), log);
    } catch (error) {
      if (asked === this.asked) [this.view, this.goes, this.problem] = [null, false, said(error)];
      return;
    }
    await this.look(asked);
  }

  async stop(): Promise<void> {
    try {
      await this.server.remove('/api/walk');
    } catch (error) {
      this.problem = said(error);
    }
  }

  private async look(asked: number): Promise<void> {
    let view: LocatingView | null;
    try {
      view = await this.server.json<LocatingView | null>('/api/walk');
    } catch (error) {
      if (asked === this.asked) [this.view, this.goes, this.problem] = [null, false, said(error)];
      return;
    }
    if (asked !== this.asked) return;
    const went = this.goes;
    this.view = view;
    this.goes = this.isRunning;
    if (this.goes) this.timer = setTimeout(() => void this.look(asked), EVERY_MS);
    else if (went && view !== null) {
      if (view.state === 'failed') this.problem = `Cannot open ${view.log}: ${view.problem ?? ''}`;
      else if (view.run !== null) this.ondone(view.run);
    }
  }
}
