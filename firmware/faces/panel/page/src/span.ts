/** What an axis of a trend shows for values from `low` to `high`: a little more than they, and at least `least`. */
export function spanOf(low: number | null, high: number | null, least: number): [number, number] {
  const middle = ((low ?? 0) + (high ?? 0)) / 2;
  const half = Math.max(((high ?? 0) - (low ?? 0)) * 1.1, least) / 2;
  return [middle - half, middle + half];
}
