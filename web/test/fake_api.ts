import { type Api, ApiError } from '../src/api/api'
import type {
  Candidate,
  Check,
  CheckFinding,
  Conversion,
  ConversionRequest,
  Device,
  Diagnostic,
  GradedClass,
  Invitation,
  Listing,
  Live,
  NewPerson,
  NewToken,
  Pairing,
  PairingDevice,
  PairingState,
  Person,
  RobotLibrary,
  Role,
  Session,
  TrajectoryInfo,
  Upload,
  Version,
} from '../src/api/types'
import type { MotionDocument } from '../src/playback/motion'
import { own } from '../src/words/diagnostic'
import { fakeMotion } from './fake_motion'

const GALLERY = '/docs/gallery'
const MODELS = [
  'ur5e',
  'kuka_kr6_r900_sixx',
  'kuka_kr10_r900_2',
  'kuka_lbr_iisy15_r930',
  'kuka_kr560_r3100_2',
]

export const NO_CHECK: Check = {
  state: 'none',
  robot: '',
  trajectory: '',
  stale: null,
  problem: null,
  verdict: '',
  claim: null,
  duration: null,
  findings: [],
}
export const NO_CLASS: GradedClass = {
  title: 'Pick and place',
  robot: 'ur5e',
  marked: false,
  form: '',
  submissions: [],
  reference: null,
  desk: {
    sources: [],
    missing: [],
    form: '',
    run: null,
    proposed: null,
    journal: [],
    locked: '',
    released: '',
    undo: false,
    differing: 0,
    worksheet: false,
    before: false,
    left_out: [],
    unmatched: [],
    rows: [],
  },
}
const FOUND = {
  ...finding({}),
  robot: 'ur5e_1',
  end: null,
  kind: '',
  other: '',
} as const
export const FOUND_CHECK: Check = {
  ...NO_CHECK,
  state: 'done',
  verdict: 'not_ready',
  duration: 600,
  findings: [
    {
      ...FOUND,
      severity: 'error',
      code: 'collision',
      message: 'wrist_3_link touches cube_1 at 0.465, 0.127, 0.061 m.',
      remedy: 'Lift the way over it.',
      link: 'wrist_3_link',
      time: 214,
    },
    {
      ...FOUND,
      severity: 'warning',
      code: 'near_singularity',
      message: 'The arm is nearly singular.',
      link: '',
      time: 420.5,
    },
    {
      ...FOUND,
      severity: 'error',
      code: 'payload',
      message: 'box_1 is too heavy.',
      link: '',
      time: null,
    },
  ],
}

export function finding(of: Partial<Diagnostic>): Diagnostic {
  return {
    severity: 'error',
    code: 'joint_limit',
    message: '',
    remedy: '',
    variable: 'q',
    where: '',
    first_row: 0,
    last_row: 0,
    joint: '',
    value: null,
    limit: null,
    unit: '',
    values: {},
    fixes: [],
    ...of,
  }
}

export const JOINT_LIMIT = finding({
  message: 'elbow leaves its range in rows 295 to 345: it reaches 191 deg, the limit is 180 deg.',
  remedy: 'Plan the motion with the limits of the UR5e, or remove the jumps by a full turn.',
  first_row: 295,
  last_row: 345,
  joint: 'elbow',
  value: 3.33,
  limit: Math.PI,
  unit: 'rad',
  fixes: [{ option: 'unwrap', value: 'true', matlab: 'q = unwrap(q);' }],
})
const RATE = finding({
  severity: 'warning',
  code: 'rate_assumed',
  message: 'The file says no rate; 100 rows a second was assumed.',
  remedy: "Save the rate as well: fs = 100; save('traj.mat', 'q', 'fs', '-v7').",
  fixes: [{ option: 'frame_rate', value: '200', matlab: 'fs = 200;' }],
})

function wave(columns: number, scale: number): Candidate['preview'] {
  const rows = Array.from({ length: 120 }, (_, i) => 1 + i * 4)
  const values = rows.flatMap((row) =>
    Array.from({ length: columns }, (_, j) => scale * Math.sin(row / (60 + 17 * j) + j)),
  )
  return { variable: 'q', rows, columns, values }
}

export function trajectory(of: Partial<TrajectoryInfo>): TrajectoryInfo {
  return {
    id: 'quintic',
    robot_model: 'ur5e',
    end_effector: '',
    source_file: 'quintic_ur5e.mat',
    source_variable: 'q',
    source_sha256: '0'.repeat(64),
    created: 1.79e9,
    frame_rate: 100,
    frame_count: 801,
    duration: 8,
    has_gripper: false,
    owner: '',
    version: 1,
    shared: true,
    warnings: [],
    ...of,
  }
}

/** A gateway of a lab with a few people, in memory. The name of a file decides its outcome: "bad",
 * "which"; every other file is accepted. */
export class FakeApi implements Api {
  /** ?nobody in the address: not signed in. */
  user: Session['user'] = location.search.includes('nobody')
    ? null
    : { id: 'ada', name: 'ada', role: 'instructor' }
  readonly requests: ConversionRequest[] = []
  catalogue: TrajectoryInfo[] = [
    trajectory({}),
    trajectory({
      id: 'ada/wave',
      owner: 'ada',
      version: 3,
      shared: false,
      source_file: 'wave.mat',
    }),
    trajectory({
      id: 'ada/pick_and_place',
      owner: 'ada',
      has_gripper: true,
      duration: 12.4,
      frame_count: 1241,
      end_effector: 'parallel_gripper',
    }),
    trajectory({
      id: 'grace/spiral',
      owner: 'grace',
      robot_model: 'kuka_kr6_r900_sixx',
      version: 2,
      duration: 20,
    }),
  ]
  /** The motion that a program shows, and who waits for the next. */
  #live: Live | null = null
  readonly #waiting = new Set<() => void>()
  readonly #deleted = new Map<string, TrajectoryInfo>()
  touched: readonly CheckFinding[] = []
  readonly checks = new Map<string, Check>()
  #people: Person[] = [
    { name: 'ada', role: 'instructor', signs_in: 'password' },
    { name: 'grace', role: 'student', signs_in: '' },
    { name: 'beamer', role: 'display', signs_in: 'password' },
  ]
  #devices: Device[] = [
    {
      id: 'd1',
      name: 'Quest 3',
      role: 'student',
      approved_by: 'ada',
      created: 1.79e9,
      last_seen: 1.79e9 + 600,
      expires: 1.8e9,
      this: false,
    },
  ]
  #pairing: PairingState = { state: 'waiting' }
  // Files by the key of their upload.
  readonly #names = new Map<string, string>()

  async session(): Promise<Session> {
    return {
      lab: { id: 'lab', name: 'MR-Lab', version: '0.1.0' },
      user: this.user,
      may: { commands: true, scene: true, replay: true, grades: true, hands_in: false },
      csrf: 'token',
      ways: { password: true, oidc: true, pairing: true, course: false },
    }
  }
  async signIn(name: string, password: string): Promise<Session> {
    if (password !== 'secret')
      throw new ApiError(401, 'wrong_password', own('Name and password do not belong together.'))
    this.user = { id: name, name, role: 'student' }
    return this.session()
  }
  async signOut(): Promise<void> {
    this.user = null
  }
  async robots(): Promise<RobotLibrary> {
    return {
      robots: MODELS.map((model) => ({
        model,
        name: model === 'ur5e' ? 'UR5e' : model.slice(5).toUpperCase().replaceAll('_', ' '),
        maker: model === 'ur5e' ? 'Universal Robots' : 'KUKA',
        joints: ['a1', 'a2', 'a3', 'a4', 'a5', 'a6'],
        home: [0, 0, 0, 0, 0, 0],
        reach: 0.85,
        payload: 5,
        urdf: `/assets/robots/${model}.urdf`,
        thumbnail: `${GALLERY}/${model}.png`,
      })),
      end_effectors: ['parallel_gripper', 'vacuum_cup', 'centric_gripper'].map((id) => ({
        id,
        name: id.replace('_', ' '),
        thumbnail: `${GALLERY}/${id}.png`,
      })),
    }
  }
  async upload(
    file: File,
    onProgress: (share: number) => void,
    _signal: AbortSignal,
  ): Promise<Upload> {
    const upload = `users/ada/uploads/${this.#names.size + 1}/${file.name}`
    this.#names.set(upload, file.name)
    onProgress(1)
    return { upload, file_name: file.name, size: file.size, sha256: '0'.repeat(64) }
  }
  async convert(request: ConversionRequest): Promise<Conversion> {
    this.requests.push(request)
    const name = this.#names.get(request.upload) ?? ''
    const none = { candidates: [], trajectory: null, draft: null, motion: null }
    if (name.includes('which') && !request.variable)
      return {
        ...none,
        outcome: 'ambiguous',
        code: '',
        message: 'Two matrices could be the joint positions of UR5e.',
        diagnostics: [],
        candidates: [
          {
            variable: 'q',
            rows: 480,
            columns: 6,
            minimum: -1.6,
            maximum: 2.1,
            score: 0.62,
            reasons: [own('within the limits of every joint')],
            preview: wave(6, 1),
          },
          {
            variable: 'log.q_soll',
            rows: 480,
            columns: 6,
            minimum: -92,
            maximum: 121,
            score: 0.58,
            reasons: [own('named as set-points; looks like degrees')],
            preview: wave(6, 60),
          },
        ],
      }
    if (name.includes('bad') && !request.unwrap)
      return {
        ...none,
        outcome: 'rejected',
        code: '',
        message: 'q was not taken: one joint leaves its range.',
        diagnostics: [JOINT_LIMIT, RATE],
        motion: '/api/motions/bad',
      }
    return {
      ...none,
      outcome: 'accepted',
      code: '',
      message: 'q, 801 x 6, is a motion of UR5e: 8.0 s at 100 Hz.',
      diagnostics: name.includes('bad') ? [RATE] : [],
      trajectory: trajectory({ id: 'ada/run', owner: 'ada', shared: false, source_file: name }),
      draft: 'users/ada/drafts/1.npz',
      motion: '/api/motions/good',
    }
  }
  async sketch(): Promise<readonly (readonly number[])[]> {
    return Array.from({ length: 48 }, (_, i) => [20, 58, 20, 40, 40, 20 + i / 2, 80, 30 + i / 3])
  }
  async motion(url: string): Promise<MotionDocument> {
    if (url.includes('bad'))
      return fakeMotion({
        verdict: 'refused',
        message: 'one joint leaves its range',
        findings: [JOINT_LIMIT, RATE] as readonly Diagnostic[],
        bump: 2.15,
      })
    return fakeMotion({
      verdict: 'accepted',
      message: '8.0 s at 100 Hz',
      bump: url.includes('wave') ? 0.4 : 0,
    })
  }
  async live(after: string | null, signal: AbortSignal): Promise<Live | null> {
    while (after !== null && (this.#live?.live ?? '') === after) {
      await new Promise<void>((resolve) => {
        this.#waiting.add(resolve)
        signal.addEventListener('abort', () => resolve())
      })
      if (signal.aborted) throw new DOMException('Cancelled', 'AbortError')
    }
    return this.#live
  }
  /** Have a program show a motion. */
  show(live: Live): void {
    this.#live = live
    for (const resolve of this.#waiting) resolve()
    this.#waiting.clear()
  }

  async trajectories(): Promise<Listing> {
    return { trajectories: this.catalogue, problem: null }
  }
  async publish(_draft: string, id: string, shared: boolean): Promise<TrajectoryInfo> {
    const info = trajectory({ id: `ada/${id}`, owner: 'ada', shared })
    this.catalogue = [info, ...this.catalogue]
    return info
  }
  async versions(id: string): Promise<readonly Version[]> {
    const info = this.catalogue.find((each) => each.id === id)
    return Array.from({ length: info?.version ?? 0 }, (_, i) => ({
      version: (info?.version ?? 0) - i,
      created: (info?.created ?? 0) - i * 86400,
      source_file: info?.source_file ?? '',
      frame_count: 801,
      duration: 8,
    }))
  }
  async share(id: string, shared: boolean): Promise<void> {
    this.catalogue = this.catalogue.map((each) => (each.id === id ? { ...each, shared } : each))
  }
  async remove(id: string): Promise<void> {
    const info = this.catalogue.find((each) => each.id === id)
    if (info) this.#deleted.set(id, info)
    this.catalogue = this.catalogue.filter((each) => each.id !== id)
  }
  async restore(id: string): Promise<TrajectoryInfo> {
    const info = this.#deleted.get(id) ?? this.catalogue.find((each) => each.id === id)
    if (!info) throw new ApiError(404, 'not_found', own(`There is no trajectory '${id}'.`))
    this.catalogue = [info, ...this.catalogue.filter((each) => each.id !== id)]
    return info
  }
  async check(robot: string, trajectory: string): Promise<Check> {
    return this.checks.get(`${robot} ${trajectory}`) ?? { ...NO_CHECK, robot, trajectory }
  }
  async startCheck(robot: string, trajectory: string): Promise<Check> {
    this.checks.set(`${robot} ${trajectory}`, { ...FOUND_CHECK, robot, trajectory })
    return { ...NO_CHECK, state: 'running', robot, trajectory }
  }
  async touches(): Promise<readonly CheckFinding[]> {
    return this.touched
  }
  async cancelCheck(robot: string, trajectory: string): Promise<void> {
    this.checks.delete(`${robot} ${trajectory}`)
  }
  async gradedClass(): Promise<GradedClass> {
    return NO_CLASS
  }
  async classSource(): Promise<void> {}
  async classDo(): Promise<void> {}
  course(): Promise<never> {
    throw new Error('not of a course')
  }
  sendMarks(): Promise<never> {
    throw new Error('not of a course')
  }
  handedIn(): Promise<never> {
    throw new Error('not of a course')
  }
  async handIn(): Promise<void> {}
  async classFile(key: string): Promise<File> {
    return new File(['{}'], `${key}.json`)
  }
  async people(): Promise<readonly Person[]> {
    return this.#people
  }
  async invite(person: NewPerson) {
    this.#people = [...this.#people, { ...person, signs_in: '' }]
    return this.inviteAgain(person.name)
  }
  async inviteAgain(name: string) {
    return { name, url: `${location.origin}/invitation/kxQ3zt81`, expires_in: 86400 * 3 }
  }
  async removePerson(name: string): Promise<void> {
    this.#people = this.#people.filter((each) => each.name !== name)
  }
  async invitation(): Promise<Invitation> {
    return { name: 'grace', role: 'student' }
  }
  async acceptInvitation(): Promise<Session> {
    return this.session()
  }
  async devices(): Promise<readonly Device[]> {
    return this.#devices
  }
  async revokeDevice(id: string): Promise<void> {
    this.#devices = this.#devices.filter((each) => each.id !== id)
  }
  async makeToken({ program, role }: NewToken): Promise<string> {
    const device = { id: program, name: program, role, approved_by: 'ada', created: 1.79e9 }
    const times = { last_seen: 1.79e9, expires: 1.8e9, this: false }
    this.#devices = [...this.#devices, { ...device, ...times }]
    return 'mrlab_abc'
  }
  async startPairing(): Promise<Pairing> {
    return {
      code: 'BKWT-XZRD',
      secret: 's',
      url: `${location.origin}/pair/BKWTXZRD`,
      expires_in: 120,
    }
  }
  async pairing(): Promise<PairingState> {
    return this.#pairing
  }
  async pairingDevice(code: string): Promise<PairingDevice> {
    return { device: code === 'MATXLABX' ? 'MATLAB' : 'Quest 3', program: code === 'MATXLABX' }
  }
  async approvePairing(code: string, _role: Role): Promise<string> {
    if (!code) throw new ApiError(404, 'unknown_code', own('No headset shows this code now.'))
    this.#pairing = { state: 'approved' }
    return 'Quest 3'
  }
}
