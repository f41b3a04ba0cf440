import { useEffect, useState } from 'preact/hooks'
import type { ClassPart } from '../api/api'
import type { CourseState, MarksSent } from '../api/types'
import { Button } from '../design/button'
import { Notice } from '../design/notice'
import { showToast } from '../design/toast'
import { useApi } from '../shell/session'
import { say, sentence } from '../words/diagnostic'
import { words } from '../words/words'
import type { ClassSteps } from './class_steps'

/** The course of a class at its teacher's desk: who has handed in, and the way of the marks back. */
export function Course({ steps }: { readonly steps: ClassSteps }) {
  const api = useApi()
  const w = words.value.grades.course
  const [course, setCourse] = useState<CourseState | null>(null)
  const [sent, setSent] = useState<MarksSent | null>(null)
  const [busy, setBusy] = useState(false)
  const load = async () => setCourse(await api.course())
  useEffect(() => {
    load().catch((error: unknown) => showToast(sentence(error)))
  }, [api])
  if (course === null) return null
  const does = async (what: () => Promise<void>) => {
    setBusy(true)
    try {
      await what()
      await load()
    } catch (error) {
      showToast(sentence(error))
    } finally {
      setBusy(false)
    }
  }
  const part = (method: 'POST' | 'DELETE', name: ClassPart) => does(() => steps.does(method, name))
  const desk = steps.graded.value?.desk
  const running = desk?.run?.running ?? false
  return (
    <section class="stack-8 desk-course" aria-label={w.title}>
      <h3>{course.connected ? w.connected(course.course, course.task) : w.title}</h3>
      {!course.connected && <p class="second">{w.none}</p>}
      {course.count > 0 && <p>{w.handedIn(course.handed_in, course.count)}</p>}
      {course.silent.length > 0 && (
        <details>
          <summary>
            {w.silent}: {course.silent.length}
          </summary>
          <ul class="desk-list small">
            {course.silent.map((name) => (
              <li key={name}>{name}</li>
            ))}
          </ul>
        </details>
      )}
      {course.connected && (
        <div class="row">
          {course.members && (
            <Button disabled={busy} onClick={() => part('POST', 'course/members')}>
              {w.members}
            </Button>
          )}
          <Button
            disabled={busy || running || course.handed_in === 0 || desk?.locked !== ''}
            onClick={() =>
              does(async () => {
                await steps.does('POST', 'course/export')
                showToast(w.taken)
              })
            }
          >
            {w.take}
          </Button>
          {desk?.released && course.scores && (
            <Button
              look="primary"
              disabled={busy}
              onClick={() => does(async () => setSent(await api.sendMarks()))}
            >
              {w.send}
            </Button>
          )}
          <Button
            look="quiet"
            disabled={busy}
            title={w.leaving}
            onClick={() => part('DELETE', 'course')}
          >
            {w.leave}
          </Button>
        </div>
      )}
      {sent && (
        <Notice severity={sent.problems.length > 0 ? 'warning' : 'info'}>
          <p>{say(sent.said).message}</p>
          {sent.problems.map((each) => (
            <p key={each.message}>{say(each).message}</p>
          ))}
        </Notice>
      )}
    </section>
  )
}
