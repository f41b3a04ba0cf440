import { expect, it } from 'vitest'
import { Ages, tell } from '../../src/room/latency'
import { FakeLink } from '../fake_link'

it('tells the lab how old messages were, each window by itself', () => {
  const link = new FakeLink()
  link.time = 1000.25
  const ages = new Ages()
  for (let i = 1; i <= 100; i++) ages.add(i / 1000)
  ages.add(Number.NaN)
  ages.close()
  tell(link, ages)
  expect(link.published).toMatchObject([
    {
      key: 'latency/clients',
      message: {
        observer: 'room',
        clock_error: 0.0005,
        hops: [{ hop: 2, topic: '', count: 100, p50: 0.051, p95: 0.096, max: 0.1 }],
      },
    },
  ])
  ages.close()
  tell(link, ages)
  expect(link.published, 'nothing came: nothing is said').toHaveLength(1)
})

it('keeps the newest of more than it has room for', () => {
  const ages = new Ages()
  for (let i = 0; i < 3000; i++) ages.add(i)
  ages.close()
  expect(ages.count).toBe(3000)
  expect(ages.most).toBe(2999)
})
