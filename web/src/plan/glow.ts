// The brightness of sensors without flashes. WCAG 2.3.1 allows three flashes a second; a fast run would have hundreds.

const RISE_S = 0.15;
/** A sensor stays lit this long after the last detection, so that shorter gaps, which may be frequent, are invisible. */
const HOLD_MS = 300;
const FALL_S = 0.9;

/** By sensor or lamp, from 0 to 1: rises quickly and fades slowly, so that frequent changes keep it lit. */
export class Glow {
  readonly levels: number[] = [];
  private readonly until_ms: number[] = [];
  private last_ms: number | null = null;

  /** @returns whether something is lit, or was until now. */
  step(sensors: number, lit: Iterable<number>, now_ms: number): boolean {
    const past = this.last_ms === null ? 0 : Math.min(Math.max((now_ms - this.last_ms) / 1000, 0), 0.25);
    this.last_ms = now_ms;
    const isLit = new Set(lit);
    let any = false;
    for (let sensor = 0; sensor < sensors; sensor++) {
      const level = this.levels[sensor] ?? 0;
      if (isLit.has(sensor)) this.until_ms[sensor] = now_ms + HOLD_MS;
      const next = now_ms <= (this.until_ms[sensor] ?? -Infinity) ? Math.min(level + past / RISE_S, 1) : Math.max(level - past / FALL_S, 0);
      this.levels[sensor] = next;
      any ||= next !== level || (next > 0 && !isLit.has(sensor));
    }
    this.levels.length = sensors;
    return any;
  }
}

/** A value that takes at least a second from 0 to 1, however fast its target changes. */
export class Eased {
  level: number | null = null;
  private last_ms = 0;

  /** @returns whether it has changed. */
  step(target: number, now_ms: number): boolean {
    const most = Math.min(Math.max((now_ms - this.last_ms) / 1000, 0), 0.25);
    this.last_ms = now_ms;
    const before = this.level ?? target;
    this.level = before + Math.min(Math.max(target - before, -most), most);
    return this.level !== before;
  }
}

type Pulse = { sensor: number; since_ms: number };

const PULSE_MS = 1100;
const MOST_A_SECOND = 3;

/** The rings around sensors that have just fired: at most three begin within a second. */
export class Pulses {
  private begun: number[] = [];
  private running: Pulse[] = [];

  /** @returns whether a ring begins; otherwise the count next to the sensor still grows. */
  fire(sensor: number, now_ms: number): boolean {
    this.begun = this.begun.filter((at) => at > now_ms - 1000);
    this.running = this.running.filter((pulse) => now_ms - pulse.since_ms < PULSE_MS);
    if (this.begun.length >= MOST_A_SECOND || this.running.some((pulse) => pulse.sensor === sensor && now_ms - pulse.since_ms < 400)) return false;
    this.begun.push(now_ms);
    this.running.push({ sensor, since_ms: now_ms });
    return true;
  }

  /** Each ring with its age, from 0 to 1. */
  at(now_ms: number): { sensor: number; age: number }[] {
    this.running = this.running.filter((pulse) => now_ms - pulse.since_ms < PULSE_MS);
    return this.running.map(({ sensor, since_ms }) => ({ sensor, age: (now_ms - since_ms) / PULSE_MS }));
  }

  clear(): void {
    this.running = [];
  }
}

/** From this speed on, sensors are not lit one by one: only their counts grow. */
const FAST = 20;

export function isFast(speed: number | null): boolean {
  return speed === null || speed > FAST;
}

/** Limits the rate of an action. */
export class Throttle {
  private last_ms = -Infinity;

  constructor(private readonly every_ms: number) {}

  due(now_ms: number): boolean {
    if (now_ms - this.last_ms < this.every_ms) return false;
    this.last_ms = now_ms;
    return true;
  }
}
