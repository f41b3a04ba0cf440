import { writeFileSync } from 'node:fs'
import { until } from './lab.mjs'
import { FRAMES, quantile } from './scene.mjs'

/** µs between two samples. A longer gap is the time of another process, and counts as one sample. */
const INTERVAL = 200
const MS = 1000

/** Measure where the time of the room's own scripts goes, ms of CPU a frame: the headset's emulation
 * and the blind WebGL left out, garbage collection with it. file: gets the profile; '': none. */
export async function measureProfile(page, client, file = '') {
  await client.send('Profiler.enable')
  await client.send('Profiler.setSamplingInterval', { interval: INTERVAL })
  const drawn = () => page.evaluate(() => window.room.frames)
  const before = await drawn()
  await client.send('Profiler.start')
  await until(async () => (await drawn()) >= before + FRAMES, `${FRAMES} frames were drawn`)
  const frames = (await drawn()) - before
  const { profile } = await client.send('Profiler.stop')
  if (file !== '') writeFileSync(file, JSON.stringify(profile))
  return { frames, ...shares(profile, frames) }
}

/** Return ms a frame of the room's scripts (`own`), of collecting garbage, and of each function. */
function shares({ nodes, samples, timeDeltas }, frames) {
  const byId = new Map(nodes.map((node) => [node.id, node]))
  const functions = new Map()
  let own = 0
  let garbage = 0
  samples.forEach((id, i) => {
    const spent = Math.min(timeDeltas[i + 1] ?? INTERVAL, 2 * INTERVAL) / MS / frames
    const { functionName, url, lineNumber } = byId.get(id).callFrame
    if (functionName === '(garbage collector)') garbage += spent
    else if (url.includes('/static/')) own += spent
    else return
    const file = url.slice(url.lastIndexOf('/') + 1)
    const name = `${functionName || '(anonymous)'} ${file}:${lineNumber + 1}`
    functions.set(name, (functions.get(name) ?? 0) + spent)
  })
  const largest = [...functions].sort((a, b) => b[1] - a[1])
  return { own: own + garbage, garbage, largest }
}

/** Measure the CPU time of the thread in each frame callback, ms, the headset's emulation with it: what
 * else runs on the machine lengthens the time of a frame, and hardly this. */
export async function measureCpu(page) {
  const browser = page.context().browser()
  const before = await page.evaluate(() => window.room.frames)
  await browser.startTracing(page, { categories: ['devtools.timeline'] })
  await until(
    () => page.evaluate((end) => window.room.frames >= end, before + FRAMES),
    `${FRAMES} frames were drawn`,
  )
  const { traceEvents } = JSON.parse((await browser.stopTracing()).toString())
  const times = traceEvents
    .filter(({ name, tdur }) => name === 'FireAnimationFrame' && tdur !== undefined)
    .map(({ tdur }) => tdur / MS)
  return { p50: quantile(times, 0.5), p95: quantile(times, 0.95) }
}
