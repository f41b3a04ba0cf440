import { useEffect, useMemo } from 'preact/hooks'
import { Button } from '../../design/button'
import { Notice } from '../../design/notice'
import { useFileDrop } from '../../shell/file_drop'
import { path } from '../../shell/router'
import { useApi } from '../../shell/session'
import { words } from '../../words/words'
import { DropZone } from './drop_zone'
import { UploadFlow } from './flow'
import { Pickers } from './pickers'
import { Progress } from './progress'
import { Verdict } from './verdict'
import '../motion/verdict.css'
import './upload.css'

/** From a file to a robot that moves. */
export function UploadPage() {
  const api = useApi()
  const flow = useMemo(() => new UploadFlow(api), [api])
  useEffect(() => {
    const left = new AbortController()
    void flow.loadLibrary()
    void flow.follow(left.signal, path.value === '/live')
    return () => {
      left.abort()
      flow.cancel()
    }
  }, [flow])
  const over = useFileDrop((file) => void flow.choose(file))
  const w = words.value.upload
  const { result, file, error } = flow

  if (result.value !== null && file.value !== null)
    return (
      <>
        {over && <div class="drop-over">{w.dropHere}</div>}
        {error.value && (
          <div class="upload-problem">
            <Notice severity="error">
              <p>{error.value}</p>
              <Button onClick={() => void flow.run()}>{words.value.retry}</Button>
            </Notice>
          </div>
        )}
        <Verdict flow={flow} result={result.value} file={file.value} />
      </>
    )
  return (
    <div class="upload-start">
      <header class="upload-head">
        <h1>{w.title}</h1>
        <p class="second">{w.subtitle}</p>
      </header>
      {error.value && (
        <Notice severity="error">
          <p>{error.value}</p>
          {file.value ? (
            <div class="row">
              <Button look="primary" onClick={() => void flow.run()}>
                {words.value.retry}
              </Button>
              <span class="second small">{w.kept(file.value.name)}</span>
            </div>
          ) : (
            <Button onClick={() => void flow.loadLibrary()}>{words.value.retry}</Button>
          )}
        </Notice>
      )}
      {flow.busy.value ? (
        <Progress flow={flow} />
      ) : (
        <DropZone over={over} onFile={(chosen) => void flow.choose(chosen)} />
      )}
      <div class="upload-robot">
        <Pickers flow={flow} />
      </div>
    </div>
  )
}
