// The coverage of the sensors, requested while the home is edited: always for the latest draft, so that no answer is
// useless.

import { Latest } from '../../latest';
import type { Server } from '../../server';
import type { Draft, HomeView, PlanView, ProblemView, CoverageView } from '../../wire';

type Seen = { home: HomeView; coverage: CoverageView };

type Question = { draft: Draft; alone: Draft | null };

export class Coverage {
  /** Of the last valid draft. */
  seen = $state.raw<Seen | null>(null);
  /** The coverage of the selected sensor alone. */
  alone = $state.raw<CoverageView | null>(null);
  /** The present draft is invalid. */
  stale = $state(false);
  /** Of the home's file; null before the first answer. */
  problems = $state.raw<ProblemView[] | null>(null);
  /** The drafts with these problems. */
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

  /** Requests the coverage of a draft, and of the same draft with a single sensor. */
  ask(draft: Draft, alone: Draft | null): void {
    this.questions.want({ draft, alone });
  }

  close(): void {
    this.questions.close();
  }
}
