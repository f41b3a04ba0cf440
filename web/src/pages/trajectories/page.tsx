import { useEffect, useMemo } from 'preact/hooks'
import { path } from '../../shell/router'
import { session, useApi } from '../../shell/session'
import { Catalogue, idOfPath } from './catalogue'
import { TrajectoryDetail } from './detail'
import { TrajectoryList } from './list'
import './trajectories.css'

/** One's own trajectories and the shared ones: the list, or one of them. */
export function TrajectoriesPage() {
  const api = useApi()
  const user = session.value?.user?.id ?? ''
  const catalogue = useMemo(() => new Catalogue(api, user), [api, user])
  useEffect(() => catalogue.follow(), [catalogue])
  const id = idOfPath(path.value)
  if (id !== '') return <TrajectoryDetail key={id} catalogue={catalogue} id={id} />
  return <TrajectoryList catalogue={catalogue} user={user} />
}
