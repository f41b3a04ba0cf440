import { computed, signal } from '@preact/signals'
import type { Api } from '../../api/api'
import type { Robot, TrajectoryInfo } from '../../api/types'
import { sentence, spoken } from '../../words/diagnostic'

/** A list that others change is read this often. */
const EVERY_MS = 5000

export type Scope = 'all' | 'mine' | 'shared'

/** Return the part of an id behind its owner. */
export function shortName(id: string): string {
  return id.slice(id.indexOf('/') + 1)
}

/** Return the page of a trajectory. */
export function trajectoryPage(id: string, compared = ''): string {
  const place = id.split('/').map(encodeURIComponent).join('/')
  return `/trajectories/${place}${compared && `?with=${encodeURIComponent(compared)}`}`
}

/** Return the id that a page's path names; empty: the list. */
export function idOfPath(path: string): string {
  const parts = path.split('/').slice(2)
  return parts.map(decodeURIComponent).join('/')
}

/** Return those that `text` is part of, by name, owner, robot or file, of `scope`, newest first. */
export function found(
  all: readonly TrajectoryInfo[],
  text: string,
  scope: Scope,
  user: string,
): TrajectoryInfo[] {
  const wanted = text.trim().toLowerCase().split(/\s+/).filter(Boolean)
  return all
    .filter((each) => {
      if (scope === 'mine' && each.owner !== user) return false
      if (scope === 'shared' && each.owner === user) return false
      if (wanted.length === 0) return true
      const line =
        `${each.id} ${each.robot_model} ${each.end_effector} ${each.source_file}`.toLowerCase()
      return wanted.every((word) => line.includes(word))
    })
    .sort((a, b) => b.created - a.created || a.id.localeCompare(b.id))
}

function same(one: readonly TrajectoryInfo[], other: readonly TrajectoryInfo[] | null): boolean {
  return JSON.stringify(one) === JSON.stringify(other)
}

/** The trajectories that a person may see, and the search for one. */
export class Catalogue {
  readonly all = signal<readonly TrajectoryInfo[] | null>(null)
  readonly error = signal('')
  readonly text = signal('')
  readonly scope = signal<Scope>('all')
  /** The library's robots; empty until they are loaded. */
  readonly robots = signal<readonly Robot[]>([])
  /** Ids to compare, two at most. */
  readonly chosen = signal<readonly string[]>([])
  readonly found = computed(() =>
    found(this.all.value ?? [], this.text.value, this.scope.value, this.user),
  )

  /** Number of changes made here. */
  #changes = 0

  constructor(
    private readonly api: Api,
    readonly user: string,
  ) {}

  /** Read the list. A change made here meanwhile is newer than the list. */
  async load(): Promise<void> {
    const changes = this.#changes
    try {
      const { trajectories: all, problem } = await this.api.trajectories()
      if (changes === this.#changes && !same(all, this.all.value)) this.all.value = all
      this.error.value = problem ? spoken(problem) : ''
    } catch (error) {
      this.error.value = sentence(error)
    }
  }

  /** Read the list now, every few seconds while the page is visible, and when it becomes visible:
   * others change it. Return a function that ends it. */
  follow(): () => void {
    const look = () => {
      if (document.visibilityState === 'visible') void this.load()
    }
    void this.load()
    // without them the rows have no pictures
    this.api.robots().then(
      ({ robots }) => {
        this.robots.value = robots
      },
      () => undefined,
    )
    const timer = setInterval(look, EVERY_MS)
    document.addEventListener('visibilitychange', look)
    return () => {
      clearInterval(timer)
      document.removeEventListener('visibilitychange', look)
    }
  }

  /** Return whether it can be compared with the one that is chosen: motions of other robots cannot. */
  comparable(info: TrajectoryInfo): boolean {
    const first = this.all.value?.find(({ id }) => id === this.chosen.value[0])
    return first === undefined || first.robot_model === info.robot_model
  }

  toggle(id: string): void {
    const { value } = this.chosen
    this.chosen.value = value.includes(id)
      ? value.filter((each) => each !== id)
      : [...value.slice(-1), id]
  }

  async share(id: string, shared: boolean): Promise<void> {
    await this.api.share(id, shared)
    this.#changes++
    this.#replace(id, (each) => ({ ...each, shared }))
  }

  async remove(id: string): Promise<void> {
    await this.api.remove(id)
    this.#changes++
    this.all.value = (this.all.value ?? []).filter((each) => each.id !== id)
    this.chosen.value = this.chosen.value.filter((each) => each !== id)
  }

  async restore(id: string, version: number): Promise<TrajectoryInfo> {
    const info = await this.api.restore(id, version)
    this.#changes++
    const others = (this.all.value ?? []).filter((each) => each.id !== id)
    this.all.value = [info, ...others]
    return info
  }

  #replace(id: string, change: (info: TrajectoryInfo) => TrajectoryInfo): void {
    this.all.value = (this.all.value ?? []).map((each) => (each.id === id ? change(each) : each))
  }
}
