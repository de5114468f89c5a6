// Frames and firings for tests.

import type { FiringView, RunFrame } from '../wire';

export function frame(with_: Partial<RunFrame> = {}): RunFrame {
  return {
    now_us: 0,
    clock: '2009-03-02 07:12:03',
    state: 'playing',
    speed: 1,
    bodies: [],
    seeing: [],
    on: [],
    sun: 1,
    told: 0,
    counts: [],
    firings: [],
    looks: [],
    ...with_,
  };
}

export function firing(seq: number, at_us: number, sensor = 0, stored = true): FiringView {
  return { seq, at_us, sensor, value: 'ON', row: stored ? [`time ${seq}`, `S${sensor}`, `message ${seq}`] : null };
}
