// @vitest-environment jsdom
import { expect, test } from 'vitest'
import {
  Catalogue,
  found,
  idOfPath,
  trajectoryPage,
} from '../../../src/pages/trajectories/catalogue'
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
