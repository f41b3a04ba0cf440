import { germanSentence } from './session_german'

/** The page's own words; the sentences of converter and report stay as they are. */
const WORDS: Readonly<Record<string, string>> = {
  Accepted: 'Angenommen',
  'Not accepted': 'Nicht angenommen',
  'A choice is needed': 'Eine Wahl ist nötig',
  Findings: 'Befunde',
  error: 'Fehler',
  warning: 'Warnung',
  note: 'Hinweis',
  Angles: 'Winkel',
  Velocities: 'Geschwindigkeiten',
  'Torque proxies (nominal, no torque)': 'Moment-Proxys (nominell, kein Drehmoment)',
  Events: 'Ereignisse',
  Robots: 'Roboter',
  Runs: 'Läufe',
  Run: 'Lauf',
  Robot: 'Roboter',
  Trajectory: 'Trajektorie',
  Began: 'Beginn',
  Took: 'Dauer',
  Result: 'Ergebnis',
  'What it did': 'Was geschah',
  'Way of the tool': 'Weg des Werkzeugs',
  'from above': 'von oben',
  'from the side': 'von der Seite',
  'from the front': 'von vorn',
  begins: 'Anfang',
  ends: 'Ende',
  reference: 'Vorgabe',
  Reference: 'Vorgabe',
  Played: 'Gespielt',
  Fastest: 'Am schnellsten',
  'Nearest limit': 'Nächste Grenze',
  'Largest deviation': 'Größte Abweichung',
  'Tool, at most': 'Werkzeug, höchstens',
  'Without a run': 'Ohne Lauf',
  'holds an object': 'hält einen Gegenstand',
  collision: 'Kollision',
  'joint states': 'Gelenkstellungen',
  'joint states late': 'Gelenkstellungen, verspätet',
  'tracking error': 'Abweichung von der Bahn',
  'all topics': 'alle Topics',
  Technical: 'Technik',
  'deadlines, latency, tracking': 'Fristen, Latenz, Bahntreue',
  Quantity: 'Größe',
  Median: 'Median',
  Marks: 'Bewertung',
  Points: 'Punkte',
  Test: 'Aufgabe',
  Time: 'Zeit',
  Found: 'Gefunden',
  passed: 'erfüllt',
  partly: 'teilweise',
  'not passed': 'nicht erfüllt',
  hidden: 'verdeckt',
  Most: 'Höchstens',
  Ready: 'Bereit',
  'Not ready': 'Nicht bereit',
  refuses: 'spricht dagegen',
  'Ready for hardware': 'Bereit für den echten Roboter',
  ok: 'in Ordnung',
  'not ok': 'nicht in Ordnung',
  'not known': 'nicht bekannt',
  'positions inside their ranges': 'Stellungen in ihren Bereichen',
  'speeds below their limits': 'Geschwindigkeiten unter ihren Grenzen',
  'accelerations below their limits': 'Beschleunigungen unter ihren Grenzen',
  'jerks below their limits': 'Ruck unter seinen Grenzen',
  'begins at rest': 'beginnt in Ruhe',
  'ends at rest': 'endet in Ruhe',
  continuous: 'stetig',
  'no collision': 'keine Kollision',
  Distances: 'Abstände',
  Tool: 'Werkzeug',
  Joints: 'Gelenke',
  'speed of tool0': 'Geschwindigkeit von tool0',
  'conditioning (0: singular)': 'Konditionierung (0: singulär)',
}
/** Words before the name of a robot, such as `Tool of ur5e_1`. */
const BEFORE: Readonly<Record<string, string>> = {
  'Ready for hardware: ': 'Bereit für den echten Roboter: ',
  'Tool of ': 'Werkzeug von ',
  'Joints of ': 'Gelenke von ',
}
/** The states of a robot. */
export const STATES: Readonly<Record<string, string>> = {
  IDLE: 'untätig',
  READY: 'bereit',
  ADJUSTING: 'fährt zum Start',
  PLAYING: 'läuft',
  PAUSED: 'Pause',
  COLLISION_HALT: 'Kollisionshalt',
  COMPLETE: 'fertig',
}
const SEPARATOR = ' \u00b7 '

const PLACES =
  'h2, h3, th, dt, figcaption, .in-bar, .keys span, .others span, .head-word, .technical td, summary span, .verdict b, .findings button b, .path .title, .marks .result span, .marks .test small, .runs .result span, .runs td.robot'

/** Put the fixed words and what a session says of its runs, which are English, into German. */
export function translate(page: HTMLElement): void {
  for (const place of page.querySelectorAll('.said')) {
    const text = place.textContent ?? ''
    const german = germanSentence(text)
    if (german !== text) place.textContent = german
  }
  for (const place of page.querySelectorAll(PLACES)) {
    if (place.childElementCount > 0 && !place.matches('h2, h3')) continue
    const text = place.textContent ?? ''
    const german = WORDS[text] ?? germanState(text) ?? germanParts(text)
    if (german !== text) place.textContent = german
  }
  for (const place of page.querySelectorAll('.findings button b')) {
    const rows = place.nextSibling
    if (rows instanceof Text) rows.data = germanRows(rows.data)
  }
}

/** Return the word for a state that is written as `collision halt`, and `Run 3` as `Lauf 3`. */
function germanState(text: string): string | undefined {
  const [, run] = /^Run (\d+)$/.exec(text) ?? []
  return run === undefined ? STATES[text.toUpperCase().replace(' ', '_')] : `Lauf ${run}`
}

/** Return a text with its first words in German, such as those of `refuses · 0.41 s · elbow`. */
function germanParts(text: string): string {
  for (const [english, german] of Object.entries(BEFORE)) {
    if (text.startsWith(english)) return german + text.slice(english.length)
  }
  const [first = '', ...rest] = text.split(SEPARATOR)
  const german = WORDS[first]
  return german === undefined || rest.length === 0 ? text : [german, ...rest].join(SEPARATOR)
}

/** Return the place of a finding, such as ` row 3-7 · joint`, with its rows in German. */
export function germanRows(text: string): string {
  return text
    .replace(/^(\s*)row (\d+)-(\d+)/, '$1Zeilen $2 bis $3')
    .replace(/^(\s*)row (\d+)/, '$1Zeile $2')
}
