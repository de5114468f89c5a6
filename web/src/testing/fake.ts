// A fake server: it simulates a made-up run in the page with the messages of the real one. Its sensors are only
// approximate; the real models are in the program.

import { rowOf } from '../plan/kinds';
import { encode } from '@msgpack/msgpack';
import { type At, distance, inside } from '../plan/geometry';
import type { Wire } from '../socket';
import type { BodyView, FiringView, Key, MapPosture, PageCommand, RunFrame, RunNotice, RunState, RunView } from '../wire';
import { DOORWAYS, madeUpRun, spotIn } from './home';

const TICK_MS = 16;
const START = Date.parse('2009-03-02T06:55:00Z');
/** The speed of "as fast as it goes". */
const FASTEST = 20_000;
const MOST_FIRINGS = 60;

type Walker = { at: At; heading: number; posture: MapPosture; way: At[]; room: number; rests_s: number };

/** Set by the page's address: `?residents=10&sensors=100&driven=0&hostile=1`. */
export function fakeServer(asked: URLSearchParams): () => Wire {
  const number = (name: string, usual: number) => Number(asked.get(name) ?? usual);
  const driven = asked.has('driven') ? number('driven', 0) : null;
  const names = asked.has('hostile') ? hostile : (name: string) => name;
  return () => new FakeServer(madeUpRun(number('residents', 2), number('sensors', 18), driven, names), asked);
}

/** Names that try to break out of their place. */
export function hostile(name: string): string {
  const tricks = [
    `<script>alert(1)</script> ${name}`,
    `<img src=x onerror="document.title='broken'"> ${name}`,
    `${name} ${'very '.repeat(800)}long`,
    `${name} 👩‍👩‍👧‍👦🛁🚿`,
    `\u202e${name} غرفة النوم`,
    `"'\`]]>--></style> ${name}\n\n${name}`,
  ];
  return tricks[name.length % tricks.length]!;
}

class FakeServer implements Wire {
  binaryType = 'arraybuffer';
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: ((event: { code: number }) => void) | null = null;
  onerror: (() => void) | null = null;
  private state: RunState = 'playing';
  private speed: number | null = 1;
  private now_us = 0;
  private told = 0;
  private counts: number[] = [];
  private keys: Key[] = [];
  private walkers: Walker[] = [];
  private on = new Set<number>();
  private quiet_until: number[] = [];
  private seeing: number[] = [];
  private timer: ReturnType<typeof setInterval> | undefined;
  private random = 12345;

  constructor(
    private run: RunView,
    asked: URLSearchParams = new URLSearchParams(),
  ) {
    if (asked.has('speed')) this.speed = asked.get('speed') === 'fastest' ? null : Number(asked.get('speed'));
    if (asked.has('hour')) this.now_us = (Number(asked.get('hour')) * 3600 - 6.92 * 3600 + 86_400) * 1e6;
    setTimeout(() => this.onopen?.(), 5);
  }

  send(text: string): void {
    this.hear(JSON.parse(text) as PageCommand);
  }

  close(): void {
    clearInterval(this.timer);
  }

  private hear(say: PageCommand): void {
    switch (say.say) {
      case 'hello':
        this.begin();
        break;
      case 'play':
        this.state = 'playing';
        break;
      case 'pause':
        this.state = 'paused';
        break;
      case 'step':
        this.live(say.seconds);
        this.state = 'paused';
        break;
      case 'speed':
        this.speed = say.times;
        break;
      case 'jump':
        this.now_us = say.to_us;
        this.state = 'paused';
        break;
      case 'hold':
        this.keys = say.keys;
        break;
      case 'be':
        if (this.run.driven !== null) this.walkers[this.run.driven]!.posture = say.posture;
        break;
      case 'use':
        if (say.on) this.on.add(say.thing);
        else this.on.delete(say.thing);
        break;
      case 'start':
        this.run = { ...this.run, driven: say.driven, seed: say.options.seed ?? this.run.seed, replay: false, id: 'cottage-2' };
        this.now_us = 0;
        [this.told, this.counts] = [0, this.run.home.sensors.map(() => 0)];
        this.state = 'playing';
        this.begin();
        break;
      case 'stop':
        this.state = 'over';
        this.tell({ tell: 'note', text: 'The run is stored in runs/cottage-1.', bad: false });
        break;
      case 'replay':
        this.run = { ...this.run, replay: true };
        this.now_us = 0;
        [this.told, this.counts] = [0, this.run.home.sensors.map(() => 0)];
        this.state = 'playing';
        this.begin();
        break;
    }
    this.show([]);
  }

  private begin(): void {
    clearInterval(this.timer);
    this.walkers = this.run.residents.map((_, index) => {
      const room = [0, 1, 4, 5, 6, 3][index % 6]!;
      return { at: spotIn(room, this.chance), heading: 90, posture: 'standing', way: [], room, rests_s: index * 0.7 };
    });
    this.quiet_until = this.run.home.sensors.map(() => 0);
    this.on = new Set([0, 1, 2, 4, 5, 7, 8, 12].filter((thing) => thing < this.run.home.things.length));
    this.tell({ tell: 'run', run: this.run });
    this.show([]);
    this.timer = setInterval(() => {
      if (this.state !== 'playing') return;
      this.show(this.live((TICK_MS / 1000) * (this.speed ?? FASTEST)));
    }, TICK_MS);
  }

  private live(seconds: number): FiringView[] {
    this.now_us = Math.min(this.now_us + Math.round(seconds * 1e6), this.run.length_us);
    if (this.now_us >= this.run.length_us) this.state = 'over';
    this.walkers.forEach((walker, index) => {
      if (index === this.run.driven) this.drive(walker, Math.min(seconds, 0.1));
      else this.wander(walker, Math.min(seconds, 30));
    });
    return this.sense(seconds);
  }

  private drive(walker: Walker, seconds: number): void {
    const has = (key: Key) => Number(this.keys.includes(key));
    const [dx, dy] = [has('right') - has('left'), has('up') - has('down')];
    if (dx === 0 && dy === 0) return;
    const pace = 0.8 * (has('fast') ? 2 : 1) * (has('slow') ? 0.5 : 1);
    const far = Math.hypot(dx, dy);
    walker.heading = (Math.atan2(dy, dx) * 180) / Math.PI;
    walker.posture = 'standing';
    const next: At = [walker.at[0] + (dx / far) * pace * seconds, walker.at[1] + (dy / far) * pace * seconds];
    if (this.run.home.rooms.some((room) => inside(room.outline, next))) walker.at = next;
  }

  private wander(walker: Walker, seconds: number): void {
    walker.rests_s -= seconds;
    if (walker.rests_s > 0) return;
    if (walker.way.length === 0) {
      walker.posture = 'standing';
      const [to, door] = this.neighbour(walker.room);
      walker.room = to;
      walker.way = [door, spotIn(to, this.chance)];
    }
    const next = walker.way[0]!;
    const [far, stride] = [distance(walker.at, next), 0.7 * seconds];
    walker.heading = (Math.atan2(next[1] - walker.at[1], next[0] - walker.at[0]) * 180) / Math.PI;
    if (far > stride) {
      walker.at = [walker.at[0] + ((next[0] - walker.at[0]) / far) * stride, walker.at[1] + ((next[1] - walker.at[1]) / far) * stride];
      return;
    }
    walker.at = next;
    walker.way.shift();
    if (walker.way.length > 0) return;
    walker.rests_s = 2 + 6 * this.chance();
    walker.posture = (['standing', 'sitting', 'lying'] as const)[Math.floor(this.chance() * 3)]!;
  }

  private neighbour(room: number): [number, At] {
    const ways = DOORWAYS.filter(([a, b]) => a === room || b === room);
    const [a, b, door] = ways[Math.floor(this.chance() * ways.length)]!;
    return [a === room ? b : a, door];
  }

  private sense(seconds: number): FiringView[] {
    const firings: FiringView[] = [];
    this.seeing = [];
    this.run.home.sensors.forEach((sensor, index) => {
      const moves = (way: At[], who: number) => way.length > 0 || (who === this.run.driven && this.keys.length > 0);
      const sees = this.walkers.some(({ at, way }, who) => moves(way, who) && (sensor.area ? inside(sensor.area, at) : inFan(at, sensor.beams)));
      if (sees) this.seeing.push(index);
      const often = Math.min(Math.floor(seconds / 7), 4);
      if (!(sees && this.now_us >= this.quiet_until[index]!) && !(often > 0 && this.chance() < 0.3)) return;
      for (let time = 0; time < Math.max(often, 1); time++) firings.push(this.fire(index, this.now_us - Math.round((seconds * 1e6 * (often - time)) / (often + 1))));
      this.quiet_until[index] = this.now_us + (6 + 2 * this.chance()) * 1e6;
    });
    firings.sort((a, b) => a.at_us - b.at_us);
    for (const { sensor } of firings) this.counts[sensor] = (this.counts[sensor] ?? 0) + 1;
    return firings.map((firing) => ({ ...firing, seq: this.told++ })).slice(-MOST_FIRINGS);
  }

  private fire(index: number, at_us: number): FiringView {
    const sensor = this.run.home.sensors[index]!;
    const value = rowOf(sensor.kind)?.values[0] ?? 'ON';
    const time = clock(at_us);
    return { seq: 0, at_us, sensor: index, value, row: sensor.kind === 'light' ? null : [time, sensor.name, value] };
  }

  private show(firings: FiringView[]): void {
    const hour = ((START + this.now_us / 1000) / 3_600_000) % 24;
    const bodies: BodyView[] = this.walkers.map((walker) => ({
      at: walker.at,
      heading_deg: walker.heading,
      posture: walker.posture,
      room: walker.room,
      activity: walker.way.length > 0 ? 'walking' : 'resting',
    }));
    const frame: RunFrame = {
      now_us: this.now_us, clock: clock(this.now_us), state: this.state, speed: this.speed, bodies,
      seeing: this.state === 'playing' ? this.seeing : [],
      on: [...this.on], sun: -Math.cos(((hour - 0.5) / 24) * 2 * Math.PI), told: this.told, counts: this.counts, looks: [], firings,
    };
    this.onmessage?.({ data: encode(frame) });
  }

  private tell(tell: RunNotice): void {
    this.onmessage?.({ data: JSON.stringify(tell) });
  }

  private readonly chance = (): number => {
    this.random = (this.random * 1_103_515_245 + 12_345) % 2_147_483_648;
    return this.random / 2_147_483_648;
  };
}

function clock(at_us: number): string {
  return new Date(START + at_us / 1000).toISOString().slice(0, 19).replace('T', ' ');
}

function inFan(at: At, beams: [At, At][]): boolean {
  return beams.some(([from, to]) => {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const along = ((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / (dx * dx + dy * dy || 1);
    const t = Math.min(Math.max(along, 0), 1);
    return Math.hypot(at[0] - from[0] - t * dx, at[1] - from[1] - t * dy) < 0.22;
  });
}
