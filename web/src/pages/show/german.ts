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
}
const PLACES =
  'h2, h3, th, summary span, .verdict b, .findings button b, .path .title, .marks .result span, .marks .test small'

/** Put the fixed words of a page, which is written in English, into German. */
export function translate(page: HTMLElement): void {
  for (const place of page.querySelectorAll(PLACES)) {
    const german = WORDS[place.textContent ?? '']
    if (german !== undefined) place.textContent = german
  }
  for (const place of page.querySelectorAll('.findings button b')) {
    const rows = place.nextSibling
    if (rows instanceof Text) rows.data = germanRows(rows.data)
  }
}

/** Return the place of a finding, such as ` row 3-7 · joint`, with its rows in German. */
export function germanRows(text: string): string {
  return text
    .replace(/^(\s*)row (\d+)-(\d+)/, '$1Zeilen $2 bis $3')
    .replace(/^(\s*)row (\d+)/, '$1Zeile $2')
}
