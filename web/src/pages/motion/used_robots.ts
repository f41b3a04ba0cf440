import type { Robot } from '../../api/types'

/** The robot of the examples. */
export const FIRST_ROBOT = 'ur5e'
const KEY = 'mrlab.robots'

/** How often each robot was used in this browser. */
function uses(): Record<string, number> {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? '{}') as Record<string, number>
  } catch {
    return {}
  }
}

/** Count one more use of a robot. */
export function countUse(model: string): void {
  const before = uses()
  localStorage.setItem(KEY, JSON.stringify({ ...before, [model]: (before[model] ?? 0) + 1 }))
}

/** Return the robots, the most used first; the one that beginners take before others. */
export function mostUsed(robots: readonly Robot[]): readonly Robot[] {
  const count: Record<string, number> = { [FIRST_ROBOT]: 0.5, ...uses() }
  return [...robots].sort((a, b) => (count[b.model] ?? 0) - (count[a.model] ?? 0))
}
