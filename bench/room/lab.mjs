import { execFile } from 'node:child_process'
import { join } from 'node:path'
import { promisify } from 'node:util'

export const ROOT = join(import.meta.dirname, '..', '..')
const PYTHON = join(ROOT, '.venv', 'bin', 'python')
const DEADLINE_MS = 120_000
const run = promisify(execFile)

/** Wait until `done` returns something; throws after two minutes. */
export async function until(done, what) {
  const end = Date.now() + DEADLINE_MS
  for (;;) {
    const found = await done()
    if (found) return found
    if (Date.now() > end) throw new Error(`it took too long until ${what}`)
    await new Promise((resolve) => setTimeout(resolve, 50))
  }
}

/** Run a command of `mrlab` in the lab of this environment. */
export async function mrlab(...args) {
  await run(PYTHON, ['-m', 'mrlab_ros.cli', ...args])
}
