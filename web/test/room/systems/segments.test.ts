import { describe, expect, it, vi } from 'vitest'
import { Creation } from '../../../src/room/systems/creation'
import { segmentsOf } from '../../../src/room/systems/segments'

const member = (robot: string, start: number, duration: number) => ({
  robot,
  start,
  duration,
  waiting_for: '',
})

describe('the segments of a system', () => {
  it('stand where their members play, in the order of touch', () => {
    const found = segmentsOf([member('kr6_1', 0, 4), member('ur5e_1', 4, 4)], 8)
    expect(found.map(({ label, from, to }) => [label, from, to])).toEqual([
      ['1 kr6_1', 0, 0.5],
      ['2 ur5e_1', 0.5, 1],
    ])
  })

  it('stay on a timeline that has no length, or is shorter than they are', () => {
    expect(segmentsOf([member('a', 0, 0)], 0)[0]).toMatchObject({ from: 0, to: 0 })
    expect(segmentsOf([member('a', 2, 20)], 10)[0]).toMatchObject({ from: 0.2, to: 1 })
  })
})

describe('choosing robots', () => {
  it('keeps the order of touch; touched again, one goes out', () => {
    const changed = vi.fn()
    const creation = new Creation(changed)
    creation.touch('a')
    expect(creation.picked).toEqual([])
    creation.begin()
    for (const name of ['c', 'a', 'b', 'a']) creation.touch(name)
    expect(creation.picked).toEqual(['c', 'b'])
    creation.keep((name) => name !== 'c')
    expect(creation.picked).toEqual(['b'])
    creation.end()
    expect([creation.on, creation.picked.length]).toEqual([false, 0])
    expect(changed).toHaveBeenCalledTimes(7)
  })
})
