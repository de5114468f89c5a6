// Tabs of one server tell each other the token: who opens a second one need not go back to the terminal. Only pages of the same
// address hear it, and nothing is kept.

const CHANNEL = 'homebody-token';
/** How long another tab is waited for (ours): one that is there answers in some milliseconds. */
const PATIENCE_MS = 250;

/** The token that another tab has; nothing where there is none. */
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

/** Answers tabs that ask; the function that comes back ends that. */
export function answerOthers(token: () => string | null): () => void {
  if (typeof BroadcastChannel === 'undefined') return () => {};
  const channel = new BroadcastChannel(CHANNEL);
  channel.onmessage = ({ data }) => {
    const known = data === 'token?' ? token() : null;
    if (known !== null) channel.postMessage({ token: known });
  };
  return () => channel.close();
}
