/** Return the instant, s, of a fragment such as #t=3.2, inside the duration; null: it has none. */
export function instantOf(fragment: string, duration: number): number | null {
  const match = /^#t=(\d+(?:\.\d+)?)$/.exec(fragment)
  return match === null ? null : Math.min(Number(match[1]), duration)
}
