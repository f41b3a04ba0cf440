import type { MotionDocument } from '../playback/motion'
import { own, type Told } from '../words/diagnostic'
import { type Api, ApiError, type ClassPart, trajectoryUrl } from './api'
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

/** The fields of assets/robots.json that pages use; thumbnails are keys of assets. */
interface LibraryDocument {
  readonly robots: readonly {
    readonly id: string
    readonly name: string
    readonly maker: string
    readonly product: string
    readonly joints: readonly { readonly name: string }[]
    readonly home: readonly number[]
    readonly reach: number
    readonly payload: number
    readonly urdf: string
    readonly thumbnail: string | null
  }[]
  readonly end_effectors: readonly {
    readonly id: string
    readonly name: string
    readonly thumbnail: string | null
  }[]
}

function checkUrl(robot: string, trajectory: string): string {
  return `/api/checks?${new URLSearchParams({ robot, trajectory })}`
}

function address(key: string | null): string | null {
  return key === null ? null : `/${key}`
}

type Method = 'GET' | 'POST' | 'PUT' | 'PATCH' | 'DELETE'

/** The gateway, by fetch; uploads by XMLHttpRequest, which alone reports progress. */
export class HttpApi implements Api {
  #csrf = ''
  /** Called when a sign-in has ended. */
  onSignedOut: () => void = () => {}

  constructor(private readonly noAnswer: () => string) {}

  async session(): Promise<Session> {
    return this.#kept(await this.#ask<Session>('GET', '/api/session'))
  }
  async signIn(name: string, password: string): Promise<Session> {
    await this.#ask('POST', '/api/session', { name, password })
    return this.session()
  }
  async signOut(): Promise<void> {
    await this.#ask('DELETE', '/api/session')
  }

  async robots(): Promise<RobotLibrary> {
    const library = await this.#ask<LibraryDocument>('GET', '/assets/robots.json')
    return {
      robots: library.robots.map((robot) => ({
        model: robot.id,
        name: robot.product || robot.name,
        maker: robot.maker,
        joints: robot.joints.map(({ name }) => name),
        home: robot.home,
        reach: robot.reach,
        payload: robot.payload,
        urdf: `/${robot.urdf}`,
        thumbnail: address(robot.thumbnail),
      })),
      end_effectors: library.end_effectors.map((each) => ({
        id: each.id,
        name: each.name,
        thumbnail: address(each.thumbnail),
      })),
    }
  }

  upload(file: File, onProgress: (share: number) => void, signal: AbortSignal): Promise<Upload> {
    return this.#sent(`/api/uploads/${encodeURIComponent(file.name)}`, file, onProgress, signal)
  }
  #sent<Answer>(
    url: string,
    file: File,
    onProgress: (share: number) => void,
    signal: AbortSignal,
  ): Promise<Answer> {
    return new Promise((resolve, reject) => {
      const request = new XMLHttpRequest()
      const abort = () => request.abort()
      const end = (act: () => void) => {
        signal.removeEventListener('abort', abort)
        act()
      }
      request.open('PUT', url)
      request.setRequestHeader('X-CSRF-Token', this.#csrf)
      request.setRequestHeader('Content-Type', 'application/octet-stream')
      request.upload.onprogress = (event) => {
        if (event.lengthComputable) onProgress(event.loaded / event.total)
      }
      request.onload = () =>
        end(() => {
          const body = parsed(request.responseText)
          if (request.status < 300) resolve(body as Answer)
          else reject(this.#failure(request.status, body))
        })
      request.onerror = () => end(() => reject(new ApiError(0, 'no_answer', own(this.noAnswer()))))
      request.onabort = () => end(() => reject(new DOMException('Cancelled', 'AbortError')))
      signal.addEventListener('abort', abort)
      if (signal.aborted) request.abort()
      else request.send(file)
    })
  }
  convert(request: ConversionRequest, signal: AbortSignal): Promise<Conversion> {
    return this.#ask('POST', '/api/conversions', request, signal)
  }
  motion(url: string, signal?: AbortSignal): Promise<MotionDocument> {
    return this.#ask('GET', url, undefined, signal)
  }

  async live(after: string | null, signal: AbortSignal): Promise<Live | null> {
    const url = after === null ? '/api/live' : `/api/live?after=${after}`
    return (await this.#ask<{ now: Live | null }>('GET', url, undefined, signal)).now
  }

  trajectories(): Promise<Listing> {
    return this.#ask('GET', '/api/trajectories')
  }
  async sketch(id: string): Promise<readonly (readonly number[])[]> {
    const url = trajectoryUrl(id, 'sketch')
    return (await this.#ask<{ poses: number[][] }>('GET', url)).poses
  }
  publish(draft: string, id: string, shared: boolean): Promise<TrajectoryInfo> {
    return this.#ask('POST', '/api/trajectories', { draft, id, shared })
  }
  async versions(id: string): Promise<readonly Version[]> {
    const url = trajectoryUrl(id, 'versions')
    return (await this.#ask<{ versions: Version[] }>('GET', url)).versions
  }
  async share(id: string, shared: boolean): Promise<void> {
    await this.#ask('PATCH', trajectoryUrl(id), { shared })
  }
  async remove(id: string): Promise<void> {
    await this.#ask('DELETE', trajectoryUrl(id))
  }
  restore(id: string, version: number): Promise<TrajectoryInfo> {
    return this.#ask('POST', trajectoryUrl(id, 'restore'), { version })
  }

  check(robot: string, trajectory: string): Promise<Check> {
    return this.#ask('GET', checkUrl(robot, trajectory))
  }
  startCheck(robot: string, trajectory: string): Promise<Check> {
    return this.#ask('POST', '/api/checks', { robot, trajectory })
  }
  touches(draft: string, signal?: AbortSignal): Promise<readonly CheckFinding[]> {
    return this.#ask('GET', `/api/checks/drafts/${encodeURIComponent(draft)}`, undefined, signal)
  }
  async cancelCheck(robot: string, trajectory: string): Promise<void> {
    await this.#ask('DELETE', checkUrl(robot, trajectory))
  }

  gradedClass(): Promise<GradedClass> {
    return this.#ask('GET', '/api/class')
  }
  classSource(name: string, file: File, onProgress: (share: number) => void): Promise<void> {
    const url = `/api/class/sources/${encodeURIComponent(name)}`
    return this.#sent(url, file, onProgress, new AbortController().signal)
  }
  async classDo(method: 'POST' | 'DELETE', part: ClassPart, body?: object): Promise<void> {
    await this.#ask(method, `/api/class/${part}`, body ?? (method === 'POST' ? {} : undefined))
  }
  course(): Promise<CourseState> {
    return this.#ask('GET', '/api/class/course')
  }
  sendMarks(): Promise<MarksSent> {
    return this.#ask('POST', '/api/class/course/marks', {})
  }
  handedIn(): Promise<HandInState> {
    return this.#ask('GET', '/api/hand_in')
  }
  handIn(file: File, onProgress: (share: number) => void): Promise<void> {
    const url = `/api/hand_in/${encodeURIComponent(file.name)}`
    return this.#sent(url, file, onProgress, new AbortController().signal)
  }
  async classFile(key: string): Promise<File> {
    const url = `/api/class/${encodeURIComponent(key)}/file`
    const motion = await this.#ask<object>('GET', url)
    return new File([JSON.stringify(motion)], `${key}.json`, { type: 'application/json' })
  }

  async people(): Promise<readonly Person[]> {
    return (await this.#ask<{ people: Person[] }>('GET', '/api/people')).people
  }
  invite(person: NewPerson): Promise<InvitationLink> {
    return this.#ask('POST', '/api/people', person)
  }
  inviteAgain(name: string): Promise<InvitationLink> {
    return this.#ask('POST', `/api/people/${encodeURIComponent(name)}/invitation`)
  }
  async removePerson(name: string, fate: Fate): Promise<void> {
    const query = new URLSearchParams({ ...fate })
    await this.#ask('DELETE', `/api/people/${encodeURIComponent(name)}?${query}`)
  }
  invitation(token: string): Promise<Invitation> {
    return this.#ask('GET', `/api/invitations/${encodeURIComponent(token)}`)
  }
  async acceptInvitation(token: string, password: string): Promise<Session> {
    await this.#ask('POST', `/api/invitations/${encodeURIComponent(token)}`, { password })
    return this.session()
  }

  async devices(): Promise<readonly Device[]> {
    return (await this.#ask<{ devices: Device[] }>('GET', '/api/devices')).devices
  }
  async revokeDevice(id: string): Promise<void> {
    await this.#ask('DELETE', `/api/devices/${encodeURIComponent(id)}`)
  }
  async makeToken(program: NewToken): Promise<string> {
    return (await this.#ask<{ token: string }>('POST', '/api/tokens', program)).token
  }
  startPairing(): Promise<Pairing> {
    return this.#ask('POST', '/api/pairings', { device: deviceName() })
  }
  pairing(secret: string): Promise<PairingState> {
    return this.#ask('GET', `/api/pairings/${encodeURIComponent(secret)}`)
  }
  pairingDevice(code: string): Promise<PairingDevice> {
    return this.#ask('GET', `/api/pairings/shown/${encodeURIComponent(code)}`)
  }
  async approvePairing(code: string, role: Role): Promise<string> {
    const body = { code, role }
    return (await this.#ask<{ user: { name: string } }>('POST', '/api/pairings/approve', body))
      .user.name
  }

  #kept(session: Session): Session {
    this.#csrf = session.csrf
    return session
  }

  async #ask<Answer>(
    method: Method,
    url: string,
    body?: object,
    signal?: AbortSignal,
  ): Promise<Answer> {
    const headers: Record<string, string> = { Accept: 'application/json' }
    if (method !== 'GET') headers['X-CSRF-Token'] = this.#csrf
    if (body) headers['Content-Type'] = 'application/json'
    const init: RequestInit = { method, headers, credentials: 'same-origin' }
    if (body) init.body = JSON.stringify(body)
    if (signal) init.signal = signal
    let response: Response
    try {
      response = await fetch(url, init)
    } catch (error) {
      if (error instanceof DOMException) throw error
      throw new ApiError(0, 'no_answer', own(this.noAnswer()))
    }
    const answer = parsed(await response.text())
    if (!response.ok) throw this.#failure(response.status, answer)
    return answer as Answer
  }

  #failure(status: number, answer: unknown): ApiError {
    const error = (answer as { error?: Told & { kind: string } } | null)?.error
    if (status === 401) this.onSignedOut()
    return new ApiError(status, error?.kind ?? '', error ?? own(`${status}: ${this.noAnswer()}`))
  }
}

/** Return the name of a headset in the list of devices, as far as its browser reports it. */
function deviceName(): string {
  const agent = navigator.userAgent
  return /Quest( \d)?|Pico[ \w]*|Vision|iPhone|iPad|Android/.exec(agent)?.[0].trim() ?? 'headset'
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text)
  } catch {
    return null
  }
}
