/** Receive joint states in a benchmark's page or clients, and note their ages. */

import { openLink, type SocketOptions } from '../src/link/socket'
import { type JointState, jointStateReader } from '../src/protocol/sensor_msgs'

export interface Ages {
  /** s from publishing to decoded, one a message */
  readonly ages: number[]
  stop(): void
}

/** Receive by the lab's own protocol; begin to note when the clock is known. */
export function receiveLink(url: string, options: SocketOptions = {}): Ages {
  const ages: number[] = []
  const link = openLink(url, options)
  link.subscribe('*/joint_states', jointStateReader, (_, sample) => {
    if (!Number.isNaN(link.status.roundTrip)) ages.push(link.labTime() - sample.stamp)
  })
  return { ages, stop: () => link.close() }
}

/** Receive one message a sample, as the baseline sends them. */
export function receivePlain(url: string): Ages {
  const ages: number[] = []
  const kept: JointState = jointStateReader.create()
  const socket = new WebSocket(url)
  socket.binaryType = 'arraybuffer'
  socket.onmessage = ({ data }) => {
    const bytes = new Uint8Array(data as ArrayBuffer)
    const stamp = new DataView(bytes.buffer).getFloat64(0, true)
    jointStateReader.decode(bytes, kept, 12)
    ages.push((performance.timeOrigin + performance.now()) / 1000 - stamp)
  }
  return { ages, stop: () => socket.close() }
}
