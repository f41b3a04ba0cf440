import { signal } from '@preact/signals'
import { describe, expect, it, vi } from 'vitest'
import type { RobotView } from '../../../src/lab/followed_robot'
import type { LabFollower, SystemView } from '../../../src/lab/follower'
import { RobotSystem, triggerType } from '../../../src/protocol/mrlab_msgs'
import { movingNow, pauseAll, pauseNews } from '../../../src/room/people/pausing'
import { FakeLink } from '../../fake_link'

function lab(): Pick<LabFollower, 'robots' | 'systems'> {
  const robot = (name: string, state: string, system = '') =>
    ({ robot: { name }, state, playback: { system } }) as unknown as RobotView
  const system = (name: string, state: number) =>
    ({ system: { name, state } }) as unknown as SystemView
  return {
    robots: signal([
      robot('a', 'PLAYING'),
      robot('b', 'ADJUSTING'),
      robot('c', 'PAUSED'),
      robot('d', 'PLAYING', 'cell'),
    ]),
    systems: signal([system('cell', RobotSystem.PLAYING), system('rest', RobotSystem.READY)]),
  }
}

describe('pausing all', () => {
  it('asks systems and the robots that are in none, those that move', () => {
    expect(movingNow(lab())).toEqual(['cell', 'a', 'b'])
  })

  it('says which were paused, and why others were not', async () => {
    const link = new FakeLink()
    link.answer('cell/pause', triggerType, () => ({ success: true, message: '' }))
    link.answer('a/pause', triggerType, () => ({ success: false, message: 'no' }))
    const { paused, failed } = await pauseAll(link, lab())
    expect(paused).toEqual(['cell'])
    expect(failed).toHaveLength(2)
    expect(failed).toContain('a: no')
  })

  it('is one sentence for those who see it', () => {
    const link = new FakeLink()
    const say = vi.fn()
    let time = 0
    const end = pauseNews(link, say, () => time)
    link.did({ who: 'eva', service: 'a/pause' })
    link.did({ who: 'eva', service: 'b/pause' })
    expect(say).toHaveBeenLastCalledWith('eva', ['a', 'b'])
    time = 5
    link.did({ who: 'eva', service: 'a/pause' })
    expect(say).toHaveBeenLastCalledWith('eva', ['a'])
    link.did({ who: 'ben', service: 'c/pause' })
    expect(say).toHaveBeenLastCalledWith('ben', ['c'])
    end()
    link.did({ who: 'ben', service: 'd/pause' })
    expect(say).toHaveBeenCalledTimes(4)
  })
})
