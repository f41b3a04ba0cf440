import { type Link, LinkError } from '../link/link'
import type { Commands } from '../playback/player'
import type { ServiceType } from '../protocol/message_type'
import {
  listBagsType,
  seekType,
  setRateType,
  type TriggerResponse,
  triggerType,
} from '../protocol/mrlab_msgs'
import { sentence, spoken, type Told } from '../words/diagnostic'

/** The lab, and how the caller reports a refusal. */
export interface Lab {
  readonly link: Link
  /** Show a sentence; warns: it reports a problem, which is the default. */
  say(text: string, warns?: boolean): void
}

interface Answer extends Told {
  readonly success: boolean
}

/** Call a service; report a refusal. Returns the response; null if it was refused. */
export async function order<Request, Response extends Answer>(
  { link, say }: Lab,
  service: string,
  type: ServiceType<Request, Response>,
  request: Request,
): Promise<Response | null> {
  try {
    const answer = await link.call(service, type, request)
    if (answer.success) return answer
    say(spoken(answer) || service)
  } catch (error) {
    say(sentence(error))
  }
  return null
}

export function trigger(lab: Lab, service: string): Promise<TriggerResponse | null> {
  return order<Record<string, never>, TriggerResponse>(lab, service, triggerType, {})
}

/** Return the names of the bags that the lab can replay, newest first. Rejects with why it says
 * none. */
export async function listBagsOf(link: Link): Promise<readonly string[]> {
  const answer = await link.call('recorder/list_bags', listBagsType, {})
  if (!answer.success) throw new LinkError('refused', answer)
  return answer.bags
}

/** Return a function that sends a value at once, or, while an answer is awaited, the newest of the
 * values since then: what a timeline's thumb passes is no queue. */
function newest<T>(send: (value: T) => Promise<unknown>): (value: T) => void {
  let next: { readonly value: T } | null = null
  let busy = false
  const run = async () => {
    busy = true
    while (next !== null) {
      const { value } = next
      next = null
      await send(value)
    }
    busy = false
  }
  return (value) => {
    next = { value }
    if (!busy) void run()
  }
}

/** Return the commands of a robot, of a robot system or of the recorder's replay. */
export function commandsOf(lab: Lab, name: string): Commands {
  const play = name === 'recorder' ? 'resume' : 'play'
  return {
    play: () => void trigger(lab, `${name}/${play}`),
    pause: () => void trigger(lab, `${name}/pause`),
    seek: newest((position: number) => order(lab, `${name}/seek`, seekType, { position })),
    setRate: (rate) => void order(lab, `${name}/set_rate`, setRateType, { rate }),
  }
}
