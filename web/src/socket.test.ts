import { encode } from '@msgpack/msgpack';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Socket, type Status, WRONG_TOKEN, type Wire } from './socket';
import { frame } from './testing/frames';

class FakeWire implements Wire {
  binaryType = '';
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: ((event: { code: number }) => void) | null = null;
  onerror: (() => void) | null = null;
  sent: unknown[] = [];
  closed = false;
  send(text: string) {
    this.sent.push(JSON.parse(text));
  }
  close() {
    this.closed = true;
  }
}

let wires: FakeWire[];
let heard: { statuses: Status[]; frames: unknown[]; tells: unknown[]; troubles: string[] };
let socket: Socket;

beforeEach(() => {
  vi.useFakeTimers();
  wires = [];
  heard = { statuses: [], frames: [], tells: [], troubles: [] };
  const make = () => {
    wires.push(new FakeWire());
    return wires.at(-1)!;
  };
  const hears = {
    status: (status: Status) => heard.statuses.push(status),
    frame: (one: unknown) => heard.frames.push(one),
    tell: (tell: unknown) => heard.tells.push(tell),
    trouble: (text: string) => heard.troubles.push(text),
  };
  socket = new Socket('secret-token', hears, make, () => 0.5);
});

afterEach(() => vi.useRealTimers());

test('hello comes first, and nothing is said before', () => {
  socket.open();
  expect(socket.say({ say: 'play' })).toBe(false);
  wires[0]!.onopen!();
  expect(socket.say({ say: 'play' })).toBe(true);
  expect(wires[0]!.sent).toEqual([{ say: 'hello', token: 'secret-token' }, { say: 'play' }]);
  expect(wires[0]!.binaryType).toBe('arraybuffer');
});

test('frames and tells are passed on', () => {
  socket.open();
  wires[0]!.onopen!();
  const packed = encode(frame({ now_us: 42 }));
  wires[0]!.onmessage!({ data: packed.buffer.slice(packed.byteOffset, packed.byteOffset + packed.byteLength) });
  wires[0]!.onmessage!({ data: '{"tell":"note","text":"stored","bad":false}' });
  expect(heard.frames).toEqual([frame({ now_us: 42 })]);
  expect(heard.tells).toEqual([{ tell: 'note', text: 'stored', bad: false }]);
  expect(heard.troubles).toEqual([]);
});

test('what cannot be read is told, not dropped', () => {
  socket.open();
  wires[0]!.onopen!();
  for (const data of ['{', '{"tell":"joke"}', new Uint8Array([0xc1]).buffer, encode({ a: 1 }), encode(null)]) wires[0]!.onmessage!({ data });
  expect(heard.troubles).toHaveLength(5);
  expect(heard.frames).toEqual([]);
});

test('a cut is tried again, later and later, and says hello again', () => {
  socket.open();
  wires[0]!.onopen!();
  wires[0]!.onclose!({ code: 1006 });
  expect(heard.statuses).toEqual(['connecting', 'open', 'lost']);
  expect(socket.say({ say: 'play' })).toBe(false);
  const waits: number[] = [];
  for (let time = 0; time < 7; time++) {
    const [before, made] = [Date.now(), wires.length];
    while (wires.length === made) vi.advanceTimersByTime(100);
    waits.push(Date.now() - before);
    wires.at(-1)!.onclose!({ code: 1006 });
  }
  expect(waits).toEqual([500, 1000, 2000, 4000, 8000, 10_000, 10_000]);
  vi.advanceTimersByTime(10_000);
  const last = wires.at(-1)!;
  last.onopen!();
  expect(last.sent).toEqual([{ say: 'hello', token: 'secret-token' }]);
  expect(heard.statuses.at(-1)).toBe('open');
});

test('being heard again makes the next wait short', () => {
  socket.open();
  for (let time = 0; time < 4; time++) {
    wires.at(-1)!.onclose!({ code: 1006 });
    vi.advanceTimersByTime(10_000);
  }
  wires.at(-1)!.onopen!();
  wires.at(-1)!.onmessage!({ data: '{"tell":"note","text":"","bad":false}' });
  wires.at(-1)!.onclose!({ code: 1006 });
  const made = wires.length;
  vi.advanceTimersByTime(500);
  expect(wires).toHaveLength(made + 1);
});

test('a wrong token is not tried again', () => {
  socket.open();
  wires[0]!.onopen!();
  wires[0]!.onclose!({ code: WRONG_TOKEN });
  vi.advanceTimersByTime(60_000);
  expect(wires).toHaveLength(1);
  expect(heard.statuses.at(-1)).toBe('refused');
});

test('closing is for good, and an old wire is heard no more', () => {
  socket.open();
  wires[0]!.onopen!();
  socket.close();
  wires[0]!.onmessage!({ data: '{"tell":"note","text":"late","bad":false}' });
  wires[0]!.onclose!({ code: 1000 });
  vi.advanceTimersByTime(60_000);
  expect([wires.length, wires[0]!.closed, heard.tells.length]).toEqual([1, true, 0]);
});

test('somebody who does not want to wait tries at once', () => {
  socket.open();
  wires[0]!.onclose!({ code: 1006 });
  socket.hurry();
  expect(wires).toHaveLength(2);
  vi.advanceTimersByTime(5000);
  expect(wires).toHaveLength(2);
});
