import { LabProcess } from '../protocol/mrlab_msgs'
import type { Words } from '../words/en'
import { timeOfDay } from '../words/words'
import { seconds } from './followed_robot'

/** s for which a process that runs again is named. */
export const BACK_S = 60

/** A process of the lab that does not run, or runs again since a short while. */
export interface Outage {
  readonly kind: 'died' | 'froze' | 'refused' | 'back'
  readonly process: LabProcess
}

/** Return the outages of a lab at a time, s of lab time, in the order of its processes. */
export function outagesOf(processes: readonly LabProcess[], now: number): readonly Outage[] {
  return processes.flatMap((process): readonly Outage[] => {
    switch (process.state) {
      case LabProcess.WAITING:
        return [{ kind: 'died', process }]
      case LabProcess.FROZEN:
        return [{ kind: 'froze', process }]
      case LabProcess.REFUSED:
        return [{ kind: 'refused', process }]
      case LabProcess.RUNNING:
        return now < backUntil(process) ? [{ kind: 'back', process }] : []
      default:
        return []
    }
  })
}

/** Return until when a process that runs is named, s of lab time; 0: it was never down. */
export function backUntil({ state, down, since }: LabProcess): number {
  return state === LabProcess.RUNNING && seconds(down) > 0 ? seconds(since) + BACK_S : 0
}

/** Return the text of an outage. */
export function outageWords({ kind, process }: Outage, w: Words['lab']['outages']): string {
  const { name, exit_code: code, last_exit: said } = process
  const at = timeOfDay(seconds(process.down))
  const how = said === '' ? '' : code < 0 ? said : w.exitCode(code)
  if (kind === 'died') return w.died(name, at, how, Math.max(Math.ceil(process.restart_in), 1))
  if (kind === 'back') return w.back(name, timeOfDay(seconds(process.since)), at, how)
  return w[kind](name, at)
}

/** Return whether a process holds a node; node: its full name, or one below that. */
export function holds({ nodes }: LabProcess, node: string): boolean {
  return nodes.some((held) => `${node}/`.startsWith(`/${held}/`))
}
