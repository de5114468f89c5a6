// Texts of fields that are not values yet: the user still types them, or they are wrong.

import { getContext, setContext } from 'svelte';
import { SvelteMap } from 'svelte/reactivity';

type TextState = 'typed' | 'wrong';

export class Typing {
  private readonly texts = new SvelteMap<string, TextState>();

  /** The text of a field; null for one that is a value. */
  note(id: string, state: TextState | null): void {
    if (state === null) this.texts.delete(id);
    else if (this.texts.get(id) !== state) this.texts.set(id, state);
  }

  get isWrong(): boolean {
    return [...this.texts.values()].includes('wrong');
  }

  get isTyped(): boolean {
    return this.texts.size > 0;
  }
}

const KEY = Symbol('typing');

export function provideTyping(): Typing {
  return setContext(KEY, new Typing());
}

export function typingOfForm(): Typing {
  return getContext<Typing>(KEY);
}
