// @vitest-environment jsdom
import { h } from 'preact'
import { beforeEach, expect, test } from 'vitest'
import type { ShownData } from '../src/report/packed_data'
import { REPORTS } from '../src/reports'
import { showReport } from '../src/show'

const data: ShownData = {
  document: { schema: 'mrlab.calibration.1' },
  meshes: () => Promise.reject(new Error('no mesh')),
}

beforeEach(() => {
  document.body.innerHTML =
    '<div id="report"><div class="poster"><img src="data:," alt="arm"></div>still</div>'
})

test('a report is a row of the table, and gets the pictures of the page', async () => {
  await showReport(data, {
    ...REPORTS,
    'mrlab.calibration.1': (shown, pictures) =>
      h('h1', null, `${shown.document.schema} with ${pictures[0]?.text}`),
  })
  expect(document.getElementById('report')?.innerHTML).toBe(
    '<h1>mrlab.calibration.1 with arm</h1>',
  )
})

test('the text of the page stays where no report draws its schema', async () => {
  await showReport(data, REPORTS)
  expect(document.getElementById('report')?.textContent).toBe('still')
})
