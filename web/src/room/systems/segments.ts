/** The fields of a member that its segment shows. */
interface TimedMember {
  readonly robot: string
  readonly start: number
  readonly duration: number
  readonly waiting_for: string
}

/** One member on the system's timeline. from, to: parts of it, 0 to 1. */
export interface Segment {
  readonly row: number
  readonly rows: number
  readonly from: number
  readonly to: number
  readonly label: string
  readonly waits: string
}

/** Return a segment for each member, in the order in which they were touched. duration: s. */
export function segmentsOf(members: readonly TimedMember[], duration: number): Segment[] {
  const whole = Math.max(duration, 1e-9)
  const part = (time: number) => Math.min(Math.max(time / whole, 0), 1)
  return members.map(({ robot, start, duration: own, waiting_for }, row) => ({
    row,
    rows: members.length,
    from: part(start),
    to: part(start + own),
    label: `${row + 1} ${robot}`,
    waits: waiting_for,
  }))
}
