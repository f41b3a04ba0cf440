import { expect, test } from 'vitest'
import { Moves } from '../../../src/room/handles/moves'

const settled = () => new Promise((resolve) => setTimeout(resolve))

function slow() {
  const sent: number[] = []
  const answers: (() => void)[] = []
  const moves = new Moves<number>(0.1, (value) => {
    sent.push(value)
    return new Promise<void>((resolve) => answers.push(resolve))
  })
  return { moves, sent, answer: () => answers.shift()?.() }
}

test('one value is on its way at a time, a period apart', async () => {
  const { moves, sent, answer } = slow()
  expect(moves.due(1)).toBe(true)
  moves.send(1, 1)
  expect(moves.due(2)).toBe(false)
  answer()
  await settled()
  expect(moves.due(1.05)).toBe(false)
  expect(moves.due(1.2)).toBe(true)
  expect(sent).toEqual([1])
})

test('of the values behind one that is unanswered the last is sent', async () => {
  const { moves, sent, answer } = slow()
  for (const value of [1, 2, 3]) moves.send(value, 1)
  expect(sent).toEqual([1])
  answer()
  await settled()
  expect(sent).toEqual([1, 3])
  expect(moves.unanswered).toBe(true)
  answer()
  await settled()
  expect(moves.unanswered).toBe(false)
})
