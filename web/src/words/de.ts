import type { Words } from './en'
import type { Templates } from './words'

export const words: Words = {
  names: {
    local: 'lokal',
    centric_gripper: 'Dreifinger\u00adgreifer',
    holding_magnet: 'Haft\u00admagnet',
    parallel_gripper: 'Parallel\u00adgreifer',
    vacuum_cup: 'Vakuum\u00adsauger',
    cube: 'Würfel',
    cube_small: 'kleiner Würfel',
    cube_large: 'großer Würfel',
    block: 'Block',
    brick: 'Ziegel',
    carton: 'Karton',
    plate: 'Platte',
    cylinder: 'Zylinder',
    rod: 'Stab',
    disc: 'Scheibe',
    pillar: 'Säule',
    sphere: 'Kugel',
    ball: 'Ball',
    bottle: 'Flasche',
    can: 'Dose',
    cup: 'Becher',
    peg: 'Zapfen',
    hole: 'Lochplatte',
    bin: 'Behälter',
    conveyor: 'Förderband',
    crate: 'Kiste',
    fixture: 'Vorrichtung',
    pallet: 'Palette',
    pedestal: 'Podest',
    table: 'Tisch',
    wall: 'Wand',
    empty: 'leere Szene',
    forearm_link: 'Unterarm',
    upper_arm_link: 'Oberarm',
    shoulder_pan_joint: 'Sockel',
    shoulder_lift_joint: 'Schulter',
    elbow_joint: 'Ellbogen',
    wrist_1_joint: 'Handgelenk 1',
    wrist_2_joint: 'Handgelenk 2',
    wrist_3_joint: 'Handgelenk 3',
    handover: 'Übergabe',
    obstacle_course: 'Hindernisse',
    pick_and_place: 'Greifen und Ablegen',
  },
  close: 'Schließen',
  cancel: 'Abbrechen',
  undo: 'Rückgängig',
  copy: 'Kopieren',
  copied: 'Kopiert',
  loading: 'Wird geladen …',
  retry: 'Noch einmal versuchen',
  yes: 'Ja',
  noAnswer: 'Das Labor antwortet nicht. Prüfe, ob es läuft und ob du in seinem Netz bist.',
  joining: {
    and: 'und',
    or: 'oder',
    row: 'Zeile',
    rows: (first, last) => `Zeilen ${first} bis ${last}`,
    states: {
      IDLE: 'untätig',
      READY: 'bereit',
      ADJUSTING: 'fährt zum Start',
      STAGING: 'fährt zum Start',
      PLAYING: 'läuft',
      PAUSED: 'Pause',
      COLLISION_HALT: 'Kollisionshalt',
      COMPLETE: 'fertig',
      STOPPING: 'stoppt',
      STOPPED: 'gestoppt',
      RECORDING: 'nimmt auf',
      PREPARING: 'bereitet vor',
      REPLAYING: 'gibt wieder',
    },
  },
  scene: {
    view: 'Der Roboter in 3D. Pfeiltasten drehen die Ansicht, Plus und Minus zoomen, 0 zeigt alles.',
    play: 'Abspielen',
    pause: 'Anhalten',
    time: 'Zeit',
    speed: 'Tempo',
    ghosts: 'Erste und letzte Stellung',
    show: 'Anzeigen',
    path: 'Werkzeugbahn',
    start: 'Anfang',
    end: 'Ende',
    loading: (here, count) => `Der Roboter wird geladen, ${here} von ${count} Teilen`,
    noWebGL:
      'Dieser Browser zeichnet nicht in 3D (WebGL 2 ist aus oder fehlt); Kurven und Befunde sind vollständig.',
    missing: (names) => `Ein Kasten steht für jedes fehlende Teil des Roboters: ${names}`,
    at: (time, row) => `${time} s, Zeile ${row}`,
    gripper: { open: 'Greifer offen', closed: 'Greifer zu' },
  },
  link: {
    closed: 'Die Seite hat ihre Verbindung geschlossen.',
    answerLost:
      'Die Verbindung ging verloren, bevor die Antwort kam. Sieh nach, dann noch einmal.',
    silent: (seconds) => `Das Gateway hat seit ${seconds} s nichts gesendet.`,
    unreadable: (why) => `Das Gateway sandte, was diese Seite nicht lesen kann: ${why}`,
    labAway: 'Das Gateway ist da, das Labor nicht: Vielleicht startet es gerade.',
    gone: 'Das Gateway ist weg oder nicht erreichbar.',
    timeout: (service, seconds) => `${service} hat nicht innerhalb von ${seconds} s geantwortet.`,
  },
  states: {
    IDLE: 'untätig',
    READY: 'bereit',
    ADJUSTING: 'fährt zum Start',
    PLAYING: 'läuft',
    PAUSED: 'Pause',
    COLLISION_HALT: 'Kollisionshalt',
    COMPLETE: 'fertig',
  },
  outcomes: { accepted: 'angenommen', rejected: 'abgelehnt', ambiguous: 'deine Wahl' },
  severities: { error: 'Fehler', warning: 'Warnung', info: 'Hinweis' },
  roles: {
    student: 'Studierende',
    instructor: 'Lehrende',
    operator: 'Betrieb',
    display: 'Anzeige',
  },
  nav: {
    main: 'Hauptmenü',
    upload: 'Hochladen',
    trajectories: 'Trajektorien',
    lab: 'Labor',
    room: 'Raum',
    grades: 'Klasse',
    people: 'Personen',
    pair: 'Headset koppeln',
    signIn: 'Anmelden',
    signOut: 'Abmelden',
    language: 'Sprache',
    appearance: 'Darstellung',
    light: 'Hell',
    dark: 'Dunkel',
    skip: 'Zur Seite springen',
    account: 'Konto',
  },
  notFound: { title: 'Diese Seite gibt es nicht', back: 'Zur Upload-Seite' },
  crashed: {
    title: 'Diese Seite konnte nicht gezeigt werden',
    remedy: 'Lade sie neu. Hilft das nicht, melde, was du getan hast und was hier steht:',
    reload: 'Neu laden',
  },
  copyLink: 'Link kopieren',
  qrCode: (url) => `QR-Code von ${url}`,
  plots: {
    title: 'Kurven',
    channels: {
      angles: 'Winkel',
      velocities: 'Geschwindigkeiten',
      proxies: 'Ersatzmomente',
      difference: 'Unterschied',
    },
    proxyNote: 'Nominelle Werte zur Anzeige: eine Ersatzgröße, kein Drehmoment.',
    at: (time, row) => `${time} s · Zeile ${row}`,
    joint: (number) => `Gelenk ${number}`,
    unfold: (count) => `Alle ${count} Gelenke zeigen`,
    fold: 'Nur dieses Gelenk zeigen',
    from: (low, high, unit) => `von ${low} bis ${high} ${unit}`,
    between: (low, high) => `, erlaubt von ${low} bis ${high}`,
    noScene: 'Die 3D-Ansicht konnte nicht geladen werden; Kurven und Befunde sind vollständig.',
  },
  report: {
    madeBy: 'erstellt von MR-Lab',
    view: '3D-Ansicht',
    fits: (file, robot) => `${file} passt zum ${robot}`,
    with: (robot, effector) => `${robot} mit ${effector}`,
    of: (variable, file) => `${variable} aus ${file}`,
    class: {
      checked: (marked, count) => `${marked} von ${count} geprüft`,
      average: (mean, median, of) => `Mittel ${mean}, Median ${median} von ${of} Punkten`,
      full: (count) => `${count} mit allen`,
      fromFolder: 'aus einem Ordner gelesen',
      fromExport: (system) => `aus einem Export von ${system} gelesen`,
      referenceGets: (points, of) =>
        `Die Musterlösung selbst bekommt ${points} von ${of} Punkten.`,
      claim: 'Punkte sagen, was ein Modell zeigt; sieh jede Bewegung an, bevor du entscheidest.',
      histogram: (counts) => `Studierende nach Zehnteln der Punkte: ${counts}`,
      lost: 'Wo Punkte verloren gingen',
      nobodyLost: 'Niemand hat einen Punkt verloren.',
      commonest: 'Die häufigsten Befunde, je mit einem Beispiel',
      nothingFound: 'Keine Prüfung hat etwas gefunden.',
      students: 'Studierende',
      student: 'Studierende',
      motion: 'Bewegung',
      search: 'Suchen',
      show: 'Zeigen',
      filters: {
        '': 'alle',
        lost: 'mit verlorenen Punkten',
        unchecked: 'nicht geprüft',
        late: 'verspätet',
        alike: 'fast gleich',
      },
      states: { passed: 'erfüllt', partly: 'zum Teil', lost: 'verfehlt', none: 'nicht geprüft' },
      shown: (count, all) => `${count} von ${all}`,
      more: (count) => `Mehr zeigen, ${count} fehlen noch`,
      reference: 'Musterlösung',
      late: 'verspätet',
      leftOut: (count) => `Ausgelassene Dateien: ${count}`,
      unmatched: (count) => `Nicht zugeordnet: ${count}`,
      proposal: (name) => `Am ähnlichsten: ${name}`,
      alike: 'Fast gleich',
      nobodyAlike: 'Keine zwei sind fast gleich.',
      sameFile: 'dieselbe Datei',
      apart: (degrees) => `höchstens ${degrees}° entfernt`,
      pairs: 'Dunkler ist ähnlicher. Ein Klick zeigt zwei nebeneinander.',
      pairApart: (degrees) => `${degrees}° entfernt`,
      pairFigures: (points, seconds) => `${points} Punkte, ${seconds} s`,
      andMore: (count) => `und ${count} weitere`,
      andMoreGroups: (count) => `und ${count} weitere Gruppen`,
      howAlike: (threshold, usual) =>
        `Gelenkwinkel bei gleichen Anteilen des Weges, gleich wie schnell; nah ist unter ${threshold}° RMS${usual ? `, wo zwei dieser Klasse meist ${usual}° entfernt sind` : ''}. Dass zwei Bewegungen ähnlich sind, sagt nicht, wie es dazu kam.`,
      asReference: (count) =>
        count === 1
          ? 'Eine ist wie die Musterlösung und wird nicht als ähnlich gezeigt.'
          : `${count} sind wie die Musterlösung und werden nicht als ähnlich gezeigt.`,
    },
    distances: 'Abstände',
    distance: (part, other) => `${part} zu ${other}`,
    itsOwn: (link) => `eigenem ${link}`,
    linkOf: (link, robot) => `${link} von ${robot}`,
    tool: 'Werkzeug',
    joints: 'Gelenke',
    toolSpeed: 'Geschwindigkeit des Werkzeugs',
    conditioning: 'Konditionierung (0: singulär)',
    hardware: 'Bereit für den echten Roboter',
    states: { ok: 'in Ordnung', not: 'nicht in Ordnung', unknown: 'nicht bekannt' },
    results: { ok: 'erfüllt', not: 'nicht erfüllt', unknown: 'teilweise' },
    points: (points, of) => `${points} von ${of} Punkten`,
    pointsHead: 'Punkte',
    test: 'Aufgabe',
    time: 'Zeit',
    found: 'Gefunden',
    hidden: 'verdeckt',
    hash: (hash) => `Bericht ${hash}`,
    robot: 'Roboter',
    robots: 'Roboter',
    events: 'Ereignisse',
    morePrinted: (count) => `und ${count} weitere, auf der Seite`,
    moreEvents: (count) => `${count} weitere stehen in der Tabelle der Läufe.`,
    runs: 'Läufe',
    runOf: (run) => `Lauf ${run}`,
    toRun: (run) => `Lauf ${run}, zu seinem Anfang`,
    noRun: 'Kein Roboter hat etwas abgespielt.',
    trajectory: 'Trajektorie',
    began: 'Beginn',
    took: 'Dauer',
    result: 'Ergebnis',
    done: 'Was geschah',
    statesOf: (robot) => `Zustände von ${robot} über der Zeit`,
    withoutRun: (robots) => `Ohne Lauf: ${robots}`,
    touches: (link, other) => `${link} berührt ${other}`,
    holding: 'hält einen Gegenstand',
    collision: 'Kollision',
    way: 'Weg des Werkzeugs',
    wayFrom: (view) => `Weg des Werkzeugs ${view}, in Metern`,
    views: { above: 'von oben', side: 'von der Seite', front: 'von vorn' },
    begins: 'Anfang',
    ends: 'Ende',
    reference: 'Vorgabe',
    played: 'Gespielt',
    fastest: 'Am schnellsten',
    nearestLimit: 'Nächste Grenze',
    deviation: 'Größte Abweichung',
    deviationOfTool: 'Werkzeug, höchstens',
    technical: 'Technik',
    technicalNote: 'Fristen, Latenz, Bahntreue',
    quantity: 'Größe',
    median: 'Median',
    most: 'Höchstens',
    allTopics: 'alle Topics',
    jointStates: 'Gelenkstellungen',
    counts: (states, lost, contacts) =>
      `${states} aufgezeichnet, ${lost} Bilder ausgelassen, ${contacts} Kontakte`,
    quantities: {
      deadline: 'Gelenkstellungen, verspätet',
      tracking: 'Abweichung von der Bahn',
      latency: 'Latenz',
    },
    hop: (ends, observer) => (observer ? `${ends}, gesehen von ${observer}` : ends),
    hops: {
      published_to_bridged: 'von der Quelle zur Brücke',
      bridged_to_received: 'von der Brücke zum Empfänger',
      published_to_received: 'von der Quelle zum Empfänger',
    },
  },
  upload: {
    title: 'Sieh deine MATLAB-Bewegung an einem Roboter',
    touching: 'Wird geprüft: was der Roboter berührt …',
    touchesNothing: 'Allein auf einem Boden berührt der Roboter nichts.',
    subtitle:
      'Lege die Workspace-Datei mit deinen Gelenkwinkeln ab. Sie wird gelesen, am Roboter geprüft und gezeigt; veröffentlicht wird erst, wenn du es sagst.',
    drop: 'Lege eine .mat-Datei hier ab',
    dropHere: 'Loslassen, um die Datei zu lesen',
    formats: 'MATLAB v4 bis v7.3, CSV, NumPy oder ein Bag mit einer JointTrajectory',
    chooseFile: 'Datei wählen',
    tryExample: 'Beispiel ausprobieren',
    onlyFirst: (name) => `Eine Datei nach der anderen: ${name} wurde genommen.`,
    kept: (name) => `${name} und deine Auswahl bleiben erhalten.`,
    stages: {
      sending: (percent) => `Wird gesendet, ${percent} %`,
      converting: 'Wird gelesen und geprüft …',
      loading: 'Die Bewegung wird geladen …',
    },
    stageNames: { sending: 'Senden', converting: 'Lesen und prüfen', loading: 'Zeigen' },
    joints: 'Gelenke',
    jointCount: (count) => `${count} Gelenke`,
    reach: (metres, kilograms) => `${metres} m · ${kilograms} kg`,
    robot: 'Roboter',
    endEffector: 'Was er hält',
    noEndEffector: 'Nichts',
    otherFile: 'Andere Datei',
    otherRobot: 'Anderen Roboter wählen',
    checkedFor: 'Geprüft für',
    change: 'ändern',
    several: (count) =>
      count === 1
        ? 'Eine Matrix dieser Datei könnte die Bewegung sein'
        : `${count} Matrizen dieser Datei könnten die Bewegung sein`,
    which: 'Welche ist die Bewegung?',
    drawn: (variable) => `Gezeigt: ${variable}, die wahrscheinlichste, als Radiant gelesen.`,
    wouldBe: (fix) => `Der Geist zeigt sie berichtigt: ${fix}`,
    shownHere: 'gezeigt',
    take: (variable) => `${variable} nehmen`,
    range: (low, high) => `von ${low} bis ${high}`,
    sparkline: (variable) => `Werte von ${variable} über die Zeilen`,
    findings: (count) => (count === 1 ? '1 Befund' : `${count} Befunde`),
    previousFinding: 'Befund davor',
    nextFinding: 'Nächster Befund',
    row: (row) => `Zeile ${row}`,
    rows: (first, last) => `Zeilen ${first} bis ${last}`,
    copyMatlab: 'MATLAB-Zeile kopieren',
    publishTitle: 'Im Labor veröffentlichen',
    name: 'Name',
    shareWithClass: 'Alle im Kurs dürfen sie sehen',
    publish: 'Veröffentlichen',
    publishedAs: (id, version) =>
      version > 1 ? `Veröffentlicht als ${id}, Version ${version}` : `Veröffentlicht als ${id}`,
    toLab: 'Labor öffnen',
    toTrajectory: 'Zur Trajektorie',
  },
  fixes: {
    frame_rate: (value) => `${value} Zeilen in der Sekunde annehmen`,
    variable: (value) => `${value} nehmen`,
    allTheSame: 'Trotzdem nehmen',
    leaveOut: (rows) =>
      rows.length === 1 && !rows[0]?.includes(':')
        ? `Zeile ${rows[0]} weglassen`
        : `Zeilen ${rows.join(', ').replaceAll(':', ' bis ')} weglassen`,
    keepRows: (first, last) => `Zeilen ${first} bis ${last} behalten`,
    columns: (value) => `Die Spalten ${value} nehmen`,
    transpose: () => 'Spalten als Messpunkte lesen',
    degrees: () => 'Zahlen als Grad lesen',
    unwrap: () => 'Sprünge um eine volle Drehung entfernen',
    resample: () => 'Zeiten gleichmäßig machen',
    join: (value) => `${value} zusammenfügen`,
    gripper: (value) => (value === 'none' ? 'Es gibt keinen Greifer' : `Der Greifer ist ${value}`),
    invert: () => 'Größer heißt offen',
    units: (value) => {
      const counts = value.startsWith('counts:') ? value.slice(7) : ''
      if (counts) return `Zahlen als Zählschritte lesen, ${counts} je Umdrehung`
      return `Zahlen als ${value === 'deg' ? 'Grad' : 'Radiant'} lesen`
    },
  },
  trajectories: {
    title: 'Trajektorien',
    search: 'Name, Person, Roboter oder Datei',
    whose: 'Wessen',
    scopes: { all: 'Alle', mine: 'Meine', shared: 'Mit mir geteilt' },
    count: (count) => (count === 1 ? '1 Trajektorie' : `${count} Trajektorien`),
    empty: 'Hierher kommen Bewegungen, die du veröffentlichst, und die, die andere teilen.',
    emptyAction: 'Die erste hochladen',
    noneFound: 'So eine Trajektorie gibt es nicht.',
    showAll: 'Alle zeigen',
    theLab: 'das Labor',
    you: 'du',
    shared: 'mit dem Kurs geteilt',
    ofLab: 'für alle in diesem Labor',
    private: 'nur für dich',
    privateOf: (owner) => `nur für ${owner}`,
    version: (version) => `Version ${version}`,
    warnings: (count) => (count === 1 ? '1 Warnung' : `${count} Warnungen`),
    chooseToCompare: 'Zwei zum Vergleichen wählen',
    compareWith: (id) => `${id} vergleichen`,
    chooseAnother: (name) => `${name}: wähle eine zweite zum Vergleich`,
    and: (first, second) => `${first} und ${second}`,
    compare: 'Vergleichen',
    actions: (name) => `Was mit ${name} geschehen soll`,
    download: 'Herunterladen',
    share: 'Mit dem Kurs teilen',
    unshare: 'Nicht mehr teilen',
    nowShared: (name) => `Der Kurs sieht ${name} jetzt`,
    nowPrivate: (name, whose) => `${name} ist jetzt ${whose}`,
    delete: 'Löschen',
    deleted: (name) => `${name} wurde gelöscht`,
    gone: (id) => `Die Trajektorie '${id}' gibt es nicht, oder sie ist nicht mit dir geteilt.`,
    toAll: 'Alle Trajektorien',
    robot: 'Roboter',
    length: 'Länge',
    lengthOf: (duration, frames, rate) => `${duration} s, ${frames} Zeilen mit ${rate} Hz`,
    source: 'Aus',
    created: 'Umgewandelt',
    link: 'Link und QR-Code',
    versions: 'Versionen',
    compareVersion: (version) => `Mit Version ${version} vergleichen`,
    restore: (version) => `Version ${version} zurückholen`,
    restored: (version) => `Version ${version} ist wieder die neueste`,
    comparison: 'Vergleich',
    endComparison: 'Vergleich beenden',
    same: 'Sie sind in jeder Zeile gleich.',
    otherRobot: 'Es ist die Bewegung eines anderen Roboters als die gewählte',
    otherJoints: (robot, other) =>
      `Es sind Bewegungen von ${robot} und ${other}, deren Gelenke nicht vergleichbar sind.`,
    deviation: (joint, amount, time, row) =>
      `Am weitesten auseinander in ${joint}: ${amount} bei ${time} s, Zeile ${row}.`,
    delayed: (delay, left) => `Die zweite ist ${delay} s später; ohne das: ${left}`,
  },
  signIn: {
    title: 'Anmelden',
    already: (name) => `Du bist als ${name} angemeldet.`,
    noWay: 'Öffne den Link, den mrlab up beim Start des Labors ausgegeben hat; er meldet dich an.',
    name: 'Name',
    password: 'Passwort',
    submit: 'Anmelden',
    university: 'Mit dem Konto der Hochschule anmelden',
    course: 'Du kommst aus einem Kurs? Öffne das Labor dort: das meldet dich an.',
    problems: {
      not_begun: 'Das dauerte zu lange oder begann in einem anderen Browser. Bitte beginne neu.',
      not_confirmed: 'Die Hochschule hat nicht bestätigt, wer du bist. Bitte beginne neu.',
      not_allowed: 'Dieses Konto darf sich hier nicht anmelden. Frag, wer das Labor betreibt.',
      too_many: 'Zu viele Versuche von dieser Adresse. Warte einen Moment und versuche es wieder.',
      ended: 'Deine Anmeldung wurde beendet. Melde dich neu an oder frag, wer das Labor betreibt.',
      unavailable: 'Die Hochschule antwortet gerade nicht. Versuche es gleich noch einmal.',
    },
    otherProblem: 'Das Anmelden hat nicht geklappt. Bitte beginne neu.',
    headset: 'Das ist ein Headset: Code zeigen',
    lost: 'Noch kein Passwort oder vergessen? Wer das Labor betreibt, macht dir einen Link.',
  },
  invitation: {
    title: (name) => `Willkommen, ${name}`,
    explanation: (role) => `Wähle ein Passwort für dieses Labor. Deine Rolle: ${role}.`,
    password: 'Passwort',
    again: 'Noch einmal dasselbe',
    hint: (least) => `Mindestens ${least} Zeichen; mehrere Wörter merkt man sich leicht.`,
    short: (least, count) => `Das Passwort hat ${count} Zeichen; nimm mindestens ${least}.`,
    differ: 'Die beiden sind nicht gleich; gib beide noch einmal ein.',
    submit: 'Speichern und hinein',
    invalid: 'Dieser Link gilt nicht',
    askAgain: 'Ein Link gilt einmal. Bitte den Betrieb des Labors um einen neuen.',
  },
  pairing: {
    showTitle: 'Dieses Headset einlassen',
    stepScan: 'Scanne das Bild mit einem angemeldeten Handy.',
    stepCompare: 'Vergleiche dort den Code und bestätige ihn.',
    stepWait: 'Warte hier: Das Labor öffnet sich von selbst.',
    goodFor: (seconds) => `In ${seconds} s kommt ein neuer Code.`,
    withPassword: 'Stattdessen ein Passwort verwenden',
    approveTitle: 'Ein Gerät oder Programm einlassen',
    approveExplanation:
      'Gib den Code ein, den das Headset oder das Programm zeigt. Bestätige ihn nur, wenn du es vor dir siehst.',
    shownBy: (device) => `${device} zeigt diesen Code.`,
    shownByProgram: (device) =>
      `${device} zeigt diesen Code. Bestätige ihn nur, wenn du dieses Programm gerade gestartet hast.`,
    code: 'Code',
    as: 'Es darf, was diese Rolle darf',
    approve: 'Bestätigen',
    approved: (device) => `${device} ist eingelassen`,
    whereToEnd: 'In der Liste der Geräte kannst du das jederzeit beenden.',
    toDevices: 'Zu den Geräten',
  },
  people: {
    title: 'Personen',
    list: 'Wer eingelassen ist',
    name: 'Name',
    role: 'Rolle',
    state: 'Passwort',
    member: 'vorhanden',
    invited: 'Link noch nicht benutzt',
    actions: 'Aktionen',
    actionsFor: (name) => `Was mit ${name} geschehen soll`,
    add: 'Jemanden hinzufügen',
    makeLink: 'Link machen',
    linkFor: (name) => `Link für ${name}`,
    linkExplanation: (days) =>
      `Gib diesen Link nur dieser Person. Er gilt einmal, ${days} Tage lang.`,
    newLink: 'Neuen Link machen',
    remove: 'Entfernen',
    removeTitle: (name) => `${name} entfernen?`,
    removeExplanation: 'Alle Anmeldungen dieser Person, ihrer Geräte und Programme enden sofort.',
    fate: 'Trajektorien und Uploads',
    fates: {
      keep: 'bleiben für die Lehrenden',
      hand_over: 'gehen an jemand anderen; Unveröffentlichtes wird gelöscht',
      erase: 'werden endgültig gelöscht',
    },
    heir: 'Wer sie bekommt',
    removed: (name) => `${name} wurde entfernt`,
    local:
      'Dieses Labor läuft nur für dich auf diesem Rechner. Mit Schlüsseln nimmt es weitere Personen auf: mrlab keys init.',
    roleNotes: {
      student: 'Lädt eigene Trajektorien hoch, veröffentlicht sie und sieht, was geteilt ist.',
      instructor: 'Darf alles und lässt Personen ein.',
      operator: 'Bewegt außerdem die Roboter des Labors.',
      display: 'Sieht das Labor und ändert nichts: für Projektoren.',
    },
    devices: 'Angemeldete Geräte',
    noDevices:
      'Kein Gerät ist angemeldet. Ein Headset zeigt einen Code, den du am Handy bestätigst.',
    browser: 'Browser',
    thisOne: 'dieses hier',
    lastSeen: (when) => `zuletzt gesehen ${when}`,
    until: (when) => `bis ${when}`,
    addProgram: 'Programm hinzufügen',
    program: 'Name des Programms',
    goodFor: 'Es gilt',
    days: (count) => (count === 1 ? 'einen Tag' : `${count} Tage`),
    makeToken: 'Token machen',
    tokenFor: (name) => `Token für ${name}`,
    tokenExplanation:
      'Das Programm sendet ihn im Header „Authorization: Bearer …“. Er wird nur dieses eine Mal gezeigt: Wer ihn hat, darf, was diese Rolle darf.',
    revoke: 'Beenden',
    revoked: (name) => `${name} ist abgemeldet`,
  },
  lab: {
    scene: 'Die Szene',
    picture:
      'Das Labor in 3D. Pfeiltasten drehen die Ansicht, Plus und Minus zoomen, 0 zeigt alles.',
    panel: 'Roboter und Systeme',
    pauseAll: 'Alle anhalten',
    showAll: 'Alles zeigen',
    project: 'Für den Beamer',
    keys: 'Topics',
    searchTopics: 'Topics nach Name oder Typ suchen',
    holdMessage: 'Anhalten',
    goOn: 'Weiter',
    noMessage: 'Noch ist keine Nachricht gekommen.',
    unknownType: (type) => `Diese Seite liest ${type} nicht; ros2 topic echo tut es.`,
    span: (low, high) => `(${low} bis ${high})`,
    copyLine: 'Die ros2-Zeile kopieren',
    connected: 'verbunden',
    roundTrip: (ms) => `hin und zurück ${ms} ms`,
    phases: {
      connecting: 'verbindet',
      lost: 'Verbindung verloren',
      refused: 'nicht erlaubt',
    },
    lastKnown:
      'Die Verbindung ist verloren: Das ist der letzte bekannte Stand. Alles hier wartet, bis sie wieder da ist.',
    outages: {
      died: (process, at, how, seconds) =>
        `${process} ist um ${at} gestorben${how && ` (${how})`}, in ${seconds} s wieder da`,
      froze: (process, at) => `${process} läuft seit ${at} nicht: von einem Signal angehalten`,
      refused: (process, at) =>
        `${process} endete um ${at}: Die Konfiguration ist falsch, deshalb kein neuer Start`,
      back: (process, since, at, how) =>
        `${process} läuft seit ${since} wieder, nach einem Ausfall ab ${at}${how && ` (${how})`}`,
      exitCode: (code) => `Exit-Code ${code}`,
      robot: 'Der Prozess, der diesen Roboter abspielt, läuft nicht.',
    },
    empty: 'Noch steht kein Roboter in der Szene.',
    emptyForOthers: 'Noch steht kein Roboter in der Szene. Eine Lehrkraft stellt einen auf.',
    addRobot: 'Roboter aufstellen',
    addIt: 'Aufstellen',
    removeRobot: 'Roboter entfernen',
    actionsFor: (name) => `Was mit ${name} geschehen soll`,
    load: 'Laden',
    loadingIt: 'Lädt …',
    another: 'Andere laden',
    playableBy: (robot) => `Trajektorien, die ${robot} abspielen kann`,
    searchFor: (robot) => `Trajektorien für ${robot} suchen`,
    searchTrajectory: 'Suche nach Name oder Datei',
    moreToFind: (count) =>
      count === 1 ? 'Eine weitere findet die Suche.' : `${count} weitere findet die Suche.`,
    noneLike: (text) => `Keine hat „${text}“ in Name oder Datei.`,
    nonePlayable: (model) => `Für ${model} gibt es noch keine Trajektorie.`,
    takeExample: 'Beispiel laden',
    otherEffector: (count) =>
      count === 1
        ? 'Eine weitere ist für ein anderes Werkzeug gemacht.'
        : `${count} weitere sind für andere Werkzeuge gemacht.`,
    onlyWatch: (role) =>
      `Mit der Rolle ${role} siehst du zu. Betrieb und Lehrende laden und spielen ab.`,
    grasps: 'Wo er greift und loslässt',
    closesAt: (time) => `schließt bei ${time} s`,
    opensAt: (time) => `öffnet bei ${time} s`,
    fromTo: (start, end) => `${start} bis ${end} s`,
    segment: (robot, start, end) => `${robot} von ${start} bis ${end} s`,
    join: 'Mit dem Handy dazu',
    joinSignIn: 'Scanne das mit einem Handy oder öffne die Adresse im Headset und melde dich an.',
    joinOpen: 'Scanne das mit einem Handy oder öffne die Adresse im Headset.',
    joinNot: (host) =>
      `Diese Seite wurde unter ${host} geöffnet, das ist dieser Rechner selbst: Auf einem Handy ist dieselbe Adresse das Handy.`,
    joinHow:
      'Ist das Labor schon im Netz erreichbar, öffne die Adresse, die mrlab up ausgegeben hat. Sonst beende das Labor und starte es für das Netz; Personen melden sich dann an (mrlab users add).',
    address: 'Adresse, unter der andere dieses Labor erreichen',
    takeAddress: 'Für Links nehmen',
    holds: (object) => `Hält ${object}`,
    standsIn: (what) => `Steht in ${what}: dort wird nicht geprüft, bis er heraus ist.`,
    inRoom: 'Im Raum',
    placeName: 'Name dieses Ortes',
    namePlace: 'Benennen',
    newPlace: 'Ein neuer Ort',
    seeWith: (name) => `Sehen, was ${name} sieht`,
    seesWith: (name) => `Mit den Augen von ${name}`,
    ownView: 'Zurück zur eigenen Ansicht',
    hasLeft: (name) => `${name} hat den Raum verlassen.`,
    lookHereHow: 'Klick: alle sehen den Punkt.',
    inSystem: (system) => `in ${system}`,
    clearHalt: 'Halt aufheben',
    next: {
      next: 'Dann',
      down: 'steht, bis sein Prozess wieder läuft',
      load: 'eine Bewegung laden',
      waits: (what) => `weiter, wenn ${what} fertig ist`,
      turn: (seconds) => `in ${seconds} s an der Reihe`,
      free: (time) => `ist er frei, geht es mit Abspielen bei ${time} s weiter`,
      goesOn: (time) => `mit Abspielen geht es bei ${time} s weiter`,
      plays: (motion, seconds) => `Abspielen führt ${motion} aus, ${seconds} s`,
      afterAdjusting: 'die Bewegung, sobald er an ihrem Anfang steht',
      closes: (time) => `der Greifer schließt bei ${time} s`,
      opens: (time) => `der Greifer öffnet bei ${time} s`,
      again: 'die Bewegung beginnt von vorn',
      ends: (time) => `die Bewegung endet bei ${time} s`,
    },
    openBag: (bag) => `${bag} wiedergeben`,
    parallel: 'Alle zugleich',
    sequential: 'Nacheinander',
    waitsFor: (what) => `wartet auf ${what}`,
    recordings: 'Aufnahmen',
    recording: (bag) => `Nimmt auf nach ${bag}`,
    replaying: (bag) => `Spielt ${bag} ab`,
    endReplay: 'Wiedergabe beenden',
    bag: 'Aufnahmen aller Labore, oder Ordner',
    replay: 'Abspielen',
    noWebGL:
      'Dieser Browser zeichnet nicht in 3D (WebGL 2 ist aus oder fehlt); die Zustände der Roboter stehen daneben.',
  },
  check: {
    of: (robot) => `Prüfung von ${robot}`,
    check: 'Prüfen',
    again: 'Neu prüfen',
    notYet: 'Noch nicht geprüft: eine Prüfung sagt vor dem Abspielen, was dagegen spricht.',
    verdicts: {
      ready: 'Bereit',
      not_ready: 'Nicht bereit',
      running: 'Wird geprüft…',
      failed: 'Nicht prüfbar:',
    },
    refusing: (count) =>
      count === 1 ? '1 Befund spricht dagegen' : `${count} Befunde sprechen dagegen`,
    warnings: (count) => (count === 1 ? '1 Warnung' : `${count} Warnungen`),
    nothing: 'keine Befunde, die dagegen sprechen',
    stale: (what) => `Von einer früheren Szene (${what}). Neu prüfen.`,
    findings: 'Was die Prüfung fand',
    at: (time) => `bei ${time} s`,
    more: (count) => (count === 1 ? 'Einen weiteren zeigen' : `${count} weitere zeigen`),
    claim:
      'Das Modell zeigt keinen Grund dagegen. Es kennt keine Momente, Bremsen, Kabel oder Menschen.',
    kinds: {
      collision: 'Kollision',
      collides_at_start: 'Kollision am Anfang',
      begins_inside: 'Beginnt in etwas',
      too_close: 'Sehr nah',
      joint_limit: 'Außerhalb des Bereichs',
      outside_range: 'Außerhalb des Bereichs',
      near_joint_limit: 'Nah am Ende des Bereichs',
      velocity_limit: 'Zu schnell',
      over_speed: 'Zu schnell',
      acceleration_limit: 'Beschleunigt zu stark',
      jerk_limit: 'Zu viel Ruck',
      moves_at_start: 'Beginnt nicht in Ruhe',
      moves_at_end: 'Endet nicht in Ruhe',
      speed_step: 'Sprung der Geschwindigkeit',
      zigzag: 'Zickzack',
      small_jumps: 'Kleine Sprünge',
      near_singularity: 'Nah an einer Singularität',
      uncertain_grasp: 'Unsicherer Griff',
      loses_object: 'Verliert ein Objekt',
      grasps_nothing: 'Greift ins Leere',
      nothing_to_grasp: 'Nichts zu greifen',
      bare_flange: 'Kein Greifer',
      missed_hand_over: 'Verpasste Übergabe',
      drops_object: 'Lässt in der Luft los',
      failed_hand_over: 'Misslungene Übergabe',
      payload: 'Zu schwer',
      misses_point: 'Verfehlt einen Punkt',
      point_out_of_order: 'Punkte in falscher Reihenfolge',
      left_the_room: 'Aus dem Raum gefallen',
      waits_forever: 'Wartet für immer',
      lost_points: 'Verlorene Punkte',
    },
  },
  grades: {
    none: 'In dieser Klasse ist keine Abgabe.',
    previous: 'Zurück',
    next: 'Weiter',
    keys: 'n: weiter, p: zurück',
    place: (number, count) => `${number} von ${count}`,
    points: (points, of) => `${points} von ${of} Punkten`,
    marks: 'Bewertung',
    hidden: 'für Studierende verborgen',
    bonus: 'zusätzlich zu den anderen',
    at: (time) => `bei ${time} s`,
    all: 'Alle Abgaben',
    order: 'Reihenfolge',
    orders: { class: 'Wie in der Klasse', points: 'Wenigste Punkte zuerst' },
    noMotion: 'Es gibt keine Bewegung zu zeigen',
    solid: 'diese Abgabe',
    dashed: 'die Musterlösung, in 3D als Geist',
    noReference: 'Die Aufgabe nennt keine Musterlösung zum Vergleich.',
    play: 'Im Labor abspielen',
    onRobot: 'Laden auf',
    noRobot: (model) => `Im Labor ist kein ${model}; füge auf der Seite Labor einen hinzu.`,
    loaded: (robot) => `Geladen auf ${robot}.`,
    toLab: 'Zum Labor',
    reference: 'Die Musterlösung',
    choose: 'Hier durch die Klasse gehen',
    leave: 'Die Klasse verlassen',
    desk: {
      title: 'Bewertungstisch',
      handIn: 'Abgeben',
      export: 'Export der Abgaben (ZIP aus Moodle, Canvas, ILIAS, Gradescope)',
      rubric: 'Rubrik (YAML)',
      solution: 'Musterlösung, wie die Rubrik sie nennt',
      worksheet: 'Tabelle der Plattform (CSV aus Moodle, Canvas, ILIAS), zum Ausfüllen',
      choose: 'Datei wählen',
      another: 'Andere wählen',
      there: (name, size) => `${name}, ${size}`,
      missing: (names) => `Die Rubrik nennt ${names}; gib sie als Musterlösung ab.`,
      form: 'Form des Exports',
      recognise: 'selbst erkennen',
      forms: { folder: 'ein Ordner oder eine Datei je Person', course: 'hier abgegeben' },
      read: (form) => `Gelesen als ${form}. Falsch? Wähle die Form und bewerte noch einmal.`,
      run: 'Klasse bewerten',
      again: 'Neu bewerten und Unterschiede zeigen',
      running: (done, all) => `${done} von ${all} sind bewertet`,
      starting: 'Der Lauf beginnt',
      runs: {
        propose: 'Neue Punkte',
        hold: 'Punkte',
        back: 'Punkte des Laufs davor',
        final: 'Was Studierende bekommen',
      },
      goBack: 'Zurück zu den Punkten des Laufs davor',
      stop: 'Anhalten',
      proposed: (count) =>
        count === 0
          ? 'Die neuen Punkte sind für alle dieselben.'
          : `Neue Punkte sind vorgeschlagen; sie unterscheiden sich bei ${count}.`,
      student: 'Person',
      before: 'Jetzt',
      after: 'Neu',
      tests: 'Tests',
      gone: 'nicht dabei',
      adopt: 'Neue Punkte gelten lassen',
      discard: 'Verwerfen',
      lock: 'Punkte sperren',
      lockedBy: (who) => `${who} hat die Punkte gesperrt.`,
      release: 'Punkte freigeben',
      releasedBy: (who) => `${who} hat die Punkte freigegeben.`,
      differing: (count) => `Zweitbewertungen, die abweichen: ${count}`,
      undo: 'Letzten Schritt zurücknehmen',
      downloads: 'Für das Lernsystem',
      feedback: 'Rückmeldungen (ZIP)',
      grades: 'Alle Punkte (CSV)',
      filled: 'Bewertungstabelle (CSV)',
      journal: 'Verlauf',
      leftOut: (count) => `Dateien, die zu niemandem gehören: ${count}`,
      unmatched: (count) => `Nicht zugeordnet: ${count}`,
      itIs: (name) => `Es ist ${name}`,
      allProposals: 'Alle Vorschläge annehmen',
      somebodyElse: 'Jemand anders',
      noProposal: 'Niemand ist ähnlich.',
      whoIsIt: 'Wer ist es?',
      ofItsOwn: 'eine eigene Abgabe',
      nobody: 'niemand',
      decided: 'Bewerte noch einmal, um zugeordnete Dateien zu prüfen.',
      acts: {
        assign: (who, file, name) => `${who}: ${file} ist von ${name}`,
        enrol: (who, name, row) => `${who}: ${name} ist ${row} der Tabelle`,
        mark: (who, name, test, points, text) => `${who}: ${name}, ${test}: ${points}. ${text}`,
        taken: (who, name, test) => `${who}: ${name}, ${test}: wie der Test sie gab`,
        second: (who, name, test, points) => `${who}, Zweitprüfung: ${name}, ${test}: ${points}`,
        comment: (who, name, text) => `${who} an ${name}: ${text}`,
        lock: (who) => `${who} hat die Punkte gesperrt`,
        release: (who) => `${who} hat die Punkte freigegeben`,
        undo: (who) => `${who} hat den letzten Schritt zurückgenommen`,
        adopt: (who) => `${who} ließ die Punkte eines Laufs gelten`,
        take_back: (who) => `${who} ging zu den Punkten des Laufs davor zurück`,
      },
      change: 'Ändern',
      points: 'Punkte',
      reason: 'Grund',
      asFirst: 'Gelten lassen',
      asSecond: 'Als Zweitprüfung',
      back: 'Wie der Test sie gab',
      secondBack: 'Zweitbewertung zurücknehmen',
      cancel: 'Abbrechen',
      changed: (who, given, when, reason) => `${who} änderte es von ${given} (${when}): ${reason}`,
      seconds: (who, points) => `Zweitprüfung ${who}: ${points}`,
      total: 'Alle Punkte',
      comment: 'Kommentar für die Person',
      keep: 'Kommentar behalten',
    },
    course: {
      title: 'Kurs',
      none: 'Öffne das Labor einmal aus dem Kurs, als Lehrperson: dann sind hier seine Aufgabe und seine Bewertungen bekannt.',
      connected: (course, task) => (task ? `${course}: ${task}` : course),
      handedIn: (done, all) => `${done} von ${all} haben abgegeben`,
      silent: 'Noch nicht',
      members: 'Liste der Studierenden holen',
      take: 'Abgegebenes übernehmen',
      taken: 'Das Abgegebene ist jetzt der Export. Bewerte die Klasse.',
      send: 'Punkte an den Kurs senden',
      leave: 'Vom Kurs trennen',
      leaving: 'Die nächste Aufgabe, die du im Kurs öffnest, ist dann die dieser Klasse.',
    },
    mine: {
      title: 'Abgeben',
      noTask: 'Deine Lehrperson hat die Aufgabe noch nicht bereitgestellt.',
      notMember: 'Öffne das Labor aus dem Kurs, um abzugeben.',
      closed: 'Die Bewertung ist abgeschlossen; es kann nichts mehr abgegeben werden.',
      drop: 'Gib deine Bewegung ab',
      explanation:
        'Sie wird sofort geprüft. Du kannst beliebig oft eine andere Datei abgeben: die letzte zählt.',
      file: (name, when) => `${name}, abgegeben ${when}`,
      checking: 'Deine Datei ist abgegeben und wird gerade geprüft…',
      looks: 'Die Bewegung erst in 3D ansehen',
      check: 'Sofortprüfung',
      passed: 'erfüllt',
      lost: 'noch zu tun',
      mark: 'Deine Bewertung',
      comment: 'Von deiner Lehrperson',
    },
  },
  room: {
    title: 'Das Labor in deinem Raum',
    inAnotherHand: (name: string) => `Jemand anders hat ${name} in der Hand.`,
    picture:
      'Das Labor in wahrer Größe. Ziehen dreht die Ansicht, das Mausrad bringt näher; Tafeln drückt die Maus. Alles steht auch auf der Seite Labor.',
    enter: 'Raum betreten',
    enterVr: 'In virtueller Realität betreten',
    entering: 'Wird betreten…',
    desktop: 'Ohne Brille siehst du den Raum von hier: ziehen, scrollen, Tafeln drücken.',
    inside: 'Du bist im Raum. Nimm die Brille ab oder drücke Verlassen, um zurückzukommen.',
    empty: 'Hier steht noch kein Roboter. Wähle einen auf der Tafel neben dir.',
    hindrances: {
      no_https:
        'Eine Brille tritt nur über HTTPS ein, und diese Seite kam ohne. Starte das Labor mit `mrlab up --keys` oder `--https-cert` und öffne die https-Adresse, die es ausgibt.',
      no_webxr:
        'Dieser Browser hat kein WebXR. Nimm in einer Quest ihren eigenen Browser, am Telefon Chrome.',
      no_device: 'Keine Brille ist verbunden. Öffne diese Seite im Browser der Brille.',
      blocked:
        'Der Browser hat dieser Seite virtuelle Realität verweigert. Erlaube sie in seinen Einstellungen und lade neu.',
    },
    refusedEntry: (why: string) => `Die Brille ist nicht eingetreten: ${why}`,
    permission: 'es war nicht erlaubt. Drücke erneut und erlaube den Zugriff auf den Raum.',
    noFloor:
      'sie kennt keinen Boden. Richte den Raum in den Einstellungen der Brille ein, dann drücke erneut.',
    busy: 'eine andere Seite benutzt sie. Schließe diese und drücke erneut.',
    missing: (names: string) => `Ein Kasten steht für jedes fehlende Teil: ${names}`,
    hops: {
      connecting: 'Der Weg zum Gateway: wird verbunden.',
      lost: (why: string) => `Der Weg zum Gateway ist verloren, es wird erneut versucht: ${why}`,
      refused: (why: string) => `Das Gateway lässt diese Seite nicht ein: ${why}`,
      silent: 'Das Gateway antwortet, aber dahinter kein Labor. Starte eines mit `mrlab up`.',
    },
    robots: 'Roboter',
    objects: 'Dinge',
    systems: 'Systeme',
    room: 'Raum',
    all: 'Alle',
    axes: (count: number) => `${count} Achsen`,
    placed: (name: string) => `${name} steht dort. Halte seinen Sockel, um ihn zu tragen.`,
    placing:
      'Zeige auf den Boden oder einen Tisch; der Stick dreht, oder drück und geh zur Seite. Loslassen stellt auf, in der Luft legt es weg.',
    placingShort: 'Drücken: hier aufstellen · Stick, oder drücken und zur Seite: drehen',
    hindered: {
      edge: 'Es stünde über der Kante. Zeige weiter nach innen.',
      thing: 'Es stünde in einem anderen Ding. Zeige daneben.',
      robot: 'Es stünde zu nah an einem anderen Roboter. Zeige weiter weg.',
      person: 'Dort steht ein Mensch. Zeige weiter weg.',
    },
    play: 'Abspielen',
    pause: 'Anhalten',
    stop: 'Stopp',
    motions: 'Bewegungen',
    endEffector: 'Endeffektor',
    telemetry: 'Telemetrie',
    remove: 'Entfernen',
    back: 'Zurück',
    noMotion: 'keine Bewegung',
    chooseMotion: 'Wähle eine Bewegung zum Abspielen.',
    noneFits: (model: string) =>
      `Für ${model} ist noch keine Bewegung veröffentlicht. Lade eine auf der Seite Hochladen hoch.`,
    bareFlange: 'Nur der Flansch',
    grasps: 'greift',
    releases: 'lässt los',
    frame: (frame: number, count: number) => `Zeile ${frame} von ${count}`,
    moveClear: 'Räume den Arm frei, dann drücke Abspielen.',
    cleared: 'Es ist wieder frei.',
    playOn: 'Drücke Abspielen, um hier weiterzumachen.',
    show: 'Zeigen …',
    letGo: 'Loslassen',
    giveInHand: 'Greifen',
    nothingNear:
      'Zwischen den Fingern liegt nichts. Bringe einen Gegenstand hin und drücke noch einmal.',
    toolPath: 'Weg des Werkzeugs',
    reach: 'Reichweite',
    speed: (fastest: string) => `0 bis ${fastest} m/s`,
    compare: 'Mit anderer Bewegung vergleichen …',
    comparedWith: (motion: string) => `Daneben: ${motion}`,
    compareHint: 'Die andere Bewegung läuft als Geist mit; der Abstand der beiden wird angezeigt.',
    noGhost: 'Keine andere Bewegung',
    earlier: 'die Fassung davor',
    apart: (now: string, most: string) => `${now} mm Abstand am Werkzeug, höchstens ${most} mm`,
    lab: 'Labor',
    scenes: 'Szenen',
    saveScene: 'Diese Szene sichern',
    savedScene: (name: string) => `Gesichert als ${name}.`,
    touchSurface: 'Fläche antippen',
    touchTable: 'Berühre die Mitte eines Tisches und drück.',
    tourStop: 'Halt',
    looksHere: (name: string) => `${name}: seht hierher`,
    lookHere: 'Hierher sehen',
    pointing: 'Ziel und drück: alle sehen den Punkt.',
    undo: 'Rückgängig',
    asksForget: 'Das Labor vergisst alle Flächen. Noch einmal drücken.',
    loadScene: (name: string) => `${name} laden`,
    noScenes: 'Noch ist keine Szene gesichert.',
    record: 'Aufzeichnen',
    endRecording: 'Aufzeichnung beenden',
    endReplay: 'Beenden',
    noBags: 'Das Labor hat noch keine Aufnahme.',
    stats: 'Verzögerung und Bildzeit',
    statsFrame: (ms: string, rate: string) => `${ms} ms je Bild, ${rate} Bilder je Sekunde`,
    statsAge: (p50: string, p95: string) => `Gelenkwerte sind ${p50} ms alt, 95 % unter ${p95} ms`,
    statsTrip: (ms: string) => `Hin und zurück zum Gateway: ${ms} ms`,
    statsNone: 'In der letzten Sekunde kamen keine Gelenkwerte.',
    holdsNow: (object: string, mass: string, payload: string) =>
      `Hält ${object}: ${mass} kg${payload === '' ? '' : ` von ${payload} kg`}`,
    bears: (margin: string, moment: string) =>
      `Rutschreserve ${margin} · ${moment} N·m am Handgelenk`,
    slips: (moment: string) => `Er rutscht · ${moment} N·m am Handgelenk`,
    objectCount: (count: number, most: number) =>
      most > 0
        ? `${count} von ${most} Gegenständen; ein weiterer ersetzt den ältesten`
        : `${count} Gegenstände`,
    proxyNote: 'Ersatzgröße, kein Drehmoment',
    clearObjects: 'Alle Dinge entfernen',
    systemHint:
      'Mehrere Roboter auf einer Zeitachse: drücke den Knopf, dann berühre sie der Reihe nach.',
    pick: 'Roboter wählen',
    touchInOrder:
      'Berühre jeden Roboter mit Finger oder Controller, oder zeige auf ihn: in der Reihenfolge, in der sie spielen.',
    nonePicked: 'noch keiner',
    people: 'Leute',
    you: 'du',
    alone: 'Niemand sonst ist mit einem Headset im Raum.',
    andMore: (count: number) => `und ${count} weitere`,
    parts: { 0: 'sieht zu', 1: 'steuert', 2: 'lehrt' },
    pauseAll: 'Alle anhalten',
    pausedAll: (count: number) => `Angehalten: ${count}. Alle hier erfahren, dass du es warst.`,
    nothingMoves: 'Gerade bewegt sich nichts.',
    pausedBy: (who: string, names: string) => `${who} hat ${names} angehalten.`,
    align: 'An Punkten ausrichten',
    undoAlign: 'Ausrichtung zurück',
    alignFirst:
      'Berühre den ersten Punkt, dann kneife oder drücke den Abzug. Alle Headsets nehmen dieselben zwei Punkte, in derselben Reihenfolge.',
    alignSecond: 'Nun berühre ebenso den zweiten Punkt. Das Labor blickt vom ersten zu ihm.',
    alignNear:
      'Diese Punkte liegen zu nah beieinander. Nimm einen, der mindestens einen halben Meter weg ist.',
    alignDone: 'Ausgerichtet. Wer dieselben Punkte berührt, sieht das Labor am selben Ort.',
    alignUndone: 'Die Szene steht, wo sie vorher stand.',
    settings: 'Optionen',
    leftHandedAbout: 'Tafeln stehen auf der anderen Seite, für die linke Hand.',
    captions: 'Untertitel',
    captionsAbout: 'Was geschieht, steht unten im Bild, auch was sonst nur zu hören ist.',
    seated: 'Im Sitzen',
    seatedAbout:
      'Tafeln kommen tiefer, in virtueller Realität auch der Boden. Roboter trägt der Strahl.',
    largeText: 'Große Schrift',
    largeTextAbout: 'Tafeln und ihre Schrift sind um ein Drittel größer.',
    contrast: 'Hoher Kontrast',
    contrastAbout: 'Tafeln in Schwarz, Weiß und Gelb.',
    still: 'Weniger Bewegung',
    stillAbout: 'Nichts pulsiert oder gleitet; Tafeln springen an ihren Ort.',
    occlusion: 'Echtes verdeckt',
    occlusionAbout:
      'Durch Flächen, die die Brille kennt; durch gemessene Tiefe ab dem nächsten Betreten.',
    brightness: ['Dunkel', 'Schattig', 'Hell'],
    warmth: ['Tageslicht', 'Gemischt', 'Lampe'],
    lightAbout: 'Das Licht deines Raums, da die Brille es nicht schätzt.',
    tour: {
      title: (number: number, count: number) => `Erste Schritte · ${number} von ${count}`,
      next: 'Weiter',
      end: 'Beenden',
      again: 'Erste Schritte',
      about:
        'Roboter stellen, Bewegung laden, abspielen, scrubben und einen befreien, der anhielt.',
      steps: {
        place:
          'Wähle einen Roboter im Reiter Roboter, zeige auf Boden oder Tisch und zieh den Abzug.',
        load: 'Drücke Bewegungen auf der Tafel des Roboters und wähle eine.',
        play: 'Drücke Abspielen. Geh um den Roboter herum, während er sich bewegt.',
        scrub: 'Zieh den Knopf auf der Zeitachse: der Roboter geht an jeden Zeitpunkt.',
        halt: 'Trage ein Ding in den Arm: er hält an und sagt, was er traf. Trag es weg, dann Abspielen.',
      },
      gestures: {
        controller: {
          place: 'Auf ein Bild zeigen, Abzug drücken',
          load: 'Auf Bewegungen zeigen, Abzug drücken',
          play: 'Auf Abspielen zeigen, Abzug drücken',
          scrub: 'Abzug auf dem Knopf halten und ziehen',
          halt: 'Griff an einem Ding halten und tragen',
        },
        hand: {
          place: 'Auf ein Bild zeigen und kneifen, oder antippen',
          load: 'Bewegungen antippen, oder zeigen und kneifen',
          play: 'Abspielen antippen, oder zeigen und kneifen',
          scrub: 'Den Knopf kneifen und ziehen',
          halt: 'Ein Ding kneifen und tragen',
        },
      },
    },
    dissolve: 'Auflösen',
    members: (count: number) =>
      `${count} Roboter auf einer Zeitachse; ihre eigenen Tafeln sind weggelegt.`,
    takeOut: 'Roboter herausnehmen',
    asksTakeOut: (robot: string) =>
      `Ohne ${robot} wird das System aufgelöst: seine Roboter bleiben, wo sie sind, und jeder hat wieder seine eigene Tafel.`,
    asksDissolve:
      'Das System auflösen? Seine Roboter bleiben, wo sie sind, und jeder hat wieder seine eigene Tafel.',
    surfaces: (count: number) =>
      count === 0
        ? 'Der Raum hat noch keine Flächen: Roboter stehen am Boden und gehen durch Tische.'
        : `${count} Flächen des Raums sind bekannt; Arme halten vor ihnen.`,
    notSetUp:
      'Die Brille kennt hier weder Tisch noch Wand. Drücke „Raum einrichten“ oder mach ohne weiter.',
    anchorKept: 'Die Szene behält hier ihren Platz, auch für das nächste Mal.',
    anchorSession:
      'Die Szene behält ihren Platz, bis du gehst; die Brille merkt sich keine weiteren.',
    alignWith: 'Mit ihnen ausrichten',
    notAligned: 'woanders oder nicht ausgerichtet',
    alignToCount:
      'Andere sind hier. Deine Flächen und dein Avatar zählen, sobald du dich ausrichtest: Reiter „Raum“.',
    earlierPlace:
      'Der frühere Platz der Szene wurde gefunden. Reiter „Raum“: zurückstellen oder hier lassen.',
    putBack: 'Zurückstellen',
    keepHere: 'Hier lassen',
    anchorNone: 'Diese Brille merkt sich keine Plätze: nach dem Zentrieren „Szene hierher holen“.',
    lacks: (features: string) => `Dieser Sitzung fehlt: ${features}`,
    grid: 'Bodenraster',
    leftHanded: 'Linkshändig',
    scan: 'Raum einrichten',
    forgetSurfaces: 'Alle Flächen vergessen',
    bringHere: 'Szene hierher holen',
    leave: 'Verlassen',
  },
}

const ROLE = 'display=Anzeige|student=Studierende|operator=Betrieb|instructor=Lehrende'

const COMMANDS = [
  'load=Laden',
  'unload=Entladen',
  'play=Abspielen',
  'pause=Anhalten',
  'stop=Stoppen',
  'seek=Springen',
  'step=Einzelschritt',
  'clear the halt=Halt aufheben',
  'set the mode=Ändern des Modus',
  'start a recording=Beginn einer Aufnahme',
  'split the recording=Teilen der Aufnahme',
  'start a replay=Beginn einer Wiedergabe',
  'pause the replay=Anhalten der Wiedergabe',
  'resume the replay=Fortsetzen der Wiedergabe',
  'seek in the replay=Springen in der Wiedergabe',
  'set the rate=Ändern des Tempos',
  'set the loop=Ändern der Schleife',
].join('|')

/** Texts of the lab by code; the placeholders are those of the English text. */
export const diagnostics: Templates = {
  a_filled_text: ['ein Text, der nicht leer ist'],
  a_list: ['eine Liste'],
  a_mapping: ['eine Zuordnung mit den Feldern {fields:list}'],
  a_name: [
    'ein Name aus Kleinbuchstaben, Ziffern und Unterstrichen, der mit einem Buchstaben beginnt, etwa cube_1',
  ],
  a_number: [
    'eine Zahl[ {limits:problem}][ ({unit})][{sign:choice either=, auch mit negativem Vorzeichen}]',
  ],
  a_text: ['ein Text'],
  a_urdf: ['eine URDF'],
  acceleration_limit: [
    '{joint} beschleunigt mit {value:measure}; der Hersteller nennt {limit:measure}.',
    'Plane mit einem glatten Zeitgesetz wie einem Polynom fünften Grades, oder gib der Bewegung mehr Zeit.',
  ],
  accelerations_in_limits: ['Beschleunigungen unter ihren Grenzen, bis auf {tolerance:share}'],
  add_objects: ['{objects:list} zurücklegen'],
  all_held: [
    'Alle {count:integer} Gegenstände werden gehalten; für einen neuen ist kein Platz.',
    'Lass erst einen los oder entferne einen.',
  ],
  all_hidden: ['Jeder Test ist verborgen; Studierende sehen keinen davon.'],
  all_joints_turn: ['alle Gelenke von {model} drehen sich: möglich sind rad, deg oder counts:N'],
  all_stand: ['alle Mitglieder stehen; Abspielen beginnt von vorn'],
  allow_list_not_read: [
    'Die Bridge kann ihre Liste der Erlaubten, {path}, nicht lesen: {why:problem}.',
    'Nenne eine YAML-Datei mit dem Parameter allow_list.',
  ],
  allow_list_unreadable: ['Die Liste der Erlaubten, {path}, ist nicht lesbar: {why:problem}.'],
  already_in_world: ['{name} ist schon in der Welt.', 'Entferne es zuerst.'],
  ambiguous: [
    "[Ist '{only}' ({size}) in '{file}' die Matrix der Gelenkwinkel, wie der Roboter sie nimmt? Sie würde genommen, aber {why:reasons}.][ Ihre Werte: {seen:reasons}.][{count:count Matrix kommt|Matrizen kommen} in '{file}' als Trajektorie infrage:{candidates:problems}]",
    "[Enthält '{only}' sie, nenne die Matrix; wenn nicht, speichere die Gelenkwinkel als q.][Sag, welche von {among:list} es ist, oder speichere nur diese.]",
  ],
  an_integer: ['eine ganze Zahl[ {limits:problem}][ ({unit})]'],
  and_also: ['{first:problem}; {then:problem}'],
  another_count: [
    'sie hat {count:count Element|Elemente} und die Trajektorie {rows:count Zeile|Zeilen}',
  ],
  appeared: ['{name} ist hinzugekommen'],
  array_rate: [
    'fs ist {found} und damit keine Rate.',
    'Erwartet wird eine Zahl von Hz über 0, oder die Zeit jeder der {rows:count Zeile|Zeilen} in s.',
  ],
  array_shape: [
    'Ein Array aus {kind} mit der Form {shape:list} ist keine Bewegung.',
    'Erwartet wird eine Matrix reeller Zahlen, mit einer Zeile je Frame und einer Spalte je Gelenk.',
  ],
  asset_changed: ['{asset} wurde während des Sendens geändert.', 'Lade die Datei noch einmal.'],
  asset_in_pieces: [
    '{key} hat {size:integer} Bytes, und eine Antwort fasst höchstens {largest:integer}.',
    'Hole die Datei in Stücken: {key}?offset=0;length={largest:integer}, dann mit dem nächsten offset.',
  ],
  asset_offset_beyond: [
    '{key} hat {size:integer} Bytes; offset ist {offset:integer}.',
    'Nimm einen offset, der höchstens so groß ist.',
  ],
  asset_too_large: ['{asset} hat {size:bytes}; das ist zu groß für einen Roboter.'],
  asset_unanswered: [
    'Das Labor antwortet auf die Frage nach {asset} nicht.',
    'Prüfe, ob das Labor läuft, und versuche es noch einmal.',
  ],
  asset_unsteady: [
    '{asset} ändert sich immer wieder.',
    'Versuche es noch einmal, wenn die Datei vollständig ist.',
  ],
  assets_busy: [
    '{waiting:integer} Anfragen nach Dateien warten schon.',
    'Frag später noch einmal.',
  ],
  at_position: ['bei {position:time}'],
  at_rest: ['{instant:choice start=Die Bewegung beginnt|end=Die Bewegung endet} in Ruhe.'],
  at_start: ['am Start'],
  back_at_begin: ['wieder am Anfang; wartet, bis es frei ist'],
  back_at_home: ['in seiner Grundstellung; wartet, bis es frei ist'],
  bad_asset_attachment: [
    'Der Anhang {found} gehört nicht zu einer Datei des Labors; erwartet wird JSON mit size, sha256, media_type und offset.',
  ],
  bad_asset_parameter: [
    "Der Parameter {parameter} ist '{found}'; erwartet wird eine Zahl von Bytes, wie in ?offset=0;length=65536.",
  ],
  bad_attachment_name: [
    "Der Anhang '{attachment}' {problem:choice unprintable=kann keine Datei benennen|outside=würde außerhalb des Ordners geschrieben|hidden=wäre eine versteckte Datei|within=läge in einem anderen Anhang statt in einem Ordner}; es wurde nichts geschrieben.",
    'Das Bag ist von Hand gemacht: Ein Labor nennt seine Anhänge zum Beispiel robots/ur5e_1.urdf.',
  ],
  bad_attribute: ["das Attribut {attribute} von '{variable}' ist zu groß"],
  bad_bag_message: [
    'eine Nachricht ist nicht vom Typ {type} ({problem})',
    'Hole eine Kopie des Bags zurück.',
  ],
  bad_body: [
    'Ein Körper hat die Masse {mass:mass} und {parts:count Teil|Teile}; erwartet werden eine Masse von mindestens 0 und mindestens ein Teil.',
  ],
  bad_closest: ['closest ist {text}; erwartet wird 0 bis {limit:length}, so weit wird gemessen.'],
  bad_columns: [
    "Die Spalten '{columns}' lassen sich nicht aus '{variable}' ({size}) nehmen: {why:problem}.",
    'Schreibe Spalten wie in MATLAB: 2:7, oder 1,3,5, oder 2:end.',
  ],
  bad_command: [
    'Der Befehl {command:integer} ist unbekannt; erwartet wird einer aus mrlab_msgs/DriveOrder.',
  ],
  bad_dimensions: [
    'ein Feld hat die Abmessungen {size}; erwartet werden {least:integer} bis {most:integer}, keine davon negativ',
  ],
  bad_display_id: [
    "Die Anzeige hat die Kennung '{id}'.",
    'Erwartet werden 1 bis {most:integer} druckbare Zeichen.',
  ],
  bad_due: ['Den Zeitpunkt {text} gibt es nicht.'],
  bad_dwell: ['Die Haltezeit ist {dwell:time}; erwartet wird 0 bis {longest:time}.'],
  bad_endpoint: [
    "Die Bridge soll an '{endpoint}' erreichbar sein; erwartet wird Protokoll/Adresse:Port, etwa tcp/127.0.0.1:7447.",
  ],
  bad_fingers: [
    'Die Finger von {robot} erhielten die Geschwindigkeiten {found:list}; erwartet: {count:integer} endliche Zahlen.',
  ],
  bad_frame_number: ['{field} ist {found}; erwartet wird eine Zahl von 0 bis 2^32 - 1.'],
  bad_key_name: [
    "'{name}' ist kein Name für einen Schlüssel.",
    "Erwartet werden höchstens 41 Buchstaben, Ziffern, '_', '-' und '.', beginnend mit einem Buchstaben oder einer Ziffer, und nicht {reserved:either}.",
  ],
  bad_listen_address: [
    "'{address}' ist keine Adresse, an der das Gateway erreichbar sein kann.",
    'Erwartet wird HOST:PORT, etwa 127.0.0.1:8080 oder 0.0.0.0:8080.',
  ],
  bad_mesh: ['Ein Netz hat weniger als drei endliche Eckpunkte.'],
  bad_mesh_address: ["Die Adresse des Netzes, '{uri}', beginnt nicht mit {expected}."],
  bad_message: [
    "'{variable}' ist eine JointTrajectory, die sich nicht abspielen lässt: {why:problem}.",
    'Jeder Punkt braucht für jedes Gelenk eine Position und ein time_from_start, das später ist als das des Punkts davor.',
  ],
  bad_mode: [
    'Der Modus {mode:integer} ist unbekannt; erwartet wird 0 (alle zugleich) oder 1 (einer nach dem anderen).',
  ],
  bad_name: [
    "'{name}' kann nicht der Name {what:choice robot=eines Roboters|object=eines Gegenstands|system=eines Systems} sein; erwartet werden Kleinbuchstaben, Ziffern und einzelne Unterstriche, beginnend mit einem Buchstaben, etwa ur5e_1.",
  ],
  bad_name_bytes: ['ein Name ist als {found} geschrieben; so schreibt ihn MATLAB nie'],
  bad_op: ["'{op}' gehört nicht zu den Operationen (op) von {protocol}.", 'Siehe docs/link.md.'],
  bad_option: [
    "Die Option {option} ist '{found}': {why:problem}.",
    'Berichtige die Option oder lass sie weg.',
  ],
  bad_part: [
    "'{variable}' lässt sich nicht aus '{other}' ({size}) nehmen: {why:problem}.",
    'Schreibe Zeilen und Spalten wie in MATLAB: q(1:200, :), oder q(201:end, 1:6).',
  ],
  bad_person_name: [
    "'{name}' ist kein Name für eine Person.",
    "Erwartet werden höchstens 41 Buchstaben, Ziffern, '_', '-' und '.', beginnend mit einem Buchstaben oder einer Ziffer, und nicht {reserved:either}.",
  ],
  bad_policy: [
    'Die Regel {policy:integer} ist unbekannt; erwartet wird 0 (alle halten an) oder 1 (nur das Mitglied hält an).',
  ],
  bad_pose: [
    '{place:problem} ist {found}; erwartet wird [[x, y, z]] in m, oder position: [[x, y, z]] mit rpy_deg: [[roll, pitch, yaw]].',
  ],
  bad_position: [
    'Die Position ist {position:time}; erwartet wird 0 bis {duration:time}, die Länge der Zeitachse.',
  ],
  bad_public_url: [
    '{url} ist keine Adresse einer Website.',
    'Erwartet wird zum Beispiel https://lab.example.org.',
  ],
  bad_quaternion: [
    'Die Orientierung {found:list} hat die Länge {length:number}; erwartet wird ein Einheitsquaternion (x, y, z, w), etwa 0, 0, 0, 1.',
  ],
  bad_rate: [
    'Die Rate ist {value:number}; erwartet werden {least:number} bis {most:number} Zeilen pro Sekunde.',
    'Sag, wie viele Zeilen pro Sekunde du aufgenommen hast, etwa 100.',
  ],
  bad_replay_rate: [
    'Das Tempo ist {rate:number}; erwartet wird {low:number} bis {high:number}, 1 ist wie aufgenommen.',
  ],
  bad_request: [
    'Diese Anfrage ist nicht zu verstehen: {mistakes:reasons}.',
    '/api/openapi.json beschreibt sie.',
  ],
  bad_request_field: [
    '{field} ist {found}; erwartet wird {expected:choice number=eine Zahl|integer=eine ganze Zahl|boolean=True oder False|text=ein Text}.',
  ],
  bad_ros_arguments: [
    "ROS nimmt die Befehlszeile nicht an: {why}. Erwartet werden Argumente, wie ROS sie hat, etwa eine Parameterdatei oder ein Parameter lab:robots:='[[ur5e]]'.",
  ],
  bad_scene_name: [
    "'{name}' kann nicht der Name einer Szene sein; erwartet werden Kleinbuchstaben, Ziffern und Unterstriche, etwa class_3.",
  ],
  bad_size: [
    'Die Form {shape:choice box=Quader|cylinder=Zylinder|sphere=Kugel|hull=konvexe Hülle|mesh=Netz} hat die Größe {size:list} m; erwartet: {count:count Zahl|Zahlen} von 0,0001 bis 1000.',
  ],
  bad_source: [
    'Die Quelle {source} hat {count:integer} Zeichen; erwartet werden höchstens {most:integer} druckbare, etwa eine Kennung des Headsets.',
  ],
  bad_speed: [
    'Das Tempo ist {rate:exact}; erwartet wird {low:exact} bis {high:exact}, rückwärts -{low:exact} bis -{high:exact}; 1 ist das vorgesehene Tempo.',
  ],
  bad_split_duration: [
    'Die Dateien sollen nach {duration:time} geteilt werden; erwartet wird 1 s oder mehr, oder 0 für nie.',
  ],
  bad_split_size: [
    'Die Dateien sollen bei {size:bytes} geteilt werden; erwartet wird 0 oder mehr.',
  ],
  bad_step: ['Der Schritt ist {step:exact} s lang; erwartet wird 0,00001 bis 0,1 s.'],
  bad_subscriptions: [
    'Die Abonnements eines hello müssen eine Zuordnung von Nummern zu Schlüsselausdrücken sein.',
  ],
  bad_table: [
    "'{file}' lässt sich nicht als Tabelle lesen: {why:problem}.",
    'Schreibe Zahlen mit Dezimalpunkt, eine Zeile je Messpunkt, unter eine Zeile mit Überschriften; oder sichere in MATLAB eine .mat-Datei.',
  ],
  bad_topic_pattern: [
    "'{pattern}' ist kein Name für Topics; erwartet wird ein Name wie /robots oder /*/joint_states, in dem * für einen Teil steht und ** für beliebig viele.",
  ],
  bad_trajectory_id: [
    "'{id}' kann nicht die Kennung einer Trajektorie sein.",
    "Schreibe NAME oder PERSON/NAME, mit Buchstaben, Ziffern, '.', '_' und '-' in NAME, etwa quintic, anna/quintic oder quintic@3.",
  ],
  bad_trajectory_name: [
    "Der Name '{name}' geht nicht.",
    "Nimm Buchstaben, Ziffern, '.', '_' und '-', höchstens {most:integer}, beginnend mit einem Buchstaben oder einer Ziffer.",
  ],
  bad_upload_number: [
    "'{number}' bezeichnet nichts, was gesendet wurde; erwartet werden 32 Hexadezimalziffern.",
  ],
  bad_value: ['{what:problem} ist {found}; erwartet: {expected:problem}.', '[{hint:problem}.]'],
  bad_vector: [
    '{what:choice position=Die Position|velocity=Die Geschwindigkeit|angular_velocity=Die Winkelgeschwindigkeit} ist {found:list}; erwartet werden drei endliche Zahlen innerhalb von ±{limit:exact}.',
  ],
  bad_wait: [
    "'{wait}' ist keine Wartebedingung; erwartet wird 'frame 0: after kr6_1.frame 120', 'frame 200: object cube_1 held by ur5e_1' oder 'frame 310: object cube_1 free'.",
  ],
  bad_zenoh_file: [
    'Zenoh nimmt {file} nicht an: {why:problem}.',
    'Beispiele stehen in docs/bridge.md.',
  ],
  bad_zenoh_settings: [
    'Zenoh nimmt mode {mode}[, listen {listen:list}][, connect {connect:list}] nicht an: {why:problem}.',
    'Beispiele stehen in docs/bridge.md.',
  ],
  bag_being_recorded: [
    'Das Bag {path} wird gerade aufgenommen und braucht keine Reparatur.',
    'Beende zuerst die Aufnahme.',
  ],
  bag_compressed: [
    '{path} ist als Ganzes komprimiert.',
    'Importiere es; das macht ein gewöhnliches Bag daraus.',
  ],
  bag_cut_short: [
    '{file} endet bei Byte {offset:integer} mitten in einem Eintrag; was davor steht, wird gelesen',
  ],
  bag_damaged: [
    '{file} ist bei Byte {offset:integer} beschädigt[ ({problem})].',
    'Hole eine Kopie der Datei zurück oder repariere das Bag; dabei fällt dieser Teil weg.',
  ],
  bag_disk_full: [
    'Das Bag {folder} kann nicht geschrieben werden: {cause:choice disk=Der Datenträger ist voll|quota=Dein Kontingent dort ist aufgebraucht}[ ({free:bytes} von {size:bytes} sind frei)]; eine Aufnahme braucht {needed:bytes}. Was aufgenommen wurde, bleibt lesbar.',
    'Mach dort Platz oder nimm einen Ordner auf einem anderen Datenträger, dann beginne eine neue Aufnahme.',
  ],
  bag_empty_file: [
    '{path} ist leer oder nach den ersten Bytes abgeschnitten: Darin ist nichts zu lesen oder zu retten.',
    'Hole eine Kopie zurück.',
  ],
  bag_exists: [
    '{folder} gibt es schon; ein Bag braucht einen neuen Ordner.',
    'Nimm einen anderen.',
  ],
  bag_folder_not_made: [
    'Der Ordner {folder} kann nicht angelegt werden ({problem}).',
    'Nimm einen Ort, an dem du schreiben darfst.',
  ],
  bag_gone: [
    '{path} ist nicht mehr lesbar ({problem}).',
    'Wurde das Bag umbenannt, entfernt oder sein Datenträger abgezogen? Nenne den Ort, an dem es jetzt ist.',
  ],
  bag_imported: ['{bag} enthält {messages:count Nachricht|Nachrichten}[:{notes:problems}]'],
  bag_lacks_files: [
    'In {path} fehlt, was die metadata.yaml dort aufführt: {files:list}.',
    'Hole die Dateien zurück, gib ihnen wieder diese Namen oder lies einzeln, was noch da ist.',
  ],
  bag_live: ['das Bag wird gerade aufgenommen; dies ist der Stand bis jetzt'],
  bag_moved: [
    'Das Bag {folder} wurde während der Aufnahme umbenannt oder entfernt; das Aufgenommene ist an seinem neuen Ort vollständig.',
    'Beginne eine neue Aufnahme.',
  ],
  bag_no_index: ['{file} hat keinen Index: Die Aufnahme brach ab oder verlor ihren Datenträger'],
  bag_not_begun: ['{file} endet vor dem ersten Eintrag: Die Aufnahme brach ab'],
  bag_not_repaired: [
    'Das Bag {path} lässt sich nicht reparieren ({problem}).',
    'Mach dort Platz, oder kopiere das Bag dorthin, wo du schreiben darfst, und repariere die Kopie.',
  ],
  bag_not_written: [
    'Das Bag {folder} kann nicht geschrieben werden ({problem}); was aufgenommen wurde, bleibt lesbar.',
    'Prüfe diesen Ordner, dann beginne eine neue Aufnahme.',
  ],
  bag_trajectory: ['{trajectory} aus {bag}'],
  bag_unreadable: ['{path} ist nicht lesbar ({problem}).', 'Prüfe die Zugriffsrechte.'],
  bag_without_files: [
    '{path} enthält keine MCAP-Datei.',
    'Nenne den Ordner eines Bags; ein Bag anderer Art wird durch einen Import zu einem des Labors.',
  ],
  bag_without_model: [
    '{path} nennt keinen Roboter; nichts darin lässt sich mit einer Datei vergleichen.',
  ],
  bag_without_robots: [
    'Kein Roboter eines Labors ist darin, sondern {topics:list}[ und {more:integer} weitere]',
  ],
  bare_flange: [
    'Die Bewegung schließt einen Greifer, und {robot} trägt keinen.',
    'Wähle den Greifer, für den sie ist.',
  ],
  begins_at_rest: ['beginnt in Ruhe'],
  begins_inside: [
    'Der Arm beginnt innerhalb der Fläche {other}.',
    'Berichtige die erste Zeile oder den Platz des Roboters in der Szene.',
  ],
  beyond_measure: [
    'Abstände werden bis {most:length} gemessen; {limit:length} lässt sich von mehr nicht unterscheiden. Nimm weniger.',
  ],
  beyond_most: ["'{text}' liegt jenseits von {limit:measure}; erwartet: {expected:problem}."],
  body_stopped: [
    "Von '{file}' kam {wait:time} lang nichts; nichts wurde behalten.",
    'Sende die Datei noch einmal.',
  ],
  bytes_not_of_type: [
    '{size:bytes} sind keine Nachricht vom Typ {type}: {why:problem}.',
    'Prüfe, ob beide Seiten dieselben Nachrichtentypen haben.',
  ],
  call_timed_out: [
    '{key} hat nicht innerhalb von {timeout:time} geantwortet.',
    'Prüfe, ob der Knoten läuft, und versuche es noch einmal.',
  ],
  called_by_another_key: [
    'Der Dienst {service} wird über seinen Schlüssel {key} aufgerufen und nicht als {found}.',
  ],
  calls_full: ['Zu viele Aufrufe auf einmal.', 'Warte auf ihre Antworten.'],
  calls_wait: [
    'Beim Dienst {service} warten schon {waiting:integer} Aufrufe; er nimmt keine weiteren an.',
    'Warte auf eine Antwort, dann rufe noch einmal auf.',
  ],
  came_as_form: ["'{file}' kam als Formular.", 'Sende die Datei selbst als Inhalt der Anfrage.'],
  came_off_cup: [
    '{object} hat sich vom Sauger gelöst: {mass:mass}, Reibung {friction:number}, nötig {friction_needed:number}.',
  ],
  came_off_magnet: [
    '{object} hat sich vom Magneten gelöst: {mass:mass}, Reibung {friction:number}, nötig {friction_needed:number}.',
  ],
  candidate: ["'{variable}' ({size}): {reasons:reasons}"],
  cannot_hold_fixed: ['{robot} kann {object} nicht halten: Es steht fest im Raum.'],
  capped: ['{found:problem}; deshalb gibt es insgesamt höchstens {most:number} Punkte.'],
  categories: ['eines von {names:either}'],
  cell_not_scene: [
    '{place:problem} ist eine Zelle und keine Szene.',
    'Erstelle ein System daraus.',
  ],
  cells_unreadable: ['ihre Zellen sind nicht lesbar ({error})'],
  certificate_early: [
    'Das Zertifikat {path} gilt ab {begin} UTC; nach der Uhr dieses Rechners ist es {now}.',
    'Stelle die Uhr.',
  ],
  certificate_ends: ['Das Zertifikat {path} läuft am {day} ab', 'Mach ein neues.'],
  certificate_expired: ['Das Zertifikat {path} ist am {end} UTC abgelaufen.'],
  certificate_lasts: ['Das Zertifikat {path} gilt bis {day}'],
  certificate_without_key: [
    'HTTPS braucht ein Zertifikat und seinen Schlüssel; eines von beiden fehlt.',
    'Nenne beide.',
  ],
  changed_mark: [
    '[{test}: ]{before:number} wurde von einer Lehrperson zu {after:number} geändert.',
  ],
  changed_mark_not_read: [
    "{student}, {test}: '{found}' ist keine Zahl; es bleibt bei den Punkten des Tests.",
  ],
  changed_mark_out_of_range: [
    '{student}, {test}: {found:number} liegt nicht zwischen {least:number} und {most:number}; es bleibt bei den Punkten.',
  ],
  channel_shape: [
    "{channel:choice gripper=Die Greiferzustände|derived=Die abgeleiteten Kanäle} von '{id}' sind {size}; erwartet wird {expected}, mit einer Zeile für jede Zeile der Trajektorie.",
  ],
  check_ended_early: [
    'Die Prüfung endete vorzeitig (Status {status:integer}), wie es bei zu viel Speicher oder Zeit geschieht.',
    'Prüfe eine kürzere Bewegung, oder prüfe sie auf deinem eigenen Rechner.',
  ],
  check_failed: [
    'Die Prüfung ist gescheitert; das Protokoll des Gateways auf dem Rechner des Labors sagt, warum.',
  ],
  check_not_ready: [
    'nicht bereit: {count:count Befund spricht|Befunde sprechen} dagegen[, der erste bei {time:time}]: {first:problem}.',
  ],
  check_out_of_memory: ['Die Prüfung braucht mehr als {most:bytes} Speicher.'],
  check_ready: [
    'bereit: nichts spricht dagegen[; {warnings:count Warnung|Warnungen}][; {unknown:count Bedingung|Bedingungen} nicht bekannt]',
  ],
  check_too_slow: [
    'Die Prüfung dauerte länger als {limit:time}, weil dieser Rechner beschäftigt oder die Bewegung lang ist.',
    'Halte an, was läuft, und prüfe noch einmal.',
  ],
  checked_at_once: [
    '{passed:count Test ist|Tests sind} erfüllt[, an {lost:count Test|Tests} ist noch zu tun].',
  ],
  claim: [
    'Das sagt nur, was das Modell zeigt: nominelle Kinematik, konvexe Hüllen der Glieder, starre Körper, die Gegenstände der Szene und vorgegebene Gelenkwinkel. Es kennt keine Momente, keine eigenen Grenzen der Steuerung, keine Bremsen, keine Kabel, keine Menschen und nicht den Weg des Arms zur ersten Zeile. Fahre zuerst langsam, mit der Hand am Not-Halt.',
  ],
  class_file_too_large: ['{file} hat mehr als {most:bytes}; das ist keine Datei einer Klasse.'],
  class_is_locked: [
    '{who} hat die Punkte dieser Klasse gesperrt; nimm das zurück, bevor du welche änderst.',
  ],
  class_no_json: ['{file} ist kein JSON: {why:problem}.', 'Bewerte die Klasse noch einmal.'],
  class_not_read: [
    'Die Klasse ist nicht lesbar: {why:problem}.',
    'Bewerte die Klasse noch einmal.',
  ],
  class_run_ended: [
    'Der Lauf endete, bevor er fertig war ({why:problem}); starte ihn noch einmal.',
  ],
  class_runs: ['Ein anderer Lauf schreibt die Ergebnisse in {folder}; warte, bis er zu Ende ist.'],
  clear_again: ['wieder frei; Abspielen macht hier weiter'],
  clear_and_stop_first: ['warte, bis alle Mitglieder frei sind, dann stoppe'],
  client_closed: ['Dieser Client des Labors ist geschlossen.', 'Öffne einen neuen: Lab().'],
  client_without_router: [
    'Die Bridge hat Schlüssel ({folder}) und mode client, aber keinen Router.',
    'Nenne mit dem Parameter connect den Router, oder lass mode weg.',
  ],
  clock: [
    "[ihre Überschrift '{heading}' bedeutet Zeit][sie verläuft wie '{other}'][{rises:choice far=sie steigt gleichmäßig, weiter als sich ein Gelenk dreht|round=sie steigt gleichmäßig in runden Schritten|irregular=sie steigt in ungleichen Schritten wie aufgezeichnete Zeiten|even=sie steigt durchgehend in gleichen Schritten}]",
  ],
  clock_set_back: [
    'Bei {time:time} wurde die Uhr um {by:time} zurückgestellt; {then:choice even=die Zeiten dieses Berichts laufen gleichmäßig weiter|piled=was bis zum Einholen aufgenommen wurde, steht an diesem Zeitpunkt}',
  ],
  clocks_agree: ['Uhren: {offset:time} zwischen dem Gateway und diesem Rechner'],
  clocks_differ: [
    'Uhren: {offset:time} zwischen dem Gateway und diesem Rechner; erwartet: höchstens {limit:time}',
    'Schalte auf beiden die Zeitsynchronisation ein.',
  ],
  closed_unseen: [
    '{robot} sollte schließen, während die Physik nicht lief, und schließt, wo es jetzt ist.',
    'Spiel die Bewegung ab einer Stelle ab, bevor es schließt.',
  ],
  coarse_times: [
    'einfache Genauigkeit (single) kennt solche Zeiten nur in Schritten von {value:number}; sichere sie als double',
  ],
  codes_wrong: [
    '{count:count Code war|Codes waren} falsch.',
    'Warte, bis das Gerät einen neuen zeigt.',
  ],
  collides_at_start: [
    '{link}[ (hält {held})] berührt schon in der ersten Zeile {kind:choice self=das eigene Glied|robot=den Roboter|object=den Gegenstand|surface=die Fläche} {other}[ ({other_link})], bei {point:position}, {value:length} tief.',
    'Beginne die Bewegung anderswo, oder verschiebe, was dort steht.[ {advice:problem}.]',
  ],
  collision: [
    '{link}[ (hält {held})] berührt {kind:choice self=das eigene Glied|robot=den Roboter|object=den Gegenstand|surface=die Fläche} {other}[ ({other_link})] bei {point:position}, {value:length} tief.',
    '{kind:choice self=Beuge den Arm dort weniger, oder nimm eine andere Konfiguration.|robot=Lass einen der beiden warten, oder gib ihnen Wege, die sich nicht kreuzen.|surface=Führe den Weg dort höher, oder füge einen Punkt darüber ein.|object=Führe den Weg um den Gegenstand herum, oder verschiebe ihn.}[ {advice:problem}.]',
  ],
  column_not_finite: [
    "'{column}' der Trajektoriendatei enthält NaN oder Inf.",
    'Wandle den Workspace noch einmal um.',
  ],
  column_of_time: [
    "'t' der Trajektoriendatei zählt nicht i / {rate:number}.",
    'Wandle den Workspace noch einmal um.',
  ],
  column_shape: [
    "'{column}' der Trajektoriendatei ist {size}; nach frame_count und joint_names wird {expected} erwartet.",
    'Wandle den Workspace noch einmal um.',
  ],
  columns_applied: ["Wie gewünscht wurden die Spalten {columns} von '{variable}' genommen."],
  command_jumps: [
    'Der Gelenkbefehl springt: {joint} um {value:angle} in {passed:time}; erwartet: höchstens {limit:turn_rate}.',
    'Fahre in kleineren Schritten dorthin, oder unterbrich den Strom für {silence:time}.',
  ],
  command_refused: ['Ein Gelenkbefehl wurde nicht angenommen: {why:problem}'],
  command_too_fast: [
    'Der Gelenkbefehl bewegt {joint} mit {value:turn_rate}; erwartet: höchstens {limit:turn_rate}.',
  ],
  commands_ended: ['es kommt kein Gelenkbefehl mehr'],
  commands_ignored: [
    'Der Roboter ist im Zustand „{state:state}“ und beachtet die Gelenkbefehle nicht.',
    'Abspielen setzt sie fort, ebenso ein Strom, der nach {silence:time} neu beginnt.',
  ],
  commas_twice: [
    'Kommas sind Dezimalzeichen und trennen zugleich die Spalten: Jede Zeile hat {count:integer} Werte[ unter {headings:count Überschrift|Überschriften}]; exportiere die Tabelle mit Semikolons zwischen den Spalten',
  ],
  compressed_cut_short: ['ihr Ende fehlt'],
  compressed_damaged: ['die komprimierten Daten sind beschädigt: {problem}'],
  config_and_keys: [
    'Die Bridge hat zenoh_config ({file}) und keys ({folder}); erwartet wird nur eines, denn jedes legt fest, wer sich verbinden darf.',
  ],
  contents_left_out: [
    '{objects:count Gegenstand|Gegenstände} und {surfaces:count Fläche|Flächen} bleiben weg: Es läuft keine Physik.',
  ],
  contents_not_back: ['Vom letzten Lauf bleibt weg:{all:problems}'],
  continuous: ['stetig'],
  converted_unit: [
    "Die Datei nennt für '{variable}' die Einheit {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}[ ('{source}')]; die Werte wurden in Radiant umgerechnet.",
  ],
  converter_failed: [
    "Der Konverter ist an '{file}' gescheitert ({error}); das ist ein Fehler des Konverters.",
    'Sichere nur die Trajektorie, und melde den Fehler mit der Datei.',
  ],
  coordinator_restarted: ['der Koordinator wurde neu gestartet; Abspielen macht hier weiter'],
  copies: ["'{variable}' wurde genommen; dieselben Zahlen stehen in {others:list}."],
  copy_kept: ['Eine Kopie bleibt als {file}'],
  counted_numbers: ['eine Liste mit {count:count Zahl|Zahlen}[ {limits:problem}][ ({unit})]'],
  counts: [
    "'{variable}' ist nicht in Radiant: {why:problem}.",
    'Sag, wie viele Zählschritte eine Umdrehung sind, {counts:integer} oder eine andere Zahl.',
  ],
  counts_down: ["'{term}' zählt nicht von einer Zahl zu einer größeren"],
  counts_of_what: ['counts braucht die Zählschritte einer Umdrehung, etwa counts:4096'],
  counts_stated: [
    "'{source}' nennt für '{variable}' die Einheit {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}, und die Datei sagt nicht, wie viel davon eine Umdrehung ist.",
    'Sag, wie viele Zählschritte eine Umdrehung sind, oder speichere Radiant.',
  ],
  course_leads_away: ['Die Plattform nennt eine Adresse auf einem anderen Rechner: {address}.'],
  course_offers_not: [
    'Die Plattform gibt diesem Labor {what:choice members=die Liste der Studierenden|scores=die Bewertungen} nicht frei.',
    'Erlaube es in den Einstellungen des Werkzeugs auf der Plattform, und öffne das Labor noch einmal aus dem Kurs.',
  ],
  course_silent: [
    'Die Plattform {issuer} antwortet nicht wie erwartet: {why:problem}.',
    'Versuche es gleich noch einmal.',
  ],
  create_system: ['das System {system} erstellen'],
  cut_before_checksum: ['eine komprimierte Variable ist vor ihrer Prüfsumme abgeschnitten'],
  cycle_time: ['Der Zyklus dauert {value:time}; erwartet: höchstens {limit:time}.'],
  damaged_trajectory: [
    "'{file}' ist beschädigt ({error}).",
    'Wandle den Workspace noch einmal um.',
  ],
  damaged_version: [
    "Version {version:integer} von '{id}' wurde nach {folder} verschoben: {why:problem}.",
  ],
  database_damaged: [
    '{path} ist beschädigt ({problem}).',
    'Hole eine Kopie zurück oder lies weiter, was noch da ist.',
  ],
  degrees: [
    "'{variable}' ist anscheinend in Grad[{percent:choice percent= oder in Prozent, da mehrere Spalten von 0 bis 100 laufen}]: {why:problem}; erwartet wird Radiant.",
    'Rechne mit deg2rad in Radiant um, oder nenne die Einheit, wenn alles in Grad ist. Ist es doch in Radiant, nenne diese Einheit.',
  ],
  deleted_already: [
    "'{id}' ist schon gelöscht.",
    'Hole eine Version zurück, wenn du sie wieder brauchst.',
  ],
  derivative_of: [
    "sie enthält die {order:choice first=Geschwindigkeiten|second=Beschleunigungen} von '{other}'",
  ],
  devices_full: [
    'Zu viele Geräte warten darauf, gekoppelt zu werden.',
    'Versuche es später noch einmal.',
  ],
  did_not_run: ['stand etwa {frozen:integer} s lang still, bis vor {ago:integer} s'],
  died: [
    'brach ab[ ({last_exit:problem})] und wurde vor {ago:integer} s neu gestartet; nichts ging verloren',
  ],
  died_and_looks: [
    'brach ab[ ({last_exit:problem})] und wurde vor {ago:integer} s neu gestartet; was verloren ging, wird noch ermittelt',
  ],
  died_and_lost: [
    'brach ab[ ({last_exit:problem})] und wurde vor {ago:integer} s neu gestartet; verloren: {lost:problem}',
  ],
  disappeared: ['{name} ist nicht mehr da'],
  discontinuity: [
    '{joint} springt um {value:measure} von Zeile {first_row:integer} zur nächsten ({time:time}); seine übrigen Schritte bleiben unter {usual:measure}.',
    'Suche nach einem Stück, das fehlt oder an der falschen Stelle angefügt wurde.',
  ],
  disk_almost_full: [
    'Datenträger: {free:bytes} frei; erwartet: mindestens {least:bytes}',
    'Mach Platz: Bags und Hochgeladenes brauchen ihn.',
  ],
  disk_room: ['Datenträger: {free:bytes} frei'],
  display_taken: ["Die Anzeige '{id}' gehört einer anderen Seite.", 'Wähle eine eigene Kennung.'],
  display_too_far: [
    "Die Anzeige '{id}' ist bei {at:length}; erwartet werden endliche Zahlen bis {most:length}.",
  ],
  dissolve_systems: ['{systems:list} auflösen'],
  dissolved: ['{system} ist aufgelöst'],
  document_type: [
    '{file} legt einen Dokumenttyp fest, den eine URDF nicht braucht.',
    'Entferne die Zeilen <!DOCTYPE ...> und <!ENTITY ...>.',
  ],
  domain_taken: [
    'In der ROS-Domain {domain:integer} läuft schon ein Labor[ (Prozess {pid:integer})].',
    'Nimm dieses, beende es, oder setze ROS_DOMAIN_ID auf eine andere Zahl.',
  ],
  doubtful_name: [
    "'{variable}' wurde als Gelenkwinkel genommen, aber {why:problem}.",
    'Prüfe, ob du das meinst; Gelenkwinkel heißen meist q.',
  ],
  doubtful_values: [
    "'{variable}' wurde als Gelenkwinkel genommen, aber {why:reasons}.",
    'Sieh dir die Bewegung an, bevor du ihr traust, und sichere die Gelenkwinkel als q.',
  ],
  draft_of_another: [
    'Der Entwurf gehört nicht {owner}.',
    'Veröffentliche ihn unter dem Namen, unter dem er hochgeladen wurde.',
  ],
  driven_by: ['gesteuert vom System {system}'],
  driven_by_system: [
    "Der Roboter wird vom System '{system}' gesteuert.",
    'Befiehl dem System, oder löse es auf, um den Roboter freizugeben.',
  ],
  drops_object: [
    'Der Greifer lässt {other} in der Luft los; es fällt {value:length}.',
    'Öffne ihn dort, wo das Objekt auf etwas steht.',
  ],
  earned_standing: [
    'Eine Bewegung, die stillsteht, bekommt hier {points:number} von {of:number} Punkten.',
    'Lass diesen Test einen verlangen, für den etwas zu tun ist.',
  ],
  element_lacks: [
    "{file}: <{element} name='{name}'> hat kein <{tag} {attribute}=...>.",
    'Ergänze es.',
  ],
  element_unnamed: [
    "{file}: Ein <{element}>[ von '{parent}' zu '{child}'] hat keinen Namen.",
    'Gib ihm einen.',
  ],
  empty: [
    "'{variable}' ist leer ({size}).",
    'Führe das Programm aus, das sie füllt, bevor du sie sicherst.',
  ],
  empty_cells: ['in Zeile {line:integer} sind Zellen leer, in denen Zahlen erwartet werden'],
  empty_store_name: ['Ein Name in der Ablage ist leer; erwartet wird mindestens ein Zeichen.'],
  empty_subsystem: ['der Teil mit dem Inhalt der Objekte ist leer'],
  empty_upload: ["'{file}' ist leer.", 'Sichere die Datei noch einmal und sende sie.'],
  empty_value: ['{what:problem} ist leer; erwartet: {expected:problem}.'],
  encrypted_file: ['Die Datei ist verschlüsselt; bitte um eine offene.'],
  end_effector_left_out: ['Der Endeffektor {end_effector} fehlt in der Liste: {why:problem}'],
  endless_hold: [
    "nichts sagt, bis wann bei frame {frame:integer} gewartet wird; ergänze wait, etwa 'object cube_1 free', oder after, etwa 'kr6_1.frame 120'",
  ],
  endpoint_taken: [
    'Die Bridge kann {endpoints:list} nicht benutzen: Ein anderes Programm hat diesen Port, vielleicht ein Labor, das noch läuft.',
    'Beende es, oder wähle mit dem Parameter listen einen anderen Port.',
  ],
  ends_at_rest: ['endet in Ruhe'],
  ends_early: ['sie endet mitten in der Kennung eines Elements'],
  ends_first: ['{robot} muss vorher enden'],
  entry: [
    '{place:problem}, {one:choice part=Teil|hold=Halt|member=Mitglied|robot=Roboter|object=Gegenstand|surface=Fläche|system=System} {number:integer}',
  ],
  enumeration: ['eine Aufzählung: {names:list}'],
  exited: ['Exit-Code {exit_code:integer}'],
  failed_hand_over: [
    'Der Greifer bleibt um {other} geschlossen, während ein anderer Roboter es wegnimmt[: {why:problem}].',
    'Öffne den Greifer des Gebers, nachdem der des Nehmers geschlossen hat und bevor einer weiterfährt.',
  ],
  falls: [
    '{object} fällt um {value:length}, wenn es losgelassen wird; erwartet werden höchstens {limit:length}.',
  ],
  fault: ['Das Labor ist an {service} gescheitert ({error}); Näheres steht in seinem Protokoll.'],
  few_rows: ['sie hat nur {rows:count Zeile|Zeilen}'],
  field: ['{place:problem}: {key}'],
  field_below: ['{place:problem}, {key}'],
  field_changed: [
    'Das Feld {field} von {type} ist im Bag von anderer Art als hier.',
    'Spiele es mit dem Labor ab, das es aufgenommen hat.',
  ],
  field_missing: ["'{field}' fehlt"],
  field_out_of_range: [
    "'{field}' ist {found}; erwartet wird [mindestens {least:exact}][höchstens {most:exact}]",
  ],
  field_refused: ["'{field}' ist {found}: {why:problem}"],
  field_unknown: ["'{field}' gibt es nicht"],
  file_assigned: ['{file} hat eine Lehrperson dieser Abgabe zugeordnet.'],
  file_changed_meanwhile: [
    'sie wurde während des Lesens geändert; sichere sie vollständig und versuche es noch einmal',
  ],
  file_missing: ['Die Datei {file} gibt es nicht.', "[Meinst du '{close}'?]"],
  file_name_length: [
    'Der Name der Datei hat {count:count Zeichen|Zeichen}; die Grenze ist {most:integer}.',
    'Gib ihr einen kürzeren.',
  ],
  file_name_signs: [
    'Der Name der Datei, {file}, enthält Zeichen, die sich nicht darstellen lassen.',
    'Gib ihr einen anderen, aus Buchstaben, Ziffern und Satzzeichen.',
  ],
  file_reader_failed: ['das Leseprogramm ist an ihr gescheitert ({error})'],
  file_unreadable: ['{file} ist nicht lesbar: {why:problem}.'],
  file_unwritable: [
    '{file} kann nicht geschrieben werden: {why:problem}.',
    '[{remedy:choice room=Mach dort Platz, oder nimm einen anderen Datenträger.|may=Prüfe, wer dort schreiben darf.}]',
  ],
  finger_beyond: [
    'Der Finger {finger} soll auf {position:number}; erwartet wird {low:number} bis {high:number}.',
  ],
  fingers_still: [
    'Kein Gelenk in {file} bewegt sich, aber {facts} sagt, dass Finger greifen.',
    'Gib den Fingern bewegliche Gelenke, oder schreibe gripper: cup, magnet oder none.',
  ],
  finite_count: ['{count:count endliche Zahl|endliche Zahlen}'],
  finite_numbers: ['Jede Zahl muss endlich sein'],
  fixed_object: [
    '{object} steht fest im Raum.',
    'Wähle einen Gegenstand, der sich bewegen lässt.',
  ],
  fixed_with_mass: [
    'fixed ist true, und dazu ist eine Masse angegeben.',
    'Lass eines von beiden weg.',
  ],
  folder_in_use: ['{folder} enthält schon etwas.', 'Nimm einen neuen Ordner.'],
  folder_of_another: ['{path} gehört jemand anderem; erwartet wird ein Ordner, der dir gehört.'],
  folder_unusable: [
    '{path} ist nicht verwendbar: {problem}; erwartet wird ein Ordner oder ein Pfad, an dem einer angelegt werden kann.',
  ],
  follows_commands: ['folgt Gelenkbefehlen'],
  for_another_model: [
    "'{trajectory}' ist für {found}, und {robot} ist {model}; lade sie in einen Roboter {found}.",
  ],
  frame_kind: [
    'Ein Paket beginnt mit {frame:integer}; erwartet wird 1 bis 4.',
    'Siehe docs/link.md.',
  ],
  frame_length: [
    'Ein Paket der Art {frame:integer} hat {size:count Byte|Bytes}; erwartet: {expected:integer}.',
  ],
  frame_rate_not_positive: [
    "Die Rate von '{id}' ist {value:number}; erwartet wird eine Zahl von Zeilen pro Sekunde über 0.",
  ],
  frame_short: [
    'Ein Paket der Art {frame:integer} hat {size:count Byte|Bytes}; erwartet: {least:integer} oder mehr.',
  ],
  from_reference: [
    '{what:choice tool=Das Werkzeug|joint=Ein Gelenk} ist {how:choice rms=im Mittel (RMS)|most=bis zu} {value:measure} von der Musterlösung entfernt; erwartet: höchstens {limit:measure}.',
  ],
  function_handle: ['eine Funktion enthält keine Werte, bevor sie aufgerufen wird'],
  gateway_differs: [
    'Gateway {url}: Version {version}; dieser Rechner hat {own}',
    'Bring beide auf eine Version, dann lade die Seiten neu.',
  ],
  gateway_disk_full: [
    "Das Gateway hat keinen Platz für '{file}' ({why:problem}); nichts wurde behalten.",
    'Bitte den Betrieb, dort Platz zu schaffen, und versuche es dann noch einmal.',
  ],
  gateway_fault: [
    'Das Gateway ist an dieser Anfrage gescheitert.',
    'Sein Protokoll auf dem Rechner des Labors sagt, warum.',
  ],
  gateway_same: ['Gateway {url}: Version {version}, wie dieser Rechner'],
  gateway_silent: [
    'Gateway {url}: {why:problem}',
    'Starte das Labor; für andere Rechner mit Schlüsseln oder einem Zertifikat, und mit seinem Port offen in der Firewall.',
  ],
  gateway_without_lab: [
    'Dieses Gateway hat kein Labor.',
    'Starte es mit dem Endpunkt eines Labors.',
  ],
  geometry_empty: ['{place:problem}: Eine <geometry> ist leer; erwartet: {known:either}.'],
  geometry_unknown: [
    '{place:problem}: Eine <geometry> enthält <{tag}>; erwartet: {known:either}.',
  ],
  go_to_place: ['an den Ort {place} gehen'],
  goal_lost: [
    '{robot} steht, wo er war: Das Ziel oder der Strom von Gelenkbefehlen, dem er folgte, endete mit seinem Prozess.',
    'Sende es noch einmal.',
  ],
  grade_to_repeat: [
    '{student} hat keine Note: Die Prüfung ist zu wiederholen.',
    'Starte denselben Befehl noch einmal.',
  ],
  grasped: [
    '{robot} greift {object} bei {value:time}[; erwartet: nach {since:time}][; erwartet: vor {until:time}].',
  ],
  grasped_late: ['{object} wird bei {value:time} gegriffen; erwartet: vor {limit:time}.'],
  grasps_missing: [
    'Nach {limit:time} fehlen noch Griffe: {objects:list} in der Hand von {robots:list}.',
  ],
  grasps_nothing: [
    'Der Greifer schließt um nichts[: {why:problem}].',
    'Schließ ihn dort, wo ein Gegenstand ist; die Abstände zeigen, wie weit er entfernt war.',
  ],
  grip_objects: ['{robots:list} nach {objects:list} greifen lassen'],
  gripper_applied: ["Der Greifer wurde aus '{gripper}' genommen."],
  gripper_beside: [
    "'{variable}' ({size}) könnte die Zustände des Greifers enthalten; sie wurde nicht genommen.",
    'Nimm sie als Greifer, oder sichere sie als letzte Spalte.',
  ],
  gripper_between: [
    'In der Spalte des Greifers liegen Werte zwischen ihren Enden {first:number} und {last:number}, nämlich {count:integer} von {rows:integer}; {side:choice above=über|below=unter} {threshold:number} gilt der Greifer als geschlossen.',
    'Sichere 0 für offen und 1 für geschlossen, ohne Rampen. Ist die Spalte ein Gelenk, nimm nur die Gelenke.',
  ],
  gripper_assumed: [
    "Die letzte Spalte, '{heading}', gilt als der Greifer: 0 offen, 1 geschlossen.",
    'Ist sie keiner, lass sie aus der Matrix weg.',
  ],
  gripper_opens: [
    "Nach der Überschrift '{heading}' ist 1, wo der Greifer offen ist; die Spalte wurde umgedreht.",
    'Kehre sie um, um das zu bestätigen, oder speichere 1 für geschlossen.',
  ],
  gripper_constant: [
    'Die Spalte des Greifers ist durchweg {value:number}; der Greifer bleibt offen.',
  ],
  gripper_range: [
    'Die Spalte des Greifers geht von {first:number} bis {last:number}.[ Das ist {meaning:choice states=0 für offen und 1 für geschlossen|position=eine Stellung von 0 (offen) bis 255 (geschlossen), wie bei Robotiq|width_m=eine Öffnungsweite in m, größer heißt offen|percent=Prozent|width_mm=eine Öffnungsweite in mm, größer heißt offen}.] {side:choice above=Über|below=Unter} {threshold:number} gilt der Greifer als geschlossen.',
    'Sichere 0 für offen und 1 für geschlossen, oder sag, dass größer offen heißt.',
  ],
  gripper_unmoved: [
    'Die Spalte des Greifers ist durchweg {value:number}; das heißt weder offen noch geschlossen, und der Greifer bleibt offen.',
    'Sichere 0 für offen und 1 für geschlossen. Ist die Spalte ein Gelenk, wähle einen Roboter, der es hat, oder nimm nur die Gelenke.',
  ],
  halted_by_contact: ['[{held} in der Hand des Roboters][{link}] berührt {other}'],
  handed_in_late: [
    '{days:count Tag|Tage} zu spät abgegeben: {share:share} der Punkte sind abgezogen.',
  ],
  handed_in_on_time: ['Rechtzeitig abgegeben.'],
  handed_over: ['{count:count Trajektorie|Trajektorien} von {owner} gehören jetzt {to}.'],
  hand_of_its_own: [
    "Der Roboter '{robot}' hat eine eigene Hand.",
    'Lass den Endeffektor leer, oder importiere den Roboter noch einmal ohne seine Hand.',
  ],
  has_derivative: ["'{other}' ist ihre Ableitung"],
  has_key: [
    `{name} hat schon einen Schlüssel, mit der Rolle {role:choice ${ROLE}}.`,
    'Nimm diesen zuerst zurück.',
  ],
  has_no_key: ['{name} hat in {folder} keinen Schlüssel[; einen haben: {known:list}].'],
  headings_again: [
    'in Zeile {line:integer} stehen die Überschriften {headings:list} noch einmal: Die Datei enthält mehrere Aufnahmen; behalte eine davon',
  ],
  held: ['{object} wird von {since:time} bis {until:time} gehalten.'],
  held_by_another: ['{name} wird von einem anderen Roboter gehalten'],
  held_by_wait: ['wartet auf sein System'],
  held_for: ['{object} wird {value:time} lang gehalten; erwartet: {limit:time}.'],
  held_in_part: ['held_by und in_hand gehören zusammen.', 'Gib beide an oder keines.'],
  hidden_without_hint: [
    'Der Test ist verborgen und hat keinen Hinweis; Studierende erfahren nichts daraus. Ergänze hint:',
  ],
  holds_already: ['{robot} hält schon {object}.', 'Lass das zuerst los.'],
  holds_nothing: ['{robot} hält nichts.'],
  holds_two: ['{place:problem}: {robot} hält zwei Gegenstände.', 'Lass einen weg.'],
  hollow_mesh: [
    'Ein hohles Netz kann sich nicht bewegen.',
    'Setze es aus konvexen Teilen zusammen.',
  ],
  home_size: [
    '{file}: home_deg hat {count:count Wert|Werte}; erwartet: {joints:integer}, einer je beweglichem Gelenk.',
  ],
  http_error: ['Die Anfrage wurde nicht angenommen: {detail:problem}.'],
  https_unusable: [
    '{certificate} und {key} taugen nicht für HTTPS: {why:problem}.',
    'Erwartet wird ein Zertifikat mit seinem Schlüssel ohne Passwort (PEM).',
  ],
  illegal_event: [
    `{event:choice ${COMMANDS}} geht im Zustand „{state:state}“ nicht[: {reason:problem}][; möglich ist jetzt: {possible:list ${COMMANDS}}]`,
  ],
  in_brackets: ['Schreibe [[{text}]]'],
  in_cell: ['in einer Zelle mit {robots:count Roboter|Robotern}'],
  in_empty_room: ['in einem leeren Raum mit Boden'],
  in_lab: [
    'im Labor, wie es war, mit {objects:count Gegenstand|Gegenständen} und {robots:count Roboter|Robotern}',
  ],
  in_place: ['{place:problem}: {why:problem}.'],
  in_quotes: ['Schreibe "{text}" in Anführungszeichen'],
  in_scene: ['in der Szene {scene} mit {objects:count Gegenstand|Gegenständen}'],
  index_out_of_range: [
    'es gibt die {axis:choice row=Zeilen|column=Spalten} 1 bis {count:integer}',
  ],
  inflates_too_far: ['{file} ist entpackt größer als {most:bytes}.'],
  inflates_too_much: ['entpackt ist sie größer als {limit:bytes}'],
  insecure_with_keys: [
    'Die Seiten können nicht zugleich für alle offen sein und Schlüssel haben.',
    'Lass eines von beiden weg.',
  ],
  inside_container: [
    "Die Trajektorie ist nicht eine Matrix: {pieces:choice joints=Jedes Gelenk ist eine eigene Variable|segments=Sie liegt in Abschnitten|samples=Sie liegt in einzelnen Messpunkten}, '{variable}' bis '{last}'[, dazu {more:integer} weitere, zu viele zum Aufzählen].",
    'Füge sie zusammen.',
  ],
  invert_applied: ['Wie gewünscht heißen größere Werte des Greifers offen.'],
  jerk_limit: [
    '{joint} hat einen Ruck von {value:measure}; der Hersteller nennt {limit:measure}.',
    'Plane mit einem glatten Zeitgesetz wie einem Polynom fünften Grades, oder gib der Bewegung mehr Zeit.',
  ],
  jerks_in_limits: ['Ruck unter seinen Grenzen, bis auf {tolerance:share}'],
  joint_axis: ["{place:problem}: Die Achse ist '{axis}'; erwartet wird eine Richtung wie 0 0 1."],
  joint_from: [
    '{joint} ist {instant:choice start=am Anfang|end=am Ende} {value:angle} {origin:choice home=von der Grundstellung|start=von seinem Anfang} entfernt; erwartet: höchstens {limit:angle}.',
  ],
  joint_limit: [
    '{joint} geht in Zeile {row:integer} ({time:time}) auf {value:measure}; sein Bereich ist {lower:measure} bis {upper:measure}; außerhalb ist es in {count:count Zeile|Zeilen}.',
    'Plane die Bewegung innerhalb des Bereichs, oder wähle den Roboter, für den sie gemacht wurde.',
  ],
  joint_names: [
    "Die Gelenke von '{variable}' sind nicht die von {model}.[ Es fehlt: {missing:list}.][ {model} hat kein {unknown:list}.][ Mehrmals vorhanden: {repeated:list}.]",
    'Wähle den Roboter, für den die Bewegung gemacht wurde, oder nenne die Spalten wie der Roboter seine Gelenke: {joints:list}. Spalten einer Tabelle lassen sich auch über ihre Nummern nehmen.',
  ],
  joint_no_velocity: [
    '{place:problem} hat kein <limit> mit einer Geschwindigkeit; erwartet werden lower, upper und velocity (rad, rad/s) aus dem Datenblatt des Roboters.',
  ],
  joint_out_of_range: [
    '{joint} ist {value:angle}[ an Punkt {point:integer}][ bei {time:time}, zwischen zwei Punkten]; erwartet: {lower:angle} bis {upper:angle}.',
  ],
  joint_state_beyond: [
    'Ein Gelenkzustand enthält NaN oder unendlich[ oder eine Zahl jenseits von {most:exact}]; der Arm bleibt, wo er ist.',
  ],
  joint_state_cut: [
    '{size:integer} Bytes enden vor dem Ende des Gelenkzustands, den sie beginnen.',
  ],
  joint_state_size: [
    'Ein Gelenkzustand hat {positions:integer} Positionen und {velocities:integer} Geschwindigkeiten; erwartet: je {joints:integer}.',
  ],
  joint_state_uneven: [
    'Ein Gelenkzustand hat {names:integer} Namen und {values:integer} Positionen oder Geschwindigkeiten; erwartet werden gleich viele.',
  ],
  joint_state_without: ['Einem Gelenkzustand fehlt {missing:list}; er hat {found:list}.'],
  joint_type: ["{place:problem} ist vom Typ '{type}'; erwartet: {known:either}."],
  joints_matched: [
    "Die Spalten von '{variable}' wurden {model} nach den Namen der Gelenke zugeordnet: Spalten {order:list}, in dieser Reihenfolge.[ Weggelassen: {left_out:list}.]",
  ],
  joints_move: ['die Gelenke bewegen {robot} ({model})'],
  joints_of_topic: ['{topic}: {joints:list}'],
  jump_2pi: [
    '{joint} springt um eine volle Drehung ({value:measure}) von Zeile {first_row:integer} zur nächsten ({time:time}).',
    'Entferne den Sprung mit unwrap.',
  ],
  key_file_open: [
    '{path} ist für andere auf diesem Rechner lesbar (Rechte {mode}).',
    'Nimm dieses Recht weg.',
  ],
  key_file_unreadable: ['{path} ist nicht lesbar: {why:problem}.'],
  key_not_text: ['Ein Schlüssel ist kein UTF-8: {why:problem}.'],
  key_too_long: [
    'Ein Schlüssel von {length:count Byte|Bytes} passt nicht in ein Paket von {size:count Byte|Bytes}.',
  ],
  key_twice: [
    "'{key}' steht zweimal da, zum zweiten Mal in Zeile {line:integer}[ von {file}].",
    'Schreibe es nur einmal.',
  ],
  keys_damaged: [
    '{path} ist beschädigt: {why:problem}.',
    'Spiele eine Kopie zurück, oder mach neue Schlüssel.',
  ],
  keys_folder_not_empty: [
    '{folder} gibt es schon, und der Ordner ist nicht leer; nichts wurde geändert.',
    'Nimm einen anderen Ordner, oder entferne diesen: Wer Schlüssel daraus hat, braucht dann neue.',
  ],
  keys_need_tls: [
    'Das Labor hat Schlüssel, und die Bridge soll an {endpoint} erreichbar sein, wo niemand einen zeigen kann.',
    'Nimm {better}, oder lass die Schlüssel weg.',
  ],
  kinematics_agree: [
    "Der Roboter '{variable}'[ ({title})] in der Datei stimmt mit {model} auf {distance:length} überein.",
  ],
  kinematics_differ: [
    "Der Roboter '{variable}'[ ({title})] in der Datei ist nicht {model}:[ Bei gleichen Gelenkwinkeln liegt sein Flansch bis zu {distance:length} und {angle:angle} daneben.][ Er hat {count:count Gelenk|Gelenke} und {model} {joints:integer}.] Die Bewegung kann für einen anderen Roboter gemacht sein, oder mit anderen Nullstellungen der Gelenke.",
    'Wähle den Roboter, für den die Datei gemacht wurde; oder vergleiche die Nullstellungen und die Drehrichtungen der Gelenke mit denen von {model}.',
  ],
  lab_failed_on_file: [
    "Das Labor konnte '{file}' nicht bearbeiten ({error}); an der Datei liegt es nicht.",
    'Wandle die Datei noch einmal um; wiederholt es sich, prüfe Speicher und Grenzen des Rechners.',
  ],
  lab_names: [
    '{file} enthält {names:list}; so heißt, was das Labor zwischen Roboter und Endeffektor setzt.',
    'Benenne es um.',
  ],
  lab_unconnected: [
    'Das Gateway hat keine Verbindung zum Labor.',
    'Prüfe, ob das Labor läuft, und den Endpunkt des Gateways.',
  ],
  lab_without_id: [
    'In dieser ROS-Domain ist ein Labor-Knoten ohne Kennung; dieses Labor, {lab}, beachtet die Roboter nicht, die er aufführt.',
    'Beende diesen Knoten, oder starte ihn mit einer anderen ROS_DOMAIN_ID.',
  ],
  labs_elsewhere: [
    'In der ROS-Domain {domain:integer} antwortet kein Labor; deine sind in {labs:list}.',
    'Setze ROS_DOMAIN_ID auf die Domain von einem davon.',
  ],
  labs_own: ["'{trajectory}' gehört dem Labor; {person} kann sie nur ansehen."],
  labview_segments: [
    'ihr LabVIEW-Kopf endet {count:count Mal|Mal}, bei einer Datei mit nur einem Abschnitt sind es 2; exportiere einen Abschnitt',
  ],
  larger_than_needed: ['{file} ist größer als {most:bytes}; so viel braucht keine Klasse.'],
  largest_of_joint: ['höchstens {value:measure}, {joint}'],
  largest_share: ['höchstens {value:share} der Grenze, {joint} bei {time:time}'],
  largest_step: [
    'größte Änderung der Geschwindigkeit von Zeile zu Zeile {value:measure}, {joint} bei {time:time}',
  ],
  late_at_start: ['nicht rechtzeitig am Start: {robots:list}'],
  late_point: ['Punkt {point:integer} ({time:time}) liegt nicht nach dem Punkt davor'],
  layout_read: ['Die Gelenke wurden gelesen, wie sie in der Datei liegen: {why:problem}.'],
  least_distance: [
    '{link}[ (hält {held})][ von {robot}] kommt {kind:choice self=dem eigenen Glied|robot=dem Roboter|object=dem Gegenstand|surface=der Fläche} {other}[ ({other_link})] bei {time:time} auf {value:length} nah; erwartet: mindestens {limit:length}.',
  ],
  least_room: ['mindestens {value:measure} Spielraum, {joint} bei {time:time}'],
  left_out: ['{topic} weggelassen: {why:problem}'],
  left_room: ['Der Gegenstand ist aus dem Raum gefallen.'],
  left_the_room: [
    '{other} ist aus dem Raum gefallen und wurde entfernt.',
    'Sieh nach, was diesen Gegenstand gestoßen oder fallen gelassen hat.',
  ],
  let_go: ['{object} wurde losgelassen: {robot} bekam einen anderen Endeffektor.'],
  library_failed: [
    '{part:choice hdf5=die HDF5-Bibliothek|bag=das Leseprogramm für Bags|npz=das Leseprogramm für Dateien von NumPy|json=das Leseprogramm für JSON|yaml=das Leseprogramm für YAML|variable=zlib|message=das Leseprogramm für Nachrichten} kann sie nicht lesen ({error})',
  ],
  lies_elsewhere: [
    '{object} liegt bei {point:position} und nicht {side:choice in=in|on=auf} {other}.',
  ],
  lies_from_object: [
    '{object} liegt {value:length} von {other} entfernt; erwartet: höchstens {limit:length}.',
  ],
  lies_from_place: [
    '{object} liegt {value:length} von {place:position} entfernt; erwartet: höchstens {limit:length}.',
  ],
  lies_in_place: ['{object} liegt {side:choice in=in|on=auf} {other}.'],
  lies_on_itself: ["'{object}' kann nicht {side:choice in=in|on=auf} sich selbst liegen."],
  like_percent: ['sie läuft in mehreren Spalten von 0 bis 100 wie Prozent'],
  like_poses: ['sie sieht aus wie Posen des Werkzeugs: {why:problem}'],
  limit_not_stated: [
    '{model} nennt für {joints:list} keine Grenze {of:choice acceleration=der Beschleunigung|jerk=des Rucks}; sie lässt sich nicht messen.',
    'Miss Geschwindigkeiten, oder trage die Grenze in robot.yaml ein.',
  ],
  limit_used: [
    '{joint} nutzt {value:share} {of:choice ranges=seines Bereichs|speeds=seiner größten Geschwindigkeit|acceleration=seiner Beschleunigungsgrenze|jerk=seiner Ruckgrenze}; erwartet: höchstens {limit:share}.',
  ],
  limits_above: ['über {low:exact}[ und höchstens {high:exact}][ und unter {below:exact}]'],
  limits_below: ['unter {below:exact}'],
  limits_between: ['von {low:exact} bis {high:exact}'],
  limits_from: ['von mindestens {low:exact}[ und unter {below:exact}]'],
  limits_not_stated: [
    'höchstens {value:measure}, {joint}; das Modell nennt keine Grenze[ für {missing:list}]',
  ],
  limits_to: ['von höchstens {high:exact}'],
  lines_differ: [
    'Zeile {line:integer} hat {count:count Wert|Werte} und die erste {first:integer}',
  ],
  link_circle: [
    "Das Glied '{link}' hängt unter sich selbst; erwartet wird ein Baum von Gliedern.",
  ],
  link_not_followed: ['Das ist ein Verweis (Link); ihm wird nicht gefolgt.'],
  link_used: [
    'Dieser Link wurde schon benutzt oder ist zu alt.',
    'Bitte deine Lehrkraft um einen neuen.',
  ],
  little_in_degrees: [
    'in Grad bewegen sich die Spalten {columns} je um weniger als 2 Grad; sie könnten schon in Radiant sein, während andere in Grad sind',
  ],
  load_trajectory: ['{trajectory} in {robot} laden'],
  loaded: ['geladen: {trajectory}, {frames:count Zeile|Zeilen}, {duration:time}'],
  loaded_in_part: [
    'Die Szene ist nur zum Teil geladen: {why:problem}. Lade sie noch einmal.[\nErledigt:{done:problems}][\nNicht versucht:{rest:problems}]',
  ],
  looked_here: ['{name} zeigte hierher'],
  looks_like: [
    "'{variable}' ({size}) wurde nicht als Gelenkwinkel genommen: {why:problem}.",
    'Sichere die Gelenkwinkel, eine Zeile je Messpunkt. Ist es doch das Gewünschte, nenne die Variable beim Namen.',
  ],
  loops: ['läuft in Schleife'],
  loose_between: ['Zwischen den Fingern und nicht gehalten: {objects:list}.'],
  loses_object: [
    'Der Greifer verliert {other}[: {why:problem}].',
    'Greif näher am Schwerpunkt, bewege sanfter, oder nimm einen stärkeren Greifer.',
  ],
  lost_by_none: [
    'Die Lösung rückwärts oder abgeschnitten, selbst Stillstehen: Nichts verliert hier Punkte.',
    'Wähle eine engere Grenze.',
  ],
  lost_points: ['{test}: {found:problem}.', '[{hint}]'],
  lti_key_unusable: [
    'Der Schlüssel {path} ist nicht lesbar oder nicht schreibbar: {why:problem}.',
  ],
  lti_not_understood: [
    'Der Start der Plattform ist nicht so, wie LTI 1.3 ihn festlegt: {why:problem}.',
  ],
  lti_other_course: [
    "Der Start ist aus dem Kurs '{course}'[ ({title})], nicht aus {known:either}.",
    'Soll er zu diesem Labor gehören, schreibe seine Kennung in die Datei der Plattform.',
  ],
  lti_other_deployment: ["Der Start ist vom Deployment '{deployment}', nicht von {known:either}."],
  lti_other_platform: [
    'Der Start kommt von einer anderen Plattform oder einem anderen Client[: {issuer}].',
  ],
  lti_used: ['Dieser Start wurde schon benutzt.', 'Öffne das Labor noch einmal aus dem Kurs.'],
  lti_without_class: [
    'Studierende eines Kurses geben für eine Klasse ab, und es ist keine genannt.',
    'Nenne ihren Ordner, der leer sein darf.',
  ],
  machine_lacks: [
    '{lack:choice disk=Der Datenträger ist voll|quota=Das Kontingent auf dem Datenträger ist aufgebraucht|read_only=Der Datenträger ist schreibgeschützt|device=Der Datenträger hat einen Fehler|descriptors=Der Prozess hat keinen Dateideskriptor mehr frei|files=Der Rechner hat keinen Dateideskriptor mehr frei|memory=Es ist kein Speicher mehr frei}.',
    '{lack:choice disk=Mach auf dem Datenträger Platz.|quota=Mach auf dem Datenträger Platz.|read_only=Nenn einen Ordner, in den geschrieben werden kann.|device=Prüfe den Datenträger.|descriptors=Heb die Grenze an (ulimit -n).|files=Beende andere Programme.|memory=Beende andere Programme.}',
  ],
  machine_refused: [
    'Der Rechner ließ die Prüfung nicht enden ({why:problem}).',
    'Schaffe Platz im Speicher oder auf dem Datenträger und starte denselben Befehl noch einmal: Er prüft, was zu wiederholen ist.',
  ],
  made_room: ['Der älteste von {limit:integer} Gegenständen hat einem neuen Platz gemacht.'],
  mail_not_admitted: [
    'Mit dieser Adresse darf sich niemand anmelden[: {email}].',
    'Sie muss bestätigt sein und zu denen gehören, die dieses Labor zulässt.',
  ],
  mark_not_sent: ['Die Punkte von {student} kamen im Kurs nicht an: {why:problem}.'],
  mark_without_reason: ['Geänderte Punkte brauchen einen Grund; nenne ihn in wenigen Worten.'],
  marks_of_another_form: [
    'Diese Punkte gehören nicht zu dem, was hier abgegeben wurde; der Kurs weiß nicht, wessen sie sind.',
    'Bewerte das Abgegebene, oder nimm die Bewertungstabelle.',
  ],
  marks_sent: ['{count:count Bewertung steht|Bewertungen stehen} im Kurs.'],
  mass_or_fixed: [
    'eine Zahl {limits:problem} (kg), oder fixed: true für einen Gegenstand, der sich nie bewegt',
  ],
  matlab_computes: [
    'Zeile {line:integer} rechnet ({found}); gelesen werden nur Zahlen, Texte und Matrizen aus Zahlen. Führe die Datei in MATLAB aus und sichere den Workspace',
  ],
  maximum_differs: [
    'Das Maximum der Plattform ist {found}, die Rubrik hat {points:number} Punkte; die Punkte werden eingetragen, wie sie sind.',
  ],
  may_be_old: [
    'Der Prozess {process} stand {frozen:integer} s lang still, und dies wurde vielleicht davor gesendet; es wurde nicht ausgeführt.',
    'Sende es noch einmal.',
  ],
  may_be_poses: ['es können Posen des Werkzeugs in m und rad sein: {why:reasons}'],
  may_be_time: ['Spalte {column:integer} kann Zeit statt eines Gelenks sein: {why:problem}'],
  may_not_call: [
    `Die Rolle {role:choice ${ROLE}} darf {key} nicht aufrufen.`,
    'Frag deine Lehrkraft.',
  ],
  may_not_publish: [
    `Die Rolle {role:choice ${ROLE}} darf auf {key} nicht senden.`,
    'Frag deine Lehrkraft.',
  ],
  may_still_move: [
    '{why:problem}; keine Antwort von {robots:list}: Dort kann sich noch etwas bewegen',
  ],
  mcap_without_chunks: [
    '{path} enthält Nachrichten außerhalb von Chunks und keinen Index.',
    'Importiere die Datei; das macht ein Bag des Labors daraus.',
  ],
  member_collided: ['Kollision von {robot}'],
  member_file_missing: [
    "Die Trajektorie '{trajectory}' von {robot} ist keine Datei in {folder}; eine Prüfung liest Dateien, nicht den Katalog eines laufenden Labors.",
  ],
  member_file_not_beside: [
    "Die Trajektorie '{trajectory}' von {robot} ist keine Datei neben {file}; eine abgegebene Zelle erreicht nur Dateien derselben Abgabe.",
  ],
  member_lost: ['{robot} hat seine Wiedergabe verloren; Abspielen macht hier weiter'],
  member_lost_at_end: ['{robot} hat seine Wiedergabe verloren; Abspielen beginnt von vorn'],
  member_not_in_scene: [
    'Das Mitglied {robot} gehört nicht zu den Robotern in [der Szene {scene}][{file}][; vorhanden: {robots:list}].',
  ],
  member_of_system: [
    "Der Roboter[ {robot}] ist schon Mitglied des Systems '{system}'.",
    'Löse zuerst dieses System auf.',
  ],
  member_place: ['{place:problem}, Mitglied {robot}'],
  member_refused: ['{robot} kann {file} nicht abspielen: {why:problem}.'],
  member_twice: ['{place:problem}: {robot} ist zweimal Mitglied.', 'Lass einen der Einträge weg.'],
  member_waits_forever: ["{robot} wartet ohne Ende: '{wait}' tritt nie ein."],
  member_without_motion: [
    '{file} nennt keine Trajektorie für {robot}; füge eine hinzu, zum Beispiel trajectory: run.mat',
  ],
  members_back: ['{robots:list} ist wieder da; Abspielen macht bei {position:time} weiter'],
  members_move_to_places: [
    'Die Mitglieder fahren an ihre Plätze.',
    'Halte an, ändere dann die Richtung und spiele ab.',
  ],
  members_silent: ['[keine Antwort von {robots:list}; ]Abspielen macht hier weiter'],
  mesh_no_vertex: ['Die Dreiecke eines Netzes nennen Eckpunkte, die es nicht hat.'],
  mesh_vertex_nowhere: ['ein Eckpunkt ist nicht endlich'],
  mesh_without_triangles: ['es enthält keine Dreiecke'],
  message_too_large: ['Eine Nachricht auf {topic} ist größer als {limit:bytes}.'],
  messages_unreadable: [
    '{messages:count Nachricht|Nachrichten} auf {topic} nicht lesbar und weggelassen',
  ],
  metadata_not_yaml: [
    '{file} ist kein YAML ({problem}).',
    'Entferne die Datei, oder repariere das Bag; dabei wird sie neu geschrieben.',
  ],
  metadata_too_new: [
    '{file} hat die Version {version}; dieses Labor liest bis Version {known:integer}.',
    'Nimm ein neueres Labor.',
  ],
  metadata_without_files: [
    '{file} führt keine Dateien auf.',
    'Repariere das Bag; dabei werden die Metadaten neu geschrieben.',
  ],
  method_not_possible: ['{method} geht bei {path} nicht.'],
  middleware_none: ['Middleware: keine', 'Führe make demo aus; das installiert rmw_fastrtps_cpp.'],
  middleware_other: [
    'RMW_IMPLEMENTATION ist {wanted}[; installiert: {middlewares:list}]',
    'Lösche RMW_IMPLEMENTATION aus der Umgebung, oder installiere diese Middleware.',
  ],
  middleware_there: ['Middleware vorhanden: {middlewares:list}'],
  missed_hand_over: [
    'Der Greifer schließt ins Leere: {giver} hat {other} {ago:time} vorher losgelassen[: {why:problem}].',
    "Um {other} zu übergeben, schließe ihn, während {giver} noch hält; in einer parallelen Zelle mit 'after:', wo einer zu früh ist.",
  ],
  misses_point: [
    'Das Werkzeug kommt am Punkt {number:integer} ({point:position}) in {value:length} Abstand vorbei; erwartet: höchstens {limit:length}.',
    'Berichtige den Weg, oder lass einen größeren Abstand zu.',
  ],
  missing: [
    "Die Datei '{file}' gibt es nicht[; gemeint ist vielleicht '{close}'].",
    'Prüfe den Ordner und den Namen; die Datei endet auf .mat.',
  ],
  missing_field: ['{what:problem} fehlt; erwartet: {expected:problem}.'],
  mistakes: ['{what:problem} hat {count:count Fehler|Fehler}:{all:problems}'],
  mode_of_one_motion: [
    'Die Musterlösung ist eine einzelne Bewegung und hat keinen Modus; nenne eine Zelle (.yaml).',
  ],
  mode_set: [
    '{mode:choice parallel=alle zugleich|sequential=einer nach dem anderen}, {duration:time}',
  ],
  mode_used: [
    'Die Zelle wird {mode:choice parallel=parallel|sequential=nacheinander} abgespielt.',
  ],
  model_left_out: ["Der Roboter '{robot}' bleibt weg: {why:problem}."],
  model_not_in_scene: [
    'Die Szene {scene} enthält keinen Roboter {robot}, also ist sein Platz darin nicht bekannt; vorhanden: {robots:list}.',
    'Nimm einen davon oder eine andere Szene.',
  ],
  module_missing: [
    '{module} fehlt; das Labor läuft ohne Physik: keine Kontakte, kein Greifen',
    'Installiere es.',
  ],
  module_there: ['{module}: vorhanden'],
  module_without_wheel: [
    'Für {module} gibt es bei diesem Python kein Wheel; das Labor läuft ohne Physik: keine Kontakte, kein Greifen',
    'Nimm Python 3.10 oder 3.11.',
  ],
  motion_not_there: [
    "Die Bewegung von '{key}' ist nicht da: {why:problem}.",
    'Bewerte die Klasse noch einmal.',
  ],
  motion_of_another_robot: [
    "'{file}' ist eine Bewegung für {found}; erwartet wird eine für {model}.",
    'Wandle den Workspace noch einmal für diesen Roboter um.',
  ],
  motion_outside: ["Die Bewegung von '{key}' liegt außerhalb des Ordners der Klasse."],
  motion_size: [
    'Verlangt ist eine Bewegung von {robot} von {start:integer} nach {goal:integer} Werten; erwartet werden je {joints:integer} Gelenkpositionen.',
  ],
  motor_side: [
    "'{source}' spricht von Motoren oder Getrieben; die Zahlen in '{variable}' sind vielleicht Winkel der Motoren und nicht der Gelenke.",
    'Sind es Winkel der Gelenke, hinter den Getrieben? Sind es die der Motoren, teile sie durch die Übersetzungen und speichere das Ergebnis als q.',
  ],
  moved: ['{name} wurde bewegt'],
  moves_at_end: [
    '{joint} bewegt sich am Ende noch mit {value:measure}.',
    'Bring die Bewegung zur Ruhe, etwa mit einem Polynom fünften Grades.',
  ],
  moves_at_start: [
    '{joint} bewegt sich schon am Anfang mit {value:measure}.',
    'Beginne mit der Geschwindigkeit 0, etwa mit einem Polynom fünften Grades.',
  ],
  moves_no_robot: [
    '{topic} bewegt keinen Roboter: Keiner des Labors hat diese Gelenke[ ({joints:list})].',
    'Ein Roboter kommt durch den Import seiner URDF dazu.',
  ],
  moves_to_start: ['fährt zum Start'],
  multicast_blocked: [
    'Multicast: ein Paket an {group} kommt nicht zurück[ ({why:problem})]',
    'Setze ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST für ein Labor auf einem einzigen Rechner, oder erlaube in der Firewall UDP-Multicast an {group}.',
  ],
  multicast_works: ['Multicast: Knoten finden einander darüber'],
  name_leads_out: ['Der Name führt aus dem Archiv hinaus; die Datei wird nicht gelesen.'],
  name_of_another_model: [
    "'{id}' ist schon eine Trajektorie von {there}, und diese ist für {robot_model}.",
    "Wähle einen anderen Namen, etwa {name}_{robot_model}, oder lösche zuerst '{id}'.",
  ],
  name_says: [
    'ihr Name [bedeutet {quantity:choice velocities=Geschwindigkeiten|accelerations=Beschleunigungen|jerks=dritte Ableitungen|torques=Momente oder Kräfte|currents=Motorströme|voltages=Spannungen|errors=Fehler oder Differenzen|poses=Positionen des Werkzeugs|times=Zeiten|parameters=Parameter eines Reglers oder Modells|turns=Zahlen von Umdrehungen|obstacles=Hindernisse|temperatures=Temperaturen|joint_velocities=Gelenkgeschwindigkeiten|inputs=Stellgrößen oder Pixelkoordinaten|pixels=Geschwindigkeiten oder Pixelkoordinaten|tool_or_states=Positionen des Werkzeugs oder Zustände|points=Punkte|states_or_path=Zustände oder Bahnparameter|angular_velocities=Winkelgeschwindigkeiten oder Gewichte|states=Zustände|turns_or_reversed=Zahlen von Umdrehungen oder ein umgekehrter Weg}][steht oft für {often:choice velocities=Geschwindigkeiten|accelerations=Beschleunigungen|jerks=dritte Ableitungen|torques=Momente oder Kräfte|currents=Motorströme|voltages=Spannungen|errors=Fehler oder Differenzen|poses=Positionen des Werkzeugs|times=Zeiten|parameters=Parameter eines Reglers oder Modells|turns=Zahlen von Umdrehungen|obstacles=Hindernisse|temperatures=Temperaturen|joint_velocities=Gelenkgeschwindigkeiten|inputs=Stellgrößen oder Pixelkoordinaten|pixels=Geschwindigkeiten oder Pixelkoordinaten|tool_or_states=Positionen des Werkzeugs oder Zustände|points=Punkte|states_or_path=Zustände oder Bahnparameter|angular_velocities=Winkelgeschwindigkeiten oder Gewichte|states=Zustände|turns_or_reversed=Zahlen von Umdrehungen oder ein umgekehrter Weg}][{hint:choice positions=passt zu Gelenkwinkeln|partly=passt zu Gelenkwinkeln|neutral=sagt nicht, was sie enthält|two_faced=steht für Gelenkwinkel ebenso wie für Bahnen des Werkzeugs|doubtful=steht oft für etwas anderes als Gelenkwinkel|against=sagt, dass sie etwas anderes ist als Gelenkwinkel}][, aber {unread:list} ist unbekannt]',
  ],
  name_taken: ["Der Name '{name}' ist vergeben.", 'Wähle einen anderen, oder lass das Feld leer.'],
  name_too_long: [
    "{file}: Ein Name hat {count:integer} Zeichen, '{name}...'; erwartet: höchstens {most:integer}.",
  ],
  name_unprintable: [
    "{file}: Ein Glied oder ein Gelenk heißt '{name}'; erwartet werden druckbare Zeichen und keines von = + - @ am Anfang.",
  ],
  named_entries: ['eine Zuordnung von Namen zu Einträgen'],
  named_twice: [
    '{place:problem} nennt {what:choice robot=den Roboter|object=den Gegenstand|system=das System|surface=die Fläche} {name} zweimal.',
    'Benenne eines davon um.',
  ],
  names_not_known: ['Das ist nicht lesbar; die Namen sind darum nicht bekannt: {why:problem}.'],
  names_other: [
    "'{source}' nennt die Spalten von '{variable}' {words}; das sind nicht die Gelenke von {model}: {joints:list}.",
    'Sind es trotzdem diese Gelenke in dieser Reihenfolge? Dann nenne die Matrix; sonst wähle den Roboter, für den die Datei gemacht ist.',
  ],
  near_joint_limit: [
    '{joint} kommt bis auf {value:measure} an das Ende seines Bereichs.',
    'Wähle eine andere Konfiguration des Arms, oder drehe die Aufgabe um die Basis.',
  ],
  near_singularity: [
    'Der Arm ist fast singulär: Seine Konditionierung sinkt auf {value:number} (1 ist gleichmäßig, 0 singulär).',
    'Eine Bewegung der Gelenke geht dort, eine Gerade des Werkzeugs nicht. Beuge Ellbogen oder Handgelenk, wo der Weg es zulässt.',
  ],
  negative: ["'{text}' ist negativ; erwartet: {expected:problem}."],
  nested_too_deep: ["'{variable}' ist tiefer als {most:integer} Ebenen verschachtelt"],
  neutral_name: [
    "'{variable}' wurde als Gelenkwinkel genommen, aber: {why:problem}[ ({seen:reasons})].",
    'Ist es etwas anderes, sichere die Gelenkwinkel als q. Stimmt es, bestätige die Variable mit ihrem Namen.',
  ],
  never_filled: [
    "'{variable}' ({size}) enthält nur Nullen; erwartet werden Gelenkwinkel.",
    'Lass das Programm laufen, das sie füllt, bevor du sie sicherst.',
  ],
  never_grasped: ['{object} wird nie gegriffen; der Greifer schließt nicht.'],
  never_grasped_closes: ['{object} wird nie gegriffen; der Greifer schließt bei {time:time}.'],
  never_grasped_nothing: [
    '{object} wird nie gegriffen; der Greifer schließt bei {time:time} ins Leere[: {why:problem}].',
  ],
  never_grasped_other: ['{object} wird nie gegriffen, wohl aber {other}, bei {time:time}.'],
  never_held: [
    'Keine Bewegung hält {limit:number}[ {unit}] ein; wähle eine Grenze, die sich einhalten lässt.',
  ],
  never_lost: [
    'Jede Bewegung hält {limit:number}[ {unit}] ein; wähle eine Grenze, die sich verfehlen lässt.',
  ],
  new_keys_needed: [
    'Die Schlüssel sind nicht mehr brauchbar: {why:problem}.',
    'Mach neue Schlüssel in einem anderen Ordner, und verteile sie neu.',
  ],
  newer_format: [
    "Die Trajektorie '{id}' hat das Format {found}; dieses MR-Lab liest Format {known:integer}.",
    'Aktualisiere das Labor, oder wandle den Workspace noch einmal um.',
  ],
  newer_is_shown: [
    'Eine neuere Bewegung dieses Programms kam, während „{file}“ wartete.',
    'Die neuere wird gezeigt.',
  ],
  newer_record: [
    'Ein Eintrag des Katalogs hat das Format {found}; dieses MR-Lab liest Format {known:integer}.',
    'Aktualisiere das Labor.',
  ],
  newer_socket: ['Diese Seite hat eine neuere Verbindung.'],
  newest_already: ["Version {version:integer} von '{id}' ist schon die neueste."],
  newest_taken: [
    'Von {count:count Datei|Dateien}[ mit Namen wie {pattern}] zählt die neueste, die eine Bewegung enthält[: {files:list}].',
  ],
  no_act_to_undo: ['Nichts zurückzunehmen: das geht {limit:time} lang.'],
  no_answer_in_time: [
    '{service} hat nicht innerhalb von {timeout:time} geantwortet.',
    'Versuche es noch einmal.',
  ],
  no_course: ['Noch ist kein Kurs verbunden.', 'Öffne das Labor als Lehrperson aus dem Kurs.'],
  no_landlock: [
    'Sandbox für fremde Dateien: Der Kernel hat kein Landlock; ein Leser von Bags, Meshes oder Abgaben kann jede Datei dieses Benutzers öffnen, und ein Xacro wird abgelehnt',
    'Nimm Linux ab 5.13 mit Landlock, oder einen Container, der dessen Systemaufrufe zulässt; lies bis dahin nur Dateien von Leuten, denen du vertraust.',
  ],
  no_arrivals: [
    'Die Middleware meldet nicht, wenn auf {topic} Nachrichten ankommen (Fehler {error:integer}).',
    'Setze RMW_IMPLEMENTATION auf eine, die das tut, etwa rmw_fastrtps_cpp.',
  ],
  no_asset: ['Die Datei {asset} gibt es im Labor nicht; was es gibt, sagen {documents:list}.'],
  no_asset_name: [
    "'{path}' bezeichnet keine Datei des Labors; erwartet wird ein Pfad wie mrlab_ros/robots/ur5e/meshes/base_link.glb, ohne '..' und ohne versteckte Namen.",
  ],
  no_attachment: ["{path} hat keinen Anhang '{attachment}'[; vorhanden: {known:list}]."],
  no_authority: [
    'Dieses Gateway hat keine eigene Zertifizierungsstelle; zu installieren gibt es nichts.',
  ],
  no_bag: [
    "Das Bag {path} gibt es nicht[; gemeint ist vielleicht '{close}'].",
    'Nenne den Ordner eines Bags oder eine MCAP-Datei.',
  ],
  no_cell: [
    'Es ist eine einzelne Bewegung; erwartet wird eine Zelle, deren Roboter sich {mode:choice parallel=parallel|sequential=nacheinander} bewegen.',
  ],
  no_certificate: ['{path} ist kein Zertifikat (PEM): {why:problem}.'],
  no_class: [
    'Dieses Gateway zeigt keine Klasse.',
    'Starte das Labor mit dem Ordner einer bewerteten Klasse.',
  ],
  no_class_folder: [
    '{folder} enthält {found} und ist kein Ordner einer früher bewerteten Klasse; nimm einen leeren oder einen neuen Ordner.',
  ],
  no_collision: ['keine Kollision'],
  no_collision_mesh: [
    "Das Kollisionsnetz {mesh} des Glieds '{link}' fehlt, oder die Physik liest sein Format nicht ({formats:list}).",
    'Erzeuge die Netze des Roboters noch einmal.',
  ],
  no_column: ['sie ist {size}, wo eine einzelne Spalte erwartet wird'],
  no_coordinator_runs: ['Es läuft kein Koordinator; die Systeme der Szene brauchen ihn.'],
  no_device: ['So ein Gerät gibt es nicht.', 'Vielleicht hat es sich abgemeldet.'],
  no_device_shows: [
    'Kein Gerät zeigt den Code {shown}.',
    'Ein Code gilt {minutes:count Minute|Minuten}; vergleiche ihn noch einmal mit dem Gerät.',
  ],
  no_distance: ['In dem, was geprüft wurde, gibt es keinen Abstand[ zu {thing}].'],
  no_ec_key: ['{path} ist {found}; erwartet wird ein EC-Schlüssel.'],
  no_end_effector: [
    "Den Endeffektor '{end_effector}' gibt es nicht; es gibt: {known:list}, oder none für den bloßen Flansch.",
    "[Meinst du '{close}'?]",
  ],
  no_export_format: [
    "Das Format '{format}' wird nicht geschrieben[; gemeint ist vielleicht {close}].",
    'Wähle eines von diesen: {known:list}.',
  ],
  no_file_handed_in: [
    'Es wurde keine Datei abgegeben, in der eine Bewegung sein kann[; vorhanden: {files:list}].',
  ],
  no_file_name: [
    "Die Datei hat keinen Namen[: '{file}' ist keiner].",
    'Gib ihr einen, der sagt, was sie ist, etwa traj.mat.',
  ],
  no_free_place: [
    'Für {type} ist innerhalb von {distance:length} kein Platz frei.',
    'Verschiebe oder entferne etwas.',
  ],
  no_hello: [
    'Das erste Paket ist kein hello, oder es kam nicht innerhalb von {wait:time}.',
    'Siehe docs/link.md.',
  ],
  no_host: [
    "'{host}' ist weder der Name eines Rechners noch eine Adresse.",
    'Erwartet wird zum Beispiel lab.example.org oder 192.168.1.20, ohne Port.',
  ],
  no_https_file: [
    'Die Datei {path}, die HTTPS braucht, gibt es nicht.',
    'Erzeuge sie, oder nenne dein eigenes Zertifikat und seinen Schlüssel.',
  ],
  no_index: ["'{term}' ist keine {axis:choice row=Zeile|column=Spalte}"],
  no_indices: ['damit ist gar keine {axis:choice row=Zeile|column=Spalte} genannt'],
  no_joint_state: ['{size:integer} Bytes sind kein Gelenkzustand: {why:problem}.'],
  no_json_object: [
    'es ist kein JSON-Objekt; erwartet wird zum Beispiel {{"q": [[[[...]], ...]], "fs": 100}}',
  ],
  no_key_file: [
    'Die Datei {path} gibt es nicht.',
    'Spiele eine Kopie zurück, oder mach neue Schlüssel.',
  ],
  no_keys: ['{folder} enthält keine Schlüssel.', 'Mach zuerst welche.'],
  no_lab_answers: [
    'In der ROS-Domain {domain:integer} antwortet kein Labor.',
    'Starte eines, oder setze ROS_DOMAIN_ID auf die Domain eines Labors, das läuft.',
  ],
  no_lab_at: ['An {endpoint} antwortet kein Labor: {why:problem}.'],
  no_level_surface: [
    "Eine waagerechte Fläche '{surface}' gibt es im Raum nicht; es gibt: {known:list}.",
    "[Meinst du '{close}'?]",
  ],
  no_link: ["{robot} hat kein Glied '{link}'; seine Glieder: {known:list}."],
  no_link_in_file: ["{file} hat kein Glied '{link}'; ihre Glieder: {known:list}."],
  no_lti: [
    'Dieses Labor gehört zu keinem Kurs einer Lernplattform.',
    'Starte es mit der Datei der Plattform.',
  ],
  no_matrix: ["'{variable}' ist keine Matrix aus Zahlen"],
  no_matrix_q: ['ihre Zeilen enthalten keine Matrix q; wandle den Workspace noch einmal um'],
  no_members: ['Ein System braucht mindestens ein Mitglied.', 'Nenne die Roboter, die es bewegt.'],
  no_members_in_file: ['members ist leer; erwartet wird eine Liste mit mindestens einem Roboter'],
  no_messages: [
    'sie enthält weder eine JointTrajectory (joint_names und points) noch Gelenkzustände (name und position)',
  ],
  no_metadata: [
    '{file} enthält keine Metadaten eines Bags: {field} fehlt.',
    'Nenne den Ordner eines Bags, oder repariere das Bag; dabei werden die Metadaten neu geschrieben.',
  ],
  no_motion: [
    "Die Zeilen von '{variable}' sind keine Bewegung: {why:choice random=benachbarte Zeilen liegen so weit auseinander wie beliebige|pose=das Werkzeug steht an einer Stelle, während die Gelenke springen, wie bei Lösungen einer inversen Kinematik}.",
    'Speichere die Bewegung in der Reihenfolge, in der sie abläuft; sind die Zeilen Wegpunkte, speichere ihre Zeiten als t.',
  ],
  no_motion_file: ['In dieser Datei kann keine Bewegung sein.'],
  no_motion_in_file: ['aus der Datei ließ sich keine Bewegung entnehmen'],
  no_motion_leads: [
    'Keine Bewegung von {robot} führt von {start:list} nach {goal:list} rad ({why:problem}).',
    'Prüfe die erste Zeile der Trajektorie.',
  ],
  no_motion_of: ['{robot} hat in dieser Datei keine Bewegung[; eine haben: {robots:list}].'],
  no_motion_to_mark: ['Es gibt keine Bewegung zum Bewerten.'],
  no_motion_to_show: [
    "Die Abgabe '{key}' hat keine Bewegung, die sich zeigen lässt[: {why:problem}].",
  ],
  no_moving_joint: [
    'Die Beschreibung von {robot} hat kein bewegliches Gelenk {missing:either}; ihre Gelenke: {known:list}.',
  ],
  no_name: ['eine Variable oder ein Objekt hat keinen Namen'],
  no_name_left: ["Der Name '{name}' ist vergeben.", 'Bitte deine Lehrkraft um einen anderen.'],
  cell_for_one_robot: [
    '{file} ist eine Zelle mehrerer Roboter, und die Rubrik ist für einen {robot}; lass robot: in einer Rubrik für Zellen weg.',
  ],
  grader_not_started: ['Der Prozess, der prüft, ist nicht gestartet.'],
  no_file: ['Es gibt keine Datei.'],
  no_robot_in_rubric: [
    "'{file}' sagt nicht, für welchen Roboter sie ist; nenne einen in der Rubrik: robot: ur5e",
  ],
  no_seccomp: [
    'Sandbox für fremde Dateien: Der Kernel nimmt keinen Filter für Systemaufrufe; ein Leser kann Sockets öffnen und die Rechte von Dateien ändern, und ein Xacro wird abgelehnt',
    'Nimm einen Kernel mit seccomp auf x86_64 oder aarch64; lies bis dahin nur Dateien von Leuten, denen du vertraust.',
  ],
  no_share_of_limits: [
    '{value:share} einer Grenze sind keine Schranke; wähle einen Anteil über 0 % und bis 100 %.',
  ],
  no_stop_before: ['vor dieser Stelle kommt kein Halt'],
  no_submissions: [
    '{file} enthält keine Abgabe; erwartet wird ein Export von Moodle, ILIAS, Canvas oder Gradescope, oder ein Ordner oder eine Datei für jede Person.',
  ],
  no_tcp: [
    '{file} hat keinen Frame tcp; seine Links sind {links:list}.',
    'Füge mit einem festen Gelenk dort, wo das Werkzeug arbeitet, einen Link tcp hinzu, oder einen, der auf _tcp endet.',
  ],
  no_worksheet_given: [
    'Die Bewertungstabelle von Moodle wurde nicht abgegeben; gib sie ab, nimm die Freigabe zurück und gib noch einmal frei.',
  ],
  not_back: [
    'Nicht zurück: {names:list}. Den Namen hat etwas anderes, oder es fehlt, was es braucht.',
  ],
  not_of_course: ['Nur wer aus dem Kurs kommt, kann abgeben.', 'Öffne das Labor aus dem Kurs.'],
  not_ready_for_robot: ['Die Prüfung sperrt die Bewegung: {why:problem}.'],
  not_released: [
    'Die Punkte sind nicht freigegeben; gib sie frei und lade dann herunter, was die Studierenden bekommen.',
  ],
  nothing_handed_in: ['Noch hat niemand etwas abgegeben.'],
  nothing_proposed: ['Es sind keine Punkte vorgeschlagen; starte zuerst die Bewertung.'],
  nothing_to_grasp: [
    'Der Greifer schließt um nichts: Es ist kein Teil da, das er halten könnte.',
    'Prüfe die Bewegung mit ihren Teilen: mrlab check --scene FILE, oder --lab.',
  ],
  nothing_to_hand_in_for: [
    'Es gibt noch keine Aufgabe.',
    'Warte, bis deine Lehrperson sie bereitgestellt hat.',
  ],
  nothing_to_undo: ['Es wurde nichts getan, das sich zurücknehmen ließe.'],
  objects_taken_out: ['Aus der Szene entfernt: {objects:list}.'],
  of_reference: ['{rubric}: Referenz: {why:problem}.'],
  of_rubric: ['{rubric}: {why:problem}.'],
  other_joints: [
    "'{file}' hat die Gelenke {joints:list}; erwartet werden die von {model}.",
    'Wandle die ursprüngliche Datei noch einmal um.',
  ],
  processes_killed: [
    'Prozesse, die prüfen, wurden {count:integer}-mal beendet; vielleicht reicht der Speicher nicht.',
    'Fertiges bleibt erhalten: Starte denselben Befehl noch einmal mit weniger Prozessen.',
  ],
  pulled_through: [
    '{other} zieht {object} durch die geschlossenen Finger von {robot}: Es glitt {way:length} gegen {force:number} N, und {other} hält es mit einer Reserve von {margin:share}.',
  ],
  ready_for_robot: ['Die Prüfung hat keinen Befund, der die Bewegung sperrt.'],
  recording_pauses: [
    "'{variable}' hat vor Punkt {first_row:integer} für {value:number} s keinen Punkt; so lange braucht der Roboter vom einen zum nächsten.",
    'Wurde die Aufnahme dort unterbrochen, wandle ihre Teile einzeln um.',
  ],
  reference_apart: [
    '{rubric}: Die Referenz {file} nennt die Bewegung {motion}, die nicht neben ihr liegt.',
    'Lege die Bewegungen der Zelle neben sie.',
  ],
  reference_not_marked: [
    '{rubric}: Die Referenz {file} kann nicht bewertet werden[: {why:problem}].',
  ],
  reference_not_read: ['{rubric}: Die Referenz {file} ist nicht lesbar: {why:problem}.'],
  required_hidden_lost: ['Ein anderer Test ist nicht bestanden, den dieser verlangt.'],
  required_lost: ['Der Test „{test}“ ist nicht bestanden, den dieser verlangt.'],
  requires_circle: [
    'Er verlangt sich selbst, auf dem Weg über {tests:list}; keiner dieser Tests kann bestanden werden.',
  ],
  requires_unknown: [
    'Er verlangt „{test}“, und so heißt kein anderer Test der Bewertung[; es gibt {known:list}][. Meinst du {close:either}?].',
  ],
  robot_not_said: [
    "'{file}' sagt nicht, für welchen Roboter sie ist, und die Rubrik auch nicht; ergänze robot: ur5e in der Rubrik, oder bewerte eine Zelle (.yaml).",
  ],
  sandbox_has: ['Sandbox für fremde Dateien: {layers:list}'],
  second_is_first: [
    '{who} hat diese Punkte gegeben und kann sie nicht zweitprüfen; dafür muss sich eine andere Lehrperson anmelden.',
  ],
  second_marks_differ: [
    '{count:count Zweitbewertung weicht|Zweitbewertungen weichen} ab; vergib die Punkte, die gelten, oder nimm die zweiten zurück.',
  ],
  small_jumps: [
    '{joint} springt in {count:count Zeile|Zeilen}; seine Geschwindigkeit weicht dort für eine Zeile um bis zu {value:measure} ab.',
    'Nimm die Zeilen heraus, die nicht dorthin gehören, oder glätte die Bewegung.',
  ],
  source_name: [
    "'{file}' ist kein Name einer Datei neben einer Rubrik; erwartet wird einer ohne Ordner.",
  ],
  source_too_large: ['{file} ist größer als {most:bytes}.'],
  sources_missing: [
    'Es fehlt noch {what:choice export=der Export|rubric=die Rubrik}; gib das zuerst ab.',
  ],
  stamps_back: [
    "{count:count Nachricht trägt|Nachrichten tragen} in '{variable}' einen früheren Zeitstempel als die davor; was vor dem spätesten lag, wurde weggelassen.",
    'Prüfe, ob zwei Aufnahmen in der Datei sind oder eine Uhr zurückgestellt wurde, und trenne sie dort.',
  ],
  stands_still: ['{robot} bewegt sich nicht.'],
  stop_event: ['{robot}: {said:problem}'],
  stops_awaited: [
    'Die Ereignisse von {bag} werden noch gelesen.',
    'Versuch es gleich noch einmal.',
  ],
  submission_killed: [
    'Die Prüfung wurde von außen beendet; dem Rechner fehlte wohl Speicher.',
    'Starte denselben Befehl mit weniger Prozessen: Er prüft, was zu wiederholen ist.',
  ],
  to_end: ['spielt weiter bis zum Ende: kein Halt folgt'],
  to_stop: ['spielt weiter bis {at:time}'],
  torn_off: [
    '{other} hat {object} aus den geschlossenen Fingern von {robot} gerissen: Es glitt {way:length} gegen {force:number} N, und {other} hält es mit einer Reserve von {margin:share}.',
  ],
  tour_stop: ['Halt {number:integer} von {count:integer}: {events:reasons}'],
  undone: ['Zurückgenommen: {act:problem}[\n{missing:problem}]'],
  undone_in_part: [
    'Nur zum Teil zurückgenommen: {why:problem}. Nimm es noch einmal zurück.[\nErledigt:{done:problems}][\nNicht versucht:{rest:problems}]',
  ],
  unknown_form: ["Die Form des Exports ist '{form}'; erwartet wird {known:either}."],
  unpacking_ended: [
    'Der Prozess, der entpackt, endete an {file} ({why:problem}); der Grund ist diese Datei, und sie wird nicht gelesen.',
    'Bitte um ein gewöhnliches Archiv.',
  ],
  unpacking_not_started: ['Der Prozess, der entpackt, startet nicht: {why:problem}.'],
  unreadable_submission: ['Keine Datei dieser Abgabe lässt sich lesen.'],
  no_number: ['sie ist {found:problem}, wo eine reelle Zahl erwartet wird'],
  no_numbers: ['sie enthält keine Zeile mit Zahlen'],
  no_object_checked: ['In dem, was geprüft wurde, gibt es keinen Gegenstand {object}.'],
  no_object_in_scene: [
    'In der Szene ist kein Gegenstand {object}[; vorhanden: {known:list}].',
    "[Meinst du '{close}'?]",
  ],
  no_object_type: [
    "Im Katalog gibt es keinen Gegenstand '{type}'; es gibt: {known:list}.",
    "[Meinst du '{close}'?]",
  ],
  no_ordinary_file: ['Das ist keine gewöhnliche Datei; sie wird nicht gelesen.'],
  no_partial: ["partial ist '{rule}'; '{sentence}' kennt keine Teilpunkte; lass partial weg."],
  no_person: ["Niemand heißt '{name}'."],
  no_physics: ['Es gibt keine Physik: {why:problem}.'],
  no_place_before_viewer: [
    'Vor dir ist innerhalb von {distance:length} kein Platz frei.',
    'Dreh dich um, entferne dort einen Roboter oder einen Gegenstand, oder gib eine Pose an.',
  ],
  no_place_on_floor: [
    'Innerhalb von {distance:length} um den Ursprung ist kein Platz frei.',
    'Entferne einen Roboter, oder gib eine Pose an.',
  ],
  no_place_on_surface: [
    'Auf {surface} ist kein Platz frei.',
    'Entferne dort einen Roboter oder einen Gegenstand, oder gib eine Pose an.',
  ],
  no_playback_runs: ['Es läuft keine Wiedergabe; die Trajektorien der Szene brauchen sie.'],
  no_poses: ['Es nennt keine Posen; ergänze poses: [[[[0.4, 0.2, 0.3]]]], in m in world.'],
  no_private_folder: [
    'Kein Ordner gehört diesem Benutzer allein: {reasons:reasons}.',
    'Setze XDG_RUNTIME_DIR auf einen solchen Ordner.',
  ],
  no_private_key: ['{path} ist kein privater Schlüssel ohne Passwort (PEM): {why:problem}.'],
  no_provider: [
    'Dieses Labor hat keinen Anbieter für OpenID Connect.',
    'Melde dich mit einem Passwort an.',
  ],
  no_rate: ['{value:number} ist weder eine Rate noch ein Schritt der Zeilen'],
  no_record: ['Es ist kein Eintrag einer Trajektorie ({error}).'],
  no_recording: ['es wird nichts aufgenommen; beginne zuerst eine Aufnahme'],
  no_reference: [
    'Es nennt keine Musterlösung; so zeigt nichts, dass die volle Punktzahl erreichbar ist; ergänze reference: solution.mat',
  ],
  no_reference_motion: ['Zum Vergleichen gibt es keine Bewegung der Musterlösung.'],
  no_reference_named: [
    'Die Rubrik nennt keine Musterlösung zum Vergleichen; ergänze reference: solution.mat',
  ],
  no_reference_of_model: ['Die Musterlösung hat keine Bewegung eines {model} zum Vergleichen.'],
  no_references: ["'{variable}' enthält keine Verweise auf ihre Elemente"],
  no_replay: ['es wird nichts wiedergegeben; starte zuerst eine Wiedergabe'],
  no_robot_in_scene: [
    'In der Szene ist kein Roboter {robot}[; vorhanden: {known:list}].',
    "[Meinst du '{close}'?]",
  ],
  no_robot_model: [
    "Den Roboter '{robot}' gibt es nicht; es gibt: {known:list}.",
    "[Meinst du '{close}'?]",
  ],
  no_role_may: [
    'Keine Rolle darf das in diesem Labor.',
    'Seine Liste der Erlaubten sagt, wer was darf.',
  ],
  no_room_for_copy: [
    'In {folder} lässt sich keine Trajektorie ablegen ({error}).',
    'Mach auf dem Datenträger Platz.',
  ],
  no_room_for_trajectory: [
    "Das Labor hat keinen Platz für '{file}' ({error}).",
    'Mach auf dem Datenträger[ von {folder}] Platz, und wandle die Datei noch einmal um.',
  ],
  no_room_on_disk: [
    'In {folder} lässt sich nicht schreiben ({why:problem}); nichts wurde geändert.',
    'Mach dort Platz, und versuche es noch einmal.',
  ],
  no_scene: [
    "Die Szene '{scene}' gibt es nicht; es gibt: {known:list}.",
    "[Meinst du '{close}'?]",
  ],
  no_seal_at_edge: [
    'Der Sauger schließt nicht dicht: Nur {share:share} seiner Lippe liegen auf {object}; darunter ist eine Kante, ein Loch oder ein Rand.',
  ],
  no_seal_curved: [
    'Der Sauger schließt nicht dicht: {object} ist unter seiner Lippe zu stark gewölbt.',
  ],
  no_seal_tilted: [
    'Der Sauger schließt nicht dicht: {object} ist um {tilt:angle} zu ihm geneigt; erwartet: höchstens {most:angle}.',
  ],
  no_shape: [
    'pybullet konnte aus einem Körper keine Form machen.',
    'Prüfe die Größen seiner Teile.',
  ],
  no_shared_link: [
    "Kein Glied von {file}, das ein Netz hat[ ({meshed:list})], ist ein Glied von '{robot}' ({links:list}).",
    'Gib eine URDF ohne Präfix an.',
  ],
  no_speed: [
    'Die Geschwindigkeit {found:list} von {object} ist keine; erwartet werden Werte in m/s und rad/s.',
  ],
  no_spherical_wrist: [
    'Die letzten drei Achsen gehen um {distance:length} aneinander vorbei; für reach_definition wrist_centre müssen sie sich in einem Punkt schneiden.',
    'Schreibe stattdessen flange.',
  ],
  no_state_of_robot: [
    'Niemand sendet den Zustand der Wiedergabe von {robot}; vielleicht läuft sie nicht.',
  ],
  no_store: [
    "Die Ablage '{store}' ist nicht brauchbar.",
    'Erwartet wird ein Ordner oder eine URL wie s3://bucket/lab, gs://bucket/lab oder az://container/lab.',
  ],
  no_submission: ["In dieser Klasse gibt es keine Abgabe '{key}'; wähle eine aus ihrer Liste."],
  no_such_column: ["'{variable}' hat die Spalten 1 bis {width:integer}"],
  no_such_field: ['{type} hat kein Feld {names:either}[; vorhanden: {fields:list}].'],
  no_such_frame: ["'{id}' hat den Frame {frame:integer} nicht; erwartet: 0 bis {last:integer}."],
  no_such_joints: [
    'Das Bag enthält keine Gelenkzustände von {model} mit den Gelenken {joints:list}[; vorhanden:{found:problems}]',
  ],
  no_such_limit: [
    'Für diesen Roboter ist {of:choice ranges=kein Bereich|speeds=keine größte Geschwindigkeit|acceleration=keine Grenze der Beschleunigung|jerk=keine Grenze des Rucks} angegeben.',
  ],
  no_such_motion: [
    'Diese Bewegung ist nicht mehr da.',
    'Wandle die Datei noch einmal um, oder öffne die Trajektorie, die daraus wurde.',
  ],
  no_such_variable: ["es gibt keine Variable '{variable}'"],
  no_such_version: ["'{id}' hat keine Version {version:integer}; vorhanden: {kept:list}."],
  no_surface_below: [
    'Unter {place:position} ist keine Fläche.',
    'Gib eine Pose über einer Fläche an.',
  ],
  no_system: [
    "Das System '{system}' gibt es nicht[; es gibt: {known:list}].",
    "[Meinst du '{close}'?]",
  ],
  no_system_in_cell: [
    '{place:problem} enthält kein System; erwartet wird members oder eine Liste von Systemen.',
  ],
  no_text: ['Byte {byte:integer} ist kein Text in {encoding}'],
  no_times: [
    "Gleichmäßig machen braucht die Zeiten der Zeilen von '{variable}', und die Datei hat keine.",
    'Sichere für jede Zeile eine Zeit in s, zum Beispiel 2 s von Zeile zu Zeile.',
  ],
  no_times_of_rows: [
    'ihre Werte sind keine Zeiten der Zeilen, die mit einer Rate für Gelenke steigen',
  ],
  no_tool_to_grasp: [
    'Ohne Werkzeug zum Greifen: {robots:list}; ergänze in der Rubrik tool: parallel_gripper.',
  ],
  no_topic_of_pages: [
    '{key} ist kein Topic, das das Labor an Seiten gibt.',
    'Sie stehen in docs/protocol.md, mit * für einen Teil eines Schlüssels.',
  ],
  no_trajectory: [
    "Keine Variable in '{file}' sieht aus wie die Gelenkwinkel von {model}, eine N x {joints:integer} Matrix in Radiant mit N >= 2. Die Datei enthält {count:count Variable|Variablen}[: {held:list}][ und {more:integer} weitere].[ Darin: {inside:list}.][{looks:problems}]",
    'Sichere die Gelenkwinkel, eine Zeile je Messpunkt. Ist eine der Variablen das Gewünschte, nenne sie beim Namen.',
  ],
  no_trajectory_loaded: [
    '{robot} hat keine Trajektorie.',
    'Lade eine, oder nenne eine für das System.',
  ],
  no_trajectory_named: [
    'Das System {system} nennt für {robot} keine Trajektorie.',
    'Nenne eine aus dem Katalog.',
  ],
  no_trajectory_of_name: [
    "Die Trajektorie '{id}' gibt es nicht[; gemeint ist vielleicht {close}].",
    'Wandle eine Datei um[, oder nimm eine von diesen: {known:list}].',
  ],
  no_unit: ["'{text}' hat keine Einheit; erwartet: {expected:problem}."],
  no_upload: ['Das Hochgeladene {upload} ist nicht da.', 'Sende die Datei noch einmal.'],
  no_upload_key: [
    "'{key}' ist kein Schlüssel {what:choice upload=von etwas Hochgeladenem|draft=eines Entwurfs}.",
    'Sende die Datei noch einmal.',
  ],
  no_variable_here: ['wo eine Variable beginnen muss, beginnt keine[, bei Byte {byte:integer}]'],
  no_wait_helps: [
    'Kein Warten an einer ersten Zeile hält die beiden auseinander: Einer steht dem anderen im Weg.',
    'Ändere einen Weg oder einen Platz.',
  ],
  no_worksheet: [
    '{file} hat {count:count Spalte|Spalten}[: {columns:list}]; erwartet werden die von Moodles Bewertungstabelle (Identifier, Grade), von status.csv aus ILIAS (login, mark) oder von Canvas (ID und eine Aufgabe, oder eine, die wie die Rubrik heißt).',
  ],
  no_zero: ['Zahlen außer 0'],
  no_zip: [
    '{file} ist kein lesbares ZIP-Archiv ({why:problem}); erwartet wird der Export, wie das System ihn geschrieben hat, oder sein Ordner.',
  ],
  nobodys_trajectories: [
    "Trajektorien von '{owner}' können nicht an '{to}' gehen und nicht gelöscht werden.",
    'Erwartet: die Kennungen zweier Personen; die Trajektorien des Labors bleiben.',
  ],
  nobody_answers: [
    'Niemand antwortet auf {key}: Sein Knoten läuft nicht, der Roboter ist nicht da, oder der Schlüssel des Gateways darf ihn nicht aufrufen.',
  ],
  non_finite: [
    "'{variable}' enthält {count:count Wert|Werte} NaN oder Inf, in {rows:integer} von {of:count Zeile|Zeilen}, den ersten in Zeile {first_row:integer}, Spalte {column:integer}.",
    'Suche mit isfinite, woher sie kommen. Zeilen am Rand und wenige im Innern kannst du weglassen; mehr werden aus ihren Nachbarn gefüllt, denn ohne sie wäre die Bewegung kürzer.',
  ],
  none_named_so: ['Keine Datei heißt so: {pattern}.'],
  not_a_file: [
    '{file} ist nicht lesbar: Es ist {what:choice folder=ein Ordner|special=keine gewöhnliche Datei}.',
  ],
  not_a_folder: ['{path} ist kein Ordner oder ein Verweis (Link) auf einen'],
  not_a_new_folder: [
    '{folder} {problem:choice file=ist kein Ordner|full=ist nicht leer}.',
    'Nenne einen neuen Ordner.',
  ],
  not_a_new_name: [
    "'{id}' lässt sich nicht veröffentlichen.",
    'Gib einen Namen ohne Version und ohne andere Person an, etwa {name}.',
  ],
  not_a_number: ["'{text}' ist keine Zahl[; schreibe {better}]; erwartet: {expected:problem}."],
  not_a_package_uri: ["Die URI ist '{uri}'; erwartet wird eine, die mit {begin} beginnt."],
  not_a_place: ['Der Ort ist {text}; erwartet wird [[x, y]] oder [[x, y, z]] in m, in world.'],
  not_among_yours: [
    "Unter deinen und den geteilten Trajektorien ist keine '{trajectory}'.",
    'Suche sie in der Liste.',
  ],
  not_as_awaited: ['Was erwartet wurde, kam auf {topic} nicht innerhalb von {timeout:time}.'],
  not_as_before: ['Das Labor ist nicht wie zuvor:{all:problems}'],
  not_as_schema: [
    "'{file}' ist keine Trajektoriendatei: [bei {place}, ]{error}.",
    'Wandle den Workspace noch einmal um.',
  ],
  not_assembled: [
    '{file} lässt sich nicht zusammensetzen: {why:problem}.',
    'Vergleiche sie mit der Spezifikation von URDF, http://wiki.ros.org/urdf/XML.',
  ],
  not_at_rest: [
    '{joint} {instant:choice start=beginnt|end=endet} mit {value:share} seiner größten Geschwindigkeit; erwartet: höchstens {limit:share}.',
  ],
  not_attached: ['{topic}: Was dazu gehört, ist nicht im Bag: {why:problem}'],
  not_cdr: ['es ist {format} und nicht CDR'],
  not_confirmed: [
    'Der Anbieter hat nicht bestätigt, wer du bist: {why:problem}.',
    'Beginne von vorn.',
  ],
  not_deleted: ["'{id}' ist nicht gelöscht.", 'Nenne die Version, die die nächste wird.'],
  not_driven_by: [
    "Der Roboter ist kein Mitglied des Systems '{system}'.",
    'Erstelle das System noch einmal.',
  ],
  not_held: [
    '{object} wird bei {time:time} nicht gehalten; erwartet: von {since:time} bis {until:time}.',
  ],
  not_imported: ["Als '{robot}' wurde nichts importiert; nichts wird entfernt."],
  not_in_lab: ["Im Labor gibt es keinen Roboter '{robot}'[; vorhanden: {robots:list}]."],
  not_in_place: [
    'Der Arm steht nicht bei {position:time} seiner Trajektorie.',
    'Lass ihn zuerst dorthin fahren.',
  ],
  not_in_store: ["Unter '{key}' liegt nichts in der Ablage.", 'Sende es noch einmal.'],
  not_in_the_room: ['{object} ist am Ende nicht mehr im Raum.'],
  not_in_worksheet: ['{student} steht nicht in der Bewertungstabelle.'],
  not_in_world: ['Die Physik kennt {name} nicht.', 'Füge es zuerst hinzu.'],
  not_inflated: ['die {form}-Datei lässt sich nicht entpacken ({why:problem})'],
  not_json: ["'{file}' ist kein JSON ({error}).", 'Wandle den Workspace noch einmal um.'],
  not_mcap: [
    '{path} ist keine MCAP-Datei: Sie beginnt nicht mit den Kennbytes von MCAP.',
    'Ein anderes ROS-2-Bag wird durch einen Import zu einem des Labors.',
  ],
  not_moved_yet: ['{robot} hat sich noch nicht bewegt.', 'Warte auf seinen ersten Gelenkzustand.'],
  not_named_as_by: ['Sie heißt nicht so, wie {form} Dateien benennt.'],
  not_of_format: ['{file}[:{line:integer}] ist kein {format}: {why:problem}.'],
  not_of_library: [
    "'{robot}' gehört nicht zu den eigenen Robotern des Labors.",
    'Importiere ihn stattdessen noch einmal.',
  ],
  not_of_type: [
    '{found} ist kein {type}: {why:problem}.',
    'Gib jedem Feld einen Wert von seinem Typ.',
  ],
  not_offered: [
    'Niemand bietet {service}[ in der ROS-Domain {domain:integer}] an; vielleicht läuft dieser Teil des Labors nicht.',
  ],
  not_one_system: [
    '{file} enthält {count:count System|Systeme}[ ({names:list})]; erwartet wird genau eines.',
  ],
  not_played: ['{robot} hat hier keine Wiedergabe; ist er noch in der Szene?'],
  not_readable: ['{file} ist nicht lesbar: {why:problem}.'],
  not_real: [
    "'{variable}' enthält komplexe Zahlen; Gelenkwinkel sind reell.",
    'Oft kommen sie aus einer inversen Kinematik außerhalb der Reichweite. Prüfe den Weg; sind die Imaginärteile nur Rundung, nimm den Realteil.',
  ],
  not_recorded: ['nicht aufgenommen: {why:problem}'],
  not_rehearsed: ['die Bewegung ging nicht durch die Physik'],
  not_ros_bag: [
    '{path} lässt sich nicht als ROS-2-Bag lesen ({why:problem}); erwartet wird sein Ordner mit metadata.yaml, eine MCAP-Datei oder eine .db3-Datei.',
  ],
  not_set_aside: ['Sie lässt sich nicht zur Seite legen: {problem}'],
  not_signed_in: ['Niemand ist angemeldet, oder die Anmeldung ist beendet.', 'Melde dich an.'],
  nobody_waits: ['Niemand wartet mehr auf das Labor.'],
  not_standing: ['Der Roboter[ {robot}] ist im Zustand „{state:state}“.', 'Stoppe ihn zuerst.'],
  not_taken_back: [
    '{why:problem}. Was geändert wurde, ließ sich nicht zurücknehmen: {error:problem}.',
    'Lade {robots:list} noch einmal.',
  ],
  not_unpacked: ['{file} lässt sich nicht entpacken: {why:problem}.'],
  not_urdf: ['{file} beginnt mit <{tag}>; erwartet wird eine URDF, und die hat <robot>.'],
  not_utf8: ['{file} ist kein Text in UTF-8.', 'Sichere die Datei als UTF-8.'],
  not_xml: ["{file} ist kein XML: {why:problem} in Zeile {line:integer}[, '{found}']."],
  not_yours: ["'{trajectory}' gehört {owner}; {person} darf sie nur ansehen."],
  nothing_answers: ['Auf {key} antwortet nichts.'],
  nothing_at: ['Unter {path} gibt es nichts.'],
  nothing_came: [
    'Auf {topic} kam innerhalb von {timeout:time} nichts; vielleicht läuft dieser Teil des Labors nicht.',
  ],
  nothing_loaded: [
    'Der Roboter kann sich im Zustand „{state:state}“ nicht bewegen: Er hat keine Trajektorie.',
    'Lade zuerst eine Trajektorie.',
  ],
  nothing_near: ['Nichts kommt näher als {value:length}.'],
  nothing_recorded: ['Darin wurde nichts aufgenommen'],
  nothing_runs: ['es läuft keine Aufnahme und keine Wiedergabe'],
  nothing_to_replay: [
    '{path} enthält kein Topic, das sich wiedergeben lässt[:{left_out:problems}].',
    'Nimm die Topics des Labors auf.',
  ],
  nothing_to_show: ['Es gibt keine Bewegung zu zeigen: {why:problem}.'],
  nothing_touched: ['Nichts wird berührt.'],
  numbers_differ: ['zwei Leseprogramme finden verschiedene Zahlen darin'],
  object_catalogue: ['der Katalog der Gegenstände'],
  object_entry: ["Gegenstand '{object}'"],
  object_id: ['die Kennung eines Gegenstands im Katalog'],
  object_ignored: [
    'Nicht zu öffnen und darum weggelassen: {objects:list} ({why:problem}).',
    'Du musst nichts tun, außer wenn die Trajektorie darin ist: Dann sichere in MATLAB die Zahlen daraus.',
  ],
  object_is_fixed: [
    "'{object}' steht fest, nichts kann es greifen; nenne einen Gegenstand, der sich bewegt.",
  ],
  object_mesh_empty: [
    'Das Netz {mesh} hat keine Dreiecke oder einen Eckpunkt, der nicht endlich ist.',
    'Exportiere es noch einmal.',
  ],
  object_mesh_flat: [
    'Das Netz {mesh} ist flach; was fällt und gehalten wird, braucht ein Volumen.',
    'Gib ihm eine Dicke oder schreib fixed: true.',
  ],
  object_mesh_missing: [
    'Das Netz {mesh} gibt es nicht.',
    'Lege es unter {path} ab, oder berichtige die URI.',
  ],
  object_mesh_size: [
    'Das Netz {mesh} misst {size:length}; erwartet: {low:length} bis {high:length}.',
    'Exportiere es in Metern.',
  ],
  object_mesh_too_fine: [
    'Das Netz {mesh} hat {count:integer} Dreiecke; erwartet: höchstens {most:integer}.',
    'Vereinfache es, in Blender mit dem Modifikator Decimate.',
  ],
  object_mesh_unreadable: [
    'Das Netz {mesh} ist nicht lesbar: {why:problem}.',
    'Exportiere es noch einmal.',
  ],
  object_mesh_uri: [
    "Das Netz ist '{mesh}'; erwartet wird eine URI, die mit {prefix} beginnt und auf {formats:either} endet.",
  ],
  object_not_in_scene: [
    "Die Szene hat keinen Gegenstand '{object}'[; vorhanden: {known:list}].",
    '[Meinst du {close}?]',
  ],
  object_unreadable: ['mat-io kann es nicht lesen ({error})'],
  odd_bytes: [
    '{part:choice variable=eine Variable hat|fields=die Feldnamen eines struct haben} {count:integer} Bytes; das ist kein Vielfaches von {unit_size:integer}',
  ],
  of_another_end_effector: [
    "Die Trajektorie '{id}' wurde für den Endeffektor {made_for} gemacht, den dieser Roboter nicht trägt[; er trägt {carried}].",
    'Tausche den Endeffektor, oder wandle die Datei noch einmal um.',
  ],
  of_another_model: [
    "Die Trajektorie '{id}' wurde für {made_for} gemacht; dieser Roboter ist ein {robot_model}.",
    'Wandle die Datei noch einmal für {robot_model} um.',
  ],
  of_other_joints: [
    "Die Trajektorie '{id}' hat die Gelenke {found:list}; erwartet: {expected:list}.",
    'Wandle die Datei noch einmal um.',
  ],
  of_robot: ['{robot}: {why:problem}'],
  one_local_user: [
    'Dieses Labor hat eine einzige Person am Rechner selbst; es gibt kein Anmelden und keine gekoppelten Geräte.',
    'Für mehr Personen starte es mit Schlüsseln.',
  ],
  one_of: ['{choices:either}'],
  one_piece: ['es nennt eine einzige Variable; zusammenfügen lassen sich zwei oder mehr'],
  one_pose_each: ["'partial: each' ergibt keine Teilpunkte: Es gibt nur eine Pose."],
  open_endpoint: [
    'Die Bridge soll an {endpoint} erreichbar sein; dort könnte jeder im Netz zusehen und die Roboter bewegen.',
    'Gib dem Labor Schlüssel, nimm tcp/127.0.0.1, oder lass es mit dem Parameter insecure zu.',
  ],
  open_to_network: [
    'An {host}:{port:integer} könnte jeder im Netz alles lesen und ändern.',
    'Gib dem Labor Schlüssel, nimm nur 127.0.0.1, oder lass es ausdrücklich zu.',
  ],
  opened_unseen: [
    '{object} wurde losgelassen: {robot} sollte öffnen, während die Physik nicht lief.',
  ],
  order_stated: [
    "'{source}' sagt, welches Gelenk jede Spalte von '{variable}' enthält ({words}); die Spalten wurden in die Reihenfolge von {model} gebracht.",
    'Prüfe, ob sich der Roboter richtig bewegt. Stehen die Spalten schon in der Reihenfolge des Roboters, wähle sie nach Nummern.',
  ],
  order_unclear: [
    "'{source}' gibt '{variable}' eine Reihenfolge der Gelenke ({words}); sie nennt entweder das Gelenk jeder Spalte oder die Spalte jedes Gelenks.",
    'Welche Spalten sind die Gelenke 1 bis {joints:integer}?',
  ],
  original_in_the_way: [
    '{path} ist noch von einer früheren Reparatur da.',
    'Lege es anderswohin, dann repariere noch einmal.',
  ],
  other_authority: [
    'Das Zertifikat {path} wurde von {signer} unterschrieben und nicht von der Zertifizierungsstelle dieses Ordners, {authority}.',
  ],
  other_candidates: [
    "'{variable}' wurde genommen; infrage kommt auch: {others:list}.",
    'Willst du eine andere, nenne sie beim Namen.',
  ],
  other_class_schema: [
    '{file} hat das Schema {found}; erwartet: {expected}.',
    'Bewerte die Klasse mit dieser Version noch einmal.',
  ],
  other_ending: [
    "'{file}' gehört zu keiner Art von Datei, die gelesen wird.",
    'Der Name muss auf {endings:either} enden.',
  ],
  other_key: [
    '{path} ist nicht der Schlüssel zu {certificate}.',
    'Hole den zurück, der damit erzeugt wurde.',
  ],
  other_lab: [
    'In dieser ROS-Domain ist noch ein Labor, {other_lab}. Dieses hier, {lab}, beachtet es nicht, aber Topics und Dienste mit gleichem Namen teilen sie sich.',
    'Starte eines der beiden mit einer anderen ROS_DOMAIN_ID neu.',
  ],
  other_length: ["'{variable}' ist {size}, und '{other}' hat {rows:count Zeile|Zeilen}"],
  other_mode: [
    'Die Zelle wird {found:choice parallel=parallel|sequential=nacheinander} abgespielt; erwartet: {mode:choice parallel=parallel|sequential=nacheinander}.',
  ],
  other_model: ['{name} ist ein anderer Roboter oder hat einen anderen Endeffektor'],
  other_protocol: [
    'Dieses Gateway spricht {ours}[ und die Seite {theirs}].',
    'Lade die Seite neu.',
  ],
  other_storage: [
    '{file} nennt als Speicherart {storage}[ mit der Kompression {compression}]; erwartet wird mcap ohne Kompression.',
    'Importiere das Bag; das macht ein gewöhnliches daraus.',
  ],
  other_unit: ["'{text}' hat die Einheit '{given}'; erwartet: {expected:problem}."],
  others_exchange: ['andere können austauschen, was in {path} liegt'],
  others_go_on: ['Kollision von {robot}; die anderen machen weiter'],
  others_publish: [
    'Die Wiedergabe beginnt nicht: Auf {topics:list} wird schon gesendet, von {nodes:list}.',
    'Beende, was dort sendet, oder gib in einer anderen ROS-Domain wieder.',
  ],
  others_write: ['andere können in {path} schreiben'],
  out_of_attach_reach: [
    '{object} ist {distance:length} von der Hand von {robot} entfernt; erwartet: höchstens {limit:length} (attach_reach).',
    'Bring die Hand zum Gegenstand oder den Gegenstand zur Hand, und hänge ihn dann an.',
  ],
  out_of_reach: [
    '{place:position} ist außer Reichweite: Das Werkzeug kommt bis auf {value:length} heran, nicht bis auf {limit:length}.',
  ],
  outside_range: [
    '{joint} ist {value:measure} außerhalb seines Bereichs von {lower:measure} bis {upper:measure}.',
    'Lass das Gelenk in seinem Bereich, oder wandle die Datei für diesen Roboter noch einmal um.',
  ],
  over_payload: [
    '{mass:mass} ist mehr als die {payload:mass}, die {robot} mit diesem Endeffektor tragen darf.',
  ],
  over_speed: [
    '{joint} bewegt sich mit {value:measure}; seine Grenze ist {limit:measure}.',
    'Lass die Bewegung mindestens {times:number}-mal so lange dauern.',
  ],
  owner_erased: [
    '{count:count Trajektorie|Trajektorien} von {owner} und alles, was {owner} hochgeladen hat, wurden gelöscht.',
  ],
  own_pages_only: ['Das dürfen nur die eigenen Seiten dieses Gateways anfragen.'],
  package_missing: [
    'Das Paket {package} ist hier nicht installiert.',
    'Baue es mit `make`, oder mit colcon auf einem Rechner mit ROS.',
  ],
  page_silent: ['Von dieser Seite kam {wait:time} lang nichts.'],
  pages_built: ['Seiten: gebaut'],
  pages_full: [
    'Verbunden sind {own:count Seite|Seiten} von {person} und {all:integer} von allen Personen.',
    'Schließe einige, dann lade diese neu.',
  ],
  pages_not_built: ['Seiten: nicht gebaut', 'Führe make demo aus, oder scripts/npm run build.'],
  pages_not_served: [
    'Die Seiten lassen sich unter {host}:{port:integer} nicht anbieten: {why:problem}.',
    'Vielleicht hat ein anderes Labor diesen Port; wähle einen anderen.',
  ],
  paired_role_too_high: [
    `{person} hat die Rolle {role:choice ${ROLE}} und kann kein Gerät mit der Rolle {wanted:choice ${ROLE}} koppeln.`,
    `Wähle höchstens die Rolle {role:choice ${ROLE}}.`,
  ],
  pairing_ended: ['Dieses Koppeln ist beendet.', 'Beginne ein neues.'],
  parameters_not_attached: ['die Parameter von {node} sind nicht im Bag: {why:problem}'],
  partial_gives_nothing: [
    "'partial: until' mit {until:measure} ergibt keine Teilpunkte: Der Wert muss {side:choice below=unter|above=über} der Grenze von {limit:measure} liegen.",
  ],
  passed_already: [
    'Der Roboter ist an {until:time} schon vorbei.',
    'Halte an, dann springe zurück.',
  ],
  password_length: [
    'Das Passwort hat {count:count Zeichen|Zeichen}; nötig sind {least:integer} bis {most:integer}.',
    'Mehrere Wörter merkt man sich leicht.',
  ],
  path_length: [
    'Der Weg des Werkzeugs ist {value:length} lang; erwartet: höchstens {limit:length}.',
  ],
  pause_first: ['halte zuerst an'],
  paused: ['angehalten bei {position:time}'],
  paused_without: ['angehalten bei {position:time}; keine Antwort von {robots:list}'],
  payload: [
    'Mit {other} trägt der Roboter {value:mass}; neben seinem Endeffektor darf er {limit:mass} tragen.',
    'Nimm einen leichteren Gegenstand, oder einen Roboter mit mehr Traglast.',
  ],
  last_instructor: [
    '{name} ist die einzige Lehrperson dieses Labors.',
    'Mach zuerst jemand anderen zur Lehrperson.',
  ],
  last_known: [
    'Das ist der letzte bekannte Stand, denn der Speicher antwortet nicht. {why:problem}',
  ],
  device_lets_in: [
    'Ein gekoppeltes Gerät kann kein anderes Gerät einlassen.',
    'Bestätige den Code in einem Browser, in dem du dich mit deinem Passwort angemeldet hast.',
  ],
  users_locked: [
    '{path} lässt sich gerade nicht lesen: {why:problem}. Seiten von Anmeldungen, die inzwischen enden, bleiben offen.',
    'Beende das Programm, das die Datei geöffnet hat.',
  ],
  users_other_version: [
    '{path} wurde von einer anderen Version dieses Programms geschrieben.',
    'Lege die Datei beiseite, und füge die Personen neu hinzu.',
  ],
  texts_wait: [
    '{size:bytes} Text warten auf diese Seite; sie liest sie nicht.',
    'Verbinde dich neu.',
  ],
  person_exists: [
    "Jemand heißt schon '{name}'.",
    'Wähle einen anderen Namen, oder entferne erst diese Person.',
  ],
  pieces_differ: [
    "Die Gelenke ab '{variable}' sind verschieden lang: Die meisten haben {usual:count Messpunkt|Messpunkte}, aber nicht {others:list}.",
    'Suche die fehlenden Messpunkte, und sichere alle neu. Beginnen alle gleichzeitig, kürze sie auf die ersten {rows:integer}.',
  ],
  places_not_known: [
    '{file} nennt Roboter, aber nicht ihre Plätze.',
    'Nenne die Szene, in der sie stehen, oder trage Roboter in die Datei ein.',
  ],
  playback_restarted: ['ihr Prozess wurde neu gestartet; Abspielen macht hier weiter'],
  playback_silent: [
    'Die Wiedergabe von {robots:list} hat nicht innerhalb von {timeout:time} geantwortet.',
    'Versuche es noch einmal.',
  ],
  playbacks_missing: ['Nach {limit:time} ist die Wiedergabe von {robots:list} noch nicht da.'],
  played_back: ['rückwärts bis zum Anfang abgespielt'],
  played_to_end: ['bis zum Ende abgespielt'],
  plays: ['läuft'],
  plays_backwards: [
    'Die Zelle spielt rückwärts (Rate {rate:number}); eine Prüfung spielt vorwärts.',
  ],
  plays_once: ['läuft einmal'],
  point_count: [
    '{file} enthält {count:count Punkt|Punkte}; erwartet: 1 bis {most:integer}, einer je Zeile: x, y, z in m.',
  ],
  point_not_numbers: [
    "{file}, Zeile {line:integer} ist '{found:list}'; erwartet werden drei Zahlen: x, y, z in m, in world.",
  ],
  point_out_of_order: [
    'Das Werkzeug kommt am Punkt {number:integer} ({point:position}) vor dem Punkt {before:integer} vorbei und nicht danach.',
    'Ordne die Punkte so, wie das Werkzeug an ihnen vorbeikommen soll, oder ändere den Weg.',
  ],
  point_too_far: [
    '{file}, Zeile {line:integer} ist {point:position}; erwartet wird ein Punkt höchstens {most:length} vom Ursprung von world.',
  ],
  points_nowhere: ["'{variable}' verweist ins Leere"],
  port_free: ['Port {port:integer} ({what}): frei'],
  port_in_use: [
    'Port {port:integer} ({what}): ein anderes Programm hat ihn',
    'Beende dieses Programm, oder starte das Labor mit einem anderen Port.',
  ],
  port_ours: ['Port {port:integer} ({what}): das laufende Labor hat ihn'],
  pose_count: [
    'poses hat {count:count Eintrag|Einträge}; erwartet: 1 bis {most:integer}, etwa [[0.4, -0.3, 0.2]], in m in world.',
  ],
  pose_hint: [
    '{hint:choice down=die Spalten 4 bis 6 sind die Orientierung eines Werkzeugs, das nach unten zeigt|still=die Spalten 4 bis 6 ändern sich nie, während sich 1 bis 3 bewegen|wraps=die Spalten 4 bis 6 springen zwischen -pi und pi wie Winkel einer Orientierung|circle=zwei der Spalten 1 bis 3 laufen auf einem Kreis}',
  ],
  pose_not_finite: ['Die Pose {found:list} ist nicht endlich.'],
  pose_not_turned: [
    'Verlangt ist ein Winkel, aber die Pose {number:integer} hat keine Orientierung; ergänze rpy_deg: [[180, 0, 0]] neben ihrer position, oder lass den Winkel weg.',
  ],
  pose_out_of_reach: [
    'Die Pose {number:integer} ({place:position}) ist außer Reichweite: Das Werkzeug kommt bis auf {value:length} heran, nicht bis auf {limit:length}.',
  ],
  pose_ranges: [
    'die Spalten 1 bis 3 reichen bis {far:number} und die Spalten 4 bis 6 nur bis {near:number}: mm und {angles:choice rad=rad|deg=Grad}',
  ],
  pose_too_early: [
    'Das Werkzeug kommt an der Pose {number:integer} ({place:position}) bei {time:time} vorbei, vor der, die zuerst kommt; erreicht: {passed:integer} von {count:count Pose|Posen}.',
  ],
  pose_too_far: [
    'Das Werkzeug kommt an der Pose {number:integer} ({place:position}) bei {time:time} in {value:length} Abstand vorbei; erwartet: höchstens {limit:length}; erreicht: {passed:integer} von {count:count Pose|Posen}.',
  ],
  pose_turned: [
    'Das Werkzeug ist an der Pose {number:integer} ({place:position}) bei {time:time} um {value:angle} verdreht; erwartet: höchstens {limit:angle}; erreicht: {passed:integer} von {count:count Pose|Posen}.',
  ],
  poses_passed: [
    'Das Werkzeug erreicht {passed:integer} von {count:count Pose|Posen}, mit höchstens {value:length} Abstand.',
  ],
  position_beyond: [
    "Die Szene will {robot} bei {position:time} von '{trajectory}', und die dauert {duration:time}.",
    "Setze 'at' auf höchstens {most:exact}.",
  ],
  position_count: [
    'Es gibt {count:count Position|Positionen}; erwartet: {joints:integer}, eine für jedes bewegliche Gelenk.',
  ],
  positions_in_range: ['Positionen in ihren Bereichen, bis auf {tolerance:exact} rad'],
  positions_not_finite: [
    "Die Positionen von '{id}' enthalten NaN oder Inf.",
    'Sichere endliche Werte in Radiant.',
  ],
  positions_shape: [
    "Die Positionen von '{id}' sind {size}; erwartet werden mindestens 2 Zeilen und {joints:count Spalte|Spalten}, eine für jedes Gelenk.",
  ],
  process_died: [
    '{process} ist gestorben ({how:problem}), mit ihm {robots:list}; alle stehen bei {position:time}',
  ],
  process_froze: ['{process} läuft nicht, mit ihm {robots:list}; alle stehen bei {position:time}'],
  process_silent: [
    'seit {silent:integer} s kein Lebenszeichen: abgebrochen oder hängen geblieben',
  ],
  undecodable: [
    '{count:count Nachricht|Nachrichten} auf {topic} ließen sich nicht als {type} lesen und blieben ohne Wirkung[; Sender: {publishers:list}].',
    'Beende das Programm, das sie sendet, oder lass es {type} senden.',
  ],
  thread_failed: [
    'Der Thread {thread} scheiterte: {error:problem}[; {again:integer}-mal, seit das gemeldet wurde].',
  ],
  thread_ends: [
    'Der Thread {thread} scheiterte {failures:integer}-mal hintereinander. Sein Prozess endet, und das Labor startet ihn neu.',
  ],
  provider_incomplete: ['{url} nennt nicht: {missing:list}.'],
  provider_other: [
    '{url} gehört zu einem anderen Anbieter[, {issuer},] und nicht zum eingestellten.',
  ],
  provider_silent: [
    'Der Anbieter {issuer} antwortet nicht, wie er sollte: {why:problem}.',
    'Versuche es noch einmal, oder melde dich mit einem Passwort an.',
  ],
  published_already: ["Dieser Entwurf wurde schon veröffentlicht, als '{id}'."],
  pybullet_missing: [
    'pybullet ist für dieses Python {version} nicht installiert; Wheels gibt es für 3.10 und 3.11.',
    'Installiere eines davon und richte alles neu ein, oder baue es mit pip install pybullet; das dauert Minuten.',
  ],
  python_fits: ['Python {version} passt'],
  python_unfit: [
    'Python {version}; erwartet: {first} bis {last}',
    'Installiere Python 3.11, und richte das Labor damit ein: MRLAB_PYTHON=python3.11 make demo.',
  ],
  quantity: [
    '{quantity:choice length=eine Länge|angle=ein Winkel|time=eine Zeit|speed=eine Geschwindigkeit|share=ein Anteil in Prozent|number=eine Zahl}, etwa {example}[ (Einheiten: {units:list})]',
  ],
  quaternions: ['die Spalten 4 bis 7 sind Einheitsquaternionen'],
  quic_unbounded: [
    'Die Bridge soll an {endpoint} erreichbar sein; bei QUIC kann sie für eine Person weder die Zahl der Verbindungen noch die der Bytes begrenzen, und so könnte eine das Labor allen anderen nehmen.',
    'Nimm {better}.',
  ],
  quota_full: [
    'Deine Dateien belegen {used:bytes} von {most:bytes}, und diese passt nicht mehr dazu.',
    'Hochgeladenes wird nach einigen Tagen entfernt.',
  ],
  rate_assumed: [
    "Aus '{variable}' wurden {rate:number} Zeilen pro Sekunde genommen; der Name kann etwas anderes bedeuten.",
    'Stimmt es, sichere die Zahl als fs; sonst setze die Rate.',
  ],
  rate_conflict: [
    "'{variable}' nennt {rate:number} Zeilen pro Sekunde, '{other}' aber {limit:number}; genommen wurde die erste Zahl.",
    'Sichere nur eine davon, oder setze die Rate.',
  ],
  rate_default: [
    "'{file}' nennt keine Zahl von Zeilen pro Sekunde; genommen wurden {rate:number}.",
    'Sichere sie mit der Trajektorie als fs, oder setze die Rate.',
  ],
  rate_found: ["{rate:number} Zeilen pro Sekunde, aus '{variable}'."],
  rate_of_velocity: [
    "Die Datei nennt keine Zahl von Zeilen pro Sekunde; '{variable}' ist die Ableitung der Positionen bei {rate:number} Zeilen pro Sekunde, und diese Zahl wurde genommen.",
    'Sind die Geschwindigkeiten nicht in rad/s, setze die Rate.',
  ],
  rate_set: ['Tempo {rate:number}'],
  rate_unclear: [
    'In {found:list} kann eine Rate oder ein Schritt stehen, aber auch etwas anderes; genommen wurden {rate:number} Zeilen pro Sekunde.',
    'Sichere die Rate als fs, oder setze sie.',
  ],
  rate_unused: [
    "'{variable}' heißt wie Zeiten oder eine Rate der Zeilen, wurde aber nicht benutzt: {why:problem}; genommen wurden {rate:number} Zeilen pro Sekunde.",
    'Sichere für jede Zeile eine steigende Zeit in Sekunden, oder die Rate als die Zahl fs.',
  ],
  reach_members_first: ['warte, bis alle Mitglieder erreicht wurden, oder löse das System auf'],
  reader_died: [
    "'{file}' hat das Leseprogramm zum Absturz gebracht[ (Exit-Code {exit:integer})][ (Signal {signal:integer}[, {meaning}])][ ({error})]; die Datei ist beschädigt oder dafür gemacht.",
    'Sichere sie in MATLAB noch einmal.',
  ],
  reader_failed: [
    'Das Leseprogramm ist an {file} gescheitert (Exit-Status {status:integer})[: {problem}]',
  ],
  reader_memory: ['{file} zu lesen braucht mehr als {limit:bytes} Speicher.'],
  reader_slow: ['{file} zu lesen dauert länger als {limit:time}.', 'Ist es die richtige Datei?'],
  readers_disagree: [
    "'{variable}' aus '{file}' ist nicht zu trauen, denn zwei Leseprogramme sind sich nicht einig: {why:problem}.",
    'Sichere sie in MATLAB noch einmal, und sende die neue Datei.',
  ],
  reads_no_poses: ["'{sentence}' liest keine Posen; schreibe 'passes within 5 mm of poses'."],
  record_of_another: ["Es enthält '{id}'."],
  recorded: ['{folder} enthält {messages:count Nachricht|Nachrichten}'],
  recorded_states: [
    "'{variable}' enthält aufgenommene Gelenkzustände, aber nicht die aller Gelenke von {model}; genannt sind {found:list}.",
    'Wähle den Roboter, der aufgenommen wurde, oder gib das Bag wieder, wie es aufgenommen wurde.',
  ],
  recorder_fault: [
    'In der Aufnahme ist ein eigener Fehler aufgetreten ({error}).',
    'Bitte mit dem Protokoll der Aufnahme melden.',
  ],
  recorder_restarted: ['die Aufnahme wurde neu gestartet, bevor sie etwas empfangen hatte'],
  recording_failed: [
    '{why:problem}; das Bag ist vollständig, mit {messages:count Nachricht|Nachrichten}.',
  ],
  recording_ended_late: [
    'die Aufnahme {folder} wurde beendet, während ihr Prozess nicht lief: Sie enthält {messages:count Nachricht|Nachrichten}',
  ],
  recording_gap: ['{missing:time} fehlen ab {time:time}: Die Aufnahme wurde neu gestartet'],
  recording_gap_unknown: ['Ab {time:time} fehlt etwas: Die Aufnahme wurde neu gestartet'],
  recording_lost: ['Die Aufnahme {folder} endete mit ihrem Prozess: {why:problem}.'],
  recording_runs: ['eine Aufnahme in {bag} läuft; beende sie zuerst'],
  recording_split: ['wird in einer neuen Datei fortgesetzt'],
  recording_with_gap: ['die Aufnahme {folder}: {gap:problem}'],
  records: ['nimmt in {folder} auf'],
  reference_loses: [
    'Die Musterlösung verliert {lost:number} von {of:number} Punkten: {why:problem}.',
  ],
  reference_within_nothing: [
    'Keine Bewegung ist um höchstens 0 von einer anderen entfernt; nimm mindestens 1 mm oder 1 deg.',
  ],
  refused_by_conversion: ['beim Umwandeln nicht angenommen'],
  released_by: ['vom System {system} freigegeben'],
  remove_robots: ['{robots:list} entfernen'],
  removed_meanwhile: ["'{id}' wurde inzwischen entfernt."],
  renewal_needed: [
    'Das Zertifikat des Labors ist nicht brauchbar: {why:problem}.',
    'Mach ein neues.',
  ],
  repair_runs: ['Eine andere Reparatur von {path} läuft gerade.', 'Warte auf ihr Ende.'],
  repeated_columns: ['die Spalten {columns} nennen eine Spalte mehr als einmal'],
  repeated_pieces: ['{join} nennt eine Variable mehr als einmal'],
  replaced_meanwhile: ["'{id}' wurde ersetzt, während sie geholt wurde.", 'Lade sie noch einmal.'],
  replay_at: ['bei {position:time}'],
  replay_broke: [
    'Das Bag {path} lässt sich nicht weiterlesen ({problem}).',
    'Sieh nach, was damit ist.',
  ],
  replay_loops: ['läuft in Schleife'],
  replay_once: ['hört am Ende auf'],
  replay_over: ['die Wiedergabe ist zu Ende'],
  replay_paused: ['angehalten bei {position:time}'],
  replay_rate: ['Tempo {rate:number}'],
  replay_resumed: ['läuft weiter'],
  replay_runs: ['{bag} wird gerade wiedergegeben; beende das zuerst'],
  replays: [
    'gibt {duration:time} mit {messages:count Nachricht|Nachrichten} wieder[:{left_out:problems}]',
  ],
  report_not_built: [
    'Die Seite lässt sich nicht schreiben: Es fehlt {path}; das entsteht, wenn die Seiten gebaut werden.',
    'Baue die Seiten: npm ci und npm run build in web/.',
  ],
  request_missing: [
    'Der Dienst {service} wurde ohne Anfrage aufgerufen.',
    'Sende die Anfrage von {type} als CDR im Inhalt des Aufrufs.',
  ],
  request_not_cdr: [
    'Der Dienst {service} bekam {size:integer} Bytes, die keine Anfrage von {type} sind.',
    'Sende ihr CDR, mit dem Kopf von 4 Bytes.',
  ],
  path_from_afar: [
    "{service}: '{path}' ist ein Pfad auf der Maschine des Labors.",
    'Erwartet: ein Name ohne Ordner; Programme auf dieser Maschine rufen den Dienst über ROS auf.',
  ],
  request_too_large: [
    'Eine Anfrage an {service} hat {size:integer} Bytes; erwartet: höchstens {largest:integer} (max_size in der Liste der Erlaubten).',
  ],
  resampled: [
    "{points:count Punkt|Punkte} von '{variable}' ({duration:time}) wurden durch {curve:choice lines=Geraden|splines=kubische Splines durch ihre Geschwindigkeiten} verbunden; das ergibt {frames:count Zeile|Zeilen} mit {rate:rate}.",
    'Für eine andere Rate setze sie.',
  ],
  reserved_name: [
    "'{name}' ist ein Name des Labors selbst.",
    'Wähle einen anderen, etwa {name}_1.',
  ],
  robot_degrees: [
    "Die Grenzen von '{joint}' sind {lower:number} bis {upper:number} rad.",
    'Das sind anscheinend Grad: Schreibe Radiant.',
  ],
  robot_effort: [
    "Die größte Kraft oder das größte Moment (effort) von '{joint}' ist nicht bekannt.",
  ],
  robot_frame: [
    "Das Glied '{link}' von {origin} liegt {distance:length} und {angle:angle} von dem von {robot} entfernt.",
    'Nimm die Beschreibung desselben Produkts in derselben Version.',
  ],
  robot_gone: ['{robot} wurde inzwischen entfernt.'],
  robot_hull: [
    "Der Körper von '{link}' steht um {smaller:length} aus seinen Hüllen heraus, und sie stehen bis {larger:length} von ihm ab; erlaubt sind 5 und 20 mm.",
    'Mach die Hüllen neu, aus mehr Teilen (CoACD und V-HACD können das).',
  ],
  robot_inertia: [
    "Die Hauptträgheitsmomente von '{link}' sind {least:number}, {middle:number} und {most:number} kg*m^2.",
    'Solche hat kein Körper: Jedes ist positiv, und keines ist größer als die Summe der anderen.',
  ],
  robot_joints: [
    '{count:count Gelenk bewegt sich|Gelenke bewegen sich}; erwartet: 1 bis {most:integer}.',
    'Mach die Gelenke fest, die der Arm nicht braucht.',
  ],
  robot_left_out: ['{robot} bleibt weg: {why:problem}.'],
  robot_limits: [
    "Die Grenzen von '{joint}' sind {lower:number} bis {upper:number}.",
    'Die untere Grenze muss unter der oberen liegen.',
  ],
  robot_mass: [
    "Das <inertial> von '{link}' hat keine positive Masse oder keine Trägheit.",
    'Gib beides an, oder lass <inertial> weg.',
  ],
  robot_mesh_format: [
    'Das Netz {uri} hat ein Format, das das Labor nicht zeichnet.',
    'Wandle es in {formats:either} um.',
  ],
  robot_mesh_unreadable: [
    'Das Netz {uri} ist nicht lesbar: {why:problem}.',
    'Exportiere es noch einmal aus dem Programm, mit dem es gemacht wurde.',
  ],
  robot_mesh_uri: ["Das Netz ist '{mesh}'; erwartet wird eine URI, die mit {prefix} beginnt."],
  robot_millimetres: [
    "[Die Größe des Netzes {mesh}][Der Abstand zum Ursprung von '{joint}'] ist {size:length}; so groß ist kein Arm.",
    'Exportiere in Metern, oder ergänze beim Netz scale="0.001 0.001 0.001".',
  ],
  robot_mimic: ["'{joint}' folgt '{other}'; das Labor bewegt es mit."],
  robot_no_limits: [
    "'{joint}' hat keine Grenzen.",
    'Ergänze <limit lower= upper= velocity= effort=> aus dem Datenblatt.',
  ],
  robot_no_link: [
    "Das Gelenk '{joint}' nennt das Glied '{link}', und das gibt es nicht.",
    'Ergänze das Glied, oder berichtige den Namen.',
  ],
  robot_no_mass: [
    "Die Masse von '{link}' ist {mass:mass}.",
    'Gib die Masse aus dem Datenblatt in kg an, oder lass <inertial> weg.',
  ],
  robot_no_mesh: [
    'Das Netz {uri} fehlt[: {why:problem}].',
    'Installiere das Paket, in dem es ist, oder gib beim Import des Roboters dessen Ordner an.',
  ],
  robot_no_texture: [
    'Das Netz {uri} nennt {file}, und diese Datei fehlt.',
    'Lege sie neben das Netz, oder verzichte auf seine Farben.',
  ],
  robot_not_among: [
    "{place:problem}: {name} nennt den Roboter '{robot}', den die Szene nicht hat[; ihre Roboter: {known:list}].",
  ],
  robot_not_named: [
    "'{file}' nennt nicht den Roboter, für den die Datei ist.",
    'Nenne den Roboter, einen von {known:list}.',
  ],
  robot_nowhere: ['Den Roboter gibt es weder hier noch im Labor: {here:problem}; {lab:problem}.'],
  robot_removed: ['{robot} ist entfernt.'],
  robot_repeated: ["'{robot}' ist {count:integer}-mal genannt.", 'Nenne den Roboter einmal.'],
  robot_roots: [
    'Erwartet wird genau ein Wurzelglied; gefunden: {count:integer}[: {roots:list}].',
    'Verbinde die Glieder durch feste Gelenke.',
  ],
  robot_stated: [
    "'{source}' sagt '{words}', und gewählt wurde {model}.",
    'Ist die Bewegung trotzdem für {model}? Dann nenne die Matrix; sonst wähle den Roboter, den die Datei nennt.',
  ],
  robot_velocity: [
    "Die Grenze der Geschwindigkeit von '{joint}' ist {value:number}.",
    'Schreibe die größte Geschwindigkeit in rad/s oder m/s, oder gib sie beim Import des Roboters an.',
  ],
  robots_not_known: [
    'Das Labor sagt nicht, welche Roboter es hat; warte, bis es läuft, und versuche es noch einmal.',
  ],
  robots_stay: [
    'Nach {limit:time} sind die Wiedergabe und die Physik von {robots:list} noch nicht beendet.',
  ],
  robots_twice: [
    'Die Szene {scene} ist verlangt, und {file} enthält selbst Roboter und Objekte; lass eines davon weg.',
  ],
  role_too_low: [
    `{person} hat die Rolle {role:choice ${ROLE}}; nötig ist {needed:choice ${ROLE}}.`,
    'Frag deine Lehrkraft.',
  ],
  root_links: ['{file} hat die Wurzelglieder {links:list}; erwartet wird eines.'],
  route_without_policy: [
    '{method} {path} hat in gateway/policy.py keine Zeile; darum darf es niemand benutzen.',
  ],
  router_keys_needed: [
    'Das Labor kann sich mit seinen Schlüsseln nicht mit seinem Router verbinden: {why:problem}.',
    'Mach die Datei des Routers neu.',
  ],
  router_needs_client: [
    'Die Bridge hat Schlüssel und verbindet sich mit {endpoints:list}, mit mode {mode}[ und listen {listen:list}]; die Personen verbinden sich dann nur mit diesem Router.',
    'Lass listen leer, und setze mode auf client.',
  ],
  router_takes_certificates: [
    'Die Personen in {folder} melden sich mit {login} an, und ein Router nimmt nur Zertifikate.',
    'Mach einen Ordner, dessen Personen sich mit einem Zertifikat anmelden.',
  ],
  router_without_tls: [
    'Die Bridge hat Schlüssel und soll sich mit {endpoint} verbinden, wo sie keinen zeigen kann; erwartet wird die Adresse eines Routers wie tls/router.example.org:7447.',
  ],
  rows_already: ["'{variable}' ist {size}: ihre Messpunkte sind schon Zeilen"],
  scale_beside: [
    "'{variable}' reicht bis {value:number}, das ist nicht in Radiant; mal '{source}' ({factor:number}) liegt es in den Grenzen von {model}.",
    "Multipliziere es mit '{source}', oder nenne seine Einheit.",
  ],
  rows_left_out: [
    "'{variable}' lässt {count:integer} der {rows:count Zeile|Zeilen} von '{other}' weg.",
    'Gehören sie zur Bewegung, bring die Stelle dazwischen in Ordnung und nimm die ganze Matrix.',
  ],
  rows_not_filled: [
    "Die Zeilen {first_row:integer} bis {last_row:integer} von '{variable}' sind nur Nullen, und die Bewegung springt dorthin: Sie wurden reserviert (zeros(N, d)) und nicht gefüllt.",
    'Lass sie weg, oder fülle sie, bevor du sicherst.',
  ],
  rows_of_numbers: [
    'eine Liste von Zeilen mit je {columns:integer} {numbers:choice any=Zahlen|whole=ganzen Zahlen}',
  ],
  rubric_entry: ['{file}[:{line:integer}]: Test {number:integer}'],
  rubric_test: ["{file}[:{line:integer}]: Test '{test}'"],
  rule_goes_out: [
    'Die Regel für {topic} hat eine Rolle, geht aber hinaus; wer sich verbinden darf, empfängt es.',
    'Lass die Rolle weg, oder setze direction: in.',
  ],
  rule_without_name: [
    '{place} enthält {found}; erwartet wird ein Eintrag mit einem Namen, etwa {example}.',
  ],
  run_began: ['beginnt {trajectory}'],
  run_completed: [
    'abgeschlossen[, {rounds:integer}-mal][ nach {halts:count Kollision|Kollisionen}]',
  ],
  run_deviated: [
    'bis [{angle:fine_angle}][{distance:length}] von {reference} entfernt ({joint} bei {time:duration})[, das Werkzeug {tool:length}]',
  ],
  run_ended: ['{trajectory}: {outcome:problem}'],
  run_followed: ['folgte {reference} genau'],
  run_grasped: [
    'griff {object}[, {mass:mass}, Reibung {friction:number}, nötig {friction_needed:number}, {wrist_moment:moment} am Handgelenk]',
  ],
  run_halted: [
    'nach einer Kollision angehalten[ bei {position:time} von {length:time}], als die Aufnahme endete',
  ],
  run_handed_over: ['übergab {object} an {to}'],
  run_hit: ['{link} stieß in Zeile {row:integer} an {other}'],
  run_lost: ['verlor {object}[ bei {place:position}]'],
  run_missed: ['schloss den Greifer ins Leere'],
  run_open: ['lief noch[ bei {position:time} von {length:time}], als die Aufnahme endete'],
  run_released: [
    'ließ {object} los[ bei {place:position}][, {distance:length} vom vorgesehenen Ort entfernt]',
  ],
  run_stopped: [
    'gestoppt[ nach {halts:count Kollision|Kollisionen}][ bei {position:time} von {length:time}]',
  ],
  runs_without_physics: ['Das Labor läuft ohne Physik: {why:problem}.'],
  same_name: ["zwei Variablen heißen '{variable}'"],
  same_names: [
    "Der Roboter '{robot}' und der Endeffektor '{end_effector}' haben beide {names:list}.",
    'Gib ihnen in einer der beiden URDFs andere Namen.',
  ],
  same_test_name: [
    "'{test}' heißt auch der Test in Zeile {line:integer}; gib jedem Test einen eigenen Namen.",
  ],
  scene_loaded: [
    '{scene} ist geladen: {robots:count Roboter|Roboter}[, {objects:count Gegenstand|Gegenstände}][, {surfaces:count Fläche|Flächen}][, {systems:count System|Systeme}][; {missing:problem}].',
  ],
  scene_not_cell: [
    '{place:problem} enthält {parts:list}; eine Zelle hat nur Systeme.',
    'Lade sie als Szene.',
  ],
  second_cannot_read: ['{reader} kann sie nicht lesen ({error})'],
  second_finds: [
    '{reader} findet {second}, wo {first} gelesen wurde (Zeile {row:integer}, Spalte {column:integer}[, Seite {page:integer}]; {count:integer} von {total:integer} Werten sind verschieden)',
  ],
  second_finds_size: ['{reader} findet {size} Werte'],
  second_finds_type: ['{reader} findet Werte vom Typ {found}'],
  second_reader_crashed: [
    'das zweite Leseprogramm stürzte daran ab[ (Exit-Code {exit:integer})][ (Signal {signal:integer}[, {meaning}])][ ({error})]',
  ],
  seen: [
    '{what:choice message=es ist eine JointTrajectory für diese Gelenke|named=ihre Spalten heißen wie die Gelenke|not_finite=sie enthält NaN oder Inf|square=sie ist quadratisch|last_column=ihre letzte Spalte ist nicht die eines Greifers|between_zeros=sie beginnt und endet bei null wie Geschwindigkeiten|limits=sie verlässt die Grenzen der Gelenke|still=sie bewegt sich nie|smooth=sie bewegt sich glatt|rough=ihre Zeilen folgen nicht aufeinander wie eine Bewegung|zeros=alles darin ist 0, sie wurde nie gefüllt}',
  ],
  seen_by_all: [
    "'{id}' gehört dem Labor selbst; alle dürfen sie sehen.",
    'Damit sie jemandem gehört, veröffentliche sie als diese Person.',
  ],
  self_distance: [
    "Der Abstand eines Roboters zu sich selbst wird nicht gemessen; nimm 'no collision'.",
  ],
  sender_not_named: ['{file} nennt nicht, wer {folder} gesendet hat.'],
  sends_too_much: ['Diese Seite sendet zu viel.', 'Lade sie neu.'],
  server_silent: [
    'Der Dienst {service} hat nicht innerhalb von {timeout:time} geantwortet.',
    'Prüfe, ob sein Knoten läuft, dann rufe noch einmal auf.',
  ],
  service_ended: ['{service} endete, bevor er antworten konnte.', 'Versuche es noch einmal.'],
  service_gone: [
    'Der Dienst {service} ist weg.',
    'Prüfe, welche Knoten laufen, dann rufe noch einmal auf.',
  ],
  session_summary: [
    '{duration:duration}, {robots:count Roboter|Roboter}, {runs:count Lauf|Läufe}[, {completed:integer} abgeschlossen][, {collisions:count Kollision|Kollisionen}]',
  ],
  set_aside: ['Sie heißt jetzt {file}'],
  set_contents: [
    '{objects:count Gegenstand|Gegenstände} und {surfaces:count Fläche|Flächen} setzen',
  ],
  seven_axes: [
    "Spalte {column:integer} von '{variable}' bewegt sich wie ein Gelenk ({first:number} bis {last:number}, {levels:count Wert|Werte}) und nicht wie ein Greifer, der offen oder zu ist; {model} hat {joints:integer} Gelenke.[ Ist es ein Greifer, der sich langsam bewegt ({meaning:choice states=0 offen, 1 zu|position=eine Position von 0 (offen) bis 255 (zu) wie bei Robotiq|width_m=eine Öffnungsweite in m, größer heißt offen|percent=Prozent|width_mm=eine Öffnungsweite in mm, größer heißt offen}), dann nenne ihn.]",
    'Wähle den Roboter, für den die Datei gemacht wurde, nimm nur die Gelenke, oder sag, dass es der Greifer ist.',
  ],
  several_assets: [
    "'{key}' steht für mehrere Dateien des Labors.",
    'Hole jede über ihren eigenen Schlüssel, wie in {robots} und {objects}.',
  ],
  several_models: ['Die Gelenke auf {topic} sind die von {models:list}.', 'Nenne den Roboter.'],
  several_types: ['{topic} hat mehrere Typen ({types:list}).'],
  shape_and_parts: ['Er hat eine Form und Teile.', 'Lass eines von beiden weg.'],
  shape_lacks: ['{place:problem}: In <{tag}> fehlt: {missing:list}.', 'Ergänze es.'],
  shared_service: [
    '{service} wurde nicht aufgerufen, denn ein anderes Labor in dieser ROS-Domain hat den Dienst auch: {labs:list}.',
    'Starte eines der Labore mit einer anderen ROS_DOMAIN_ID neu; Anhalten und Stoppen erreichen weiter beide.',
  ],
  sheet_format: [
    "Die Datei ist '{file}'; erwartet wird ein Name mit der Endung {formats:either}.",
  ],
  short_point: [
    'Punkt {point:integer} hat {count:count Position|Positionen} für {joints:count Gelenk|Gelenke}',
  ],
  side_of_cup: ['Der Sauger berührt {object} mit der Seite.'],
  side_of_magnet: ['Der Magnet berührt {object} mit der Seite.'],
  sign_in_ended: [
    'Deine Anmeldung ist beendet, oder deine Rolle hat sich geändert.',
    'Melde dich an.',
  ],
  sign_in_not_begun: [
    'Diese Anmeldung dauerte zu lange, oder sie begann nicht in diesem Browser.',
    'Beginne von vorn.',
  ],
  sign_ins_full: [
    'Zu viele melden sich gleichzeitig an.',
    'Versuche es in ein paar Minuten noch einmal.',
  ],
  single_sample: [
    "'{variable}' ist {size}, eine einzelne Konfiguration; eine Trajektorie hat mindestens 2 Zeilen.",
    'Sichere eine Bewegung mit zwei oder mehr Zeilen.',
  ],
  sizes_above_zero: ['{count:count Größe|Größen} über 0, in m'],
  sizes_differ: ['die Größen sind verschieden: {sizes:list}'],
  slipped_out: [
    '{object} ist aus den Fingern gerutscht: {mass:mass}, Reibung {friction:number}, nötig {friction_needed:number}.',
  ],
  slips: [
    'Es rutscht: {mass:mass} zu halten braucht eine Reibung von {friction_needed:number}, vorhanden ist {friction:number}.',
  ],
  small_for_degrees: [
    'ihre Einheit in der Datei ist {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}, aber sie reicht nur bis {largest:number}, wie es auch Radiant tun',
  ],
  smoothness: ['Die Glattheit ist {value:number}; erwartet: mindestens {limit:number}.'],
  some_numbers: ['eine Liste von Zahlen[ {limits:problem}][ ({unit})]'],
  some_texts: ['eine Liste von Texten[, jeder {item:problem}]'],
  spawn_robots: ['{robots:list} aufstellen'],
  speed_at_end: ['{value:measure} bei {joint}'],
  speed_step: [
    '{joint} ändert seine Geschwindigkeit von einer Zeile zur nächsten um {value:measure}; sonst bleiben seine Änderungen unter {usual:measure}.',
    'Verbinde die beiden Teile der Bewegung glatt, oder halte dazwischen an.',
  ],
  speeds_in_limits: ['Geschwindigkeiten unter ihren Grenzen, bis auf {tolerance:share}'],
  squeezed: ["'{variable}' ist {size}; sie wurde als {taken} genommen, wie {line} es ergibt."],
  stages: ['fährt seine Mitglieder an ihre Plätze[, das dauert {duration:time}], dann läuft es'],
  stands_elsewhere: ['{name} steht anderswo'],
  starts_inside: [
    '{robot} beginnt innerhalb der Fläche {other}[; dazu {more:count weiterer Kontakt|weitere Kontakte}].',
  ],
  step_failed: ['{step:problem}: gescheitert, {why:problem}.'],
  step_of_zero: ['ein Schritt von 0 führt nirgendwohin'],
  still_collides: ['{robot} ist noch in Kollision'],
  still_held: ['{object} wird am Ende noch von {robot} gehalten.'],
  still_moves: ['{object} bewegt sich am Ende noch mit {value:speed}.'],
  still_touches: [
    'Der Arm berührt noch etwas.',
    'Stelle den Roboter anderswohin, verschiebe, was er berührt, oder springe zurück.',
  ],
  still_xacro: [
    '{file} enthält <xacro:{tag}>; erwartet wird eine einfache URDF.',
    'Wandle die Datei um: xacro {name} -o robot.urdf',
  ],
  stop_and_clear_first: [
    'stoppe es; dabei fahren seine Arme an ihren Anfang zurück; sind alle frei, spiele ab',
  ],
  stop_first: ['stoppe zuerst'],
  stop_left: [
    'Die Aufnahme kann gerade nicht beendet werden, weil ihr Prozess nicht läuft; der Auftrag, die Aufnahme in {bag} zu beenden, wartet und wird ausgeführt, sobald er läuft.',
  ],
  stopped: ['gestoppt'],
  store_failed: [
    'Die Ablage {store} hat versagt ({why:problem}); nichts wurde geändert.',
    'Versuche es noch einmal, wenn sie wieder geht.',
  ],
  store_silent: ['sie antwortet nicht'],
  store_folder_unusable: [
    'Der Ordner {folder} kann nicht die Ablage sein: {why:problem}.',
    'Wähle einen anderen mit dem Parameter store, oder ein anderes state_dir.',
  ],
  store_read_only: [
    'Ablage: in {folder} lässt sich nicht schreiben',
    'Gib diesem Benutzer dort Schreibrecht, oder wähle für den Zustand des Labors einen anderen Ordner.',
  ],
  store_unusable: [
    "Die Ablage '{store}' ist nicht brauchbar: {why:problem}.",
    'Prüfe die URL und die Zugangsdaten in der Umgebung (docs/store.md).',
  ],
  store_writable: ['Ablage: in {folder} lässt sich schreiben'],
  stray_rows: [
    '{joint} springt um {value:measure} bei Zeile {first_row:integer} ({time:time}) und nach Zeile {last_row:integer} zurück; die Zeilen davor und danach passen zusammen.',
    'Lass weg, was nicht dorthin gehört, oder setze das Mittel seiner Nachbarn ein.',
  ],
  submission_crashed: [
    'Die Prüfung stürzte daran ab ({why:problem}); der Grund ist diese Datei und keine andere.',
  ],
  submission_ended: ['Die Prüfung brauchte mehr als {limit:duration} eines Prozessors.'],
  submission_failed: ['Die Prüfung ist daran gescheitert ({error}).'],
  submission_given_up: [
    'Die Prüfung wurde nach {limit:duration} aufgegeben; der Rechner war überlastet.',
    'Starte denselben Befehl noch einmal: Er prüft, was zu wiederholen ist.',
  ],
  submission_out_of_memory: [
    'Die Prüfung braucht mehr als {limit:bytes} Speicher; vielleicht ist die Bewegung sehr lang.',
  ],
  subscriptions_full: [
    'Diese Seite hat {count:count Abonnement|Abonnements}.',
    'Beende erst einige.',
  ],
  surface_beyond: [
    'Die Fläche {surface} hat einen Eckpunkt, der nicht endlich ist oder weiter als 1 km weg.',
  ],
  surface_half_triangle: [
    'Die Fläche {surface} hat {count:integer} Indizes für Dreiecke; erwartet werden drei für jedes Dreieck.',
  ],
  surface_is_line: [
    'Der Umriss der Fläche {surface} ist eine Linie; erwartet wird ein Umriss mit Inhalt.',
  ],
  surface_no_vertex: [
    'Die Fläche {surface} nennt den Eckpunkt {vertex:integer} von {count:integer}; erwartet werden Indizes ihrer eigenen Eckpunkte.',
  ],
  surface_outline: [
    'Der Umriss der Fläche {surface} hat {count:count Punkt|Punkte}; erwartet werden 3 bis {most:integer}, oder Dreiecke.',
  ],
  surface_too_fine: [
    'Die Fläche {surface} hat {count:integer} Dreiecke; erwartet: höchstens {most:integer}.',
    'Vereinfache das Netz, oder sende stattdessen die Ebenen des Raums.',
  ],
  surface_without_name: [
    'Eine Fläche hat keinen Namen.',
    'Gib jeder einen eigenen, etwa table_1.',
  ],
  surfaces_changed: ['die Flächen des Raums haben sich geändert'],
  surfaces_of_one_name: ['Zwei Flächen heißen {name}.', 'Gib jeder einen eigenen Namen.'],
  system_created: [
    '{system} bewegt {robots:list}: {duration:time}, {mode:choice parallel=alle zugleich|sequential=einer nach dem anderen}',
  ],
  system_gone: ['Das System {system} ist aufgelöst.'],
  system_left_out: ['Das System {system} bleibt weg: Seine Roboter sind nicht alle da.'],
  system_lost: [
    'Das System {system} ging verloren: Sein Eintrag im Journal ist beschädigt.',
    'Erstelle es noch einmal.',
  ],
  test_count: ['tests hat {count:count Eintrag|Einträge}; erwartet: 1 bis {most:integer}.'],
  test_pose: ['{place:problem}: Pose {number:integer}'],
  text_no_json: ['Ein Textpaket ist kein JSON-Objekt[: {why:problem}].'],
  text_not_read: ['Es gibt auch einen Online-Text; er wird nicht gelesen.'],
  text_or_texts: ['ein Text oder eine Liste von Texten[, jeder {item:problem}]'],
  text_unread: [
    "'{source}' sagt '{words}', und {unread:list} ist unbekannt: '{variable}' wurde so genommen, wie sie ist.",
    'Ändert es die Bedeutung der Zahlen, wende es an und speichere das Ergebnis als q.',
  ],
  thing_not_in_scene: [
    "In der Szene heißt nichts '{thing}'; vorhanden: {known:list}.",
    '[Meinst du {close}?]',
  ],
  time_backward: [
    "Die Zeit '{variable}' geht in {count:count Zeile|Zeilen} zurück, zuerst in Zeile {first_row:integer}; die Zeilen werden in ihrer Reihenfolge abgespielt, {rate:number} pro Sekunde.",
    'Prüfe, ob zwei Aufnahmen zusammengefügt wurden; sortiere die Zeilen in MATLAB, oder nimm eine davon, etwa q(1:{last:integer}, :).',
  ],
  time_column: [
    "Spalte {column:integer} von '{variable}' ist Zeit ({first:number} bis {last:number}) und kein Gelenk: {why:problem}.[ Die Spalten {columns} sind die Gelenke.][ Übrig: {left:count Spalte|Spalten}; {model} hat {joints:integer} Gelenke.]",
    'Nimm nur die Gelenke, oder sichere sie allein und die Zeit als t.',
  ],
  time_counts_rows: [
    "'{variable}' zählt in Einerschritten: Sekunden, Millisekunden oder die Nummern der Zeilen; genommen wurden {rate:number} Zeilen pro Sekunde.",
    'Sichere die Zeit in Sekunden, oder setze die Rate.',
  ],
  time_length: [
    "'{variable}' hat {value:integer} Elemente und die Trajektorie {limit:integer} Zeilen; die Zeit wurde nicht benutzt, sie ergäbe {rate:number} Zeilen pro Sekunde.",
    'Sichere für jede Zeile eine Zeit, oder setze die Rate.',
  ],
  time_not_finite: ['ihre Zeile {first_row:integer} ist {value:number}'],
  time_repeated: [
    "{count:count Zeile|Zeilen} von '{variable}' mit der Zeit der Zeile davor, zuerst Zeile {first_row:integer}; die Zeilen werden gleichmäßig abgespielt, {rate:number} pro Sekunde.",
    'Lass diese Zeilen weg, und mach die übrigen gleichmäßig.',
  ],
  time_rounded: [
    "Die Zeiten von '{variable}' sind auf {value:number} s gerundet; die Zeilen kommen gleichmäßig, {rate:number} pro Sekunde.",
  ],
  time_uneven: [
    "Die Schritte von '{variable}' gehen von {least:number} bis {most:number} s, der schlechteste vor Zeile {first_row:integer}; gleichmäßig abgespielt, mit {rate:number} Zeilen pro Sekunde, ist eine Zeile bis zu {value:number} s von ihrer Zeit entfernt.",
    'Mach die Zeiten gleichmäßig, hier oder in MATLAB mit interp1.',
  ],
  time_unit: [
    "'{variable}' steigt von Zeile zu Zeile um {step:number}; das wurde als {taken:choice s=Sekunden|ms=Millisekunden|us=Mikrosekunden|ns=Nanosekunden|days=Tage, wie datenum sie zählt,|min=Minuten|h=Stunden} gelesen und ergibt {rate:number} Zeilen pro Sekunde.",
    'Sichere die Zeit in Sekunden, oder setze die Rate.',
  ],
  times_of_class: ['ihre Klasse ist {found:problem}'],
  times_swapped: [
    '{first:time} liegt nicht vor {last:time}; erwartet wird die frühere Zeit zuerst.',
  ],
  tls_needs_keys: [
    'Die Bridge soll an {endpoint} erreichbar sein; für {protocol} braucht sie Schlüssel.',
    'Mach welche, und nenne ihren Ordner (Parameter keys).',
  ],
  too_close: [
    '{link}[ (hält {held})] kommt auf {value:length} an {kind:choice self=das eigene Glied|robot=den Roboter|object=den Gegenstand|surface=die Fläche} {other}[ ({other_link})] heran.',
    'Halte mehr Abstand: Eine echte Zelle ist weniger genau gemessen als diese.[ {advice:problem}.]',
  ],
  too_few_bytes: [
    "[die Zahlen von '{variable}' haben][der Text '{text}' hat][{element:choice any=ein Element hat}] {left:integer} Bytes, nötig sind {needed:integer}",
  ],
  too_few_columns: [
    "'{variable}' hat {width:integer} Spalten, und ohne Spalte {column:integer} bleiben für die {joints:integer} Gelenke von {model} nur {left:integer}",
  ],
  too_large: [
    "'{file}' ist zu groß: {part:choice file=Sie hat|bag=Das Bag hat|numbers=Ihre Matrizen haben|variable=Eine ihrer Variablen hat|inflated=Entpackt hat sie|reading=Sie zu lesen braucht|converting=Sie umzuwandeln braucht} mehr als {limit:bytes}[, nämlich {size:bytes}].",
    'Sichere nur die Trajektorie.',
  ],
  too_long: [
    "'{variable}' dauert {duration:time}; das sind bei {rate:rate} mehr als {most:integer} Zeilen.",
    'Prüfe ihre Zeiten auf eine Lücke, und die Zeit ihres letzten Punkts; höchstens {lower:rate} passen.',
  ],
  too_long_for_lab: [
    "'{trajectory}' dauert {duration:time}; erwartet: im Labor höchstens {most:time}.",
    'Lade sie herunter, und prüfe sie auf deinem eigenen Rechner.',
  ],
  too_many_bytes: [
    "{count:count Byte folgt|Bytes folgen} auf [den Inhalt von '{variable}'][{behind:choice checksum=die Prüfsumme einer komprimierten Variablen}]",
  ],
  too_many_checks: [
    '{count:count Bewegung wartet|Bewegungen warten} schon auf ihre Prüfung; versuche es in {seconds:time} noch einmal.',
  ],
  too_many_files: ['{file} enthält mehr als {most:integer} Dateien; erwartet werden weniger.'],
  too_many_links: ['{file} hat {count:integer} Glieder; erwartet: höchstens {most:integer}.'],
  too_many_objects: [
    '{count:count Gegenstand ist|Gegenstände sind} zu viel; erwartet: höchstens {most:integer} (max_objects in config/physics.yaml).',
  ],
  too_many_parts: ['es hat mehr als {most:integer} Teile'],
  too_many_requests: [
    'Das ist zu oft: {what:choice uploads=Hochladen|conversions=Umwandeln|checks=Prüfen|sign_ins_by_address=Anmelden von dieser Adresse|sign_ins_by_name=Anmelden mit diesem Namen|links=Links von dieser Adresse|pairings=Koppeln von dieser Adresse|tries=Versuche|launches=Starten von dieser Adresse|hand_ins=Abgeben}.',
    'Versuche es in {wait:time} noch einmal.',
  ],
  too_many_rows: [
    "'{variable}' hat {rows:count Messpunkt|Messpunkte}; die Grenze ist {most:integer}.",
    'Sichere einen Teil davon oder jeden zehnten Messpunkt, oder erhöhe die Grenze der Zeilen.',
  ],
  too_much_waits: [
    '{count:count Nachricht wartet|Nachrichten warten} mit {size:bytes} auf diese Seite; sie bestätigt sie nicht.',
    'Verbinde dich neu, und hole, was fehlt.',
  ],
  too_slow: [
    "'{file}' ließ sich nicht innerhalb von {limit:time}[ {clock:choice processor=Prozessorzeit}] lesen; das Lesen wurde abgebrochen.",
    'Sichere nur die Trajektorie.',
  ],
  too_wide: ['{object} ist breiter, als der Greifer sich öffnet.'],
  tool_from_place: [
    'Das Werkzeug {instant:choice start=beginnt|end=endet} {value:length} von {place:position} entfernt; erwartet: höchstens {limit:length}.',
  ],
  tool_of: ["ihre Spalten 1 bis 3 sind die Positionen des Werkzeugs bei '{other}'"],
  tool_path: ["'{other}' ist der Weg des Werkzeugs bei diesen Gelenkwinkeln"],
  tool_path_differs: [
    "'{other}' ist auf diesem Roboter nicht der Weg des Werkzeugs bei '{variable}': Sie liegen {value:length} auseinander, und der Weg erstreckt sich über {limit:length}.",
    'Wähle den Roboter, für den die Datei gemacht wurde, oder prüfe, ob beide zu einer Bewegung gehören.',
  ],
  tool_speed: ['Das Werkzeug bewegt sich mit {value:speed}; erwartet: höchstens {limit:speed}.'],
  total_time: ['Alles dauert {value:time}; erwartet: höchstens {limit:time}.'],
  touches: [
    '{link}[ (hält {held})] berührt {kind:choice self=das eigene Glied|robot=den Roboter|object=den Gegenstand|surface=die Fläche} {other}[ ({other_link})] bei {time:time}[; dazu {more:count weiterer Kontakt|weitere Kontakte}].',
  ],
  trajectory_deleted: ["'{id}' wurde gelöscht.", 'Stelle sie wieder her, wenn du sie brauchst.'],
  trajectory_hidden: ["'{id}' sehen {owner} und Lehrende."],
  trajectory_lost: ['{robot} hat {trajectory} verloren: {why:problem}.', 'Lade sie noch einmal.'],
  trajectory_not_fitting: [
    "Die Szene will, dass {robot} '{trajectory}' abspielt; der Katalog hat sie für ihn nicht[; vorhanden: {known:list}].",
    'Wandle die Datei um, dann lade noch einmal.',
  ],
  trajectory_published: ["'{id}' ist veröffentlicht, Version {version:integer}."],
  trajectory_quota: [
    'Die Trajektorien von {owner} belegen {used:bytes} und diese {size:bytes}; erwartet: zusammen höchstens {limit:bytes}.',
    'Lösche, was niemand mehr braucht.',
  ],
  trajectory_restored: ["'{id}' ist wieder da, Version {version:integer}."],
  trajectory_shared: ["'{id}' sehen alle."],
  trajectory_taken: [
    "'{variable}' aus '{file}' wurde genommen: {frames:count Zeile|Zeilen} mit {rate:rate}, {duration:time}[, mit {warnings:count Warnung|Warnungen}]",
  ],
  trajectory_unreadable: [
    '{attachment} ist nicht lesbar; Läufe davon werden mit nichts verglichen',
  ],
  transforms: [
    "'{variable}' ({size}) enthält homogene Transformationen, eine je Seite: Posen und keine Gelenkwinkel.",
    'Sichere die Gelenkwinkel, eine Zeile je Messpunkt; MATLAB berechnet sie aus Posen mit inverseKinematics, die Toolbox von Corke mit ikine.',
  ],
  transpose_applied: ["Wie gewünscht wurde '{variable}' transponiert."],
  transposed: [
    "'{variable}' ist {size}: die Messpunkte sind Spalten, {model} braucht eine Zeile je Messpunkt.[ Zeile {time_row:integer} ist Zeit.]",
    'Transponiere sie.',
  ],
  true_or_false: ['true oder false'],
  turned_twice: ['rpy_deg und orientation sind beide angegeben; schreibe nur eines davon.'],
  twice_in_archive: ['Die Datei ist zweimal im Archiv; die letzte wird gelesen.'],
  twice_in_urdf: [
    "{file}: {what:choice joint=Zwei Gelenke heißen|link=Zwei Glieder heißen|child=Zwei Gelenke haben als child} '{name}'; erwartet wird ein Baum von Gliedern, jedes mit eigenem Namen.",
  ],
  twin: [
    "'{variable}' wurde genommen; fast dieselbe Bewegung ist in {others:list}.",
    'Willst du die andere, nenne sie beim Namen.',
  ],
  two_dates: ['sie hat in {count:integer} Spalten ein Datum; behalte eine davon'],
  type_not_installed: [
    "Der Nachrichtentyp '{type}' ist hier nicht installiert.",
    'Installiere sein Paket, und starte das Labor neu.',
  ],
  type_unknown: ['das Bag beschreibt {type} nicht, und der Typ ist hier nicht installiert'],
  type_without_text: [
    'Der Text von {type} ist nicht installiert.',
    'Installiere das Paket {package}, oder lass die Topics dieses Typs weg.',
  ],
  uncertain_grasp: [
    '{other} im Greifer: {why:problem}.',
    'Bewege dort sanfter, oder greife näher am Schwerpunkt.',
  ],
  unit_conflict: [
    "'{source}' nennt für '{variable}' die Einheit {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}, '{other}' aber {second:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}.",
    'Was stimmt? Nenne die Einheit.',
  ],
  unit_mixed: [
    'die Spalten {columns} reichen bis {largest:number} wie Grad, die Spalten {others} aber bewegen sich wie Radiant; keine Einheit passt für alle',
  ],
  unit_named: ['ihr Name sagt Grad'],
  unit_reaches: [
    'sie reicht bis {largest:number}[ und bleibt nur in den Grenzen von {model}, wenn das {fits:choice degrees=Grad sind|hundredths=Hundertstelgrad oder Zählschritte sind|thousandths=Tausendstelgrad oder Zählschritte sind}][, wie es Grad tun und Radiant bei {beyond} nicht][{counted:choice counts=, in ganzen Zahlen wie die Zählschritte eines Encoders}]',
  ],
  unit_of_name: [
    "'{variable}' heißt nach der Einheit {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}; erwartet werden Radiant.",
    'Rechne die Werte in Radiant um, oder bestätige die Einheit, indem du sie nennst.',
  ],
  unit_stated: [
    "'{source}' nennt die Einheit {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}",
  ],
  unit_unread: [
    "'{source}' nennt für '{variable}' '{words}', und das ist keine bekannte Einheit von Winkeln; die Werte wurden als Radiant gelesen.",
    'Schreib dort rad oder deg, oder nenne die Einheit.',
  ],
  units_applied: [
    "Wie gewünscht wurde '{variable}' als {taken:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}[, {counts:number} je Umdrehung,] gelesen.",
  ],
  units_contradict: ['zugleich wurden Grad verlangt; nenne eine Einheit, etwa {found}'],
  units_unknown: [
    "in ihrer Zeile mit Einheiten steht '{found}', und diese Einheit ist hier nicht bekannt",
  ],
  unknown_class: ['diese Klasse kennt nur MATLAB'],
  unknown_class_number: [
    "'{variable}' hat die Klassennummer {found:integer}; die schreibt MATLAB nie",
  ],
  unknown_field: [
    "{place:problem}: '{key}' ist unbekannt[; erwartet: {fields:list}].",
    "[Meinst du '{close}'?]",
  ],
  unknown_message_type: [
    '{type} ist kein bekannter Nachrichtentyp.',
    'Erwartet wird ein üblicher Typ oder einer aus mrlab_msgs, etwa mrlab_msgs/msg/Robots oder mrlab_msgs/srv/Seek_Request.',
  ],
  unknown_partial: ["partial ist '{rule}'; '{sentence}' kennt {rules:list}."],
  unknown_sentence: [
    "'{text}' kann eine Rubrik nicht messen; meinst du {close:either}?",
    'Was sich messen lässt, steht in docs/rubrics.md.',
  ],
  unknown_unit: ['die Einheiten sind {known:list}'],
  unknown_variable: [
    "'{file}' hat keine Variable '{variable}'. Die Datei enthält {count:count Variable|Variablen}[: {held:list}][ und {more:integer} weitere].[ Darin: {inside:list}.]",
    'Nimm einen dieser Namen, genauso geschrieben.',
  ],
  unloaded: ['entladen'],
  unreadable: [
    "'{file}' ist beschädigt: {why:problem}.",
    'Kopiere die Datei noch einmal, oder sichere sie noch einmal[, in Python: {python}].',
  ],
  unsupported_format: [
    "'{file}' ist {form:choice folder=ein Ordner|special=keine gewöhnliche Datei|empty=eine leere Datei|version=eine MAT-Datei einer unbekannten Version|header=eine MATLAB-Datei mit beschädigtem Kopf|zip=ein ZIP-Archiv (oder eine Datei aus Office, .mlx oder .slx)|spreadsheet=eine Tabellenkalkulation (sichere das Blatt als CSV UTF-8, und wandle diese Datei um)|numpy=ein NumPy-Array|png=ein PNG-Bild|jpeg=ein JPEG-Bild|gif=ein GIF-Bild|pdf=ein PDF-Dokument|lfs=ein Platzhalter von Git LFS (die Datei selbst wurde nicht heruntergeladen)|octave=eine Octave-Datei (sichere sie mit: save -7 traj.mat q)|seven_zip=ein 7-Zip-Archiv|rar=ein RAR-Archiv|elf=ein Programm|exe=ein Windows-Programm|bzip=ein bzip2-Archiv|xz=ein xz-Archiv|sqlite=eine SQLite-Datenbank, aber kein vollständiges rosbag2-Bag|html=eine Webseite (wurde statt der Datei die Seite zum Herunterladen gesichert?)|text=eine Textdatei|unknown=eine Datei unbekannter Art}[ ({detail})] und kein MATLAB-Workspace.",
    'Sichere die Gelenkwinkel als q, eine Zeile je Abtastung, als .mat, .csv, .npz oder .json, und wandle diese Datei um.',
  ],
  unsupported_object: [
    "Nicht zu öffnen: {objects:list} ({why:problem}). Keine andere Matrix in '{file}' ist die Trajektorie.",
    'Sichere in MATLAB die Zahlen daraus.',
  ],
  unused_beside: [
    "{found:list} {count:choice one=enthält eine Zahl je Gelenk|more=enthalten eine Zahl je Gelenk|factor=kann ein Faktor davon sein}[, und {unread:list} ist unbekannt]: '{variable}' wurde so genommen, wie sie ist.",
    'Sind es Nullpunkte, Vorzeichen oder Faktoren der Gelenke, wende sie an und speichere das Ergebnis als q.',
  ],
  units_differ: [
    "Die Datei gibt die Spalten {columns} von '{variable}' in {stated:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm} an, die Spalten {others} aber in {second:choice rad=Radiant|deg=Grad|mrad=Milliradiant|urad=Mikroradiant|gon=Gon|turn=Umdrehungen|halfturn=halbe Umdrehungen|ddeg=Zehntelgrad|cdeg=Hundertstel Grad|mdeg=Tausendstel Grad|arcmin=Bogenminuten|arcsec=Bogensekunden|counts=Zählschritte|%=Prozent|normalized=Anteile eines Bereichs|mm=mm}; jede wurde in ihrer Einheit genommen.",
    'Prüfe, ob sich alle Gelenke richtig bewegen. Gilt eine Einheit für alle, nenne sie.',
  ],
  unwrap_applied: ["Wie gewünscht wurden die Sprünge um 2*pi in '{variable}' entfernt."],
  upload_broke_off: [
    "Das Senden von '{file}' brach ab; nichts wurde behalten.",
    'Sende die Datei noch einmal.',
  ],
  upload_of_another: ['{owner} hat dieses Hochgeladene nicht.', 'Sende die Datei noch einmal.'],
  upload_too_large: [
    'Die Datei hat mehr als {most:bytes}, die Grenze.',
    "Sichere nur die Trajektorie: save('file.mat', 'q', 't').",
  ],
  urdf_joint: ["{file}: Gelenk '{joint}'"],
  urdf_link: ["{file}: Glied '{link}'"],
  users_unusable: [
    '{path} ist für Personen und Anmeldungen nicht brauchbar: {why:problem}.',
    'Erwartet wird eine Datei, in die dieser Benutzer schreiben kann, oder keine.',
  ],
  value_not_finite: [
    '{joint} hat keine endliche {what:choice positions=Position|velocities=Geschwindigkeit|accelerations=Beschleunigung}[ an Punkt {point:integer}]; erwartet wird eine Zahl.',
  ],
  values_elsewhere: ["'{variable}' nimmt ihre Werte von anderswo; dem wird nicht gefolgt"],
  velocities_of: ['das sind die Geschwindigkeiten ihrer Spalten {columns}'],
  velocity_limit: [
    '{joint} bewegt sich in Zeile {first_row:integer} ({time:time}) mit {value:measure}; {model} erreicht {limit:measure}; zu schnell ist das Gelenk in {count:count Schritt|Schritten}.',
    'Mach die Bewegung {times:number}-mal so lang[, oder prüfe, ob {rate:number} Zeilen pro Sekunde stimmen: Mit {slower:number} kann der Roboter folgen].',
  ],
  version_gone: [
    'Die Datei der Version {version:integer} ist nicht mehr in {place}.',
    'Wandle den Workspace noch einmal um.',
  ],
  version_removed: [
    'Version {version:integer} wurde inzwischen entfernt.',
    'Frag sie noch einmal an.',
  ],
  values_of: ['{kind:choice complex=komplex|text=Text}'],
  wait_beyond_end: [
    '{robot} wartet am Frame {frame:integer}; seine Trajektorie hat die Frames 0 bis {last_frame:integer}.',
  ],
  wait_clears: [
    'Wartet {robot} {seconds:time}, bleiben die beiden in der Probe auseinander.',
    "Ergänze beim Mitglied {robot}: 'after: {other}.frame {frame:integer}'.",
  ],
  wait_clears_two: [
    'Wartet {robot} {seconds:time}, bleiben die beiden in der Probe auseinander; andere berühren sich noch.',
    "Ergänze beim Mitglied {robot}: 'after: {other}.frame {frame:integer}'.",
  ],
  wait_for_itself: ["{robot} wartet auf sich selbst: '{wait}'.", 'Nenne ein anderes Mitglied.'],
  wait_for_stranger: [
    "'{wait}' nennt {robot}; erwartet wird ein Mitglied des Systems: {members:list}.",
  ],
  wait_not_enough: [
    '{seconds:time} Warten für {robot} ist das Kürzeste, das hilft, reicht aber nicht bei dem, was die Roboter halten.',
    "Ergänze beim Mitglied {robot}: 'after: {other}.frame {frame:integer}', und ändere einen Weg.",
  ],
  waited_in_freeze: [
    'Der Prozess {process} stand {frozen:integer} s lang still, und diese Anfrage wartete davon {waited:integer} s; sie wurde nicht ausgeführt.',
    'Sende sie noch einmal.',
  ],
  waited_too_long: [
    'Diese Anfrage wartete {waited:time} auf die vor ihr; sie wurde nicht ausgeführt.',
    'Sende sie noch einmal.',
  ],
  waiting_circle: [
    'Die Mitglieder würden ohne Ende aufeinander warten:{steps:problems}',
    'Lass eine dieser Wartebedingungen weg.',
  ],
  waiting_files: [
    '{count:count Datei wartet|Dateien warten} mit {size:bytes} schon darauf, umgewandelt zu werden.',
    'Sende diese in einer Minute noch einmal.',
  ],
  waits_at: ['{robot} wartet: {wait}'],
  waits_forever: [
    "Wartet ohne Ende: '{wait}' tritt nie ein.",
    'Berichtige die Wartebedingung, oder die Bewegung, auf die sie wartet.',
  ],
  was_let_go: ['{name} wurde losgelassen'],
  waypoints: [
    "Die Zeilen von '{variable}' kommen mit {rate:rate} und liegen bis zu {value:angle} auseinander, am weitesten vor Zeile {first_row:integer}: Es sind Wegpunkte, zwischen denen der Roboter springt.",
    'Mach die Zeiten gleichmäßig: Dann verbinden Geraden die Punkte. Dafür sind ihre Zeiten nötig, gesichert als t.',
  ],
  wheels_missing: [
    'Wheels: es fehlt {modules:list}',
    'Führe einmal make demo aus; in einer eigenen Shell: . .venv/mrlab.sh',
  ],
  wheels_there: ['Wheels: alle vorhanden'],
  whole_like_poses: ['die ganze Matrix sieht aus wie Posen des Werkzeugs: {why:problem}'],
  within_nothing: ['Bei 0 mm kommt keine Bewegung an etwas vorbei; nimm 1 mm oder mehr.'],
  without_quotes: ['Schreibe {number} ohne Anführungszeichen'],
  worlds_full: ['pybullet hat keinen Platz für eine weitere Welt.', 'Schließe erst eine.'],
  wrong_cell: [
    "in Zeile {line:integer} steht '{found}', wo {expected:choice number=eine Zahl|date=ein Datum} erwartet wird",
  ],
  wrong_class: [
    "'{variable}' hat die Klasse {kind}; Gelenkwinkel sind double oder single.",
    'Sichere Radiant als double.',
  ],
  wrong_csrf: ['Der Header X-CSRF-Token fehlt oder ist alt.', 'Nimm csrf aus GET /api/session.'],
  wrong_host: [
    "Dieses Gateway heißt nicht '{host}'.",
    'Öffne es unter der Adresse, die es beim Start genannt hat.',
  ],
  wrong_inflated_size: [
    'eine komprimierte Variable ist entpackt {found:choice less=kleiner|more=größer} als die {declared:integer} Bytes, die sie nennt',
  ],
  wrong_joint_names: [
    'Die Namen der Gelenke sind nicht die des Roboters[; es fehlt: {missing:list}][; unbekannt: {unknown:list}][; mehrmals vorhanden: {repeated:list}]; erwartet wird jedes von {expected:list} einmal, in beliebiger Reihenfolge.',
  ],
  wrong_origin: [
    'Diese Anfrage kommt nicht von den Seiten dieses Gateways[, sondern von {origin}].',
    'Der Header Origin muss {expected} sein.',
  ],
  wrong_password: ['Name und Passwort passen nicht zusammen.', 'Versuche es noch einmal.'],
  wrong_shape: [
    "'{variable}' ist {size}; {model} braucht {joints:integer} Spalten, eine für jedes Gelenk, oder {more:integer} mit dem Greifer zuletzt.[ In den Spalten 1 bis {dates:integer} steht ein Datum.][ Spalte {time_column:integer} sieht wie Zeit aus, neben {beside:integer} anderen.][ Vielleicht ist ein Roboter mit {meant:integer} Gelenken gemeint.][ Vielleicht sind die Spalten {columns} die Gelenke.][ Sie hat {dimensions:integer} Dimensionen.]",
    'Sichere eine Zeile je Messpunkt und eine Spalte je Gelenk[, oder nimm die Spalten {columns}].',
  ],
  wrong_type: [
    "{part:choice name=ein Name hat|dimensions=Abmessungen haben|flags=die Flags einer Variablen haben|fields=Feldnamen haben|indices=Indizes einer dünn besetzten Matrix haben|numbers=Zahlen haben|text=ein Text hat|variable=was eine Variable sein müsste, hat} den Elementtyp {found}[ (in '{variable}')]",
  ],
  wrong_value_count: [
    '{what:choice positions=Positionen|velocities=Geschwindigkeiten|accelerations=Beschleunigungen}[ an Punkt {point:integer}]: {found:integer}; erwartet werden {expected:integer}, je Gelenk ein Wert.',
  ],
  yaml_alias: [
    '*{alias} in Zeile {line:integer} ist ein Alias; ROS liest keine.',
    'Schreibe die Werte aus.',
  ],
  yaml_mapping: ['eine Zuordnung in YAML'],
  zenoh_not_open: [
    'Die Bridge kann zenoh nicht an {endpoints:list} öffnen: {why:problem}.',
    'Prüfe die Parameter listen, connect und zenoh_config.',
  ],
  zigzag: [
    '{joint} kehrt {count:count Mal|Mal} sofort um; seine Geschwindigkeit ändert sich von einer Richtung zur anderen um {value:measure}.',
    'Glätte die Bewegung, oder plane sie neu mit einem glatten Zeitgesetz.',
  ],
}
