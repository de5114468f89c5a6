// A text that becomes statements: the server asks a model in the background, or reads the answers of an assistant.

import type { Drafts } from '../../drafts.svelte';
import { said } from '../../server';
import type { AcceptLines, AcceptedView, Answerer, DraftLineView, FreeTextRequest, FreeTextView } from '../../wire';

/** Interval of progress requests. */
const EVERY_MS = 400;

const PATH = '/api/free-text';

/** A routine can have one of the statements. */
export function isUsable(line: DraftLineView): boolean {
  return line.statements.some(({ refused }) => refused === null);
}

/** The present text with a routine below it. */
export function below(text: string, routine: string): string {
  return text.trim() === '' ? routine : `${text.trimEnd()}\n\n${routine}`;
}

export class FreeText {
  view = $state.raw<FreeTextView | null>(null);
  problem = $state('');
  /** By line. */
  accepted = $state<boolean[]>([]);
  /** Statements of accepted lines that are only comments. */
  lost = $state.raw<string[]>([]);
  /** What this page has asked for last: a page that was loaded anew has none. */
  request = $state.raw<Pick<FreeTextRequest, 'text' | 'by'> | null>(null);
  private asked = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly drafts: Drafts,
    readonly file: string,
  ) {}

  get isRunning(): boolean {
    return this.view !== null && ['beginning', 'asking', 'checking'].includes(this.view.state);
  }

  /** The answers of an assistant, while the conversation is by hand. */
  get answers(): string[] | null {
    return this.request?.by.kind === 'assistant' ? this.request.by.answers : null;
  }

  /** Sends the next answer of the assistant, about the text of its prompt. */
  async answer(answer: string): Promise<void> {
    if (this.request === null || this.answers === null) return;
    await this.ask(this.request.text, { kind: 'assistant', answers: [...this.answers, answer] });
  }

  get usable(): number {
    return this.view?.lines.filter(isUsable).length ?? 0;
  }

  /** Shows the latest text of the home: it may have been sent before this page was loaded. */
  watch(): void {
    void this.look(++this.asked);
  }

  /** Stops watching; the server continues. */
  leave(): void {
    this.asked += 1;
    clearTimeout(this.timer);
  }

  async ask(text: string, by: Answerer): Promise<void> {
    const asked = ++this.asked;
    [this.problem, this.lost] = ['', []];
    this.request = { text, by };
    try {
      this.take(await this.drafts.server.post<FreeTextView>(PATH, { draft: this.drafts.draft, file: this.file, text, by } satisfies FreeTextRequest), asked);
    } catch (error) {
      if (asked === this.asked) this.problem = said(error);
    }
  }

  async stop(): Promise<void> {
    try {
      await this.drafts.server.remove(PATH);
    } catch (error) {
      this.problem = said(error);
    }
  }

  acceptAll(all: boolean): void {
    this.accepted = this.view?.lines.map((line) => all && isUsable(line)) ?? [];
  }

  /** Puts the accepted lines into the draft of the routine, below its text or in its place. Nothing is saved. */
  async put(replace: boolean): Promise<void> {
    if (this.view === null) return;
    const lines = { number: this.view.number, accepted: [...this.accepted] } satisfies AcceptLines;
    try {
      const { text, lost } = await this.drafts.server.post<AcceptedView>(`${PATH}/routine`, lines);
      const before = this.drafts.text(this.file) ?? '';
      this.drafts.applyFix('Rows from a text', { [this.file]: replace ? text : below(before, text) });
      [this.lost, this.problem] = [lost, ''];
    } catch (error) {
      this.problem = said(error);
    }
  }

  private async look(asked: number): Promise<void> {
    try {
      this.take(await this.drafts.server.json<FreeTextView | null>(PATH), asked);
    } catch (error) {
      if (asked === this.asked) this.problem = said(error);
    }
  }

  private take(view: FreeTextView | null, asked: number): void {
    if (asked !== this.asked || (view !== null && view.file !== this.file)) return;
    const isNew = JSON.stringify(view?.lines) !== JSON.stringify(this.view?.lines);
    this.view = view;
    if (isNew) this.acceptAll(false);
    this.problem = view?.problem ?? '';
    if (this.isRunning) this.timer = setTimeout(() => void this.look(asked), EVERY_MS);
  }
}
