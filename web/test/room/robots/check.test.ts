// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { PANEL_THEME } from '../../../src/room/panels/pen'
import { checkColour, checkLabel, findingChoices } from '../../../src/room/robots/check'
import { en } from '../../../src/words/en'
import { FOUND_CHECK, finding, NO_CHECK } from '../../fake_api'

test('the button of a check says its verdict and how much was found', () => {
  expect(checkLabel(null, en)).toBe('Check')
  expect(checkLabel({ ...NO_CHECK, state: 'running' }, en)).toBe('Checking…')
  expect(checkLabel(FOUND_CHECK, en)).toBe('Not ready · 3')
  expect(
    checkLabel(
      { ...FOUND_CHECK, stale: finding({ code: 'moved', message: 'cube_1 has been moved' }) },
      en,
    ),
  ).toBe('Not ready? · 3')
  expect(checkLabel({ ...NO_CHECK, state: 'done', verdict: 'ready' }, en)).toBe('Ready')
})

test('a verdict of an earlier scene has the colour of no verdict', () => {
  const { states } = PANEL_THEME
  const ready = { ...NO_CHECK, state: 'done', verdict: 'ready' } as const
  expect(checkColour(ready)).toBe(states.READY)
  expect(checkColour(FOUND_CHECK)).toBe(states.COLLISION_HALT)
  expect(
    checkColour({ ...ready, stale: finding({ code: 'moved', message: 'cube_1 has been moved' }) }),
  ).toBe(states.PAUSED)
})

test('findings are listed by severity, kind and instant; who may not play checks nothing', () => {
  const choices = findingChoices(FOUND_CHECK, true, en)
  expect(choices.map(({ id }) => id)).toEqual(['again', '0', '1', '2'])
  expect(choices[1]?.words).toBe('Error: Collision at 214 s')
  expect(choices[3]?.words).toBe('Error: Too heavy')
  expect(findingChoices(FOUND_CHECK, false, en).map(({ id }) => id)).toEqual(['0', '1', '2'])
})
