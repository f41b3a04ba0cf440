import { expect, test } from 'vitest'
import { Carry } from '../../../src/room/handles/carry'
import { upright } from '../../../src/room/scene/frames'
import { FakeLink } from '../../fake_link'

const settled = () => new Promise((resolve) => setTimeout(resolve))

interface Told {
  readonly hand: string
  readonly sequence: number
  readonly pose: { readonly position: { readonly x: number } }
}

function carrying(answer: unknown = {}) {
  const link = new FakeLink()
  const calls: [string, number][] = []
  const answers: (() => void)[] = []
  const call = (x: number, hand: string) => {
    calls.push([hand, x])
    return new Promise<unknown>((resolve) => answers.push(() => resolve(answer)))
  }
  const carry = new Carry(
    { link, say: () => undefined },
    { object: 'cube_1' },
    0.1,
    (pose, hand) => call(pose.position.x, hand),
  )
  const moved = () => link.published.map(({ message }) => message as Told)
  const at = (x: number, now: number) => carry.move(upright(x, 0, 0, 0), now)
  const answerAll = async () => {
    for (const each of answers.splice(0)) each()
    await settled()
  }
  return { carry, call, calls, moved, at, answerAll }
}

test('a call takes it, its moves are numbered and no call', async () => {
  const { carry, calls, moved, at, answerAll } = carrying()
  at(1, 1)
  await settled()
  at(2, 2)
  // until the lab has given it to this hand, its moves would count for nothing
  expect(moved()).toEqual([])
  await answerAll()
  expect(carry.held).toBe(true)
  for (const now of [3, 3.05, 3.2]) at(now, now)
  expect(moved().map(({ sequence, pose }) => [sequence, pose.position.x])).toEqual([
    [1, 3],
    [2, 3.2],
  ])
  expect(new Set(moved().map(({ hand }) => hand))).toEqual(new Set([calls[0]?.[0]]))
  expect(calls).toHaveLength(1)
})

test('it is put down after it was taken, by a hand of its own each time', async () => {
  const { carry, call, calls, at, answerAll } = carrying()
  at(1, 1)
  carry.end(() => call(2, ''))
  await settled()
  expect(calls.map(([, x]) => x)).toEqual([1])
  await answerAll()
  expect(calls.map(([, x]) => x)).toEqual([1, 2])
  expect(carry.held).toBe(false)
  at(3, 1.01)
  await answerAll()
  await answerAll()
  expect(calls.map(([, x]) => x)).toEqual([1, 2, 3])
  expect(calls[2]?.[0]).not.toBe(calls[0]?.[0])
})

test('what the lab does not give is not moved', async () => {
  const { moved, at, answerAll } = carrying(null)
  at(1, 1)
  await settled()
  await answerAll()
  at(2, 2)
  expect(moved()).toEqual([])
})
