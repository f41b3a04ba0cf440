import { showToast } from '../design/toast'
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

interface Answer extends Told {
  readonly success: boolean
}

/** Call a service; return why it was refused, empty where it was done. */
export async function ask<Request, Response extends Answer>(
  link: Link,
  service: string,
  type: ServiceType<Request, Response>,
  request: Request,
): Promise<string> {
  try {
    const answer = await link.call(service, type, request)
    return answer.success ? '' : spoken(answer) || service
  } catch (error) {
    return sentence(error)
  }
}

/** Call a service and say what came of it where it was refused. */
export async function order<Request, Response extends Answer>(
  link: Link,
  service: string,
  type: ServiceType<Request, Response>,
  request: Request,
): Promise<boolean> {
  const refusal = await ask(link, service, type, request)
  if (refusal !== '') showToast(refusal)
  return refusal === ''
}

export function trigger(link: Link, service: string): Promise<boolean> {
  return order<Record<string, never>, TriggerResponse>(link, service, triggerType, {})
}

/** Return the names of the bags that the lab can replay, newest first. Rejects with why it says none. */
export async function listBagsOf(link: Link): Promise<readonly string[]> {
  const answer = await link.call('recorder/list_bags', listBagsType, {})
  if (!answer.success) throw new LinkError('refused', answer)
  return answer.bags
}

/** Return what a robot, a robot system or the recorder's replay is told. */
export function commandsOf(link: Link, name: string): Commands {
  const play = name === 'recorder' ? 'resume' : 'play'
  return {
    play: () => void trigger(link, `${name}/${play}`),
    pause: () => void trigger(link, `${name}/pause`),
    seek: (position) => void order(link, `${name}/seek`, seekType, { position }),
    setRate: (rate) => void order(link, `${name}/set_rate`, setRateType, { rate }),
  }
}
