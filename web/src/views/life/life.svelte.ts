// Whose life is written, how it was understood, and what some days of it are like.

import { Latest } from '../../latest';
import type { Live } from '../../live.svelte';
import type { Draft, Explain, ExplainView, Month, MonthView, ProblemView } from '../../wire';

const EXPLAIN_MS = 250;
const MONTH_MS = 400;

/** The days that are drawn: as they are written, and if something is left out, without that. */
type Asked = { draft: Draft; from: number; days: number; without: string[] };
type Lived = { whole: MonthView; less: MonthView | null };

/** What one drawing shows. */
export type Side = { title: string; view: MonthView };

export class Life {
  explain = $state.raw<ExplainView | null>(null);
  /** The text that it was understood from. */
  explained = $state.raw('');
  /** Why it is not known how a text was understood. */
  trouble = $state('');
  from = $state(0);
  days = $state(28);
  /** Conditions that are left out. */
  without = $state.raw<string[]>([]);
  sideBySide = $state(true);
  lived = $state.raw<(Lived & Pick<Asked, 'from' | 'without'>) | null>(null);
  /** Why these days cannot be lived. */
  problems = $state.raw<ProblemView[]>([]);
  monthTrouble = $state('');
  /** Whether other days are on their way. */
  waiting = $state(false);
  /** The day that is drawn large, counted from the first that is drawn. */
  day = $state<number | null>(null);

  private readonly explains: Latest<Explain & { text: string }, ExplainView>;
  private readonly months: Latest<Asked, Lived>;
  private file = '';

  constructor({ server }: Pick<Live, 'server'>) {
    this.explains = new Latest(
      EXPLAIN_MS,
      ({ draft, file }) => server.post<ExplainView>('/api/explain', { draft, file } satisfies Explain),
      (explain, { file, text }) => {
        if (file !== this.file) return;
        [this.explain, this.explained, this.trouble] = [explain, text, ''];
        this.without = this.without.filter((name) => explain.conditions.some((condition) => condition.name === name));
      },
      (why) => (this.trouble = why),
    );
    this.months = new Latest(
      MONTH_MS,
      async ({ without, ...of }) => {
        const month = (without: string[]) => server.packed<MonthView>('/api/month', { ...of, without } satisfies Month);
        const whole = await month([]);
        return { whole, less: without.length > 0 && whole.problems.length === 0 ? await month(without) : null };
      },
      ({ whole, less }, { from, without }) => {
        [this.waiting, this.monthTrouble] = [this.months.wants, ''];
        this.problems = [...whole.problems, ...(less?.problems ?? [])];
        // What was drawn before stays in sight while a sentence is being mended.
        if (this.problems.length > 0) return;
        this.lived = { whole, less, from, without };
        if (this.day !== null && this.day >= whole.days.length) this.day = null;
      },
      (why) => ([this.waiting, this.monthTrouble] = [this.months.wants, why]),
    );
  }

  /** What is drawn: one life, or two to compare. */
  get sides(): Side[] {
    if (this.lived === null) return [];
    const { whole, less, without } = this.lived;
    if (less === null) return [{ title: '', view: whole }];
    const left = { title: `Without ${without.join(', ')}`, view: less };
    return this.sideBySide ? [{ title: 'As it is written', view: whole }, left] : [left];
  }

  /** Another routine is looked at: nothing is known of it yet. */
  begin(file: string): void {
    this.file = file;
    [this.explain, this.explained, this.trouble, this.without, this.day] = [null, '', '', [], null];
  }

  understand(draft: Draft, file: string, text: string): void {
    this.explains.want({ draft, file, text });
  }

  draw(draft: Draft): void {
    this.waiting = true;
    this.months.want({ draft, from: this.from, days: this.days, without: this.without });
  }

  leaveOut(condition: string, out: boolean): void {
    const others = this.without.filter((name) => name !== condition);
    this.without = out ? [...others, condition] : others;
  }

  close(): void {
    this.explains.close();
    this.months.close();
  }
}
