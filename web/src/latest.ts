// What is asked of the server while somebody edits: a while after the last change, one question at a time, the latest next.

import { said } from './server';

export class Latest<Asked, Answer> {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private wanted: Asked | undefined;
  private busy = false;
  private closed = false;

  /**
   * @param pause_ms without one the first question is asked at once.
   * @param fail is told in words why there is no answer.
   */
  constructor(
    private readonly pause_ms: number,
    private readonly ask: (asked: Asked) => Promise<Answer>,
    private readonly take: (answer: Answer, asked: Asked) => void,
    private readonly fail: (why: string) => void,
  ) {}

  want(asked: Asked): void {
    this.wanted = asked;
    if (this.pause_ms === 0) return void this.go();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = undefined;
      void this.go();
    }, this.pause_ms);
  }

  /** Whether something else has been wanted since what was asked last. */
  get wants(): boolean {
    return this.wanted !== undefined;
  }

  /** Answers that come from now on are not wanted any more. */
  close(): void {
    this.closed = true;
    clearTimeout(this.timer);
  }

  private async go(): Promise<void> {
    if (this.busy || this.wanted === undefined) return;
    const asked = this.wanted;
    this.wanted = undefined;
    this.busy = true;
    try {
      const answer = await this.ask(asked);
      if (!this.closed) this.take(answer, asked);
    } catch (error) {
      if (!this.closed) this.fail(said(error));
    } finally {
      this.busy = false;
    }
    // What was wanted meanwhile has waited long enough, unless its pause still runs.
    if (!this.closed && this.timer === undefined) void this.go();
  }
}
