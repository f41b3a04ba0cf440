import { join } from 'node:path'
import { mrlab, ROOT, until } from './lab.mjs'

/** How much is measured; `--touch` only sees that it runs. */
export const TOUCH = process.argv.includes('--touch')
export const FRAMES = TOUCH ? 30 : 600
const OBJECTS = TOUCH ? 2 : 20
const WINDOWS = TOUCH ? 1 : 3
const SCRUBS = TOUCH ? 1 : 24

/** Fill the scene: robots with grippers that pick and place for ever, twenty objects. */
export async function fillScene(page) {
  const names = ['ur5e_1', 'ur5e_2', 'ur5e_3', 'ur5e_4']
  const choose = (name, list, id) =>
    page.evaluate(
      ([name, list, id]) => {
        const { room } = window
        room.opened.open(name)
        room.opened.keep(room.panels.names)
        const { panel } = room.panels.of(name)
        panel.group.visible = true
        return panel.act(list) && panel.act(`choose ${id}`)
      },
      [name, list, id],
    )
  for (const name of names) await choose(name, 'end_effector', 'parallel_gripper')
  const tools = () => window.room.follower.robots.value.map(({ robot }) => robot.end_effector)
  await until(
    async () => (await page.evaluate(tools)).every((tool) => tool !== ''),
    'every robot had its gripper',
  )
  const file = join(ROOT, 'examples', 'pick_and_place_ur5e.mat')
  await mrlab('play', names[0], file, '--no-wait')
  const motion = await until(
    () => page.evaluate(() => window.room.trajectories[0]?.id ?? ''),
    'the motion was in the catalogue',
  )
  for (const name of names.slice(1)) await choose(name, 'motions', motion)
  await page.evaluate(async (count) => {
    const { spawning } = window.room
    for (let i = 0; i < count; i++) {
      const position = { x: -1 + 0.2 * (i % 10), y: -1.5 - 0.2 * Math.floor(i / 10), z: 0.1 }
      const pose = { position, orientation: { x: 0, y: 0, z: 0, w: 1 } }
      await spawning.spawnObject(spawning.types[i % 5].id, pose)
    }
  }, OBJECTS)
  await page.evaluate(() => {
    // what has ended plays again
    window.again = setInterval(() => {
      for (const { robot, state } of window.room.follower.robots.value) {
        const panel = window.room.panels.of(robot.name)
        if (['READY', 'PAUSED', 'COMPLETE'].includes(state)) panel?.play()
      }
    }, 500)
  })
  await until(
    () =>
      page.evaluate(
        () =>
          window.room.follower.robots.value.every(({ state }) => state === 'PLAYING') &&
          window.room.panels.of('ur5e_4') !== undefined,
      ),
    'all robots played',
  )
}

/** Return the value below which a share of values lies. */
export function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b)
  return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)]
}

/** Measure frames in several windows; the quietest counts, for other work on the machine is none of
 * the room's. */
export async function measureFrames(page) {
  const found = []
  for (let i = 0; i < WINDOWS; i++) {
    await page.evaluate(() => {
      window.samples.js.length = window.samples.callback.length = 0
    })
    await until(
      () => page.evaluate((count) => window.samples.js.length >= count, FRAMES),
      `${FRAMES} frames were drawn`,
    )
    const { js, callback } = await page.evaluate(() => ({
      js: window.samples.js,
      callback: window.samples.callback,
    }))
    found.push({ p50: quantile(js, 0.5), p95: quantile(js, 0.95), callbackP95: quantile(callback, 0.95) })
  }
  found.sort((a, b) => a.p95 - b.p95)
  const scene = await page.evaluate(() => {
    const { calls, triangles } = window.room.stage.renderer.info.render
    return { calls, triangles, glCalls: window.samples.glCalls }
  })
  return { ...found[0], ...scene }
}

/** Show the telemetry of all robots, and measure what is sent to the graphics card, MB/s, and what a
 * frame then costs, ms. also: measures more of it. */
export async function measureTelemetry(page, also) {
  await page.evaluate(() => {
    for (const name of window.room.panels.names) window.room.panels.of(name).telemetry = true
  })
  await page.waitForTimeout(TOUCH ? 200 : 2000)
  const found = await page.evaluate(async (ms) => {
    window.samples.js.length = 0
    const began = performance.now()
    const bytes = window.blindBytes
    await new Promise((resolve) => setTimeout(resolve, ms))
    const seconds = (performance.now() - began) / 1000
    return { sent: (window.blindBytes - bytes) / seconds / 1e6, js: window.samples.js }
  }, TOUCH ? 300 : 5000)
  const { calls } = await page.evaluate(() => window.room.stage.renderer.info.render)
  const more = await also()
  await page.evaluate(() => {
    for (const name of window.room.panels.names) window.room.panels.of(name).telemetry = false
  })
  return { sent: found.sent, p95: quantile(found.js, 0.95), calls, more }
}

/** Measure from moving the knob of a paused robot until its pose changes in a frame, ms. */
export async function measureScrub(page) {
  const times = await page.evaluate(async (count) => {
    clearInterval(window.again)
    const { room } = window
    const view = () => room.follower.robots.value.find(({ robot }) => robot.name === 'ur5e_1')
    const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms))
    room.panels.of('ur5e_1').play()
    for (let i = 0; i < 200 && view().state !== 'PAUSED'; i++) await wait(20)
    const times = []
    for (let i = 0; i < count; i++) {
      await wait(400)
      const arm = room.scene.robot('ur5e_1')
      const names = view().robot.joint_names
      const pose = () => names.map((name) => arm.angle(name)).join()
      const before = pose()
      const began = performance.now()
      const moved = new Promise((resolve) => {
        window.samples.listener = () => {
          if (pose() !== before) resolve(performance.now() - began)
        }
      })
      view().player.seek(view().player.duration * (0.15 + 0.7 * ((i * 0.37) % 1)))
      times.push(await Promise.race([moved, wait(2000).then(() => 2000)]))
    }
    window.samples.listener = null
    return times
  }, SCRUBS)
  return { p50: quantile(times, 0.5), p95: quantile(times, 0.95) }
}

/** Measure how the heap grows while everything goes on, each value after a collection; kB. `series`:
 * the sizes, evenly over the time, one a minute or more. */
export async function measureMemory(page, client, minutes) {
  await page.evaluate(() => {
    window.again = setInterval(() => {
      for (const { robot, state } of window.room.follower.robots.value) {
        const panel = window.room.panels.of(robot.name)
        if (['READY', 'PAUSED', 'COMPLETE'].includes(state)) panel?.play()
      }
    }, 500)
  })
  const used = async (collect) => {
    if (collect) await client.send('HeapProfiler.collectGarbage')
    return (await client.send('Runtime.getHeapUsage')).usedSize / 1000
  }
  const steps = TOUCH ? 2 : Math.max(8, 2 * Math.round(minutes / 2))
  const found = []
  let garbage = Number.POSITIVE_INFINITY
  for (let i = 0; i <= steps; i++) {
    await page.evaluate(() => {
      window.samples.js.length = window.samples.callback.length = 0
    })
    const before = await used(true)
    found.push(before)
    const frames = await page.evaluate(() => window.room.frames)
    await page.waitForTimeout(1000)
    const grown = (await used(false)) - before
    const drawn = (await page.evaluate(() => window.room.frames)) - frames
    if (grown > 0 && drawn > 0) garbage = Math.min(garbage, grown / drawn)
    if (i < steps) await page.waitForTimeout(Math.max(((TOUCH ? 0 : minutes) * 60_000) / steps - 1000, 0))
  }
  const growth = found[steps] - found[0]
  const slope = (found[steps] - found[steps / 2]) / (minutes / 2)
  return { growth, slope, garbage, series: found }
}
