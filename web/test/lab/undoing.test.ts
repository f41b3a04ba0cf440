import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest'
import { Undoing } from '../../src/lab/undoing'
import { undoableReader, undoType } from '../../src/protocol/mrlab_msgs'
import { FakeLink } from '../fake_link'

describe('what can be undone', () => {
  let link: FakeLink
  let undoing: Undoing
  let success: boolean
  let values: { key: string; value: string }[]
  let said: string[]

  /** Announce an act that can be undone until a time, s. */
  const announce = (id: string, until: number) => {
    link.deliver('undoable', undoableReader, { id, until: { sec: until, nanosec: 0 } })
  }
  const offered = () => undoing.act.value?.id ?? ''
  const undo = () => undoing.undo({ link, say: (text) => said.push(text) })

  beforeEach(() => {
    vi.useFakeTimers()
    link = new FakeLink()
    link.time = 100
    success = true
    values = []
    said = []
    link.answer('lab/undo', undoType, () => ({ success, message: 'Undone.', values }))
    undoing = new Undoing(link)
  })

  afterEach(() => {
    undoing.dispose()
    vi.useRealTimers()
  })

  it('is offered until its end, and never past it', () => {
    announce('a', 110)
    vi.advanceTimersByTime(9900)
    expect(offered()).toBe('a')
    vi.advanceTimersByTime(200)
    expect(offered()).toBe('')
    announce('b', 99)
    expect(offered()).toBe('')
    announce('c', 105)
    announce('', 0)
    expect(offered()).toBe('')
  })

  it('is offered again where the lab refused to undo it', async () => {
    announce('a', 110)
    success = false
    expect([await undo(), offered()]).toEqual([false, 'a'])
    success = true
    expect([await undo(), offered(), await undo()]).toEqual([true, '', false])
    expect(link.calls.map(({ request }) => request)).toEqual([{ id: 'a' }, { id: 'a' }])
  })

  it('says what did not come back', async () => {
    announce('a', 110)
    await undo()
    expect(said).toEqual([])
    announce('b', 110)
    values = [{ key: 'missing', value: '{}' }]
    await undo()
    expect(said).toEqual(['Undone.'])
  })
})
