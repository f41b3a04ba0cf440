import type { Course } from '../../playback/course'
import type { CourseOf } from './followed_robot'

/** Of how many trajectories the frames are kept. */
const MOST = 24

/** The frames of trajectories, each fetched once for all robots that play it. */
export class Courses {
  private readonly known = new Map<string, Promise<Course>>()

  constructor(private readonly fetch: CourseOf) {}

  /** Return the frames of a trajectory, such as quintic@3; one that failed is asked for again. */
  readonly of: CourseOf = (id) => {
    let fetching = this.known.get(id)
    if (fetching === undefined) {
      fetching = this.fetch(id)
      this.known.set(id, fetching)
      fetching.catch(() => this.known.delete(id))
      const [oldest] = this.known.keys()
      if (this.known.size > MOST && oldest !== undefined) this.known.delete(oldest)
    }
    return fetching
  }
}
