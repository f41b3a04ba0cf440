/** A client of a real gateway, driven over stdin by test/system/test_link.py: a JSON line a
 * command, and a JSON line for each thing that happens. Arguments: url, cookie. */

import { createInterface } from 'node:readline'
import type { LinkError } from '../../src/link/link'
import { openLink } from '../../src/link/socket'
import type { ServiceType } from '../../src/protocol/message_type'
import {
  convertTrajectoryType,
  loadTrajectoryType,
  playbackStateReader,
  robotsReader,
  setLoopType,
  triggerType,
} from '../../src/protocol/mrlab_msgs'
import { jointStateReader } from '../../src/protocol/sensor_msgs'

const [url = '', cookie = ''] = process.argv.slice(2)
const origin = url.replace(/^ws/, 'http').replace(/\/link$/, '')
const services = new Map(
  [convertTrajectoryType, loadTrajectoryType, setLoopType, triggerType].map((type) => [
    type.name as string,
    type as unknown as ServiceType<object, object>,
  ]),
)

function say(event: object): void {
  process.stdout.write(`${JSON.stringify(event)}\n`)
}

const link = openLink(url, {
  open: (address, protocol) => {
    // Node's WebSocket takes headers, which a browser sets by itself.
    const options = { protocols: [protocol], headers: { origin, cookie } }
    return new WebSocket(address, options as unknown as string[])
  },
})
let phase = ''
link.onStatus((status) => {
  if (status.phase === phase) return
  phase = status.phase
  say({ status: phase, reason: status.reason, topics: Object.keys(link.offer.topics).length })
})
link.subscribe('robots', robotsReader, ({ robots }) => {
  say({ robots: robots.map(({ name }) => name) })
})
link.subscribe('*/playback_state', playbackStateReader, ({ label, clock }, { key }) => {
  say({ state: label, key, stamp: clock.stamp.sec })
})
let count = 0
link.subscribe('*/joint_states', jointStateReader, ({ name, position, header }, { stamp }) => {
  count++
  if (count % 25 !== 1) return
  const published = header.stamp.sec + header.stamp.nanosec / 1e9
  say({
    joints: name.length,
    position: [...position],
    age: link.labTime() - stamp,
    late: stamp - published,
  })
})
createInterface({ input: process.stdin }).on('line', (line) => {
  const { id, service, type, request } = JSON.parse(line) as {
    id: number
    service: string
    type: string
    request: object
  }
  const kind = services.get(type)
  if (kind === undefined) throw new Error(`${type} is none of ${[...services.keys()]}`)
  link.call(service, kind, request).then(
    (response) => say({ answer: id, response }),
    (error: LinkError) => say({ answer: id, error: error.kind, told: error.told }),
  )
})
say({ status: link.status.phase })
