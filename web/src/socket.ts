// The WebSocket for watching and controlling a run. It introduces itself first, reconnects after a cut, and passes on
// all messages, including a report of those that it cannot read.

import { decode } from '@msgpack/msgpack';
import type { PageCommand, RunFrame, RunNotice } from './wire';

export type Status = 'connecting' | 'open' | 'lost' | 'refused' | 'gone' | 'closed';

/** The server closes the socket with this code if it does not know the token. */
export const WRONG_TOKEN = 4401;

/** The server closes the socket with this code if the home does not exist. */
export const NO_HOME = 4404;

/** The part of a WebSocket that is used, so that tests can replace it. */
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
  /** A message could not be read. */
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
    /** From 0 to 1: pages that lost the same server should not all reconnect at once. */
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
      // The server has accepted the page: the next wait after a cut is short again.
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

  /** @returns whether it could be sent. */
  say(say: PageCommand): boolean {
    if (this.wire === null || this.now !== 'open') return false;
    this.wire.send(JSON.stringify(say));
    return true;
  }

  /** Reconnects at once. */
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

/** Opens a WebSocket to a path of the server. */
export function dial(api: string): Wire {
  const scheme = window.location.protocol === 'https:' ? 'wss' : 'ws';
  return new WebSocket(`${scheme}://${window.location.host}${api}/live`) as unknown as Wire;
}
