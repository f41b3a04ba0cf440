import { signal } from '@preact/signals'
import type { Api } from '../api/api'
import type { TrajectoryInfo } from '../api/types'
import { sentence, spoken, ToldError } from '../words/diagnostic'

interface Carrier {
  readonly model: string
  readonly end_effector: string
}

/** The fields that say for which robot a trajectory is, in the gateway's list and in messages. */
interface Carried {
  readonly robot_model: string
  readonly end_effector: string
}

/** Return whether a robot can play a trajectory: a trajectory without an end effector plays with
 * any. The same rule as `mrlab_ros/core/trajectory/trajectory.py`. */
export function fits(info: Carried, robot: Carrier): boolean {
  if (info.robot_model !== robot.model) return false
  return info.end_effector === '' || info.end_effector === robot.end_effector
}

/** Return the motions that a robot can play, newest first, and the number of those for another end
 * effector. */
export function playable(
  all: readonly TrajectoryInfo[],
  robot: Carrier,
): { readonly here: TrajectoryInfo[]; readonly otherwise: number } {
  const ofModel = all.filter((info) => info.robot_model === robot.model)
  const here = ofModel.filter((info) => fits(info, robot))
  here.sort((a, b) => b.created - a.created || a.id.localeCompare(b.id))
  return { here, otherwise: ofModel.length - here.length }
}

/** The trajectories that the person may see, for the robots of the lab. */
export class LabCatalogue {
  readonly all = signal<readonly TrajectoryInfo[] | null>(null)
  readonly error = signal('')
  #loading = false
  #again = false

  constructor(private readonly api: Api) {}

  /** Read the list; a call while it is read has it read once more. */
  async load(): Promise<void> {
    if (this.#loading) {
      this.#again = true
      return
    }
    this.#loading = true
    try {
      do {
        this.#again = false
        const { trajectories, problem } = await this.api.trajectories()
        this.all.value = trajectories
        this.error.value = problem ? spoken(problem) : ''
      } while (this.#again)
    } catch (error) {
      this.error.value = sentence(error)
    } finally {
      this.#loading = false
    }
  }

  /** Convert a file for a robot model and publish it under a name; return its id. Rejects with
   * why not. */
  async take(file: File, robot_model: string, name: string, end_effector = ''): Promise<string> {
    const { signal } = new AbortController()
    const { upload } = await this.api.upload(file, () => undefined, signal)
    const request = { upload, robot_model, end_effector }
    const conversion = await this.api.convert(request, signal)
    if (conversion.draft === null) throw new ToldError(conversion)
    const { id } = await this.api.publish(conversion.draft, name, false)
    await this.load()
    return id
  }
}
