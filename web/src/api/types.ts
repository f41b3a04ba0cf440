import type { Diagnostic, Fix, Told } from '../words/diagnostic'
import type { ClassAct, ClassDifference, ClassRun, PlatformRow, Unmatched } from './class_types'
/** The gateway's JSON. Field names are those of mrlab_msgs. */

export type Role = 'student' | 'instructor' | 'operator' | 'display'

/** The actions that the pages offer to a person; the gateway checks each call. */
export interface Rights {
  /** Loads and plays robots. */
  readonly commands: boolean
  /** Puts robots there and takes them away. */
  readonly scene: boolean
  /** Plays bags. */
  readonly replay: boolean
  /** Steps through the class that the gateway shows. */
  readonly grades: boolean
  /** Hands in for the class. */
  readonly hands_in: boolean
}

export interface Session {
  readonly lab: { readonly id: string; readonly name: string; readonly version: string }
  readonly user: { readonly id: string; readonly name: string; readonly role: Role } | null
  readonly may: Rights
  /** To be sent with every request that changes something. */
  readonly csrf: string
  /** course: people come from a course of a learning platform. */
  readonly ways: {
    readonly password: boolean
    readonly oidc: boolean
    readonly pairing: boolean
    readonly course: boolean
  }
}

export interface Robot {
  readonly model: string
  readonly name: string
  readonly maker: string
  /** In the order of its positions. */
  readonly joints: readonly string[]
  /** rad or m, of each joint */
  readonly home: readonly number[]
  /** m */
  readonly reach: number
  /** kg */
  readonly payload: number
  /** URL of its description. */
  readonly urdf: string
  /** URL of a picture; null: none. */
  readonly thumbnail: string | null
}

interface EndEffector {
  readonly id: string
  readonly name: string
  readonly thumbnail: string | null
}

export interface RobotLibrary {
  readonly robots: readonly Robot[]
  readonly end_effectors: readonly EndEffector[]
}

export interface Upload {
  readonly upload: string
  readonly file_name: string
  readonly size: number
  readonly sha256: string
}

/** Options of ConvertTrajectory; an absent one keeps its default. */
export interface ConvertOptions {
  readonly frame_rate?: number
  readonly variable?: string
  readonly columns?: string
  readonly transpose?: boolean
  readonly degrees?: boolean
  readonly unwrap?: boolean
  readonly resample?: boolean
  readonly join?: string
  readonly gripper?: string
  readonly invert?: boolean
  readonly units?: string
}

export interface ConversionRequest extends ConvertOptions {
  readonly upload: string
  readonly robot_model: string
  readonly end_effector: string
}

export type { Diagnostic, Fix }

export interface Preview {
  readonly variable: string
  readonly rows: readonly number[]
  readonly columns: number
  /** Row by row; null: not finite. */
  readonly values: readonly (number | null)[]
}

export interface Candidate {
  readonly variable: string
  readonly rows: number
  readonly columns: number
  readonly minimum: number | null
  readonly maximum: number | null
  readonly score: number
  readonly reasons: readonly Told[]
  readonly preview: Preview
}

/** problem: why they are what was last known; null: they are what the store has. */
export interface Listing {
  readonly trajectories: readonly TrajectoryInfo[]
  readonly problem: Diagnostic | null
}

export interface TrajectoryInfo {
  readonly id: string
  readonly robot_model: string
  readonly end_effector: string
  readonly source_file: string
  readonly source_variable: string
  readonly source_sha256: string
  /** s since the epoch */
  readonly created: number
  readonly frame_rate: number
  readonly frame_count: number
  readonly duration: number
  readonly has_gripper: boolean
  readonly owner: string
  readonly version: number
  readonly shared: boolean
  readonly warnings: readonly Diagnostic[]
}

export interface Conversion extends Told {
  readonly outcome: 'accepted' | 'rejected' | 'ambiguous'
  readonly diagnostics: readonly Diagnostic[]
  readonly candidates: readonly Candidate[]
  readonly trajectory: TrajectoryInfo | null
  readonly draft: string | null
  /** URL of a MotionDocument */
  readonly motion: string | null
}

/** A motion that a program of the person shows. live: names it. options: those of the conversion,
 * with their defaults. */
export interface Live {
  readonly live: string
  readonly upload: Upload
  readonly options: ConvertOptions & {
    readonly robot_model: string
    readonly end_effector: string
    readonly id: string
  }
  readonly conversion: Conversion
}

export interface Version {
  readonly version: number
  /** s since the epoch */
  readonly created: number
  readonly source_file: string
  readonly frame_count: number
  readonly duration: number
}

export interface Invitation {
  readonly name: string
  readonly role: Role
}

export interface NewPerson {
  readonly name: string
  readonly role: Role
}

export interface Person {
  readonly name: string
  readonly role: Role
  /** password or oidc; empty until the link was used. */
  readonly signs_in: string
}

/** The link by which a person chooses a password, once. */
export interface InvitationLink {
  readonly name: string
  readonly url: string
  /** s */
  readonly expires_in: number
}

/** A program that acts for whoever makes its token. days: how long the token is good. */
export interface NewToken {
  readonly program: string
  readonly role: Role
  readonly days: number
}

/** What happens to all that a removed person uploaded and published. to: who gets it. */
export type Fate =
  | { readonly data: 'keep' | 'erase' }
  | { readonly data: 'hand_over'; readonly to: string }

export interface Device {
  readonly id: string
  readonly name: string
  readonly role: Role
  /** Its owner. */
  readonly approved_by: string
  /** s since the epoch */
  readonly created: number
  readonly last_seen: number
  readonly expires: number
  /** The device of this session. */
  readonly this: boolean
}

export interface Pairing {
  /** To be typed at the phone. */
  readonly code: string
  readonly secret: string
  /** Page at which the code is approved. */
  readonly url: string
  /** s */
  readonly expires_in: number
}

/** What shows a code, by the name that it gives itself. */
export interface PairingDevice {
  readonly device: string
  /** It keeps a token, and is no headset. */
  readonly program: boolean
}

export interface PairingState {
  readonly state: 'waiting' | 'approved' | 'expired'
}

/** A finding of a check; time and end: s from the first frame, null: it has no instant. */
export interface CheckFinding extends Diagnostic {
  readonly robot: string
  readonly link: string
  readonly time: number | null
  readonly end: number | null
  /** Kind of the thing that the robot touches, such as object, and its name; empty: nothing. */
  readonly kind: string
  readonly other: string
}

/** A check of the motion that a robot of the lab has loaded. */
export interface Check {
  readonly state: 'none' | 'waiting' | 'running' | 'done' | 'failed'
  readonly robot: string
  /** Such as quintic@3 */
  readonly trajectory: string
  /** Change in the lab since then; null: none. */
  readonly stale: Diagnostic | null
  /** Why it failed. */
  readonly problem: Diagnostic | null
  readonly verdict: string
  readonly claim: Diagnostic | null
  readonly duration: number | null
  readonly findings: readonly CheckFinding[]
}

/** Result of a test of a rubric; time: s at which points were lost, null: no instant. */
export interface ClassMark {
  readonly name: string
  readonly points: number
  readonly of: number
  readonly passed: boolean
  readonly found: Diagnostic
  readonly hint: string
  readonly hidden: boolean
  /** Its points come on top of the others'. */
  readonly bonus: boolean
  readonly time: number | null
  /** By the teacher who marks; null: as the test gave it. */
  readonly change: ClassChange | null
  /** By a second marker; it does not hold. */
  readonly second: ClassChange | null
}

/** Points that a teacher gave; at: s since 1970, given: those of the test. */
export interface ClassChange {
  readonly points: number
  readonly given: number
  readonly who: string
  readonly at: number
  readonly reason: string
}

/** One student's submission. */
export interface Submission {
  readonly key: string
  readonly name: string
  readonly points: number
  readonly of: number
  /** The outcome: the reason for having no motion, or the verdict of its check. */
  readonly found: Diagnostic
  readonly duration: number | null
  readonly robot: string
  readonly tool: string
  /** There is one to show. */
  readonly motion: boolean
  readonly marks: readonly ClassMark[]
  readonly late: boolean
  readonly comment: string
}

/** A graded class; reference: the solution, null: there is none. */
export interface GradedClass {
  readonly title: string
  readonly robot: string
  /** False: it was not run yet. */
  readonly marked: boolean
  /** Of the export, such as Moodle. */
  readonly form: string
  readonly desk: ClassDesk
  readonly submissions: readonly Submission[]
  readonly reference: Submission | null
}

/** What stands on the desk of a class. */
export interface ClassDesk {
  /** Files that the next run reads; size: bytes. */
  readonly sources: readonly { readonly name: string; readonly size: number }[]
  /** Files that the rubric names and that are not there. */
  readonly missing: readonly string[]
  /** The form of the export that was said; empty: it is recognised. */
  readonly form: string
  readonly run: ClassRun | null
  /** What proposed marks change; null: none are proposed. */
  readonly proposed: readonly ClassDifference[] | null
  /** The latest acts, newest first. */
  readonly journal: readonly ClassAct[]
  /** Who locked and who released the marks; empty: nobody. */
  readonly locked: string
  readonly released: string
  readonly undo: boolean
  /** How many marks of second markers do not hold. */
  readonly differing: number
  /** Moodle's worksheet is filled. */
  readonly worksheet: boolean
  /** The marks of the run before can hold again. */
  readonly before: boolean
  readonly left_out: readonly { readonly file: string; readonly why: Diagnostic }[]
  /** What a teacher has to decide about. */
  readonly unmatched: readonly Unmatched[]
  /** Rows of the platform's table that nobody has. */
  readonly rows: readonly PlatformRow[]
}

/** The course that a class belongs to. */
export interface CourseState {
  /** A teacher has opened the lab from it. */
  readonly connected: boolean
  readonly course: string
  readonly task: string
  /** How many students are known, how many have handed in, and who has not. */
  readonly count: number
  readonly handed_in: number
  readonly silent: readonly string[]
  /** The platform offers its list of people, and its gradebook. */
  readonly members: boolean
  readonly scores: boolean
}

export interface MarksSent {
  readonly said: Diagnostic
  readonly problems: readonly Diagnostic[]
}

/** What a student is told of the own file. */
export interface InstantCheck {
  readonly said: Diagnostic
  /** Those that are not hidden; the points count after the release only. */
  readonly tests: readonly {
    readonly name: string
    readonly passed: boolean
    readonly found: Diagnostic
    readonly hint: string
    readonly points: number
    readonly of: number
  }[]
  /** Of hidden tests. */
  readonly hints: readonly string[]
}

export interface HandInState {
  readonly course: string
  readonly task: string
  readonly robot: string
  /** The person came from the course. */
  readonly member: boolean
  /** Who closed it; empty: it is open. */
  readonly closed: string
  readonly handed_in: { readonly file: string; readonly at: number; readonly size: number } | null
  /** null: nothing is handed in, or the check goes on. */
  readonly check: InstantCheck | null
  /** Once it is released. */
  readonly mark:
    | (InstantCheck & { readonly points: number; readonly of: number; readonly comment: string })
    | null
}
