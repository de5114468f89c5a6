// The present run. All views share it, and it continues while another view is open.

import { Announcer } from './announce';
import { date, time } from './clock';
import { Drafts } from './drafts.svelte';
import { Firings } from './firings';
import { RunHistory } from './run-history';
import { clockOf } from './localtime';
import { Throttle } from './plan/glow';
import { Server } from './server';
import { Socket, type Status, type Wire, dial } from './socket';
import type { FiringView, PageCommand, ProblemView, RunFrame, RunNotice, RunView } from './wire';

type Note = { id: number; text: string; bad: boolean };

/** Text changes at most this often, so that it can be read. */
const TEXT_MS = 120;
const NOTES = 4;
const NOTE_MS = 9000;

export class Live {
  status = $state<Status>('closed');
  run = $state.raw<RunView | null>(null);
  /** The frame of texts; drawings use every frame. */
  frame = $state.raw<RunFrame | null>(null);
  notes = $state.raw<Note[]>([]);
  /** For screen readers: the sensors that fired recently. */
  spoken = $state('');
  /** Grows when `firings` has changed. */
  heard = $state(0);
  /** The reason why a run could not start, and the problems of the scenario, or the option; until a run starts or the user closes the message. */
  startFailure = $state.raw<{ why: string; problems: ProblemView[]; option?: string } | null>(null);
  /** The last run that was stored in a folder and has ended. */
  stored = $state<string | null>(null);

  readonly firings = new Firings();
  readonly lived = new RunHistory();
  readonly server: Server;
  readonly drafts: Drafts;
  latest: RunFrame | null = null;
  private readonly socket: Socket;
  private readonly watchers = new Set<(frame: RunFrame, fresh: FiringView[]) => void>();
  private readonly cuts = new Set<() => void>();
  private readonly texts = new Throttle(TEXT_MS);
  private readonly announcer = new Announcer();
  private noted = 0;
  /** The connection was lost since the last report of the run. */
  private wasCut = false;
  /** Gets true if the requested run has started. */
  private begun: ((has: boolean) => void) | null = null;
  private timer: ReturnType<typeof setInterval> | undefined;

  /** @param api the path of the home on the server. */
  constructor(token: string, onWrongToken: () => void, make?: () => Wire, drafts?: Drafts, api = '/api') {
    this.server = new Server(token, onWrongToken, undefined, api);
    const note = (text: string, bad: boolean) => this.note(text, bad);
    drafts?.reconnect(this.server, note);
    this.drafts = drafts ?? new Drafts(this.server, note);
    this.socket = new Socket(
      token,
      {
        status: (status) => {
          this.status = status;
          if (status === 'refused') onWrongToken();
          else if (status !== 'open') {
            this.wasCut = true;
            for (const cut of this.cuts) cut();
          }
        },
        frame: (frame) => this.take(frame),
        tell: (tell) => this.hear(tell),
        trouble: (text) => this.note(text, true),
      },
      make ?? (() => dial(api)),
    );
  }

  /** The folder of the present run, which is not complete yet. */
  get ongoing(): string | null {
    return this.run === null || this.run.replay || this.frame?.state === 'over' ? null : this.run.id;
  }

  open(): void {
    this.socket.open();
    // The last frames and firings before a pause are shown, too, although no other follows.
    this.timer = setInterval(() => this.catchUp(performance.now()), TEXT_MS);
  }

  close(): void {
    clearInterval(this.timer);
    this.socket.close();
  }

  tryNow(): void {
    this.socket.hurry();
  }

  /** Reports commands that cannot be sent, so that no click is silently ignored. */
  say(say: PageCommand): boolean {
    const sent = this.socket.say(say);
    if (!sent && say.say !== 'hold') this.note('Not connected to the server. Nothing was changed.', true);
    return sent;
  }

  /** Starts a run with the drivers of the scenario. @returns whether it has started. */
  begin(without: string[]): Promise<boolean> {
    if (!this.say({ say: 'start', driven: null, options: { without } })) return Promise.resolve(false);
    this.begun?.(false);
    return new Promise((begun) => (this.begun = begun));
  }

  toggle(): void {
    const state = this.frame?.state ?? 'over';
    if (state !== 'over') this.say({ say: state === 'playing' ? 'pause' : 'play' });
  }

  /** @returns a function that ends the subscription. */
  watch(watcher: (frame: RunFrame, fresh: FiringView[]) => void): () => void {
    this.watchers.add(watcher);
    return () => this.watchers.delete(watcher);
  }

  /** @returns a function that ends the subscription to lost connections. */
  whenCut(cut: () => void): () => void {
    this.cuts.add(cut);
    return () => this.cuts.delete(cut);
  }

  note(text: string, bad: boolean): void {
    // A visible note is not repeated, as screen readers would read it again.
    if (this.notes.some((old) => old.text === text && old.bad === bad)) return;
    const note = { id: ++this.noted, text, bad };
    this.notes = [...this.notes, note].slice(-NOTES);
    // An error stays until the user closes it.
    if (!bad) setTimeout(() => this.dismiss(note.id), NOTE_MS);
  }

  dismiss(id: number): void {
    this.notes = this.notes.filter((note) => note.id !== id);
  }

  private hear(tell: RunNotice): void {
    if (tell.tell === 'run' || (tell.tell === 'note' && tell.bad)) {
      this.begun?.(tell.tell === 'run');
      this.begun = null;
    }
    if (tell.tell === 'unbegun') {
      this.begun?.(false);
      this.begun = null;
      this.startFailure = tell;
      return;
    }
    if (tell.tell === 'note') {
      this.note(tell.text, tell.bad);
      return;
    }
    this.tellOfEnd(tell.run);
    this.run = tell.run;
    this.startFailure = null;
    this.frame = null;
    this.latest = null;
    this.firings.clear(tell.run.home.sensors.length);
    this.lived.clear(tell.run);
    this.announcer.clear();
    this.heard += 1;
  }

  /** A new run after a lost connection: the server was stopped, and its run with it. */
  private tellOfEnd(next: RunView): void {
    const { run, latest, wasCut } = this;
    this.wasCut = false;
    if (!wasCut || run === null || run.replay || run.id === null || run.id === next.id || latest === null || latest.state === 'over') return;
    const clock = clockOf(run, latest.now_us);
    const far = Number.isFinite(clock) ? ` at ${date(clock)}, ${time(clock)}` : '';
    this.note(`The server stopped, and ${run.id} stopped with it${far}. That part is saved and listed in Playback. To resume it, use “homebody run --resume” with its folder. The run shown now is a new one.`, true);
  }

  private take(frame: RunFrame): void {
    // No frame can be shown before the home of the run is known.
    if (this.run === null) return;
    const turns = this.latest?.state !== frame.state;
    this.latest = frame;
    const fresh = this.firings.take(frame);
    this.lived.take(frame);
    for (const firing of fresh) this.announcer.fired(this.run.home.sensors[firing.sensor]?.name ?? 'an unknown sensor');
    for (const watcher of this.watchers) watcher(frame, fresh);
    if (frame.state === 'over' && !this.run.replay && this.run.id !== null) this.stored = this.run.id;
    if (turns) this.frame = frame;
    this.catchUp(performance.now());
  }

  private catchUp(now_ms: number): void {
    const sentence = this.announcer.due(now_ms);
    if (sentence !== null) this.spoken = sentence;
    if (this.frame === this.latest || !this.texts.due(now_ms)) return;
    this.frame = this.latest;
    this.heard += 1;
  }
}
