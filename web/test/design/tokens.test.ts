import { expect, test } from 'vitest'
import { THEMES } from '../../src/design/tokens'

function luminance(colour: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const share = Number.parseInt(colour.slice(at, at + 2), 16) / 255
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4
  }) as [number, number, number]
  return 0.2126 * r + 0.7152 * g + 0.0722 * b
}

/** WCAG 2.2, 1.4.3 */
function contrast(a: string, b: string): number {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y) as [number, number]
  return (high + 0.05) / (low + 0.05)
}

test.each(['light', 'dark'] as const)('text of the %s theme is readable', (name) => {
  const { colours, states } = THEMES[name]
  for (const ground of [colours.card, colours.page])
    for (const ink of [colours.ink, colours.second, colours.accent])
      expect(contrast(ink, ground)).toBeGreaterThanOrEqual(4.5)
  expect(contrast(colours.on_accent, colours.accent)).toBeGreaterThanOrEqual(4.5)
  expect(contrast(colours.on_halt, states.COLLISION_HALT)).toBeGreaterThanOrEqual(4.5)
  for (const state of Object.values(states))
    expect(contrast(state, colours.card)).toBeGreaterThanOrEqual(4.5)
})

test.each(['light', 'dark'] as const)('lines and borders of the %s theme are seen', (name) => {
  const { colours, joints } = THEMES[name]
  for (const line of [...joints, colours.border])
    expect(contrast(line, colours.card)).toBeGreaterThanOrEqual(2.9)
})
