/** The words of the 3D view; the pages give those of the person's language. */
export interface SceneWords {
  readonly view: string
  readonly play: string
  readonly pause: string
  readonly time: string
  readonly speed: string
  readonly ghosts: string
  readonly compared: string
  readonly path: string
  readonly start: string
  readonly end: string
  readonly loading: (here: number, count: number) => string
  readonly noWebGL: string
  readonly missing: (names: string) => string
  readonly at: (time: string, row: number) => string
  readonly gripper: { readonly open: string; readonly closed: string }
}

export const ENGLISH: SceneWords = {
  view: 'The robot in 3D. Arrow keys turn the view, plus and minus zoom, 0 shows all.',
  play: 'Play',
  pause: 'Pause',
  time: 'Time',
  speed: 'Speed',
  ghosts: 'First and last pose',
  compared: 'The other motion',
  path: 'Tool path',
  start: 'start',
  end: 'end',
  loading: (here, count) => `Loading the robot, ${here} of ${count} parts`,
  noWebGL:
    'This browser cannot draw in 3D (WebGL 2 is off or missing); the plots and findings are complete.',
  missing: (names) => `A box stands for each part of the robot that is missing: ${names}`,
  at: (time, row) => `${time} s, row ${row}`,
  gripper: { open: 'gripper open', closed: 'gripper closed' },
}

export const GERMAN: SceneWords = {
  view: 'Der Roboter in 3D. Pfeiltasten drehen die Ansicht, Plus und Minus zoomen, 0 zeigt alles.',
  play: 'Abspielen',
  pause: 'Anhalten',
  time: 'Zeit',
  speed: 'Tempo',
  ghosts: 'Erste und letzte Stellung',
  compared: 'Die andere Bewegung',
  path: 'Werkzeugbahn',
  start: 'Anfang',
  end: 'Ende',
  loading: (here, count) => `Der Roboter wird geladen, ${here} von ${count} Teilen`,
  noWebGL:
    'Dieser Browser zeichnet nicht in 3D (WebGL 2 ist aus oder fehlt); Kurven und Befunde sind vollständig.',
  missing: (names) => `Ein Kasten steht für jedes fehlende Teil des Roboters: ${names}`,
  at: (time, row) => `${time} s, Zeile ${row}`,
  gripper: { open: 'Greifer offen', closed: 'Greifer zu' },
}
