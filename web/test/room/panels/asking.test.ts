import { expect, it } from 'vitest'
import { Asking, CONFIRM_S } from '../../../src/room/panels/asking'

it('an act is carried out by the second press of the same button, in time', () => {
  const said: string[] = []
  const done: string[] = []
  let now = 0
  const asking = new Asking(
    (question) => said.push(question),
    () => now,
  )
  const press = (id: string) => asking.press(id, `${id}?`, () => done.push(id))
  press('empty')
  expect([said, done]).toEqual([['empty?'], []])
  // Another act asks for itself.
  press('load')
  press('empty')
  expect(done).toEqual([])
  now += CONFIRM_S
  press('empty')
  expect(done).toEqual(['empty'])
  // Each act is asked for anew, and a late press asks again.
  press('empty')
  now += CONFIRM_S + 0.1
  press('empty')
  expect([said, done]).toEqual([['empty?', 'load?', 'empty?', 'empty?', 'empty?'], ['empty']])
})
