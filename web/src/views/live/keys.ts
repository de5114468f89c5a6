// The keys for walking. They are identified by their position on the keyboard, not by their letters, so that W, A, S
// and D are in the same place on every layout; they work only while the plan has the focus.

import type { Key } from '../../wire';

const CODES: Record<string, Key> = {
  KeyW: 'up', ArrowUp: 'up',
  KeyS: 'down', ArrowDown: 'down',
  KeyA: 'left', ArrowLeft: 'left',
  KeyD: 'right', ArrowRight: 'right',
  ShiftLeft: 'fast', ShiftRight: 'fast',
  ControlLeft: 'slow', ControlRight: 'slow', KeyC: 'slow',
};

const ORDER: Key[] = ['up', 'down', 'left', 'right', 'fast', 'slow'];

export type Pressed = Pick<KeyboardEvent, 'code' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey'>;

/** The held keys, of the keyboard and of the buttons on the screen; listeners get changes only. */
export class HeldKeys {
  private readonly sources = new Map<string, Key>();
  private said = '';

  constructor(private readonly say: (keys: Key[]) => void) {}

  get held(): Key[] {
    const held = new Set(this.sources.values());
    return ORDER.filter((key) => held.has(key));
  }

  /** @returns whether it is a walking key, so that the page does not scroll. */
  down(event: Pressed): boolean {
    // With these it is a shortcut of the browser, and a Mac sends no keyup while Command is down.
    if (event.altKey || event.metaKey) {
      this.releaseAll();
      return false;
    }
    const key = CODES[event.code];
    if (key === undefined || (event.code === 'KeyC' && event.ctrlKey)) return false;
    this.sources.set(event.code, key);
    this.tell();
    return true;
  }

  up(event: Pressed): boolean {
    const ours = this.sources.delete(event.code);
    // If two Shift keys are released together, some keyboards report only one.
    if (!event.shiftKey) this.drop('ShiftLeft', 'ShiftRight');
    if (!event.ctrlKey) this.drop('ControlLeft', 'ControlRight');
    this.tell();
    return ours;
  }

  /** A button on the screen; `source` distinguishes fingers. */
  press(source: string, key: Key): void {
    this.sources.set(source, key);
    this.tell();
  }

  release(source: string): void {
    if (this.sources.delete(source)) this.tell();
  }

  releaseAll(): void {
    this.sources.clear();
    this.tell();
  }

  /** The connection was lost: the server has released all keys, and held ones are sent again. */
  forget(): void {
    this.sources.clear();
    this.said = '';
  }

  private drop(...codes: string[]): void {
    for (const code of codes) this.sources.delete(code);
  }

  private tell(): void {
    const held = this.held;
    const now = held.join();
    if (now === this.said) return;
    this.said = now;
    this.say(held);
  }
}
