/** Many clients in one process, for bench/measures/gateway.py: ages as JSON lines on stdout.
 * Arguments: url, number of clients, s to warm up, s to measure, cookie; without one: the baseline. */

import { type Ages, receiveLink, receivePlain } from './receive'

const [url = '', count = '1', warm = '1', seconds = '5', cookie = ''] = process.argv.slice(2)
const origin = url.replace(/^ws/, 'http').replace(/\/link$/, '')

/** Node's WebSocket takes headers, which a browser sets by itself. */
function open(address: string, protocol: string): WebSocket {
  const options = { protocols: [protocol], headers: { origin, cookie } }
  return new WebSocket(address, options as unknown as string[])
}

const receptions: Ages[] = Array.from({ length: Number(count) }, () =>
  cookie === '' ? receivePlain(url) : receiveLink(url, { open }),
)
setTimeout(() => {
  for (const each of receptions) each.ages.length = 0
  const begun = performance.now()
  console.log('begun')
  setTimeout(() => {
    const elapsed = (performance.now() - begun) / 1000
    const answer = JSON.stringify({ elapsed, clients: receptions.map(({ ages }) => ages) })
    process.stdout.write(`${answer}\n`, () => process.exit(0))
  }, Number(seconds) * 1000)
}, Number(warm) * 1000)
