// The line to the server over which a run is watched and steered. It says hello first, tries again when it is cut, and
// passes on everything it hears: what it cannot read is told, too.

import { decode } from '@msgpack/msgpack';
import type { PageCommand, RunFrame, RunNotice } from './wire';

export type Status = 'connecting' | 'open' | 'lost' | 'refused' | 'gone' | 'closed';

/** The server closes the socket with this where it does not know the token. */
export const WRONG_TOKEN = 4401;

/** And with this where the home is not there, or not any more. */
export const NO_HOME = 4404;

/** The part of a WebSocket that is used, so that tests can stand in for it. */
export type Wire = {
  binaryType: string;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: ((event: { code: number }) => void) | null;
  onerror: (() => void) | null;
  send(text: string): void;
  close(): void;
};

type Hears = {
  status(status: Status): void;
  frame(frame: RunFrame): void;
  tell(tell: RunNotice): void;
  /** Something came that could not be read. */
  trouble(text: string): void;
};

const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 10_000;

export class Socket {
  private wire: Wire | null = null;
  private waits = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private now: Status = 'closed';

  constructor(
    private readonly token: string,
    private readonly hears: Hears,
    private readonly make: () => Wire = () => dial('/api'),
    /** From 0 to 1: pages that lost the same server do not all come back at once. */
    private readonly chance: () => number = Math.random,
  ) {}

  get status(): Status {
    return this.now;
  }

  open(): void {
    this.become(this.waits === 0 ? 'connecting' : 'lost');
    const wire = this.make();
    this.wire = wire;
    wire.binaryType = 'arraybuffer';
    wire.onopen = () => {
      if (this.wire !== wire) return;
      wire.send(JSON.stringify({ say: 'hello', token: this.token } satisfies PageCommand));
      this.become('open');
    };
    wire.onmessage = ({ data }) => {
      if (this.wire !== wire) return;
      // The server has let us in: a wait after the next cut begins small again.
      this.waits = 0;
      this.hear(data);
    };
    wire.onerror = null;
    wire.onclose = ({ code }) => {
      if (this.wire !== wire) return;
      this.wire = null;
      if (code === WRONG_TOKEN) this.become('refused');
      else if (code === NO_HOME) this.become('gone');
      else this.tryAgain();
    };
  }

  /** Whether it could be sent. */
  say(say: PageCommand): boolean {
    if (this.wire === null || this.now !== 'open') return false;
    this.wire.send(JSON.stringify(say));
    return true;
  }

  /** Tries at once instead of waiting longer. */
  hurry(): void {
    if (this.wire !== null || this.now !== 'lost') return;
    clearTimeout(this.timer);
    this.open();
  }

  close(): void {
    clearTimeout(this.timer);
    const wire = this.wire;
    this.wire = null;
    wire?.close();
    this.become('closed');
  }

  private tryAgain(): void {
    this.become('lost');
    const wait = Math.min(FIRST_WAIT_MS * 2 ** this.waits, LONGEST_WAIT_MS);
    this.waits += 1;
    this.timer = setTimeout(() => this.open(), wait * (0.75 + 0.5 * this.chance()));
  }

  private hear(data: unknown): void {
    try {
      if (typeof data === 'string') {
        const tell = JSON.parse(data) as RunNotice;
        if (tell.tell !== 'run' && tell.tell !== 'note' && tell.tell !== 'unbegun') throw new Error('unknown');
        this.hears.tell(tell);
        return;
      }
      const frame = decode(data as ArrayBuffer) as RunFrame;
      if (typeof frame?.now_us !== 'number' || !Array.isArray(frame.bodies)) throw new Error('not a frame');
      this.hears.frame(frame);
    } catch {
      this.hears.trouble('Cannot read a message from the server. The page may be of another version: reload it.');
    }
  }

  private become(status: Status): void {
    if (this.now === status) return;
    this.now = status;
    this.hears.status(status);
  }
}

/** A line to what the server has below this path. */
export function dial(api: string): Wire {
  const scheme = window.location.protocol === 'https:' ? 'wss' : 'ws';
  return new WebSocket(`${scheme}://${window.location.host}${api}/live`) as unknown as Wire;
}
