import { execFile, spawn } from 'node:child_process'
import { mkdtempSync, openSync, readFileSync, rmSync } from 'node:fs'
import { createServer } from 'node:net'
import { tmpdir } from 'node:os'
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

function freePort() {
  return new Promise((resolve, reject) => {
    const probe = createServer().on('error', reject)
    probe.listen(0, '127.0.0.1', () => {
      const { port } = probe.address()
      probe.close(() => resolve(port))
    })
  })
}

/** Start a lab with four robots; `mrlab` runs a command in it, `stop` ends it. */
export async function startLab() {
  const folder = mkdtempSync(join(tmpdir(), 'mrlab-room-'))
  const domain = await run(PYTHON, [
    '-c',
    'from mrlab_ros.commands.demo.lab import claim_free_domain as c; f, d = c(); f.release(); print(d)',
  ])
  const env = {
    ...process.env,
    ROS_DOMAIN_ID: domain.stdout.trim(),
    ROS_AUTOMATIC_DISCOVERY_RANGE: 'LOCALHOST',
    XDG_RUNTIME_DIR: folder,
  }
  const http = await freePort()
  const log = join(folder, 'up.log')
  const output = openSync(log, 'w')
  const up = spawn(
    PYTHON,
    [
      ...['-m', 'mrlab_ros.cli', 'up', '--robots', 'ur5e,ur5e,ur5e,ur5e'],
      ...['--http', `127.0.0.1:${http}`, '--zenoh-listen', `tcp/127.0.0.1:${await freePort()}`],
      ...['--state-dir', join(folder, 'state')],
    ],
    { env, stdio: ['ignore', output, output] },
  )
  const ended = new Promise((resolve) => up.once('exit', resolve))
  const stop = async () => {
    up.kill('SIGINT')
    const late = setTimeout(() => up.kill('SIGKILL'), 20_000)
    await ended
    clearTimeout(late)
    rmSync(folder, { recursive: true, force: true })
  }
  try {
    await until(() => {
      if (up.exitCode !== null) throw new Error(readFileSync(log, 'utf8'))
      return readFileSync(log, 'utf8').includes('is ready')
    }, 'the lab was ready')
  } catch (error) {
    await stop()
    throw error
  }
  const mrlab = async (...args) => {
    const done = await run(PYTHON, ['-m', 'mrlab_ros.cli', ...args], { env })
    return done.stdout
  }
  return { url: `http://127.0.0.1:${http}`, mrlab, stop }
}
