/** Time and garbage of decoding joint states: the generated codec against rosmsg2-serialization. */

import { parse } from '@foxglove/rosmsg'
import { MessageReader } from '@foxglove/rosmsg2-serialization'
import { CdrWriter } from '../src/protocol/cdr'
import { jointStateReader } from '../src/protocol/sensor_msgs'

const DEFINITION = `std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
===
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
===
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`
const ROUNDS = 200_000
const names = ['shoulder_pan', 'shoulder_lift', 'elbow', 'wrist_1', 'wrist_2', 'wrist_3']
const to = new CdrWriter().open()
to.int32(0)
to.uint32(0)
to.string('')
to.strings(names.map((name) => `${name}_joint`))
to.float64s(new Float64Array(6).fill(1.25))
to.float64s(new Float64Array(6).fill(0.5))
to.float64s(new Float64Array(0))
const payload = to.payload()
const batch = new Uint8Array(4 + payload.length)
batch.set(payload, 4)

/** Print us and bytes allocated a message, after a warm-up. */
function measure(name: string, decode: () => unknown): void {
  for (let i = 0; i < ROUNDS / 4; i++) decode()
  globalThis.gc?.()
  const heap = process.memoryUsage().heapUsed
  for (let i = 0; i < 2000; i++) decode()
  const grown = (process.memoryUsage().heapUsed - heap) / 2000
  // Time of this process, not of others beside it.
  const before = process.cpuUsage()
  for (let i = 0; i < ROUNDS; i++) decode()
  const us = process.cpuUsage(before).user / ROUNDS
  console.log(JSON.stringify({ name, us: +us.toFixed(3), bytes: Math.max(0, Math.round(grown)) }))
}

const reader = new MessageReader(parse(DEFINITION, { ros2: true }))
const kept = jointStateReader.create()
measure('rosmsg2-serialization', () => reader.readMessage(batch.subarray(4)))
measure('generated, a new message', () => jointStateReader.decode(batch, undefined, 4))
measure('generated, into a kept one', () => jointStateReader.decode(batch, kept, 4))
