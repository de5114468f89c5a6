// What the sensors see, asked of the server as the home is edited: one question is under way at a time, and the next one is
// about the latest draft, so that no answer is waited for in vain.

import { said } from '../../drafts.svelte';
import type { Server } from '../../server';
import type { Draft, HomeView, PlanView, ProblemView, CoverageView } from '../../wire';

export type Seen = { home: HomeView; coverage: CoverageView };

type Question = { draft: Draft; alone: Draft | null };

export class Coverage {
  /** Of the last draft that was sound. */
  seen = $state.raw<Seen | null>(null);
  /** What the selected sensor sees, as if it were the only one. */
  alone = $state.raw<CoverageView | null>(null);
  /** Whether the draft of now is one that is not sound. */
  stale = $state(false);
  /** Of the home's file; nothing before the first answer. */
  problems = $state.raw<ProblemView[] | null>(null);
  trouble = $state('');
  private next: Question | null = null;
  private busy = false;

  constructor(private readonly server: Server) {}

  /** Asks about a draft, and about the same with a single sensor, if that is wanted. */
  ask(draft: Draft, alone: Draft | null): void {
    this.next = { draft, alone };
    if (!this.busy) void this.go();
  }

  private async go(): Promise<void> {
    this.busy = true;
    while (this.next !== null) {
      const { draft, alone } = this.next;
      this.next = null;
      try {
        const { problems, home, coverage } = await this.server.packed<PlanView>('/api/plan', draft);
        this.problems = problems;
        if (home && coverage) this.seen = { home, coverage };
        this.stale = home === null;
        const single = alone && home ? await this.server.packed<PlanView>('/api/plan', alone) : null;
        if (home) this.alone = single?.coverage ?? null;
        this.trouble = '';
      } catch (error) {
        this.trouble = `What the sensors see cannot be counted: ${said(error)}`;
        this.stale = true;
      }
    }
    this.busy = false;
  }
}
