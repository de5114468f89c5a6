// A browser store in memory.

/** A browser store that may be full: then a request succeeds and its transaction does not. */
export class FakeStore {
  readonly kept = new Map<string, unknown>();
  isFull = false;
  opened = 0;
  closed = 0;

  open() {
    const opening = { result: this.database(), onsuccess: () => {} };
    queueMicrotask(() => {
      this.opened += 1;
      opening.onsuccess();
    });
    return opening;
  }

  private database() {
    const transaction = { error: null as Error | null, oncomplete: () => {}, onabort: () => {}, objectStore: () => objects };
    const objects = {
      get: (key: string) => request(this.kept.get(key)),
      put: (value: unknown, key: string) => {
        if (!this.isFull) this.kept.set(key, value);
        return request(key);
      },
      delete: (key: string) => request(this.kept.delete(key)),
    };
    const request = (result: unknown) => {
      const request = { result, transaction, onsuccess: () => {}, onerror: () => {} };
      queueMicrotask(() => {
        request.onsuccess();
        transaction.error = this.isFull ? new Error('QuotaExceededError') : null;
        if (this.isFull) transaction.onabort();
        else transaction.oncomplete();
      });
      return request;
    };
    return { transaction: () => transaction, close: () => (this.closed += 1) };
  }
}
