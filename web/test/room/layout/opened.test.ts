import { beforeEach, expect, test } from 'vitest'
import { Opened } from '../../../src/room/layout/opened'

let opened: Opened
beforeEach(() => {
  opened = new Opened()
  opened.keep(['ur5e_1', 'ur5e_2'])
})

test('the first panel is open until another is chosen', () => {
  expect(opened.name).toBe('ur5e_1')
  opened.open('ur5e_2')
  expect(opened.name).toBe('ur5e_2')
})

test('none is open once a person closed it', () => {
  opened.close()
  opened.keep(['ur5e_1', 'ur5e_2', 'ur5e_3'])
  expect(opened.name).toBe('')
})

test('where the open one goes, as into a system, the first one opens', () => {
  opened.open('ur5e_2')
  opened.keep(['handover', 'ur5e_1'])
  expect(opened.name).toBe('handover')
})

test('a robot that is placed opens once it is there', () => {
  opened.open('kr6_1')
  expect(opened.name).toBe('ur5e_1')
  opened.keep(['ur5e_1', 'ur5e_2', 'kr6_1'])
  expect(opened.name).toBe('kr6_1')
})
