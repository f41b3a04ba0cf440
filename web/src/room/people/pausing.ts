import type { LabFollower } from '../../lab/follower'
import type { Link } from '../../link/link'
import { LinkError } from '../../link/link'
import { RobotSystem, triggerType } from '../../protocol/mrlab_msgs'
import { spoken } from '../../words/diagnostic'

/** s within which several pauses count as one deed. */
const TOGETHER = 1.5

/** Return the names of moving systems, and of moving robots that are in none. */
export function movingNow({ robots, systems }: Pick<LabFollower, 'robots' | 'systems'>): string[] {
  const alone = robots.value
    .filter(({ state, playback }) => {
      const moves = state === 'PLAYING' || state === 'ADJUSTING'
      return moves && !playback?.system
    })
    .map(({ robot }) => robot.name)
  const together = systems.value
    .filter(({ system: { state } }) => {
      return state === RobotSystem.PLAYING || state === RobotSystem.STAGING
    })
    .map(({ system }) => system.name)
  return [...together, ...alone]
}

/** Pause every robot and system that moves. Returns which were paused, and why others were not. */
export async function pauseAll(
  link: Pick<Link, 'call'>,
  follower: Pick<LabFollower, 'robots' | 'systems'>,
): Promise<{ readonly paused: readonly string[]; readonly failed: readonly string[] }> {
  const names = movingNow(follower)
  const paused: string[] = []
  const failed: string[] = []
  await Promise.all(
    names.map(async (name) => {
      try {
        const answer = await link.call(`${name}/pause`, triggerType, {})
        if (answer.success) paused.push(name)
        else failed.push(`${name}: ${spoken(answer)}`)
      } catch (error) {
        if (!(error instanceof LinkError)) throw error
        failed.push(`${name}: ${spoken(error.told)}`)
      }
    }),
  )
  return { paused, failed }
}

/** Reports the pauses of other people; pauses of one person within a short time are one
 * sentence. */
export function pauseNews(
  link: Link,
  say: (who: string, names: readonly string[]) => void,
  now: () => number = () => performance.now() / 1000,
): () => void {
  let who = ''
  let names: string[] = []
  let last = Number.NEGATIVE_INFINITY
  return link.onDeed((deed) => {
    const name = deed.service.slice(0, deed.service.lastIndexOf('/'))
    const time = now()
    if (deed.who !== who || time - last > TOGETHER) names = []
    who = deed.who
    last = time
    if (!names.includes(name)) names = [...names, name]
    say(who, names)
  })
}
