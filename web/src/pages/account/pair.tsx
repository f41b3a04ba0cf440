import { path } from '../../shell/router'
import { session } from '../../shell/session'
import { ApprovePage } from './approve'
import { ShowCodePage } from './show_code'
import './account.css'

/** A device that is not signed in shows a code; a person who is approves it. */
export function PairPage() {
  const code = decodeURIComponent(path.value.split('/')[2] ?? '')
  return session.value?.user ? <ApprovePage code={code} /> : <ShowCodePage />
}
