// Announcements of firings for screen readers: rarely, and in one sentence, however many there are.

const EVERY_MS = 5000;
const NAMED = 4;

export class Announcer {
  private readonly waiting = new Map<string, number>();
  private last_ms = -Infinity;

  fired(sensor: string): void {
    this.waiting.set(sensor, (this.waiting.get(sensor) ?? 0) + 1);
  }

  due(now_ms: number): string | null {
    if (this.waiting.size === 0 || now_ms - this.last_ms < EVERY_MS) return null;
    this.last_ms = now_ms;
    const sentence = spoken(this.waiting);
    this.waiting.clear();
    return sentence;
  }

  clear(): void {
    this.waiting.clear();
  }
}

function spoken(fired: Map<string, number>): string {
  const most = [...fired].sort((a, b) => b[1] - a[1]);
  const named = most.slice(0, NAMED).map(([name, times]) => (times === 1 ? name : `${name} ${times} times`));
  const others = most.length - named.length;
  if (others > 0) named.push(`${others} other ${others === 1 ? 'sensor' : 'sensors'}`);
  const last = named.pop();
  return `New events: ${named.length > 0 ? `${named.join(', ')} and ${last}` : last}.`;
}
