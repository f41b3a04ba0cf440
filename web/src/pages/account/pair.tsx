import { path } from '../../shell/router'
import { session } from '../../shell/session'
import { ApprovePage } from './approve'
import { ShowCodePage } from './show_code'
import './account.css'

/** A device without a sign-in shows a code; a signed-in person approves it. */
export function PairPage() {
  const code = decodeURIComponent(path.value.split('/')[2] ?? '')
  return session.value?.user ? <ApprovePage code={code} /> : <ShowCodePage />
}
