// Tabs of one server share the token, so that a second tab needs no address from the terminal. Only pages of the same
// origin receive it, and nothing is stored.

const CHANNEL = 'homebody-token';
/** Time to wait for another tab (our choice): tabs answer within some milliseconds. */
const PATIENCE_MS = 250;

/** The token of another tab, if there is one. */
export function tokenOfOthers(): Promise<string | null> {
  if (typeof BroadcastChannel === 'undefined') return Promise.resolve(null);
  const channel = new BroadcastChannel(CHANNEL);
  return new Promise((told) => {
    const end = (token: string | null) => {
      clearTimeout(timer);
      channel.close();
      told(token);
    };
    const timer = setTimeout(() => end(null), PATIENCE_MS);
    channel.onmessage = ({ data }) => {
      if (typeof data?.token === 'string') end(data.token);
    };
    channel.postMessage('token?');
  });
}

/** Answers other tabs; the returned function ends that. */
export function answerOthers(token: () => string | null): () => void {
  if (typeof BroadcastChannel === 'undefined') return () => {};
  const channel = new BroadcastChannel(CHANNEL);
  channel.onmessage = ({ data }) => {
    const known = data === 'token?' ? token() : null;
    if (known !== null) channel.postMessage({ token: known });
  };
  return () => channel.close();
}
