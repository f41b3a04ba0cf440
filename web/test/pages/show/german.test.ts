// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { translate } from '../../../src/pages/show/german'

test('the fixed words of a page become German, the sentences stay', () => {
  document.body.innerHTML =
    '<p class="verdict"><b>Not accepted</b> <span>joint 1 to 8 rad</span></p><h2>Findings</h2>' +
    '<div class="findings"><button><span>1</span><span><b>error</b> row 315-400 · wrist</span>' +
    '</button><button><span><b>note</b> row 7</span></button></div>'
  translate(document.body)
  expect(document.body.textContent).toBe(
    'Nicht angenommen joint 1 to 8 radBefunde1Fehler Zeilen 315 bis 400 · wristHinweis Zeile 7',
  )
})
