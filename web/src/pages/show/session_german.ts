/** What the report of a session says in sentences of its own, in German; `report_text.py`,
 * `runs.py` and `run_finding.py` write them in English. */

type Rule = readonly [RegExp, string]

const OUTCOMES: readonly Rule[] = [
  [/^completed/, 'vollständig'],
  [/^stopped/, 'gestoppt'],
  [/^halted by a collision/, 'durch eine Kollision angehalten'],
  [/^still going on/, 'lief noch'],
  [/, (\d+) times/, ', $1-mal'],
  [/ after a collision/, ' nach einer Kollision'],
  [/ at ([\d.]+) of ([\d.]+) s/, ' bei $1 von $2 s'],
  [/ when the recording ended$/, ', als die Aufnahme endete'],
]
const ACTIONS: readonly Rule[] = [
  [/^grasped (.+)$/, '$1 gegriffen'],
  [/^(released|lost) (\S+) at its programmed place, at (.+)$/, '$1 $2 am programmierten Ort, $3'],
  [
    /^(released|lost) (\S+) (\d+) mm from its programmed place, at (.+)$/,
    '$1 $2 $3 mm neben dem programmierten Ort, $4',
  ],
  [/^(released|lost) (\S+) at (.+)$/, '$1 $2 bei $3'],
  [/^released (\S+)/, '$1 losgelassen:'],
  [/^lost (\S+)/, '$1 verloren:'],
  [/ (losgelassen|verloren):$/, ' $1'],
  [/^handed (\S+) to (.+)$/, '$1 an $2 übergeben'],
  [/^hit (.+) with (\S+) at frame (\d+)$/, 'mit $2 an $1 gestoßen, Bild $3'],
  [/^closed the gripper on nothing$/, 'den Greifer um nichts geschlossen'],
  [/^begins (.+)$/, 'beginnt $1'],
]
const SEAL = 'der Sauger dichtet nicht'
/** What physics remarks; `grippers.py`, `holding.py`, `grasp_load.py` and `seal.py` write it. */
const REMARKS: readonly Rule[] = [
  [/^(\S+) is wider than the gripper opens$/, '$1 ist breiter, als der Greifer öffnet'],
  [/^the cup touches (\S+) with its side$/, 'der Sauger berührt $1 mit seiner Seite'],
  [
    /^the cup does not seal: (\d+) % of its lip is on (\S+); an edge, a hole or a rim lies under it$/,
    `${SEAL}: $1 % seiner Lippe liegen auf $2; unter ihr ist eine Kante, ein Loch oder ein Rand`,
  ],
  [
    /^the cup does not seal: (\S+) is tilted by (\d+) degrees to it; (\d+) at most$/,
    `${SEAL}: $1 steht um $2 Grad schräg zu ihm; höchstens $3 dürfen es sein`,
  ],
  [
    /^the cup does not seal: (\S+) is too curved under its lip$/,
    `${SEAL}: $1 ist unter seiner Lippe zu stark gewölbt`,
  ],
  [
    /^it slips: holding (\S+ kg) needs a friction of ([\d.]+|inf), there is ([\d.]+)$/,
    'es rutscht: $1 zu halten braucht eine Reibung von $2, hier ist sie $3',
  ],
  [
    /^(\S+ kg) is more than the (\S+ kg) that (\S+) may carry with this end effector$/,
    '$1 sind mehr als die $2, die $3 mit diesem Endeffektor tragen darf',
  ],
  [
    /^(\S+) came off the cup: (\S+ kg), friction ([\d.]+), needed ([\d.]+|inf)$/,
    '$1 hat sich vom Sauger gelöst: $2, Reibung $3, nötig $4',
  ],
  [
    /^(\S+) slipped out of the fingers: (\S+ kg), friction ([\d.]+), needed ([\d.]+|inf)$/,
    '$1 ist aus den Fingern gerutscht: $2, Reibung $3, nötig $4',
  ],
]
/** What is wrong with a bag; `metadata.py`, `mcap_file.py` and `session.py` write it. */
const TROUBLES: readonly Rule[] = [
  [
    /^([\d.]+ s) are missing from ([\d.]+ s) on: the recorder was restarted$/,
    'ab $2 fehlen $1: die Aufnahme brach ab und wurde fortgesetzt',
  ],
  [
    /^some time is missing from ([\d.]+ s) on: the recorder was restarted$/,
    'ab $1 fehlt etwas: die Aufnahme brach ab und wurde fortgesetzt',
  ],
  [
    /^at ([\d.]+ s) the clock was set back by ([\d.]+ s); the times of this report go on evenly$/,
    'bei $1 wurde die Uhr um $2 zurückgestellt; die Zeiten dieses Berichts laufen gleichmäßig weiter',
  ],
  [
    /^(\S+) has no index: its writer was killed or lost its disk$/,
    '$1 hat keinen Index: die Aufnahme brach ab',
  ],
  [
    /^(\S+) ends before its first record: its writer was killed$/,
    '$1 endet vor dem ersten Eintrag: die Aufnahme brach ab',
  ],
  [/^(\S+) is damaged at byte (\d+)/, '$1 ist bei Byte $2 beschädigt'],
  [
    /^1 message of (\S+) cannot be read and is left out$/,
    '1 Nachricht von $1 ist nicht lesbar und fehlt hier',
  ],
  [
    /^(\d+) messages of (\S+) cannot be read and are left out$/,
    '$1 Nachrichten von $2 sind nicht lesbar und fehlen hier',
  ],
  [/^nothing was recorded in it$/, 'es wurde nichts darin aufgenommen'],
  [/^no robot of a lab is in it, but (.+)$/, 'kein Roboter eines Labors ist darin, sondern $1'],
  [/^(kein Roboter eines Labors .+) and (\d+) more(;|$)/, '$1 und $2 weitere$3'],
  [
    /; mrlab bag import makes a session of it by the joints' names$/,
    '; mrlab bag import macht nach den Namen der Gelenke eine Aufnahme des Labors daraus',
  ],
]
const FIGURES: readonly Rule[] = [
  [
    /^([\d.e-]+ kg), friction ([\d.]+), needed ([\d.]+), (.+) at the wrist$/,
    '$1, Reibung $2, nötig $3, $4 am Handgelenk',
  ],
]
const REFERENCES: readonly Rule[] = [
  [/^followed (.+) exactly$/, 'folgte $1 genau'],
  [
    /^up to (.+) from (.+) \((\S+) at ([^)]+)\)(?:, the tool ([\d.]+ mm))?$/,
    'bis zu $1 neben $2 ($3 bei $4), das Werkzeug $5',
  ],
  [/, das Werkzeug $/, ''],
  [/ deg neben /, '° neben '],
]
const SUMMARY: readonly Rule[] = [
  [/\b1 robot\b/, '1 Roboter'],
  [/\b(\d+) robots\b/, '$1 Roboter'],
  [/\b1 run\b/, '1 Lauf'],
  [/\b(\d+) runs\b/, '$1 Läufe'],
  [/\b(\d+) completed\b/, '$1 vollständig'],
  [/\b1 collision\b/, '1 Kollision'],
  [/\b(\d+) collisions\b/, '$1 Kollisionen'],
]
const WHOLE: readonly Rule[] = [
  [/^No robot played\.$/, 'Kein Roboter hat gespielt.'],
  [
    /^The first (\d+) of (\d+) runs are drawn; report\.json has all\.$/,
    'Die ersten $1 von $2 Läufen sind gezeichnet; report.json hat alle.',
  ],
  [
    /^(\d+) more events are in the table of runs\.$/,
    '$1 weitere Ereignisse stehen in der Tabelle der Läufe.',
  ],
  [
    /^it is being recorded; this is what it holds so far$/,
    'wird noch aufgenommen; dies ist der Stand bis jetzt',
  ],
]
const SENTENCES: readonly Rule[] = [
  ...WHOLE,
  ...TROUBLES,
  ...REMARKS,
  ...ACTIONS,
  ...FIGURES,
  ...REFERENCES,
]
const OUTCOME = /^(completed|stopped|halted by|still going)/

/** Return a sentence of a session's report in German; one that is not known stays. */
export function germanSentence(text: string): string {
  if (OUTCOME.test(text)) return applied(OUTCOMES, text)
  const [, name, outcome = ''] = /^(\S+): (.+)$/.exec(text) ?? []
  if (OUTCOME.test(outcome)) return `${name}: ${applied(OUTCOMES, outcome)}`
  if (/^[\d:.]+ (s|min|h), \d+ robot/.test(text)) return applied(SUMMARY, text)
  return applied(SENTENCES, text)
}

function applied(rules: readonly Rule[], text: string): string {
  return rules.reduce((said, [english, german]) => said.replace(english, german), text)
}
