// A log that is opened here: it goes to the server, which walks it back through a home while everything else goes on.

import { type Server, keepPath, said, walkPath } from '../../server';
import type { LocatingView } from '../../wire';

/** How often is asked how far it is. */
const EVERY_MS = 300;

/** As much as the server takes; what is larger is not sent. */
const LARGEST_BYTES = 64 << 20;

export class Walking {
  view = $state.raw<LocatingView | null>(null);
  problem = $state('');
  private asked = 0;
  /** Whether it has been seen on its way: else it was over before anybody looked. */
  private goes = false;
  private timer: ReturnType<typeof setTimeout> | null = null;

  /** @param ondone is told the run that came of a log. */
  constructor(
    private readonly server: Pick<Server, 'json' | 'post' | 'remove'>,
    private readonly ondone: (run: string) => void,
  ) {}

  get isGoingOn(): boolean {
    return this.view?.state === 'coming' || this.view?.state === 'walking';
  }

  /** Looks whether one is on its way already: another page may have opened it, or this one before. */
  watch(): void {
    void this.look(++this.asked);
  }

  /** Nobody looks any more; the server goes on. */
  leave(): void {
    this.asked += 1;
    if (this.timer !== null) clearTimeout(this.timer);
  }

  /** Through the home of a run, or of the scenario where that is null; of no home at all it is kept as it is. */
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
    this.goes = this.isGoingOn;
    if (this.goes) this.timer = setTimeout(() => void this.look(asked), EVERY_MS);
    else if (went && view !== null) {
      if (view.state === 'failed') this.problem = `Cannot open ${view.log}: ${view.problem ?? ''}`;
      else if (view.run !== null) this.ondone(view.run);
    }
  }
}
