import { expect, test } from 'vitest'
import { Pace } from '../../../src/scene/stage/renderer'

test('a machine draws until it is done with the orders of the last picture', () => {
  let status = 'unsignaled'
  let kept = 0
  const context = {
    UNSIGNALED: 'unsignaled',
    fenceSync: () => ({ number: ++kept }),
    deleteSync: (sync: object | null) => {
      if (sync !== null) kept--
    },
    getSyncParameter: () => status,
    flush: () => undefined,
  }
  const pace = new Pace(context as unknown as WebGL2RenderingContext)
  expect(pace.draws).toBe(false)
  pace.ordered()
  pace.ordered()
  expect(pace.draws).toBe(true)
  status = 'signaled'
  expect([pace.draws, pace.draws]).toEqual([false, false])
  expect(kept).toBe(0)
})
