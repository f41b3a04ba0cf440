import { expect, it } from 'vitest'
import { muteLightProbe } from '../../../src/room/session/session'

it('a refused light probe stays unanswered; a granted one arrives', async () => {
  const probe = {}
  const answers = [Promise.reject(new DOMException('no', 'NotSupportedError')), probe]
  const session = { requestLightProbe: async () => answers.shift() ?? {} }
  muteLightProbe(session)
  const settled: string[] = []
  session.requestLightProbe().then(
    () => settled.push('granted'),
    () => settled.push('rejected'),
  )
  expect(await session.requestLightProbe()).toBe(probe)
  expect(settled).toEqual([])
})
