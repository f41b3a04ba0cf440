import { type DiagnosticArray, DiagnosticStatus } from '../protocol/diagnostic_msgs'
import { isTold, type Told } from '../words/diagnostic'
import { typed } from '../words/phrase'

/** Where a replay can stand: something that happened in the recorded session. */
export interface SessionStop {
  /** s of the session */
  readonly time: number
  readonly severity: 'info' | 'warning' | 'error'
  /** All that happened then. */
  readonly events: readonly Told[]
}

/** As in `mrlab_ros/messages/status.py`. */
const INSTANT = 'session_time'

/** Return the stops that the recorder publishes of the bag that it replays, in their order. */
export function stopsOf({ status }: DiagnosticArray): readonly SessionStop[] {
  return status.map(({ level, name, message, values }) => {
    const value = (wanted: string) => values.find(({ key }) => key === wanted)?.value ?? ''
    const events = [typed(value('events'))].flat().filter(isTold)
    return {
      time: Number(value(INSTANT)),
      severity:
        level === DiagnosticStatus.OK
          ? 'info'
          : level === DiagnosticStatus.WARN
            ? 'warning'
            : 'error',
      // a lab of another version
      events: events.length > 0 ? events : [{ code: name, message, values: [...values] }],
    }
  })
}
