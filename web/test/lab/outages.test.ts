// @vitest-environment jsdom
import { describe, expect, it } from 'vitest'
import { BACK_S, holds, outagesOf, outageWords } from '../../src/lab/outages'
import { createLabProcess, LabProcess } from '../../src/protocol/mrlab_msgs'
import { words as de } from '../../src/words/de'
import { en } from '../../src/words/en'

const at = (sec: number) => ({ sec, nanosec: 0 })
const DEAD: LabProcess = {
  ...createLabProcess(),
  name: 'playback',
  nodes: ['playback_host'],
  state: LabProcess.WAITING,
  down: at(100),
  exit_code: -9,
  last_exit: 'SIGKILL',
  restart_in: 1.2,
}
const only = (change: Partial<LabProcess>, now = 101) => outagesOf([{ ...DEAD, ...change }], now)

describe('outages of a lab', () => {
  it.each([
    ['a process that is started again', {}, 'died'],
    ['one that a signal stopped', { state: LabProcess.FROZEN }, 'froze'],
    ['one with a wrong configuration', { state: LabProcess.REFUSED }, 'refused'],
    ['one that is back', { state: LabProcess.RUNNING, since: at(101) }, 'back'],
  ])('%s', (_, change, kind) => {
    const [outage, ...more] = only(change)
    expect(more).toEqual([])
    expect(outage?.kind).toBe(kind)
    for (const { lab } of [en, de]) {
      if (outage !== undefined) expect(outageWords(outage, lab.outages)).toContain('playback')
    }
  })

  it('are over some time after the return, and none where nothing was down', () => {
    const back = { state: LabProcess.RUNNING, since: at(101) }
    expect(only(back, 101 + BACK_S)).toEqual([])
    expect(only({ ...back, down: at(0) })).toEqual([])
    expect(only({ state: LabProcess.STOPPED })).toEqual([])
  })

  it('say how the process ended and when it is back', () => {
    const [outage] = only({})
    if (outage === undefined) throw new Error('none')
    expect(outageWords(outage, en.lab.outages)).toMatch(
      /^playback died at .*\d\d.* \(SIGKILL\), back in 2 s$/,
    )
    const left = { ...outage, process: { ...DEAD, exit_code: 1, last_exit: 'exit code 1' } }
    expect(outageWords(left, de.lab.outages)).toContain('(Exit-Code 1)')
  })

  it('name the robots by the node that plays them', () => {
    expect(holds(DEAD, '/playback_host/lab_7')).toBe(true)
    expect(holds(DEAD, '/playback_host_2')).toBe(false)
    expect(holds(DEAD, '')).toBe(false)
  })
})
