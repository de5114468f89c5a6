// What the sensors see, asked of the server as the home is edited: always of the latest draft, so that no answer is waited for
// in vain.

import { Latest } from '../../latest';
import type { Server } from '../../server';
import type { Draft, HomeView, PlanView, ProblemView, CoverageView } from '../../wire';

type Seen = { home: HomeView; coverage: CoverageView };

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
  /** The drafts in which these were found. */
  of = $state.raw<Draft['texts'] | null>(null);
  trouble = $state('');
  private readonly questions: Latest<Question, void>;

  constructor(server: Server) {
    this.questions = new Latest(
      0,
      async ({ draft, alone }) => {
        const { problems, home, coverage } = await server.packed<PlanView>('/api/plan', draft);
        [this.problems, this.of] = [problems, draft.texts];
        if (home && coverage) this.seen = { home, coverage };
        this.stale = home === null;
        const single = alone && home ? await server.packed<PlanView>('/api/plan', alone) : null;
        if (home) this.alone = single?.coverage ?? null;
      },
      () => (this.trouble = ''),
      (why) => ([this.trouble, this.stale] = [`Cannot calculate the coverage: ${why}`, true]),
    );
  }

  /** Asks about a draft, and about the same with a single sensor, if that is wanted. */
  ask(draft: Draft, alone: Draft | null): void {
    this.questions.want({ draft, alone });
  }

  close(): void {
    this.questions.close();
  }
}
