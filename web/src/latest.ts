// Requests to the server during editing: after a pause, one at a time, always for the latest state.

import { said } from './server';

export class Latest<Asked, Answer> {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private wanted: Asked | undefined;
  private busy = false;
  private closed = false;

  /**
   * @param pause_ms without it, the first request is sent at once.
   * @param fail gets the reason for a missing answer.
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

  /** A later state than the last request is waiting. */
  get wants(): boolean {
    return this.wanted !== undefined;
  }

  /** Ignores all further answers. */
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
    // A waiting request has waited long enough, unless its pause still runs.
    if (!this.closed && this.timer === undefined) void this.go();
  }
}
