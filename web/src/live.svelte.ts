// The run that is being lived, as this page knows it. All views share it, and it goes on while another view is looked at.

import { Announcer } from './announce';
import { date, time } from './clock';
import { Drafts } from './drafts.svelte';
import { Firings } from './firings';
import { Lived } from './lived';
import { clockOf } from './localtime';
import { Throttle } from './plan/glow';
import { Server } from './server';
import { Socket, type Status, type Wire, dial } from './socket';
import type { FiringView, PageCommand, ProblemView, RunFrame, RunNotice, RunView } from './wire';

type Note = { id: number; text: string; bad: boolean };

/** What is read as text need not change more often than one can read. */
const TEXT_MS = 120;
const NOTES = 4;
const NOTE_MS = 9000;

export class Live {
  status = $state<Status>('closed');
  run = $state.raw<RunView | null>(null);
  /** The frame as text shows it; drawings have every one. */
  frame = $state.raw<RunFrame | null>(null);
  notes = $state.raw<Note[]>([]);
  /** For a screen reader: which sensors fired of late. */
  spoken = $state('');
  /** Grows when `firings` has changed. */
  heard = $state(0);
  /** Why no run could be begun, and what is wrong with the scenario; until one is begun or that is read. */
  unbegun = $state.raw<{ why: string; problems: ProblemView[] } | null>(null);
  /** The last run that was stored in a folder and has ended. */
  stored = $state<string | null>(null);

  readonly firings = new Firings();
  readonly lived = new Lived();
  readonly server: Server;
  /** The scenario's files, as this page writes them. */
  readonly drafts: Drafts;
  latest: RunFrame | null = null;
  private readonly socket: Socket;
  private readonly watchers = new Set<(frame: RunFrame, fresh: FiringView[]) => void>();
  private readonly cuts = new Set<() => void>();
  private readonly texts = new Throttle(TEXT_MS);
  private readonly announcer = new Announcer();
  private noted = 0;
  /** Whether the connection was gone since the run was told of. */
  private wasCut = false;
  /** Is told whether the run that was asked for has begun. */
  private begun: ((has: boolean) => void) | null = null;
  private timer: ReturnType<typeof setInterval> | undefined;

  /** @param api below which path the server answers for the home. */
  constructor(token: string, onWrongToken: () => void, make?: () => Wire, drafts?: Drafts, api = '/api') {
    this.server = new Server(token, onWrongToken, undefined, api);
    const note = (text: string, bad: boolean) => this.note(text, bad);
    drafts?.meet(this.server, note);
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

  /** The folder of the run that is being lived: what is stored of it is not whole yet. */
  get goesOn(): string | null {
    return this.run === null || this.run.replay || this.frame?.state === 'over' ? null : this.run.id;
  }

  open(): void {
    this.socket.open();
    // The last frames and firings before a pause are shown, too, though no other comes after them.
    this.timer = setInterval(() => this.catchUp(performance.now()), TEXT_MS);
  }

  close(): void {
    clearInterval(this.timer);
    this.socket.close();
  }

  tryNow(): void {
    this.socket.hurry();
  }

  /** What cannot be sent is said so: a click that does nothing would be worse. */
  say(say: PageCommand): boolean {
    const sent = this.socket.say(say);
    if (!sent && say.say !== 'hold') this.note('Not connected to the server. Nothing was changed.', true);
    return sent;
  }

  /** Begins a run in which everybody lives as the scenario says. @returns whether there is one. */
  begin(without: string[]): Promise<boolean> {
    if (!this.say({ say: 'start', driven: null, without, seed: null })) return Promise.resolve(false);
    this.begun?.(false);
    return new Promise((begun) => (this.begun = begun));
  }

  /** Plays, or pauses. */
  toggle(): void {
    const state = this.frame?.state ?? 'over';
    if (state !== 'over') this.say({ say: state === 'playing' ? 'pause' : 'play' });
  }

  /** @returns how to stop being told. */
  watch(watcher: (frame: RunFrame, fresh: FiringView[]) => void): () => void {
    this.watchers.add(watcher);
    return () => this.watchers.delete(watcher);
  }

  /** @returns how to stop being told when the line is cut. */
  whenCut(cut: () => void): () => void {
    this.cuts.add(cut);
    return () => this.cuts.delete(cut);
  }

  note(text: string, bad: boolean): void {
    // Said again while it is still there to be read, it would only be read out again.
    if (this.notes.some((old) => old.text === text && old.bad === bad)) return;
    const note = { id: ++this.noted, text, bad };
    this.notes = [...this.notes, note].slice(-NOTES);
    // What went wrong stays until somebody has read it.
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
      this.unbegun = { why: tell.why, problems: tell.problems };
      return;
    }
    if (tell.tell === 'note') {
      this.note(tell.text, tell.bad);
      return;
    }
    this.tellOfEnd(tell.run);
    this.run = tell.run;
    this.unbegun = null;
    this.frame = null;
    this.latest = null;
    this.firings.clear(tell.run.home.sensors.length);
    this.lived.clear(tell.run);
    this.announcer.clear();
    this.heard += 1;
  }

  /** Another run after a cut: the server was ended, and the run with it. */
  private tellOfEnd(next: RunView): void {
    const { run, latest, wasCut } = this;
    this.wasCut = false;
    if (!wasCut || run === null || run.replay || run.id === null || run.id === next.id || latest === null || latest.state === 'over') return;
    const clock = clockOf(run, latest.now_us);
    const far = Number.isFinite(clock) ? ` at ${date(clock)}, ${time(clock)}` : '';
    this.note(`The server stopped, and ${run.id} stopped with it${far}. That part is saved and listed in Playback. To resume it, use “homebody run --resume” with its folder. The run shown now is a new one.`, true);
  }

  private take(frame: RunFrame): void {
    // Before a run is told of there is no home in which a frame could be shown.
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
