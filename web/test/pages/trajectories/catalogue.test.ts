// @vitest-environment jsdom
import { expect, test, vi } from 'vitest'
import type { Listing } from '../../../src/api/types'
import {
  Catalogue,
  found,
  idOfPath,
  trajectoryPage,
} from '../../../src/pages/trajectories/catalogue'
import { audience } from '../../../src/pages/trajectories/list'
import { FakeApi, trajectory } from '../../fake_api'

const ALL = [
  trajectory({ id: 'quintic', created: 1 }),
  trajectory({ id: 'ada/wave', owner: 'ada', created: 3, source_file: 'hand.mat' }),
  trajectory({
    id: 'grace/spiral',
    owner: 'grace',
    created: 2,
    robot_model: 'kuka_kr6_r900_sixx',
  }),
]

test('the newest comes first', () => {
  expect(found(ALL, '', 'all', 'ada').map((each) => each.id)).toEqual([
    'ada/wave',
    'grace/spiral',
    'quintic',
  ])
})

test.each([
  ['KR6', ['grace/spiral']],
  ['grace spi', ['grace/spiral']],
  ['hand.mat', ['ada/wave']],
  ['nothing', []],
])('a search for %s', (text, ids) => {
  expect(found(ALL, text, 'all', 'ada').map((each) => each.id)).toEqual(ids)
})

test('mine and those of others', () => {
  expect(found(ALL, '', 'mine', 'ada').map((each) => each.id)).toEqual(['ada/wave'])
  expect(found(ALL, '', 'shared', 'ada').map((each) => each.id)).toEqual([
    'grace/spiral',
    'quintic',
  ])
})

test.each(['quintic', 'ada/wave', 'ada/50 %', 'a/b?c#d'])(
  'the page of %s leads back to it',
  (id) => {
    const { pathname } = new URL(trajectoryPage(id), 'http://lab')
    expect(idOfPath(pathname)).toBe(id)
  },
)

test('what is deleted comes back', async () => {
  const catalogue = new Catalogue(new FakeApi(), 'ada')
  await catalogue.load()
  const count = catalogue.found.value.length
  catalogue.toggle('ada/wave')
  await catalogue.remove('ada/wave')
  expect(catalogue.found.value).toHaveLength(count - 1)
  expect(catalogue.chosen.value).toEqual([])
  await catalogue.restore('ada/wave', 0)
  expect(catalogue.found.value).toHaveLength(count)
})

test('two at most are compared, the last ones chosen', () => {
  const catalogue = new Catalogue(new FakeApi(), 'ada')
  for (const id of ['a', 'b', 'c']) catalogue.toggle(id)
  expect(catalogue.chosen.value).toEqual(['b', 'c'])
  catalogue.toggle('b')
  expect(catalogue.chosen.value).toEqual(['c'])
})

test('a list that was asked for before something was deleted here does not bring it back', async () => {
  const api = new FakeApi()
  const catalogue = new Catalogue(api, 'ada')
  await catalogue.load()
  const before = catalogue.all.value ?? []
  let answer = (_all: Listing) => {}
  api.trajectories = () =>
    new Promise((resolve) => {
      answer = resolve
    })
  const loading = catalogue.load()
  await catalogue.remove('ada/wave')
  answer({ trajectories: before, problem: null })
  await loading
  expect(catalogue.all.value?.some((each) => each.id === 'ada/wave')).toBe(false)
})

test('what others delete goes within seconds, and the list stays itself where nothing changed', async () => {
  vi.useFakeTimers()
  const api = new FakeApi()
  const catalogue = new Catalogue(api, 'ada')
  const stop = catalogue.follow()
  await vi.advanceTimersByTimeAsync(100)
  const first = catalogue.all.value
  expect(first?.length).toBeGreaterThan(1)
  await vi.advanceTimersByTimeAsync(10_000)
  expect(catalogue.all.value).toBe(first)
  api.trajectories = () => Promise.resolve({ trajectories: (first ?? []).slice(1), problem: null })
  await vi.advanceTimersByTimeAsync(6000)
  expect(catalogue.all.value?.length).toBe((first?.length ?? 0) - 1)
  stop()
  expect(vi.getTimerCount()).toBe(0)
  vi.useRealTimers()
})

test.each([
  ['ada', 'only for you'],
  ['grace', 'only for ada'],
])('for %s a private one of ada is %s', (user, words) => {
  expect(audience(trajectory({ id: 'ada/wave', owner: 'ada', shared: false }), user)).toBe(words)
})

test('only a motion of the same robot is offered for a comparison', () => {
  const catalogue = new Catalogue(new FakeApi(), 'ada')
  catalogue.all.value = ALL
  const [quintic, , spiral] = ALL as [(typeof ALL)[0], unknown, (typeof ALL)[0]]
  expect(catalogue.comparable(spiral)).toBe(true)
  catalogue.toggle(quintic.id)
  expect(catalogue.comparable(spiral)).toBe(false)
  expect(catalogue.comparable(quintic)).toBe(true)
})
