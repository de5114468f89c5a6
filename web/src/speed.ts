// The speed of a run.

export const SPEEDS: readonly number[] = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

/** Speeds with a button. */
export const QUICK: readonly number[] = [0.1, 1, 10, 100, 1000];

const plain = new Intl.NumberFormat('en-GB', { maximumFractionDigits: 2 });

/** `10×`, `1,000×`, `as fast as it goes`. */
export function short(speed: number | null): string {
  return speed === null ? 'as fast as possible' : `${plain.format(speed)}×`;
}

/** For screen readers. */
export function long(speed: number | null): string {
  if (speed === null) return 'as fast as possible';
  if (speed === 1) return 'real time';
  return `${plain.format(speed)} times real time`;
}

export function stepOf(speed: number | null): number {
  if (speed === null) return SPEEDS.length - 1;
  const off = SPEEDS.map((step) => Math.abs(Math.log(step / speed)));
  return off.indexOf(Math.min(...off));
}
