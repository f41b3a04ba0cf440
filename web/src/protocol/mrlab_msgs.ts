// Generated from the message definitions by `make docs`.

import { type Time, createTime, readTime } from './builtin_interfaces'
import type { CdrReader, CdrWriter } from './cdr'
import { type KeyValue, createKeyValue, readKeyValue } from './diagnostic_msgs'
import { type Point, type Pose, type Twist, type Vector3, createPoint, createPose, createTwist, createVector3, readPoint, readPose, readTwist, readVector3, writePoint, writePose, writeTwist } from './geometry_msgs'
import { type MessageReader, type MessageWriter, type ServiceType, messageReader, messageWriter, serviceType } from './message_type'
import { type SolidPrimitive, createSolidPrimitive, readSolidPrimitive } from './shape_msgs'
import { type ColorRGBA, type Header, createColorRGBA, createHeader, readColorRGBA, readHeader, writeHeader } from './std_msgs'

/** mrlab_msgs/srv/Attach_Request: Fix an object to a robot's gripper by hand. */
export interface AttachRequest {
  robot: string
  object: string
}

export function writeAttachRequest(to: CdrWriter, message: AttachRequest): void {
  to.string(message.robot)
  to.string(message.object)
}

/** mrlab_msgs/msg/Candidate: A matrix in a workspace file that could be the trajectory. */
export interface Candidate {
  /** its path, written as in MATLAB, such as out.q.signals.values */
  variable: string
  /** as MATLAB's size() gives them */
  rows: number
  columns: number
  /** smallest value, in the matrix's own unit */
  minimum: number
  /** largest value, in the matrix's own unit */
  maximum: number
  /** 0 to 1, larger is likelier */
  score: number
  /** what speaks for and against it */
  reasons: Diagnostic[]
  /** some of its rows */
  preview: Preview
}

export function createCandidate(): Candidate {
  return {
    variable: '',
    rows: 0,
    columns: 0,
    minimum: 0,
    maximum: 0,
    score: 0,
    reasons: [],
    preview: createPreview(),
  }
}

export function readCandidate(from: CdrReader, into: Candidate): void {
  into.variable = from.string(into.variable)
  into.rows = from.uint32()
  into.columns = from.uint32()
  into.minimum = from.float64()
  into.maximum = from.float64()
  into.score = from.float64()
  into.reasons = from.messages(into.reasons, createDiagnostic, readDiagnostic)
  readPreview(from, into.preview)
}

/** mrlab_msgs/msg/Collision: Whether a robot's arm touches something it should not. Latched; sent at each change. */
export interface Collision {
  /** frame_id is world */
  header: Header
  /** true: halt; false: clear, with the margin kept */
  colliding: boolean
  /** the first contact of this collision */
  contact: Contact
  /** m to the nearest thing, as far as physics looks; negative: overlap */
  clearance: number
}

export function createCollision(): Collision {
  return {
    header: createHeader(),
    colliding: false,
    contact: createContact(),
    clearance: 0,
  }
}

export function readCollision(from: CdrReader, into: Collision): void {
  readHeader(from, into.header)
  into.colliding = from.bool()
  readContact(from, into.contact)
  into.clearance = from.float64()
}

export const collisionReader: MessageReader<Collision> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Collision',
  createCollision,
  readCollision,
)

/** mrlab_msgs/msg/Contact: One contact between a robot and something else. */
export interface Contact {
  stamp: Time
  /** name of the robot */
  robot: string
  /** its link that touches, a finger too */
  link: string
  /** the object in its gripper that touches; empty: the robot itself */
  held: string
  /** what it touches: one of the constants above */
  kind: number
  /** name of the object, surface or robot */
  other: string
  /** link of the other robot, or of the same one; else empty */
  other_link: string
  /** in world, m */
  point: Point
  /** unit vector in world, from the other towards the robot */
  normal: Vector3
  /** m, positive: overlap */
  depth: number
  /** N*s of the physics step */
  impulse: number
  /** source frame of the robot's trajectory */
  frame: number
}

export function createContact(): Contact {
  return {
    stamp: createTime(),
    robot: '',
    link: '',
    held: '',
    kind: 0,
    other: '',
    other_link: '',
    point: createPoint(),
    normal: createVector3(),
    depth: 0,
    impulse: 0,
    frame: 0,
  }
}

export function readContact(from: CdrReader, into: Contact): void {
  readTime(from, into.stamp)
  into.robot = from.string(into.robot)
  into.link = from.string(into.link)
  into.held = from.string(into.held)
  into.kind = from.uint8()
  into.other = from.string(into.other)
  into.other_link = from.string(into.other_link)
  readPoint(from, into.point)
  readVector3(from, into.normal)
  into.depth = from.float64()
  into.impulse = from.float64()
  into.frame = from.uint32()
}

/** mrlab_msgs/msg/Contacts: All contacts of one physics step. */
export interface Contacts {
  /** frame_id is world */
  header: Header
  contacts: Contact[]
}

export function createContacts(): Contacts {
  return {
    header: createHeader(),
    contacts: [],
  }
}

export function readContacts(from: CdrReader, into: Contacts): void {
  readHeader(from, into.header)
  into.contacts = from.messages(into.contacts, createContact, readContact)
}

export const contactsReader: MessageReader<Contacts> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Contacts',
  createContacts,
  readContacts,
)

/** mrlab_msgs/srv/ConvertTrajectory_Request: Read a workspace file, find and check the trajectory, put it in the catalogue. */
export interface ConvertTrajectoryRequest {
  /** file on the lab's machine; empty: the file is in upload or data */
  path: string
  /** key of the file in the store; empty: the file is in data */
  upload: string
  /** the file's bytes, when path and upload are empty */
  data: Uint8Array
  /** name of the file in data */
  file_name: string
  /** id of the robot it is for, such as ur5e */
  robot_model: string
  /** id of the end effector; empty: none */
  end_effector: string
  /** Hz at which the rows were sampled; 0: taken from the file or the lab's default */
  frame_rate: number
  /** which variable, written as in MATLAB; empty: the converter finds it */
  variable: string
  /** which columns or rows hold the joints, as in MATLAB, such as 2:7; empty: all */
  columns: string
  /** true: samples are columns */
  transpose: boolean
  /** true: values are degrees */
  degrees: boolean
  /** true: jumps of 2*pi are removed */
  unwrap: boolean
  /** true: rows at uneven times become frames at an even rate */
  resample: boolean
  /** variables to put side by side (joints) or below one another (segments): q1..q6, or q1,q2,q3 */
  join: string
  /** column that holds the gripper, as in MATLAB, such as 1 or end; none: there is no gripper; empty: the column after the joints */
  gripper: string
  /** true: larger values of the gripper's column mean open */
  invert: boolean
  /** unit of the joints: rad, deg, counts:N with N counts a turn, or mm for joints in m; empty: rad */
  units: string
  /** name in the catalogue; empty: from the file's name */
  id: string
  /** user whose trajectory it becomes; empty: the lab's */
  owner: string
  /** key in the store under which an accepted trajectory is left; empty: it enters the catalogue at once */
  draft: string
  /** with an owner: true: everybody may see and load it */
  shared: boolean
}

export function writeConvertTrajectoryRequest(to: CdrWriter, message: ConvertTrajectoryRequest): void {
  to.string(message.path)
  to.string(message.upload)
  to.uint8s(message.data)
  to.string(message.file_name)
  to.string(message.robot_model)
  to.string(message.end_effector)
  to.float64(message.frame_rate)
  to.string(message.variable)
  to.string(message.columns)
  to.bool(message.transpose)
  to.bool(message.degrees)
  to.bool(message.unwrap)
  to.bool(message.resample)
  to.string(message.join)
  to.string(message.gripper)
  to.bool(message.invert)
  to.string(message.units)
  to.string(message.id)
  to.string(message.owner)
  to.string(message.draft)
  to.bool(message.shared)
}

/** mrlab_msgs/srv/ConvertTrajectory_Response */
export interface ConvertTrajectoryResponse {
  /** true: ACCEPTED */
  success: boolean
  /** one sentence for a person */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** one of the constants above */
  outcome: number
  /** meaningful only where ACCEPTED */
  trajectory: TrajectoryInfo
  /** likeliest first */
  candidates: Candidate[]
  /** all findings, worst first */
  diagnostics: Diagnostic[]
  /** of the matrix that was refused, where one was found */
  preview: Preview
}

export function createConvertTrajectoryResponse(): ConvertTrajectoryResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
    outcome: 0,
    trajectory: createTrajectoryInfo(),
    candidates: [],
    diagnostics: [],
    preview: createPreview(),
  }
}

export function readConvertTrajectoryResponse(from: CdrReader, into: ConvertTrajectoryResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  into.outcome = from.uint8()
  readTrajectoryInfo(from, into.trajectory)
  into.candidates = from.messages(into.candidates, createCandidate, readCandidate)
  into.diagnostics = from.messages(into.diagnostics, createDiagnostic, readDiagnostic)
  readPreview(from, into.preview)
}

/** mrlab_msgs/srv/CreateSystem_Request: Make a robot system. */
export interface CreateSystemRequest {
  /** wanted name; empty: system and a number */
  name: string
  /** robot, trajectory_id, dwell and waits are read */
  members: SystemMember[]
  /** as in RobotSystem */
  mode: number
  /** as in RobotSystem */
  policy: number
  loop: boolean
}

export function createCreateSystemRequest(): CreateSystemRequest {
  return {
    name: '',
    members: [],
    mode: 0,
    policy: 0,
    loop: false,
  }
}

export function writeCreateSystemRequest(to: CdrWriter, message: CreateSystemRequest): void {
  to.string(message.name)
  to.messages(message.members, writeSystemMember)
  to.uint8(message.mode)
  to.uint8(message.policy)
  to.bool(message.loop)
}

/** mrlab_msgs/srv/CreateSystem_Response */
export interface CreateSystemResponse {
  /** false: nothing was changed */
  success: boolean
  /** why not */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** meaningful only on success */
  system: RobotSystem
}

export function createCreateSystemResponse(): CreateSystemResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
    system: createRobotSystem(),
  }
}

export function readCreateSystemResponse(from: CdrReader, into: CreateSystemResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  readRobotSystem(from, into.system)
}

/** mrlab_msgs/srv/Detach_Request: Let a robot's gripper lose what it holds. */
export interface DetachRequest {
  robot: string
}

export function writeDetachRequest(to: CdrWriter, message: DetachRequest): void {
  to.string(message.robot)
}

/** mrlab_msgs/msg/Diagnostic: One finding about a workspace file, a trajectory or a robot, for a person to act on. docs/diagnostics.md lists every code. */
export interface Diagnostic {
  /** one of the constants above */
  severity: number
  /** stable name for programs, such as joint_limit */
  code: string
  /** what was found and what was expected, in plain words */
  message: string
  /** what to do next, in MATLAB where that is where to do it; may be empty */
  remedy: string
  /** variable in the workspace, written as in MATLAB; empty: the whole file */
  variable: string
  /** place inside the variable, such as "row 12, column 3"; may be empty */
  where: string
  /** first row of the variable that it applies to, counted from 1 as in MATLAB; 0: no rows */
  first_row: number
  /** last of these rows; 0: no rows */
  last_row: number
  /** joint of the robot that it applies to; empty: no single joint */
  joint: string
  /** what was found there, in unit; NaN: no number */
  value: number
  /** what it was compared with, in unit; NaN: no number */
  limit: number
  /** of value and limit: rad, rad/s, s, Hz; empty: that of the variable, or none */
  unit: string
  /** all values of its texts by name, in SI units and radians; a text as it is, all else as JSON */
  values: KeyValue[]
  /** ways to mend it, the likeliest first; may be empty */
  fixes: Fix[]
}

export function createDiagnostic(): Diagnostic {
  return {
    severity: 0,
    code: '',
    message: '',
    remedy: '',
    variable: '',
    where: '',
    first_row: 0,
    last_row: 0,
    joint: '',
    value: 0,
    limit: 0,
    unit: '',
    values: [],
    fixes: [],
  }
}

export function readDiagnostic(from: CdrReader, into: Diagnostic): void {
  into.severity = from.uint8()
  into.code = from.string(into.code)
  into.message = from.string(into.message)
  into.remedy = from.string(into.remedy)
  into.variable = from.string(into.variable)
  into.where = from.string(into.where)
  into.first_row = from.uint32()
  into.last_row = from.uint32()
  into.joint = from.string(into.joint)
  into.value = from.float64()
  into.limit = from.float64()
  into.unit = from.string(into.unit)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  into.fixes = from.messages(into.fixes, createFix, readFix)
}

/** mrlab_msgs/msg/Fix: One way to mend what a Diagnostic found: an option of ConvertTrajectory, a line of MATLAB, or either of them. A button sets the option and converts again. */
export interface Fix {
  /** field of the request of ConvertTrajectory, such as columns; empty: only MATLAB mends it */
  option: string
  /** what to set the option to, as text: "2:7", "true", "100", "deg"; empty without option */
  value: string
  /** statements that do the same in MATLAB, such as q = unwrap(q); may be empty */
  matlab: string
  /** command line of a shell that mends it, such as "mrlab up --robots ur5e"; may be empty */
  command: string
}

export function createFix(): Fix {
  return {
    option: '',
    value: '',
    matlab: '',
    command: '',
  }
}

export function readFix(from: CdrReader, into: Fix): void {
  into.option = from.string(into.option)
  into.value = from.string(into.value)
  into.matlab = from.string(into.matlab)
  into.command = from.string(into.command)
}

/** mrlab_msgs/msg/Grasp: What a robot's gripper does. Latched; sent at each change. */
export interface Grasp {
  /** frame_id is the robot's tool0 */
  header: Header
  /** one of the constants above */
  state: number
  /** held object; empty unless HOLDING */
  object: string
  /** finger joints of the end effector */
  fingers: string[]
  /** m or rad, in the order of fingers */
  finger_positions: Float64Array
  /** N or N*m, in the order of fingers */
  finger_forces: Float64Array
  /** why nothing is held, why it slips or was lost; empty: nothing to say */
  reason: string
  /** what the reason says, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** how much the reason matters, by the constants of Diagnostic */
  severity: number
  /** kg of the held object */
  mass: number
  /** kg that the robot with this end effector may carry; 0: not stated */
  payload: number
  /** coefficient between the fingers or the cup and the object */
  friction: number
  /** coefficient that the load on it needs now */
  friction_needed: number
  /** friction / friction_needed - 1; negative: it slips */
  slip_margin: number
  /** N*m of its weight about the origin of tool0 */
  wrist_moment: number
}

export const Grasp = {
  /** open, or opening */
  OPEN: 0,
  /** fingers move, nothing held yet */
  CLOSING: 1,
  /** an object is attached */
  HOLDING: 2,
  /** closed on nothing */
  EMPTY: 3,
} as const

export function createGrasp(): Grasp {
  return {
    header: createHeader(),
    state: 0,
    object: '',
    fingers: [],
    finger_positions: new Float64Array(0),
    finger_forces: new Float64Array(0),
    reason: '',
    code: '',
    values: [],
    severity: 0,
    mass: 0,
    payload: 0,
    friction: 0,
    friction_needed: 0,
    slip_margin: 0,
    wrist_moment: 0,
  }
}

export function readGrasp(from: CdrReader, into: Grasp): void {
  readHeader(from, into.header)
  into.state = from.uint8()
  into.object = from.string(into.object)
  into.fingers = from.strings(into.fingers)
  into.finger_positions = from.float64s(into.finger_positions)
  into.finger_forces = from.float64s(into.finger_forces)
  into.reason = from.string(into.reason)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  into.severity = from.uint8()
  into.mass = from.float64()
  into.payload = from.float64()
  into.friction = from.float64()
  into.friction_needed = from.float64()
  into.slip_margin = from.float64()
  into.wrist_moment = from.float64()
}

export const graspReader: MessageReader<Grasp> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Grasp',
  createGrasp,
  readGrasp,
)

/** mrlab_msgs/msg/GraspTarget: A frame at which the trajectory opens or closes the gripper. */
export interface GraspTarget {
  /** the first frame with the new gripper state */
  frame: number
  /** s from the first frame */
  time: number
  /** true closes, false opens */
  close: boolean
  /** pose of tool0 in the robot's base_link at that frame, m */
  tool0: Pose
}

export function createGraspTarget(): GraspTarget {
  return {
    frame: 0,
    time: 0,
    close: false,
    tool0: createPose(),
  }
}

export function readGraspTarget(from: CdrReader, into: GraspTarget): void {
  into.frame = from.uint32()
  into.time = from.float64()
  into.close = from.bool()
  readPose(from, into.tool0)
}

/** mrlab_msgs/msg/GraspTargets: Where the loaded trajectory grasps and releases. Latched; empty without a gripper. */
export interface GraspTargets {
  /** frame_id is the robot's base_link */
  header: Header
  trajectory_id: string
  /** in order of time */
  targets: GraspTarget[]
}

export function createGraspTargets(): GraspTargets {
  return {
    header: createHeader(),
    trajectory_id: '',
    targets: [],
  }
}

export function readGraspTargets(from: CdrReader, into: GraspTargets): void {
  readHeader(from, into.header)
  into.trajectory_id = from.string(into.trajectory_id)
  into.targets = from.messages(into.targets, createGraspTarget, readGraspTarget)
}

export const graspTargetsReader: MessageReader<GraspTargets> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/GraspTargets',
  createGraspTargets,
  readGraspTargets,
)

/** mrlab_msgs/msg/LabProcess: A process of the lab as its supervisor sees it. */
export interface LabProcess {
  /** such as playback */
  name: string
  /** nodes that it holds, such as playback_host; empty: it is none of ROS */
  nodes: string[]
  /** one of the constants above */
  state: number
  /** when it entered this state */
  since: Time
  /** how often it was started again */
  restarts: number
  /** of the last end; negative: the number of the signal that ended it; 0 also before the first end */
  exit_code: number
  /** the same in words: a signal such as SIGKILL, or the exit code; empty: it never ended */
  last_exit: string
  /** when it ended or froze last; 0: never */
  down: Time
  /** the same instant in ns of CLOCK_MONOTONIC, for processes of the same machine; 0: never */
  down_steady_ns: bigint
  /** s from the end to the next start, while WAITING */
  restart_in: number
}

export const LabProcess = {
  /** not started yet */
  STARTING: 0,
  RUNNING: 1,
  /** it ended, and is started again in restart_in */
  WAITING: 2,
  /** it ended as its configuration is wrong, and is not started again */
  REFUSED: 3,
  /** it ended with the lab */
  STOPPED: 4,
  /** a signal stopped it (SIGSTOP): it lives but does not run */
  FROZEN: 5,
} as const

export function createLabProcess(): LabProcess {
  return {
    name: '',
    nodes: [],
    state: 0,
    since: createTime(),
    restarts: 0,
    exit_code: 0,
    last_exit: '',
    down: createTime(),
    down_steady_ns: 0n,
    restart_in: 0,
  }
}

export function readLabProcess(from: CdrReader, into: LabProcess): void {
  into.name = from.string(into.name)
  into.nodes = from.strings(into.nodes)
  into.state = from.uint8()
  readTime(from, into.since)
  into.restarts = from.uint32()
  into.exit_code = from.int32()
  into.last_exit = from.string(into.last_exit)
  readTime(from, into.down)
  into.down_steady_ns = from.int64()
  into.restart_in = from.float64()
}

/** mrlab_msgs/msg/LabProcesses: The processes of the lab. Latched; sent by their supervisor at each change, at once. */
export interface LabProcesses {
  header: Header
  processes: LabProcess[]
  /** id of the lab whose processes they are */
  lab: string
}

export function createLabProcesses(): LabProcesses {
  return {
    header: createHeader(),
    processes: [],
    lab: '',
  }
}

export function readLabProcesses(from: CdrReader, into: LabProcesses): void {
  readHeader(from, into.header)
  into.processes = from.messages(into.processes, createLabProcess, readLabProcess)
  into.lab = from.string(into.lab)
}

export const labProcessesReader: MessageReader<LabProcesses> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/LabProcesses',
  createLabProcesses,
  readLabProcesses,
)

/** mrlab_msgs/msg/Latency: How long messages take on their way, as one observer measured it. Sent about once a second. */
export interface Latency {
  /** end of the window */
  header: Header
  /** who measured: "bridge", or the name that a client gives itself */
  observer: string
  /** s that the report covers */
  window: number
  /** s, bound of the observer's clock error against the lab's; 0: same */
  clock_error: number
  hops: LatencyHop[]
}

export function writeLatency(to: CdrWriter, message: Latency): void {
  writeHeader(to, message.header)
  to.string(message.observer)
  to.float64(message.window)
  to.float64(message.clock_error)
  to.messages(message.hops, writeLatencyHop)
}

export const latencyWriter: MessageWriter<Latency> = /* @__PURE__ */ messageWriter(
  'mrlab_msgs/msg/Latency',
  writeLatency,
)

/** mrlab_msgs/msg/LatencyHop: How long the messages of one key took over one hop, in the window that the report covers. */
export interface LatencyHop {
  /** one of the constants above */
  hop: number
  /** name of the topic, such as /ur5e_1/joint_states; empty: all topics */
  topic: string
  /** messages measured */
  count: number
  /** s, the median */
  p50: number
  /** s */
  p95: number
  /** s */
  max: number
}

export const LatencyHop = {
  /** from publishing in the graph until the bridge handed it to zenoh */
  PUBLISHED_TO_BRIDGED: 0,
  /** from there until a client had it */
  BRIDGED_TO_RECEIVED: 1,
  /** all of it */
  PUBLISHED_TO_RECEIVED: 2,
} as const

export function writeLatencyHop(to: CdrWriter, message: LatencyHop): void {
  to.uint8(message.hop)
  to.string(message.topic)
  to.uint32(message.count)
  to.float64(message.p50)
  to.float64(message.p95)
  to.float64(message.max)
}

/** mrlab_msgs/srv/ListBags_Request: List the bags that replay finds by name. */
export type ListBagsRequest = Record<string, never>

export function writeListBagsRequest(to: CdrWriter, _: ListBagsRequest): void {
  to.uint8(0)
}

/** mrlab_msgs/srv/ListBags_Response */
export interface ListBagsResponse {
  success: boolean
  /** why not */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** names, newest first */
  bags: string[]
}

export function createListBagsResponse(): ListBagsResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
    bags: [],
  }
}

export function readListBagsResponse(from: CdrReader, into: ListBagsResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  into.bags = from.strings(into.bags)
}

/** mrlab_msgs/srv/ListCatalogue_Request: List the types of objects that spawn_object takes. */
export type ListCatalogueRequest = Record<string, never>

export function writeListCatalogueRequest(to: CdrWriter, _: ListCatalogueRequest): void {
  to.uint8(0)
}

/** mrlab_msgs/srv/ListCatalogue_Response */
export interface ListCatalogueResponse {
  /** the catalogue */
  types: ObjectType[]
  /** objects that may be active at a time */
  limit: number
}

export function createListCatalogueResponse(): ListCatalogueResponse {
  return {
    types: [],
    limit: 0,
  }
}

export function readListCatalogueResponse(from: CdrReader, into: ListCatalogueResponse): void {
  into.types = from.messages(into.types, createObjectType, readObjectType)
  into.limit = from.uint32()
}

/** mrlab_msgs/srv/ListScenes_Request: List the scenes that load_scene takes. */
export type ListScenesRequest = Record<string, never>

export function writeListScenesRequest(to: CdrWriter, _: ListScenesRequest): void {
  to.uint8(0)
}

/** mrlab_msgs/srv/ListScenes_Response */
export interface ListScenesResponse {
  /** names, sorted: those shipped with the lab and those saved in it */
  scenes: string[]
}

export function createListScenesResponse(): ListScenesResponse {
  return {
    scenes: [],
  }
}

export function readListScenesResponse(from: CdrReader, into: ListScenesResponse): void {
  into.scenes = from.strings(into.scenes)
}

/** mrlab_msgs/srv/LoadTrajectory_Request: Load a trajectory from the catalogue into a robot's playback. */
export interface LoadTrajectoryRequest {
  /** name in the catalogue, NAME@3 for its third version; empty: unload */
  id: string
}

export function writeLoadTrajectoryRequest(to: CdrWriter, message: LoadTrajectoryRequest): void {
  to.string(message.id)
}

/** mrlab_msgs/msg/LookHere: Somebody asks all in the room to look at a point. Every display marks it for some seconds. */
export interface LookHere {
  /** frame_id is world */
  header: Header
  /** of the person; the gateway fills it in from the sign-in */
  name: string
  /** in world, m */
  point: Point
}

export function createLookHere(): LookHere {
  return {
    header: createHeader(),
    name: '',
    point: createPoint(),
  }
}

export function readLookHere(from: CdrReader, into: LookHere): void {
  readHeader(from, into.header)
  into.name = from.string(into.name)
  readPoint(from, into.point)
}

export function writeLookHere(to: CdrWriter, message: LookHere): void {
  writeHeader(to, message.header)
  to.string(message.name)
  writePoint(to, message.point)
}

export const lookHereReader: MessageReader<LookHere> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/LookHere',
  createLookHere,
  readLookHere,
)

export const lookHereWriter: MessageWriter<LookHere> = /* @__PURE__ */ messageWriter(
  'mrlab_msgs/msg/LookHere',
  writeLookHere,
)

/** mrlab_msgs/msg/Move: Where a hand has what it carries. MoveObject and PlaceRobot take it and put it down; between them only moves of the hand that took it count, and each only while no newer one has come. */
export interface Move {
  /** as in the call that took it */
  hand: string
  /** rises with each move, from 1 */
  sequence: number
  /** what is carried: an object, */
  object: string
  /** or a robot's base */
  robot: string
  /** in world, m */
  pose: Pose
}

export function writeMove(to: CdrWriter, message: Move): void {
  to.string(message.hand)
  to.uint32(message.sequence)
  to.string(message.object)
  to.string(message.robot)
  writePose(to, message.pose)
}

export const moveWriter: MessageWriter<Move> = /* @__PURE__ */ messageWriter(
  'mrlab_msgs/msg/Move',
  writeMove,
)

/** mrlab_msgs/srv/MoveObject_Request: Move an object by hand. */
export interface MoveObjectRequest {
  name: string
  /** in world, m */
  pose: Pose
  /** in world; how it flies when it is let go */
  twist: Twist
  /** true: the hand keeps it; false: it is let go here */
  held: boolean
  /** an id that whoever holds it chose: its moves on /moves count from now on; empty: none do */
  hand: string
}

export function writeMoveObjectRequest(to: CdrWriter, message: MoveObjectRequest): void {
  to.string(message.name)
  writePose(to, message.pose)
  writeTwist(to, message.twist)
  to.bool(message.held)
  to.string(message.hand)
}

/** mrlab_msgs/msg/ObjectRemoved: An object that the lab itself took out of the scene. Removals by request are not announced. */
export interface ObjectRemoved {
  header: Header
  /** its name in the scene */
  name: string
  /** its id in the catalogue */
  type: string
  /** why, for a person: it was the oldest, or it fell out of the room */
  reason: string
  /** what the reason says, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
}

export function createObjectRemoved(): ObjectRemoved {
  return {
    header: createHeader(),
    name: '',
    type: '',
    reason: '',
    code: '',
    values: [],
  }
}

export function readObjectRemoved(from: CdrReader, into: ObjectRemoved): void {
  readHeader(from, into.header)
  into.name = from.string(into.name)
  into.type = from.string(into.type)
  into.reason = from.string(into.reason)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
}

export const objectRemovedReader: MessageReader<ObjectRemoved> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/ObjectRemoved',
  createObjectRemoved,
  readObjectRemoved,
)

/** mrlab_msgs/msg/ObjectType: One entry of the catalogue of objects. */
export interface ObjectType {
  /** what spawn_object takes as type */
  id: string
  /** what it is, for a person */
  about: string
  /** edge lengths of its bounding box in its own frame, m */
  size: Vector3
  /** kg; 0: fixed */
  mass: number
  color: ColorRGBA
  /** URI of its mesh; empty: draw the primitive */
  mesh: string
  /** its shape in its own frame; type 0: several parts or a mesh */
  primitive: SolidPrimitive
}

export function createObjectType(): ObjectType {
  return {
    id: '',
    about: '',
    size: createVector3(),
    mass: 0,
    color: createColorRGBA(),
    mesh: '',
    primitive: createSolidPrimitive(),
  }
}

export function readObjectType(from: CdrReader, into: ObjectType): void {
  into.id = from.string(into.id)
  into.about = from.string(into.about)
  readVector3(from, into.size)
  into.mass = from.float64()
  readColorRGBA(from, into.color)
  into.mesh = from.string(into.mesh)
  readSolidPrimitive(from, into.primitive)
}

/** mrlab_msgs/msg/Overlap: A robot that stands in a surface of the room, as in a real table whose plane the headset measured. */
export interface Overlap {
  robot: string
  /** its name */
  surface: string
  /** table, wall, ... as the headset names it; may be empty */
  label: string
}

export function createOverlap(): Overlap {
  return {
    robot: '',
    surface: '',
    label: '',
  }
}

export function readOverlap(from: CdrReader, into: Overlap): void {
  into.robot = from.string(into.robot)
  into.surface = from.string(into.surface)
  into.label = from.string(into.label)
}

/** mrlab_msgs/msg/Overlaps: Robots that stand in surfaces of the room. Contacts of these pairs are not checked until the robot has left the surface. Latched; sent at each change. */
export interface Overlaps {
  header: Header
  overlaps: Overlap[]
}

export function createOverlaps(): Overlaps {
  return {
    header: createHeader(),
    overlaps: [],
  }
}

export function readOverlaps(from: CdrReader, into: Overlaps): void {
  readHeader(from, into.header)
  into.overlaps = from.messages(into.overlaps, createOverlap, readOverlap)
}

export const overlapsReader: MessageReader<Overlaps> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Overlaps',
  createOverlaps,
  readOverlaps,
)

/** mrlab_msgs/msg/Place: The place in which the lab's robots stand: a real room, with an origin that its headsets share. Latched; sent at each change. */
export interface Place {
  header: Header
  /** of the place, never used again; headsets keep their anchors by it */
  id: string
  /** for people; may be empty */
  name: string
}

export function createPlace(): Place {
  return {
    header: createHeader(),
    id: '',
    name: '',
  }
}

export function readPlace(from: CdrReader, into: Place): void {
  readHeader(from, into.header)
  into.id = from.string(into.id)
  into.name = from.string(into.name)
}

export const placeReader: MessageReader<Place> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Place',
  createPlace,
  readPlace,
)

/** mrlab_msgs/srv/PlaceRobot_Request: Move a robot's base. */
export interface PlaceRobotRequest {
  robot: string
  /** base_link in world, m */
  pose: Pose
  /** an id that whoever carries it chose: its moves on /moves count from now on; empty: none do */
  hand: string
}

export function writePlaceRobotRequest(to: CdrWriter, message: PlaceRobotRequest): void {
  to.string(message.robot)
  writePose(to, message.pose)
  to.string(message.hand)
}

/** mrlab_msgs/msg/PlaybackClock: The clock of a trajectory: position(t) = position + rate * (t - stamp). A client that holds the trajectory computes the pose at any instant from it. */
export interface PlaybackClock {
  /** time on the lab's clock at which position held; may lie ahead */
  stamp: Time
  /** s from the first frame */
  position: number
  /** 1 is the declared speed; 0 while it stands */
  rate: number
}

export function createPlaybackClock(): PlaybackClock {
  return {
    stamp: createTime(),
    position: 0,
    rate: 0,
  }
}

export function readPlaybackClock(from: CdrReader, into: PlaybackClock): void {
  readTime(from, into.stamp)
  into.position = from.float64()
  into.rate = from.float64()
}

/** mrlab_msgs/msg/PlaybackState: The state of one robot's playback. Latched; sent at each change and once a second while moving. */
export interface PlaybackState {
  /** when the state was taken; frame_id is the robot's name */
  header: Header
  /** one of the constants above */
  state: number
  /** the state's name, such as PLAYING */
  label: string
  /** why it is in this state, for a person; may be empty */
  message: string
  /** what the message says, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** empty in IDLE */
  trajectory_id: string
  /** which one was loaded: converter/get ID@VERSION; 0 in IDLE */
  trajectory_version: number
  /** where on the trajectory it is at any time */
  clock: PlaybackClock
  /** the last source frame reached */
  frame: number
  /** frames of the trajectory; 0 in IDLE */
  frame_count: number
  /** Hz of the trajectory; 0 in IDLE */
  frame_rate: number
  /** s; 0 in IDLE */
  duration: number
  /** the speed it plays at when it plays, 0.1 to 4; negative: backwards */
  rate: number
  /** true: starts over after the last frame */
  loop: boolean
  /** node that plays it; its command_members service commands it for a system */
  host: string
  /** the robot system that drives it; empty: independent */
  system: string
  /** id of the lab that published it; empty: unknown */
  lab: string
}

export const PlaybackState = {
  /** no trajectory loaded */
  IDLE: 0,
  /** loaded, waiting to play */
  READY: 1,
  /** moving to the first frame */
  ADJUSTING: 2,
  /** streaming the trajectory */
  PLAYING: 3,
  /** stands on the trajectory, plays on from there */
  PAUSED: 4,
  /** stopped by a contact, waits until physics confirms it is clear */
  COLLISION_HALT: 5,
  /** the last frame was sent; READY follows */
  COMPLETE: 6,
} as const

export function createPlaybackState(): PlaybackState {
  return {
    header: createHeader(),
    state: 0,
    label: '',
    message: '',
    code: '',
    values: [],
    trajectory_id: '',
    trajectory_version: 0,
    clock: createPlaybackClock(),
    frame: 0,
    frame_count: 0,
    frame_rate: 0,
    duration: 0,
    rate: 0,
    loop: false,
    host: '',
    system: '',
    lab: '',
  }
}

export function readPlaybackState(from: CdrReader, into: PlaybackState): void {
  readHeader(from, into.header)
  into.state = from.uint8()
  into.label = from.string(into.label)
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  into.trajectory_id = from.string(into.trajectory_id)
  into.trajectory_version = from.uint32()
  readPlaybackClock(from, into.clock)
  into.frame = from.uint32()
  into.frame_count = from.uint32()
  into.frame_rate = from.float64()
  into.duration = from.float64()
  into.rate = from.float64()
  into.loop = from.bool()
  into.host = from.string(into.host)
  into.system = from.string(into.system)
  into.lab = from.string(into.lab)
}

export const playbackStateReader: MessageReader<PlaybackState> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/PlaybackState',
  createPlaybackState,
  readPlaybackState,
)

/** mrlab_msgs/msg/Presence: Where somebody in the room is. A display sends it at most 20 times a second while it is in the lab. */
export interface Presence {
  /** when it was measured, lab time; frame_id is world, or id where it is not aligned */
  header: Header
  /** of the display, unique in the lab */
  id: string
  /** of the person; the gateway fills it in from the sign-in */
  name: string
  /** one of the constants above */
  part: number
  /** of their eyes in world, x forwards, m */
  head: Pose
  /** true: the left hand or controller is tracked */
  has_left: boolean
  /** in world, m */
  left: Pose
  has_right: boolean
  /** in world, m */
  right: Pose
  /** true: takes the headset off, or leaves; the avatar is removed */
  away: boolean
}

export const Presence = {
  /** sees the lab and commands nothing */
  WATCHES: 0,
  /** commands robots */
  DRIVES: 1,
  /** may pause all */
  TEACHES: 2,
} as const

export function createPresence(): Presence {
  return {
    header: createHeader(),
    id: '',
    name: '',
    part: 0,
    head: createPose(),
    has_left: false,
    left: createPose(),
    has_right: false,
    right: createPose(),
    away: false,
  }
}

export function readPresence(from: CdrReader, into: Presence): void {
  readHeader(from, into.header)
  into.id = from.string(into.id)
  into.name = from.string(into.name)
  into.part = from.uint8()
  readPose(from, into.head)
  into.has_left = from.bool()
  readPose(from, into.left)
  into.has_right = from.bool()
  readPose(from, into.right)
  into.away = from.bool()
}

export function writePresence(to: CdrWriter, message: Presence): void {
  writeHeader(to, message.header)
  to.string(message.id)
  to.string(message.name)
  to.uint8(message.part)
  writePose(to, message.head)
  to.bool(message.has_left)
  writePose(to, message.left)
  to.bool(message.has_right)
  writePose(to, message.right)
  to.bool(message.away)
}

export const presenceReader: MessageReader<Presence> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Presence',
  createPresence,
  readPresence,
)

export const presenceWriter: MessageWriter<Presence> = /* @__PURE__ */ messageWriter(
  'mrlab_msgs/msg/Presence',
  writePresence,
)

/** mrlab_msgs/msg/Preview: Some rows of a matrix, for a picture of it: at most 400, evenly chosen, the first, the last and the rows that findings name among them. */
export interface Preview {
  /** path of the matrix, written as in MATLAB; empty: no preview */
  variable: string
  /** which rows, counted from 1 as in MATLAB, rising */
  rows: Uint32Array
  /** how many columns of each row, at most 32 */
  columns: number
  /** in the matrix's own unit, row by row: size(rows) x columns, NaN where not finite */
  values: Float32Array
}

export function createPreview(): Preview {
  return {
    variable: '',
    rows: new Uint32Array(0),
    columns: 0,
    values: new Float32Array(0),
  }
}

export function readPreview(from: CdrReader, into: Preview): void {
  into.variable = from.string(into.variable)
  into.rows = from.uint32s(into.rows)
  into.columns = from.uint32()
  into.values = from.float32s(into.values)
}

/** mrlab_msgs/msg/RecorderState: What the recorder does. Latched; sent at each change and once a second while it works. */
export interface RecorderState {
  header: Header
  /** one of the constants above */
  state: number
  /** folder of the bag; empty when STOPPED */
  bag: string
  /** s recorded, or s into the replay */
  position: number
  /** s of the bag that is replayed; 0 while recording */
  duration: number
  /** of the replay; 1 while recording */
  rate: number
  /** written or replayed */
  messages: bigint
  /** written, or size of the replayed bag */
  bytes: bigint
  /** trouble, for a person; may be empty */
  message: string
  /** what the message says, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
}

export const RecorderState = {
  STOPPED: 0,
  RECORDING: 1,
  REPLAYING: 2,
  /** a replay that stands */
  PAUSED: 3,
} as const

export function createRecorderState(): RecorderState {
  return {
    header: createHeader(),
    state: 0,
    bag: '',
    position: 0,
    duration: 0,
    rate: 0,
    messages: 0n,
    bytes: 0n,
    message: '',
    code: '',
    values: [],
  }
}

export function readRecorderState(from: CdrReader, into: RecorderState): void {
  readHeader(from, into.header)
  into.state = from.uint8()
  into.bag = from.string(into.bag)
  into.position = from.float64()
  into.duration = from.float64()
  into.rate = from.float64()
  into.messages = from.uint64()
  into.bytes = from.uint64()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
}

export const recorderStateReader: MessageReader<RecorderState> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/RecorderState',
  createRecorderState,
  readRecorderState,
)

/** mrlab_msgs/srv/Remove_Request: Remove something by its name: a robot, an object, a trajectory or a robot system. */
export interface RemoveRequest {
  name: string
}

export function writeRemoveRequest(to: CdrWriter, message: RemoveRequest): void {
  to.string(message.name)
}

/** mrlab_msgs/srv/Replay_Request: Replay a bag into the graph. */
export interface ReplayRequest {
  /** folder of the bag */
  bag: string
  /** 0.1 to 10 */
  rate: number
  /** s into the bag */
  start: number
  loop: boolean
}

export function writeReplayRequest(to: CdrWriter, message: ReplayRequest): void {
  to.string(message.bag)
  to.float64(message.rate)
  to.float64(message.start)
  to.bool(message.loop)
}

/** mrlab_msgs/msg/Robot: One robot in the scene. */
export interface Robot {
  /** its namespace, such as ur5e_1 */
  name: string
  /** id of the model, such as ur5e */
  model: string
  /** id of the end effector; empty: none */
  end_effector: string
  /** base_link in the frame world, m */
  pose: Pose
  /** moving joints of the arm, base first */
  joint_names: string[]
}

export function createRobot(): Robot {
  return {
    name: '',
    model: '',
    end_effector: '',
    pose: createPose(),
    joint_names: [],
  }
}

export function readRobot(from: CdrReader, into: Robot): void {
  into.name = from.string(into.name)
  into.model = from.string(into.model)
  into.end_effector = from.string(into.end_effector)
  readPose(from, into.pose)
  into.joint_names = from.strings(into.joint_names)
}

/** mrlab_msgs/msg/RobotSystem: Robots that play as one, on one timeline. */
export interface RobotSystem {
  /** unique; its services are below this name */
  name: string
  /** in order of selection */
  members: SystemMember[]
  /** PARALLEL or SEQUENTIAL */
  mode: number
  /** HALT_ALL or HALT_MEMBER */
  policy: number
  /** READY to STOPPING, above */
  state: number
  /** the state's name */
  label: string
  /** why it is in this state, for a person; may be empty */
  message: string
  /** what the message says, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** of the timeline */
  clock: PlaybackClock
  /** s of the timeline */
  duration: number
  /** the speed it plays at when it plays, 0.1 to 4; negative: backwards */
  rate: number
  loop: boolean
}

export const RobotSystem = {
  /** all begin at one stamp */
  PARALLEL: 0,
  /** one after another, in order of the members */
  SEQUENTIAL: 1,
  /** a collision of one member halts all */
  HALT_ALL: 0,
  /** a collision halts that member only */
  HALT_MEMBER: 1,
  /** values as in PlaybackState */
  READY: 1,
  /** every member moves to its first frame */
  STAGING: 2,
  PLAYING: 3,
  PAUSED: 4,
  COLLISION_HALT: 5,
  COMPLETE: 6,
  /** a member was not reached; READY follows once all stand */
  STOPPING: 7,
} as const

export function createRobotSystem(): RobotSystem {
  return {
    name: '',
    members: [],
    mode: 0,
    policy: 0,
    state: 0,
    label: '',
    message: '',
    code: '',
    values: [],
    clock: createPlaybackClock(),
    duration: 0,
    rate: 0,
    loop: false,
  }
}

export function readRobotSystem(from: CdrReader, into: RobotSystem): void {
  into.name = from.string(into.name)
  into.members = from.messages(into.members, createSystemMember, readSystemMember)
  into.mode = from.uint8()
  into.policy = from.uint8()
  into.state = from.uint8()
  into.label = from.string(into.label)
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  readPlaybackClock(from, into.clock)
  into.duration = from.float64()
  into.rate = from.float64()
  into.loop = from.bool()
}

/** mrlab_msgs/msg/RobotSystems: All robot systems. Latched. */
export interface RobotSystems {
  header: Header
  systems: RobotSystem[]
  /** id of the lab that published it; empty: unknown */
  lab: string
  /** the coordinator that holds the claims; after a restart another one */
  holder: string
}

export function createRobotSystems(): RobotSystems {
  return {
    header: createHeader(),
    systems: [],
    lab: '',
    holder: '',
  }
}

export function readRobotSystems(from: CdrReader, into: RobotSystems): void {
  readHeader(from, into.header)
  into.systems = from.messages(into.systems, createRobotSystem, readRobotSystem)
  into.lab = from.string(into.lab)
  into.holder = from.string(into.holder)
}

export const robotSystemsReader: MessageReader<RobotSystems> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/RobotSystems',
  createRobotSystems,
  readRobotSystems,
)

/** mrlab_msgs/msg/Robots: All robots in the scene, in order of arrival. Latched. */
export interface Robots {
  /** frame_id is world */
  header: Header
  robots: Robot[]
  /** id of the lab that published it; empty: unknown */
  lab: string
}

export function createRobots(): Robots {
  return {
    header: createHeader(),
    robots: [],
    lab: '',
  }
}

export function readRobots(from: CdrReader, into: Robots): void {
  readHeader(from, into.header)
  into.robots = from.messages(into.robots, createRobot, readRobot)
  into.lab = from.string(into.lab)
}

export const robotsReader: MessageReader<Robots> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Robots',
  createRobots,
  readRobots,
)

/** mrlab_msgs/srv/SceneFile_Request: Save the scene to, or load it from, a file in the lab's scene folder. */
export interface SceneFileRequest {
  /** without folder and extension */
  name: string
}

export function writeSceneFileRequest(to: CdrWriter, message: SceneFileRequest): void {
  to.string(message.name)
}

/** mrlab_msgs/msg/SceneObject: One movable or fixed thing in the scene. */
export interface SceneObject {
  /** unique in the scene, such as cube_1 */
  name: string
  /** id in the catalogue config/objects.yaml */
  type: string
  /** in world, m */
  pose: Pose
  /** in world, m/s and rad/s */
  twist: Twist
  /** edge lengths of its bounding box in its own frame, m */
  size: Vector3
  /** kg; 0: fixed */
  mass: number
  color: ColorRGBA
  /** URI of its mesh; empty: draw the primitive */
  mesh: string
  /** its shape in its own frame; type 0: several parts or a mesh */
  primitive: SolidPrimitive
  /** robot that holds it, or "hand"; empty: free */
  held_by: string
  /** only where a robot holds it: its pose in that robot's tool0, m */
  in_tool: Pose
}

export function createSceneObject(): SceneObject {
  return {
    name: '',
    type: '',
    pose: createPose(),
    twist: createTwist(),
    size: createVector3(),
    mass: 0,
    color: createColorRGBA(),
    mesh: '',
    primitive: createSolidPrimitive(),
    held_by: '',
    in_tool: createPose(),
  }
}

export function readSceneObject(from: CdrReader, into: SceneObject): void {
  into.name = from.string(into.name)
  into.type = from.string(into.type)
  readPose(from, into.pose)
  readTwist(from, into.twist)
  readVector3(from, into.size)
  into.mass = from.float64()
  readColorRGBA(from, into.color)
  into.mesh = from.string(into.mesh)
  readSolidPrimitive(from, into.primitive)
  into.held_by = from.string(into.held_by)
  readPose(from, into.in_tool)
}

/** mrlab_msgs/msg/SceneObjects: All objects in the scene. */
export interface SceneObjects {
  /** frame_id is world */
  header: Header
  objects: SceneObject[]
}

export function createSceneObjects(): SceneObjects {
  return {
    header: createHeader(),
    objects: [],
  }
}

export function readSceneObjects(from: CdrReader, into: SceneObjects): void {
  readHeader(from, into.header)
  into.objects = from.messages(into.objects, createSceneObject, readSceneObject)
}

export const sceneObjectsReader: MessageReader<SceneObjects> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/SceneObjects',
  createSceneObjects,
  readSceneObjects,
)

/** mrlab_msgs/srv/Seek_Request: Go to a place on the timeline. */
export interface SeekRequest {
  /** s from the first frame */
  position: number
}

export function writeSeekRequest(to: CdrWriter, message: SeekRequest): void {
  to.float64(message.position)
}

/** mrlab_msgs/srv/SetEndEffector_Request: Exchange a robot's end effector. */
export interface SetEndEffectorRequest {
  robot: string
  /** id of the end effector; empty: none */
  end_effector: string
}

export function writeSetEndEffectorRequest(to: CdrWriter, message: SetEndEffectorRequest): void {
  to.string(message.robot)
  to.string(message.end_effector)
}

/** mrlab_msgs/srv/SetLoop_Request: Play or replay again and again, or once. */
export interface SetLoopRequest {
  /** true: starts over after the last frame */
  loop: boolean
}

export function writeSetLoopRequest(to: CdrWriter, message: SetLoopRequest): void {
  to.bool(message.loop)
}

/** mrlab_msgs/srv/SetMode_Request: Set how a robot system plays. */
export interface SetModeRequest {
  /** as in RobotSystem */
  mode: number
}

export function writeSetModeRequest(to: CdrWriter, message: SetModeRequest): void {
  to.uint8(message.mode)
}

/** mrlab_msgs/srv/SetPlace_Request: Say in which place the robots stand. Headsets look for their anchors of it, or must be aligned again. */
export interface SetPlaceRequest {
  /** of a place that there was before; empty: a new one */
  id: string
  /** for people */
  name: string
}

export function writeSetPlaceRequest(to: CdrWriter, message: SetPlaceRequest): void {
  to.string(message.id)
  to.string(message.name)
}

/** mrlab_msgs/srv/SetRate_Request: Set the speed of playback. */
export interface SetRateRequest {
  /** 0.1 to 4, or -0.1 to -4: backwards; 1 is the declared speed */
  rate: number
}

export function writeSetRateRequest(to: CdrWriter, message: SetRateRequest): void {
  to.float64(message.rate)
}

/** mrlab_msgs/srv/SetSurfaces_Request: Replace the surfaces of the room, or those of one source. */
export interface SetSurfacesRequest {
  /** who measured them, such as a headset: only its own are replaced; empty: all */
  source: string
  surfaces: Surface[]
}

export function writeSetSurfacesRequest(to: CdrWriter, message: SetSurfacesRequest): void {
  to.string(message.source)
  to.messages(message.surfaces, writeSurface)
}

/** mrlab_msgs/srv/SpawnObject_Request: Put an object into the scene. */
export interface SpawnObjectRequest {
  /** id in the catalogue */
  type: string
  /** wanted name; empty: the type and a number */
  name: string
  /** true: on the nearest surface below pose, free of others */
  automatic: boolean
  /** in world, m */
  pose: Pose
}

export function writeSpawnObjectRequest(to: CdrWriter, message: SpawnObjectRequest): void {
  to.string(message.type)
  to.string(message.name)
  to.bool(message.automatic)
  writePose(to, message.pose)
}

/** mrlab_msgs/srv/SpawnObject_Response */
export interface SpawnObjectResponse {
  /** false: nothing was changed */
  success: boolean
  /** why not */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** meaningful only on success */
  object: SceneObject
}

export function createSpawnObjectResponse(): SpawnObjectResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
    object: createSceneObject(),
  }
}

export function readSpawnObjectResponse(from: CdrReader, into: SpawnObjectResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  readSceneObject(from, into.object)
}

/** mrlab_msgs/srv/SpawnRobot_Request: Put a robot into the scene. */
export interface SpawnRobotRequest {
  /** id of the model, such as ur5e */
  model: string
  /** id of the end effector; empty: none */
  end_effector: string
  /** wanted name; empty: the model's id and a number */
  name: string
  /** true: the lab finds a free place and pose is ignored */
  automatic: boolean
  /** base_link in world, m */
  pose: Pose
  /** what it stands on, by name; empty: the floor */
  surface: string
  /** true: the free place is in front of the viewer, and the robot faces them */
  has_viewer: boolean
  /** of their eyes in world, x forwards, m; meaningful only with has_viewer */
  viewer: Pose
}

export function createSpawnRobotRequest(): SpawnRobotRequest {
  return {
    model: '',
    end_effector: '',
    name: '',
    automatic: false,
    pose: createPose(),
    surface: '',
    has_viewer: false,
    viewer: createPose(),
  }
}

export function writeSpawnRobotRequest(to: CdrWriter, message: SpawnRobotRequest): void {
  to.string(message.model)
  to.string(message.end_effector)
  to.string(message.name)
  to.bool(message.automatic)
  writePose(to, message.pose)
  to.string(message.surface)
  to.bool(message.has_viewer)
  writePose(to, message.viewer)
}

/** mrlab_msgs/srv/SpawnRobot_Response */
export interface SpawnRobotResponse {
  /** false: nothing was changed */
  success: boolean
  /** why not */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** meaningful only on success */
  robot: Robot
}

export function createSpawnRobotResponse(): SpawnRobotResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
    robot: createRobot(),
  }
}

export function readSpawnRobotResponse(from: CdrReader, into: SpawnRobotResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  readRobot(from, into.robot)
}

/** mrlab_msgs/srv/StartRecording_Request: Start writing a bag. */
export interface StartRecordingRequest {
  /** folder to make; empty: named by date and time */
  bag: string
  /** empty: all of the lab's topics */
  topics: string[]
  /** s after which a new file begins; 0: never */
  split_duration: number
}

export function writeStartRecordingRequest(to: CdrWriter, message: StartRecordingRequest): void {
  to.string(message.bag)
  to.strings(message.topics)
  to.float64(message.split_duration)
}

/** mrlab_msgs/srv/StartRecording_Response */
export interface StartRecordingResponse {
  success: boolean
  /** why not */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
  /** the folder */
  bag: string
}

export function createStartRecordingResponse(): StartRecordingResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
    bag: '',
  }
}

export function readStartRecordingResponse(from: CdrReader, into: StartRecordingResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
  into.bag = from.string(into.bag)
}

/** mrlab_msgs/msg/Surface: A static surface of the room: the floor, a table, a wall, or a mesh the headset detected. */
export interface Surface {
  /** unique, such as table_1 */
  name: string
  /** floor, wall, ceiling, table, ... as the headset names it */
  label: string
  /** who measured it, such as a headset; empty: the lab's own */
  source: string
  /** in world, m; of a plane, z is its normal */
  pose: Pose
  /** in the surface's frame, m: a plane's outline, or a mesh's vertices */
  vertices: Point[]
  /** three vertex indices each; empty: a plane */
  triangles: Uint32Array
}

export function createSurface(): Surface {
  return {
    name: '',
    label: '',
    source: '',
    pose: createPose(),
    vertices: [],
    triangles: new Uint32Array(0),
  }
}

export function readSurface(from: CdrReader, into: Surface): void {
  into.name = from.string(into.name)
  into.label = from.string(into.label)
  into.source = from.string(into.source)
  readPose(from, into.pose)
  into.vertices = from.messages(into.vertices, createPoint, readPoint)
  into.triangles = from.uint32s(into.triangles)
}

export function writeSurface(to: CdrWriter, message: Surface): void {
  to.string(message.name)
  to.string(message.label)
  to.string(message.source)
  writePose(to, message.pose)
  to.messages(message.vertices, writePoint)
  to.uint32s(message.triangles)
}

/** mrlab_msgs/msg/Surfaces: All surfaces of the room. Latched. */
export interface Surfaces {
  /** frame_id is world */
  header: Header
  surfaces: Surface[]
}

export function createSurfaces(): Surfaces {
  return {
    header: createHeader(),
    surfaces: [],
  }
}

export function readSurfaces(from: CdrReader, into: Surfaces): void {
  readHeader(from, into.header)
  into.surfaces = from.messages(into.surfaces, createSurface, readSurface)
}

export const surfacesReader: MessageReader<Surfaces> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Surfaces',
  createSurfaces,
  readSurfaces,
)

/** mrlab_msgs/msg/SystemMember: One robot of a robot system and its share of the timeline. */
export interface SystemMember {
  /** name of the robot */
  robot: string
  trajectory_id: string
  /** s on the system's timeline at which it begins */
  start: number
  /** s at the system's rate 1 */
  duration: number
  /** s it waits after its end before the next one starts (sequential) */
  dwell: number
  /** a state of PlaybackState */
  state: number
  /** s on its own trajectory when it last stood or was ordered */
  position: number
  /** what it waits for, such as "frame 0: after kr6_1.frame 120" */
  waits: string[]
  /** the wait that holds it now; empty: none */
  waiting_for: string
}

export function createSystemMember(): SystemMember {
  return {
    robot: '',
    trajectory_id: '',
    start: 0,
    duration: 0,
    dwell: 0,
    state: 0,
    position: 0,
    waits: [],
    waiting_for: '',
  }
}

export function readSystemMember(from: CdrReader, into: SystemMember): void {
  into.robot = from.string(into.robot)
  into.trajectory_id = from.string(into.trajectory_id)
  into.start = from.float64()
  into.duration = from.float64()
  into.dwell = from.float64()
  into.state = from.uint8()
  into.position = from.float64()
  into.waits = from.strings(into.waits)
  into.waiting_for = from.string(into.waiting_for)
}

export function writeSystemMember(to: CdrWriter, message: SystemMember): void {
  to.string(message.robot)
  to.string(message.trajectory_id)
  to.float64(message.start)
  to.float64(message.duration)
  to.float64(message.dwell)
  to.uint8(message.state)
  to.float64(message.position)
  to.strings(message.waits)
  to.string(message.waiting_for)
}

/** mrlab_msgs/msg/Telemetry: What a display shows beside the robot, at a bounded rate. joint_states is the motion itself. */
export interface Telemetry {
  /** when it was taken; frame_id is the robot's name */
  header: Header
  /** order of the arrays below */
  joint_names: string[]
  /** rad/s, derived from the trajectory */
  velocities: Float64Array
  /** N*m nominal, for display only: not a torque */
  effort_proxy: Float64Array
  /** source frame */
  frame: number
  /** s from the first frame */
  position: number
  has_gripper: boolean
  /** meaningful only where has_gripper */
  gripper_closed: boolean
  /** pose of tool0 in the robot's base_link, m */
  tool0: Pose
  /** empty: nothing, or no physics */
  held_object: string
  /** kg; meaningful, as what follows, only with held_object */
  held_mass: number
  /** kg that the robot may carry with this end effector; 0: not stated */
  payload: number
  /** friction there / friction needed - 1; negative: it slips */
  slip_margin: number
  /** N*m of its weight about the origin of tool0 */
  wrist_moment: number
  /** s, how late the last joint state left */
  deadline_error: number
  /** s, largest since play */
  deadline_error_max: number
  /** joint states of this trajectory sent since play */
  frames_sent: number
  /** joint states left out since play because they were far too late */
  frames_lost: number
}

export function createTelemetry(): Telemetry {
  return {
    header: createHeader(),
    joint_names: [],
    velocities: new Float64Array(0),
    effort_proxy: new Float64Array(0),
    frame: 0,
    position: 0,
    has_gripper: false,
    gripper_closed: false,
    tool0: createPose(),
    held_object: '',
    held_mass: 0,
    payload: 0,
    slip_margin: 0,
    wrist_moment: 0,
    deadline_error: 0,
    deadline_error_max: 0,
    frames_sent: 0,
    frames_lost: 0,
  }
}

export function readTelemetry(from: CdrReader, into: Telemetry): void {
  readHeader(from, into.header)
  into.joint_names = from.strings(into.joint_names)
  into.velocities = from.float64s(into.velocities)
  into.effort_proxy = from.float64s(into.effort_proxy)
  into.frame = from.uint32()
  into.position = from.float64()
  into.has_gripper = from.bool()
  into.gripper_closed = from.bool()
  readPose(from, into.tool0)
  into.held_object = from.string(into.held_object)
  into.held_mass = from.float64()
  into.payload = from.float64()
  into.slip_margin = from.float64()
  into.wrist_moment = from.float64()
  into.deadline_error = from.float64()
  into.deadline_error_max = from.float64()
  into.frames_sent = from.uint32()
  into.frames_lost = from.uint32()
}

export const telemetryReader: MessageReader<Telemetry> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Telemetry',
  createTelemetry,
  readTelemetry,
)

/** mrlab_msgs/msg/TrajectoryCatalogue: The trajectories that everybody may load: the lab's own and those that are shared, ordered by id. Latched. */
export interface TrajectoryCatalogue {
  /** the 1000 newest at most, without their warnings */
  trajectories: TrajectoryInfo[]
  /** how many there are; converter/list gives all */
  total: number
}

export function createTrajectoryCatalogue(): TrajectoryCatalogue {
  return {
    trajectories: [],
    total: 0,
  }
}

export function readTrajectoryCatalogue(from: CdrReader, into: TrajectoryCatalogue): void {
  into.trajectories = from.messages(into.trajectories, createTrajectoryInfo, readTrajectoryInfo)
  into.total = from.uint32()
}

export const trajectoryCatalogueReader: MessageReader<TrajectoryCatalogue> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/TrajectoryCatalogue',
  createTrajectoryCatalogue,
  readTrajectoryCatalogue,
)

/** mrlab_msgs/msg/TrajectoryInfo: What there is to know of a trajectory without its frames. */
export interface TrajectoryInfo {
  /** name in the catalogue, unique there */
  id: string
  /** id of the robot model it was checked against, such as ur5e */
  robot_model: string
  /** id of the end effector; empty: none */
  end_effector: string
  /** name of the workspace file, without folder */
  source_file: string
  /** variable in that file, written as in MATLAB */
  source_variable: string
  /** of the workspace file, 64 hexadecimal digits */
  source_sha256: string
  /** when it was converted, wall time */
  created: Time
  /** Hz */
  frame_rate: number
  /** at least 2 */
  frame_count: number
  /** s, (frame_count - 1) / frame_rate */
  duration: number
  /** true: every frame has a gripper state */
  has_gripper: boolean
  /** user whose it is; empty: the lab's, made at its own machine */
  owner: string
  /** from 1; a new upload of the same name and owner is the next one */
  version: number
  /** true: everybody may see and load it; false: its owner and instructors; the lab's are shared */
  shared: boolean
  /** what the converter doubted, never of severity ERROR */
  warnings: Diagnostic[]
}

export function createTrajectoryInfo(): TrajectoryInfo {
  return {
    id: '',
    robot_model: '',
    end_effector: '',
    source_file: '',
    source_variable: '',
    source_sha256: '',
    created: createTime(),
    frame_rate: 0,
    frame_count: 0,
    duration: 0,
    has_gripper: false,
    owner: '',
    version: 0,
    shared: false,
    warnings: [],
  }
}

export function readTrajectoryInfo(from: CdrReader, into: TrajectoryInfo): void {
  into.id = from.string(into.id)
  into.robot_model = from.string(into.robot_model)
  into.end_effector = from.string(into.end_effector)
  into.source_file = from.string(into.source_file)
  into.source_variable = from.string(into.source_variable)
  into.source_sha256 = from.string(into.source_sha256)
  readTime(from, into.created)
  into.frame_rate = from.float64()
  into.frame_count = from.uint32()
  into.duration = from.float64()
  into.has_gripper = from.bool()
  into.owner = from.string(into.owner)
  into.version = from.uint32()
  into.shared = from.bool()
  into.warnings = from.messages(into.warnings, createDiagnostic, readDiagnostic)
}

/** mrlab_msgs/srv/Trigger_Request: Do what the service's name says. As std_srvs/Trigger, with the code and the values of the text. */
export type TriggerRequest = Record<string, never>

export function writeTriggerRequest(to: CdrWriter, _: TriggerRequest): void {
  to.uint8(0)
}

/** mrlab_msgs/srv/Trigger_Response */
export interface TriggerResponse {
  /** false: nothing was changed */
  success: boolean
  /** why not, or what was done */
  message: string
  /** what it is, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
}

export function createTriggerResponse(): TriggerResponse {
  return {
    success: false,
    message: '',
    code: '',
    values: [],
  }
}

export function readTriggerResponse(from: CdrReader, into: TriggerResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
}

/** mrlab_msgs/srv/Undo_Request: Bring back what an act removed, as /undoable names it. */
export interface UndoRequest {
  /** of the act; empty: the newest one */
  id: string
}

export function writeUndoRequest(to: CdrWriter, message: UndoRequest): void {
  to.string(message.id)
}

/** mrlab_msgs/msg/Undoable: The newest act that can be undone: somebody loaded a scene, or removed robots, objects or a system. Latched; sent at each change. */
export interface Undoable {
  header: Header
  /** of the act; empty: there is none */
  id: string
  /** it can be undone until then, lab time */
  until: Time
  /** what was done, for a person */
  message: string
  /** what the message says, for programs; docs/diagnostics.md lists the codes */
  code: string
  /** values of that text by name; a text as it is, all else as JSON */
  values: KeyValue[]
}

export function createUndoable(): Undoable {
  return {
    header: createHeader(),
    id: '',
    until: createTime(),
    message: '',
    code: '',
    values: [],
  }
}

export function readUndoable(from: CdrReader, into: Undoable): void {
  readHeader(from, into.header)
  into.id = from.string(into.id)
  readTime(from, into.until)
  into.message = from.string(into.message)
  into.code = from.string(into.code)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
}

export const undoableReader: MessageReader<Undoable> = /* @__PURE__ */ messageReader(
  'mrlab_msgs/msg/Undoable',
  createUndoable,
  readUndoable,
)

export const attachType: ServiceType<AttachRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Attach',
  writeAttachRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const convertTrajectoryType: ServiceType<ConvertTrajectoryRequest, ConvertTrajectoryResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/ConvertTrajectory',
  writeConvertTrajectoryRequest,
  createConvertTrajectoryResponse,
  readConvertTrajectoryResponse,
)

export const createSystemType: ServiceType<CreateSystemRequest, CreateSystemResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/CreateSystem',
  writeCreateSystemRequest,
  createCreateSystemResponse,
  readCreateSystemResponse,
)

export const detachType: ServiceType<DetachRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Detach',
  writeDetachRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const listBagsType: ServiceType<ListBagsRequest, ListBagsResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/ListBags',
  writeListBagsRequest,
  createListBagsResponse,
  readListBagsResponse,
)

export const listCatalogueType: ServiceType<ListCatalogueRequest, ListCatalogueResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/ListCatalogue',
  writeListCatalogueRequest,
  createListCatalogueResponse,
  readListCatalogueResponse,
)

export const listScenesType: ServiceType<ListScenesRequest, ListScenesResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/ListScenes',
  writeListScenesRequest,
  createListScenesResponse,
  readListScenesResponse,
)

export const loadTrajectoryType: ServiceType<LoadTrajectoryRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/LoadTrajectory',
  writeLoadTrajectoryRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const moveObjectType: ServiceType<MoveObjectRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/MoveObject',
  writeMoveObjectRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const placeRobotType: ServiceType<PlaceRobotRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/PlaceRobot',
  writePlaceRobotRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const removeType: ServiceType<RemoveRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Remove',
  writeRemoveRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const replayType: ServiceType<ReplayRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Replay',
  writeReplayRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const sceneFileType: ServiceType<SceneFileRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SceneFile',
  writeSceneFileRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const seekType: ServiceType<SeekRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Seek',
  writeSeekRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const setEndEffectorType: ServiceType<SetEndEffectorRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SetEndEffector',
  writeSetEndEffectorRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const setLoopType: ServiceType<SetLoopRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SetLoop',
  writeSetLoopRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const setModeType: ServiceType<SetModeRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SetMode',
  writeSetModeRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const setPlaceType: ServiceType<SetPlaceRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SetPlace',
  writeSetPlaceRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const setRateType: ServiceType<SetRateRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SetRate',
  writeSetRateRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const setSurfacesType: ServiceType<SetSurfacesRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SetSurfaces',
  writeSetSurfacesRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const spawnObjectType: ServiceType<SpawnObjectRequest, SpawnObjectResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SpawnObject',
  writeSpawnObjectRequest,
  createSpawnObjectResponse,
  readSpawnObjectResponse,
)

export const spawnRobotType: ServiceType<SpawnRobotRequest, SpawnRobotResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/SpawnRobot',
  writeSpawnRobotRequest,
  createSpawnRobotResponse,
  readSpawnRobotResponse,
)

export const startRecordingType: ServiceType<StartRecordingRequest, StartRecordingResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/StartRecording',
  writeStartRecordingRequest,
  createStartRecordingResponse,
  readStartRecordingResponse,
)

export const triggerType: ServiceType<TriggerRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Trigger',
  writeTriggerRequest,
  createTriggerResponse,
  readTriggerResponse,
)

export const undoType: ServiceType<UndoRequest, TriggerResponse> = /* @__PURE__ */ serviceType(
  'mrlab_msgs/srv/Undo',
  writeUndoRequest,
  createTriggerResponse,
  readTriggerResponse,
)
