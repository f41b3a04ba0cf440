// @vitest-environment jsdom
import { render } from 'preact'
import { act } from 'preact/test-utils'
import { expect, test } from 'vitest'
import type { ClassDocument, ClassStudent } from '../../../src/classroom/class_document'
import { Alike } from '../../../src/classroom/report/alike'

const student = (key: string) =>
  ({
    key,
    name: `${key} <b>`,
    page: `pages/${key}.html`,
    file: 'a.mat',
    points: 4,
    duration: 2,
  }) as unknown as ClassStudent

const GRADED = {
  students: ['a', 'b', 'c', 'd'].map(student),
  similar: {
    threshold: 0.5,
    usual: 20,
    as_reference: 0,
    groups: [
      { keys: ['a', 'c'], apart: 0, equal: true },
      { keys: ['b', 'd'], apart: 0.3, equal: false },
    ],
    paired: ['a', 'c', 'b', 'd'],
    apart: [[], [0], [10, 10], [null, 20, 0.3]],
  },
} as unknown as ClassDocument

const pair = () => document.querySelector('.pair')?.textContent
const cells = () => [...document.querySelectorAll<HTMLButtonElement>('.pairs-grid button')]

test('a press on a pair shows the two side by side; the nearest are shown first', () => {
  act(() => render(<Alike graded={GRADED} />, document.body))
  expect(pair()).toContain('the same file')
  expect(cells().map((each) => each.title)).toEqual([
    'c <b>, a <b>: the same file',
    'b <b>, a <b>: 10° apart',
    'b <b>, c <b>: 10° apart',
    'd <b>, c <b>: 20° apart',
    'd <b>, b <b>: 0.3° apart',
  ])
  const dark = cells().map((each) => Number(each.querySelector('i')?.style.opacity))
  expect(dark).toEqual([1, 0.3, 0.3, 0, 1])
  expect(cells().map((each) => each.tabIndex)).toEqual([0, -1, -1, -1, 0])
  act(() => cells().at(-1)?.click())
  expect(pair()).toContain('0.3° apart')
  const links = [...document.querySelectorAll<HTMLAnchorElement>('.pair a')]
  expect(links.map((each) => each.getAttribute('href'))).toEqual(['pages/d.html', 'pages/b.html'])
  act(() => render(null, document.body))
})
