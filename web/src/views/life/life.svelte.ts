// The edited resident: their routine, its interpretation, and some of their days.

import { Latest } from '../../latest';
import type { Live } from '../../live.svelte';
import type { Draft, Explain, ExplainView, Month, MonthView, ProblemView } from '../../wire';

const EXPLAIN_MS = 250;
const MONTH_MS = 400;

/** A request for days: as written, and with `without`, also without some conditions. */
type Asked = { draft: Draft; from: number; days: number; without: string[]; text: (name: string) => string | undefined };
type Lived = { whole: MonthView; less: MonthView | null };
/** The drawn days: which ones, without which conditions, and without which wrong lines. */
type Drawn = Lived & Pick<Asked, 'from' | 'days' | 'without'> & { lacks: readonly ProblemView[] };

/** The content of one drawing. */
export type Side = { title: string; view: MonthView };

/** The drafts with wrong lines of routines emptied; null if another problem remains. */
export function withoutLines(draft: Draft, problems: readonly ProblemView[], text: Asked['text']): Draft | null {
  const texts = { ...draft.texts };
  for (const { file, line } of problems) {
    const lines = text(file) === undefined ? [] : (texts[file] ?? text(file)!).split('\n');
    if (line <= 0 || line > lines.length) return null;
    texts[file] = lines.with(line - 1, '').join('\n');
  }
  return { texts };
}

/** The lines or files of problems: `Line 3`, `Lines 3 and 7`, `home.json`. */
export function whereOf(problems: readonly Pick<ProblemView, 'file' | 'line'>[], file: string): string {
  const own = problems.every((problem) => problem.file === file && problem.line > 0);
  if (!own) return [...new Set(problems.map((problem) => problem.file.slice(0, 100)))].slice(0, 3).join(', ');
  const lines = [...new Set(problems.map(({ line }) => line))].sort((a, b) => a - b);
  if (lines.length === 1) return `Line ${lines[0]}`;
  const first = lines.length > 4 ? [...lines.slice(0, 3), `${lines.length - 3} more`] : lines;
  return `Lines ${first.slice(0, -1).join(', ')} and ${first.at(-1)}`;
}

export class Life {
  explain = $state.raw<ExplainView | null>(null);
  /** The interpreted text. */
  explained = $state.raw('');
  /** The reason why there is no interpretation. */
  trouble = $state('');
  from = $state(0);
  days = $state(28);
  /** Conditions that are left out. */
  without = $state.raw<string[]>([]);
  sideBySide = $state(true);
  lived = $state.raw<Drawn | null>(null);
  /** The reasons why these days cannot be simulated. */
  problems = $state.raw<ProblemView[]>([]);
  monthTrouble = $state('');
  /** Other days are on their way. */
  waiting = $state(false);
  /** The day that is drawn large, counted from the first drawn one. */
  day = $state<number | null>(null);

  private readonly explains: Latest<Explain & { text: string }, ExplainView>;
  private readonly months: Latest<Asked, Lived & { problems: ProblemView[] }>;
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
      async ({ without, text, draft, ...of }) => {
        const month = (draft: Draft, without: string[]) => server.packed<MonthView>('/api/month', { ...of, draft, without } satisfies Month);
        const written = await month(draft, []);
        // Drawn days stay while the user types. Before the first ones, wrong lines are left out.
        const isThere = this.lived !== null && this.lived.lacks.length === 0 && this.lived.from === of.from && this.lived.days === of.days;
        const rest = written.problems.length === 0 || isThere ? null : withoutLines(draft, written.problems, text);
        const whole = rest === null ? written : await month(rest, []);
        return { problems: written.problems, whole, less: without.length > 0 && whole.problems.length === 0 ? await month(rest ?? draft, without) : null };
      },
      ({ problems, whole, less }, { from, days, without }) => {
        [this.waiting, this.monthTrouble] = [this.months.wants, ''];
        this.problems = [...problems, ...(less?.problems ?? [])];
        if (whole.problems.length > 0 || (less !== null && less.problems.length > 0)) return;
        this.lived = { whole, less, from, days, without, lacks: problems };
        if (this.day !== null && this.day >= whole.days.length) this.day = null;
      },
      (why) => ([this.waiting, this.monthTrouble] = [this.months.wants, why]),
    );
  }

  /** The drawings: one variant, or two to compare. */
  get sides(): Side[] {
    if (this.lived === null) return [];
    const { whole, less, without } = this.lived;
    if (less === null) return [{ title: '', view: whole }];
    const left = { title: `Without ${without.join(', ')}`, view: less };
    return this.sideBySide ? [{ title: 'With all conditions', view: whole }, left] : [left];
  }

  /** Opens another routine, without an interpretation yet. */
  begin(file: string): void {
    this.file = file;
    [this.explain, this.explained, this.trouble, this.without, this.day] = [null, '', '', [], null];
  }

  understand(draft: Draft, file: string, text: string): void {
    this.explains.want({ draft, file, text });
  }

  /** @param text of a routine's file in its present form; undefined for another file. */
  draw(draft: Draft, text: Asked['text']): void {
    this.waiting = true;
    this.months.want({ draft, text, from: this.from, days: this.days, without: this.without });
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
