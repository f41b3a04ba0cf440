// @vitest-environment jsdom
import { expect, test, vi } from 'vitest'
import type { Api } from '../../src/api/api'
import { fits, LabCatalogue, playable } from '../../src/lab/catalogue'
import { originOf, reachable } from '../../src/pages/motion/link_with_code'
import { FakeApi } from '../fake_api'

test('a robot plays what is for its model, and for what it carries or for nothing', async () => {
  const [made] = (await new FakeApi().trajectories()).trajectories
  if (made === undefined) throw new Error('the fake has trajectories')
  const plain = { ...made, id: 'plain', robot_model: 'ur5e', end_effector: '', created: 1 }
  const gripping = { ...plain, id: 'gripping', end_effector: 'hand', created: 2 }
  const other = { ...plain, id: 'other', robot_model: 'kr6' }
  const bare = { model: 'ur5e', end_effector: '' }
  expect(fits(plain, { ...bare, end_effector: 'hand' })).toBe(true)
  const { here, otherwise } = playable([plain, gripping, other], bare)
  expect(here.map((info) => info.id)).toEqual(['plain'])
  expect(otherwise).toBe(1)
  const both = playable([plain, gripping, other], { ...bare, end_effector: 'hand' })
  expect(both.here.map((info) => info.id)).toEqual(['gripping', 'plain'])
})

test('a change while the list is read has it read once more, and only once', async () => {
  const trajectories = vi.fn(async () => [])
  const catalogue = new LabCatalogue({ trajectories } as unknown as Api)
  await Promise.all([catalogue.load(), catalogue.load(), catalogue.load()])
  expect(trajectories).toHaveBeenCalledTimes(2)
})

test('an address of this machine alone is no address for a phone', () => {
  for (const host of ['127.0.0.1', '127.8.8.8', 'localhost', 'lab.localhost', '[::1]'])
    expect(reachable(host)).toBe(false)
  for (const host of ['192.168.1.20', 'lab.uni.example', '[fd00::1]'])
    expect(reachable(host)).toBe(true)
  expect(originOf('https://lab.uni.example:8765/lab?x=1')).toBe('https://lab.uni.example:8765')
  expect(originOf('http://127.0.0.1:8765')).toBe('')
  expect(originOf('no address')).toBe('')
})
