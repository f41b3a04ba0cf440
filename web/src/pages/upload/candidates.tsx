import type { Candidate } from '../../api/types'
import { Button } from '../../design/button'
import { Sparkline } from '../../design/plot/sparkline'
import { spoken } from '../../words/diagnostic'
import { number, words } from '../../words/words'

interface CandidatesProps {
  candidates: readonly Candidate[]
  busy: boolean
  /** The variable that plots and 3D show; empty: none. */
  drawn: string
  onChoose: (variable: string) => void
}

/** Several matrices could be the motion: say which. */
export function Candidates({ candidates, busy, drawn, onChoose }: CandidatesProps) {
  const w = words.value.upload
  return (
    <section class="card stack candidates-card" aria-labelledby="candidates">
      <h2 id="candidates">{w.which}</h2>
      <ul class="candidates">
        {candidates.map((candidate) => (
          <li key={candidate.variable} class="candidate">
            <div class="candidate-head">
              <code class="candidate-name">{candidate.variable}</code>
              {candidate.variable === drawn && <span class="chip chip-plain">{w.shownHere}</span>}
              <span class="second small nowrap">
                {candidate.rows} × {candidate.columns}
              </span>
            </div>
            <Sparkline preview={candidate.preview} label={w.sparkline(candidate.variable)} />
            <p class="small second">
              {candidate.minimum !== null &&
                candidate.maximum !== null &&
                w.range(number(candidate.minimum, 2), number(candidate.maximum, 2))}
            </p>
            <p class="small">{candidate.reasons.map(spoken).join('; ')}</p>
            <Button look="primary" disabled={busy} onClick={() => onChoose(candidate.variable)}>
              {w.take(candidate.variable)}
            </Button>
          </li>
        ))}
      </ul>
    </section>
  )
}
