#!/usr/bin/env node
/** Measure the room in Chromium with an emulated Quest 3, both eyes drawn; WebGL's own calls do
 * nothing, so the figures leave the GPU and its driver out. Prints them as JSON. measures/room.py runs
 * it:  node room.mjs LAB_URL SIGN_IN_URL [--touch] [--minutes N] [--profile FILE.cpuprofile]
 */
import { parseArgs } from 'node:util'
import { bytesOf, openRoom } from './page.mjs'
import { measureCpu, measureProfile } from './profile.mjs'
import { fillScene, measureFrames, measureMemory, measureScrub, measureTelemetry } from './scene.mjs'

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    minutes: { type: 'string', default: '0.5' },
    touch: { type: 'boolean', default: false },
    profile: { type: 'string', default: '' },
  },
})
const [url, signIn] = positionals
const figures = []
const note = (figure, value, unit, mark = null) => figures.push({ figure, value, unit, mark })
const { page, client, close, toRobot, toLab } = await openRoom(url, signIn)
try {
  note('open the page to the lab in view', toLab, 'ms')
  note('tap to first robot', toRobot, 'ms', 3000)
  await fillScene(page)
  const plain = await measureFrames(page)
  note('JavaScript a frame, p50', plain.p50, 'ms')
  note('JavaScript a frame, p95', plain.p95, 'ms', 2)
  const cpu = await measureCpu(page)
  note('CPU time of a frame with the emulated headset, p50', cpu.p50, 'ms')
  note('CPU time of a frame with the emulated headset, p95', cpu.p95, 'ms', 2)
  const profile = await measureProfile(page, client, options.profile)
  note("CPU time of the room's scripts a frame, messages with it, mean", profile.own, 'ms')
  note('whole frame callback with the emulated headset, p95', plain.callbackP95, 'ms')
  await client.send('Emulation.setCPUThrottlingRate', { rate: 4 })
  const slow = await measureFrames(page)
  await client.send('Emulation.setCPUThrottlingRate', { rate: 1 })
  note('JavaScript a frame at 4x throttle, p50', slow.p50, 'ms')
  note('JavaScript a frame at 4x throttle, p95', slow.p95, 'ms', 4)
  note('draw calls, both eyes and shadow', plain.calls, '', 110)
  note('triangles, both eyes and shadow', plain.triangles, '', 600_000)
  note('WebGL calls a frame', plain.glCalls, '')
  const telemetry = await measureTelemetry(page, () => measureCpu(page))
  note('sent to the graphics card, four telemetry panels', telemetry.sent, 'MB/s', 2)
  note('JavaScript a frame, four telemetry panels, p95', telemetry.p95, 'ms', 2)
  note('CPU time of a frame, four telemetry panels, p95', telemetry.more.p95, 'ms', 2)
  note('draw calls, both eyes and shadow, four telemetry panels', telemetry.calls, '', 110)
  const scrub = await measureScrub(page)
  note('scrub to pose change, p50', scrub.p50, 'ms', 50)
  note('scrub to pose change, p95', scrub.p95, 'ms')
  const memory = await measureMemory(page, client, Number(options.minutes))
  memory.series.forEach((kilobytes, i) => {
    note(`heap, step ${i} of ${memory.series.length - 1}`, kilobytes / 1000, 'MB')
  })
  note(`heap growth over ${options.minutes} min`, memory.growth, 'kB')
  note('heap growth a minute, second half', memory.slope, 'kB/min', 100)
  note('garbage a frame', memory.garbage, 'kB')
  note('scripts and styles of the room, gzip', await bytesOf(page, url), 'kB', 450)
  const largest = options.profile === '' ? [] : profile.largest.slice(0, 12)
  for (const [where, spent] of largest) note(where, spent, 'ms a frame')
} finally {
  await close()
}
console.log(JSON.stringify(figures))
