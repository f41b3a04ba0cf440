#!/usr/bin/env node
/** What the room costs: JavaScript time a frame, draw calls, triangles, memory, bytes, and how soon
 * it answers.
 *
 * A real lab with four robots that play, twenty objects and four panels; Chromium with an emulated
 * Quest 3, both eyes drawn. WebGL's own calls do nothing, so the figures leave the GPU and its driver
 * out. `mrlab` must be set up in .venv:  node bench/room.mjs [--minutes 10] [--json FILE]
 *     [--profile FILE.cpuprofile]
 */
import { writeFileSync } from 'node:fs'
import { cpus, loadavg } from 'node:os'
import { parseArgs } from 'node:util'
import { startLab } from './room_bench/lab.mjs'
import { bytesOf, openRoom } from './room_bench/page.mjs'
import { measureCpu, measureProfile } from './room_bench/profile.mjs'
import { fillScene, measureFrames, measureMemory, measureScrub } from './room_bench/scene.mjs'

const { values: options } = parseArgs({
  options: {
    minutes: { type: 'string', default: '0.5' },
    touch: { type: 'boolean', default: false },
    json: { type: 'string' },
    profile: { type: 'string', default: '' },
    help: { type: 'boolean', short: 'h', default: false },
  },
})
if (options.help) {
  console.log(`node bench/room.mjs [--minutes N] [--json FILE] [--profile FILE.cpuprofile]

Measures what the room costs with 4 robots that play, 20 objects and 4 panels, in Chromium with an
emulated Quest 3; starts a lab of its own, which ends with it.

  --touch        see only that it runs
  --minutes N    how long the memory is watched; 0.5 where it is not given
  --json FILE    keeps the figures
  --profile FILE keeps a profile for the browser's own tools, and prints its largest parts`)
  process.exit(0)
}

const lab = await startLab()
const figures = []
let largest = []
let heap = []
const note = (what, value, unit, mark) => {
  figures.push({ what, value, unit, mark, meets: mark === null ? null : value < mark })
}
try {
  const { page, client, close, toRobot, toLab } = await openRoom(lab)
  try {
    note('open the page to the lab in view', toLab, 'ms', null)
    note('tap to first robot', toRobot, 'ms', 3000)
    await fillScene(page, lab)
    const plain = await measureFrames(page)
    note('JavaScript a frame, p50', plain.p50, 'ms', null)
    note('JavaScript a frame, p95', plain.p95, 'ms', 2)
    const cpu = await measureCpu(page)
    note('CPU time of a frame with the emulated headset, p50', cpu.p50, 'ms', null)
    note('CPU time of a frame with the emulated headset, p95', cpu.p95, 'ms', 2)
    const profile = await measureProfile(page, client, options.profile)
    note("CPU time of the room's scripts a frame, messages with it, mean", profile.own, 'ms', null)
    largest = profile.largest.slice(0, 12)
    note('whole frame callback with the emulated headset, p95', plain.callbackP95, 'ms', null)
    await client.send('Emulation.setCPUThrottlingRate', { rate: 4 })
    const slow = await measureFrames(page)
    await client.send('Emulation.setCPUThrottlingRate', { rate: 1 })
    note('JavaScript a frame at 4x throttle, p50', slow.p50, 'ms', null)
    note('JavaScript a frame at 4x throttle, p95', slow.p95, 'ms', 4)
    note('draw calls, both eyes and shadow', plain.calls, '', 200)
    note('triangles, both eyes and shadow', plain.triangles, '', 600_000)
    note('WebGL calls a frame', plain.glCalls, '', null)
    const scrub = await measureScrub(page)
    note('scrub to pose change, p50', scrub.p50, 'ms', 50)
    note('scrub to pose change, p95', scrub.p95, 'ms', null)
    const memory = await measureMemory(page, client, Number(options.minutes))
    heap = memory.series
    note(`heap growth over ${options.minutes} min`, memory.growth, 'kB', null)
    note('heap growth a minute, second half', memory.slope, 'kB/min', 100)
    note('garbage a frame', memory.garbage, 'kB', null)
    const bundle = await bytesOf(page, lab)
    note('scripts and styles of the room, gzip', bundle, 'kB', 450)
  } finally {
    await close()
  }
} finally {
  await lab.stop()
}

const machine = `${cpus().length} cores, Node ${process.version}, load average ${loadavg()
  .map((each) => each.toFixed(2))
  .join(', ')}`
const width = Math.max(...figures.map(({ what }) => what.length))
console.log('The room: 4 robots that play, 20 objects, 4 panels')
for (const { what, value, unit, mark, meets } of figures) {
  const number = value < 100 ? value.toFixed(2) : value.toFixed(0)
  const beside = mark === null ? '' : `  ${meets ? 'meets' : 'MISSES'} < ${mark}`
  console.log(`  ${what.padEnd(width)}  ${number.padStart(9)} ${unit.padEnd(6)}${beside}`)
}
const sizes = heap.map((kilobytes) => (kilobytes / 1000).toFixed(2)).join(' ')
console.log(`Heap after a collection, evenly over ${options.minutes} min, MB: ${sizes}`)
if (options.profile) {
  console.log('Where the time of the scripts goes, ms a frame:')
  for (const [where, spent] of largest) console.log(`  ${spent.toFixed(3)}  ${where}`)
}
console.log(machine)
if (options.json) writeFileSync(options.json, JSON.stringify({ machine, figures, heap }, null, 1))
