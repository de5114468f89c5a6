// The interpretation of a sentence, in a few words.

const DAY_S = 86_400;

/** Frequency and days; every day needs no word. */
export function often(days: string): string {
  return days.replace(/\bp 1(?=\s*(;|$))/, '').replace(/^[\s;]+|[\s;]+$/g, '').replace(/\bp (0\.\d+)/, (_, share: string) => `${Math.round(Number(share) * 100)} %`).slice(0, 120);
}

/** `25 min`, `1 h 30 min`. */
export function lasting(seconds: number): string {
  if (seconds < 59.5) return `${Math.round(seconds)} s`;
  const minutes = Math.round(seconds / 60);
  const [hours, rest] = [Math.floor(minutes / 60), minutes % 60];
  return [hours > 0 ? `${hours} h` : '', rest > 0 ? `${rest} min` : ''].filter(Boolean).join(' ');
}

/** The shares of a day that a start and a duration take; times after midnight belong to the day before. */
export function bar(start_s: readonly [number, number, number], lasts_s: readonly [number, number, number] | null) {
  const share = (seconds: number) => Math.min(Math.max(seconds / DAY_S, 0), 1);
  const over = start_s[0] >= DAY_S ? DAY_S : 0;
  const [least, mean, most] = start_s.map((at) => share(at - over)) as [number, number, number];
  return { least, mean, most, end: lasts_s === null ? mean : share(start_s[1] - over + lasts_s[1]) };
}
