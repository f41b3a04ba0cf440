import type { MotionDocument } from '../playback/motion'
import { type Told, ToldError } from '../words/diagnostic'
import type {
  Check,
  CheckFinding,
  Conversion,
  ConversionRequest,
  CourseState,
  Device,
  Fate,
  GradedClass,
  HandInState,
  Invitation,
  InvitationLink,
  Listing,
  Live,
  MarksSent,
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
} from './types'

/** The gateway's HTTP interface. Every method rejects with an ApiError. */
export interface Api {
  session(): Promise<Session>
  signIn(name: string, password: string): Promise<Session>
  signOut(): Promise<void>

  robots(): Promise<RobotLibrary>

  /** onProgress: share sent, 0 to 1. */
  upload(file: File, onProgress: (share: number) => void, signal: AbortSignal): Promise<Upload>
  convert(request: ConversionRequest, signal: AbortSignal): Promise<Conversion>
  motion(url: string, signal?: AbortSignal): Promise<MotionDocument>

  /** Return the motion that a program of the person shows; null: none. after: wait some seconds for
   * another one than that; null: answer at once. */
  live(after: string | null, signal: AbortSignal): Promise<Live | null>

  trajectories(): Promise<Listing>
  /** Return a robot of sticks in poses evenly spaced in time, each x0, y0, x1, y1, ... in 96 x 64
   * px. id: such as quintic@3. */
  sketch(id: string): Promise<readonly (readonly number[])[]>
  publish(draft: string, id: string, shared: boolean): Promise<TrajectoryInfo>
  versions(id: string): Promise<readonly Version[]>
  share(id: string, shared: boolean): Promise<void>
  remove(id: string): Promise<void>
  /** version 0: bring a deleted one back; else an older version becomes the newest. */
  restore(id: string, version: number): Promise<TrajectoryInfo>

  /** Return the known check of `trajectory`, such as quintic@3, on a robot of the lab. */
  check(robot: string, trajectory: string): Promise<Check>
  /** Start a check in the present scene. */
  startCheck(robot: string, trajectory: string): Promise<Check>
  cancelCheck(robot: string, trajectory: string): Promise<void>
  /** Return what the robot touches with a draft, alone on a floor, once that is known. */
  touches(draft: string, signal?: AbortSignal): Promise<readonly CheckFinding[]>

  gradedClass(): Promise<GradedClass>
  /** Hand in a file for the next run of the class. */
  classSource(name: string, file: File, onProgress: (share: number) => void): Promise<void>
  /** Do something at the desk of the class, such as POST run. */
  classDo(method: 'POST' | 'DELETE', part: ClassPart, body?: object): Promise<void>
  /** The course of the class. */
  course(): Promise<CourseState>
  /** Send the marks that were released to the gradebook of the course. */
  sendMarks(): Promise<MarksSent>
  /** What the person handed in for the class, and what its check found. */
  handedIn(): Promise<HandInState>
  handIn(file: File, onProgress: (share: number) => void): Promise<void>
  /** The motion of a submission as a file that can be uploaded. */
  classFile(key: string): Promise<File>

  people(): Promise<readonly Person[]>
  invite(person: NewPerson): Promise<InvitationLink>
  /** A new link for a person who lost the password. */
  inviteAgain(name: string): Promise<InvitationLink>
  removePerson(name: string, fate: Fate): Promise<void>
  invitation(token: string): Promise<Invitation>
  acceptInvitation(token: string, password: string): Promise<Session>

  devices(): Promise<readonly Device[]>
  revokeDevice(id: string): Promise<void>
  /** Return a token for a program; it is told once. */
  makeToken(program: NewToken): Promise<string>
  startPairing(): Promise<Pairing>
  pairing(secret: string): Promise<PairingState>
  /** Return what shows a code. */
  pairingDevice(code: string): Promise<PairingDevice>
  /** Return the name of the device. */
  approvePairing(code: string, role: Role): Promise<string>
}

/** Parts of the desk of a class below /api/class. */
export type ClassPart =
  | 'run'
  | 'proposed'
  | 'acts'
  | 'release'
  | 'before'
  | 'course'
  | 'course/members'
  | 'course/export'

export class ApiError extends ToldError {
  override readonly name = 'ApiError'
  constructor(
    /** HTTP status; 0: no answer. */
    readonly status: number,
    /** A coarse word, such as not_found; empty: the gateway did not answer. */
    readonly kind: string,
    told: Told,
  ) {
    super(told)
  }
}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'AbortError'
}

export type FileFormat = 'json' | 'mat' | 'csv'

/** Return a trajectory's place below /api/trajectories; an id holds one slash at most. */
export function trajectoryUrl(id: string, part = ''): string {
  const path = id.split('/').map(encodeURIComponent).join('/')
  return `/api/trajectories/${path}${part && `/${part}`}`
}

/** Return the place of the motion of a submission. */
export function submissionUrl(key: string): string {
  return `/api/class/${encodeURIComponent(key)}/motion`
}

export function fileUrl(id: string, format: FileFormat): string {
  return trajectoryUrl(id, `file?format=${format}`)
}
