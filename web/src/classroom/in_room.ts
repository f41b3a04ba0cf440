import { type Api, submissionUrl } from '../api/api'
import { LabCatalogue } from '../lab/catalogue'
import type { RoomExtra } from '../room/page'
import { ClassSteps, publishedName } from './class_steps'
import { type Lesson, SUBMISSION } from './lesson'

/** The class in the room: its motions, and a tab for its teacher. */
export const classInRoom: RoomExtra = {
  motionUrl: (id) =>
    id.startsWith(SUBMISSION) ? submissionUrl(id.slice(SUBMISSION.length)) : null,
  tab: async (api, may) => {
    if (!may.grades) return null
    const { classTab } = await import('./class_tab')
    const lesson = lessonOf(api)
    return (ports, follower, drawings) => classTab(ports, follower, drawings, lesson)
  },
}

function lessonOf(api: Api): Lesson {
  const catalogue = new LabCatalogue(api)
  return {
    steps: new ClassSteps(api),
    publish: async ({ key, robot, tool }) =>
      catalogue.take(await api.classFile(key), robot, publishedName(key), tool),
  }
}
