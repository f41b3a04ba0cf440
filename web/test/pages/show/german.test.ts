// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { translate } from '../../../src/pages/show/german'
import { germanSentence } from '../../../src/pages/show/session_german'

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

test.each([
  ['completed', 'vollständig'],
  ['completed, 2 times after a collision', 'vollständig, 2-mal nach einer Kollision'],
  [
    'stopped after a collision at 0.26 of 6.00 s',
    'gestoppt nach einer Kollision bei 0.26 von 6.00 s',
  ],
  [
    'halted by a collision at 2.00 of 8.00 s when the recording ended',
    'durch eine Kollision angehalten bei 2.00 von 8.00 s, als die Aufnahme endete',
  ],
  ['wave: completed', 'wave: vollständig'],
  ['begins wave', 'beginnt wave'],
  ['grasped cube_1', 'cube_1 gegriffen'],
  ['handed rod_1 to kuka_1', 'rod_1 an kuka_1 übergeben'],
  [
    'released cube_1 30 mm from its programmed place, at 1.530, 0.000, 0.000 m',
    'cube_1 losgelassen: 30 mm neben dem programmierten Ort, 1.530, 0.000, 0.000 m',
  ],
  ['lost cube_1 at 1.5, 0, 0 m', 'cube_1 verloren: bei 1.5, 0, 0 m'],
  ['released cube_1', 'cube_1 losgelassen'],
  [
    'hit pillar_1 with gripper_base_link at frame 25',
    'mit gripper_base_link an pillar_1 gestoßen, Bild 25',
  ],
  [
    'up to 8.59 deg from teacher.mat (wrist_2_joint at 5.02 s), the tool 43.7 mm',
    'bis zu 8.59° neben teacher.mat (wrist_2_joint bei 5.02 s), das Werkzeug 43.7 mm',
  ],
  ['followed wave exactly', 'folgte wave genau'],
  [
    '50.4 s, 2 robots, 1 run, 1 completed, 3 collisions',
    '50.4 s, 2 Roboter, 1 Lauf, 1 vollständig, 3 Kollisionen',
  ],
  ['cube_1 is wider than the gripper opens', 'cube_1 ist breiter, als der Greifer öffnet'],
  ['the cup touches box_1 with its side', 'der Sauger berührt box_1 mit seiner Seite'],
  [
    'the cup does not seal: 42 % of its lip is on box_1; an edge, a hole or a rim lies under it',
    'der Sauger dichtet nicht: 42 % seiner Lippe liegen auf box_1; unter ihr ist eine Kante, ein ' +
      'Loch oder ein Rand',
  ],
  [
    'the cup does not seal: box_1 is tilted by 14 degrees to it; 10 at most',
    'der Sauger dichtet nicht: box_1 steht um 14 Grad schräg zu ihm; höchstens 10 dürfen es sein',
  ],
  [
    'the cup does not seal: ball_1 is too curved under its lip',
    'der Sauger dichtet nicht: ball_1 ist unter seiner Lippe zu stark gewölbt',
  ],
  [
    'it slips: holding 2.5 kg needs a friction of 1.20, there is 0.90',
    'es rutscht: 2.5 kg zu halten braucht eine Reibung von 1.20, hier ist sie 0.90',
  ],
  [
    '7.5 kg is more than the 5 kg that ur5e_1 may carry with this end effector',
    '7.5 kg sind mehr als die 5 kg, die ur5e_1 mit diesem Endeffektor tragen darf',
  ],
  [
    'cube_1 slipped out of the fingers: 2.5 kg, friction 0.90, needed 1.20',
    'cube_1 ist aus den Fingern gerutscht: 2.5 kg, Reibung 0.90, nötig 1.20',
  ],
  [
    'box_1 came off the cup: 2.5 kg, friction 0.90, needed 1.20',
    'box_1 hat sich vom Sauger gelöst: 2.5 kg, Reibung 0.90, nötig 1.20',
  ],
  [
    '3.7 s are missing from 63.2 s on: the recorder was restarted',
    'ab 63.2 s fehlen 3.7 s: die Aufnahme brach ab und wurde fortgesetzt',
  ],
  [
    'at 3.46 s the clock was set back by 3600.0 s; the times of this report go on evenly',
    'bei 3.46 s wurde die Uhr um 3600.0 s zurückgestellt; die Zeiten dieses Berichts laufen ' +
      'gleichmäßig weiter',
  ],
  [
    'class_1.mcap ends before its first record: its writer was killed',
    'class_1.mcap endet vor dem ersten Eintrag: die Aufnahme brach ab',
  ],
  ['class_1.mcap is damaged at byte 97 (zstd)', 'class_1.mcap ist bei Byte 97 beschädigt (zstd)'],
  [
    '1 message of /a/state cannot be read and is left out',
    '1 Nachricht von /a/state ist nicht lesbar und fehlt hier',
  ],
  [
    '20 messages of /a/state cannot be read and are left out',
    '20 Nachrichten von /a/state sind nicht lesbar und fehlen hier',
  ],
  ['nothing was recorded in it', 'es wurde nichts darin aufgenommen'],
  [
    'no robot of a lab is in it, but /tf (tf2_msgs/msg/TFMessage)',
    'kein Roboter eines Labors ist darin, sondern /tf (tf2_msgs/msg/TFMessage)',
  ],
  [
    'no robot of a lab is in it, but /a (b/msg/C), /joint_states (sensor_msgs/msg/JointState) and ' +
      "3 more; mrlab bag import makes a session of it by the joints' names",
    'kein Roboter eines Labors ist darin, sondern /a (b/msg/C), /joint_states ' +
      '(sensor_msgs/msg/JointState) und 3 weitere; mrlab bag import macht nach den Namen der ' +
      'Gelenke eine Aufnahme des Labors daraus',
  ],
  ['ur5e_1 was busy', 'ur5e_1 was busy'],
])('what a session says becomes German: %s', (english, german) => {
  expect(germanSentence(english)).toBe(german)
})

test('a page of a session is German, with its states', () => {
  document.body.innerHTML =
    '<h2>Run 3</h2><h3>joint_1 <small>-1 ... 1</small></h3><p class="keys"><span><i></i>' +
    '<span>collision halt</span></span></p><svg><text class="in-bar">ready</text></svg>' +
    '<span class="said">completed</span><dl><dt>Nearest limit</dt><dd>Reference</dd></dl>'
  translate(document.body)
  expect(document.body.textContent).toBe(
    'Lauf 3joint_1 -1 ... 1Kollisionshaltbereitvollständig' + 'Nächste GrenzeReference',
  )
})
