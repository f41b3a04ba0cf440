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

test('the words of a check become German, with those before an instant or a name', () => {
  document.body.innerHTML =
    '<p class="verdict"><b>Not ready</b> <span>at 0.41 s it touches</span></p><div class="findings">' +
    '<button><span><b>refuses · 0.41 s · elbow</b></span></button></div><h2>Tool of ur5e_1</h2>' +
    '<table class="runs"><tr><td class="result"><span>not known</span></td>' +
    '<td class="robot">ends at rest</td><td>ends at rest</td></tr></table>'
  translate(document.body)
  expect(document.body.textContent).toBe(
    'Nicht bereit at 0.41 s it touchesspricht dagegen · 0.41 s · elbowWerkzeug von ur5e_1' +
      'nicht bekanntendet in Ruheends at rest',
  )
})
